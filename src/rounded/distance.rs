//! The distance `step √(x^2 + y^2)` of a grid point from the origin, as if computed exactly and rounded once.
//!
//! Ties exist here (3, 4, 5), so the last comparison is of exact integers. The proof is the section "The distances" of
//! [`docs/rounding.md`](crate::book::rounding).

use super::integers::ball::Ball;
use super::root::square_root;
use super::round::{FixedEnclosure, Midpoint, Rounded, round_integer};
use super::ziv::{normalised, round_to_nearest};
use crate::real::Real;
use core::cmp::Ordering;

/// The magnitude of `index + fraction`, an integer and a float: a place along one axis, in steps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Coordinate {
    /// The index, and the magnitude of the fraction as a significand and exponent.
    index: u64,
    fraction: (u64, i32),
    /// True if the two have different signs.
    differ: bool,
    /// The magnitude in units of `2^exponent`, exact or at most two units short: 127 bits, unless it is 0.
    significand: u128,
    exponent: i32,
}

/// The number of bits after the point in which index and fraction are added.
const SCALE: i32 = 80;

impl Coordinate {
    /// Creates `|index + fraction|` for `|index| < 2^46` and `|fraction| < 2^46`.
    pub(crate) fn new<T: Real>(index: i64, fraction: T) -> Self {
        let (m, e) = fraction.parts();
        let differ = (index < 0) != fraction.is_sign_negative() && index != 0;
        let index = index.unsigned_abs();
        // Both at scale 80, if the last bit of the fraction allows it; alone, the fraction keeps its own exponent.
        let whole = u128::from(index) << SCALE;
        let (sum, unit) = if index == 0 {
            (u128::from(m), e)
        } else if e + SCALE >= 0 {
            let part = u128::from(m) << (e + SCALE);
            (if differ { whole.abs_diff(part) } else { whole + part }, -SCALE)
        } else {
            // The fraction is below 2^-27 and is cut: the sum is its floor, or one unit less.
            let part = u128::from(m).checked_shr((-SCALE - e) as u32).unwrap_or(0);
            (if differ { whole - part - 1 } else { whole + part }, -SCALE)
        };
        // 127 bits. A sum of 0 has no leading one, and its shift is 127.
        let shift = sum.leading_zeros() as i32 - 1;
        Self { index, fraction: (m, e), differ, significand: sum << (shift & 127), exponent: unit - shift }
    }

    /// Returns true if the magnitude is 0.
    fn is_zero(self) -> bool {
        self.significand == 0
    }

    /// Returns the exponent of the next power of two above the magnitude.
    fn top(self) -> i32 {
        self.exponent + 127
    }

    /// Returns the exponent of the last bit of index and fraction.
    fn lowest(self) -> i32 {
        if self.fraction.0 == 0 { 0 } else { self.fraction.1.min(0) }
    }

    /// Returns `2^-top` times the magnitude, exactly if `fraction` limbs hold all of its bits.
    fn ball(self, top: i32, fraction: usize) -> Ball {
        let whole = Ball::dyadic(self.index, -top, fraction);
        let part = Ball::dyadic(self.fraction.0, self.fraction.1 - top, fraction);
        if !self.differ {
            whole.plus(&part)
        } else if whole.exact_order(&part) == Ordering::Less {
            part.minus(&whole)
        } else {
            whole.minus(&part)
        }
    }
}

/// Computes `step 2^scale √(x^2 + y^2)`, correctly rounded, ties to even, for a positive finite step.
pub(crate) fn distance<T: Real>(step: T, scale: i32, x: Coordinate, y: Coordinate) -> T {
    let (large, small) =
        if x.is_zero() || (!y.is_zero() && x.exponent < y.exponent) { (y, x) } else { (x, y) };
    if large.is_zero() {
        return T::zero();
    }
    let (m, e) = normalised(step);
    let e = e + scale;
    // Units of 2^(large.exponent + 64), in which the larger has 63 bits. Each floor drops less than 1.01, so the root
    // of the sum of squares loses less than 1.5, and its own floor less than one ("The distances", Enclosure).
    let gap = if small.is_zero() { 127 } else { (large.exponent - small.exponent).min(63) + 64 };
    let (a, b) = (large.significand >> 64, small.significand >> gap);
    let root = u128::from(square_root(a * a + b * b));
    // Both ends times the significand of the step: three units of the root in all.
    let m_wide = u128::from(m);
    let value = FixedEnclosure { lo: root * m_wide, width: 3 * m_wide, exponent: large.exponent + 64 + e };
    round_to_nearest(value, |midpoint| rounds_up(m, e, large, small, midpoint))
}

/// Computes `step 2^scale √square`, correctly rounded, if 64 bits of the root decide it, for a positive finite step.
#[inline]
pub(crate) fn distance_by_square<T: Real>(step: T, scale: i32, square: u128) -> Option<T> {
    if square == 0 {
        return Some(T::zero());
    }
    let (m, e) = normalised(step);
    // By an even number of bits, so that the root has 64.
    let shift = square.leading_zeros() & !1;
    let root = u128::from(square_root(square << shift));
    let m = u128::from(m);
    // The root is its floor, or less than one more.
    let value = FixedEnclosure { lo: root * m, width: m, exponent: e + scale - (shift / 2) as i32 };
    match value.round() {
        Rounded::Decided(distance) => Some(distance),
        Rounded::Between { .. } => None,
    }
}

/// Returns true if `m 2^e √(x^2 + y^2)` rounds to the float above the midpoint: compares the squares, exactly.
fn rounds_up(m: u64, e: i32, large: Coordinate, small: Coordinate, midpoint: Midpoint) -> bool {
    let top = large.top();
    // Everything in units in which the distance is in [1/4, 2), with room for every bit of the squares: two limbs or
    // more, and the midpoint, of 54 bits, has its square in them.
    let unit = top + e + 53;
    let lowest = large.lowest().min(small.lowest()) - top - 53;
    let fraction = (2 * -lowest) as usize / 64 + 1;
    let square = |ball: Ball| ball.times(&ball);
    let distance = square(large.ball(top, fraction))
        .plus(&square(small.ball(top, fraction)))
        .scaled(m, -53)
        .scaled(m, -53);
    let bound = square(Ball::dyadic(midpoint.m, midpoint.exponent - unit, fraction));
    match distance.exact_order(&bound) {
        Ordering::Less => false,
        // The midpoint is 2 k + 1 halves, and k the float below.
        Ordering::Equal => midpoint.m & 2 != 0,
        Ordering::Greater => true,
    }
}

/// Computes `step 2^scale index`, correctly rounded, ties to even, for a positive finite step and `index < 2^70`.
pub(crate) fn multiple<T: Real>(step: T, scale: i32, index: u128) -> T {
    let (m, e) = step.parts();
    round_integer(u128::from(m) * index, e + scale, false)
}

#[cfg(test)]
mod tests;
