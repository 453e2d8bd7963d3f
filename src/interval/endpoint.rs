//! The ends of an interval: floats with arithmetic rounded in a given direction.

use core::fmt::Debug;
use core::ops::Neg;

use super::ends::Interval;

/// The direction in which a result is rounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Toward {
    /// The direction of results that are not above the exact one.
    Down,
    /// The direction of results that are not below the exact one.
    Up,
}

pub(super) mod sealed {
    pub trait Sealed {}
}

/// An end of an interval: `f32`, `f64`, or the wide float of this crate's integrals.
///
/// Sealed: the soundness of every interval depends on it. No operation gets a NaN or makes one: `0 inf = 0`, since an
/// infinite end stands for numbers without bound, each of them finite.
pub trait Endpoint: sealed::Sealed + Copy + Debug + PartialOrd + Neg<Output = Self> {
    /// The number 0.
    const ZERO: Self;
    /// The number 1/2.
    const HALF: Self;
    /// The number 1.
    const ONE: Self;
    /// The end of an interval without upper bound.
    const INFINITY: Self;
    /// The end of an interval without lower bound.
    const NEG_INFINITY: Self;
    /// An interval that contains `ln 2`.
    const LN_2: Interval<Self>;

    /// Rounds `x` in the given direction.
    #[must_use]
    fn convert(x: f64, toward: Toward) -> Self;

    /// Computes `self + other`, rounded in the given direction.
    #[must_use]
    fn add(self, other: Self, toward: Toward) -> Self;

    /// Computes `self * other`, rounded in the given direction.
    #[must_use]
    fn mul(self, other: Self, toward: Toward) -> Self;

    /// Computes `self / other` for `other >= 0`, rounded in the given direction; infinite, with the sign of `self`, if only
    /// `other` is 0.
    #[must_use]
    fn div(self, other: Self, toward: Toward) -> Self;

    /// Encloses `√self`, for `self >= 0`.
    fn sqrt(self) -> Interval<Self>;

    /// Encloses `e^self`.
    fn exp(self) -> Interval<Self>;

    /// Encloses `ln self`, for `self >= 0`.
    fn ln(self) -> Interval<Self>;

    /// Encloses the entropies (bits) of the occupancies `p`, in `[0, 1]`.
    fn entropy(p: Interval<Self>) -> Interval<Self>;

    /// Encloses the entropies (bits) at the log-odds `l`.
    fn entropy_from_log_odds(l: Interval<Self>) -> Interval<Self>;
}
