//! The commands of `meaninfo`, one per file. Each computes everything before it writes anything.

mod map;
mod sweep;

pub use sweep::{Step, Sweep};

use crate::failure::Failure;
use clap::Subcommand;
use std::process::ExitCode;

/// What `meaninfo` can do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// The mean information of maps, and what it is made of.
    Map(map::Arguments),
    /// The mean information of a map against its resolution, by averaging cells 2 x 2, 4 x 4, ...; what lies beyond the
    /// map's edge is unknown.
    Sweep(sweep::Arguments),
}

impl Command {
    /// Does it.
    ///
    /// # Errors
    /// Any refusal; then nothing has been printed, and no file touched.
    pub fn run(&self) -> Result<Status, Failure> {
        match self {
            Self::Map(arguments) => arguments.run(),
            Self::Sweep(arguments) => arguments.run(),
        }
    }
}

/// How a command ended that did what it was asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Exit status 0.
    Done,
    /// Exit status 1: done, and a check did not hold.
    CheckFailed,
}

impl From<Status> for ExitCode {
    fn from(status: Status) -> Self {
        match status {
            Status::Done => Self::SUCCESS,
            Status::CheckFailed => Self::from(1),
        }
    }
}
