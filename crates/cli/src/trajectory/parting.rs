//! Where a trajectory parts from the best one: the parts of the log in which the two move most differently.

use super::common::Common;
use super::constant::Constant;
use super::motion::{LEVER, half_turn, seen_from};
use crate::output::Record;
use mean_information::scan::blocks;

/// Parts stand out that differ by so many times as much as the others do on average, and by so many as the next of them.
const STANDS_OUT: f64 = 5.0;
const APART: f64 = 1.5;
/// One in so many parts may stand out: where more do, trajectories differ all along.
const FEW: usize = 4;
/// The most parts that are named in words.
const NAMED: usize = 3;

/// A part of the log, and how differently two trajectories move in it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Part {
    /// The times of its first scan and of the one after its last, in seconds after the first scan of all.
    times: [f64; 2],
    /// The mean of the better one's positions there, in metres.
    place: [f64; 2],
    /// The difference of the two motions over these scans: metres, and radians.
    by: [f64; 2],
    /// The share of the differences over all parts, from 0 to 1; a radian counts as five metres.
    share: f64,
}

/// The parts of the log in which a trajectory moves most differently from another one.
#[derive(Clone, Debug, PartialEq)]
pub struct Parting {
    /// The parts that stand out, that with the greatest difference first; where none does, that one.
    most: Vec<Part>,
    /// True if these stand out.
    stand_out: bool,
    /// The number of parts.
    parts: usize,
    /// The differences of all parts, added up: metres, and radians.
    all: [f64; 2],
    /// What explains nearly all of the difference, if something constant does.
    constant: Option<Constant>,
}

impl Parting {
    /// Finds the parts, of `parts` equal ones, in which trajectory `own` moves most differently from trajectory `best`; `None`
    /// if they move alike.
    pub(super) fn of(common: &Common<'_>, own: usize, best: usize, parts: usize) -> Option<Self> {
        let constant = Constant::between(common, own, best);
        let (own, best) = (&common.poses[own], &common.poses[best]);
        let last = common.scans.len() - 1;
        let by = |[from, to]: [usize; 2]| {
            let [a, b] = [own, best].map(|poses| seen_from(&poses[from], &poses[to]));
            [libm::hypot(a[0] - b[0], a[1] - b[1]), libm::fabs(half_turn(a[2] - b[2]))]
        };
        // Up to the first scan of the next part, so that no step is left out.
        let ends = blocks(common.scans.len(), parts).map(|scans| [scans.start, scans.end.min(last)]);
        let parts: Vec<_> = ends.map(|ends| (ends, by(ends))).collect();
        let sum = |of: usize| parts.iter().map(|(_, by)| by[of]).sum();
        let weight = |[metres, radians]: [f64; 2]| metres + LEVER * radians;
        let all: f64 = parts.iter().map(|&(_, by)| weight(by)).sum();
        let part = |([from, to], by): ([usize; 2], [f64; 2])| {
            let positions = &best[from..=to];
            let place = [0, 1].map(|axis: usize| {
                positions.iter().map(|pose| pose.position()[axis]).sum::<f64>() / positions.len() as f64
            });
            let times = [from, to].map(|scan| common.scans[scan].time() - common.scans[0].time());
            Part { times, place, by, share: weight(by) / all }
        };
        let mut most: Vec<_> = parts.iter().copied().map(part).collect();
        // Of equal ones the first first.
        most.sort_by(|a, b| b.share.total_cmp(&a.share));
        let outstanding = outstanding(&most.iter().map(|part| part.share).collect::<Vec<_>>());
        most.truncate(outstanding.max(1));
        (all > 0.0).then(|| Self {
            most,
            stand_out: outstanding > 0,
            parts: parts.len(),
            all: [sum(0), sum(1)],
            constant,
        })
    }

    /// Returns the values of JSON, a record a part.
    pub(super) fn records(&self) -> Vec<Record> {
        self.most.iter().map(Part::record).collect()
    }

    /// Says in words where the trajectory parts from that of the name `best`.
    pub(super) fn in_words(&self, best: &str) -> String {
        let Self { most, stand_out, parts, all, constant } = self;
        let why = constant.as_ref().map(|constant| format!("; {}", constant.in_words()));
        let share = 100.0 * most.iter().map(|part| part.share).sum::<f64>();
        if !stand_out {
            let [metres, degrees] = [all[0], all[1].to_degrees()];
            let why = why.unwrap_or_else(|| "; it drifts, or look at the clock and at --mount".to_owned());
            return format!(
                "moves differently from {best} all along the log: by {metres:.2} m and {degrees:.1} degrees, added up over its \
                 {parts} parts, none of which has more than {share:.0} % of that{why}"
            );
        }
        let why = why.unwrap_or_default();
        if let [part] = &most[..] {
            return format!(
                "moves differently from {best} most {}, {share:.0} % of all that the {parts} parts of the log differ by{why}",
                part.in_words()
            );
        }
        let named: Vec<_> = most.iter().take(NAMED).map(Part::in_words).collect();
        let more = most.len() - named.len();
        let more = if more > 0 { format!("; and in {more} more") } else { String::new() };
        format!(
            "moves differently from {best} most in {} of the {parts} parts of the log, which have {share:.0} % of all that these \
             differ by: {}{more}{why}",
            most.len(),
            named.join("; ")
        )
    }
}

/// Returns how many of these shares, which descend, stand out from those that follow: few, or 0.
fn outstanding(shares: &[f64]) -> usize {
    let stand_out = |&count: &usize| {
        let (most, others) = shares.split_at(count);
        let next = others.first().copied().unwrap_or_default();
        let mean = others.iter().sum::<f64>() / others.len().max(1) as f64;
        most.last().is_some_and(|&least| least >= STANDS_OUT * mean && least >= APART * next)
    };
    (1..=(shares.len() / FEW).max(1)).rev().find(stand_out).unwrap_or(0)
}

impl Part {
    fn record(&self) -> Record {
        let Self { times: [from, to], place: [x, y], by: [metres, radians], share } = *self;
        Record::computed([
            ("from_s", from),
            ("to_s", to),
            ("x_m", x),
            ("y_m", y),
            ("distance_m", metres),
            ("turn_rad", radians),
            ("share", share),
        ])
    }

    fn in_words(&self) -> String {
        let Self { times: [from, to], place: [x, y], by: [metres, radians], .. } = self;
        format!(
            "from {from:.1} to {to:.1} s after the first scan, there about x {x:.1} m, y {y:.1} m: by {metres:.2} m, seen from its \
             heading at the start, and {:.1} degrees",
            radians.to_degrees()
        )
    }
}
