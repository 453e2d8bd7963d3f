//! The poses at the times of scans: the nearest two in time, and what lies between them.

use super::poses::Trajectory;
use crate::error::{Error, ErrorKind};
use mean_information::scan::Pose;
use std::f64::consts::TAU;

/// The poses of a trajectory at the times of scans.
#[derive(Clone, Debug, PartialEq)]
pub struct Association {
    /// The pose at each time; `None` where the trajectory has none.
    pub poses: Vec<Option<Pose>>,
    /// The number of times without a pose.
    pub without_pose: usize,
}

impl Trajectory {
    /// Returns the pose at a time, in seconds.
    ///
    /// At a time of the trajectory it is the pose of that time. Between two that are no more than `max_gap` seconds apart
    /// it is their interpolation by `s = (t - t₀) / (t₁ - t₀)`: of the position, and of the yaw along the shorter way
    /// round. Otherwise, and beyond both ends, it is `None`: nothing is extrapolated.
    pub fn pose_at(&self, time: f64, max_gap: f64) -> Option<Pose> {
        let after = self.times().partition_point(|&own| own < time);
        if self.times().get(after) == Some(&time) {
            return Some(self.poses()[after]);
        }
        let before = after.checked_sub(1)?;
        let [start, end] = [*self.times().get(before)?, *self.times().get(after)?];
        let inside = start < time && time < end && end - start <= max_gap;
        inside.then(|| between(&self.poses()[before], &self.poses()[after], part(time, start, end)))?
    }

    /// Returns the poses at the times of scans, in seconds, as [`Self::pose_at`].
    ///
    /// # Errors
    /// An [`Error`] with both spans if no time lies within this trajectory.
    pub fn at_times(&self, times: &[f64], max_gap: f64) -> Result<Association, Error> {
        let [start, end] = self.span();
        if !times.iter().any(|time| (start..=end).contains(time)) {
            let least = times.iter().copied().reduce(f64::min).unwrap_or(f64::NAN);
            let greatest = times.iter().copied().reduce(f64::max).unwrap_or(f64::NAN);
            return Err(apart([least, greatest], self.span()));
        }
        let poses: Vec<_> = times.iter().map(|&time| self.pose_at(time, max_gap)).collect();
        let without_pose = poses.iter().filter(|pose| pose.is_none()).count();
        Ok(Association { poses, without_pose })
    }
}

/// Returns the part of the way from `start` to `end` at which `time` is; halved, as a difference may overflow.
pub(crate) fn part(time: f64, start: f64, end: f64) -> f64 {
    (0.5 * time - 0.5 * start) / (0.5 * end - 0.5 * start)
}

/// Interpolates two poses; `None` never for finite poses.
fn between(start: &Pose, end: &Pose, part: f64) -> Option<Pose> {
    let ([x0, y0], [x1, y1]) = (start.position(), end.position());
    let mean = |from: f64, to: f64| (1.0 - part) * from + part * to;
    // The turn in [-π, π]: remainders are exact, so that only TAU is rounded.
    let turned = |theta: f64| libm::remainder(theta, TAU);
    let turn = turned(turned(end.theta()) - turned(start.theta()));
    Pose::new(mean(x0, x1), mean(y0, y1), start.theta() + part * turn).ok()
}

/// Creates the error of a log and a trajectory that have no time in common.
fn apart(log: [f64; 2], own: [f64; 2]) -> Error {
    let span = |[from, to]: [f64; 2]| format!("{from} to {to} s");
    let message = format!("the trajectory spans {}, the scans span {}", span(own), span(log));
    Error::new(ErrorKind::OutOfRange, message)
        .with_value(span(own))
        .allowing("; allowed are ", "times in common, on one clock")
}
