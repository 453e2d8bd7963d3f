//! Decoded pixels, brought in place to what the loader's library makes of them: only what grows takes memory.

use super::layout::{Channels, Colours, levels};
use crate::error::Error;
use crate::size::{CHUNK, Size};
use image::ImageFormat;

/// Pixels as the decoder gives them: samples of 16 bits in the machine's own order.
pub(super) struct Pixels {
    pub(super) size: Size,
    pub(super) channels: Channels,
    pub(super) deep: bool,
    pub(super) bytes: Vec<u8>,
}

impl Pixels {
    /// Brings samples up to `largest`, which the decoder scaled and rounded, to the whole range as the loader's library does:
    /// SDL_image rounds down to 8 bits, GraphicsMagick has 16.
    pub(super) fn scale(&mut self, largest: u32, colours: Colours) -> Result<(), Error> {
        let white = if self.deep { 65535 } else { 255 };
        if largest == white || largest == 0 {
            return Ok(());
        }
        let [white, largest] = [white, largest].map(u64::from);
        let own = |sample: u64| (sample * largest + white / 2) / white;
        let as_deep = |sample: u64| (((own(sample) * 65535 + largest / 2) / largest) as u16).to_ne_bytes();
        if self.deep {
            replace(&mut self.bytes, |_, sample| as_deep(u16::from_ne_bytes(sample).into()))
        } else if colours == Colours::Sdl {
            replace(&mut self.bytes, |_, [sample]| [(own(sample.into()) * 255 / largest) as u8])
        } else {
            self.deep = true;
            replace(&mut self.bytes, |_, [sample]| as_deep(sample.into()))
        }
    }

    /// Brings samples of 16 bits to the order, high byte first, or to the 8 bits, that the loader's library has.
    pub(super) fn bring_down(&mut self, colours: Colours) -> Result<(), Error> {
        let high_first = |sample| u16::from_ne_bytes(sample).to_be_bytes();
        self.deep = matches!(colours, Colours::Meant | Colours::Magick);
        if colours == Colours::Sdl {
            return replace(&mut self.bytes, |_, sample| [high_first(sample)[0]]);
        }
        replace(&mut self.bytes, |_, sample| high_first(sample))?;
        if colours == Colours::MagickLevels {
            let (mut from, mut to) = (0, 0);
            let (mut own, mut channels) = (Vec::new(), self.channels);
            while from < self.bytes.len() {
                let piece = (self.bytes.len() - from).min(CHUNK / 8 * 2 * self.channels.count());
                channels = levels(self.channels, &self.bytes[from..][..piece], &mut own);
                self.bytes[to..][..own.len()].copy_from_slice(&own);
                (from, to) = (from + piece, to + own.len());
            }
            self.bytes.truncate(to);
            self.channels = channels;
        }
        Ok(())
    }

    /// Lays out samples of 8 bits as on SDL's surfaces, of which ROS 1 averages the bytes and takes the last for alpha.
    pub(super) fn lay_out_as_sdl(&mut self, format: ImageFormat) -> Result<(), Error> {
        match (format, self.channels) {
            // Blue comes first.
            (ImageFormat::Bmp | ImageFormat::Tga, Channels::Rgb) => {
                replace(&mut self.bytes, |_, [r, g, b]| [b, g, r])
            }
            // Every TIFF is one with alpha, which its colours are multiplied by.
            (ImageFormat::Tiff, Channels::Grey | Channels::Rgb) => self.add_alpha(|_| u8::MAX),
            (ImageFormat::Tiff, Channels::Rgba) => replace(&mut self.bytes, |_, [r, g, b, alpha]| {
                let times = |sample| ((u32::from(sample) * u32::from(alpha) + 127) / 255) as u8;
                [times(r), times(g), times(b), alpha]
            }),
            _ => Ok(()),
        }
    }

    /// Drops the alpha of 8 bits of an image that is opaque throughout.
    pub(super) fn drop_opaque_alpha(&mut self) -> Result<(), Error> {
        let is_opaque = || self.bytes.as_chunks::<4>().0.iter().all(|pixel| pixel[3] == 255);
        if self.channels == Channels::Rgba && !self.deep && is_opaque() {
            self.channels = Channels::Rgb;
            replace(&mut self.bytes, |_, [r, g, b, _]| [r, g, b])?;
        }
        Ok(())
    }

    /// Keeps the first of the channels, of samples of 8 bits.
    pub(super) fn keep_first_channel(&mut self) -> Result<(), Error> {
        let channels = std::mem::replace(&mut self.channels, Channels::Grey);
        match channels {
            Channels::Grey => Ok(()),
            Channels::GreyAlpha | Channels::GreyKeyed => replace(&mut self.bytes, |_, [grey, _]| [grey]),
            Channels::Rgb => replace(&mut self.bytes, |_, [red, _, _]| [red]),
            Channels::Rgba => replace(&mut self.bytes, |_, [red, _, _, _]| [red]),
        }
    }

    /// Adds an alpha for each pixel of samples of 8 bits, where there is none; pixels beyond the last alpha are dropped.
    pub(super) fn set_alpha(&mut self, alpha: &[u8]) -> Result<(), Error> {
        self.bytes.truncate(alpha.len() * self.channels.count());
        self.add_alpha(|pixel| alpha[pixel])
    }

    /// Adds to the samples of 8 bits of each pixel, by its number, an alpha.
    fn add_alpha(&mut self, alpha: impl Fn(usize) -> u8) -> Result<(), Error> {
        if self.channels == Channels::Grey {
            self.channels = Channels::GreyAlpha;
            replace(&mut self.bytes, |pixel, [grey]| [grey, alpha(pixel)])
        } else {
            self.channels = Channels::Rgba;
            replace(&mut self.bytes, |pixel, [r, g, b]| [r, g, b, alpha(pixel)])
        }
    }
}

/// Replaces each `N` bytes, by their number, with `M` others in the place of the old ones.
fn replace<const N: usize, const M: usize>(
    bytes: &mut Vec<u8>,
    new: impl Fn(usize, [u8; N]) -> [u8; M],
) -> Result<(), Error> {
    let count = bytes.len() / N;
    let put = |bytes: &mut [u8], n: usize| {
        let mut old = [0; N];
        old.copy_from_slice(&bytes[n * N..][..N]);
        bytes[n * M..][..M].copy_from_slice(&new(n, old));
    };
    if M > N {
        // From the end, so that nothing is overwritten before it was read.
        bytes.try_reserve_exact((count * (M - N)).saturating_sub(bytes.len() % N))?;
        bytes.resize(count * M, 0);
        (0..count).rev().for_each(|n| put(bytes, n));
    } else {
        (0..count).for_each(|n| put(bytes, n));
        bytes.truncate(count * M);
    }
    Ok(())
}
