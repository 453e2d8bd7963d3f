//! PGM, plain (P2) and raw (P5), 8 and 16 bits.
//!
//! Own code: the grammar is these few lines, and comments, maximum values, trailing data and memory are what map files
//! get wrong, so they must be ours to check.

use super::layout::{Channels, Layout, Rest};
use crate::error::{Error, ErrorKind, Place};
use crate::size::{Size, at_end, read_pieces};
use std::io::{self, BufRead, Seek, SeekFrom};

/// Samples of a plain image that are handed on together.
const PLAIN_PIECE: usize = 4096;

/// A PGM whose header was read.
pub(crate) struct Pgm<R> {
    input: R,
    plain: bool,
    /// True if the header of a raw image ends in CR LF, so that LF is its first pixel.
    line_end: bool,
    layout: Layout,
}

impl<R: BufRead> Pgm<R> {
    /// Reads the header.
    pub(super) fn open(mut input: R, max_cells: u64) -> Result<Self, Error>
    where
        R: Seek,
    {
        let mut magic = [0; 2];
        input.read_exact(&mut magic)?;
        let width = header_number(&mut input, "width", u32::MAX)?;
        let height = header_number(&mut input, "height", u32::MAX)?;
        let size = match Size::within(width.into(), height.into(), max_cells) {
            // A limit is no matter of a file that was cut short.
            Err(error)
                if error.kind() == ErrorKind::TooLarge
                    && bytes_left(&mut input)? < u64::from(width) * u64::from(height) =>
            {
                return Err(io::Error::from(io::ErrorKind::UnexpectedEof).into());
            }
            size => size?,
        };
        let (max, end) = header_number_and_end(&mut input, "maximum value", 65535)?;
        let max = max as u16;
        let plain = magic == *b"P2";
        let line_end = !plain && end == Some(b'\r') && input.fill_buf()?.first() == Some(&b'\n');
        let layout = Layout { size, channels: Channels::Grey, max, white: max };
        Ok(Self { input, plain, line_end, layout })
    }

    /// Returns the layout of the pieces.
    pub(super) fn layout(&self) -> Layout {
        self.layout
    }

    /// Gives all pixels in reading order, a piece at a time; returns what follows them.
    pub(super) fn pixels(mut self, mut each: impl FnMut(&[u8]) -> Result<(), Error>) -> Result<Rest, Error> {
        if self.plain {
            self.plain_pixels(&mut each)?;
        } else {
            self.raw_pixels(&mut each)?;
        }
        self.rest()
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

    /// Tells what follows the pixels. White space is nothing; in a plain image comments are, too.
    fn rest(mut self) -> Result<Rest, Error> {
        if self.line_end && !at_end(&mut self.input)? {
            return Ok(Rest::LineEnd);
        }
        let rest = if self.plain { skip_blank(&mut self.input)? } else { skip_space(&mut self.input)? };
        Ok(if rest.is_none() { Rest::Nothing } else { Rest::More })
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

/// Returns the number of bytes that are left.
fn bytes_left(input: &mut (impl BufRead + Seek)) -> io::Result<u64> {
    let at = input.stream_position()?;
    let end = input.seek(SeekFrom::End(0))?;
    input.seek(SeekFrom::Start(at))?;
    Ok(end.saturating_sub(at))
}

/// Reads a number of the header from 1 to `most`, and the one white space after it.
fn header_number(input: &mut impl BufRead, what: &str, most: u32) -> Result<u32, Error> {
    header_number_and_end(input, what, most).map(|(n, _)| n)
}

/// Reads a number of the header, and returns the byte after it, too.
fn header_number_and_end(
    input: &mut impl BufRead,
    what: &str,
    most: u32,
) -> Result<(u32, Option<u8>), Error> {
    match number_and_end(input)? {
        Some((n, end)) if (1..=most).contains(&n) => Ok((n, end)),
        Some((n, _)) => {
            Err(Error::out_of_range(format!("the {what} in the header"), n, format!("1 to {most}")))
        }
        None => Err(Error::new(ErrorKind::CutShort, format!("the header ends before the {what}"))),
    }
}

/// Reads the next number and what ends it; `None` at the end.
fn number(input: &mut impl BufRead) -> Result<Option<u32>, Error> {
    Ok(number_and_end(input)?.map(|(n, _)| n))
}

/// Reads the next number and what ends it: one white space, a comment or the end of the file.
fn number_and_end(input: &mut impl BufRead) -> Result<Option<(u32, Option<u8>)>, Error> {
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
    Ok(Some((n, next)))
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
