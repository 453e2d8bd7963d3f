//! Axes whose ticks are given, which `plotters` would choose itself.

use crate::output::short;
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use std::ops::Range;

/// A linear axis with its ticks given.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    pub(super) range: Range<f64>,
    pub(super) ticks: Vec<f64>,
}

impl Ranged for Axis {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, x: &f64, (start, end): (i32, i32)) -> i32 {
        let part = (x - self.range.start) / (self.range.end - self.range.start);
        start + (part * f64::from(end - start)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.ticks.clone()
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

/// Returns the label of a tick of a decimal logarithm: in digits up to ten thousand.
pub(super) fn power_of_ten(exponent: i32) -> String {
    let power = format!("1e{exponent}");
    if exponent.abs() > 4 { power } else { power.parse().map_or(String::new(), short) }
}
