//! What makes a ROS map mean less than it seems: greys that may not be meant as they are read, and images that a loader
//! itself may read in another way.

use super::description::Description;
use crate::image::{Image, Layout};
use crate::options::{Mode, Semantics};
use crate::warning::{SAVED_UNKNOWN, Warning};
use std::io::{BufRead, Seek};

/// A grey that may not mean what it is read as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SuspectGrey {
    /// In raw mode, neither a percentage nor unknown.
    OutOfRange,
    /// The grey that map savers write for unknown, read as this percentage.
    SavedUnknown(i8),
    /// In probability mode, a grey (of the image's own depth) that is often meant as unknown.
    OftenUnknown(u16),
}

impl SuspectGrey {
    /// Suspects the grey that map savers write for unknown, unless it is read as unknown.
    pub(super) fn saved_unknown(percent: i8) -> Option<Self> {
        (!matches!(percent, -1 | 50)).then_some(Self::SavedUnknown(percent))
    }

    /// Suspects a grey of an image up to `white` in probability mode: the savers' unknown, and the two greys around 1/2.
    pub(super) fn often_unknown(grey: u16, white: u16) -> Option<Self> {
        let of_255 = |level: u8| u32::from(grey) * 255 == u32::from(level) * u32::from(white);
        [127, 128, SAVED_UNKNOWN].into_iter().any(of_255).then_some(Self::OftenUnknown(grey))
    }

    /// Returns what is to be said of `count` such cells of an image, if anything.
    ///
    /// Only few cells of a thresholded map may have the savers' unknown and be free. In the other modes it may also be a
    /// grey like any other, as 127 and 128 may: then it takes over a fifth of all cells to speak of it.
    pub(super) fn warning(
        self,
        count: u64,
        layout: &Layout,
        mode: Mode,
        description: &Description,
    ) -> Option<Warning> {
        let much = count.saturating_mul(5) > layout.size.cells() as u64;
        match self {
            _ if count == 0 => None,
            Self::OutOfRange => Some(Warning::OutOfRangeReadAsUnknown { count }),
            Self::SavedUnknown(percent) if mode == Mode::Trinary || percent == 0 || much => {
                let lower = mode == Mode::Trinary && !description.negate;
                Some(Warning::SavedUnknownReadAs {
                    grey: (u32::from(SAVED_UNKNOWN) * u32::from(layout.white) / 255) as u16,
                    percent,
                    count,
                    mode,
                    free_thresh: lower.then_some(description.free_thresh),
                })
            }
            Self::OftenUnknown(grey) if much => Some(Warning::OftenUnknownObserved { grey, count }),
            _ => None,
        }
    }
}

/// Returns where the loader itself would read something else, or where it is not known what it reads.
pub(super) fn of_image<R: BufRead + Seek>(semantics: Semantics, image: &Image<R>) -> Option<Warning> {
    let white = image.layout().white;
    match (semantics, image) {
        (Semantics::Nav2, Image::Png(png)) if png.is_cut() => Some(Warning::SixteenBits),
        (Semantics::Ros1, Image::Pgm(_)) if white > 255 => Some(Warning::PgmMaximumRefused { white }),
        (Semantics::Nav2, Image::Pgm(_)) if white != 255 && white != 65535 => {
            Some(Warning::PgmMaximum { white })
        }
        (Semantics::Ros1, Image::Png(png)) if png.is_indices() => Some(Warning::PaletteIndices),
        _ => None,
    }
}
