//! Several consistent scans: readings of the same range, whose log-odds add.

use alloc::vec::Vec;

use super::model::{Longer, Piece, RadialModel, beyond, exponent, half_width, ratio};
use crate::error::Error;
use crate::real::Real;
use crate::scalar::Scalar;
use crate::sensor::GaussianSensor;

/// The model of `n` independent readings of the same range: the log-odds are `n ln(p / (1 - p))`, with `p` of Eq. 5.
///
/// The report leaves the limit of their mean information open. Every reading adds information, except where `p = 1/2`, that
/// is at `ρ = z ± σ √(ln 4)`. So the entropy is concentrated about these two distances, in widths proportional to `1/n`, and
/// the mean information tends to 1 like `1 - c/n`.
///
/// ```
/// use mean_information::limit::RepeatedScans;
/// use mean_information::sensor::GaussianSensor;
/// let twice = RepeatedScans::new(GaussianSensor::new(2.0_f64, 0.2)?, 2)?;
/// assert_eq!(twice.scans(), 2);
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RepeatedScans<T> {
    sensor: GaussianSensor<T>,
    scans: u32,
}

impl<T: Real> RepeatedScans<T> {
    /// Creates the model of `scans` readings of one sensor at one range.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if there are none.
    pub fn new(sensor: GaussianSensor<T>, scans: u32) -> Result<Self, Error> {
        if scans == 0 {
            return Err(Error::out_of_range("number of scans", 0.0, "1 or more"));
        }
        Ok(Self { sensor, scans })
    }

    /// Returns the model of a single reading.
    pub fn sensor(&self) -> GaussianSensor<T> {
        self.sensor
    }

    /// Returns the number of readings.
    pub fn scans(&self) -> u32 {
        self.scans
    }
}

/// The pieces for the integrators: each stretch from `z`, where the log-odds are infinite, to a bump, where they are 0, is cut
/// in half, and each half starts at its difficult end.
impl<T: Real> RadialModel for RepeatedScans<T> {
    type Float = T;

    fn origin(&self) -> T {
        self.sensor.range()
    }

    fn scale(&self) -> T {
        self.sensor.sigma()
    }

    fn pieces<S: Scalar>(&self) -> Vec<Piece<S>> {
        // The bumps are as narrow as 1/n.
        let panels = 4 + self.scans.ilog2() as usize / 3;
        let half = || S::constant(0.5) * half_width();
        let piece = |start, length| Piece::new(start, length, panels);
        let sides = [piece(S::constant(0.0), half()), piece(half_width(), -half())];
        if Longer::of(&self.sensor) != Longer::Near {
            // The near side has no bump.
            let near = piece(S::constant(0.0), -ratio::<T, S>(&self.sensor));
            return sides.into_iter().chain([near]).collect();
        }
        sides.map(Piece::mirrored).into_iter().chain(beyond(&self.sensor, panels)).collect()
    }

    fn entropy<S: Scalar>(&self, _: usize, t: S) -> S {
        let exponent = exponent(t);
        let rest = -(-exponent.clone()).exp_m1();
        (S::constant(f64::from(self.scans)) * (-exponent - rest.ln())).entropy_from_log_odds()
    }
}
