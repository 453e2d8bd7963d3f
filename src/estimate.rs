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

/// Two floats that are proved to have the true value between them, ends included.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    ///
    /// ```
    /// use mean_information::estimate::{Enclosure, Status};
    /// let third = Enclosure { lower: 0.333_f64, upper: 0.334, status: Status::Converged, evaluations: 2 };
    /// assert!(third.contains(1.0 / 3.0) && !third.contains(0.335));
    /// ```
    pub fn contains(&self, x: T) -> bool {
        self.lower <= x && x <= self.upper
    }

    /// Returns `upper - lower`, rounded to nearest.
    ///
    /// ```
    /// use mean_information::estimate::{Enclosure, Status};
    /// let third = Enclosure { lower: 0.25_f64, upper: 0.375, status: Status::Converged, evaluations: 2 };
    /// assert_eq!(third.width(), 0.125);
    /// ```
    pub fn width(&self) -> T {
        self.upper - self.lower
    }
}
