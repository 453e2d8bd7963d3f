//! Orientations as quaternions, and what of one is kept in the plane.

use mean_information::elementary::sqrt;
use mean_information::scan::Direction;
use std::f64::consts::PI;

/// The orientation of a body, `[x, y, z, w]`, of any length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Quaternion(pub(super) [f64; 4]);

/// Returns the yaw of an orientation `[x, y, z, w]` of any length, as [`Quaternion::yaw`].
pub(crate) fn yaw(orientation: [f64; 4]) -> f64 {
    Quaternion(orientation).yaw()
}

impl Quaternion {
    /// Creates the turn by `yaw` radians about the z axis.
    ///
    /// # Errors
    /// A yaw that is not finite.
    pub(super) fn turn(yaw: f64) -> Result<Self, mean_information::Error> {
        let half = Direction::new(&[0.5 * yaw])?;
        Ok(Self([0.0, 0.0, half.sin(), half.cos()]))
    }

    /// Returns the length.
    pub(super) fn norm(self) -> f64 {
        sqrt(self.0.iter().map(|x| x * x).sum::<f64>())
    }

    /// Returns the yaw in `[-π, π]`, of the rotation Rz(yaw) Ry(pitch) Rx(roll).
    pub(super) fn yaw(self) -> f64 {
        let [x, y, z, w] = self.0;
        libm::atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z)
    }

    /// Returns the angle, in degrees, between the body's z axis and the world's: pitch and roll together.
    pub(super) fn tilt(self) -> f64 {
        let [x, y, z, w] = self.0;
        2.0 * libm::atan2(libm::hypot(x, y), libm::hypot(z, w)) * (180.0 / PI)
    }
}
