//! Map images, told apart by their first bytes: PGM and PNG read from the top a piece at a time, others decoded whole.

mod bmp;
mod bytes;
mod decoded;
mod ending;
mod format;
mod layout;
mod palette;
mod pgm;
mod pixels;
mod png;
mod reader;

pub(crate) use decoded::Quirk;
pub(crate) use layout::{Channels, Colours, GREY_WEIGHTS, Layout, MaxPixels, Rest, level};
pub(crate) use reader::Image;
