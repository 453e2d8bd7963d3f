//! The elementary functions that the rest of the crate is built on, correctly rounded and the same on every platform.
//!
//! They use the kernels of the entropy ([`rounding`](crate::book::rounding)). No ties: `e^x` and `ln x` are
//! transcendental for every algebraic `x` but 0 and 1 (Lindemann), and a square root that lies on a midpoint would have
//! a square with too many bits to be a float.

use crate::real::Real;
use crate::rounded;

/// Computes `e^x`, correctly rounded (proved, [`rounding`](crate::book::rounding)).
///
/// Special cases: 0 at `-inf`, `inf` at `inf` and on overflow, NaN at NaN.
///
/// ```
/// assert_eq!(mean_information::elementary::exp(-2.0_f64), 0.1353352832366127);
/// ```
pub fn exp<T: Real>(x: T) -> T {
    rounded::exp(x)
}

/// Computes `ln x`, correctly rounded (proved, [`rounding`](crate::book::rounding)).
///
/// Special cases: `-inf` at 0, `inf` at `inf`, NaN below 0 and at NaN.
///
/// ```
/// assert_eq!(mean_information::elementary::ln(10.0_f64), 2.302585092994046);
/// ```
pub fn ln<T: Real>(x: T) -> T {
    rounded::ln(x)
}

/// Computes the square root of `x`, correctly rounded as in IEEE 754 (proved: an integer root and its remainder).
///
/// Special cases: `±0` at `±0`, `inf` at `inf`, NaN below 0 and at NaN.
///
/// ```
/// assert_eq!(mean_information::elementary::sqrt(2.0_f64), 1.4142135623730951);
/// ```
pub fn sqrt<T: Real>(x: T) -> T {
    if x.is_nan() || x < T::zero() {
        return T::nan();
    }
    if x.is_zero() || x.is_infinite() {
        return x;
    }
    let (m, e) = x.parts();
    // An even exponent, and 118 bits or more, so that the root has 59 or more: enough to round 53.
    let shift = m.leading_zeros() as i32 + 54;
    let shift = shift + ((e - shift) & 1);
    let square = u128::from(m) << shift;
    let root = u128::from(rounded::square_root(square));
    rounded::round_integer(root, (e - shift) / 2, root * root != square)
}

/// Computes `e^x - 1`, within 2 ulp (proved: [`quadrature`](crate::book::quadrature)).
///
/// Sums `x + x^2/2 (1 + x/3 (1 + x/4 (...)))` for `|x|` below a quarter; from there on `exp(x) - 1` has that bound, too.
pub(crate) fn exp_m1<T: Real>(x: T) -> T {
    if x.abs() >= T::HALF * T::HALF || x.is_nan() {
        return exp(x) - T::one();
    }
    // The first term left out is x^14 / 14!, below 2^-62 x.
    let series = (3..=13_u32).rev().fold(T::one(), |sum, k| T::one() + x / T::from_parts(k.into(), 0) * sum);
    x + T::HALF * x * x * series
}
