//! How the pixels of an image are laid out.

use crate::error::{Error, ErrorKind};
use crate::size::Size;

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
    /// Returns the number of samples of a pixel.
    pub(crate) fn count(self) -> usize {
        match self {
            Self::Grey => 1,
            Self::GreyAlpha | Self::GreyKeyed => 2,
            Self::Rgb => 3,
            Self::Rgba => 4,
        }
    }

    /// Tells whether the first sample is a grey.
    pub(crate) fn is_grey(self) -> bool {
        matches!(self, Self::Grey | Self::GreyAlpha | Self::GreyKeyed)
    }

    /// Tells whether the last sample is alpha.
    pub(crate) fn alpha(self) -> bool {
        matches!(self, Self::GreyAlpha | Self::GreyKeyed | Self::Rgba)
    }
}

/// The layout of the pixels in the pieces of an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Layout {
    /// Columns and rows.
    pub(crate) size: Size,
    /// The samples of a pixel.
    pub(crate) channels: Channels,
    /// The sample that means white, or opaque. Samples above 255 take two bytes, the high one first.
    pub(crate) max: u16,
    /// The white of the file itself: `max` is a multiple of it, or less where samples of 16 bits are brought to 8.
    pub(crate) white: u16,
}

impl Layout {
    /// Returns the bytes of a sample.
    pub(crate) fn sample_bytes(&self) -> usize {
        if self.max > 255 { 2 } else { 1 }
    }

    /// Returns the weights of samples that sum colours, and pass over alpha.
    pub(crate) fn colour_sum(&self) -> [u32; 4] {
        match self.channels {
            Channels::Rgb | Channels::Rgba => [1, 1, 1, 0],
            Channels::Grey | Channels::GreyAlpha | Channels::GreyKeyed => [1, 0, 0, 0],
        }
    }

    /// Checks that there are as many pixels as the header claims.
    ///
    /// # Errors
    /// An [`Error`] with both numbers.
    pub(crate) fn require(&self, pixels: u64) -> Result<(), Error> {
        match self.size.cells() {
            claimed if pixels == claimed as u64 => Ok(()),
            claimed => Err(Error::new(ErrorKind::CutShort, format!("holds {pixels} pixels"))
                .with_value(pixels.to_string())
                .allowing(", its header claims ", claimed.to_string())),
        }
    }

    /// Returns the bytes of a pixel.
    pub(crate) fn pixel_bytes(&self) -> usize {
        self.sample_bytes() * self.channels.count()
    }
}

/// The weights by which GraphicsMagick sums a colour's red, green and blue into its grey, in thousandths.
pub(crate) const GREY_WEIGHTS: [u32; 4] = [299, 587, 114, 0];

/// Returns the level of 255 that GraphicsMagick gives for a weighted sum of samples of 16 bits: the grey rounded to 16 bits,
/// and that rounded down to 8.
pub(crate) fn level(sum: u32) -> u8 {
    ((sum + 500) / 1000 / 257) as u8
}

/// Turns pixels of samples of 16 bits, the high byte first, into levels of 255, each with an alpha of 0 or 255 where there is
/// alpha; returns their channels.
pub(super) fn levels(channels: Channels, pixels: &[u8], levels: &mut Vec<u8>) -> Channels {
    levels.clear();
    for pixel in pixels.chunks_exact(2 * channels.count()) {
        let samples: &[[u8; 2]] = pixel.as_chunks().0;
        let weights = if channels.is_grey() { [1000, 0, 0, 0] } else { GREY_WEIGHTS };
        let weighed = samples
            .iter()
            .zip(weights)
            .map(|(&sample, weight)| weight * u32::from(u16::from_be_bytes(sample)));
        levels.push(level(weighed.sum()));
        if channels.alpha() {
            levels.push(if samples.last() == Some(&[u8::MAX; 2]) { u8::MAX } else { 0 });
        }
    }
    if channels.alpha() { Channels::GreyAlpha } else { Channels::Grey }
}

/// The treatment of an image's colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Colours {
    /// As they are meant: palettes are looked up, transparent colours become alpha.
    Meant,
    /// As GraphicsMagick reads them.
    Magick,
    /// As GraphicsMagick gives them to nav2: pixels of 16-bit samples as the [level] of their grey.
    MagickLevels,
    /// As SDL_image gives them to ROS 1: 8 bits per sample; palettes without real alpha stay indices.
    Sdl,
}

/// The most pixels of an image, by how it is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct MaxPixels {
    /// The most of a PGM, which is at least as long as it has pixels.
    pub(crate) pgm: u64,
    /// The most of a PNG, which is compressed.
    pub(crate) png: u64,
    /// The most of an image that is decoded whole.
    pub(crate) decoded: u64,
}

/// The end of a file, after its image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rest {
    /// Nothing, or white space where the format allows it.
    Nothing,
    /// Something that is no part of the image.
    More,
    /// One byte, because the header ends in two.
    LineEnd,
}
