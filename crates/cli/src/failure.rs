//! Why a command did not do what it was asked: one line for stderr, and exit status 2.

use clap::error::{ContextKind, ContextValue, ErrorKind};
use mean_information_files::Error;
use mean_information_report::{Refused, one_line};
use std::fmt;
use std::path::{Path, PathBuf};

/// A refused input or request. Its text is one line and says what to do; that of several has one line for each, which
/// begin with the name of the program from the second on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Failure {
    /// The arguments make no sense.
    Usage(String),
    /// A file cannot be read, or cannot be written.
    File {
        /// The file.
        path: PathBuf,
        /// The fault in it.
        message: String,
    },
    /// Standard output cannot be written, for another reason than a reader who closed it.
    StandardOutput(String),
    /// Standard input or output failed while they were served.
    Streams(String),
    /// The vectors this program was built with make no sense.
    Vectors(String),
    /// A port cannot be talked to.
    Port {
        /// The command that starts it.
        command: String,
        /// The fault of its answers.
        message: String,
    },
    /// A picture cannot be drawn.
    Drawing(String),
    /// A part of the program is asked for that it was built without.
    NotBuiltIn(&'static str),
    /// Several inputs are refused, each for its own reason.
    Several(Vec<Failure>),
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Usage(message) => f.write_str(&one_line(message)),
            Self::File { path, message } => f.write_str(&one_line(&format!("{}: {message}", path.display()))),
            Self::StandardOutput(message) => write!(f, "standard output: {}", one_line(message)),
            Self::Streams(message) => write!(f, "standard input or output: {}", one_line(message)),
            Self::Vectors(message) => write!(f, "the vectors built in: {}", one_line(message)),
            Self::Port { command, message } => write!(f, "{}: {}", one_line(command), one_line(message)),
            Self::Drawing(message) => write!(f, "the picture cannot be drawn: {}", one_line(message)),
            Self::NotBuiltIn(message) => f.write_str(message),
            Self::Several(failures) => {
                let lines: Vec<String> = failures.iter().map(ToString::to_string).collect();
                f.write_str(&lines.join("\nmeaninfo: "))
            }
        }
    }
}

impl std::error::Error for Failure {}

impl Failure {
    /// Creates the failure of a file.
    pub(crate) fn file(path: &Path, message: impl Into<String>) -> Self {
        Self::File { path: path.to_owned(), message: message.into() }
    }
}

impl From<Refused> for Failure {
    /// Takes the refusal of a file.
    fn from(Refused { path, message, .. }: Refused) -> Self {
        Self::File { path, message }
    }
}

impl From<Error> for Failure {
    /// Takes the error of a reader or a writer, with the option that may mend it.
    fn from(error: Error) -> Self {
        Refused::from(error).into()
    }
}

impl From<mean_information::Error> for Failure {
    /// Wraps what the library refuses of an argument, not of a file.
    fn from(error: mean_information::Error) -> Self {
        Self::Usage(error.to_string())
    }
}

impl From<clap::Error> for Failure {
    /// Returns the first paragraphs of clap's message, in one line, without its usage and its advice to ask for help.
    fn from(error: clap::Error) -> Self {
        let rendered = error.to_string();
        let lines =
            rendered.lines().take_while(|line| !line.starts_with("Usage:") && !line.starts_with("For more"));
        let message = lines.map(str::trim).filter(|line| !line.is_empty()).collect::<Vec<_>>().join(" ");
        // Of a command to run, after `--`: a word that is no option is where it begins.
        let is_word = matches!(error.get(ContextKind::InvalidArg), Some(ContextValue::String(word)) if !word.starts_with('-'));
        let takes_command = error.kind() == ErrorKind::UnknownArgument && rendered.contains("-- <CMD>");
        let advice = if is_word && takes_command { "; put -- before the command" } else { "" };
        Self::Usage(message.trim_start_matches("error: ").to_owned() + advice)
    }
}
