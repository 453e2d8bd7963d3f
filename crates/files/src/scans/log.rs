//! A whole log: its scans, and the trajectories that it holds.

use super::carmen;
use super::options::ScanOptions;
use super::range_scan::RangeScan;
use crate::error::{Error, ErrorKind};
use crate::trajectory::Trajectory;
use crate::warning::Warning;
use mean_information::scan::Pose;
use std::path::PathBuf;

/// The scans of a log, in the order of their times, and what else it holds.
#[derive(Clone, Debug)]
pub struct ScanLog {
    /// The scans: one or more, their times ascend.
    pub scans: Vec<RangeScan>,
    /// The trajectories that the log holds, by their names: of a CARMEN log "laser" and "odometry", of a saved state "local"
    /// and "global", of a bag those of the frames and topics that were asked for.
    pub trajectories: Vec<RecordedTrajectory>,
    /// The pose of the laser in the frame of the robot, where the log says so.
    pub mount: Option<Pose>,
    /// The signs that the log means less than it seems.
    pub warnings: Vec<Warning>,
    /// The files it was read from, so that no output overwrites one.
    pub files: Vec<PathBuf>,
}

/// A trajectory that a log holds.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordedTrajectory {
    /// The name.
    pub name: String,
    /// The frame of its poses.
    pub frame: Frame,
    /// The poses by their times.
    pub trajectory: Trajectory,
    /// The signs that it means less than it seems.
    pub warnings: Vec<Warning>,
}

/// The frame whose poses a trajectory has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// The laser itself: scans are inserted at these poses.
    Laser,
    /// The robot: [`Trajectory::mounted`] gives the poses of the laser.
    Robot,
}

impl ScanLog {
    /// Reads a CARMEN log whole.
    ///
    /// ```
    /// use mean_information_files::scans::{ScanLog, ScanOptions};
    ///
    /// let line = "ROBOTLASER1 0 -0.5 1.0 0.5 20 0.01 0 3 2.25 20 1.75 0 0.25 0 0 0.125 0 0 0 0 0 0 0 7.5 robot 0.1\n";
    /// let log = ScanLog::read_carmen(line.as_bytes(), &ScanOptions::default())?;
    /// assert_eq!((log.scans[0].time(), log.scans[0].ranges()), (7.5, &[2.25, 20.0, 1.75][..]));
    /// assert_eq!(log.mount.unwrap().position(), [0.125, 0.0]);
    /// let names: Vec<_> = log.trajectories.iter().map(|held| held.name.as_str()).collect();
    /// assert_eq!(names, ["laser", "odometry"]);
    /// # Ok::<(), mean_information_files::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`carmen::Records`]; or an [`Error`] if there is no scan.
    pub fn read_carmen(input: impl std::io::BufRead, options: &ScanOptions) -> Result<Self, Error> {
        let mut records = carmen::Records::new(input, options);
        let mut scans = Vec::new();
        while let Some(record) = records.next().transpose()? {
            if let carmen::Record::Scan(scan) = record {
                scans.push(scan);
            }
        }
        let warnings = records.warnings();
        if scans.is_empty() {
            let mut refused = Error::new(ErrorKind::Format, "holds no scan");
            for warning in warnings {
                refused = refused.followed_by(&format!(": {warning}"));
            }
            return Err(refused.allowing("; allowed are ", "CARMEN logs with FLASER or ROBOTLASER1"));
        }
        let trajectories = [
            ("laser", Frame::Laser, RangeScan::laser as fn(&RangeScan) -> Option<&Pose>),
            ("odometry", Frame::Robot, RangeScan::odometry),
        ];
        let mut held = Vec::new();
        for (name, frame, pose) in trajectories {
            let (mut times, mut poses) = (Vec::new(), Vec::new());
            for scan in &scans {
                if let Some(&pose) = pose(scan) {
                    times.push(scan.time());
                    poses.push(pose);
                }
            }
            if !times.is_empty() {
                let trajectory = Trajectory::new(times, poses)?;
                let (name, warnings) = (name.to_owned(), Vec::new());
                held.push(RecordedTrajectory { name, frame, trajectory, warnings });
            }
        }
        Ok(Self { scans, trajectories: held, mount: records.mount(), warnings, files: Vec::new() })
    }

    /// Returns the times of the scans, ascending, in seconds.
    pub fn times(&self) -> Vec<f64> {
        self.scans.iter().map(RangeScan::time).collect()
    }
}
