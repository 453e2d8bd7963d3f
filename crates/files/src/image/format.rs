//! The format of an image, told by its first bytes, as the loaders' libraries tell it.

use crate::error::{Error, ErrorKind, Place};
use image::ImageFormat;

/// The images that are read, for messages.
pub(super) const ALLOWED: &str = "PGM, PNG, BMP, PPM, PBM, JPEG, TIFF, GIF, WebP and TGA";

/// The way the pixels of an image are read.
pub(super) enum Reader {
    /// PGM, a piece at a time.
    Pgm,
    /// PNG, a row at a time.
    Png,
    /// Others, decoded whole.
    Decoded(ImageFormat),
}

impl Reader {
    /// Tells the format of an image that begins with these bytes. TGA has no mark, but its name.
    pub(super) fn of(first: &[u8], name: &str) -> Result<Self, Error> {
        Ok(match first {
            [b'P', b'2' | b'5', ..] => Self::Pgm,
            [0x89, b'P', b'N', b'G', ..] => Self::Png,
            [b'P', b'1' | b'3' | b'4' | b'6' | b'7', ..] => Self::Decoded(ImageFormat::Pnm),
            [b'B', b'M', ..] => Self::Decoded(ImageFormat::Bmp),
            [0xff, 0xd8, 0xff, ..] => Self::Decoded(ImageFormat::Jpeg),
            [b'I', b'I', b'*', 0, ..] | [b'M', b'M', 0, b'*', ..] => Self::Decoded(ImageFormat::Tiff),
            [b'G', b'I', b'F', b'8', ..] => Self::Decoded(ImageFormat::Gif),
            [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => {
                Self::Decoded(ImageFormat::WebP)
            }
            [] => {
                return Err(Error::new(ErrorKind::CutShort, "the file is empty")
                    .allowing("; allowed are ", format!("{ALLOWED} images")));
            }
            first => match named(first) {
                None if name.to_ascii_lowercase().ends_with(".tga") => Self::Decoded(ImageFormat::Tga),
                name => return Err(unsupported(first, name)),
            },
        })
    }
}

/// Creates the error of a format that is not read, with a way out.
fn unsupported(first: &[u8], name: Option<&str>) -> Error {
    let shown = first[..first.len().min(4)].escape_ascii().to_string();
    let what = name.map_or_else(
        || format!("is no image of a kind that is read: it begins with \"{shown}\""),
        |name| format!("is {name}, not an image of a kind that is read"),
    );
    Error::new(ErrorKind::Unsupported, what)
        .at(Place::Byte(0))
        .with_value(shown)
        .allowing("; allowed are ", ALLOWED)
        .followed_by("; convert it, as by `magick FILE map.png`")
}

/// Names what begins with these bytes, among what is met in the place of a map's image.
fn named(first: &[u8]) -> Option<&'static str> {
    let text = first.trim_ascii_start();
    let starts = |with: &[u8]| text.len() >= with.len() && text[..with.len()].eq_ignore_ascii_case(with);
    Some(match first {
        _ if starts(b"<!doctype html") || starts(b"<html") => "a web page",
        _ if starts(b"<svg") || starts(b"<?xml") => "SVG or other XML",
        _ if starts(b"image:") || starts(b"resolution:") => "a yaml file",
        [b'%', b'P', b'D', b'F', ..] => "PDF",
        [b'P', b'K', 3 | 5, 4 | 6, ..] => "a zip archive",
        [0x1f, 0x8b, ..] => "gzip",
        [0xfd, b'7', b'z', b'X', b'Z', ..] => "xz",
        [b'P', b'F' | b'f', b'\n', ..] => "PFM",
        [_, _, _, _, b'f', b't', b'y', b'p', b'a', b'v', b'i', ..] => "AVIF",
        [_, _, _, _, b'f', b't', b'y', b'p', ..] => "HEIF",
        [0xff, 0x0a, ..] | [0, 0, 0, 0x0c, b'J', b'X', b'L', b' ', ..] => "JPEG XL",
        [0, 0, 0, 0x0c, b'j', b'P', b' ', b' ', ..] => "JPEG 2000",
        [b'8', b'B', b'P', b'S', ..] => "a Photoshop file",
        [b'g', b'i', b'm', b'p', b' ', b'x', b'c', b'f', ..] => "a GIMP file",
        [b'q', b'o', b'i', b'f', ..] => "QOI",
        [b'D', b'D', b'S', b' ', ..] => "DDS",
        [0x76, 0x2f, 0x31, 0x01, ..] => "OpenEXR",
        [0x93, b'N', b'U', b'M', b'P', b'Y', ..] => "a NumPy array",
        [0, 0, 1, 0, ..] => "an icon (ICO)",
        _ => return None,
    })
}
