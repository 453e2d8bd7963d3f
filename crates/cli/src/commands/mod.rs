//! The arguments and commands of `meaninfo`, one command per file. Each computes everything before it writes anything.

mod bag;
mod check;
mod completions;
mod converge;
mod emmi;
mod filter;
mod limit;
mod man;
mod map;
mod page;
mod paper;
mod port;
mod sensor;
mod simulate;
mod sweep;
mod trajectory;
mod version;

use crate::failure::Failure;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use std::ffi::OsString;

/// The mean information of occupancy maps (Blanco's measure): how certain a map is of the cells it has observed, in
/// bits per observed cell, from 0 to 1.
#[derive(Debug, Parser)]
#[command(name = "meaninfo", version, arg_required_else_help = false, after_help = format!("Exit status: {EXIT_STATUS}"))]
pub struct Arguments {
    /// The command.
    #[command(subcommand)]
    pub command: Command,
}

impl Arguments {
    /// Parses a command line, whose first argument is the name of the program.
    ///
    /// # Errors
    /// What is wrong with them; also a request for help or for the version.
    pub fn of(arguments: &[OsString]) -> Result<Self, clap::Error> {
        // A negative number is the value of its option, whose own message says what is allowed.
        let option = |arg: clap::Arg| {
            let takes_value = arg.get_action().takes_values() && !arg.is_positional();
            arg.allow_negative_numbers(takes_value)
        };
        let mut command = Self::command().mut_subcommands(|command| command.mut_args(option));
        // Its vectors are counted, which takes a moment.
        if arguments.iter().any(|argument| argument == "--version") {
            command = command.long_version(version::long());
        }
        Self::from_arg_matches(&command.try_get_matches_from(arguments)?)
    }
}

/// Returns the call for help on the command that a command line names, whose first argument is the name of the program.
pub(crate) fn help_of(arguments: &[OsString]) -> String {
    // No option that takes a value comes before the command.
    let named = arguments.get(1).and_then(|word| word.to_str());
    match named.filter(|&word| Arguments::command().find_subcommand(word).is_some()) {
        Some(word) => format!("meaninfo {word} --help"),
        None => "meaninfo --help".to_owned(),
    }
}

/// The commands of `meaninfo`.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// The mean information of maps, and what it is made of.
    Map(map::Arguments),
    /// The mean information of the maps of a bag, one after the other as they stand in it.
    Bag(bag::Arguments),
    /// The trajectory that makes the most consistent map of these scans: the mean information and the agreement of the map
    /// of each, without ground truth.
    Trajectory(Box<trajectory::Arguments>),
    /// The mean information of a map against its resolution, by averaging cells 2 x 2, 4 x 4, ...; what lies beyond the
    /// map's edge is unknown.
    Sweep(sweep::Arguments),
    /// The limit of the mean information of one scan of a circular room as cells shrink.
    Limit(limit::Arguments),
    /// The mean information of grids of a circular room against the size of their cells: how they tend to the limit, and the
    /// proved bound on how far they are from it.
    Converge(converge::Arguments),
    /// The expected map of a particle filter's weighted maps, its mean information (EMMI), and that of each particle; or of a
    /// GMapping log (--filter), step by step.
    Emmi(Box<emmi::Arguments>),
    /// A simulated robot with a range sensor in a room: the map it makes, written as a ROS map and as an array.
    Simulate(simulate::Arguments),
    /// Everything in the report, computed again: its five figures, its claims as a table, and a page with both.
    Paper(paper::Arguments),
    /// A page for browsers that measures maps and shows where their information is, with these maps inside: one file to send.
    Page(page::Arguments),
    /// The library as a port: it serves the port protocol on standard input and output.
    Port(port::Arguments),
    /// Runs an implementation in any language, a port, against the vectors: is it right, and if not, where and why.
    Check(Box<check::Arguments>),
    /// A script for a shell that completes the words of this command.
    Completions(completions::Arguments),
    /// Manual pages of this command and of each of its commands.
    Man(man::Arguments),
}

impl Command {
    /// Runs the command.
    ///
    /// # Errors
    /// Any refusal; then nothing has been printed, and no file touched, but by [`Command::Map`] with `--keep-going`, which
    /// writes the rows of the maps that can be read and refuses the others.
    pub fn run(&self) -> Result<Status, Failure> {
        match self {
            Self::Map(arguments) => arguments.run(),
            Self::Bag(arguments) => arguments.run(),
            Self::Trajectory(arguments) => arguments.run(),
            Self::Sweep(arguments) => arguments.run(),
            Self::Limit(arguments) => arguments.run(),
            Self::Converge(arguments) => arguments.run(),
            Self::Emmi(arguments) => arguments.run(),
            Self::Simulate(arguments) => arguments.run(),
            Self::Paper(arguments) => arguments.run(),
            Self::Page(arguments) => arguments.run(),
            Self::Port(arguments) => arguments.run(),
            Self::Check(arguments) => arguments.run(),
            Self::Completions(arguments) => arguments.run(),
            Self::Man(arguments) => arguments.run(),
        }
    }
}

/// The exit statuses in words, for the help, the manual pages and the README.
pub(crate) const EXIT_STATUS: &str = "0 is done; 1 done, and a check did not hold (limit: not converged; converge: a bound; paper: a \
     claim; check: a test); 2 refused, with a line on standard error for each thing that is wrong, and nothing written but \
     the rows of map --keep-going.";

/// The end of a command that did what it was asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Exit status 0.
    Done,
    /// Exit status 1: done, and a check did not hold.
    CheckFailed,
}

impl Status {
    /// Returns the exit status.
    pub(crate) fn number(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::CheckFailed => 1,
        }
    }
}
