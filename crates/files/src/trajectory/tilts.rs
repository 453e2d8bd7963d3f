//! Tilts, which the plane drops, counted.

use super::quaternion::Quaternion;
use crate::warning::Warning;

/// The tilt in degrees above which a pose is counted.
const FLAT: f64 = 1.0;

/// The number of poses that are tilted, and the greatest tilt.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Tilts {
    count: u64,
    greatest: f64,
}

impl Tilts {
    /// Counts an orientation if it is tilted.
    pub(crate) fn see(&mut self, turn: Quaternion) {
        let tilt = turn.tilt();
        if tilt > FLAT {
            self.count += 1;
            self.greatest = self.greatest.max(tilt);
        }
    }

    /// Returns the warning of them, if there is one.
    pub(crate) fn warning(&self) -> Option<Warning> {
        let Self { count, greatest } = *self;
        (count > 0).then_some(Warning::TiltDropped { count, greatest_degrees: greatest })
    }
}
