//! A bag as a log of scans: which topic, where the laser is on the robot, which trajectories.

use super::delivery::Visitor;
use super::read::read_bag;
use super::recording::{Poses, Recording};
use super::scan::ScanMessage;
use super::stamped::POSE_KINDS;
use super::transforms::Transforms;
use crate::error::{Error, ErrorKind};
use crate::options::Options;
use crate::scans::{Frame, RangeScan, RecordedTrajectory, ScanLog, ScanOptions, Selection};
use crate::trajectory::{Rigid, Tilts, Trajectory};
use crate::warning::Warning;
use mean_information::scan::Pose;
use std::path::Path;

/// The frames whose trajectories are taken unless others are named (REP 105).
const FRAMES: [&str; 2] = ["map", "odom"];
/// The tilt of a laser, in degrees, above which it is told.
const FLAT: f64 = 1.0;

/// Reads the scans of the bag at `path` on the disk, with the trajectories that `selection` names, by the stamps of the
/// messages.
///
/// A frame of TF gives the poses of the robot in it at the times of the scans, each step of TF interpolated as a
/// [`Trajectory`] is; a topic of poses gives its own. The mount is what `/tf_static` says of the laser; a laser that is
/// mounted upside down has its bearings turned. Transforms lie in space, and their tilt is dropped at the end.
///
/// # Errors
/// An [`Error`] of kind [`ErrorKind::Choice`] that lists what the bag holds where a topic or a frame must be named, or
/// TF does not connect two frames; where no scan has a pose; where a clock jumps back; or as
/// [`read_bag`](super::read_bag).
pub fn read_scans(path: &Path, options: &ScanOptions, selection: &Selection) -> Result<ScanLog, Error> {
    let read = |visitor: &mut dyn Visitor| read_bag(path, &Options::default(), visitor);
    let mut log = scans_of(read, options, selection).map_err(|error| error.in_file(path))?;
    log.files.push(path.to_owned());
    Ok(log)
}

/// Reads the scans of a bag, whose messages `read` hands to a visitor: as [`read_scans`].
///
/// # Errors
/// As [`read_scans`].
pub fn scans_of(
    read: impl FnOnce(&mut dyn Visitor) -> Result<Vec<Warning>, Error>,
    options: &ScanOptions,
    selection: &Selection,
) -> Result<ScanLog, Error> {
    let mut recording = Recording::new(options, selection);
    let mut warnings = read(&mut recording)?;
    let topic = topic(&recording, selection)?;
    for name in &selection.pose_topics {
        if !recording.pose_topics.contains(name) {
            let words = format!("has no topic {name} of type {}", POSE_KINDS.join(", "));
            return Err(choice(words, "; topics of its poses are: ", &recording.pose_topics));
        }
    }
    let Some(laser) = recording.laser.take().filter(|_| !recording.scans.is_empty()) else {
        return Err(Error::new(ErrorKind::Format, format!("has no scan on topic {topic}")).with_value(topic));
    };
    let transforms = transforms_of(&mut recording, &topic);
    let base = match &selection.base {
        Some(base) => base.strip_prefix('/').unwrap_or(base),
        None => transforms.fixed_under(&laser)?,
    };
    let robot = Robot { transforms: &transforms, base, selection };
    let mounted = robot.mount(&laser)?;
    let mut scans = recording.scans;
    let mut mount = selection.mount;
    if let Some(laser) = mounted {
        let tilt = laser.turn.tilt();
        if tilt > 90.0 {
            scans = scans.into_iter().map(RangeScan::upside_down).collect();
        }
        let degrees = tilt.min(180.0 - tilt);
        if degrees > FLAT {
            warnings.push(Warning::LaserTilted { degrees });
        }
        mount = Some(laser.in_plane(&mut Tilts::default())?);
    }
    let mut trajectories = robot.in_frames(&scans)?;
    for name in &selection.pose_topics {
        let poses = recording.poses.remove(name).unwrap_or_default();
        trajectories.push(robot.by_topic(name, &poses)?);
    }
    let counted = [
        (recording.same_time, Warning::ScansAtOneTime { count: recording.same_time }),
        (recording.empty, Warning::ScansWithoutBeams { count: recording.empty }),
        (transforms.unsound, Warning::TransformsUnsound { count: transforms.unsound }),
    ];
    warnings.extend(counted.into_iter().filter(|&(count, _)| count > 0).map(|(_, warning)| warning));
    if recording.duration > 0.0 {
        warnings.push(Warning::BeamsApart { seconds: recording.duration });
    }
    Ok(ScanLog { scans, trajectories, mount, warnings, files: Vec::new() })
}

/// Returns the topic of scans that is meant.
fn topic(recording: &Recording<'_>, selection: &Selection) -> Result<String, Error> {
    let refuse = |words: String| Err(choice(words, "; topics of its scans are: ", &recording.scan_topics));
    match (&recording.topic, &selection.topic) {
        (Some(topic), Some(_)) => Ok(topic.clone()),
        (None, Some(wanted)) => refuse(format!("has no topic {wanted} of type {}", ScanMessage::KIND)),
        (Some(topic), None) if recording.scan_topics.len() == 1 => Ok(topic.clone()),
        (Some(_), None) => refuse("has several topics of scans".to_owned()),
        (None, None) => refuse(format!("has no topic of type {}", ScanMessage::KIND)),
    }
}

/// Creates the error of a choice among names.
fn choice<'a>(words: String, joint: &str, names: impl IntoIterator<Item = &'a String>) -> Error {
    let names: Vec<&str> = names.into_iter().map(String::as_str).collect();
    let listed = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
    Error::new(ErrorKind::Choice, words).allowing(joint, listed)
}

/// Takes the transforms of the longest namespace that the topic of the scans lies in.
fn transforms_of(recording: &mut Recording<'_>, topic: &str) -> Transforms {
    let holds = |namespace: &str| {
        namespace.is_empty() || topic.strip_prefix(namespace).is_some_and(|rest| rest.starts_with('/'))
    };
    let all = std::mem::take(&mut recording.transforms).into_iter();
    let own = all.filter(|(namespace, _)| holds(namespace)).max_by_key(|(namespace, _)| namespace.len());
    let mut own = own.map(|(_, transforms)| transforms).unwrap_or_default();
    own.sort();
    own
}

/// The robot: its frame among those of TF.
struct Robot<'a> {
    transforms: &'a Transforms,
    base: &'a str,
    selection: &'a Selection,
}

impl Robot<'_> {
    /// Returns the pose of the laser on the robot by TF, unless it is given or none is needed.
    fn mount(&self, laser: &str) -> Result<Option<Rigid>, Error> {
        if self.selection.mount.is_some() || laser == self.base {
            return Ok(None);
        }
        self.fixed(laser, self.base, "the laser is there").map(Some)
    }

    /// Returns the pose of a frame in another in which it does not move.
    fn fixed(&self, from: &str, to: &str, what: &str) -> Result<Rigid, Error> {
        if let Some(pose) = self.transforms.way(from, to)?.fixed() {
            return Ok(pose);
        }
        let words = format!("TF moves {from} in {to}, so that it does not say where {what}");
        Err(Error::new(ErrorKind::Unsupported, words)
            .with_value(to)
            .allowing("; allowed are ", "frames of /tf_static"))
    }

    /// Returns the pose of the robot on the frame of which the poses of a topic are; `None` if that frame is the robot's: where
    /// TF does not connect it and the mount is given, which is on what the poses are of.
    fn on(&self, child: &str, topic: &str) -> Result<Option<Rigid>, Error> {
        match self.transforms.way(self.base, child) {
            Err(_) if self.selection.mount.is_some() => Ok(None),
            _ => self
                .fixed(self.base, child, &format!("the robot is, as {topic} has poses of {child}"))
                .map(Some),
        }
    }

    /// Returns the trajectories of the robot in the frames that are wanted, at the times of the scans.
    fn in_frames(&self, scans: &[RangeScan]) -> Result<Vec<RecordedTrajectory>, Error> {
        let frames: Vec<&str> = if let Some(frames) = &self.selection.frames {
            frames.iter().map(|name| name.strip_prefix('/').unwrap_or(name)).collect()
        } else {
            let over = self.transforms.over(self.base)?;
            let own: Vec<&str> = FRAMES.into_iter().filter(|name| over.contains(name)).collect();
            if own.is_empty() {
                let words = format!("TF has neither map nor odom over {}", self.base);
                let frames: Vec<String> = over[1..].iter().map(|&name| name.to_owned()).collect();
                return Err(choice(words, "; the frames over it are: ", &frames));
            }
            own
        };
        frames.into_iter().map(|frame| self.in_frame(frame, scans)).collect()
    }

    /// Returns the trajectory of the robot in a frame at the times of the scans.
    fn in_frame(&self, frame: &str, scans: &[RangeScan]) -> Result<RecordedTrajectory, Error> {
        let way = self.transforms.way(self.base, frame)?;
        let mut tilts = Tilts::default();
        let (mut times, mut poses) = (Vec::new(), Vec::new());
        for scan in scans {
            if let Some(pose) = way.at(scan.time(), self.selection.max_gap)? {
                times.push(scan.time());
                poses.push(pose.in_plane(&mut tilts)?);
            }
        }
        if times.is_empty() {
            let [first, last] = [&scans[0], &scans[scans.len() - 1]].map(RangeScan::time);
            let spans = way.span().map_or("nothing".to_owned(), |[from, to]| format!("{from} to {to} s"));
            let words = format!(
                "TF has no pose of {} in {frame} at the time of a scan: the scans span {first} to {last} s, TF spans {spans}",
                self.base
            );
            return Err(Error::new(ErrorKind::OutOfRange, words).with_value(spans));
        }
        let trajectory = Trajectory::new(times, poses)?;
        let warnings = tilts.warning().into_iter().collect();
        Ok(RecordedTrajectory { name: frame.to_owned(), frame: Frame::Robot, trajectory, warnings })
    }

    /// Returns the trajectory of the robot that a topic has.
    fn by_topic(&self, name: &str, poses: &Poses) -> Result<RecordedTrajectory, Error> {
        let own = match poses.child.as_deref() {
            Some(child) if child != self.base => self.on(child, name)?,
            _ => None,
        };
        let mut tilts = Tilts::default();
        let in_plane = |pose: &Rigid| -> Result<Pose, Error> {
            own.map_or(*pose, |own| pose.compose(&own)).in_plane(&mut tilts)
        };
        let in_plane: Vec<Pose> = poses.rigid.iter().map(in_plane).collect::<Result<_, _>>()?;
        if in_plane.is_empty() {
            return Err(
                Error::new(ErrorKind::Format, format!("has no pose on topic {name}")).with_value(name)
            );
        }
        let trajectory = Trajectory::new(poses.times.clone(), in_plane)?;
        let mut warnings: Vec<Warning> = tilts.warning().into_iter().collect();
        if poses.same_time > 0 {
            warnings.push(Warning::PosesAtOneTime { count: poses.same_time });
        }
        Ok(RecordedTrajectory { name: name.to_owned(), frame: Frame::Robot, trajectory, warnings })
    }
}
