//! What the robot records as it drives through a room and back: its scans, where it was, and where its odometry believes
//! that it was.

use super::{Random, Room, Scanner, trajectory};
use mean_information::scan::Pose;
use mean_information_files::scans::{Bearings, RangeScan};
use mean_information_files::{Error, Trajectory};
use std::f64::consts::TAU;

/// The seconds from a scan to the next.
const INTERVAL: f64 = 0.5;

/// The parts of a metre or of a radian that poses have: micrometres.
const POSE_PARTS: f64 = 1e6;

/// The parts of a metre that ranges have: millimetres.
const RANGE_PARTS: f64 = 1e3;

/// A recorded drive. Poses are in micrometres and microradians, ranges in millimetres, so that a text has them whole.
#[derive(Clone, Debug)]
pub struct Recording {
    /// The scans, each with the true pose of the laser and that of the robot by odometry.
    pub scans: Vec<RangeScan>,
    /// The true poses.
    pub truth: Trajectory,
    /// The poses by odometry.
    pub odometry: Trajectory,
}

impl Recording {
    /// Records `count` scans, one or more, at equal distances along the route of a room to its end and back, half a second
    /// apart. Seeds, and hence noise, are other ones than those of [`Journey::through`](super::Journey::through).
    ///
    /// # Errors
    /// A drift that is negative, not finite, or too large for a pose; no scan.
    pub fn through(
        room: &Room,
        scanner: &Scanner,
        count: usize,
        drift: f64,
        seed: u64,
    ) -> Result<Self, Error> {
        let mut seeds = Random::new(seed);
        // The first two are the journey's.
        let [_, _, mut noise, mut odometry] = [(); 4].map(|()| seeds.fork());
        let there = room.route.iter().copied();
        let route: Vec<_> = there.clone().chain(there.rev().skip(1)).collect();
        let exact = trajectory::along(&route, count)?;
        let poses = exact.iter().map(written).collect::<Result<Vec<_>, _>>()?;
        let believed = trajectory::drifted(&poses, drift, &mut odometry)?;
        let believed = believed.iter().map(written).collect::<Result<Vec<_>, _>>()?;
        let times: Vec<_> = (0..count).map(|k| INTERVAL * k as f64).collect();

        let mut scans = Vec::with_capacity(count);
        for (&time, (&pose, &robot)) in times.iter().zip(poses.iter().zip(&believed)) {
            let ranges = scanner.ranges(room, &pose, &mut noise)?;
            let ranges = ranges.into_iter().map(|range| scanner.recorded(range)).collect();
            let bearings = Bearings::Even { start: 0.0, increment: TAU / f64::from(scanner.beams) };
            let scan = RangeScan::new(time, bearings, ranges, [0.0, scanner.maximum_range])?;
            scans.push(scan.with_laser(pose).with_odometry(robot));
        }
        let truth = Trajectory::new(times.clone(), poses)?;
        Ok(Self { scans, truth, odometry: Trajectory::new(times, believed)? })
    }
}

impl Scanner {
    /// Returns a range as a log has it: the maximum range for no return, 0 for one that is lost.
    fn recorded(&self, range: f64) -> f64 {
        rounded(range, RANGE_PARTS).clamp(0.0, self.maximum_range)
    }
}

/// Returns a pose as a log has it, its heading within half a turn of 0.
fn written(pose: &Pose) -> Result<Pose, mean_information::Error> {
    let [x, y] = pose.position().map(|metres| rounded(metres, POSE_PARTS));
    Pose::new(x, y, rounded(libm::remainder(pose.theta(), TAU), POSE_PARTS))
}

/// Returns a number in parts of a unit; one so large that it has no such parts as it is.
fn rounded(x: f64, parts: f64) -> f64 {
    let scaled = x * parts;
    if scaled.abs() < (1_u64 << 52) as f64 { scaled.round() / parts } else { x }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::RoomName;

    #[test]
    fn the_robot_comes_back_and_believes_that_it_is_elsewhere() {
        let scanner = Scanner { beams: 24, maximum_range: 4.5, noise: 0.05 };
        let room = RoomName::Study.room();
        let made = |drift| Recording::through(&room, &scanner, 41, drift, 5).unwrap();
        let recording = made(0.02);
        let ends = |trajectory: &Trajectory| [0, 40].map(|k: usize| trajectory.poses()[k].position());
        assert_eq!(ends(&recording.truth), [[1.3, 1.1]; 2]);
        let [start, end] = ends(&recording.odometry);
        assert_eq!(start, [1.3, 1.1]);
        assert!(libm::hypot(end[0] - start[0], end[1] - start[1]) > 0.02, "{end:?}");
        assert_eq!(recording.truth.span(), [0.0, 20.0]);
        for (k, scan) in recording.scans.iter().enumerate() {
            assert_eq!(
                (scan.laser(), scan.odometry()),
                (recording.truth.poses().get(k), recording.odometry.poses().get(k))
            );
            assert_eq!(scan.ranges().len(), 24);
        }
        // Noise does not depend on the drift, and without one the two are the same.
        let known = made(0.0);
        assert_eq!(known.truth, known.odometry);
        assert_eq!(known.scans[7].ranges(), recording.scans[7].ranges());
    }

    #[test]
    fn what_is_lost_is_0_and_what_does_not_return_is_the_maximum() {
        let scanner = Scanner { beams: 3, maximum_range: 4.5, noise: 0.0 };
        let recorded = [-0.25, 0.0, 1.234_56, 4.499_9, f64::INFINITY].map(|range| scanner.recorded(range));
        assert_eq!(recorded, [0.0, 0.0, 1.235, 4.5, 4.5]);
    }
}
