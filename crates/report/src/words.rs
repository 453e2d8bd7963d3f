//! Refusals and warnings in words, each with the option of the command line that mends it.

use crate::one_line::one_line;
use mean_information::cell;
use mean_information_files::{Error, ErrorKind, FileKind, Place, Warning};
use std::fmt;
use std::path::{Path, PathBuf};

/// A file that was refused. Its text is one line, `FILE: what is wrong and what to do`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refused {
    /// The file.
    pub path: PathBuf,
    /// The fault in it.
    pub message: String,
    /// The image that a yaml file names, if it is refused because there is none.
    pub missing_image: Option<String>,
}

impl Refused {
    /// Creates the refusal of a file.
    pub fn new(path: &Path, message: impl Into<String>) -> Self {
        Self { path: path.to_owned(), message: message.into(), missing_image: None }
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&one_line(&format!("{}: {}", self.path.display(), self.message)))
    }
}

impl std::error::Error for Refused {}

/// Tells whether a cell was refused whose value often means unknown, and for which `--unknown` can be given.
fn may_be_unknown(error: &Error) -> bool {
    let of_floats = error.allowed().is_some_and(|allowed| !allowed.contains("percentage"));
    matches!(error.place(), Some(Place::Cell { .. }))
        && of_floats
        && matches!(error.value(), Some("NaN" | "-1"))
}

/// Says which command takes files of a kind.
fn command_for(kind: FileKind) -> &'static str {
    match kind {
        FileKind::Map => "; `meaninfo map` measures maps, one or several",
        FileKind::Image => "; `meaninfo map` measures the map, by the yaml file that describes its image",
        FileKind::Scans => "; `meaninfo trajectory` takes scans, and trajectories after them",
        FileKind::FilterLog => "; `meaninfo emmi --filter` takes it",
        FileKind::Trajectory => "; `meaninfo trajectory` takes trajectories, after their scans",
        _ => "",
    }
}

impl From<Error> for Refused {
    /// Takes the error of a reader or a writer, with the option that may mend it.
    fn from(error: Error) -> Self {
        let message = match error.kind() {
            ErrorKind::TooLarge => {
                format!("{}; raise it with --max-cells if the file is meant", error.message())
            }
            ErrorKind::Choice => match error.place() {
                Some(Place::Option("costmaps")) => {
                    let advice = "--topic names one, and --costmaps of `meaninfo bag` admits costmaps";
                    format!("{}; {advice}", error.message())
                }
                Some(&Place::Option(option)) if option != "file" => {
                    format!("{}; --{option} names one", error.message())
                }
                _ => error.message().to_owned(),
            },
            ErrorKind::OtherKind => {
                let command = error.file().and_then(FileKind::of).map_or("", command_for);
                format!("{}{command}", error.message())
            }
            ErrorKind::Options if error.place() == Some(&Place::Option("unknown")) => {
                "--unknown needs --mode probability; give both or neither".to_owned()
            }
            ErrorKind::OutOfRange if may_be_unknown(&error) => {
                format!("{}, as does --unknown {}", error.message(), error.value().unwrap_or_default())
            }
            // An array of integers, which may be percentages or MRPT's bytes.
            ErrorKind::Unsupported if error.message().contains("integers other than int8") => {
                format!("{}; --encoding percent reads them as they are", error.message())
            }
            _ => error.message().to_owned(),
        };
        let is_missing = error.kind() == ErrorKind::NotFound && error.place() == Some(&Place::Key("image"));
        let missing_image = error.value().filter(|_| is_missing).map(str::to_owned);
        Self { missing_image, ..Self::new(error.file().unwrap_or(Path::new("")), message) }
    }
}

/// Returns the warnings of a map as texts, each with the option that mends it.
pub fn in_words(warnings: &[Warning]) -> Vec<String> {
    let in_words = |warning: &Warning| match warning {
        Warning::SavedUnknownReadAs { grey, free_thresh: None, .. } => {
            format!("{warning}; if that grey means unknown, give --mode probability --unknown {grey}")
        }
        Warning::OftenUnknownObserved { grey, .. } => {
            format!("{warning}; give --unknown {grey} if that grey means unknown")
        }
        Warning::Clamped { least, greatest } => {
            let most = [least, greatest].map(|&p| cell::information(p)).into_iter().fold(0.0, f32::max);
            format!("{warning}, so that the mean information is at most {most:.3}")
        }
        Warning::NoGreatestRange { .. } => format!("{warning}; --max-range says it"),
        Warning::SubmapsTogether { .. } => format!("{warning}; --submaps gives each a row"),
        Warning::OftenUnknownValue { value, .. } => {
            format!("{warning}; give --unknown {value} if it means unknown here")
        }
        Warning::GreysThresholded { unknown, .. } => {
            let unknown = unknown.map_or_else(String::new, |grey| format!(" --unknown {grey}"));
            format!("{warning}; --mode scale or --mode probability{unknown} uses them")
        }
        Warning::NoPercentageAbove1 { .. } => {
            format!("{warning}; save 100 * p where p is 1 if they are states")
        }
        Warning::TransparentReadAsUnknown { .. } => {
            format!("{warning}; --semantics nav2-humble or ros1 average alpha in mode trinary")
        }
        warning => warning.to_string(),
    };
    warnings.iter().map(in_words).collect()
}
