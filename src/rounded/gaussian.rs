//! `e^-r` with `r = (x - z)^2 / (2 s^2)`, as if computed exactly from the three floats and rounded once.
//!
//! `r` is rational, so `e^-r` is transcendental unless `r = 0` (Lindemann): no ties. The errors are derived in
//! [`docs/rounding.md`](crate::book::rounding), "The enclosures", 11.

use super::compare;
use super::fixed::{EXP_ERROR, exp_neg, mul_high, reciprocal, shift_right};
use super::integers::ball::Ball;
use super::round::{FixedEnclosure, Rounded};
use super::short_gaussian::short_gaussian;
use super::ziv::{normalised, round_to_nearest};
use crate::real::Real;

/// Computes `e^(-(x - z)^2 / (2 s^2))`, correctly rounded, for finite `x`, `z` and positive finite `s`.
pub(crate) fn gaussian<T: Real>(x: T, z: T, s: T) -> T {
    if x == z {
        return T::one();
    }
    let (m, e) = normalised(s);
    if let Some(Rounded::Decided(p)) = short_gaussian(x, z, m, e).map(FixedEnclosure::round) {
        return p;
    }
    // In units in which s = m 2^-52.
    let distance = Distance::new(x, z, -52 - e);
    let (d, exponent) = distance.cut();
    let Some(r) = half_square(d, exponent, m) else {
        // e^-1023 is below half of the smallest subnormal.
        return T::zero();
    };
    // r is off by less than 2^9 units, for which EXP_ERROR allows.
    let (y, k, t) = exp_neg(r);
    round_to_nearest(FixedEnclosure::around(y, EXP_ERROR, -126 - k), |midpoint| {
        compare::gaussian(|fraction| distance.ball(fraction), m, t, midpoint)
    })
}

/// The distance of two unequal numbers: the significand and exponent of the larger and of the smaller magnitude.
#[derive(Clone, Copy)]
pub(super) struct Distance {
    pub(super) large: (u64, i32),
    pub(super) small: (u64, i32),
    pub(super) same_sign: bool,
}

impl Distance {
    /// Creates `|x - z| 2^e`.
    pub(super) fn new<T: Real>(x: T, z: T, e: i32) -> Self {
        let (large, small) = if x.abs() >= z.abs() { (x, z) } else { (z, x) };
        let scaled = |x| {
            let (m, exponent) = normalised(x);
            (m, exponent + e)
        };
        let large = scaled(large);
        let small = if small.is_zero() { (0, large.1) } else { scaled(small) };
        Self { large, small, same_sign: x.is_sign_negative() == z.is_sign_negative() }
    }

    /// Returns the number of bits between the two exponents.
    fn gap(self) -> i32 {
        self.large.1 - self.small.1
    }

    /// Returns `d` in `[2^127, 2^128)` and its exponent, with a relative error below `2^-125`; exact up to a gap of 74
    /// bits.
    pub(super) fn cut(self) -> (u128, i32) {
        let ((large, exponent), (small, _), gap) = (self.large, self.small, self.gap());
        // Both with 74 bits more: up to that gap the smaller loses none. Beyond it, less than 2^-74 of the larger's
        // last bit.
        let wide = u128::from(large) << 74;
        let narrow = shift_right(u128::from(small) << 74, gap);
        let sum = if self.same_sign { wide - narrow } else { wide + narrow };
        let shift = sum.leading_zeros() as i32;
        (sum << shift, exponent - 74 - shift)
    }

    /// Returns the 64th part of the distance, which must be below `2^70`.
    pub(super) fn ball(self, fraction: usize) -> Ball {
        let dyadic = |(m, e)| Ball::dyadic(m, e, fraction);
        if self.gap() <= 74 {
            // The two may be huge beside their distance: take the exact distance.
            let (d, e) = self.cut();
            dyadic(((d >> 64) as u64, e + 58)).plus(&dyadic((d as u64, e - 6)))
        } else {
            let (large, small) =
                (dyadic((self.large.0, self.large.1 - 6)), dyadic((self.small.0, self.small.1 - 6)));
            if self.same_sign { large.minus(&small) } else { large.plus(&small) }
        }
    }
}

/// Computes `t^2 / 2`, scale 117, for `t = d 2^e / (m 2^-52)`, with an error below `2^9` units, also if `d` is cut;
/// `None` if it is `2^10` or more.
pub(super) fn half_square(d: u128, e: i32, m: u64) -> Option<u128> {
    // t = ratio 2^(e + 2), t^2 / 2 = square 2^exponent.
    // 1 / s, scale 126: s = m 2^-52 in [1, 2) is m 2^74 there.
    let inverse = reciprocal(u128::from(m) << 74);
    // Relative errors: 2^-125 of d, 2^-120 of the inverse, 2^-123 of this floor; twice their sum in the square, and
    // 2^-121 of its floor.
    let ratio = mul_high(d, inverse);
    let square = mul_high(ratio << 1, ratio << 1);
    // 2 (e + 2) of the ratio's square, 126 = 128 - 2 of the mul_high, and -1 for the half.
    let exponent = 2 * e + 129;
    let top = exponent + 128 - square.leading_zeros() as i32;
    let shift = exponent + 117;
    (top <= 10).then(|| if shift >= 0 { square << shift } else { shift_right(square, -shift) })
}
