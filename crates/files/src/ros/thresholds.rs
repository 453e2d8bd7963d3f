//! The two thresholds of a map, and what is odd about them.

use crate::options::Semantics;
use crate::warning::Warning;

/// The occupancies up to which cells are free, and from which they are occupied.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Thresholds {
    pub(super) free: f64,
    pub(super) occupied: f64,
}

impl Thresholds {
    /// Returns what a reader should know of them: percentages where fractions are meant, and thresholds that cross.
    pub(super) fn warnings(self, semantics: Semantics) -> Vec<Warning> {
        let Self { free, occupied } = self;
        let mut warnings = Vec::new();
        if free > 1.0 || occupied > 1.0 {
            warnings.push(Warning::ThresholdsAbove1 { free, occupied });
        }
        if free >= occupied {
            warnings.push(Warning::ThresholdsCross {
                free,
                occupied,
                free_wins: semantics == Semantics::Nav2,
            });
        }
        warnings
    }
}
