//! Map images, told apart by their first bytes: PGM and PNG read from the top a piece at a time, others decoded whole.

mod decoded;
mod ending;
mod format;
mod layout;
mod palette;
mod pgm;
mod png;
mod reader;

pub(crate) use layout::{Channels, Colours, Layout, MaxPixels, Rest};
pub(crate) use reader::Image;
