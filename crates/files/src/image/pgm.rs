//! PGM, plain (P2) and raw (P5), 8 and 16 bits.
//!
//! Own code: the grammar is these few lines, and comments, maximum values, trailing data and memory are what map files
//! get wrong, so they must be ours to check.

use super::layout::{Channels, Layout};
use crate::error::{Error, ErrorKind, Place};
use crate::size::{Size, read_pieces};
use std::io::BufRead;

/// Samples of a plain image that are handed on together.
const PLAIN_PIECE: usize = 4096;

/// A PGM whose header was read.
pub(crate) struct Pgm<R> {
    input: R,
    plain: bool,
    layout: Layout,
}

impl<R: BufRead> Pgm<R> {
    /// Reads the header.
    pub(super) fn open(mut input: R, max_cells: u64) -> Result<Self, Error> {
        let mut magic = [0; 2];
        input.read_exact(&mut magic)?;
        let width = header_number(&mut input, "width", u32::MAX)?;
        let height = header_number(&mut input, "height", u32::MAX)?;
        let size = Size::within(width.into(), height.into(), max_cells)?;
        let max = header_number(&mut input, "maximum value", 65535)? as u16;
        let layout = Layout { size, channels: Channels::Grey, max, white: max };
        Ok(Self { input, plain: magic == *b"P2", layout })
    }

    /// Returns the layout of the pieces.
    pub(super) fn layout(&self) -> Layout {
        self.layout
    }

    /// Gives all pixels in reading order, a piece at a time.
    pub(super) fn pixels(mut self, mut each: impl FnMut(&[u8]) -> Result<(), Error>) -> Result<(), Error> {
        if self.plain {
            self.plain_pixels(&mut each)?;
        } else {
            self.raw_pixels(&mut each)?;
        }
        self.check_end()
    }

    /// Gives the pixels of a raw image.
    fn raw_pixels(&mut self, each: &mut impl FnMut(&[u8]) -> Result<(), Error>) -> Result<(), Error> {
        let Layout { size, max, .. } = self.layout;
        let bytes = self.layout.sample_bytes();
        let mut done = 0;
        read_pieces(&mut self.input, size.cells(), bytes, |piece| {
            let above = match max {
                255 | 65535 => None,
                _ if bytes == 1 => piece.iter().position(|&sample| u16::from(sample) > max),
                _ => piece.as_chunks().0.iter().position(|&sample| u16::from_be_bytes(sample) > max),
            };
            if let Some(at) = above {
                return Err(self.layout.above_max(done + at));
            }
            done += piece.len() / bytes;
            each(piece)
        })
    }

    /// Gives the pixels of a plain image.
    fn plain_pixels(&mut self, each: &mut impl FnMut(&[u8]) -> Result<(), Error>) -> Result<(), Error> {
        let Layout { size, max, .. } = self.layout;
        let mut piece = Vec::with_capacity(2 * PLAIN_PIECE);
        for at in 0..size.cells() {
            let Some(sample) = number(&mut self.input)? else {
                return self.layout.require(at as u64);
            };
            let Some(sample) = u16::try_from(sample).ok().filter(|&sample| sample <= max) else {
                return Err(self.layout.above_max(at));
            };
            match self.layout.sample_bytes() {
                1 => piece.push(sample as u8),
                _ => piece.extend(sample.to_be_bytes()),
            }
            if piece.len() >= PLAIN_PIECE {
                each(&piece)?;
                piece.clear();
            }
        }
        each(&piece)
    }

    /// Checks that nothing but white space follows the pixels; in a plain image comments may, too.
    fn check_end(mut self) -> Result<(), Error> {
        let rest = if self.plain { skip_blank(&mut self.input)? } else { skip_space(&mut self.input)? };
        match rest {
            None => Ok(()),
            Some(_) => Err(Error::new(
                ErrorKind::Format,
                format!("holds more than the {} pixels its header claims", self.layout.size.cells()),
            )),
        }
    }
}

impl Layout {
    /// Creates the error of a pixel above the maximum value.
    fn above_max(&self, at: usize) -> Error {
        let (row, column) = (at / self.size.width, at % self.size.width);
        Error::new(ErrorKind::OutOfRange, format!("the pixel at image row {row}, column {column} is above"))
            .at(Place::Pixel { row, column })
            .allowing(" ", format!("the maximum value {} of the header", self.max))
    }
}

/// Reads a number of the header from 1 to `most`, and the one white space after it.
fn header_number(input: &mut impl BufRead, what: &str, most: u32) -> Result<u32, Error> {
    match number(input)? {
        Some(n) if (1..=most).contains(&n) => Ok(n),
        Some(n) => Err(Error::out_of_range(format!("the {what} in the header"), n, format!("1 to {most}"))),
        None => Err(Error::new(ErrorKind::CutShort, format!("the header ends before the {what}"))),
    }
}

/// Reads the next number and what ends it: one white space, a comment or the end of the file; `None` at the end.
fn number(input: &mut impl BufRead) -> Result<Option<u32>, Error> {
    let Some(first) = skip_blank(input)? else {
        return Ok(None);
    };
    let mut next = Some(first);
    let mut n: u32 = 0;
    while let Some(byte) = next {
        if byte.is_ascii_whitespace() {
            break;
        }
        if byte == b'#' {
            skip_comment(input)?;
            break;
        }
        let digit = byte.is_ascii_digit().then(|| u32::from(byte - b'0'));
        let Some(more) = digit.and_then(|digit| n.checked_mul(10)?.checked_add(digit)) else {
            return Err(Error::new(ErrorKind::Format, "a number is malformed")
                .allowing("; allowed are ", "decimal digits below 2^32"));
        };
        n = more;
        next = byte_of(input)?;
    }
    Ok(Some(n))
}

/// Reads the first byte after white space and comments.
fn skip_blank(input: &mut impl BufRead) -> Result<Option<u8>, Error> {
    loop {
        match skip_space(input)? {
            Some(b'#') => skip_comment(input)?,
            other => return Ok(other),
        }
    }
}

/// Passes over a comment, which runs from `#` to the end of the line.
fn skip_comment(input: &mut impl BufRead) -> Result<(), Error> {
    while !matches!(byte_of(input)?, None | Some(b'\n' | b'\r')) {}
    Ok(())
}

/// Reads the first byte after white space.
fn skip_space(input: &mut impl BufRead) -> Result<Option<u8>, Error> {
    loop {
        match byte_of(input)? {
            Some(byte) if byte.is_ascii_whitespace() => {}
            other => return Ok(other),
        }
    }
}

/// Reads the next byte.
fn byte_of(input: &mut impl BufRead) -> Result<Option<u8>, Error> {
    let byte = input.fill_buf()?.first().copied();
    input.consume(usize::from(byte.is_some()));
    Ok(byte)
}
