//! The rules of `nav2_map_server` since pull request 5071 (April 2025): GraphicsMagick's grey levels, and thresholds in single precision.
//!
//! GraphicsMagick (measured: 1.3.40) takes `0.299 R + 0.587 G + 0.114 B` as the grey of a colour, rounded to 16 bits, and
//! gives nav2 its 8-bit level, rounded down. An alpha below the largest makes a cell unknown in trinary and scale mode. Raw
//! mode ignores `negate` and alpha.

use super::description::Description;
use super::pixel_table::PixelTable;
use super::suspects::SuspectGrey;
use super::thresholds::Thresholds;
use crate::image::{Channels, GREY_WEIGHTS, Layout, level};
use crate::options::Mode;
use crate::warning::SAVED_UNKNOWN;

/// Tabulates the rules for an image of this layout.
pub(super) fn table(
    description: &Description,
    mode: Mode,
    thresholds: Option<Thresholds>,
    layout: &Layout,
) -> PixelTable<i8> {
    let cell = |level: u8| {
        let Some(thresholds) = thresholds else {
            let percent = if level <= 100 { level as i8 } else { -1 };
            return (percent, (101..=254).contains(&level).then_some(SuspectGrey::OutOfRange));
        };
        let percent = percent(description, mode, thresholds, level);
        (percent, SuspectGrey::saved_unknown(percent).filter(|_| level == SAVED_UNKNOWN))
    };
    let white = u32::from(layout.max);
    let table = match layout.channels {
        Channels::Rgb | Channels::Rgba => PixelTable::new(layout, GREY_WEIGHTS, |sum| cell(level(257 * sum))),
        _ => PixelTable::new(layout, layout.colour_sum(), |grey| cell((255 * grey / white) as u8)),
    };
    match mode {
        Mode::Raw => table,
        _ if layout.channels.alpha() => table.with_alpha(layout.max, Some(SuspectGrey::SeeThrough), |_| -1),
        _ => table,
    }
}

/// Returns the percentage of a grey.
fn percent(description: &Description, mode: Mode, thresholds: Thresholds, level: u8) -> i8 {
    let shade = f32::from(level) / 255.0;
    let occupancy = if description.negate { shade } else { 1.0 - shade };
    let (free, occupied) = (thresholds.free as f32, thresholds.occupied as f32);
    if occupancy <= free {
        0
    } else if occupancy >= occupied {
        100
    } else if mode == Mode::Scale {
        // The difference is taken in double precision and rounded once, as there.
        let width = (thresholds.occupied - thresholds.free) as f32;
        ((occupancy - free) / width * 100.0).round().clamp(0.0, 100.0) as i8
    } else {
        -1
    }
}
