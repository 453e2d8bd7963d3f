//! Images that the crate `image` decodes whole: BMP, PPM, PBM, JPEG, TIFF, GIF, WebP, TGA.
//!
//! Their pixels are in memory at once, so that the limit on cells that are kept holds; and a file that claims thousands of
//! times what it holds is refused before memory is taken. Of a file with several images the first is read, as by the
//! loaders.

use super::ending;
use super::layout::{Channels, Colours, Layout, Rest};
use super::palette::Palette;
use crate::error::{Error, ErrorKind};
use crate::size::{CHUNK, Size};
use image::codecs::pnm::PnmDecoder;
use image::error::ImageError;
use image::{ColorType, ImageDecoder, ImageFormat, ImageReader, Limits};
use std::io::{self, BufRead, BufReader, Seek, SeekFrom};

/// The bytes of pixels that any file may claim.
const ANY_CLAIM: u64 = 64 << 20;
/// The most bytes of pixels for a byte of the file beyond that: no format here compresses a uniform image more.
const MOST_COMPRESSED: u64 = 4096;

/// An image that was decoded.
pub(crate) struct Decoded {
    bytes: Vec<u8>,
    layout: Layout,
    pub(super) format: ImageFormat,
    /// True if the grey levels are the indices of a palette.
    pub(super) indices: bool,
    /// True if samples of 16 bits were cut to their high byte.
    pub(super) cut: bool,
    rest: Rest,
}

impl Decoded {
    /// Decodes an image.
    pub(super) fn open<R: BufRead + Seek>(
        mut input: R,
        format: ImageFormat,
        colours: Colours,
        max_cells: u64,
    ) -> Result<Self, Error> {
        let length = input.seek(SeekFrom::End(0))?;
        input.rewind()?;
        let limit = Limit { cells: max_cells, length };
        // SDL hands the indices of a palette themselves on, and ROS 1 takes them for greys.
        let palette = if colours == Colours::Sdl { Palette::find(&mut input, format)? } else { None };
        let indices = palette.as_ref().is_some_and(|palette| !palette.is_grey_scale());
        input.rewind()?;
        let mut pixels = match (format, palette) {
            (_, Some(palette)) => {
                let numbered = BufReader::new(palette.numbered(&mut input));
                let reader = ImageReader::with_format(numbered, format);
                let mut pixels = decode(reader.into_decoder().map_err(refused)?, limit)?;
                pixels.keep_first_channel();
                pixels
            }
            (ImageFormat::Pnm, None) => {
                let decoder = PnmDecoder::new(&mut input).map_err(refused)?;
                // A bitmap's are expanded, others' are as the file has them.
                let largest = decoder.header().as_bitmap().map_or(decoder.header().maximal_sample(), |_| 255);
                let mut pixels = decode(decoder, limit)?;
                pixels.scale(largest);
                pixels
            }
            _ => {
                let reader = ImageReader::with_format(&mut input, format);
                decode(reader.into_decoder().map_err(refused)?, limit)?
            }
        };
        // The decoder gives every GIF an alpha.
        if format == ImageFormat::Gif {
            pixels.drop_opaque_alpha();
        }
        // SDL_image makes every TIFF one with alpha, which ROS 1 averages.
        if format == ImageFormat::Tiff && colours == Colours::Sdl {
            pixels.make_alpha();
        }
        let goes_on = match format {
            ImageFormat::Pnm => goes_on(&mut input, u8::is_ascii_whitespace)?,
            _ => match ending::end(&mut input, format)? {
                Some(end) => {
                    input.seek(SeekFrom::Start(end))?;
                    // Some writers fill files up.
                    goes_on(&mut input, |&byte| byte == 0)?
                }
                None => false,
            },
        };
        let rest = if goes_on { Rest::More } else { Rest::Nothing };
        let Pixels { size, channels, deep, bytes } = pixels;
        let cut = deep && colours != Colours::Meant;
        let bytes = match (deep, cut) {
            (false, _) => bytes,
            (true, true) => bytes.as_chunks().0.iter().map(|&s| (u16::from_ne_bytes(s) >> 8) as u8).collect(),
            (true, false) => {
                let samples = bytes.as_chunks().0.iter();
                samples.flat_map(|&sample| u16::from_ne_bytes(sample).to_be_bytes()).collect()
            }
        };
        let max = if deep && !cut { 65535 } else { 255 };
        let layout = Layout { size, channels, max, white: max };
        Ok(Self { bytes, layout, format, indices, cut, rest })
    }

    /// Returns the layout of the pieces.
    pub(super) fn layout(&self) -> Layout {
        self.layout
    }

    /// Gives all pixels in reading order, a piece at a time; returns what follows the image.
    pub(super) fn pixels(self, mut each: impl FnMut(&[u8]) -> Result<(), Error>) -> Result<Rest, Error> {
        let piece = CHUNK / self.layout.pixel_bytes() * self.layout.pixel_bytes();
        self.bytes.chunks(piece).try_for_each(&mut each)?;
        Ok(self.rest)
    }
}

/// The most that a file may claim.
#[derive(Clone, Copy)]
struct Limit {
    cells: u64,
    length: u64,
}

/// Pixels as the decoder gives them: samples of 16 bits in the machine's own order.
struct Pixels {
    size: Size,
    channels: Channels,
    deep: bool,
    bytes: Vec<u8>,
}

impl Pixels {
    /// Brings samples up to `largest` to the whole range, rounded down as by SDL_image.
    fn scale(&mut self, largest: u32) {
        let largest = largest.max(1);
        if self.deep && largest != 65535 {
            for sample in self.bytes.as_chunks_mut().0 {
                let value = u32::from(u16::from_ne_bytes(*sample)).min(largest);
                *sample = ((u64::from(value) * 65535 / u64::from(largest)) as u16).to_ne_bytes();
            }
        } else if !self.deep && largest != 255 {
            for sample in &mut self.bytes {
                *sample = (u32::from(*sample).min(largest) * 255 / largest) as u8;
            }
        }
    }

    /// Drops the alpha of 8 bits of an image that is opaque throughout.
    fn drop_opaque_alpha(&mut self) {
        let pixels = self.bytes.as_chunks::<4>().0;
        if self.channels == Channels::Rgba && !self.deep && pixels.iter().all(|pixel| pixel[3] == 255) {
            self.bytes = pixels.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
            self.channels = Channels::Rgb;
        }
    }

    /// Keeps the first of the channels, of samples of 8 bits.
    fn keep_first_channel(&mut self) {
        self.bytes = self.bytes.iter().copied().step_by(self.channels.count()).collect();
        self.channels = Channels::Grey;
    }

    /// Adds an opaque alpha where there is none.
    fn make_alpha(&mut self) {
        let channels = match self.channels {
            Channels::Grey => Channels::GreyAlpha,
            Channels::Rgb => Channels::Rgba,
            _ => return,
        };
        let bytes = self.channels.count() * if self.deep { 2 } else { 1 };
        let opaque = vec![0xff; if self.deep { 2 } else { 1 }];
        self.bytes = self.bytes.chunks_exact(bytes).flat_map(|pixel| [pixel, &opaque].concat()).collect();
        self.channels = channels;
    }
}

/// Decodes the first image of a file.
fn decode(mut decoder: impl ImageDecoder, limit: Limit) -> Result<Pixels, Error> {
    let (width, height) = decoder.dimensions();
    let size = Size::within(width.into(), height.into(), limit.cells)?;
    let (channels, deep) = match decoder.color_type() {
        ColorType::L8 => (Channels::Grey, false),
        ColorType::La8 => (Channels::GreyAlpha, false),
        ColorType::Rgb8 => (Channels::Rgb, false),
        ColorType::Rgba8 => (Channels::Rgba, false),
        ColorType::L16 => (Channels::Grey, true),
        ColorType::La16 => (Channels::GreyAlpha, true),
        ColorType::Rgb16 => (Channels::Rgb, true),
        ColorType::Rgba16 => (Channels::Rgba, true),
        other => {
            return Err(Error::new(ErrorKind::Unsupported, format!("is an image of {other:?} samples"))
                .allowing("; allowed are ", "samples of 8 and 16 bits"));
        }
    };
    let total = decoder.total_bytes();
    if total > ANY_CLAIM && total / MOST_COMPRESSED > limit.length {
        let message = format!("has {} bytes, which cannot hold", limit.length);
        return Err(Error::new(ErrorKind::CutShort, message)
            .with_value(limit.length.to_string())
            .allowing(" ", format!("the {width} x {height} pixels it claims")));
    }
    let mut limits = Limits::no_limits();
    // Decoders keep the image once more, or planes of it.
    limits.max_alloc = Some(total.saturating_mul(4).max(ANY_CLAIM));
    decoder.set_limits(limits).map_err(refused)?;
    let mut bytes = Vec::new();
    let total = usize::try_from(total).unwrap_or(usize::MAX);
    bytes.try_reserve_exact(total)?;
    bytes.resize(total, 0);
    decoder.read_image(&mut bytes).map_err(refused)?;
    if bytes.is_empty() {
        return Err(Error::new(ErrorKind::Format, "is an image without pixels"));
    }
    Ok(Pixels { size, channels, deep, bytes })
}

/// Tells whether more follows than bytes that mean nothing.
fn goes_on(input: &mut impl BufRead, is_blank: impl Fn(&u8) -> bool) -> io::Result<bool> {
    loop {
        let bytes = input.fill_buf()?;
        let (length, blank) = (bytes.len(), bytes.iter().all(&is_blank));
        if length == 0 || !blank {
            return Ok(length > 0);
        }
        input.consume(length);
    }
}

/// Names what the decoder refuses.
fn refused(error: ImageError) -> Error {
    match error {
        ImageError::IoError(error) => Error::from(error),
        ImageError::Limits(error) => {
            Error::new(ErrorKind::Unsupported, format!("takes too much memory to decode: {error}"))
                .caused_by(error)
        }
        ImageError::Unsupported(error) => {
            Error::new(ErrorKind::Unsupported, format!("is an image of a kind that is not read: {error}"))
                .followed_by("; save it as PNG")
                .caused_by(error)
        }
        error => Error::new(ErrorKind::Format, format!("is a malformed image: {error}")).caused_by(error),
    }
}
