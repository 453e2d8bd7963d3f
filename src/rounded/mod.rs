//! Correct rounding of entropy, information and occupancy, of `e^x`, `ln x` and the Gaussian, by Ziv's strategy, in integers.
//!
//! 1. [`enclose`] computes the value in 128-bit fixed point, with a proved bound on its error ([`fixed`]).
//! 2. [`Enclosure::round`] rounds it, if the whole enclosure rounds to one float ([`enclosure`]).
//! 3. If not, the enclosure holds one midpoint between two floats, and [`exact`] decides on which side of it the value
//!    lies, in integers of 256 bits, then 512, and so on.
//!
//! Integers because they are exact where floating point rounds, the same on every platform, and easy to prove: every
//! error is a discarded fraction. The proof is the chapter [`rounding`](crate::book::rounding); `proofs/` has it
//! machine-checked.

mod angle;
mod big;
#[rustfmt::skip] // as `proofs/constants.sollya` writes it
mod constants;
mod distance;
mod enclose;
mod enclosure;
mod exact;
pub(crate) mod extended;
mod fixed;
mod fusion;
mod gaussian;
#[cfg(feature = "std")]
pub(crate) mod lanes;
pub(crate) mod limbs;
mod log_odds;
pub(crate) mod mean;
mod natural;
mod root;
mod storage;

pub(crate) use angle::{cos_sin, turns};
pub(crate) use distance::{Coordinate, distance, multiple};
pub(crate) use enclosure::{Enclosure, round_integer, round_limbs};
pub(crate) use fixed::{horner, mul_high, reciprocal, shift_right};
pub(crate) use fusion::fused;
pub(crate) use gaussian::gaussian;
pub(crate) use log_odds::{
    LOG_ODDS_SCALE, fixed_log_odds, log_odds_from_occupancy, occupancy_from_fixed_log_odds, round_log_odds,
};
pub(crate) use natural::{Leading, Natural, leading, quotient};
pub(crate) use root::square_root;

use crate::real::Real;
use enclosure::{Midpoint, Rounded};

/// `H` and `I` of a cell, each rounded only when it is asked for: rounding may need the comparison.
pub(crate) enum Bits {
    Unknown,
    Certain,
    Between { entropy: Uncertain, information: Uncertain },
}

/// A value that is not a float, and how it compares with a midpoint: a comparison of [`exact`], at the argument `m 2^e`.
#[derive(Clone, Copy)]
pub(crate) struct Uncertain {
    value: Enclosure,
    is_above: fn(u64, i32, Midpoint) -> bool,
    argument: (u64, i32),
}

impl Uncertain {
    #[inline]
    fn round<T: Real>(self) -> T {
        let (m, e) = self.argument;
        settle(self.value, |midpoint| (self.is_above)(m, e, midpoint))
    }
}

impl Bits {
    /// At `p` in `[0, 1]`.
    #[inline]
    pub(crate) fn at_occupancy<T: Real>(p: T) -> Self {
        if p == T::HALF {
            return Self::Unknown;
        }
        if p.is_zero() || p == T::one() {
            return Self::Certain;
        }
        let argument @ (m, e) = normalised(p);
        let (entropy, information) = enclose::from_occupancy(m, e);
        Self::Between {
            entropy: Uncertain { value: entropy, is_above: exact::entropy, argument },
            information: Uncertain { value: information, is_above: exact::information, argument },
        }
    }

    /// At log-odds `l`, not NaN.
    #[inline]
    pub(crate) fn at_log_odds<T: Real>(l: T) -> Self {
        if l.is_zero() {
            return Self::Unknown;
        }
        if beyond_exponential(l) {
            return Self::Certain;
        }
        let argument @ (m, e) = normalised(l);
        let (entropy, information) = enclose::from_log_odds(m, e);
        Self::Between {
            entropy: Uncertain { value: entropy, is_above: exact::entropy_from_log_odds, argument },
            information: Uncertain {
                value: information,
                is_above: exact::information_from_log_odds,
                argument,
            },
        }
    }

    #[inline]
    pub(crate) fn entropy<T: Real>(&self) -> T {
        match self {
            Self::Unknown => T::one(),
            Self::Certain => T::zero(),
            Self::Between { entropy, .. } => entropy.round(),
        }
    }

    #[inline]
    pub(crate) fn information<T: Real>(&self) -> T {
        match self {
            Self::Unknown => T::zero(),
            Self::Certain => T::one(),
            Self::Between { information, .. } => information.round(),
        }
    }
}

/// `1 / (1 + e^-l)` for `l` not NaN.
pub(crate) fn occupancy_from_log_odds<T: Real>(l: T) -> T {
    let negative = l.is_sign_negative();
    if l.is_zero() {
        return T::HALF;
    }
    if beyond_exponential(l) {
        return if negative { T::zero() } else { T::one() };
    }
    let (m, e) = normalised(l);
    let value = enclose::occupancy(fixed::scale_117(m, e), negative);
    settle(value, |midpoint| exact::occupancy(m, e, negative, midpoint))
}

/// `e^x`; NaN at NaN.
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
    settle(enclose::exp(m, e, negative), |midpoint| exact::exp(m, e, negative, midpoint))
}

/// `ln x`; `-inf` at 0, NaN below 0 and at NaN.
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
    let magnitude: T = settle(enclose::ln(m, e), |midpoint| exact::ln(m, e, below_one, midpoint));
    if below_one { -magnitude } else { magnitude }
}

/// Whether `|l| >= 2^10`: then `e^-|l| < 2^-1477`, and `H`, `1 - p` and `e^-|l|` are below half of the smallest subnormal, and
/// `e^|l|` above the largest number.
fn beyond_exponential<T: Real>(l: T) -> bool {
    l.abs().widen() >= 1024.0
}

/// `|x| = m 2^e` with a significand in `[2^52, 2^53)`, for `x` finite and not 0.
pub(crate) fn normalised<T: Real>(x: T) -> (u64, i32) {
    let (m, e) = x.parts();
    let shift = m.leading_zeros() as i32 - 11;
    (m << shift, e - shift)
}

/// `|x| = m 2^e` with an odd significand, for `x` finite; `None` for 0.
pub(crate) fn odd_parts<T: Real>(x: T) -> Option<(u64, i32)> {
    let (m, e) = x.parts();
    let zeros = m.trailing_zeros();
    (m != 0).then(|| (m >> zeros, e + zeros as i32))
}

/// The value in the enclosure, rounded to nearest; `is_above` says whether it lies above a midpoint.
#[inline]
fn settle<T: Real>(value: Enclosure, is_above: impl FnOnce(Midpoint) -> bool) -> T {
    match value.round() {
        Rounded::Decided(x) => x,
        Rounded::Between { below, above, midpoint } => {
            if is_above(midpoint) {
                above
            } else {
                below
            }
        }
    }
}

#[cfg(test)]
mod tests;
#[cfg(test)]
pub(crate) mod wide;
