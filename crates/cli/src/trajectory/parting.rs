//! Where a trajectory parts from the best one: the stretch of the log in which the two move most differently.

use super::common::Common;
use super::constant::Constant;
use super::motion::{LEVER, half_turn, seen_from};
use crate::output::Record;
use mean_information::scan::blocks;

/// The share of all differences from which on one part of the log is named: five times that of each of 20 equal parts.
const CONCENTRATED: f64 = 0.25;

/// The part of the log in which a trajectory moves most differently from another one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parting {
    /// The times of its first scan and of the one after its last, in seconds after the first scan of all.
    pub times: [f64; 2],
    /// The mean of the other one's positions there, in metres.
    pub place: [f64; 2],
    /// The difference of the two motions over these scans: metres, and radians.
    pub by: [f64; 2],
    /// The share of the differences over all parts, from 0 to 1; a radian counts as five metres.
    pub share: f64,
    /// The number of parts.
    pub parts: usize,
    /// The differences of all parts, added up: metres, and radians.
    pub all: [f64; 2],
    /// What explains nearly all of the difference, if something constant does.
    constant: Option<Constant>,
}

impl Parting {
    /// Finds the part, of `parts` equal ones, in which trajectory `own` moves most differently from trajectory `best`; `None`
    /// if they move alike.
    pub(super) fn of(common: &Common<'_>, own: usize, best: usize, parts: usize) -> Option<Self> {
        let constant = Constant::between(common, own, best);
        let (own, best) = (&common.poses[own], &common.poses[best]);
        let last = common.scans.len() - 1;
        let by = |[from, to]: [usize; 2]| {
            let [a, b] = [own, best].map(|poses| seen_from(&poses[from], &poses[to]));
            [libm::hypot(a[0] - b[0], a[1] - b[1]), libm::fabs(half_turn(a[2] - b[2]))]
        };
        let weight = |[metres, radians]: [f64; 2]| metres + LEVER * radians;
        // Up to the first scan of the next part, so that no step is left out.
        let ends = blocks(common.scans.len(), parts).map(|scans| [scans.start, scans.end.min(last)]);
        let parts: Vec<_> = ends.map(|ends| (ends, by(ends))).collect();
        let all: f64 = parts.iter().map(|&(_, by)| weight(by)).sum();
        let most = parts.iter().max_by(|(_, a), (_, b)| weight(*a).total_cmp(&weight(*b)));
        let &([from, to], by) = most?;
        let positions = &best[from..=to];
        let place = [0, 1].map(|axis: usize| {
            positions.iter().map(|pose| pose.position()[axis]).sum::<f64>() / positions.len() as f64
        });
        let times = [from, to].map(|scan| common.scans[scan].time() - common.scans[0].time());
        let sum = |of: usize| parts.iter().map(|(_, by)| by[of]).sum();
        let share = weight(by) / all;
        (all > 0.0).then(|| Self {
            times,
            place,
            by,
            share,
            parts: parts.len(),
            all: [sum(0), sum(1)],
            constant,
        })
    }

    /// Returns the values of JSON.
    pub(super) fn record(&self) -> Record {
        let [[from, to], [x, y], [metres, radians]] = [self.times, self.place, self.by];
        Record::computed([
            ("from_s", from),
            ("to_s", to),
            ("x_m", x),
            ("y_m", y),
            ("distance_m", metres),
            ("turn_rad", radians),
            ("share", self.share),
        ])
    }

    /// Says in words where the trajectory parts from that of the name `best`.
    pub(super) fn in_words(&self, best: &str) -> String {
        let Self { times: [from, to], place: [x, y], by: [metres, radians], share, parts, all, constant } =
            self;
        let percent = 100.0 * share;
        let why = constant.as_ref().map(|constant| format!("; {}", constant.in_words()));
        if *share < CONCENTRATED {
            let [metres, degrees] = [all[0], all[1].to_degrees()];
            let why = why.unwrap_or_else(|| "; it drifts, or look at the clock and at --mount".to_owned());
            return format!(
                "moves differently from {best} all along the log: by {metres:.2} m and {degrees:.1} degrees, added up over its \
                 {parts} parts, none of which has more than {percent:.0} % of that{why}"
            );
        }
        format!(
            "moves differently from {best} most from {from:.1} to {to:.1} s after the first scan, there about x {x:.1} m, y \
             {y:.1} m: by {metres:.2} m, seen from its heading at the start, and {:.1} degrees, {percent:.0} % of all that the \
             {parts} parts of the log differ by{}",
            radians.to_degrees(),
            why.unwrap_or_default()
        )
    }
}
