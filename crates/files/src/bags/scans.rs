//! A bag as a log of scans: which topic, where the laser is on the robot, which trajectories.

use super::delivery::Visitor;
use super::folder::bag_files;
use super::read::read_bag;
use super::recording::Recording;
use super::refusals::{choice, unstamped};
use super::robot::{InSpace, Robot};
use super::scan::ScanMessage;
use super::stamped::POSE_KINDS;
use super::transforms::Transforms;
use crate::error::{Error, ErrorKind};
use crate::options::Options;
use crate::scans::{RangeScan, ScanLog, ScanOptions, Selection};
use crate::trajectory::Tilts;
use crate::warning::Warning;
use std::path::Path;

/// The tilt of a laser, in degrees, above which it is told.
const FLAT: f64 = 1.0;

/// Reads the scans of the bag at `path` on the disk, with the trajectories that `selection` names, by the stamps of the
/// messages.
///
/// A frame of TF gives the poses of the robot in it at the times of the scans, each step of TF interpolated as a
/// [`Trajectory`](crate::Trajectory) is; a topic of poses gives its own. The mount is what `/tf_static` says of the laser; where
/// nothing carries the laser without moving, the poses are those of the laser itself ([`Frame::Laser`](crate::scans::Frame)).
/// A laser that TF has upside down, or `selection`, has its bearings turned. Transforms lie in space, and their tilt is
/// dropped at the end.
///
/// # Errors
/// An [`Error`] of kind [`ErrorKind::Choice`] that lists what the bag holds where a topic or a frame must be named, or
/// TF does not connect two frames; where no scan has a pose; where a clock jumps back or no message is stamped; where the
/// laser turns over; or as [`read_bag`](super::read_bag).
pub fn read_scans(path: &Path, options: &ScanOptions, selection: &Selection) -> Result<ScanLog, Error> {
    let read = |visitor: &mut dyn Visitor| read_bag(path, &Options::default(), visitor);
    let mut log = scans_of(read, options, selection).map_err(|error| error.in_file(path))?;
    log.files = bag_files(path)?;
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
            return Err(choice("pose-topics", words, "; topics of its poses are: ", &recording.pose_topics));
        }
    }
    let Some(laser) = recording.laser.take().filter(|_| !recording.scans.is_empty()) else {
        return Err(Error::new(ErrorKind::Format, format!("has no scan on topic {topic}")).with_value(topic));
    };
    stamped(&recording, &topic)?;
    let transforms = transforms_of(&mut recording, &topic);
    let base = match &selection.base {
        Some(base) => base.strip_prefix('/').unwrap_or(base),
        None => transforms.fixed_under(&laser)?,
    };
    let robot = Robot { transforms: &transforms, base, laser: &laser, selection };
    let mut scans = std::mem::take(&mut recording.scans);
    let mounted = robot.mount()?;
    let mut held = robot.in_frames(&scans)?;
    for name in &selection.pose_topics {
        held.push(robot.by_topic(name, recording.poses.remove(name).unwrap_or_default())?);
    }
    if robot.is_upside_down(&scans, &held)? {
        scans = scans.into_iter().map(RangeScan::upside_down).collect();
    }
    let mut mount = selection.mount;
    if let Some(laser) = mounted {
        let tilt = laser.turn.tilt();
        let degrees = tilt.min(180.0 - tilt);
        if degrees > FLAT {
            warnings.push(Warning::LaserTilted { degrees });
        }
        mount = Some(laser.in_plane(&mut Tilts::default())?);
    }
    let trajectories = held.into_iter().map(InSpace::in_plane).collect::<Result<_, _>>()?;
    warnings.extend(robot.frames_of_two_kinds());
    let counted = [
        (recording.same_time, Warning::ScansAtOneTime { count: recording.same_time }),
        (recording.empty, Warning::ScansWithoutBeams { count: recording.empty }),
        (recording.limitless, Warning::NoGreatestRange { count: recording.limitless }),
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
    let refuse =
        |words: String| Err(choice("topic", words, "; topics of its scans are: ", &recording.scan_topics));
    match (&recording.topic, &selection.topic) {
        (Some(topic), Some(_)) => Ok(topic.clone()),
        (None, Some(wanted)) => refuse(format!("has no topic {wanted} of type {}", ScanMessage::KIND)),
        (Some(topic), None) if recording.scan_topics.len() == 1 => Ok(topic.clone()),
        (Some(_), None) => refuse("has several topics of scans".to_owned()),
        (None, None) => refuse(format!("has no topic of type {}", ScanMessage::KIND)),
    }
}

/// Refuses scans none of which has a time.
fn stamped(recording: &Recording<'_>, topic: &str) -> Result<(), Error> {
    match &*recording.scans {
        [scan] if scan.time() == 0.0 && recording.same_time > 0 => Err(unstamped("scans", topic)),
        _ => Ok(()),
    }
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
