//! A float of 128 bits, [`Wide`]: the ends of intervals so narrow that a sum of hundreds of them still rounds to one
//! `f64`.
//!
//! Sums and products are within a unit of the last place, quotients and roots within `2^-115`, `e^x` within `2^-77`,
//! all relative to the value; `ln x` is within `2^-76`, and near 1 within `2^-69` of its value: proved in
//! [`integration`](crate::book::integration).

use core::cmp::Ordering;
use core::ops::Neg;

use super::arithmetic::{max, min};
use super::endpoint::{Endpoint, Toward, sealed::Sealed};
use super::ends::Interval;
use crate::real::Real;
use crate::rounded::wide_elementary::{self, LN_2};
use crate::rounded::{FixedEnclosure, mul_high, reciprocal, square_root};
use Toward::{Down, Up};

/// The number `±m 2^e` with `m` in `[2^127, 2^128)`, or 0 with `m = e = 0`, or `±inf` with `e = i32::MAX`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wide {
    negative: bool,
    m: u128,
    e: i32,
}

/// The leading bit of a significand.
const TOP: u128 = 1 << 127;
/// The largest magnitude of the exponent of a finite number, above that of every product of `f64`.
const LARGEST_EXPONENT: i32 = (1 << 14) - 256;
const _: () = assert!(LARGEST_EXPONENT < 1 << 14, "the logarithm takes no larger ones");
/// The exponent of infinity.
const INFINITE: i32 = i32::MAX;

impl Wide {
    /// Returns the infinity of this sign.
    const fn infinity(negative: bool) -> Self {
        Self { negative, m: TOP, e: INFINITE }
    }

    /// Returns whether the number is 0.
    fn is_zero(self) -> bool {
        self.m == 0
    }

    /// Returns whether the number is infinite.
    fn is_infinite(self) -> bool {
        self.e == INFINITE
    }

    /// Returns the magnitude.
    fn magnitude(self) -> Self {
        Self { negative: false, ..self }
    }

    /// Rounds a number of magnitude `m 2^e`, or, if `inexact`, of one between that and `(m + 1) 2^e`.
    #[inline]
    fn rounded(negative: bool, mut m: u128, mut e: i32, inexact: bool, toward: Toward) -> Self {
        let away = (toward == Up) != negative;
        // One unit of the last place, 2^-127 of the value at most.
        if inexact && away {
            (m, e) = m.checked_add(1).map_or((TOP, e + 1), |next| (next, e));
        }
        if m == 0 {
            return Self::ZERO;
        }
        // Zeros come in below: exact, as what fell off is accounted for above.
        let shift = m.leading_zeros();
        (m, e) = (m << shift, e - shift as i32);
        // Beyond the exponents an end goes to infinity or 0 where that is outward, else to the outermost finite number.
        if e > LARGEST_EXPONENT {
            return if away {
                Self::infinity(negative)
            } else {
                Self { negative, m: u128::MAX, e: LARGEST_EXPONENT }
            };
        }
        if e < -LARGEST_EXPONENT {
            return if away { Self { negative, m: TOP, e: -LARGEST_EXPONENT } } else { Self::ZERO };
        }
        Self { negative, m, e }
    }

    /// Creates `m 2^e`, exactly, for exponents far from the largest.
    pub(crate) fn from_integer(m: u128, e: i32) -> Self {
        Self::rounded(false, m, e, false, Down)
    }

    /// Rounds to the nearest `T` in the given direction.
    pub(crate) fn to_real<T: Real>(self, toward: Toward) -> T {
        let signed = |x: T| if self.negative { -x } else { x };
        if self.is_zero() || self.is_infinite() {
            return signed(if self.is_zero() { T::zero() } else { T::infinity() });
        }
        // 128 bits become P, or fewer below the normal numbers of T.
        let drop = (128 - T::PRECISION as i32).max(T::MIN_EXPONENT - self.e);
        let kept = self.m.checked_shr(drop as u32).unwrap_or(0);
        let inexact = kept.checked_shl(drop as u32).unwrap_or(0) != self.m;
        let away = (toward == Up) != self.negative;
        let x = T::from_parts(kept as u64 + u64::from(inexact && away), self.e + drop);
        signed(if x.is_infinite() && !away { T::max_value() } else { x })
    }
}

impl Neg for Wide {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { negative: !self.negative && self.m != 0, ..self }
    }
}

impl PartialOrd for Wide {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        // Zero, whose significand lacks the leading bit, counts as the smallest magnitude.
        let key = |x: &Self| (x.m != 0, x.e, x.m);
        Some(match (self.negative, other.negative) {
            (false, false) => key(self).cmp(&key(other)),
            (true, true) => key(other).cmp(&key(self)),
            (true, false) => Ordering::Less,
            (false, true) => Ordering::Greater,
        })
    }
}

impl Sealed for Wide {}

impl Endpoint for Wide {
    const ZERO: Self = Self { negative: false, m: 0, e: 0 };
    const HALF: Self = Self { negative: false, m: TOP, e: -128 };
    const ONE: Self = Self { negative: false, m: TOP, e: -127 };
    const INFINITY: Self = Self::infinity(false);
    const NEG_INFINITY: Self = Self::infinity(true);
    /// The constant is rounded to nearest, scale 127.
    const LN_2: Interval<Self> = Interval {
        lower: Self { negative: false, m: (LN_2 << 1) - 1, e: -128 },
        upper: Self { negative: false, m: (LN_2 << 1) + 1, e: -128 },
    };

    fn convert(x: f64, _: Toward) -> Self {
        x.into()
    }

    #[inline]
    fn add(self, other: Self, toward: Toward) -> Self {
        let (large, small) =
            if self.magnitude() >= other.magnitude() { (self, other) } else { (other, self) };
        // Ends that meet in a sum are never infinities of two signs.
        if small.is_zero() || large.is_infinite() {
            return large;
        }
        // The smaller number at the larger one's scale: what falls off is less than a unit of the last place.
        let shift = (large.e - small.e) as u32;
        let addend = small.m.checked_shr(shift).unwrap_or(0);
        let inexact = addend.checked_shl(shift).unwrap_or(0) != small.m;
        if large.negative == small.negative {
            let (sum, carry) = large.m.overflowing_add(addend);
            // 129 bits: the lowest one falls off, too.
            if carry {
                return Self::rounded(
                    large.negative,
                    sum >> 1 | TOP,
                    large.e + 1,
                    inexact || sum & 1 == 1,
                    toward,
                );
            }
            Self::rounded(large.negative, sum, large.e, inexact, toward)
        } else {
            let difference = large.m - addend;
            if inexact && shift == 1 && difference < TOP {
                // What was shifted out is one half, for which there is room: differences of neighbours are exact, as the
                // lemma (128 bits) says of sums.
                return Self::rounded(large.negative, 2 * difference - 1, large.e - 1, false, toward);
            }
            // The fraction that fell off is subtracted, too: the difference is up to a unit smaller.
            Self::rounded(large.negative, difference - u128::from(inexact), large.e, inexact, toward)
        }
    }

    #[inline]
    fn mul(self, other: Self, toward: Toward) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::ZERO;
        }
        let negative = self.negative != other.negative;
        if self.is_infinite() || other.is_infinite() {
            return Self::infinity(negative);
        }
        // 256 bits, of which the upper 128 are kept: at most a unit.
        let (high, low) = (mul_high(self.m, other.m), self.m.wrapping_mul(other.m));
        let e = self.e + other.e + 128;
        if high >= TOP {
            Self::rounded(negative, high, e, low != 0, toward)
        } else {
            Self::rounded(negative, high << 1 | low >> 127, e - 1, low << 1 != 0, toward)
        }
    }

    fn div(self, other: Self, toward: Toward) -> Self {
        let negative = self.negative;
        if self.is_zero() || other.is_infinite() && !self.is_infinite() {
            return Self::ZERO;
        }
        if self.is_infinite() || other.is_zero() {
            return Self::infinity(negative);
        }
        // A power of two divides exactly.
        if other.m == TOP {
            return Self::rounded(negative, self.m, self.e - other.e - 127, false, toward);
        }
        // The significands' quotient, scale 126, below 2: the reciprocal is within 2^-120 and drops a bit of the divisor,
        // 2 (2^6 + 2^-1) units; with the floor less than 2^8 units, by which the end is moved.
        let quotient = mul_high(self.m, reciprocal(other.m >> 1) << 1);
        let bound = if (toward == Up) == negative { quotient - 0x100 } else { quotient + 0x100 };
        Self::rounded(negative, bound, self.e - other.e - 126, false, toward)
    }

    /// Encloses the root: `x / r <= √x <= r` for any `r >= √x`, such as Heron's mean of `r_0` and `x / r_0`.
    fn sqrt(self) -> Interval<Self> {
        if self.is_zero() || self.is_infinite() {
            return Interval { lower: self, upper: self };
        }
        // An even exponent, which the root halves.
        let odd = self.e & 1;
        // The bit that falls off only moves the first guess.
        let m = self.m >> odd;
        // Within 2^-62 of the root, so Heron's mean exceeds it by less than 2^-125.
        let first = Self::from_integer(square_root(m).into(), (self.e + odd) >> 1);
        let root = Self::HALF.mul(first.add(self.div(first, Up), Up), Up);
        Interval { lower: self.div(root, Down), upper: root }
    }

    fn exp(self) -> Interval<Self> {
        if self.is_zero() {
            return Interval::point(Self::ONE);
        }
        // |x| < 2^10: within 2^-77 of the value, and on the right side of 1.
        if self.e <= 10 - 128 {
            let power = enclosed(wide_elementary::exp(self.m, self.e, self.negative));
            let side = if self.negative {
                Interval::between(Self::ZERO, Self::ONE)
            } else {
                Interval::between(Self::ONE, Self::INFINITY)
            };
            return power.intersection(side);
        }
        // e^1024 > 2^1477, since 1024 / ln 2 = 1477.3...
        let bound = Self { negative: false, m: TOP, e: if self.negative { -1477 - 127 } else { 1477 - 127 } };
        if self.negative {
            Interval { lower: Self::ZERO, upper: bound }
        } else {
            Interval { lower: bound, upper: Self::INFINITY }
        }
    }

    fn ln(self) -> Interval<Self> {
        if self.is_zero() || self.is_infinite() {
            // ln 0 = -inf, ln inf = inf: ends without bound.
            let end = Self::infinity(self.is_zero());
            return Interval { lower: end, upper: end };
        }
        // In [1/2, 2), where x - 1 is exact: near 1 within 2^-69 of the value.
        if self.e == -128 || self.e == -127 {
            let z = self.add(-Self::ONE, Down);
            if is_small(z) {
                return ln_1p(z);
            }
        }
        // Elsewhere within 2^-76.
        let (magnitude, below_one) = wide_elementary::ln(self.m, self.e);
        let magnitude = enclosed(magnitude);
        if below_one { -magnitude } else { magnitude }
    }

    /// Encloses the entropy, which rises to 1 at 1/2 and falls; its slope is `log2((1 - p) / p)`.
    fn entropy(p: Interval<Self>) -> Interval<Self> {
        let rest = Interval::point(Self::ONE) - p;
        let least = min(p.lower, rest.lower);
        if is_narrow(p) && least > Self::ZERO {
            // least >= 2^(e + 127) = 2^-k, so the slope is at most k.
            return beside(entropy(p.lower), p, Self::from_integer((-127 - least.e) as u128, 0));
        }
        // The entropies at both ends, and 1 if 1/2 is between them.
        let (lower, upper) = (entropy(p.lower), entropy(p.upper));
        let greatest = if p.contains(Self::HALF) { Self::ONE } else { max(lower.upper, upper.upper) };
        Interval { lower: min(lower.lower, upper.lower), upper: greatest }
    }

    /// Encloses the entropy at log-odds, an even function that falls from 1 at 0; its slope, `-l p (1 - p) / ln 2`, is below
    /// 1/2 in magnitude.
    fn entropy_from_log_odds(l: Interval<Self>) -> Interval<Self> {
        if is_narrow(l) {
            return beside(entropy_from_log_odds(l.lower.magnitude()), l, Self::HALF);
        }
        // It falls with |l|: the far end has the least entropy, the near one the greatest.
        let far = entropy_from_log_odds(l.magnitude());
        let near = max(max(l.lower, -l.upper), Self::ZERO);
        Interval { lower: far.lower, upper: entropy_from_log_odds(near).upper }
    }
}

/// Returns whether an interval is so narrow, `2^-70`, that a bound on the slope does as well as its other end.
fn is_narrow(x: Interval<Wide>) -> bool {
    const NARROW: Wide = Wide { negative: false, m: TOP, e: -127 - 70 };
    x.width() <= NARROW
}

/// Encloses the values over `x` of a function with the given value at the lower end of `x` and slopes up to a magnitude of
/// `slope`.
fn beside(value: Interval<Wide>, x: Interval<Wide>, slope: Wide) -> Interval<Wide> {
    // The mean value theorem: the value moves by slope times width at most.
    let change = slope.mul(x.width(), Up);
    value + Interval { lower: -change, upper: change }
}

/// Encloses the entropy: `H ln 2 = -q ln q - (1 - q) ln(1 - q)` with `q` the smaller of `p` and `1 - p`.
fn entropy(p: Wide) -> Interval<Wide> {
    let (one, p) = (Interval::point(Wide::ONE), Interval::point(p));
    let rest = one - p;
    if p.lower.is_zero() || rest.upper.is_zero() {
        return Interval::point(Wide::ZERO);
    }
    let (small, large) = if p.upper <= Wide::HALF { (p, rest) } else { (rest, p) };
    // 1 - q is near 1 if q is small: there the logarithm of 1 - q is taken of q, to all its digits.
    let of_large = if is_small(small.upper) { (-small).rising(ln_1p) } else { large.rising(Wide::ln) };
    // All terms have one sign, so the sum is within 2^-66, as its logarithms are.
    -(small * small.rising(Wide::ln) + large * of_large) / Wide::LN_2
}

/// Encloses the entropy at log-odds: `H ln 2 = ln(1 + x) + l x / (1 + x)` with `x = e^-l`, for `l >= 0`.
fn entropy_from_log_odds(l: Wide) -> Interval<Wide> {
    if l.is_infinite() {
        return Interval::point(Wide::ZERO);
    }
    let x = (-l).exp();
    let sum = Interval::point(Wide::ONE) + x;
    // ln(1 + x), for small x to all its digits.
    let logarithm = if is_small(x.upper) { x.rising(ln_1p) } else { sum.rising(Wide::ln) };
    (logarithm + Interval::point(l) * x / sum) / Wide::LN_2
}

/// Returns whether `|z| < 2^-8`.
fn is_small(z: Wide) -> bool {
    z.is_zero() || z.e < -8 - 127
}

/// Encloses `ln(1 + z)` for `|z| < 2^-8`, to all digits of `z`.
fn ln_1p(z: Wide) -> Interval<Wide> {
    if z.is_zero() {
        return Interval::point(Wide::ZERO);
    }
    // The factor z comes last, with all its bits: within 2^-69 of the value.
    Interval::point(z) * enclosed(wide_elementary::ln_1p_over(z.m, z.e, z.negative))
}

impl<T: Real> From<T> for Wide {
    fn from(x: T) -> Self {
        if x.is_infinite() {
            return Self::infinity(x < T::zero());
        }
        let (m, e) = x.parts();
        let magnitude = Self::from_integer(u128::from(m), e);
        if x < T::zero() { -magnitude } else { magnitude }
    }
}

impl<T: Real> From<Interval<T>> for Interval<Wide> {
    fn from(x: Interval<T>) -> Self {
        Self { lower: x.lower.into(), upper: x.upper.into() }
    }
}

/// Converts an enclosure by integers.
fn enclosed(value: FixedEnclosure) -> Interval<Wide> {
    let end = |m| Wide::from_integer(m, value.exponent);
    Interval { lower: end(value.lo), upper: end(value.lo + value.width) }
}

#[cfg(test)]
mod tests;
