//! Where the laser is mounted on the robot, from the poses that a log has of both.

use mean_information::Error;
use mean_information::scan::{Direction, Pose};

/// How far the mounts of two records may be apart: a millimetre along x and y, a milliradian.
const TOLERANCE: f64 = 1e-3;

/// A mount that is looked for in the records of a log.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Mount {
    /// No record had both poses.
    #[default]
    Unknown,
    /// All records had this one.
    Same(Pose),
    /// Two records had different ones: the poses of the laser are corrected ones.
    Different,
}

impl Mount {
    /// Takes in the poses of a record.
    ///
    /// # Errors
    /// Never for poses whose difference is finite.
    pub(super) fn see(&mut self, robot: &Pose, laser: &Pose) -> Result<(), Error> {
        let heading = Direction::new(&[robot.theta()])?;
        let ([x0, y0], [x1, y1]) = (robot.position(), laser.position());
        let (dx, dy) = (x1 - x0, y1 - y0);
        let (ahead, aside) =
            (dx * heading.cos() + dy * heading.sin(), dy * heading.cos() - dx * heading.sin());
        let turn = libm::remainder(laser.theta() - robot.theta(), std::f64::consts::TAU);
        let seen = Pose::new(ahead, aside, turn)?;
        *self = match *self {
            Self::Unknown => Self::Same(seen),
            Self::Same(mount) if alike(&mount, &seen) => Self::Same(mount),
            _ => Self::Different,
        };
        Ok(())
    }

    /// Returns the mount that all records had.
    pub(super) fn same(self) -> Option<Pose> {
        match self {
            Self::Same(mount) => Some(mount),
            Self::Unknown | Self::Different => None,
        }
    }
}

fn alike(one: &Pose, other: &Pose) -> bool {
    let ([x0, y0], [x1, y1]) = (one.position(), other.position());
    let apart = [x1 - x0, y1 - y0, other.theta() - one.theta()];
    apart.iter().all(|difference| difference.abs() <= TOLERANCE)
}
