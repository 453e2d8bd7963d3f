//! Several consistent scans: readings of the same range, whose log-odds add.

use alloc::vec;
use alloc::vec::Vec;

use super::model::{Piece, RadialModel, TAIL, exponent, half_width, ratio};
use crate::error::Error;
use crate::real::Real;
use crate::scalar::Scalar;
use crate::sensor::GaussianSensor;

/// What `n` independent readings of the same range say together: `n ln(p / (1 - p))` as log-odds, `p` of Eq. 5.
///
/// The report leaves the limit of their mean information open. Every reading adds information where the first was certain of
/// anything; only at `p = 1/2`, that is `ρ = z ± σ √(ln 4)`, is nothing ever learnt. So the entropy becomes two bumps about these
/// distances, of widths like `1/n`, and the mean information tends to 1 like `1 - c/n`.
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
    /// `scans` readings of one sensor at one range.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if there are none.
    pub fn new(sensor: GaussianSensor<T>, scans: u32) -> Result<Self, Error> {
        if scans == 0 {
            return Err(Error::out_of_range("number of scans", 0.0, "1 or more"));
        }
        Ok(Self { sensor, scans })
    }

    /// One of the readings.
    pub fn sensor(&self) -> GaussianSensor<T> {
        self.sensor
    }

    /// How many readings.
    pub fn scans(&self) -> u32 {
        self.scans
    }
}

/// Each stretch between `z`, where the log-odds are infinite, and a bump, where they are 0, is cut in half, so that both of its
/// ends are starts.
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
        let panels = 4 + self.scans.ilog2() as usize / 2;
        let half = || S::constant(0.5) * half_width();
        let piece = |start, length| Piece::new(start, length, panels);
        let mut pieces = vec![piece(S::constant(0.0), half()), piece(half_width(), -half())];
        let distance: f64 = ratio(&self.sensor);
        // With room for both roundings: a bump that ends before the sensor would have a length of the wrong sign.
        if distance <= half_width::<f64>() * (1.0 + 4.0 * f64::EPSILON) {
            pieces.push(piece(S::constant(0.0), -ratio::<T, S>(&self.sensor)));
            return pieces;
        }
        pieces.push(piece(S::constant(0.0), -half()));
        pieces.push(piece(-half_width::<S>(), half()));
        if distance <= TAIL {
            pieces.push(piece(-half_width::<S>(), half_width::<S>() - ratio(&self.sensor)));
        } else {
            pieces.push(piece(-half_width::<S>(), half_width::<S>() - S::constant(TAIL)));
            pieces.push(piece(S::constant(-TAIL), S::constant(TAIL) - ratio(&self.sensor)));
        }
        pieces
    }

    fn entropy<S: Scalar>(&self, _: usize, t: S) -> S {
        let exponent = exponent(t);
        let rest = S::constant(1.0) - (-exponent.clone()).exp();
        (S::constant(f64::from(self.scans)) * (-exponent - rest.ln())).entropy_from_log_odds()
    }
}
