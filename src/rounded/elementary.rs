//! `e^x` and `ln x`, correctly rounded: the special cases, and the three steps for all other arguments.

use super::ziv::{beyond_exponential, normalised, round_to_nearest};
use super::{approximate, compare};
use crate::real::Real;

/// Computes `e^x`, correctly rounded; NaN at NaN.
pub(crate) fn exp<T: Real>(x: T) -> T {
    if x.is_nan() {
        return x;
    }
    if x.is_zero() {
        return T::one();
    }
    let negative = x.is_sign_negative();
    if beyond_exponential(x) {
        return if negative { T::zero() } else { T::infinity() };
    }
    let (m, e) = normalised(x);
    round_to_nearest(approximate::exp(m, e, negative), |midpoint| compare::exp(m, e, negative, midpoint))
}

/// Computes `ln x`, correctly rounded; `-inf` at 0, NaN below 0 and at NaN.
pub(crate) fn ln<T: Real>(x: T) -> T {
    if x.is_nan() || x < T::zero() {
        return T::nan();
    }
    if x.is_zero() {
        return T::neg_infinity();
    }
    if x == T::one() {
        return T::zero();
    }
    if x.is_infinite() {
        return x;
    }
    let (m, e) = normalised(x);
    let below_one = x < T::one();
    let magnitude: T =
        round_to_nearest(approximate::ln(m, e), |midpoint| compare::ln(m, e, below_one, midpoint));
    if below_one { -magnitude } else { magnitude }
}
