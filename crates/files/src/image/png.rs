//! PNG by the `png` crate, row by row: memory grows with the pixels the file really holds.
//!
//! What the compressed data hold beyond the last row is passed over, as by libpng, which the crate follows.
//!
//! An interlaced image must be held whole before its first row is known, so only small ones are read.

use super::layout::{Channels, Colours, Layout, Rest, levels};
use crate::error::{Error, ErrorKind};
use crate::size::{Size, at_end};
use png::{BitDepth, ColorType, Decoder, DecodingError, Info, Limits, Reader, Transformations};
use std::io::{self, BufRead, Seek};

/// The most memory for one row and for the chunks beside the pixels.
const ROW_BYTES: usize = 16 << 20;
/// The most memory for an interlaced image.
const INTERLACED_BYTES: usize = 64 << 20;

/// A PNG whose header was read.
pub(crate) struct Png<R: BufRead + Seek> {
    input: R,
    transformations: Transformations,
    layout: Layout,
    /// True if pixels of 16-bit samples are brought to levels.
    levels: bool,
    /// True if colours or alpha of 16 bits are cut to their high bytes for nav2.
    cut: bool,
    /// The channels of the decoder.
    channels: Channels,
    /// True if no pixel is of the transparent colour, to the loader.
    opaque: bool,
    /// The bits of a palette index, if the indices themselves are wanted.
    index_bits: Option<u8>,
}

impl<R: BufRead + Seek> Png<R> {
    /// Reads the chunks before the pixels.
    pub(super) fn open(mut input: R, colours: Colours, max_cells: u64) -> Result<Self, Error> {
        // What is to be done with the colours depends on chunks that follow the header, and what comes of it on that:
        // they are read again for either.
        let mut decoder = decoder_of(&mut input);
        let header = decoder.read_header_info().map_err(refused)?;
        let size = Size::within(header.width.into(), header.height.into(), max_cells)?;
        let reader = decoder.read_info().map_err(refused)?;
        let info = reader.info();
        if info.is_animated() {
            return Err(Error::new(ErrorKind::Unsupported, "is an animated PNG")
                .allowing("; allowed is ", "a still image"));
        }
        if info.color_type == ColorType::Indexed {
            // The decoder relies on a palette of whole entries.
            let bytes = info.palette.as_ref().map_or(0, |palette| palette.len());
            if bytes % 3 != 0 || !(1..=256).contains(&(bytes / 3)) {
                let message = format!("is a malformed PNG: its palette has {bytes} bytes");
                return Err(Error::new(ErrorKind::Format, message)
                    .with_value(bytes.to_string())
                    .allowing(", allowed are ", "3 for each of 1 to 256 colours"));
            }
        }
        let transformations = match colours {
            // The reference counts of a public map, of grey and alpha, are of samples that were cut so.
            Colours::MagickLevels if info.color_type != ColorType::Grayscale => {
                Transformations::EXPAND | Transformations::STRIP_16
            }
            Colours::Meant | Colours::Magick | Colours::MagickLevels => Transformations::EXPAND,
            Colours::Sdl => as_sdl(info),
        };
        let index_bits = (info.color_type == ColorType::Indexed
            && transformations == Transformations::IDENTITY)
            .then_some(info.bit_depth as u8);
        let keyed = info.color_type == ColorType::Grayscale;
        let depth = info.bit_depth as u8;
        let few_greys = (keyed && depth < 8).then(|| (1 << depth) - 1);
        let deep = info.bit_depth == BitDepth::Sixteen;
        let deep_to_nav2 = deep && colours == Colours::MagickLevels;
        let cut = deep_to_nav2 && transformations.contains(Transformations::STRIP_16);
        let levels = deep_to_nav2 && !cut;
        let opaque = matches!(colours, Colours::Magick | Colours::MagickLevels) && has_vain_key(info);
        drop(reader);

        let (color, depth) = reader_of(&mut input, transformations)?.output_color_type();
        let channels = match color {
            ColorType::Grayscale | ColorType::Indexed => Channels::Grey,
            ColorType::GrayscaleAlpha if keyed => Channels::GreyKeyed,
            ColorType::GrayscaleAlpha => Channels::GreyAlpha,
            ColorType::Rgb => Channels::Rgb,
            ColorType::Rgba => Channels::Rgba,
        };
        let max = if depth as u8 == 16 { 65535 } else { 255 };
        let white = few_greys.unwrap_or(if deep { u16::MAX } else { max });
        let layout = if levels {
            Layout { size, channels: self::levels(channels, &[], &mut Vec::new()), max: 255, white }
        } else {
            Layout { size, channels, max, white }
        };
        Ok(Self { input, transformations, layout, levels, cut, channels, opaque, index_bits })
    }

    /// Returns what the pieces hold.
    pub(super) fn layout(&self) -> Layout {
        self.layout
    }

    /// Tells whether the grey levels are the indices of a palette.
    pub(super) fn is_indices(&self) -> bool {
        self.index_bits.is_some()
    }

    /// Tells whether colours or alpha of 16 bits are cut to their high bytes for nav2.
    pub(super) fn is_cut(&self) -> bool {
        self.cut
    }

    /// Gives all pixels in reading order, a row at a time; returns what follows the image.
    pub(super) fn pixels(mut self, mut each: impl FnMut(&[u8]) -> Result<(), Error>) -> Result<Rest, Error> {
        let Size { width, height } = self.layout.size;
        let mut own = Vec::new();
        let mut row_of = |row: &[u8]| {
            match self.index_bits {
                Some(bits) => unpack(row, bits, width, &mut own),
                None if self.levels => _ = levels(self.channels, row, &mut own),
                None if self.opaque => {
                    own.clear();
                    own.extend(
                        row.as_chunks().0.iter().flat_map(|&[r, g, b, _]: &[u8; 4]| [r, g, b, u8::MAX]),
                    );
                }
                None => return each(row),
            }
            each(&own)
        };
        let mut reader = reader_of(&mut self.input, self.transformations)?;
        if reader.info().interlaced {
            let bytes = reader.output_buffer_size().filter(|&bytes| bytes <= INTERLACED_BYTES);
            let Some(bytes) = bytes else {
                let message = format!("is an interlaced PNG of {width} x {height} pixels");
                let allowed = format!("up to {} MiB", INTERLACED_BYTES >> 20);
                return Err(Error::new(ErrorKind::Unsupported, message)
                    .allowing("; these are read ", allowed)
                    .followed_by(": save it without interlacing"));
            };
            let mut image = vec![0; bytes];
            reader.next_frame(&mut image).map_err(refused)?;
            image.chunks_exact(bytes / height).try_for_each(&mut row_of)?;
        } else {
            while let Some(row) = reader.next_row().map_err(refused)? {
                row_of(row.data())?;
            }
        }
        reader.finish().map_err(refused)?;
        drop(reader);
        Ok(if at_end(self.input)? { Rest::Nothing } else { Rest::More })
    }
}

/// Reads an image from the beginning, up to the pixels.
fn reader_of<R: BufRead + Seek>(mut input: R, transformations: Transformations) -> Result<Reader<R>, Error> {
    input.rewind()?;
    let mut decoder = decoder_of(input);
    decoder.set_transformations(transformations);
    decoder.read_info().map_err(refused)
}

/// Creates a decoder with the limits, which passes over text and colour profiles.
fn decoder_of<R: BufRead + Seek>(input: R) -> Decoder<R> {
    let mut decoder = Decoder::new_with_limits(input, Limits { bytes: ROW_BYTES });
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    decoder
}

/// Tells whether GraphicsMagick finds no pixel of the transparent colour of an RGB image, which it has with alpha all the same:
/// it compares samples that it brought to 16 bits with those of the chunk, which it did not.
fn has_vain_key(info: &Info<'_>) -> bool {
    let key = info.trns.as_deref().unwrap_or_default();
    info.color_type == ColorType::Rgb
        && info.bit_depth == BitDepth::Eight
        && key.iter().any(|&byte| byte != 0)
}

/// Returns what SDL_image asks of libpng. It expands greys, strips 16 bits to their high byte, and looks a palette up only if
/// it has other alpha than one fully transparent entry; one transparent colour of an RGB image becomes no alpha.
fn as_sdl(info: &Info<'_>) -> Transformations {
    match info.color_type {
        ColorType::Grayscale => Transformations::EXPAND | Transformations::STRIP_16,
        ColorType::Indexed => {
            let alpha = info.trns.as_deref().unwrap_or_default();
            let second_hole = alpha.iter().filter(|&&a| a == 0).nth(1);
            let plain = second_hole.is_none() && alpha.iter().all(|&a| a == 0 || a == 255);
            if plain { Transformations::IDENTITY } else { Transformations::EXPAND }
        }
        _ => Transformations::STRIP_16,
    }
}

/// Writes the `width` indices of `bits` bits each, the leftmost in the high bits of a byte.
fn unpack(row: &[u8], bits: u8, width: usize, indices: &mut Vec<u8>) {
    indices.clear();
    let per_byte = usize::from(8 / bits);
    let mask = u8::MAX >> (8 - bits);
    indices.extend((0..width).map(|x| {
        let shift = 8 - bits * (x % per_byte + 1) as u8;
        row[x / per_byte] >> shift & mask
    }));
}

/// Names what the decoder refuses.
fn refused(error: DecodingError) -> Error {
    match error {
        DecodingError::IoError(error) if error.kind() == io::ErrorKind::UnexpectedEof => Error::from(error),
        DecodingError::LimitsExceeded => {
            Error::new(ErrorKind::Unsupported, "a row or chunk of the PNG takes more than")
                .allowing(" ", format!("the {} MiB allowed", ROW_BYTES >> 20))
        }
        error => Error::new(ErrorKind::Format, format!("is a malformed PNG: {error}")).caused_by(error),
    }
}
