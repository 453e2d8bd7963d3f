//! Refusals as Python's exceptions, in the words of the command.

use mean_information_cli::Failure;
use mean_information_files::{ErrorKind, file_of};
use pyo3::exceptions::{PyMemoryError, PyOSError, PyValueError};
use pyo3::prelude::*;
use std::io;
use std::path::Path;

/// Converts what the library refuses: `ValueError`.
pub(crate) fn refused(error: mean_information::Error) -> PyErr {
    let words = error.to_string();
    if error.is_too_large() { PyMemoryError::new_err(words) } else { PyValueError::new_err(words) }
}

/// The numbers of the system's errors that a reader finds out by itself: `ENOENT` and `EISDIR`.
const NO_ENTRY: i32 = 2;
const IS_DIRECTORY: i32 = 21;

/// Converts what a reader refuses, with the file and the command's words: `FileNotFoundError` and other kinds of `OSError`, with
/// `errno` and `filename` as of Python's `open`, `MemoryError`, or `ValueError`.
pub(crate) fn of_file(error: mean_information_files::Error) -> PyErr {
    let source = std::error::Error::source(&error);
    // The file that is not there may be one that the file names: the image of a yaml file.
    let missing = source.and_then(|cause| cause.downcast_ref::<mean_information_files::Error>());
    let file = missing.and_then(|missing| missing.file()).or(error.file()).map(Path::to_owned);
    let (kind, cause) = (error.kind(), source.and_then(|cause| cause.downcast_ref::<io::Error>()));
    let number = cause.and_then(io::Error::raw_os_error);
    // What the system says, in Python's words for it; else the reader's.
    let of_system =
        number.filter(|_| cause.is_some_and(|cause| error.message() == format!("cannot be read: {cause}")));
    let failure = Failure::from(error);
    match (kind, failure) {
        (ErrorKind::NotFound | ErrorKind::NotAFile | ErrorKind::Io, Failure::File { path, message }) => {
            let file = file_of(&file.unwrap_or(path)).to_owned();
            let number = number.unwrap_or(match kind {
                ErrorKind::NotFound => NO_ENTRY,
                _ if file.is_dir() => IS_DIRECTORY,
                _ => return PyOSError::new_err(in_python(&format!("{}: {message}", file.display()))),
            });
            Python::attach(|py| {
                let says = |number| py.import("os")?.call_method1("strerror", (number,))?.extract();
                let words = of_system.and_then(|number| says(number).ok());
                // Python makes the kind of `OSError` of the number.
                PyOSError::new_err((
                    number,
                    words.unwrap_or_else(|| in_python(&message)),
                    file.into_os_string(),
                ))
            })
        }
        (ErrorKind::TooLarge | ErrorKind::OutOfMemory, failure) => {
            PyMemoryError::new_err(in_python(&failure.to_string()))
        }
        (_, failure) => PyValueError::new_err(in_python(&failure.to_string())),
    }
}

/// Spells the command's options as Python's arguments: `--max-cells` as `max_cells`; but not within a command that is quoted.
pub(crate) fn in_python(words: &str) -> String {
    let parts = words.split('`').enumerate();
    parts
        .map(|(k, part)| if k % 2 == 0 { arguments(part) } else { part.to_owned() })
        .collect::<Vec<_>>()
        .join("`")
}

fn arguments(words: &str) -> String {
    let mut parts = words.split("--");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let end = part.find(|c: char| !c.is_ascii_lowercase() && c != '-').unwrap_or(part.len());
        if end == 0 {
            text += "--";
            text += part;
        } else {
            text += &part[..end].replace('-', "_");
            text += &part[end..];
        }
    }
    text
}

/// The refusal of an array of results that memory does not hold.
pub(crate) fn out_of_memory() -> PyErr {
    PyMemoryError::new_err("not enough memory for the result")
}

/// Returns what a word names; refuses a word that names none of the choices.
pub(crate) fn one_of<T: Copy>(what: &str, given: &str, choices: &[(&str, T)]) -> PyResult<T> {
    if let Some(&(_, chosen)) = choices.iter().find(|(word, _)| *word == given) {
        return Ok(chosen);
    }
    let words: Vec<_> = choices.iter().map(|(word, _)| format!("'{word}'")).collect();
    let and = |(last, others): (&String, &[String])| format!("{} and {last}", others.join(", "));
    let allowed = words.split_last().map_or(String::new(), and);
    Err(PyValueError::new_err(format!("{what} is '{given}', allowed are {allowed}")))
}

/// Counts in words: "1 scan", "2 scans".
pub(crate) fn count(number: impl Into<u64>, what: &str) -> String {
    match number.into() {
        1 => format!("1 {what}"),
        number => format!("{number} {what}s"),
    }
}
