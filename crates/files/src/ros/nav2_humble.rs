//! The rules of `nav2_map_server` before pull request 5071 (April 2025), as in Humble, Iron and Jazzy: the plain average of
//! the samples of a colour in double precision, and thresholds compared strictly, occupied first.
//!
//! GraphicsMagick gives samples of 16 bits, those of 8 times 257. In trinary mode alpha is averaged as one more colour of an
//! image that has it, opaque or not; in mode scale an alpha below the largest makes a cell unknown. Raw mode ignores `negate`
//! and alpha.

use super::description::Description;
use super::pixel_table::PixelTable;
use super::suspects::SuspectGrey;
use super::thresholds::Thresholds;
use crate::image::{Channels, Layout};
use crate::options::Mode;
use crate::warning::SAVED_UNKNOWN;

/// The largest sample.
const LARGEST: u32 = 65535;

/// Tabulates the rules for an image of this layout.
pub(super) fn table(
    description: &Description,
    mode: Mode,
    thresholds: Option<Thresholds>,
    layout: &Layout,
) -> PixelTable<i8> {
    let alpha = layout.channels.alpha();
    let averaged = mode == Mode::Trinary && alpha;
    let weights = match layout.channels {
        Channels::GreyAlpha | Channels::GreyKeyed if averaged => [3, 1, 0, 0],
        Channels::Rgba if averaged => [1, 1, 1, 1],
        _ => layout.colour_sum(),
    };
    let samples: u32 = weights.iter().sum();
    let max = u32::from(layout.max);
    let table = PixelTable::new(layout, weights, |sum| {
        // Only a PGM has another largest sample than 255 and 65535, and it has one sample.
        let sum_16 =
            if LARGEST.is_multiple_of(max) { LARGEST / max * sum } else { (LARGEST * sum + max / 2) / max };
        let shade = f64::from(sum_16) / f64::from(samples) / f64::from(LARGEST);
        let Some(thresholds) = thresholds else {
            let level = (shade * 255.0).round() as u8;
            let percent = if level <= 100 { level as i8 } else { -1 };
            return (percent, (101..=254).contains(&level).then_some(SuspectGrey::OutOfRange));
        };
        let percent = percent(description, mode, thresholds, shade);
        let is_saved = !averaged && 255 * sum == samples * u32::from(SAVED_UNKNOWN) * max;
        (percent, SuspectGrey::saved_unknown(percent).filter(|_| is_saved))
    });
    match mode {
        Mode::Trinary if alpha => {
            table.with_alpha(layout.max, Some(SuspectGrey::AlphaAveraged), |percent| percent)
        }
        Mode::Scale if alpha => table.with_alpha(layout.max, Some(SuspectGrey::SeeThrough), |_| -1),
        _ => table,
    }
}

/// Returns the percentage of a grey, which `shade` says from 0 to 1.
fn percent(description: &Description, mode: Mode, thresholds: Thresholds, shade: f64) -> i8 {
    let occupancy = if description.negate { shade } else { 1.0 - shade };
    let Thresholds { free, occupied } = thresholds;
    if occupied < occupancy {
        100
    } else if occupancy < free {
        0
    } else if mode == Mode::Scale {
        ((occupancy - free) / (occupied - free) * 100.0).round_ties_even() as i8
    } else {
        -1
    }
}
