//! An image of any format that is read.

use super::decoded::{Decoded, Quirk};
use super::format::Reader;
use super::layout::{Colours, Layout, MaxPixels, Rest};
use super::pgm::Pgm;
use super::png::Png;
use crate::error::Error;
use image::ImageFormat;
use std::io::{BufRead, Seek};

/// An image whose header was read.
pub(crate) enum Image<R: BufRead + Seek> {
    /// PGM.
    Pgm(Pgm<R>),
    /// PNG.
    Png(Box<Png<R>>),
    /// Another, decoded.
    Decoded(Decoded),
}

impl<R: BufRead + Seek> Image<R> {
    /// Reads the header of the image in the file `name`.
    ///
    /// # Errors
    /// An [`Error`] if this is no image that is read, its header is malformed, or it has more than `most` pixels.
    pub(crate) fn open(mut input: R, name: &str, colours: Colours, most: MaxPixels) -> Result<Self, Error> {
        match Reader::of(input.fill_buf()?, name)? {
            Reader::Pgm => Pgm::open(input, most.pgm).map(Self::Pgm),
            Reader::Png => Png::open(input, colours, most.png).map(|png| Self::Png(Box::new(png))),
            Reader::Decoded(format) => {
                Decoded::open(&mut input, format, colours, most.decoded).map(Self::Decoded)
            }
        }
    }

    /// Returns the layout of the pieces.
    pub(crate) fn layout(&self) -> Layout {
        match self {
            Self::Pgm(pgm) => pgm.layout(),
            Self::Png(png) => png.layout(),
            Self::Decoded(image) => image.layout(),
        }
    }

    /// Tells whether the grey levels are the indices of a palette.
    pub(crate) fn is_indices(&self) -> bool {
        match self {
            Self::Pgm(_) => false,
            Self::Png(png) => png.is_indices(),
            Self::Decoded(image) => image.indices,
        }
    }

    /// Returns what a loader takes in another way, or refuses, of an image that was decoded.
    pub(crate) fn quirk(&self) -> Option<Quirk> {
        match self {
            Self::Pgm(_) => None,
            Self::Png(png) => png.is_cut().then_some(Quirk::DeepColours),
            Self::Decoded(image) => image.quirk,
        }
    }

    /// Tells whether this is a JPEG.
    pub(crate) fn is_jpeg(&self) -> bool {
        matches!(self, Self::Decoded(image) if image.format == ImageFormat::Jpeg)
    }

    /// Gives all pixels in reading order, some whole pixels at a time, and returns what follows the image.
    ///
    /// # Errors
    /// An [`Error`] if the image is cut short or malformed, or what `each` returns.
    pub(crate) fn pixels(self, each: impl FnMut(&[u8]) -> Result<(), Error>) -> Result<Rest, Error> {
        match self {
            Self::Pgm(pgm) => pgm.pixels(each),
            Self::Png(png) => png.pixels(each),
            Self::Decoded(image) => image.pixels(each),
        }
    }
}
