//! Why a file was refused.

use std::collections::TryReserveError;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// The file, what is wrong with it and what to do: `FILE: message`, one line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    file: PathBuf,
    message: String,
}

impl Problem {
    /// A problem with `file`.
    pub fn new(file: &Path, message: impl Into<String>) -> Self {
        Self { file: file.to_owned(), message: message.into() }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&one_line(&format!("{}: {}", self.file.display(), self.message)))
    }
}

impl std::error::Error for Problem {}

/// The text in one line, whatever a file is called or a message quotes: control characters are escaped.
pub(crate) fn one_line(text: &str) -> String {
    let mut line = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_control() { line.extend(c.escape_default()) } else { line.push(c) }
    }
    line
}

/// What is wrong with the bytes a reader was given, before they have a file name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault(String);

impl Fault {
    /// A fault in words: what is wrong, and what is allowed.
    pub fn new(message: impl Into<String>) -> Self {
        Self(message.into())
    }

    /// The fault as a problem with `file`.
    pub fn in_file(self, file: &Path) -> Problem {
        Problem::new(file, self.0)
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Fault {}

impl From<io::Error> for Fault {
    fn from(error: io::Error) -> Self {
        if error.kind() == io::ErrorKind::UnexpectedEof {
            Self::new("the file ends before its data do: it is cut short")
        } else {
            Self::new(format!("cannot be read: {error}"))
        }
    }
}

impl From<TryReserveError> for Fault {
    fn from(_: TryReserveError) -> Self {
        Self::new("not enough memory for its cells")
    }
}

impl From<mean_information::Error> for Fault {
    fn from(error: mean_information::Error) -> Self {
        Self::new(error.to_string())
    }
}
