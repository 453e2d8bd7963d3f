//! Refusals of logs of scans that several readers share.

use crate::error::{Error, ErrorKind, Place};

/// Creates the error of a topic all messages of which have the time 0.
pub(super) fn unstamped(what: &str, topic: &str) -> Error {
    let words = format!("has {what} on {topic} that all have the time 0: nothing stamped their headers");
    Error::new(ErrorKind::OutOfRange, words)
        .with_value("0")
        .allowing("; allowed are ", "stamps by the clock of the poses")
}

/// Creates the error of a choice among names, which an option of this name makes.
pub(super) fn choice<'a>(
    option: &'static str,
    words: String,
    joint: &str,
    names: impl IntoIterator<Item = &'a String>,
) -> Error {
    let names: Vec<&str> = names.into_iter().map(String::as_str).collect();
    let listed = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
    Error::new(ErrorKind::Choice, words).at(Place::Option(option)).allowing(joint, listed)
}
