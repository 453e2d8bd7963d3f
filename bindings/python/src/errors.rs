//! Refusals as Python's exceptions, in the words of the command.

use mean_information_cli::Failure;
use mean_information_files::ErrorKind;
use pyo3::exceptions::{PyFileNotFoundError, PyMemoryError, PyOSError, PyValueError};
use pyo3::prelude::*;

/// Converts what the library refuses: `ValueError`.
pub(crate) fn refused(error: mean_information::Error) -> PyErr {
    match error {
        mean_information::Error::TooManyCells { .. } => PyMemoryError::new_err(error.to_string()),
        _ => PyValueError::new_err(error.to_string()),
    }
}

/// Converts what a reader refuses, with the file and the command's words: `FileNotFoundError`, `MemoryError`, `OSError`, or
/// `ValueError`.
pub(crate) fn of_file(error: mean_information_files::Error) -> PyErr {
    let kind = error.kind();
    let words = in_python(&Failure::from(error).to_string());
    match kind {
        ErrorKind::NotFound => PyFileNotFoundError::new_err(words),
        ErrorKind::TooLarge | ErrorKind::OutOfMemory => PyMemoryError::new_err(words),
        ErrorKind::NotAFile | ErrorKind::Io => PyOSError::new_err(words),
        _ => PyValueError::new_err(words),
    }
}

/// Spells the command's options as Python's arguments: `--max-cells` as `max_cells`.
pub(crate) fn in_python(words: &str) -> String {
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
