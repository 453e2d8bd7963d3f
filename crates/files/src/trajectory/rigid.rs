//! Poses in space: frames that carry one another.

use super::quaternion::Quaternion;
use super::tilts::Tilts;
use crate::error::Error;
use mean_information::scan::Pose;

/// The pose of a body in a frame: its position in metres and its orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rigid {
    /// The position.
    pub(crate) position: [f64; 3],
    /// The orientation.
    pub(crate) turn: Quaternion,
}

impl Rigid {
    /// The pose of a frame in itself.
    pub(crate) const NONE: Self = Self { position: [0.0; 3], turn: Quaternion::NONE };

    /// Tells whether the position is finite and the quaternion one that tf2 takes.
    pub(crate) fn is_sound(&self) -> bool {
        self.position.iter().all(|x| x.is_finite()) && self.turn.is_normal_in_tf2()
    }

    /// Returns the pose of what has the pose `part` in the frame of this body.
    pub(crate) fn compose(&self, part: &Self) -> Self {
        let (own, moved) = (self.position, self.turn.rotate(part.position));
        let position = [own[0] + moved[0], own[1] + moved[1], own[2] + moved[2]];
        Self { position, turn: self.turn.compose(part.turn) }
    }

    /// Returns the pose of the frame in the frame of this body.
    pub(crate) fn inverse(&self) -> Self {
        let turn = self.turn.conjugate();
        Self { position: turn.rotate(self.position).map(|x| -x), turn }
    }

    /// Returns the pose at `part` of the way from this to `end`: the position along a line, the orientation along the
    /// shorter way round.
    ///
    /// # Errors
    /// A pose that is not finite.
    pub(crate) fn between(&self, end: &Self, part: f64) -> Result<Self, Error> {
        let mean = |axis: usize| (1.0 - part) * self.position[axis] + part * end.position[axis];
        Ok(Self { position: [0, 1, 2].map(mean), turn: self.turn.between(end.turn, part)? })
    }

    /// Returns what of the pose lies in the plane, and counts its tilt.
    ///
    /// # Errors
    /// A number that overflows.
    pub(crate) fn in_plane(&self, tilts: &mut Tilts) -> Result<Pose, Error> {
        tilts.see(self.turn);
        Ok(Pose::new(self.position[0], self.position[1], self.turn.yaw())?)
    }
}
