//! Lines of text, one at a time, and the fields of a line.

use crate::error::{Error, ErrorKind, Place};
use std::io::BufRead;

/// The most bytes of a line: a million beams of sixteen digits.
const MAX_LINE: usize = 1 << 24;

/// Bytes that some editors put before a text in UTF-8.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// The lines of a text.
#[derive(Debug)]
pub(crate) struct Lines<R> {
    input: R,
    line: Vec<u8>,
    number: u64,
}

/// A line of a text.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line<'a> {
    /// The bytes, without those that end the line.
    pub(crate) bytes: &'a [u8],
    /// The number of the line, from 1.
    pub(crate) number: u64,
    /// False of a last line that the end of the file ends: it may be cut.
    pub(crate) ended: bool,
}

impl<R: BufRead> Lines<R> {
    /// Creates the lines of an input.
    pub(crate) fn new(input: R) -> Self {
        Self { input, line: Vec::new(), number: 0 }
    }

    /// Reads the next line; `None` at the end.
    ///
    /// # Errors
    /// An [`Error`] where the input fails, or a line is longer than [`MAX_LINE`].
    pub(crate) fn next(&mut self) -> Result<Option<Line<'_>>, Error> {
        self.line.clear();
        let read =
            std::io::Read::take(&mut self.input, MAX_LINE as u64 + 1).read_until(b'\n', &mut self.line)?;
        if read == 0 {
            return Ok(None);
        }
        self.number += 1;
        if read > MAX_LINE {
            let refused = Error::new(ErrorKind::Format, format!("line {} is longer", self.number));
            return Err(refused.allowing(" than ", format!("{MAX_LINE} bytes")).at(Place::Line(self.number)));
        }
        let ended = self.line.last() == Some(&b'\n');
        let bytes = if self.number == 1 {
            self.line.strip_prefix(BYTE_ORDER_MARK).unwrap_or(&self.line)
        } else {
            &self.line
        };
        Ok(Some(Line { bytes, number: self.number, ended }))
    }
}

impl<'a> Line<'a> {
    /// Returns the fields.
    pub(crate) fn fields(self) -> Fields<'a> {
        Fields { rest: self.bytes, line: self.number }
    }

    /// Tells whether the last field may be cut, to one that could be meant or could not: the end of the file ends it, with no
    /// white space before. A comment may be cut as it likes.
    pub(crate) fn may_be_cut(self) -> bool {
        let is_comment = self.bytes.trim_ascii_start().starts_with(b"#");
        !self.ended && !is_comment && self.bytes.last().is_some_and(|byte| !byte.is_ascii_whitespace())
    }

    /// Creates an error at this line: `line N` and the words.
    pub(crate) fn refuse(self, kind: ErrorKind, words: &str) -> Error {
        Error::new(kind, format!("line {} {words}", self.number)).at(Place::Line(self.number))
    }

    /// Adds the line to an error that knows none.
    pub(crate) fn blame(self, error: Error) -> Error {
        error.preceded_by(&format!("line {}: ", self.number)).at(Place::Line(self.number))
    }
}

/// The fields of a line, which white space parts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fields<'a> {
    rest: &'a [u8],
    line: u64,
}

impl<'a> Fields<'a> {
    /// Takes the next field; `None` at the end of the line.
    pub(crate) fn word(&mut self) -> Option<&'a [u8]> {
        let rest = self.rest.trim_ascii_start();
        let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        let (word, rest) = rest.split_at(end);
        self.rest = rest;
        (!word.is_empty()).then_some(word)
    }

    /// Takes a number, which may be infinite or none.
    ///
    /// # Errors
    /// An [`Error`] of kind [`ErrorKind::Format`] if the line ends, or the field is no number.
    pub(crate) fn number(&mut self, what: &str) -> Result<f64, Error> {
        self.parse(what, "a number")
    }

    /// Takes a number that is finite.
    ///
    /// # Errors
    /// As [`Self::number`]; [`ErrorKind::OutOfRange`] if it is not finite.
    pub(crate) fn finite(&mut self, what: &str) -> Result<f64, Error> {
        let number = self.number(what)?;
        if number.is_finite() { Ok(number) } else { Err(self.out_of_range(what, number, "a finite number")) }
    }

    /// Takes a count.
    ///
    /// # Errors
    /// An [`Error`] of kind [`ErrorKind::Format`] if the line ends, or the field is no whole number from 0.
    pub(crate) fn count(&mut self, what: &str) -> Result<u64, Error> {
        self.parse(what, "a whole number from 0")
    }

    /// Passes over a field.
    ///
    /// # Errors
    /// An [`Error`] of kind [`ErrorKind::Format`] if the line ends.
    pub(crate) fn pass(&mut self, what: &str) -> Result<(), Error> {
        self.word().map(|_| ()).ok_or_else(|| self.missing(what))
    }

    /// Creates the error of a value of this line: `what in line N is value, allowed is allowed`.
    pub(crate) fn out_of_range(
        &self,
        what: &str,
        value: impl std::fmt::Display,
        allowed: &'static str,
    ) -> Error {
        Error::out_of_range(format!("{what} in line {}", self.line), value, allowed)
            .at(Place::Line(self.line))
    }

    fn parse<T: std::str::FromStr>(&mut self, what: &str, allowed: &'static str) -> Result<T, Error> {
        let word = self.word().ok_or_else(|| self.missing(what))?;
        let parsed = std::str::from_utf8(word).ok().and_then(|text| text.parse().ok());
        parsed.ok_or_else(|| {
            let text = shortened(word);
            Error::new(ErrorKind::Format, format!("{what} in line {} is `{text}`", self.line))
                .with_value(text)
                .allowing(", allowed is ", allowed)
                .at(Place::Line(self.line))
        })
    }

    fn missing(&self, what: &str) -> Error {
        Error::new(ErrorKind::Format, format!("line {} ends before {what}", self.line))
            .at(Place::Line(self.line))
    }
}

/// The most characters of a word that a message repeats.
const MAX_WORD: usize = 32;

/// Returns a word as text, cut where it is long.
pub(crate) fn shortened(word: &[u8]) -> String {
    let text = String::from_utf8_lossy(&word[..word.len().min(4 * MAX_WORD)]);
    text.chars().take(MAX_WORD).collect()
}
