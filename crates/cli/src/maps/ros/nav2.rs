//! The rules of `nav2_map_server`: GraphicsMagick's grey levels, and thresholds in single precision.
//!
//! GraphicsMagick (measured: 1.3.40) takes `0.299 R + 0.587 G + 0.114 B` as the grey of a colour, rounded to 16 bits, and
//! gives nav2 its 8-bit level, rounded down. An alpha below 255 makes a cell unknown in trinary and scale mode. Raw mode
//! ignores `negate` and alpha. The samples of a 16-bit PNG are cut to their high byte.

use super::doubts::Suspect;
use super::shading::Shading;
use super::{Description, SAVED_UNKNOWN};
use crate::maps::Mode;
use crate::maps::image::{Channels, Layout};

/// The tables for an image of this layout.
pub(super) fn shading(description: &Description, mode: Mode, layout: &Layout) -> Shading<i8> {
    let cell = |level: u8| {
        if mode == Mode::Raw {
            let percent = if level <= 100 { level as i8 } else { -1 };
            return (percent, (101..=254).contains(&level).then_some(Suspect::OutOfRange));
        }
        let percent = percent(description, mode, level);
        (percent, Suspect::saved_unknown(percent).filter(|_| level == SAVED_UNKNOWN))
    };
    let white = u32::from(layout.max);
    let shading = match layout.channels {
        Channels::Rgb | Channels::Rgba => {
            Shading::new(layout, [299, 587, 114, 0], |sum| cell(((257 * sum + 500) / 1000 / 257) as u8))
        }
        _ => Shading::new(layout, layout.colour_sum(), |grey| cell((255 * grey / white) as u8)),
    };
    match mode {
        Mode::Raw => shading,
        _ if layout.channels.alpha() => shading.with_alpha(layout.max, |_| -1),
        _ => shading,
    }
}

fn percent(description: &Description, mode: Mode, level: u8) -> i8 {
    let shade = f32::from(level) / 255.0;
    let occupancy = if description.negate { shade } else { 1.0 - shade };
    let (free, occupied) = (description.free_thresh as f32, description.occupied_thresh as f32);
    if occupancy <= free {
        0
    } else if occupancy >= occupied {
        100
    } else if mode == Mode::Scale {
        // The difference is taken in double precision and rounded once, as there.
        let width = (description.occupied_thresh - description.free_thresh) as f32;
        ((occupancy - free) / width * 100.0).round().clamp(0.0, 100.0) as i8
    } else {
        -1
    }
}
