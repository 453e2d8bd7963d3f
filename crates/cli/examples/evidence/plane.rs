//! Poses in the plane as numbers: x and y in metres, the heading in radians.

use mean_information::Error;
use mean_information::scan::{Direction, Pose};
use std::f64::consts::TAU;

/// A pose, or the way from one to another.
pub(crate) type Place = [f64; 3];

/// Returns the numbers of a pose.
pub(crate) fn place(pose: &Pose) -> Place {
    let [x, y] = pose.position();
    [x, y, pose.theta()]
}

/// Returns the pose in the world of what is at `part` in the frame of `whole`.
pub(crate) fn compose([x, y, theta]: Place, part: Place) -> Result<Place, Error> {
    let heading = Direction::new(&[theta])?;
    Ok([
        x + part[0] * heading.cos() - part[1] * heading.sin(),
        y + part[0] * heading.sin() + part[1] * heading.cos(),
        turn(theta + part[2]),
    ])
}

/// Returns the pose `to` in the frame of `from`.
pub(crate) fn relative(from: Place, to: Place) -> Result<Place, Error> {
    let heading = Direction::new(&[from[2]])?;
    let (x, y) = (to[0] - from[0], to[1] - from[1]);
    Ok([x * heading.cos() + y * heading.sin(), y * heading.cos() - x * heading.sin(), turn(to[2] - from[2])])
}

/// Returns an angle in `[-π, π]`.
pub(crate) fn turn(angle: f64) -> f64 {
    libm::remainder(angle, TAU)
}
