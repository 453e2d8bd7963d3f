//! Tilts, which the plane drops, counted.

use super::quaternion::Quaternion;
use crate::warning::Warning;

/// The tilt in degrees above which a pose is counted.
const FLAT: f64 = 1.0;
/// The tilt in degrees above which no robot in a plane drives: z is not up, or the quaternion is read in another order than
/// it was written in.
const FAR: f64 = 45.0;

/// The number of poses, of those that are tilted, and the greatest tilt.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Tilts {
    poses: u64,
    count: u64,
    greatest: f64,
    /// Those that are tilted far, and those among them that are not if w comes first.
    far: u64,
    far_unless_w_first: u64,
}

impl Tilts {
    /// Counts an orientation, and whether it is tilted.
    pub(crate) fn see(&mut self, turn: Quaternion) {
        let tilt = turn.tilt();
        self.poses += 1;
        if tilt > FLAT {
            self.count += 1;
            self.greatest = self.greatest.max(tilt);
        }
        if tilt > FAR {
            self.far += 1;
            let Quaternion([w, x, y, z]) = turn;
            self.far_unless_w_first += u64::from(Quaternion([x, y, z, w]).tilt() <= FAR);
        }
    }

    /// Returns the warning of them, if there is one.
    pub(crate) fn warning(&self) -> Option<Warning> {
        let Self { count, greatest, .. } = *self;
        (count > 0).then_some(Warning::TiltDropped { count, greatest_degrees: greatest })
    }

    /// Returns the warning of a text in which most poses are tilted far, whose numbers may be in another order.
    pub(super) fn warning_of_order(&self) -> Option<Warning> {
        let Self { poses, far, far_unless_w_first, .. } = *self;
        let are_most = |count: u64| 2 * count > poses;
        let w_first = are_most(far_unless_w_first);
        are_most(far).then_some(Warning::MostTiltedFar { count: far, poses, w_first })
    }
}
