//! Results that are not exact: an [`Estimate`] says how far off it believes to be, an [`Enclosure`] contains the truth.
//!
//! They are different types, so that an estimate cannot pass for a proof. Both say how the computation ended.

use crate::real::Real;

/// The way in which a computation ended.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Status<T> {
    /// The error or the width is within the tolerance that was asked for.
    Converged,
    /// Within the tolerance, if the integrand is 0; for that was every value that was seen. A peak between the nodes of an
    /// integrand that underflows beside it looks alike: give break points about it.
    AllZero,
    /// The limit on evaluations came first. The result holds, with the error or the width it states.
    EvaluationLimit,
    /// Rounding errors keep the tolerance out of reach. The result holds, with the error or the width it states.
    RoundOff,
    /// The integrand is singular, or too narrow to be resolved by floats, between `lower` and `upper`.
    Unresolved {
        /// The lower end of the stretch.
        lower: T,
        /// The upper end of the stretch.
        upper: T,
    },
    /// The integrand was NaN or infinite between `lower` and `upper`: the result means nothing there.
    NotFinite {
        /// The lower end of the stretch.
        lower: T,
        /// The upper end of the stretch.
        upper: T,
    },
}

impl Status<f64> {
    /// Returns the same status with the nearest floats of another format.
    pub(crate) fn nearest<T: Real>(self) -> Status<T> {
        match self {
            Self::Converged => Status::Converged,
            Self::AllZero => Status::AllZero,
            Self::EvaluationLimit => Status::EvaluationLimit,
            Self::RoundOff => Status::RoundOff,
            Self::Unresolved { lower, upper } => {
                Status::Unresolved { lower: T::nearest(lower), upper: T::nearest(upper) }
            }
            Self::NotFinite { lower, upper } => {
                Status::NotFinite { lower: T::nearest(lower), upper: T::nearest(upper) }
            }
        }
    }
}

/// A value with the error it is believed to have: not proved.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Estimate<T> {
    /// The value.
    pub value: T,
    /// The estimated bound on `|value - truth|`; not negative.
    pub error: T,
    /// The way in which the computation ended.
    pub status: Status<T>,
    /// The number of evaluations of the integrand.
    pub evaluations: u64,
}

/// Two floats that are proved to have the true value between them, ends included: only this crate makes one.
///
/// ```
/// use mean_information::limit::{Weight, rigorous};
/// use mean_information::{quadrature::rigorous::Rigorous, sensor::GaussianSensor};
/// let limit = rigorous(&GaussianSensor::new(2.0_f64, 0.2)?, Weight::Area, &Rigorous::new().relative(0.01))?;
/// assert!(limit.contains(0.6525109529727351) && !limit.contains(0.67));
/// assert!(0.0 < limit.width() && limit.width() < 0.01); // bits
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Enclosure<T> {
    /// The lower end, not above the true value.
    pub lower: T,
    /// The upper end, not below the true value.
    pub upper: T,
    /// The way in which the computation ended.
    pub status: Status<T>,
    /// The number of evaluations of the integrand, at a point or over an interval.
    pub evaluations: u64,
}

impl<T: Real> Enclosure<T> {
    /// Returns true if `x` lies between the ends.
    pub fn contains(&self, x: T) -> bool {
        self.lower <= x && x <= self.upper
    }

    /// Returns `upper - lower`, rounded up: exact, or the next float above, as the exact residual of
    /// IEEE 754's difference tells.
    pub fn width(&self) -> T {
        let width = self.upper - self.lower;
        // Knuth's TwoSum: what rounding to nearest took away, exactly. Of infinite ends it is NaN.
        let taken = width - self.upper;
        let rest = (self.upper - (width - taken)) - (self.lower + taken);
        if rest > T::zero() {
            let (m, e) = width.parts();
            T::from_parts(m + 1, e)
        } else {
            width
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn width<T: Real>(lower: T, upper: T) -> T {
        Enclosure { lower, upper, status: Status::Converged, evaluations: 2 }.width()
    }

    #[test]
    fn a_width_is_rounded_up() {
        assert_eq!((width(0.25, 0.375), width(1.5_f32, 1.5)), (0.125, 0.0));
        let (tiny, large) = (f64::from_parts(1, -60), 3.0_f64.next_up());
        assert_eq!((width(-tiny, 1.0), width(tiny, 1.0)), (1.0_f64.next_up(), 1.0));
        assert_eq!((width(-1e-30_f32, 3.0), width(1e-30_f32, 3.0)), (3.0_f32.next_up(), 3.0));
        assert_eq!(width(-1.0, large), 4.0_f64.next_up());
        assert_eq!((width(f64::MIN, f64::MAX), width(0.5, f64::INFINITY)), (f64::INFINITY, f64::INFINITY));
    }
}
