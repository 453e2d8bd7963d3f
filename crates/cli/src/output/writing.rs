//! Where a result goes.

use super::{Files, Format, Report, standard_output};
use crate::failure::Failure;
use clap::Args;
use std::path::{Path, PathBuf};

/// The form of the result, and the place it goes to.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Output")]
pub struct Writing {
    /// A table to read, or JSON or CSV, where each result also stands as an exact hexadecimal float.
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
    /// Write the result to this file instead of standard output.
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

impl Writing {
    /// Refuses the file of the result, and `others` beside it, that cannot be written whatever is in them: before the work for
    /// them is done. `files` knows what is read.
    ///
    /// # Errors
    /// As [`may_write`].
    pub fn check<'a>(
        &'a self,
        files: &Files,
        others: impl IntoIterator<Item = &'a Path>,
    ) -> Result<(), Failure> {
        may_write(files, others, self.output.as_deref())
    }

    /// Writes `report` where it was asked for, together with the other `files` of the command: first the files, all or
    /// none, then standard output.
    ///
    /// # Errors
    /// A file that cannot be written or is an input; standard output that cannot be written. A reader who closed
    /// standard output early is no error.
    pub fn write(&self, report: &impl Report, files: Files) -> Result<(), Failure> {
        write_text(&report.text(self.format), self.output.as_deref(), files)
    }
}

/// Refuses the file of a result, and `others` beside it, that cannot be written whatever is in them.
///
/// # Errors
/// Those of [`Files::may_write`]; standard output by a name is none for a result.
pub fn may_write<'a>(
    files: &Files,
    others: impl IntoIterator<Item = &'a Path>,
    output: Option<&'a Path>,
) -> Result<(), Failure> {
    files.may_write(others.into_iter().chain(output.filter(|path| !standard_output::is(path))))
}

/// Writes a result to a file or to standard output, after the other `files`.
///
/// # Errors
/// Those of [`Writing::write`].
pub fn write_text(text: &str, output: Option<&Path>, mut files: Files) -> Result<(), Failure> {
    match output {
        // Renamed into its place, the result would be lost to whoever holds standard output.
        Some(path) if !standard_output::is(path) => {
            files.add(path, text.as_bytes().to_vec());
            files.write()
        }
        _ => {
            files.write()?;
            standard_output::print(text)
        }
    }
}
