//! Entropy and information of one cell, and its occupancy from log-odds: Eqs. 1 and 3, correctly rounded.
//!
//! The special values (unknown, certain) are decided here; all others go through the three steps.

use super::round::{FixedEnclosure, Midpoint};
use super::ziv::{beyond_exponential, normalised, round_to_nearest};
use super::{approximate, compare, fixed};
use crate::real::Real;

/// The enclosures of `H` and `I` of a cell. Each is rounded only when it is asked for: rounding may need the
/// comparison.
pub(crate) enum CellEnclosures {
    /// `H = 1` and `I = 0`, exactly: `p = 1/2`.
    Unknown,
    /// `H = 0` and `I = 1`: `p` is 0 or 1, or so near that both round to these.
    Certain,
    /// Values between 0 and 1, neither of which is a float.
    Between {
        /// `H`, in bits.
        entropy: Unrounded,
        /// `I`, in bits.
        information: Unrounded,
    },
}

/// A value that is no float: its enclosure, and how it is compared with a midpoint.
#[derive(Clone, Copy)]
pub(crate) struct Unrounded {
    value: FixedEnclosure,
    /// The comparison of [`compare`] that belongs to the value.
    is_above: fn(u64, i32, Midpoint) -> bool,
    /// The significand and exponent at which the value is taken.
    argument: (u64, i32),
}

impl Unrounded {
    /// Rounds to the nearest float.
    #[inline]
    fn round<T: Real>(self) -> T {
        let (m, e) = self.argument;
        round_to_nearest(self.value, |midpoint| (self.is_above)(m, e, midpoint))
    }
}

impl CellEnclosures {
    /// Encloses entropy and information at `p` in `[0, 1]`.
    #[inline]
    pub(crate) fn at_occupancy<T: Real>(p: T) -> Self {
        if p == T::HALF {
            return Self::Unknown;
        }
        if p.is_zero() || p == T::one() {
            return Self::Certain;
        }
        let argument @ (m, e) = normalised(p);
        let (entropy, information) = approximate::from_occupancy(m, e);
        Self::Between {
            entropy: Unrounded { value: entropy, is_above: compare::entropy, argument },
            information: Unrounded { value: information, is_above: compare::information, argument },
        }
    }

    /// Encloses entropy and information at log-odds `l`, not NaN.
    #[inline]
    pub(crate) fn at_log_odds<T: Real>(l: T) -> Self {
        if l.is_zero() {
            return Self::Unknown;
        }
        if beyond_exponential(l) {
            return Self::Certain;
        }
        let argument @ (m, e) = normalised(l);
        let (entropy, information) = approximate::from_log_odds(m, e);
        Self::Between {
            entropy: Unrounded { value: entropy, is_above: compare::entropy_from_log_odds, argument },
            information: Unrounded {
                value: information,
                is_above: compare::information_from_log_odds,
                argument,
            },
        }
    }

    /// Rounds `H` to the nearest float.
    #[inline]
    pub(crate) fn entropy<T: Real>(&self) -> T {
        match self {
            Self::Unknown => T::one(),
            Self::Certain => T::zero(),
            Self::Between { entropy, .. } => entropy.round(),
        }
    }

    /// Rounds `I` to the nearest float.
    #[inline]
    pub(crate) fn information<T: Real>(&self) -> T {
        match self {
            Self::Unknown => T::zero(),
            Self::Certain => T::one(),
            Self::Between { information, .. } => information.round(),
        }
    }
}

/// Computes `1 / (1 + e^-l)`, correctly rounded, for `l` not NaN.
pub(crate) fn occupancy_from_log_odds<T: Real>(l: T) -> T {
    let negative = l.is_sign_negative();
    if l.is_zero() {
        return T::HALF;
    }
    if beyond_exponential(l) {
        return if negative { T::zero() } else { T::one() };
    }
    let (m, e) = normalised(l);
    let value = approximate::occupancy(fixed::floor_117(m, e), negative);
    round_to_nearest(value, |midpoint| compare::occupancy(m, e, negative, midpoint))
}
