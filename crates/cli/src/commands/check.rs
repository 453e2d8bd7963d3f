//! `meaninfo check`: a port against the vectors.

use super::Status;
use crate::check::{Check, KnownFailures, Options, Registry, Vectors};
use crate::failure::Failure;
use crate::output::{self, Files, Report, may_write, write_text};
use clap::{Args, ValueEnum};
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::time::Duration;
use std::{env, fs};

/// The arguments of `meaninfo check`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// A file of the ids of tests that are known to fail, one a line, comments after #; one that does not fail is a failure.
    #[arg(long, value_name = "FILE")]
    known_failures: Option<PathBuf>,
    /// Only the operations of this name; * stands for any text. May be given several times.
    #[arg(long, value_name = "GLOB")]
    ops: Vec<String>,
    /// How many seconds the port may take for an answer.
    #[arg(long, value_name = "SECONDS", default_value = "30", value_parser = seconds)]
    timeout: Duration,
    /// The vectors of this folder in place of those built in.
    #[arg(long, value_name = "DIR")]
    vectors: Option<PathBuf>,
    /// Print the list of operations; no port is run.
    #[arg(long, conflicts_with_all = ["command", "known_failures", "ops", "timeout", "vectors"])]
    list: bool,
    /// The command that starts the port, with its arguments, after --.
    #[arg(last = true, required_unless_present = "list", value_name = "CMD")]
    command: Vec<OsString>,
    /// A table to read; JSON with every failure; CSV with a line per operation and format; JUnit XML for continuous
    /// integration.
    #[arg(long, value_enum, default_value_t, help_heading = "Output")]
    format: VerdictFormat,
    /// Write the result to this file instead of standard output.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    output: Option<PathBuf>,
}

/// The form of a verdict.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum VerdictFormat {
    #[default]
    Table,
    Json,
    Csv,
    Junit,
}

impl VerdictFormat {
    /// Returns the form that other results have too, if it is one.
    fn common(self) -> Option<output::Format> {
        match self {
            Self::Table => Some(output::Format::Table),
            Self::Json => Some(output::Format::Json),
            Self::Csv => Some(output::Format::Csv),
            Self::Junit => None,
        }
    }
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Status, Failure> {
        let mut files = Files::new();
        if self.list {
            let format = self.format.common();
            let format = format.ok_or_else(|| {
                Failure::Usage("--list: a list of operations is no verdict, so no JUnit".into())
            })?;
            write_text(&Registry.text(format), self.output.as_deref(), files)?;
            return Ok(Status::Done);
        }
        let known = self.known_failures.as_deref().map(KnownFailures::read).transpose()?;
        files.read(self.known_failures.clone());
        files.read(self.vectors.iter().flat_map(|folder| files_in(folder)));
        files.read(self.command.iter().map(PathBuf::from));
        files.read(self.command.first().and_then(|program| found_on_path(program)));
        may_write(&files, [], self.output.as_deref())?;
        let vectors = match &self.vectors {
            Some(folder) => Vectors::in_folder(folder)?,
            None => Vectors::built_in()?,
        };
        let options = Options {
            command: self.command.clone(),
            limit: self.timeout,
            ops: self.ops.clone(),
            known: known.unwrap_or_default(),
        };
        let check = Check::run(&options, vectors)?;
        let text = self.format.common().map_or_else(|| check.junit(), |format| check.text(format));
        write_text(&text, self.output.as_deref(), files)?;
        Ok(if check.holds() { Status::Done } else { Status::CheckFailed })
    }
}

/// Returns the files of a folder, as far as it can be read.
fn files_in(folder: &Path) -> impl Iterator<Item = PathBuf> {
    fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path())
}

/// Returns the file that the system runs by this name.
fn found_on_path(program: &OsStr) -> Option<PathBuf> {
    let folders = env::var_os("PATH")?;
    let found = env::split_paths(&folders).map(|folder| folder.join(program)).find(|path| path.is_file());
    // A name with a folder in it is no name to look for.
    found.filter(|_| Path::new(program).components().count() == 1)
}

/// Parses a time limit.
fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().filter(|seconds| *seconds > 0.0);
    let limit = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    limit
        .filter(|limit| *limit <= LONGEST)
        .ok_or_else(|| "not a time from above 0 to 86400 seconds".to_owned())
}

/// A day.
const LONGEST: Duration = Duration::from_secs(86400);
