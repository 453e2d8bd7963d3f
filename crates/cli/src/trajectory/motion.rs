//! Motions from one pose to another: forwards, to the left, and a turn.

use mean_information::scan::Pose;
use std::f64::consts::{PI, TAU};

/// The lever of a turn, in metres: a radian counts as much as this way.
pub(super) const LEVER: f64 = 5.0;

/// Returns the motion from one pose to another, as seen from the first: forwards, to the left, and the turn in radians.
pub(super) fn seen_from(from: &Pose, to: &Pose) -> [f64; 3] {
    let [dx, dy] = [0, 1].map(|axis: usize| to.position()[axis] - from.position()[axis]);
    let (sin, cos) = libm::sincos(from.theta());
    [cos * dx + sin * dy, cos * dy - sin * dx, to.theta() - from.theta()]
}

/// Returns a turn between half a turn to the right and half a turn to the left.
pub(super) fn half_turn(turn: f64) -> f64 {
    (turn + PI).rem_euclid(TAU) - PI
}
