//! Whether two trajectories move alike: one is the other, turned and shifted as a whole.

use super::common::Common;
use super::motion::half_turn;
use mean_information::scan::Pose;

/// The part of a cell by which the end of no beam lies elsewhere, where trajectories move alike.
const PART: f64 = 0.1;

/// How the frame of a trajectory lies in that of another, which moves alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    /// The turn, in radians.
    turn: f64,
    /// The shift of its origin, in metres.
    shift: [f64; 2],
}

impl Frame {
    /// The frame itself.
    const SAME: Self = Self { turn: 0.0, shift: [0.0; 2] };

    /// Finds the frame in which trajectory `own` moves as trajectory `other` does, to a tenth of a cell of `resolution` metres:
    /// the same frame if it does in that; `None` if in none.
    ///
    /// A position off by `d` and a heading off by `a` move the end of a beam of range `r` by at most `d + r |a|`, as a chord is
    /// no longer than its arc. The turn is the mean of the turns between the headings, and the shift that of the positions then.
    pub(super) fn of(common: &Common<'_>, own: usize, other: usize, resolution: f64) -> Option<Self> {
        let pairs = || common.poses[own].iter().zip(&common.poses[other]);
        let fits = |frame: &Self| {
            let moved = |(own, other)| {
                let [x, y] = frame.off(own, other);
                libm::hypot(x, y) + common.reach * libm::fabs(frame.turned(own, other))
            };
            pairs().all(|pair| moved(pair) < PART * resolution)
        };
        let fitted = || {
            let turns = pairs().map(|(own, other)| libm::sincos(own.theta() - other.theta()));
            let (sin, cos) = turns.fold((0.0, 0.0), |sum, turn| (sum.0 + turn.0, sum.1 + turn.1));
            let turned = Self { turn: libm::atan2(sin, cos), ..Self::SAME };
            let mean = |axis: usize| {
                pairs().map(|(own, other)| turned.off(own, other)[axis]).sum::<f64>() / pairs().count() as f64
            };
            Self { shift: [mean(0), mean(1)], ..turned }
        };
        // A scan alone would fit any other.
        let several = pairs().count() > 1;
        [Some(Self::SAME).filter(&fits), several.then(fitted).filter(&fits)].into_iter().flatten().next()
    }

    /// Returns how far the position of a pose is from that of the other in this frame, in metres.
    fn off(&self, own: &Pose, other: &Pose) -> [f64; 2] {
        let ([x, y], [to_x, to_y]) = (other.position(), own.position());
        let (sin, cos) = libm::sincos(self.turn);
        [to_x - cos * x + sin * y - self.shift[0], to_y - sin * x - cos * y - self.shift[1]]
    }

    /// Returns the turn from the heading of the other pose in this frame to that of a pose, in radians.
    fn turned(&self, own: &Pose, other: &Pose) -> f64 {
        half_turn(own.theta() - other.theta() - self.turn)
    }

    /// Tells whether it is the frame of the other one.
    pub(super) fn is_same(&self) -> bool {
        *self == Self::SAME
    }

    /// Says in words that a trajectory moves in this frame as that of the name `other` does.
    pub(super) fn in_words(&self, other: &str) -> String {
        if self.is_same() {
            return format!("moves as {other} does");
        }
        let shift = libm::hypot(self.shift[0], self.shift[1]);
        let [degrees, _] = apart(libm::fabs(self.turn.to_degrees()), 0.0, 1);
        let [metres, _] = apart(shift, 0.0, 2);
        format!("moves as {other} does, in a frame turned by {degrees} degrees and shifted by {metres} m")
    }
}

/// Writes two numbers with as many decimals, `least` or more, as tell them apart; with `least` if six do not.
pub(super) fn apart(one: f64, other: f64, least: usize) -> [String; 2] {
    let written = |decimals: usize| [one, other].map(|number| format!("{number:.decimals$}"));
    (least..=6).map(written).find(|[one, other]| one != other).unwrap_or_else(|| written(least))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_decimals_as_tell_apart() {
        assert_eq!(apart(2.1, 3.0, 1), ["2.1", "3.0"]);
        assert_eq!(apart(2.09, 2.093, 1), ["2.090", "2.093"]);
        assert_eq!(apart(0.0004, 0.0, 1), ["0.0004", "0.0000"]);
        assert_eq!(apart(1e-9, 0.0, 2), ["0.00", "0.00"]);
    }
}
