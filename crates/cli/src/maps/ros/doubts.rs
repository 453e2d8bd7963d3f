//! What makes a ROS map mean less than it seems: greys that may not be meant as they are read, and images that a loader
//! itself may read in another way.

use super::{Description, SAVED_UNKNOWN};
use crate::maps::image::{Image, Layout};
use crate::maps::size::cells_in_words;
use crate::maps::{Mode, Semantics};
use std::io::{BufRead, Seek};

/// A grey that may not mean what it is read as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Suspect {
    /// In raw mode, neither a percentage nor unknown.
    OutOfRange,
    /// The grey that map savers write for unknown, read as this percentage.
    SavedUnknown(i8),
    /// In probability mode, a grey (of the image's own depth) that is often meant as unknown.
    OftenUnknown(u16),
}

impl Suspect {
    /// For the grey that map savers write for unknown, unless it is read as unknown.
    pub(super) fn saved_unknown(percent: i8) -> Option<Self> {
        (!matches!(percent, -1 | 50)).then_some(Self::SavedUnknown(percent))
    }

    /// For a grey of an image up to `white` in probability mode: the savers' unknown, and the two greys around 1/2.
    pub(super) fn often_unknown(grey: u16, white: u16) -> Option<Self> {
        let of_255 = |level: u8| u32::from(grey) * 255 == u32::from(level) * u32::from(white);
        [127, 128, SAVED_UNKNOWN].into_iter().any(of_255).then_some(Self::OftenUnknown(grey))
    }

    /// What is to be said of `count` such cells of an image, if anything.
    ///
    /// Only few cells of a thresholded map may have the savers' unknown and be free. In the other modes it may also be a
    /// grey like any other, as 127 and 128 may: then it takes over a fifth of all cells to speak of it.
    pub(super) fn warning(
        self,
        count: u64,
        layout: &Layout,
        mode: Mode,
        description: &Description,
    ) -> Option<String> {
        let much = count.saturating_mul(5) > layout.size.cells() as u64;
        let cells = cells_in_words(count);
        match self {
            _ if count == 0 => None,
            Self::OutOfRange => {
                Some(format!("{cells} outside 0 to 100 and other than unknown (-1 or 255), read as unknown"))
            }
            Self::SavedUnknown(percent) if mode == Mode::Trinary || percent == 0 || much => {
                let read = match percent {
                    0 => "free".to_owned(),
                    100 => "occupied".to_owned(),
                    percent => format!("{percent} percent"),
                };
                let cure = if mode == Mode::Trinary && !description.negate {
                    format!(
                        " under free_thresh {}; a free_thresh of 0.196 keeps that grey unknown",
                        description.free_thresh
                    )
                } else {
                    let grey = u32::from(SAVED_UNKNOWN) * u32::from(layout.white) / 255;
                    let mode = if mode == Mode::Scale { "; mode scale has no grey for unknown" } else { "" };
                    format!("{mode}; if that grey means unknown, give --mode probability --unknown {grey}")
                };
                Some(format!(
                    "{cells} of grey {SAVED_UNKNOWN}, which map savers write for unknown, read as {read}{cure}"
                ))
            }
            Self::OftenUnknown(grey) if much => Some(format!(
                "{cells} of grey {grey} counted as observed; give --unknown {grey} if that grey means unknown"
            )),
            _ => None,
        }
    }
}

/// Where the loader itself would read something else, or where we do not know what it reads.
pub(super) fn of_image<R: BufRead + Seek>(semantics: Semantics, image: &Image<R>) -> Option<String> {
    let white = image.layout().white;
    match (semantics, image) {
        (Semantics::Nav2, Image::Png(png)) if png.is_cut() => Some(
            "the image has 16 bits: nav2_map_server may take its levels for others by 1 of 255".to_owned(),
        ),
        (Semantics::Ros1, Image::Pgm(_)) if white > 255 => Some(format!(
            "ROS 1's map_server refuses a PGM of maximum value {white}; its levels are read as of 255"
        )),
        (Semantics::Nav2, Image::Pgm(_)) if white != 255 && white != 65535 => Some(format!(
            "the PGM's maximum value is {white}: nav2_map_server may take its levels for others"
        )),
        (Semantics::Ros1, Image::Png(png)) if png.is_indices() => Some(
            "the image has a palette: as in ROS 1's map_server, its indices are read as grey levels"
                .to_owned(),
        ),
        _ => None,
    }
}
