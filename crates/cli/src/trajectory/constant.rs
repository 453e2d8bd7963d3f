//! A constant that explains why a trajectory moves differently from another: a clock that is off, or a laser mounted elsewhere.

use super::common::Common;
use super::motion::{LEVER, half_turn, seen_from};

/// The part of the squared differences that may be left for a constant to explain the rest.
const LEFT: f64 = 0.1;

/// What is constant between two trajectories.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Constant {
    /// The poses of one are stamped so many seconds later than those of the other.
    Late(f64),
    /// The laser of one is so many metres away from that of the other, and turned by so many radians.
    Mounted([f64; 2]),
}

impl Constant {
    /// Finds the constant that leaves less than a tenth of the squared differences between the poses, in one frame, of the
    /// trajectories `own` and `other`, by least squares; `None` if neither does. A radian counts as five metres.
    pub(super) fn between(common: &Common<'_>, own: usize, other: usize) -> Option<Self> {
        let (own, other) = (&common.poses[own], &common.poses[other]);
        let apart: Vec<_> =
            other.iter().zip(own).map(|(other, own)| seen_from(other, own)).map(levered).collect();
        let whole: f64 = apart.iter().map(squared).sum();
        let left = |explained: &dyn Fn(usize) -> [f64; 3]| -> f64 {
            let rest = |(k, apart): (usize, &[f64; 3])| {
                let explained = explained(k);
                squared(&[0, 1, 2].map(|axis: usize| apart[axis] - explained[axis]))
            };
            apart.iter().enumerate().map(rest).sum()
        };
        // What is late is on the way from the pose before, what is early on that to the pose after: as fast as the other is there.
        let shifted = |neighbour: &dyn Fn(usize) -> usize| {
            let speed = |k: usize| {
                let next = neighbour(k).min(other.len() - 1);
                let seconds = common.scans[next].time() - common.scans[k].time();
                let way = levered(seen_from(&other[k], &other[next]));
                way.map(|way| if seconds == 0.0 { 0.0 } else { way / seconds })
            };
            let speeds: Vec<_> = (0..other.len()).map(speed).collect();
            let products: f64 = apart.iter().zip(&speeds).map(|(apart, speed)| product(apart, speed)).sum();
            let early = products / speeds.iter().map(squared).sum::<f64>();
            (left(&|k| speeds[k].map(|speed| early * speed)), Self::Late(-early))
        };
        let count = apart.len() as f64;
        let mean = [0, 1, 2].map(|axis: usize| apart.iter().map(|apart| apart[axis]).sum::<f64>() / count);
        let mounted = Self::Mounted([libm::hypot(mean[0], mean[1]), libm::fabs(mean[2]) / LEVER]);
        let all = [shifted(&|k| k.saturating_sub(1)), shifted(&|k| k + 1), (left(&|_| mean), mounted)];
        let best = all.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
        best.filter(|best| best.0 < LEFT * whole).map(|best| best.1)
    }

    /// Says in words what explains the difference, and where to look.
    pub(super) fn in_words(&self) -> String {
        match self {
            Self::Late(seconds) => {
                let late = if *seconds > 0.0 { "late" } else { "early" };
                let seconds = libm::fabs(*seconds);
                format!(
                    "poses that are stamped {seconds:.2} s too {late} would do nearly all of it: look at the clock"
                )
            }
            Self::Mounted([metres, radians]) => format!(
                "a laser that is mounted {metres:.2} m and {:.1} degrees elsewhere would do nearly all of it: look at --mount",
                radians.to_degrees()
            ),
        }
    }
}

/// Returns a motion with its turn in metres, between half a turn to the right and half a turn to the left.
fn levered([ahead, aside, turn]: [f64; 3]) -> [f64; 3] {
    [ahead, aside, LEVER * half_turn(turn)]
}

fn product(one: &[f64; 3], other: &[f64; 3]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}

fn squared(motion: &[f64; 3]) -> f64 {
    product(motion, motion)
}
