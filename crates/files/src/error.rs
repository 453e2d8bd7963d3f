//! Why a file was refused: one error, with all that a caller branches on.

use std::borrow::Cow;
use std::collections::TryReserveError;
use std::error::Error as StdError;
use std::fmt::{self, Write};
use std::io;
use std::path::{Path, PathBuf};

/// Why a file was not read or not written: its kind, the file, the place in it, the value, what is allowed, and the
/// cause.
///
/// It displays as `FILE: what is wrong, and what is allowed`, in one line: control characters are escaped.
///
/// ```
/// use mean_information_files::{ErrorKind, Options, Place, Semantics, ros::Description};
///
/// let text = "image: map.pgm\nresolution: -0.05\n";
/// let refused = Description::read(text.as_bytes(), Semantics::Nav2).unwrap_err();
/// assert_eq!(refused.kind(), ErrorKind::OutOfRange);
/// assert_eq!(refused.place(), Some(&Place::Key("resolution")));
/// assert_eq!((refused.value(), refused.allowed()), (Some("-0.05"), Some("a positive number of metres")));
/// assert_eq!(refused.to_string(), "resolution is -0.05, allowed is a positive number of metres");
/// ```
#[derive(Debug)]
pub struct Error(Box<Details>);

#[derive(Debug)]
struct Details {
    kind: ErrorKind,
    file: Option<PathBuf>,
    place: Option<Place>,
    value: Option<String>,
    allowed: Option<Cow<'static, str>>,
    message: String,
    source: Option<Box<dyn StdError + Send + Sync>>,
}

/// The kind of an [`Error`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorKind {
    /// The file does not exist.
    NotFound,
    /// The path names a folder, which holds no bag where one is read, a pipe or a device.
    NotAFile,
    /// The system failed to read or to write; the source is its [`io::Error`].
    Io,
    /// The file ends before its data do.
    CutShort,
    /// The file breaks the rules of its format.
    Format,
    /// The file is of a format, or of a kind within a format, that is not read or cannot be written.
    Unsupported,
    /// The file is of another kind than is wanted, by its name: [`FileKind::of`](crate::FileKind::of) tells which.
    OtherKind,
    /// A value of the file or of an option lies outside its range.
    OutOfRange,
    /// The file has more cells than [`Options::max_cells`](crate::Options::max_cells) allows: a larger limit may admit it.
    TooLarge,
    /// Memory lacks for the cells, or cannot number them.
    OutOfMemory,
    /// None, or several, of what the file holds can be meant: one must be named.
    Choice,
    /// The options contradict one another.
    Options,
}

/// A place in a file.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Place {
    /// A line of text, from 1.
    Line(u64),
    /// A byte, from 0.
    Byte(u64),
    /// The value of a key.
    Key(&'static str),
    /// A pixel of an image: row from the top and column, from 0.
    Pixel {
        /// The row, from 0 at the top.
        row: usize,
        /// The column, from 0.
        column: usize,
    },
    /// A cell of a map, from 0: row from the lowest and column; of a stack of maps also which of them.
    Cell {
        /// The map in a stack, from 0.
        map: Option<usize>,
        /// The row, from 0 at the bottom.
        row: usize,
        /// The column, from 0.
        column: usize,
    },
    /// An item of a list, from 0.
    Item(usize),
    /// A message of a bag.
    Message {
        /// The topic.
        topic: String,
        /// The number among those of the topic, from 1.
        number: u64,
        /// The byte of the message, from 0.
        byte: Option<u64>,
    },
    /// An option of the reader, by its name.
    Option(&'static str),
}

impl Error {
    /// Creates an error of which only kind and words are known.
    pub(crate) fn new(kind: ErrorKind, message: impl Into<String>) -> Self {
        Self(Box::new(Details {
            kind,
            file: None,
            place: None,
            value: None,
            allowed: None,
            message: bounded(&message.into()).into_owned(),
            source: None,
        }))
    }

    /// Creates an error of kind [`ErrorKind::OutOfRange`]: `what is value, allowed is allowed`.
    pub(crate) fn out_of_range(
        what: impl fmt::Display,
        value: impl fmt::Display,
        allowed: impl Into<Cow<'static, str>>,
    ) -> Self {
        Self::new(ErrorKind::OutOfRange, format!("{what} is {value}"))
            .with_value(value.to_string())
            .allowing(", allowed is ", allowed)
    }

    /// Adds the place.
    pub(crate) fn at(mut self, place: Place) -> Self {
        self.0.place = Some(place);
        self
    }

    /// Adds the value, which the words have already.
    pub(crate) fn with_value(mut self, value: impl Into<String>) -> Self {
        self.0.value = Some(bounded(&value.into()).into_owned());
        self
    }

    /// Adds what is allowed, also to the words, after `joint`.
    pub(crate) fn allowing(mut self, joint: &str, allowed: impl Into<Cow<'static, str>>) -> Self {
        let mut allowed = allowed.into();
        if let Cow::Owned(short) = bounded(&allowed) {
            allowed = short.into();
        }
        self.0.message.extend([&*bounded(joint), &*allowed]);
        self.0.allowed = Some(allowed);
        self
    }

    /// Adds the cause.
    pub(crate) fn caused_by(mut self, source: impl StdError + Send + Sync + 'static) -> Self {
        self.0.source = Some(Box::new(source));
        self
    }

    /// Puts words behind the message.
    pub(crate) fn followed_by(mut self, words: &str) -> Self {
        self.0.message.push_str(&bounded(words));
        self
    }

    /// Puts words before the message.
    pub(crate) fn preceded_by(mut self, words: &str) -> Self {
        self.0.message.insert_str(0, &bounded(words));
        self
    }

    /// Creates the error of a writer that failed.
    pub(crate) fn of_writer(error: io::Error) -> Self {
        Self::new(ErrorKind::Io, format!("cannot be written: {error}")).caused_by(error)
    }

    /// Adds the file, unless the error names one already.
    #[must_use]
    pub fn in_file(mut self, file: &Path) -> Self {
        self.0.file.get_or_insert_with(|| file.to_owned());
        self
    }

    /// Returns the kind, to branch on.
    pub fn kind(&self) -> ErrorKind {
        self.0.kind
    }

    /// Returns the file, where bytes came from one.
    pub fn file(&self) -> Option<&Path> {
        self.0.file.as_deref()
    }

    /// Returns the place in the file, where there is one.
    pub fn place(&self) -> Option<&Place> {
        self.0.place.as_ref()
    }

    /// Returns the value that was refused, as text.
    pub fn value(&self) -> Option<&str> {
        self.0.value.as_deref()
    }

    /// Returns what is allowed, in words.
    pub fn allowed(&self) -> Option<&str> {
        self.0.allowed.as_deref()
    }

    /// Returns what is wrong, without the file and as it is: names and values may hold control characters.
    pub fn message(&self) -> &str {
        &self.0.message
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let file = self.file().map_or(String::new(), |file| format!("{}: ", file.display()));
        for c in file.chars().chain(self.message().chars()) {
            if c.is_control() {
                write!(f, "{}", c.escape_default())?;
            } else {
                f.write_char(c)?;
            }
        }
        Ok(())
    }
}

impl StdError for Error {
    fn source(&self) -> Option<&(dyn StdError + 'static)> {
        self.0.source.as_deref().map(|source| source as _)
    }
}

impl From<io::Error> for Error {
    /// Takes the error of a reader, with its kind.
    fn from(error: io::Error) -> Self {
        let kind = match error.kind() {
            io::ErrorKind::NotFound => ErrorKind::NotFound,
            io::ErrorKind::UnexpectedEof => ErrorKind::CutShort,
            io::ErrorKind::OutOfMemory => ErrorKind::OutOfMemory,
            // What a decoder between the file and the reader says.
            io::ErrorKind::InvalidData | io::ErrorKind::InvalidInput => ErrorKind::Format,
            _ => ErrorKind::Io,
        };
        let message = match kind {
            ErrorKind::CutShort => "the file ends before its data do: it is cut short".to_owned(),
            _ => format!("cannot be read: {error}"),
        };
        Self::new(kind, message).caused_by(error)
    }
}

impl From<TryReserveError> for Error {
    fn from(error: TryReserveError) -> Self {
        Self::new(ErrorKind::OutOfMemory, "not enough memory for its cells").caused_by(error)
    }
}

impl From<mean_information::Error> for Error {
    /// Takes what the library refuses of a file: a cell, or a number beside the cells.
    fn from(error: mean_information::Error) -> Self {
        use mean_information::Error as Refused;
        let mut words = error.to_string();
        if let Refused::OutOfRange { value, .. } | Refused::Item { value, .. } | Refused::Cell { value, .. } =
            error
        {
            words = words.replacen(&value.to_string(), &short(value), 1);
        }
        let kind = match error {
            Refused::TooManyCells { .. } | Refused::TooManySamples { .. } => ErrorKind::TooLarge,
            Refused::NoMemory { .. } => ErrorKind::OutOfMemory,
            _ => ErrorKind::OutOfRange,
        };
        let mut refused = Self::new(kind, words);
        match error {
            Refused::OutOfRange { value, allowed, .. } => refused.set(value, allowed, None),
            Refused::Item { index, value, allowed, .. } => {
                refused.set(value, allowed, Some(Place::Item(index)));
            }
            Refused::Cell { row, column, value, allowed, .. } => {
                refused.set(value, allowed, Some(Place::Cell { map: None, row, column }));
            }
            _ => {}
        }
        refused.caused_by(error)
    }
}

impl Error {
    /// Sets the parts of what the library refused.
    fn set(&mut self, value: f64, allowed: &'static str, place: Option<Place>) {
        self.0.value = Some(short(value));
        self.0.allowed = Some(allowed.into());
        self.0.place = place;
    }

    /// Names the map of a stack that holds the place.
    pub(crate) fn in_map(mut self, index: usize) -> Self {
        if let Some(Place::Cell { map, .. }) = &mut self.0.place {
            *map = Some(index);
        }
        self
    }
}

/// The most bytes of a part of a message: a file may hold names and texts of millions.
const MOST_WORDS: usize = 4096;

/// Returns a text, without its middle where it is long.
pub(crate) fn bounded(text: &str) -> Cow<'_, str> {
    if text.len() <= MOST_WORDS {
        return text.into();
    }
    let end = (0..=MOST_WORDS / 2).rev().find(|&at| text.is_char_boundary(at));
    let start = (text.len() - MOST_WORDS / 2..=text.len()).find(|&at| text.is_char_boundary(at));
    let [end, start] = [end, start].map(Option::unwrap_or_default);
    format!("{} [...] {}", &text[..end], &text[start..]).into()
}

/// Returns a number in few characters: a power of ten stands in the place of hundreds of zeros.
pub(crate) fn short(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || !size.is_finite() || (1e-5..1e16).contains(&size) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a file holds may be long; what is said of it is not.
    #[test]
    fn every_part_of_a_message_is_bounded() {
        let long = "é".repeat(1 << 20);
        let error = Error::new(ErrorKind::Format, format!("is {long}."))
            .with_value(&*long)
            .allowing(&long, long.clone())
            .followed_by(&long)
            .preceded_by(&long);
        let most = MOST_WORDS + 8;
        assert!(error.message().len() <= 5 * most, "{}", error.message().len());
        let [value, allowed] = [error.value(), error.allowed()].map(Option::unwrap);
        assert!(value.len() <= most && allowed.len() <= most);
        assert!(value.starts_with("éé") && value.contains("é [...] é") && value.ends_with("éé"));
        let exact = "a".repeat(MOST_WORDS);
        assert_eq!(bounded(&exact), exact);
    }
}
