//! Orientations as quaternions, and what of one is kept in the plane.

use mean_information::elementary::sqrt;
use mean_information::scan::Direction;
use std::f64::consts::PI;

/// The orientation of a body, `[x, y, z, w]`, of any length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Quaternion(pub(crate) [f64; 4]);

/// How far the length of a quaternion in a text may be from 1: two decimals, rounded.
const NORM_TOLERANCE: f64 = 0.02;
/// How far the square of a length may be from 1 in tf2.
const SQUARE_TOLERANCE: f64 = 0.01;

impl Quaternion {
    /// Creates the turn by `yaw` radians about the z axis.
    ///
    /// # Errors
    /// A yaw that is not finite.
    pub(super) fn turn(yaw: f64) -> Result<Self, mean_information::Error> {
        let half = Direction::new(&[0.5 * yaw])?;
        Ok(Self([0.0, 0.0, half.sin(), half.cos()]))
    }

    /// The orientation of the world itself.
    pub(crate) const NONE: Self = Self([0.0, 0.0, 0.0, 1.0]);

    /// Returns the square of the length.
    fn square(self) -> f64 {
        self.0.iter().map(|x| x * x).sum()
    }

    /// Returns the length.
    pub(crate) fn norm(self) -> f64 {
        sqrt(self.square())
    }

    /// Tells whether tf2 takes it for an orientation: the square of the length is 1, within 0.01.
    pub(crate) fn is_normal_in_tf2(self) -> bool {
        (self.square() - 1.0).abs() < SQUARE_TOLERANCE
    }

    /// Tells whether the length is 1, within 0.02.
    pub(crate) fn is_normal(self) -> bool {
        ((1.0 - NORM_TOLERANCE)..=(1.0 + NORM_TOLERANCE)).contains(&self.norm())
    }

    /// Returns the orientation that turns back.
    pub(crate) fn conjugate(self) -> Self {
        let [x, y, z, w] = self.0;
        Self([-x, -y, -z, w])
    }

    /// Returns the orientation in the world of what has the orientation `part` in this body.
    pub(crate) fn compose(self, part: Self) -> Self {
        let ([x, y, z, w], [a, b, c, d]) = (self.0, part.0);
        Self([
            w * a + x * d + y * c - z * b,
            w * b - x * c + y * d + z * a,
            w * c + x * b - y * a + z * d,
            w * d - x * a - y * b - z * c,
        ])
    }

    /// Returns the vector in the world that is `v` in this body.
    pub(crate) fn rotate(self, v: [f64; 3]) -> [f64; 3] {
        let turned = self.compose(Self([v[0], v[1], v[2], 0.0])).compose(self.conjugate()).0;
        let square = self.square();
        [turned[0] / square, turned[1] / square, turned[2] / square]
    }

    /// Returns the orientation at `part` of the turn from this to `end`, along the shorter way round at an even rate.
    ///
    /// # Errors
    /// Orientations that are not finite.
    pub(crate) fn between(self, end: Self, part: f64) -> Result<Self, mean_information::Error> {
        let turn = self.conjugate().compose(end).0;
        let [x, y, z, w] = if turn[3] < 0.0 { turn.map(|number| -number) } else { turn };
        let sine = libm::hypot(libm::hypot(x, y), z);
        if sine == 0.0 {
            return Ok(self);
        }
        let angle = Direction::new(&[part * libm::atan2(sine, w)])?;
        let along = angle.sin() / sine;
        Ok(self.compose(Self([along * x, along * y, along * z, angle.cos()])))
    }

    /// Returns the yaw in `[-π, π]`, of the rotation Rz(yaw) Ry(pitch) Rx(roll).
    pub(crate) fn yaw(self) -> f64 {
        let [x, y, z, w] = self.0;
        libm::atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z)
    }

    /// Returns the angle, in degrees, between the body's z axis and the world's: pitch and roll together.
    pub(crate) fn tilt(self) -> f64 {
        let [x, y, z, w] = self.0;
        2.0 * libm::atan2(libm::hypot(x, y), libm::hypot(z, w)) * (180.0 / PI)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Asserts that two lists of numbers are alike: a dozen roundings.
    fn alike<const N: usize>(found: [f64; N], exact: [f64; N]) {
        assert!(found.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-14), "{found:?} {exact:?}");
    }

    #[test]
    fn turns_compose_as_matrices_do() {
        // A quarter about x, then about the body's own z: x to z, y to -x, z to -y.
        let half = sqrt(0.5_f64);
        let turn = Quaternion([half, 0.0, 0.0, half]).compose(Quaternion([0.0, 0.0, half, half]));
        alike(turn.rotate([2.0, 3.0, 5.0]), [-3.0, -5.0, 2.0]);
        alike(turn.conjugate().rotate([-3.0, -5.0, 2.0]), [2.0, 3.0, 5.0]);
        // Its length is divided out.
        alike(Quaternion(turn.0.map(|x| 1.01 * x)).rotate([2.0, 3.0, 5.0]), [-3.0, -5.0, 2.0]);
    }

    #[test]
    fn between_two_orientations_the_shorter_way() {
        let [start, end] = [3.0, -3.0].map(|yaw| Quaternion::turn(yaw).unwrap());
        for part in [0.0, 0.25, 1.0] {
            let expected = 3.0 + part * (2.0 * PI - 6.0);
            let yaw = start.between(end, part).unwrap().yaw();
            assert!(libm::remainder(yaw - expected, 2.0 * PI).abs() < 1e-14, "{part}: {yaw} {expected}");
            let other = start.between(Quaternion(end.0.map(|x| -x)), part).unwrap();
            assert!((other.yaw() - yaw).abs() < 1e-14);
        }
        assert_eq!(start.between(start, 0.25).unwrap(), start);
    }
}
