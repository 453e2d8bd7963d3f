//! Map images: PGM and PNG, told apart by their first bytes, read from the top a piece at a time.

mod layout;
mod pgm;
mod png;
mod reader;

pub(crate) use layout::{Channels, Colours, Layout, MaxPixels};
pub(crate) use reader::Image;
