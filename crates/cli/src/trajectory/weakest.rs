//! Where a trajectory is worst: the block of scans without which it comes nearest to the best one.

use super::common::Common;
use super::measure::Measured;
use mean_information::scan::blocks;

/// The block of scans that speaks most against a trajectory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weakest {
    /// The times of its first and its last scan, in seconds after the first scan of all.
    pub times: [f64; 2],
    /// The mean of its positions, in metres.
    pub place: [f64; 2],
    /// The bits per observed cell by which the trajectory is below the best one: with all scans, and without these.
    pub below: [f64; 2],
}

impl Weakest {
    /// Finds the block of trajectory `own`, which is not the `best`; `None` if leaving out no block brings them nearer.
    pub(super) fn of(common: &Common<'_>, measured: &[Measured], own: usize, best: usize) -> Option<Self> {
        let (own_map, best_map) = (&measured[own], &measured[best]);
        let below = best_map.tally.mean_information() - own_map.tally.mean_information();
        let without = best_map.without.iter().zip(&own_map.without);
        let without = without.map(|(best, own)| best.mean_information() - own.mean_information());
        let (block, least) = without.enumerate().min_by(|(_, a), (_, b)| a.total_cmp(b))?;
        let scans = blocks(common.scans.len(), own_map.without.len()).nth(block)?;
        let poses = common.poses[own].get(scans.clone())?;
        let place = [0, 1].map(|axis: usize| {
            poses.iter().map(|pose| pose.position()[axis]).sum::<f64>() / poses.len() as f64
        });
        let since = |scan: usize| common.scans[scan].time() - common.scans[0].time();
        let times = [since(scans.start), since(scans.end - 1)];
        (least < below).then_some(Self { times, place, below: [below, least] })
    }

    /// Says in words where the trajectory is worst.
    pub(super) fn in_words(&self) -> String {
        let Self { times: [from, to], place: [x, y], below: [all, rest] } = self;
        format!(
            "worst from {from:.1} to {to:.1} s after the first scan, about x {x:.1} m, y {y:.1} m: without these scans it is \
             {rest:.4} below the best, not {all:.4}"
        )
    }
}
