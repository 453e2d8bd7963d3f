//! The scans for which every trajectory has a pose: only maps of the same scans can be compared.

use crate::failure::Failure;
use mean_information::scan::Pose;
use mean_information_files::Trajectory;
use mean_information_files::scans::{NoReturn, RangeScan, Reading};
use std::path::PathBuf;

/// A trajectory that is compared.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The name: of its file, or what the log calls it.
    pub name: String,
    /// The file that it was read from.
    pub file: PathBuf,
    /// The poses of the laser.
    pub trajectory: Trajectory,
    /// The warnings of its reader.
    pub warnings: Vec<String>,
}

/// The scans for which every trajectory has a pose, and these poses.
#[derive(Clone, Debug)]
pub struct Common<'a> {
    /// The scans, in the order of their times.
    pub scans: Vec<&'a RangeScan>,
    /// The poses of the laser by each trajectory, one for each scan.
    pub poses: Vec<Vec<Pose>>,
    /// The number of scans without a pose, of each trajectory.
    pub without_pose: Vec<usize>,
    /// The number of scans no beam of which says anything, whether or not they have poses.
    pub silent: usize,
    /// The number of beams that say something.
    pub beams: u64,
    /// The longest of them, in metres.
    pub reach: f64,
    /// The number of poses that are interpolated between two further apart than [`Self::GAP`], of each trajectory.
    pub stretched: Vec<usize>,
}

impl<'a> Common<'a> {
    /// The longest time between two poses that are interpolated, in seconds, unless another is asked for.
    pub const GAP: f64 = 1.0;

    /// Finds the scans for which every candidate has a pose, and these poses; between two poses no further apart than `max_gap` seconds poses are interpolated.
    ///
    /// # Errors
    /// A trajectory that has no time in common with the scans; no scan left.
    pub fn of(
        scans: &'a [RangeScan],
        candidates: &[Candidate],
        max_gap: f64,
        no_return: NoReturn,
    ) -> Result<Self, Failure> {
        let times: Vec<_> = scans.iter().map(RangeScan::time).collect();
        let mut associated = Vec::with_capacity(candidates.len());
        for Candidate { file, trajectory, .. } in candidates {
            let found = trajectory.at_times(&times, max_gap);
            associated.push(found.map_err(|error| Failure::from(error.in_file(file)))?);
        }
        let without_pose = associated.iter().map(|found| found.without_pose).collect();
        let mut common = Self {
            scans: Vec::new(),
            poses: vec![Vec::new(); candidates.len()],
            without_pose,
            silent: 0,
            beams: 0,
            reach: 0.0,
            stretched: vec![0; candidates.len()],
        };
        for (index, scan) in scans.iter().enumerate() {
            let (beams, reach) = telling(scan, no_return);
            common.silent += usize::from(beams == 0);
            let poses: Option<Vec<Pose>> = associated.iter().map(|found| found.poses[index]).collect();
            let Some(poses) = poses.filter(|_| beams > 0) else { continue };
            common.scans.push(scan);
            common.beams += beams;
            common.reach = common.reach.max(reach);
            for (stretched, Candidate { trajectory, .. }) in common.stretched.iter_mut().zip(candidates) {
                *stretched += usize::from(trajectory.pose_at(scan.time(), Self::GAP).is_none());
            }
            for (own, pose) in common.poses.iter_mut().zip(poses) {
                own.push(pose);
            }
        }
        Ok(common)
    }
}

/// Counts the beams of a scan that say something, and finds how far they reach, in metres.
fn telling(scan: &RangeScan, no_return: NoReturn) -> (u64, f64) {
    let [_, farthest] = scan.limits();
    let reach = |reading| match reading {
        Reading::Return(range) => Some(range),
        Reading::NoReturn => (no_return == NoReturn::Free).then_some(farthest),
        Reading::Invalid => None,
    };
    scan.readings().filter_map(reach).fold((0, 0.0), |(count, most), range| (count + 1, range.max(most)))
}

/// Finds the pose that is furthest from the middle, the medians of x and of y; returns its number, and the distance in metres.
pub fn far_pose(poses: &[Pose]) -> (usize, f64) {
    let middle = [0, 1].map(|axis: usize| {
        let mut along: Vec<_> = poses.iter().map(|pose| pose.position()[axis]).collect();
        along.sort_by(f64::total_cmp);
        along.get(along.len() / 2).copied().unwrap_or(0.0)
    });
    let distance = |pose: &Pose| {
        let [x, y] = pose.position();
        libm::hypot(x - middle[0], y - middle[1])
    };
    let distances = poses.iter().map(distance).enumerate();
    distances.max_by(|(_, a), (_, b)| a.total_cmp(b)).unwrap_or((0, 0.0))
}
