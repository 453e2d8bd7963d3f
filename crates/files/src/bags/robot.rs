//! The robot that carries the laser: its frame among those of TF, and its poses.

use super::recording::Poses;
use super::refusals::{choice, unstamped};
use super::transforms::Transforms;
use crate::error::{Error, ErrorKind, Place};
use crate::scans::{Frame, RangeScan, RecordedTrajectory, Selection};
use crate::trajectory::{Quaternion, Rigid, Tilts, Trajectory};
use crate::warning::Warning;
use mean_information::scan::Pose;

/// The frames whose trajectories are taken unless others are named (REP 105).
const FRAMES: [&str; 2] = ["map", "odom"];
/// The tilt, in degrees, above which a laser is upside down.
const ON_ITS_SIDE: f64 = 90.0;
/// Half a turn about the x axis.
const OVER: Quaternion = Quaternion([1.0, 0.0, 0.0, 0.0]);

/// The robot. Where nothing carries the laser without moving, it is the laser itself.
pub(super) struct Robot<'a> {
    pub(super) transforms: &'a Transforms,
    /// The frame of the robot.
    pub(super) base: &'a str,
    /// The frame of its laser.
    pub(super) laser: &'a str,
    pub(super) selection: &'a Selection,
}

/// A trajectory in space.
pub(super) struct InSpace {
    name: String,
    frame: Frame,
    times: Vec<f64>,
    poses: Vec<Rigid>,
    warnings: Vec<Warning>,
}

impl Robot<'_> {
    /// Tells whether the robot is the laser.
    fn is_laser(&self) -> bool {
        self.base == self.laser
    }

    /// Returns the pose of the laser on the robot by TF, unless it is given or none is needed.
    pub(super) fn mount(&self) -> Result<Option<Rigid>, Error> {
        if self.selection.mount.is_some() || self.is_laser() {
            return Ok(None);
        }
        let on_base = self.fixed(self.laser, self.base, "the laser is there");
        on_base.map(Some).map_err(|error| error.at(Place::Option("base")))
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
    /// TF does not say and the mount is given, which is on what the poses are of.
    fn on(&self, child: &str, topic: &str) -> Result<Option<Rigid>, Error> {
        let is_given = self.selection.mount.is_some();
        match self.transforms.way(self.base, child) {
            Err(_) if is_given => Ok(None),
            Ok(way) if is_given && self.is_laser() => Ok(way.fixed()),
            _ => self
                .fixed(self.base, child, &format!("the robot is, as {topic} has poses of {child}"))
                .map(Some),
        }
    }

    /// Tells whether the laser is upside down, so that its bearings turn clockwise: on the robot or, where that is the laser
    /// itself, in the world.
    ///
    /// # Errors
    /// A laser that turns over.
    pub(super) fn is_upside_down(&self, scans: &[RangeScan], held: &[InSpace]) -> Result<bool, Error> {
        if self.selection.upside_down {
            return Ok(true);
        }
        let mut sides = Sides::default();
        if self.is_laser() {
            for held in held.iter().filter(|held| held.frame == Frame::Laser) {
                held.times.iter().zip(&held.poses).for_each(|(&time, pose)| sides.see(time, pose));
            }
        } else if let Ok(way) = self.transforms.way(self.laser, self.base) {
            for scan in scans {
                if let Some(pose) = way.at(scan.time(), self.selection.max_gap)? {
                    sides.see(scan.time(), &pose);
                }
            }
        }
        match sides.times {
            [Some(up), Some(down)] => {
                let words = format!("TF has the laser upright at {up} s and upside down at {down} s");
                let refused = Error::new(ErrorKind::Unsupported, words).with_value(down.to_string());
                Err(refused.allowing("; allowed is ", "a laser that does not turn over"))
            }
            [_, down] => Ok(down.is_some()),
        }
    }

    /// Returns what is to be said of frames that are both on `/tf` and on `/tf_static`.
    pub(super) fn frames_of_two_kinds(&self) -> Vec<Warning> {
        let both = self.transforms.of_two_kinds().map(str::to_owned);
        both.map(|frame| Warning::FrameStaticAndMoving { frame }).collect()
    }

    /// Returns the trajectories of the robot in the frames that are wanted, at the times of the scans.
    pub(super) fn in_frames(&self, scans: &[RangeScan]) -> Result<Vec<InSpace>, Error> {
        let frames: Vec<&str> = if let Some(frames) = &self.selection.frames {
            frames.iter().map(|name| name.strip_prefix('/').unwrap_or(name)).collect()
        } else {
            let over = self.transforms.over(self.base)?;
            let own: Vec<&str> = FRAMES.into_iter().filter(|name| over.contains(name)).collect();
            if own.is_empty() {
                let words = format!("TF has neither map nor odom over {}", self.base);
                let frames: Vec<String> = over[1..].iter().map(|&name| name.to_owned()).collect();
                let option = if frames.is_empty() { "base" } else { "frames" };
                return Err(choice(option, words, "; the frames over it are: ", &frames));
            }
            own
        };
        frames.into_iter().map(|frame| self.in_frame(frame, scans)).collect()
    }

    /// Returns the trajectory of the robot in a frame at the times of the scans.
    fn in_frame(&self, frame: &str, scans: &[RangeScan]) -> Result<InSpace, Error> {
        let way = self.transforms.way(self.base, frame)?;
        let (mut times, mut poses) = (Vec::new(), Vec::new());
        for scan in scans {
            if let Some(pose) = way.at(scan.time(), self.selection.max_gap)? {
                times.push(scan.time());
                poses.push(pose);
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
        Ok(self.held(frame, self.is_laser(), times, poses))
    }

    /// Returns the trajectory of the robot that a topic has.
    pub(super) fn by_topic(&self, name: &str, poses: Poses) -> Result<InSpace, Error> {
        let Poses { child, times, mut rigid, same_time } = poses;
        match *times {
            [] => {
                let words = format!("has no pose on topic {name}");
                return Err(Error::new(ErrorKind::Format, words).with_value(name));
            }
            [0.0] if same_time > 0 => return Err(unstamped("poses", name)),
            _ => {}
        }
        let (own, is_of_base) = match child.as_deref() {
            Some(child) if child != self.base => {
                let own = self.on(child, name)?;
                (own, own.is_some())
            }
            Some(_) => (None, true),
            // A mount that is given is on what the poses are of.
            None => (None, self.selection.mount.is_none()),
        };
        if let Some(own) = own {
            for pose in &mut rigid {
                *pose = pose.compose(&own);
            }
        }
        let mut held = self.held(name, is_of_base && self.is_laser(), times, rigid);
        if same_time > 0 {
            held.warnings.push(Warning::PosesAtOneTime { count: same_time });
        }
        Ok(held)
    }

    /// Creates a trajectory of the laser, or of what it is mounted on.
    fn held(&self, name: &str, of_laser: bool, times: Vec<f64>, poses: Vec<Rigid>) -> InSpace {
        let frame = if of_laser { Frame::Laser } else { Frame::Robot };
        let unused = of_laser && self.selection.mount.is_some();
        let warnings = unused.then_some(Warning::PosesOfLaser).into_iter().collect();
        InSpace { name: name.to_owned(), frame, times, poses, warnings }
    }
}

impl InSpace {
    /// Drops what does not lie in the plane. A laser that is upside down lies in it.
    pub(super) fn in_plane(self) -> Result<RecordedTrajectory, Error> {
        let Self { name, frame, times, poses, warnings: more } = self;
        let mut tilts = Tilts::default();
        let in_plane = |pose: &Rigid| -> Result<Pose, Error> {
            let mut pose = *pose;
            if frame == Frame::Laser && pose.turn.tilt() > ON_ITS_SIDE {
                pose.turn = pose.turn.compose(OVER);
            }
            pose.in_plane(&mut tilts)
        };
        let in_plane = poses.iter().map(in_plane).collect::<Result<_, _>>()?;
        let trajectory = Trajectory::new(times, in_plane)?;
        let warnings = tilts.warning().into_iter().chain(more).collect();
        Ok(RecordedTrajectory { name, frame, trajectory, warnings })
    }
}

/// The first times at which a laser is upright, and upside down.
#[derive(Default)]
struct Sides {
    times: [Option<f64>; 2],
}

impl Sides {
    /// Takes in a pose at a time, in seconds.
    fn see(&mut self, time: f64, pose: &Rigid) {
        self.times[usize::from(pose.turn.tilt() > ON_ITS_SIDE)].get_or_insert(time);
    }
}
