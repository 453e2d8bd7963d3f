//! Images that the crate `image` decodes whole: BMP, PPM, PBM, JPEG, TIFF, GIF, WebP, TGA.
//!
//! Their pixels are in memory at once, so that the limit on cells that are kept holds, and one on their bytes; and a file that
//! claims thousands of times what it holds is refused before memory is taken. Of a file with several images the first is
//! read, as by the loaders.

use super::bmp::Bmp;
use super::bytes::read_at;
use super::ending;
use super::layout::{Channels, Colours, Layout, Rest};
use super::palette::Palette;
use super::pixels::Pixels;
use crate::error::{Error, ErrorKind};
use crate::size::{CHUNK, Size};
use image::codecs::pnm::PnmDecoder;
use image::error::ImageError;
use image::{ColorType, ImageDecoder, ImageFormat, ImageReader, Limits};
use std::io::{self, BufRead, BufReader, Seek, SeekFrom};

/// A file that is read from any place.
pub(super) trait Input: BufRead + Seek {}

impl<R: BufRead + Seek> Input for R {}

/// The bytes of pixels that any file may claim.
const ANY_CLAIM: u64 = 64 << 20;
/// The most bytes of pixels for a byte of the file beyond that. Lossless WebP, GIF, and TIFF of one bit in deflate compress a
/// uniform image more: what is refused may be valid, and a claim is all that tells it from one that is not.
const MOST_COMPRESSED: u64 = 4096;
/// The most bytes of decoded pixels for each cell of the limit: colours with alpha, of 8 bits.
const BYTES_PER_CELL: u64 = 4;
/// The most that a decoder takes, as a multiple of the pixels: these, and beside them twice as much, which a progressive JPEG
/// takes for its coefficients; a TIFF or a WebP is there once more.
const WHILE_DECODED: u64 = 3;

/// An image that was decoded.
pub(crate) struct Decoded {
    bytes: Vec<u8>,
    layout: Layout,
    pub(super) format: ImageFormat,
    /// True if the grey levels are the indices of a palette.
    pub(super) indices: bool,
    pub(super) quirk: Option<Quirk>,
    rest: Rest,
}

/// What a loader takes in another way, or refuses, of an image that is read here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quirk {
    /// Colours or alpha of 16 bits in a PNG, cut to their high bytes before nav2's grey is taken.
    DeepColours,
    /// A BMP of 16 bits a pixel: each loader scales its 5 or 6 bits in its own way.
    FewBits,
    /// A JPEG of four inks, which only nav2 since pull request 5071 turns into colours.
    Inks,
    /// An image that SDL_image does not read, in words.
    NotInSdl(&'static str),
}

impl Decoded {
    /// Decodes an image. The input is of one type to the decoders, so that each is compiled once.
    pub(super) fn open(
        mut input: &mut dyn Input,
        format: ImageFormat,
        colours: Colours,
        max_cells: u64,
    ) -> Result<Self, Error> {
        let length = input.seek(SeekFrom::End(0))?;
        input.rewind()?;
        let limit = Limit { cells: max_cells, length };
        // SDL hands the indices of a palette themselves on, and ROS 1 takes them for greys.
        let palette = if colours == Colours::Sdl { Palette::find(&mut input, format)? } else { None };
        let mut indices = palette.as_ref().is_some_and(|palette| !palette.is_grey_scale());
        input.rewind()?;
        let mut pixels = match (format, palette) {
            (_, Some(palette)) => {
                let mut numbered = BufReader::new(palette.numbered(&mut *input));
                let mut pixels = decode_as(&mut numbered, format, limit)?;
                pixels.keep_first_channel()?;
                pixels
            }
            (ImageFormat::Pnm, None) => {
                let decoder = PnmDecoder::new(&mut *input).map_err(refused)?;
                let bitmap = decoder.header().as_bitmap().is_some();
                let largest = if bitmap { 255 } else { decoder.header().maximal_sample() };
                let mut pixels = decode(decoder, limit)?;
                pixels.scale(largest, colours)?;
                if bitmap && colours == Colours::Sdl {
                    // To SDL a bitmap has a palette: white, then black.
                    pixels.bytes.iter_mut().for_each(|sample| *sample = u8::from(*sample == 0));
                    indices = true;
                }
                pixels
            }
            _ => decode_as(&mut *input, format, limit)?,
        };
        // The decoder gives every GIF an alpha.
        if format == ImageFormat::Gif {
            pixels.drop_opaque_alpha()?;
        }
        let head = if format == ImageFormat::Bmp { Bmp::read(&mut input)? } else { None };
        if let Some(head) = &head {
            let has_alpha = if colours == Colours::Sdl { head.bits == 32 } else { head.has_plain_alpha() };
            if has_alpha && pixels.channels == Channels::Rgb {
                let alpha = head.fourth_bytes(&mut input)?;
                pixels.set_alpha(&alpha)?;
            }
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
        let quirk = quirk(&mut input, format, pixels.deep, head.as_ref())?;
        let rest = if goes_on { Rest::More } else { Rest::Nothing };
        let white = if pixels.deep { u16::MAX } else { 255 };
        if pixels.deep {
            pixels.bring_down(colours)?;
        }
        if colours == Colours::Sdl {
            pixels.lay_out_as_sdl(format)?;
        }
        let Pixels { size, channels, deep, bytes } = pixels;
        let layout = Layout { size, channels, max: if deep { white } else { 255 }, white };
        Ok(Self { bytes, layout, format, indices, quirk, rest })
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

/// Finds what a loader takes in another way, or refuses.
fn quirk(
    input: &mut (impl BufRead + Seek),
    format: ImageFormat,
    deep: bool,
    bmp: Option<&Bmp>,
) -> io::Result<Option<Quirk>> {
    Ok(match format {
        ImageFormat::Bmp if bmp.is_some_and(|head| head.bits == 16) => Some(Quirk::FewBits),
        ImageFormat::Jpeg if ending::components_of_jpeg(input)? == Some(4) => Some(Quirk::Inks),
        ImageFormat::Pnm if read_at(input, 0, 2)? == b"P7" => Some(Quirk::NotInSdl("PAM")),
        ImageFormat::Pnm if deep => Some(Quirk::NotInSdl("a PPM of 16 bits")),
        ImageFormat::WebP if read_at(input, 12, 4)? != b"VP8 " => {
            Some(Quirk::NotInSdl("WebP but the simple lossy kind"))
        }
        _ => None,
    })
}

/// Decodes an image of this format.
fn decode_as(input: &mut dyn Input, format: ImageFormat, limit: Limit) -> Result<Pixels, Error> {
    decode(ImageReader::with_format(input, format).into_decoder().map_err(refused)?, limit)
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
    let claim = format!("claims {width} x {height} pixels, {total} bytes when decoded,");
    let refused_as = |kind| Error::new(kind, claim).with_value(total.to_string());
    if total > limit.cells.saturating_mul(BYTES_PER_CELL) {
        let allowed = format!("{BYTES_PER_CELL} for each cell of the limit of {}", limit.cells);
        return Err(refused_as(ErrorKind::TooLarge).allowing(" more than ", allowed));
    }
    if total > ANY_CLAIM && total / MOST_COMPRESSED > limit.length {
        let allowed = format!("{MOST_COMPRESSED} for each of the {} bytes it has", limit.length);
        let refused = refused_as(ErrorKind::Unsupported).allowing(" more than ", allowed);
        return Err(refused.followed_by("; convert it to PNG if it is meant"));
    }
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(total.saturating_mul(WHILE_DECODED).max(ANY_CLAIM));
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
