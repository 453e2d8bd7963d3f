//! The nodes of a saved state: scans, each with two poses.

use super::cloud::Cloud;
use super::fields::{Message, WireValue, fields};
use crate::error::{Error, ErrorKind, Place};
use crate::scans::{
    Bearings, FARTHEST, Frame, Kept, RangeScan, RecordedTrajectory, ScanLog, ScanOptions, Selection,
};
use crate::trajectory::{Quaternion, Rigid, Tilts, Trajectory, check_time, seconds};
use crate::warning::Warning;
use mean_information::scan::{Direction, Pose};
use std::collections::BTreeMap;

/// 1970 on Cartographer's clock, which counts steps of 100 nanoseconds since the year 1.
const UNIX_EPOCH: i128 = 621_355_968_000_000_000;
const STEP_NS: i128 = 100;
/// The numbers that a node takes beside its points, and those of a point: in single precision, and as a beam of a scan.
const OF_NODE: usize = 32;
const OF_POINT: usize = 3;
/// The numbers that a pose of the pose graph takes, with the number of its node, twice.
const OF_GLOBAL: usize = 24;
/// The names of the poses that a node has.
const NAMES: [&str; 2] = ["local", "global"];

/// A node, by the numbers of its trajectory and of itself there.
type Id = (u64, u64);

/// The nodes, and the poses that the pose graph gives them.
#[derive(Debug, Default)]
pub(super) struct Nodes {
    matched: BTreeMap<Id, Node>,
    global: BTreeMap<Id, Rigid>,
    pub(super) kept: Kept,
}

/// A node.
#[derive(Debug)]
struct Node {
    time: f64,
    /// The orientation that turns the tracking frame upright.
    upright: Quaternion,
    /// The pose of the tracking frame as it was matched.
    local: Rigid,
    points: Vec<[f32; 2]>,
}

impl Nodes {
    /// Reads a message `Node` of `length` bytes.
    pub(super) fn read_node(&mut self, input: &mut Message<'_>, length: u64) -> Result<(), Error> {
        let [mut trajectory, mut index, mut ticks] = [0; 3];
        let (mut upright, mut local) = (Quaternion::NONE, Rigid::NONE);
        let (mut cloud, mut in_space) = (Cloud::default(), false);
        let kept = &mut self.kept;
        fields(input, length, &mut |number, value, input| match number {
            1 => {
                [trajectory, index] = integers(input, value, [1, 2])?;
                Ok(())
            }
            5 => fields(input, value.length()?, &mut |number, value, input| {
                match number {
                    1 => ticks = value.integer()?,
                    2 => upright = quaternion(input, value)?,
                    3 => cloud = Cloud::read(input, value.length()?, kept)?,
                    4 => in_space = !Cloud::read(input, value.length()?, kept)?.is_empty(),
                    7 => local = rigid(input, value)?,
                    _ => {}
                }
                Ok(())
            }),
            _ => Ok(()),
        })?;
        let of = |error: Error| error.preceded_by(&format!("node {trajectory}, {index}: "));
        if in_space {
            let refused = Error::new(ErrorKind::Unsupported, "is a scan in three dimensions");
            return Err(of(refused.allowing("; allowed are ", "scans in the plane")));
        }
        let points = cloud.in_plane().map_err(of)?;
        let ticks = i128::from(ticks.cast_signed()) - UNIX_EPOCH;
        self.kept.add(OF_NODE + OF_POINT * points.len())?;
        let node = Node { time: seconds(ticks * STEP_NS), upright, local, points };
        if self.matched.insert((trajectory, index), node).is_some() {
            return Err(of(Error::new(ErrorKind::Format, "is there twice")));
        }
        Ok(())
    }

    /// Reads the poses of nodes in a message `PoseGraph` of `length` bytes.
    pub(super) fn read_graph(&mut self, input: &mut Message<'_>, length: u64) -> Result<(), Error> {
        fields(input, length, &mut |number, value, input| {
            if number != 4 {
                return Ok(());
            }
            // The number of the trajectory may stand behind its nodes.
            let (mut trajectory, mut poses) = (0, Vec::new());
            fields(input, value.length()?, &mut |number, value, input| {
                match number {
                    1 => {
                        let (mut index, mut pose) = (0, Rigid::NONE);
                        fields(input, value.length()?, &mut |number, value, input| {
                            match number {
                                5 => pose = rigid(input, value)?,
                                7 => index = value.integer()?,
                                _ => {}
                            }
                            Ok(())
                        })?;
                        self.kept.add(OF_GLOBAL)?;
                        poses.push((index, pose));
                    }
                    3 => trajectory = value.integer()?,
                    _ => {}
                }
                Ok(())
            })?;
            self.global.extend(poses.into_iter().map(|(index, pose)| ((trajectory, index), pose)));
            Ok(())
        })
    }

    /// Returns the nodes as a log.
    pub(super) fn log(self, options: &ScanOptions, selection: &Selection) -> Result<ScanLog, Error> {
        let wanted = self.trajectory(selection)?;
        let names = names(selection)?;
        let greatest = options.maximum_range.unwrap_or(FARTHEST);
        let mount = selection.mount.map_or_else(|| Pose::new(0.0, 0.0, 0.0), Ok)?;
        let mut scans: Vec<RangeScan> = Vec::new();
        let mut held = NAMES.map(|name| (name, Vec::new(), Vec::new(), Tilts::default()));
        let [mut same_time, mut empty] = [0; 2];
        for ((_, index), node) in self.matched.iter().filter(|((trajectory, _), _)| *trajectory == wanted) {
            let of = |error: Error| error.preceded_by(&format!("node {wanted}, {index}: "));
            let before = scans.last().map(RangeScan::time);
            if node.points.is_empty() || before == Some(node.time) {
                if node.points.is_empty() {
                    empty += 1;
                } else {
                    same_time += 1;
                }
                continue;
            }
            check_time(node.time, before).map_err(of)?;
            scans.push(scan(node, &mount, greatest).map_err(of)?);
            // The cloud lies in the tracking frame turned upright, the poses are those of the frame itself.
            let back = Rigid { position: [0.0; 3], turn: node.upright.conjugate() };
            let poses = [Some(&node.local), self.global.get(&(wanted, *index))];
            for ((_, times, own, tilts), pose) in held.iter_mut().zip(poses) {
                if let Some(pose) = pose {
                    times.push(node.time);
                    own.push(pose.compose(&back).in_plane(tilts).map_err(of)?);
                }
            }
        }
        if scans.is_empty() {
            return Err(Error::new(ErrorKind::Format, format!("has no scan in trajectory {wanted}")));
        }
        let mut trajectories = Vec::new();
        for (name, times, poses, tilts) in held {
            if !times.is_empty() && names.contains(&name) {
                let (name, trajectory) = (name.to_owned(), Trajectory::new(times, poses)?);
                let warnings = tilts.warning().into_iter().collect();
                trajectories.push(RecordedTrajectory { name, frame: Frame::Robot, trajectory, warnings });
            }
        }
        let counted = [
            (same_time, Warning::ScansAtOneTime { count: same_time }),
            (empty, Warning::ScansWithoutBeams { count: empty }),
        ];
        let counted = counted.into_iter().filter(|&(count, _)| count > 0).map(|(_, warning)| warning);
        let warnings = std::iter::once(Warning::CloudsThinned).chain(counted).collect();
        Ok(ScanLog { scans, trajectories, mount: selection.mount, warnings, files: Vec::new() })
    }

    /// Returns the number of the trajectory that is meant.
    fn trajectory(&self, selection: &Selection) -> Result<u64, Error> {
        let mut counts = BTreeMap::new();
        for (trajectory, _) in self.matched.keys() {
            *counts.entry(*trajectory).or_insert(0_u64) += 1;
        }
        let words = match (selection.trajectory, counts.len()) {
            (Some(wanted), _) if counts.contains_key(&wanted) => return Ok(wanted),
            (Some(wanted), _) => format!("has no scan of a trajectory {wanted}"),
            (None, 0) => "has no scans: it was saved without nodes".to_owned(),
            (None, 1) => return Ok(counts.into_keys().next().unwrap_or_default()),
            (None, _) => "has scans of several trajectories".to_owned(),
        };
        let listed: Vec<_> =
            counts.iter().map(|(trajectory, count)| format!("{trajectory} ({count} scans)")).collect();
        let listed = if listed.is_empty() { "none".to_owned() } else { listed.join(", ") };
        let refused = Error::new(ErrorKind::Choice, words).at(Place::Option("trajectory"));
        Err(refused.allowing("; its trajectories are: ", listed))
    }
}

/// Returns the names of the poses that are wanted.
fn names(selection: &Selection) -> Result<Vec<&'static str>, Error> {
    let Some(wanted) = &selection.frames else { return Ok(NAMES.to_vec()) };
    let own = |wanted: &String| {
        NAMES.into_iter().find(|name| name == wanted).ok_or_else(|| {
            let words = format!("is a saved state, whose poses have no frame {wanted}");
            let refused = Error::new(ErrorKind::Choice, words).with_value(wanted);
            refused.at(Place::Option("frames")).allowing("; its frames are: ", NAMES.join(", "))
        })
    };
    wanted.iter().map(own).collect()
}

/// Returns the scan of a node by a laser that is mounted at `mount` in the tracking frame.
fn scan(node: &Node, mount: &Pose, greatest: f64) -> Result<RangeScan, Error> {
    let heading = Direction::new(&[mount.theta()])?;
    let [from_x, from_y] = mount.position();
    let polar = |&[x, y]: &[f32; 2]| {
        let (dx, dy) = (f64::from(x) - from_x, f64::from(y) - from_y);
        let ahead = dx * heading.cos() + dy * heading.sin();
        let aside = dy * heading.cos() - dx * heading.sin();
        (libm::atan2(aside, ahead), libm::hypot(ahead, aside))
    };
    let (bearings, ranges): (Vec<f64>, Vec<f64>) = node.points.iter().map(polar).unzip();
    RangeScan::new(node.time, Bearings::Each(bearings.into()), ranges, [0.0, greatest])
}

/// Reads the fields of these numbers, integers, of a message; one that is not there is 0.
fn integers<const N: usize>(
    input: &mut Message<'_>,
    value: WireValue,
    numbers: [u64; N],
) -> Result<[u64; N], Error> {
    let mut found = [0; N];
    fields(input, value.length()?, &mut |number, value, _| {
        if let Some(place) = numbers.iter().position(|&own| own == number) {
            found[place] = value.integer()?;
        }
        Ok(())
    })?;
    Ok(found)
}

/// Reads a message whose fields 1 to `N` are numbers; one that is not there is 0.
fn numbers<const N: usize>(input: &mut Message<'_>, value: WireValue) -> Result<[f64; N], Error> {
    let mut found = [0.0; N];
    fields(input, value.length()?, &mut |number, value, _| {
        let place = usize::try_from(number).ok().and_then(|number| number.checked_sub(1));
        if let Some(place) = place.and_then(|place| found.get_mut(place)) {
            *place = value.double()?;
        }
        Ok(())
    })?;
    Ok(found)
}

/// Reads a message `Quaterniond`.
fn quaternion(input: &mut Message<'_>, value: WireValue) -> Result<Quaternion, Error> {
    let turn = Quaternion(numbers(input, value)?);
    if turn.is_normal() {
        return Ok(turn);
    }
    Err(Error::out_of_range("the length of a quaternion", turn.norm(), "1, within 0.02"))
}

/// Reads a message `Rigid3d`.
fn rigid(input: &mut Message<'_>, value: WireValue) -> Result<Rigid, Error> {
    let mut pose = Rigid::NONE;
    fields(input, value.length()?, &mut |number, value, input| {
        match number {
            1 => pose.position = numbers(input, value)?,
            2 => pose.turn = quaternion(input, value)?,
            _ => {}
        }
        Ok(())
    })?;
    if pose.position.iter().all(|x| x.is_finite()) {
        return Ok(pose);
    }
    let [x, y, z] = pose.position;
    Err(Error::out_of_range("a position", format!("{x}, {y}, {z}"), "finite, in metres"))
}
