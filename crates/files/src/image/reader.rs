//! An image of either format, told by its first bytes.

use super::layout::{Colours, Layout, MaxPixels};
use super::pgm::Pgm;
use super::png::Png;
use crate::error::{Error, ErrorKind, Place};
use std::io::{BufRead, Seek};

/// An image whose header was read.
pub(crate) enum Image<R: BufRead + Seek> {
    /// PGM.
    Pgm(Pgm<R>),
    /// PNG.
    Png(Box<Png<R>>),
}

impl<R: BufRead + Seek> Image<R> {
    /// Reads the header.
    ///
    /// # Errors
    /// An [`Error`] if this is no PGM or PNG, its header is malformed, or it has more than `most` pixels.
    pub(crate) fn open(mut input: R, colours: Colours, most: MaxPixels) -> Result<Self, Error> {
        match input.fill_buf()? {
            [] => Err(Error::new(ErrorKind::CutShort, "the file is empty")
                .allowing("; allowed are ", "PGM (P2, P5) and PNG images")),
            [b'P', b'2' | b'5', ..] => Pgm::open(input, most.pgm).map(Self::Pgm),
            [0x89, b'P', b'N', b'G', ..] => {
                Png::open(input, colours, most.png).map(|png| Self::Png(Box::new(png)))
            }
            first => {
                let first = first[..first.len().min(4)].escape_ascii().to_string();
                Err(Error::new(ErrorKind::Unsupported, "is no image this program reads")
                    .at(Place::Byte(0))
                    .with_value(first)
                    .allowing("; allowed are ", "PGM (P2, P5) and PNG"))
            }
        }
    }

    /// Returns the layout of the pieces.
    pub(crate) fn layout(&self) -> Layout {
        match self {
            Self::Pgm(pgm) => pgm.layout(),
            Self::Png(png) => png.layout(),
        }
    }

    /// Gives all pixels in reading order, some whole pixels at a time, and checks that the file ends with the image.
    ///
    /// # Errors
    /// An [`Error`] if the image is cut short or malformed or something follows it, or what `each` returns.
    pub(crate) fn pixels(self, each: impl FnMut(&[u8]) -> Result<(), Error>) -> Result<(), Error> {
        match self {
            Self::Pgm(pgm) => pgm.pixels(each),
            Self::Png(png) => png.pixels(each),
        }
    }
}
