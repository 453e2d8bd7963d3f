//! A scan of a range sensor in the plane: the pose of the sensor, and what its beams returned.

use super::pose::Pose;
use crate::error::{Error, positive};
use crate::real::Real;
use alloc::vec::Vec;

/// One beam of a scan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam<T> {
    /// The direction from the heading of the sensor, in radians, counter-clockwise.
    pub bearing: f64,
    /// The range that came back, in metres; `None` if nothing came back from within the maximum range.
    pub range: Option<T>,
}

/// A scan: finite bearings, and ranges above 0 and up to the maximum range.
///
/// ```
/// use mean_information::scan::{Beam, Pose, Scan};
/// let pose = Pose::new(0.5, 0.25, 0.0)?;
/// let beams = vec![Beam { bearing: -0.5, range: Some(2.75) }, Beam { bearing: 0.5, range: None }];
/// assert_eq!(Scan::new(pose, 8.0, beams.clone())?.beams().len(), 2);
/// let refused = Scan::new(pose, 2.5, beams).unwrap_err();
/// assert_eq!(refused.to_string(), "range of beam 0 is 2.75, allowed is above 0, up to the maximum range");
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Scan<T> {
    pose: Pose,
    maximum_range: T,
    beams: Vec<Beam<T>>,
}

impl<T: Real> Scan<T> {
    /// Creates the scan of a sensor at `pose` that sees up to `maximum_range` metres.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the maximum range is not positive and finite, or there is no beam; [`Error::Item`]
    /// naming the first beam whose bearing is not finite, or whose range is not above 0 or beyond the maximum.
    pub fn new(pose: Pose, maximum_range: T, beams: Vec<Beam<T>>) -> Result<Self, Error> {
        let maximum_range = positive("maximum range", maximum_range)?;
        if beams.is_empty() {
            return Err(Error::out_of_range("number of beams", 0.0, "1 or more"));
        }
        for (index, beam) in beams.iter().enumerate() {
            if !beam.bearing.is_finite() {
                let (what, value) = ("bearing of beam", beam.bearing);
                return Err(Error::Item { what, index, value, allowed: "finite, in radians" });
            }
            if let Some(range) = beam.range
                && !(range > T::zero() && range <= maximum_range)
            {
                let (what, value) = ("range of beam", range.widen());
                return Err(Error::Item { what, index, value, allowed: "above 0, up to the maximum range" });
            }
        }
        Ok(Self { pose, maximum_range, beams })
    }

    /// Returns the pose of the sensor.
    pub fn pose(&self) -> &Pose {
        &self.pose
    }

    /// Returns the maximum range of the sensor, in metres.
    pub fn maximum_range(&self) -> T {
        self.maximum_range
    }

    /// Returns the beams, in the order in which they were given.
    pub fn beams(&self) -> &[Beam<T>] {
        &self.beams
    }
}
