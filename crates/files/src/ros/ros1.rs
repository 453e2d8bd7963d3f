//! The rules of ROS 1's `map_server`: the average of the bytes SDL_image gives, in double precision.
//!
//! Its quirks are kept: trinary mode averages alpha as a colour, and so does every mode if alpha came from one
//! transparent grey; the last byte of a pixel counts as alpha even if it is blue; in scale mode only an alpha of 0 makes
//! a cell unknown, and only between the thresholds; raw mode keeps the byte as an int8.

use super::description::Description;
use super::pixel_table::PixelTable;
use super::suspects::SuspectGrey;
use super::thresholds::Thresholds;
use crate::image::{Channels, Layout};
use crate::options::Mode;
use crate::warning::SAVED_UNKNOWN;

/// Tabulates the rules for an image of this layout.
pub(super) fn table(
    description: &Description,
    mode: Mode,
    thresholds: Option<Thresholds>,
    layout: &Layout,
) -> PixelTable<i8> {
    let alpha_averaged = mode == Mode::Trinary || layout.channels == Channels::GreyKeyed;
    let weights = match layout.channels {
        // SDL_image turns grey and alpha into four samples.
        Channels::GreyAlpha if alpha_averaged => [3, 1, 0, 0],
        Channels::GreyAlpha => [3, 0, 0, 0],
        Channels::GreyKeyed => [1, 1, 0, 0],
        Channels::Rgba if alpha_averaged => [1, 1, 1, 1],
        _ => layout.colour_sum(),
    };
    let samples: u32 = weights.iter().sum();
    let max = u32::from(layout.max);
    let table = PixelTable::new(layout, weights, |sum| {
        // A single sample of another maximum is first brought to 255, without rounding; of 255 it stays as it is.
        let sum = if samples == 1 { sum * 255 / max } else { sum };
        let average = f64::from(sum) / f64::from(samples);
        let Some(thresholds) = thresholds else {
            let value = (if description.negate { 255.0 - average } else { average }) as u8 as i8;
            let allowed = (-1..=100).contains(&value);
            return if allowed { (value, None) } else { (-1, Some(SuspectGrey::OutOfRange)) };
        };
        let percent = percent(description, mode, thresholds, average);
        let is_saved = sum == samples * u32::from(SAVED_UNKNOWN);
        let is_grey = !(alpha_averaged && layout.channels.alpha());
        (percent, SuspectGrey::saved_unknown(percent).filter(|_| is_saved && is_grey))
    });
    if mode == Mode::Scale && layout.channels.count() > 1 {
        let see_through = layout.channels.alpha().then_some(SuspectGrey::SeeThrough);
        table.with_alpha(1, see_through, |percent| if (1..=99).contains(&percent) { -1 } else { percent })
    } else if mode == Mode::Trinary && layout.channels.alpha() {
        table.with_alpha(layout.max, Some(SuspectGrey::AlphaAveraged), |percent| percent)
    } else {
        table
    }
}

/// Returns the percentage of a grey.
fn percent(description: &Description, mode: Mode, thresholds: Thresholds, average: f64) -> i8 {
    let average = if description.negate { 255.0 - average } else { average };
    let occupancy = (255.0 - average) / 255.0;
    let Thresholds { free, occupied } = thresholds;
    if occupancy > occupied {
        100
    } else if occupancy < free {
        0
    } else if mode == Mode::Scale {
        (1.0 + 98.0 * ((occupancy - free) / (occupied - free))) as u8 as i8
    } else {
        -1
    }
}
