//! Powers of intervals as functions of one number: `x^n` and `x ln x`, whose ranges know that every `x` in them is the
//! same.

use super::arithmetic::max;
use super::endpoint::Endpoint;
use super::ends::Interval;
use crate::scalar::Scalar;

/// `1/e`, where `x ln x` is least, lies between these two.
const TURN: [f64; 2] = [0.367_879_441_171_442_3, 0.367_879_441_171_442_4];

impl<T: Endpoint> Interval<T> {
    /// Encloses `x^n`; everything about 0 for negative odd `n`.
    pub(super) fn power(self, n: i32) -> Self {
        if self.is_empty() {
            return self;
        }
        // Even powers fall up to 0 and rise from there: those of the magnitudes. Odd ones rise.
        let [from, to] =
            if n % 2 == 0 { [self.mignitude(), self.magnitude()] } else { [self.lower, self.upper] };
        let exponent = n.unsigned_abs();
        let [lower, upper] = [from, to].map(|x| {
            // x^n of the magnitude, with the sign of an odd power: product takes no negative number.
            if x < T::ZERO { -product(Self::point(-x), exponent) } else { product(Self::point(x), exponent) }
        });
        let power = Self::between(lower.lower, upper.upper);
        // The quotient knows what 0 in the divisor means.
        if n < 0 { Self::constant(1.0) / power } else { power }
    }

    /// Encloses `x ln x` of the numbers from 0 on; 0 at 0.
    pub(super) fn times_logarithm(self) -> Self {
        let x = self.intersection(Self::between(T::ZERO, T::INFINITY));
        if x.is_empty() {
            return x;
        }
        let at = |x: T| if x == T::ZERO { Self::point(x) } else { Self::point(x) * T::ln(x) };
        let ends = at(x.lower).hull(at(x.upper));
        // Falling up to 1/e, rising from there: the least value is at an end, or -1/e.
        let [before, after] = TURN.map(Self::constant);
        if x.lower <= after.upper && x.upper >= before.lower {
            ends.hull(-Self::constant(-1.0).exp())
        } else {
            ends
        }
    }

    /// Returns the smallest magnitude in it.
    pub(crate) fn mignitude(&self) -> T {
        max(max(self.lower, -self.upper), T::ZERO)
    }
}

/// Encloses `x^n` for a number `x >= 0`, by squares: each product rounds outward.
fn product<T: Endpoint>(x: Interval<T>, n: u32) -> Interval<T> {
    let (mut power, mut square, mut rest) = (Interval::constant(1.0), x, n);
    while rest > 0 {
        if rest % 2 == 1 {
            power = power * square;
        }
        rest /= 2;
        // The square after the last bit is not needed, and might have no bound.
        if rest > 0 {
            square = square * square;
        }
    }
    power
}
