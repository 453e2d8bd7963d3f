//! TF: the messages `tf2_msgs/TFMessage`, and the tree of frames that they make.

use super::delivery::Message;
use super::fields::Fields;
use crate::error::{Error, ErrorKind, Place};
use crate::scans::Kept;
use crate::trajectory::{Rigid, part};
use std::collections::{BTreeMap, BTreeSet};

/// The types of messages that have transforms; the second is that of early ROS 1.
pub(super) const TF_KINDS: [&str; 2] = ["tf2_msgs/TFMessage", "tf/tfMessage"];

/// The numbers that a frame takes beside its names and its poses, and those of a pose at a time.
const OF_FRAME: usize = 32;
const OF_POSE: usize = 8;

/// Frames, each with the one that carries it.
#[derive(Debug, Default)]
pub(super) struct Transforms {
    carried: BTreeMap<String, Carried>,
    /// The number of transforms that are none.
    pub(super) unsound: u64,
}

/// A frame that another carries.
#[derive(Debug)]
struct Carried {
    /// The frame that carries it.
    by: String,
    /// Another frame of which some message says the same.
    also_by: Option<String>,
    /// Its pose there by `/tf_static`, where no message of `/tf` has the frame.
    fixed: Option<Rigid>,
    /// Its poses there by their times, by `/tf`.
    moving: Vec<(f64, Rigid)>,
    /// Whether it is on `/tf_static` and on `/tf`.
    of_two_kinds: bool,
}

/// The way from a frame to another: up to the frame that carries both, and down again.
#[derive(Debug)]
pub(super) struct Way<'a> {
    up: Vec<&'a Carried>,
    down: Vec<&'a Carried>,
}

impl Transforms {
    /// Takes the transforms of a message, and counts what is kept of them. As tf2, it passes over those whose numbers are no
    /// pose, and those of a frame in itself. A frame of both topics moves: in tf2 it does from the first message of `/tf` on.
    ///
    /// # Errors
    /// An [`Error`] with the byte in the message at which it is not one; or as [`Kept::add`].
    pub(super) fn take(
        &mut self,
        message: &Message<'_>,
        is_static: bool,
        kept: &mut Kept,
    ) -> Result<(), Error> {
        let mut fields = Fields::new(message)?;
        for _ in 0..fields.u32()? {
            let header = fields.header()?;
            let child = fields.frame()?;
            let pose = fields.pose()?;
            if !pose.is_sound() || child.is_empty() || header.frame.is_empty() || child == header.frame {
                self.unsound += 1;
                continue;
            }
            kept.add(OF_POSE)?;
            let carried = self.carried(child, header.frame, kept)?;
            carried.of_two_kinds |=
                if is_static { !carried.moving.is_empty() } else { carried.fixed.take().is_some() };
            if !is_static {
                carried.moving.push((header.time, pose));
            } else if carried.moving.is_empty() {
                carried.fixed = Some(pose);
            }
        }
        Ok(())
    }

    /// Returns what is known of a frame, with a frame that carries it.
    fn carried(&mut self, child: &str, by: &str, kept: &mut Kept) -> Result<&mut Carried, Error> {
        if !self.carried.contains_key(child) {
            kept.add(OF_FRAME + (2 * child.len() + by.len()) / size_of::<f64>())?;
            let (fixed, moving) = (None, Vec::new());
            let new = Carried { by: by.to_owned(), also_by: None, fixed, moving, of_two_kinds: false };
            self.carried.insert(child.to_owned(), new);
        }
        let Some(carried) = self.carried.get_mut(child) else {
            return Err(Error::new(ErrorKind::Format, "has no frame"));
        };
        if carried.by != by && carried.also_by.is_none() {
            kept.add(by.len() / size_of::<f64>())?;
            carried.also_by = Some(by.to_owned());
        }
        Ok(carried)
    }

    /// Returns the frames that are on `/tf` and on `/tf_static`.
    pub(super) fn of_two_kinds(&self) -> impl Iterator<Item = &str> {
        self.carried.iter().filter(|(_, carried)| carried.of_two_kinds).map(|(name, _)| &**name)
    }

    /// Puts poses in the order of their times; of those of one time the first holds, as in tf2.
    pub(super) fn sort(&mut self) {
        for carried in self.carried.values_mut() {
            carried.moving.sort_by(|(one, _), (other, _)| one.total_cmp(other));
            carried.moving.dedup_by(|(later, _), (kept, _)| later == kept);
        }
    }

    /// Returns a frame and all that carry it, each by the next.
    ///
    /// # Errors
    /// An [`Error`] if two carry one of them, or one itself.
    pub(super) fn over<'a>(&'a self, frame: &'a str) -> Result<Vec<&'a str>, Error> {
        let mut frames = vec![frame];
        let mut last = frame;
        while let Some(carried) = self.carried.get(last) {
            let refused = if let Some(other) = &carried.also_by {
                format!("TF has frame {last} in two frames, {} and {other}", carried.by)
            } else if frames.len() > self.carried.len() {
                format!("TF has frame {last} in itself")
            } else {
                last = &carried.by;
                frames.push(last);
                continue;
            };
            return Err(Error::new(ErrorKind::Format, refused).with_value(last));
        }
        Ok(frames)
    }

    /// Returns the last frame that carries this one without moving: the frame itself if none does.
    ///
    /// # Errors
    /// As [`Self::over`].
    pub(super) fn fixed_under<'a>(&'a self, frame: &'a str) -> Result<&'a str, Error> {
        let frames = self.over(frame)?;
        let moves = |name: &&&str| self.carried.get(**name).is_none_or(|carried| carried.fixed.is_none());
        Ok(frames.iter().find(moves).copied().unwrap_or(frame))
    }

    /// Finds the way from a frame to another.
    ///
    /// # Errors
    /// An [`Error`] of kind [`ErrorKind::Choice`] that lists the frames over the first if there is none; or as
    /// [`Self::over`].
    pub(super) fn way<'a>(&'a self, from: &'a str, to: &'a str) -> Result<Way<'a>, Error> {
        let (up, down) = (self.over(from)?, self.over(to)?);
        let over_both: BTreeSet<_> = down.iter().collect();
        let Some(common) = up.iter().find(|&name| over_both.contains(name)) else {
            let refused = Error::new(ErrorKind::Choice, format!("TF does not connect {from} with {to}"));
            let over = if up.len() > 1 { up[1..].join(", ") } else { "none".to_owned() };
            let refused = refused.with_value(to).at(Place::Option("frames"));
            return Err(refused.allowing(&format!("; the frames over {from} are: "), over));
        };
        let part = |frames: &[&str]| {
            frames
                .iter()
                .take_while(|name| *name != common)
                .filter_map(|&name| self.carried.get(name))
                .collect()
        };
        Ok(Way { up: part(&up), down: part(&down) })
    }
}

impl Carried {
    /// Returns the pose at a time, in seconds: as of a trajectory, nothing is extrapolated.
    fn at(&self, time: f64, max_gap: f64) -> Result<Option<Rigid>, Error> {
        if self.fixed.is_some() {
            return Ok(self.fixed);
        }
        let after = self.moving.partition_point(|&(own, _)| own < time);
        let before = after.checked_sub(1).and_then(|before| self.moving.get(before));
        match (before, self.moving.get(after)) {
            (_, Some((end, pose))) if *end == time => Ok(Some(*pose)),
            (Some((start, from)), Some((end, to))) if end - start <= max_gap => {
                from.between(to, part(time, *start, *end)).map(Some)
            }
            _ => Ok(None),
        }
    }
}

impl Way<'_> {
    /// Returns the pose of the first frame in the second, where each step has one.
    fn by(
        &self,
        mut step: impl FnMut(&Carried) -> Result<Option<Rigid>, Error>,
    ) -> Result<Option<Rigid>, Error> {
        let mut poses = [Rigid::NONE; 2];
        for (pose, steps) in poses.iter_mut().zip([&self.up, &self.down]) {
            for carried in steps {
                let Some(next) = step(carried)? else { return Ok(None) };
                *pose = next.compose(pose);
            }
        }
        // What is not turned back is not rounded.
        let [up, down] = poses;
        Ok(Some(if self.down.is_empty() { up } else { down.inverse().compose(&up) }))
    }

    /// Returns the pose if nothing on the way moves.
    pub(super) fn fixed(&self) -> Option<Rigid> {
        self.by(|carried| Ok(carried.fixed)).ok().flatten()
    }

    /// Returns the pose at a time, in seconds; between two that are no more than `max_gap` seconds apart each step is
    /// interpolated.
    ///
    /// # Errors
    /// Poses that are not finite.
    pub(super) fn at(&self, time: f64, max_gap: f64) -> Result<Option<Rigid>, Error> {
        self.by(|carried| carried.at(time, max_gap))
    }

    /// Returns the times that all moving steps span, if one moves.
    pub(super) fn span(&self) -> Option<[f64; 2]> {
        let ends = |carried: &Carried| Some([carried.moving.first()?.0, carried.moving.last()?.0]);
        let moving = self.up.iter().chain(&self.down).filter(|carried| carried.fixed.is_none());
        let spans = moving.filter_map(|carried| ends(carried));
        spans.reduce(|[a, b], [c, d]| [a.max(c), b.min(d)])
    }
}
