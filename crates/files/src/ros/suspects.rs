//! What makes a ROS map mean less than it seems: greys that may not be meant as they are read, and images that a loader
//! itself may read in another way.

use super::description::Description;
use crate::image::{Image, Layout, Quirk};
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
    /// Unknown because the pixel is not opaque.
    SeeThrough,
    /// Not opaque, and its alpha averaged as a colour.
    AlphaAveraged,
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
            Self::SeeThrough => Some(Warning::TransparentReadAsUnknown { count }),
            Self::AlphaAveraged => Some(Warning::AlphaAveraged { count }),
            Self::OutOfRange => Some(Warning::OutOfRangeReadAsUnknown { count }),
            Self::SavedUnknown(percent) if mode == Mode::Trinary || percent == 0 || much => {
                let lower = mode == Mode::Trinary && !description.negate;
                Some(Warning::SavedUnknownReadAs {
                    grey: (u32::from(SAVED_UNKNOWN) * u32::from(layout.white) / 255) as u16,
                    percent,
                    count,
                    mode,
                    free_thresh: description.free_thresh.filter(|_| lower),
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
        (Semantics::Ros1, Image::Pgm(_)) if white > 255 => Some(Warning::PgmMaximumRefused { white }),
        (Semantics::Nav2 | Semantics::Nav2Humble, Image::Pgm(_)) if white != 255 && white != 65535 => {
            Some(Warning::PgmMaximum { white })
        }
        (Semantics::Ros1, image) if image.is_indices() => Some(Warning::PaletteIndices),
        _ => match (semantics, image.quirk()?) {
            (Semantics::Nav2, Quirk::DeepColours) => Some(Warning::SixteenBits),
            (_, Quirk::FewBits) => Some(Warning::LevelsDiffer { of: "a BMP of 16 bits" }),
            (Semantics::Nav2Humble | Semantics::Ros1, Quirk::Inks) => {
                Some(Warning::LevelsDiffer { of: "a JPEG of four inks (CMYK)" })
            }
            (Semantics::Ros1, Quirk::NotInSdl(of)) => Some(Warning::RefusedByRos1 { of }),
            _ => None,
        },
    }
}

/// Greys that a thresholded map may have beside black and white: savers write 254 for free and 205 for unknown.
const SAVED_FREE: u8 = 254;

/// Returns the warning of a trinary image with many greys between those of the three states: where, of the cells of other
/// greys than the one most often used, over a tenth has one of three or more greys that are neither black, white, nor what
/// savers write.
pub(super) fn greys_thresholded(sums: &[(usize, u64)], white: usize, layout: &Layout) -> Option<Warning> {
    let level = |sum: usize| (sum * 255 + white / 2) / white;
    let (commonest, most) = sums.iter().copied().max_by_key(|&(_, count)| count)?;
    let others: u64 = sums.iter().map(|&(_, count)| count).sum::<u64>() - most;
    let known = [0, SAVED_FREE, 255, SAVED_UNKNOWN].map(usize::from);
    let between = |&&(sum, _): &&(usize, u64)| sum != commonest && !known.contains(&level(sum));
    let (kinds, count) =
        sums.iter().filter(between).fold((0, 0), |(kinds, sum), &(_, count)| (kinds + 1, sum + count));
    if kinds < 3 || count * 10 <= others {
        return None;
    }
    let often = |&&(sum, _): &&(usize, u64)| [127, 128, SAVED_UNKNOWN].map(usize::from).contains(&level(sum));
    let unknown = sums.iter().filter(often).max_by_key(|&&(_, count)| count);
    let own = |sum: usize| (sum * usize::from(layout.white) / white) as u16;
    // Of a deeper image than this the level is no grey of its own.
    let unknown = unknown.filter(|_| layout.white <= layout.max).map(|&(sum, _)| own(sum));
    Some(Warning::GreysThresholded { levels: sums.len(), count, unknown })
}
