//! What makes a ROS map mean less than it seems: greys that may not be meant as they are read, and images that a loader
//! itself may read in another way.

use super::description::Description;
use super::thresholds::Thresholds;
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
            // nav2's own saver writes unknown cells so.
            Self::SeeThrough if mode == Mode::Scale => None,
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

/// The greys of an image whose grades are lost: neither black, white, nor what savers write, nor the one most often used.
struct Lost {
    /// How many greys there are.
    kinds: usize,
    /// The number of cells that have one of them.
    count: u64,
}

impl Lost {
    /// Finds these greys among sums of samples, where `is_lost` says of one that its grade is; `None` if there are fewer than
    /// three, or if not over a tenth of the cells of other greys than the one most often used has one of them.
    fn of(sums: &[(usize, u64)], white: usize, is_lost: impl Fn(usize) -> bool) -> Option<Self> {
        let (commonest, most) = sums.iter().copied().max_by_key(|&(_, count)| count)?;
        let others: u64 = sums.iter().map(|&(_, count)| count).sum::<u64>() - most;
        let known = [0, SAVED_FREE, 255, SAVED_UNKNOWN].map(usize::from);
        let lost = |&&(sum, _): &&(usize, u64)| {
            sum != commonest && !known.contains(&level(sum, white)) && is_lost(sum)
        };
        let (kinds, count) =
            sums.iter().filter(lost).fold((0, 0), |(kinds, all), &(_, count)| (kinds + 1, all + count));
        (kinds >= 3 && count * 10 > others).then_some(Self { kinds, count })
    }
}

/// Returns the level of 255 of a sum of samples.
fn level(sum: usize, white: usize) -> usize {
    (sum * 255 + white / 2) / white
}

/// Returns the warning of a trinary image with many greys between those of the three states.
pub(super) fn greys_thresholded(sums: &[(usize, u64)], white: usize, layout: &Layout) -> Option<Warning> {
    let Lost { count, .. } = Lost::of(sums, white, |_| true)?;
    let often =
        |&&(sum, _): &&(usize, u64)| [127, 128, SAVED_UNKNOWN].map(usize::from).contains(&level(sum, white));
    let unknown = sums.iter().filter(often).max_by_key(|&&(_, count)| count);
    let own = |sum: usize| (sum * usize::from(layout.white) / white) as u16;
    // Of a deeper image than this the level is no grey of its own.
    let unknown = unknown.filter(|_| layout.white <= layout.max).map(|&(sum, _)| own(sum));
    Some(Warning::GreysThresholded { levels: sums.len(), count, unknown })
}

/// Returns the warning of an image in mode scale with many greys beyond the thresholds, which savers write 0.25 and 0.65;
/// `percent` is what a sum of samples is read as.
pub(super) fn grades_clipped(
    sums: &[(usize, u64)],
    white: usize,
    thresholds: Thresholds,
    percent: impl Fn(usize) -> i8,
) -> Option<Warning> {
    let Lost { kinds, count } = Lost::of(sums, white, |sum| matches!(percent(sum), 0 | 100))?;
    let Thresholds { free, occupied } = thresholds;
    Some(Warning::GradesClipped { levels: kinds, count, free_thresh: free, occupied_thresh: occupied })
}

/// Returns the warning of an image in mode probability whose cells have one grey for free and one for occupied, at most;
/// `occupancy` is what a sum of samples is read as.
pub(super) fn two_greys(sums: &[(usize, u64)], occupancy: impl Fn(usize) -> f64) -> Option<Warning> {
    let greys = |is: fn(&f64) -> bool| sums.iter().map(|&(sum, _)| occupancy(sum)).filter(is).count();
    let [free, occupied] = [greys(|&p| p < 0.5), greys(|&p| p > 0.5)];
    (free < 2 && occupied < 2 && free + occupied > 0).then_some(Warning::TwoGreys { levels: free + occupied })
}
