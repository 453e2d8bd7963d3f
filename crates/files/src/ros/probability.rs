//! Probability mode: the occupancy of the grey level itself, in double precision, without thresholds or percent.

use super::description::Description;
use super::pixel_table::PixelTable;
use super::suspects::SuspectGrey;
use crate::error::{Error, ErrorKind};
use crate::image::Layout;

/// Tabulates the occupancies of an image of this layout: `p = (white - grey) / white`, or `grey / white` under `negate`, where the grey
/// of a colour is its average. The grey level `unknown`, and any transparency, is 1/2.
pub(super) fn table(
    description: &Description,
    layout: &Layout,
    unknown: Option<f64>,
) -> Result<PixelTable<f64>, Error> {
    let weights = layout.colour_sum();
    let samples: u32 = weights.iter().sum();
    let own = u32::from(layout.max / layout.white) * samples;
    let unknown_sum = match unknown {
        Some(level) if !(0.0..=f64::from(layout.white)).contains(&level) || level.fract() != 0.0 => {
            let message = format!("the unknown grey level {level} is none of this image");
            return Err(Error::new(ErrorKind::OutOfRange, message)
                .with_value(level.to_string())
                .allowing("; allowed is ", format!("0 to {}", layout.white)));
        }
        level => level.map(|level| level as u32 * own),
    };
    let white = samples * u32::from(layout.max);
    let table = PixelTable::new(layout, weights, |sum| {
        let occupied = if description.negate { sum } else { white - sum };
        let p = if Some(sum) == unknown_sum { 0.5 } else { f64::from(occupied) / f64::from(white) };
        let grey = (unknown.is_none() && sum % own == 0).then_some((sum / own) as u16);
        (p, grey.and_then(|grey| SuspectGrey::often_unknown(grey, layout.white)))
    });
    Ok(if layout.channels.alpha() {
        table.with_alpha(layout.max, Some(SuspectGrey::SeeThrough), |_| 0.5)
    } else {
        table
    })
}
