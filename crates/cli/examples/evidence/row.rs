//! A trajectory with all that is known of it.

use crate::measured::Measured;
use crate::perturbed::{Kind, Perturbed};
use crate::relations::Errors;

/// A trajectory with its errors and measures.
#[derive(Debug)]
pub(crate) struct Row {
    pub(crate) made: Perturbed,
    pub(crate) errors: Errors,
    pub(crate) measured: Measured,
}

impl Row {
    /// A measure as a loss: the greater, the worse.
    pub(crate) fn loss(&self, column: usize) -> f64 {
        let measure = &self.measured.measures[column];
        if measure.is_gain { -measure.value } else { measure.value }
    }

    /// Whether the trajectory is one of those that are ranked.
    pub(crate) fn is_ranked(&self) -> bool {
        self.made.kind != Kind::Moved
    }
}
