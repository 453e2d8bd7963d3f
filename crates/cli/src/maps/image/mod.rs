//! Map images: PGM and PNG, told apart by their first bytes, read from the top a piece at a time.

mod pgm;
mod png;

use super::{Fault, size::Size};
use std::io::{BufRead, Seek};

/// The samples of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Channels {
    /// Grey.
    Grey,
    /// Grey and alpha.
    GreyAlpha,
    /// Grey, and an alpha that one transparent grey level was turned into.
    GreyKeyed,
    /// Red, green, blue.
    Rgb,
    /// Red, green, blue, alpha.
    Rgba,
}

impl Channels {
    /// Samples per pixel.
    pub(crate) fn count(self) -> usize {
        match self {
            Self::Grey => 1,
            Self::GreyAlpha | Self::GreyKeyed => 2,
            Self::Rgb => 3,
            Self::Rgba => 4,
        }
    }

    /// Whether the last sample is alpha.
    pub(crate) fn alpha(self) -> bool {
        matches!(self, Self::GreyAlpha | Self::GreyKeyed | Self::Rgba)
    }
}

/// What the pieces of an image hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Layout {
    /// Columns and rows.
    pub(crate) size: Size,
    /// The samples of a pixel.
    pub(crate) channels: Channels,
    /// The sample that means white, or opaque. Samples above 255 take two bytes, the high one first.
    pub(crate) max: u16,
    /// The white of the file itself, of which `max` is a multiple.
    pub(crate) white: u16,
}

impl Layout {
    /// Bytes per sample.
    pub(crate) fn sample_bytes(&self) -> usize {
        if self.max > 255 { 2 } else { 1 }
    }

    /// The weights of samples that sum colours, and pass over alpha.
    pub(crate) fn colour_sum(&self) -> [u32; 4] {
        match self.channels {
            Channels::Rgb | Channels::Rgba => [1, 1, 1, 0],
            Channels::Grey | Channels::GreyAlpha | Channels::GreyKeyed => [1, 0, 0, 0],
        }
    }

    /// That there are as many pixels as the header claims.
    ///
    /// # Errors
    /// A [`Fault`] with both numbers.
    pub(crate) fn require(&self, pixels: u64) -> Result<(), Fault> {
        match self.size.cells() {
            claimed if pixels == claimed as u64 => Ok(()),
            claimed => Err(Fault::new(format!("holds {pixels} pixels, its header claims {claimed}"))),
        }
    }

    /// Bytes per pixel.
    pub(crate) fn pixel_bytes(&self) -> usize {
        self.sample_bytes() * self.channels.count()
    }
}

/// What becomes of a PNG's colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Colours {
    /// As they are meant: palettes are looked up, transparent colours become alpha.
    Meant,
    /// As they are meant, 16-bit samples cut to their high byte.
    MeantIn8Bits,
    /// As SDL_image gives them to ROS 1: 8 bits per sample; palettes without real alpha stay indices.
    Sdl,
}

/// The most pixels of an image, by how it is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct MaxPixels {
    /// Of a PGM, which is at least as long as it has pixels.
    pub(crate) pgm: u64,
    /// Of a PNG, which is compressed.
    pub(crate) png: u64,
}

/// An image whose header was read.
pub(crate) enum Image<R: BufRead + Seek> {
    /// PGM.
    Pgm(pgm::Pgm<R>),
    /// PNG.
    Png(Box<png::Png<R>>),
}

impl<R: BufRead + Seek> Image<R> {
    /// Reads the header.
    ///
    /// # Errors
    /// A [`Fault`] if this is no PGM or PNG, its header is malformed, or it has more than `most` pixels.
    pub(crate) fn open(mut input: R, colours: Colours, most: MaxPixels) -> Result<Self, Fault> {
        match input.fill_buf()? {
            [] => Err(Fault::new("the file is empty; allowed are PGM (P2, P5) and PNG images")),
            [b'P', b'2' | b'5', ..] => pgm::Pgm::open(input, most.pgm).map(Self::Pgm),
            [0x89, b'P', b'N', b'G', ..] => {
                png::Png::open(input, colours, most.png).map(|png| Self::Png(Box::new(png)))
            }
            _ => Err(Fault::new("is no image this program reads; allowed are PGM (P2, P5) and PNG")),
        }
    }

    /// What the pieces hold.
    pub(crate) fn layout(&self) -> Layout {
        match self {
            Self::Pgm(pgm) => pgm.layout(),
            Self::Png(png) => png.layout(),
        }
    }

    /// Gives all pixels in reading order, some whole pixels at a time, and checks that the file ends with the image.
    ///
    /// # Errors
    /// A [`Fault`] if the image is cut short or malformed or something follows it, or what `each` returns.
    pub(crate) fn pixels(self, each: impl FnMut(&[u8]) -> Result<(), Fault>) -> Result<(), Fault> {
        match self {
            Self::Pgm(pgm) => pgm.pixels(each),
            Self::Png(png) => png.pixels(each),
        }
    }
}
