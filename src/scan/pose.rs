//! The pose of a sensor in the plane.

use crate::error::Error;

/// The pose of a sensor: x and y in metres, and its heading in radians, counter-clockwise from the x axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    x: f64,
    y: f64,
    theta: f64,
}

impl Pose {
    /// Creates the pose at `x`, `y` (metres), heading to `theta` (radians).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if one of them is not finite.
    ///
    /// ```
    /// use mean_information::scan::Pose;
    /// assert_eq!(Pose::new(2.5, -0.75, 0.125)?.position(), [2.5, -0.75]);
    /// assert!(Pose::new(2.5, f64::NAN, 0.125).is_err());
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn new(x: f64, y: f64, theta: f64) -> Result<Self, Error> {
        let allowed = ["finite, in metres", "finite, in metres", "finite, in radians"];
        for ((what, value), allowed) in
            [("x of the pose", x), ("y of the pose", y), ("theta of the pose", theta)]
                .into_iter()
                .zip(allowed)
        {
            if !value.is_finite() {
                return Err(Error::out_of_range(what, value, allowed));
            }
        }
        Ok(Self { x, y, theta })
    }

    /// Returns x and y, in metres.
    pub fn position(&self) -> [f64; 2] {
        [self.x, self.y]
    }

    /// Returns the heading, in radians.
    pub fn theta(&self) -> f64 {
        self.theta
    }
}
