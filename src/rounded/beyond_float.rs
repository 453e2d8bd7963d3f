//! Entropy and information of a mean of occupancies, which is no float: from its first 63 bits, in fixed point.
//!
//! At an argument `x + δ`, `x` its first 53 bits, the value is that at `x` plus `δ` times the slope there. The slope of
//! the entropy at `q` is `log2 ((1 - q) / q)`, and that of the information at `d = |2p - 1|` is twice the information
//! over `d`.

use super::approximate;
use super::constants::INV_LN2;
use super::fixed::{mul_high, shift_right};
use super::integers::natural_number::Leading;
use super::log_odds;
use super::round::FixedEnclosure;

/// A number in fixed point: `value 2^exponent`.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Fixed {
    pub(crate) value: u128,
    pub(crate) exponent: i32,
}

/// The entropy and the information of a cell in fixed point, each within `2^-63`.
pub(crate) type Both = (Fixed, Fixed);

/// The entropy and the information of a certain cell, of occupancy 0 or 1.
pub(crate) const CERTAIN: Both =
    (Fixed { value: 0, exponent: -120 }, Fixed { value: 1 << 120, exponent: -120 });

/// The entropy and the information of an unknown cell, of occupancy 1/2.
pub(crate) const UNKNOWN: Both = (CERTAIN.1, CERTAIN.0);

/// Splits 63 bits into the first 53, as `m 2^-n`, and the other 10 with a 0 after them, in units of `2^(-11 - n)`.
fn split(x: Leading) -> (u64, i32, u64) {
    (x.m >> 11, -(x.e + 11), x.m & 0x7ff)
}

/// Returns the middle of an enclosure.
pub(super) fn middle(enclosure: FixedEnclosure) -> Fixed {
    Fixed { value: enclosure.lo + enclosure.width / 2, exponent: enclosure.exponent }
}

/// Computes entropy and information at `|2p - 1| = d`, cut by less than `2^-62 d`; `None` unless `d < 2^-4`.
///
/// `I = d^2 S(d^2)`, so `δ` moves it by `2 I δ / d`, up to `2^-62` of it.
pub(crate) fn at_distance_from_unknown(d: Leading) -> Option<Both> {
    if d.e > -68 {
        return None;
    }
    let (m, n, rest) = split(d);
    let (_, information) = approximate::with_information_series(m, n);
    let mut information = middle(information);
    // 2 I δ / d with δ / d = rest 2^-11 / m.
    information.value += (information.value / u128::from(m) * u128::from(rest)) >> 10;
    // H = 1 - I at scale 120, where an absolute error is enough.
    let at_120 = shift_right(information.value, -120 - information.exponent);
    Some((Fixed { value: (1 << 120) - at_120, exponent: -120 }, information))
}

/// Computes entropy and information at the smaller probability `min(p, 1 - p) = q`, cut by less than `2^-62 q`, for
/// `|2p - 1| >= 2^-4`.
pub(crate) fn at_smaller_probability(q: Leading) -> Both {
    let (m, n, rest) = split(q);
    let (entropy, information) = approximate::from_occupancy(m, -n);
    let (mut entropy, mut information) = (middle(entropy), middle(information));
    let slope = log_odds::magnitude(m, n);
    // δ = rest 2^(-11 - n); the slope in bits is twice this product, since 1 / ln 2 has scale 127.
    let change = u128::from(rest) * (mul_high(slope.value, INV_LN2) >> 11);
    // The 11 bits are in the shift above; what H gains, I loses.
    let exponent = slope.exponent + 1 - n;
    entropy.value += shift_right(change, entropy.exponent - exponent);
    information.value -= shift_right(change, information.exponent - exponent);
    (entropy, information)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rounded::integers::ball::Ball;
    use proptest::prelude::*;

    const FRACTION: usize = 6;

    fn one() -> Ball {
        Ball::dyadic(1, 0, FRACTION)
    }

    /// `H ln 2` at `q = m 2^e <= 1/2`: `q (-ln q) + (1 - q) (-ln (1 - q))`.
    fn entropy_ln2(m: u64, e: i32) -> Ball {
        let q = Ball::dyadic(m, e, FRACTION);
        let z = one().minus(&Ball::dyadic(m, -64, FRACTION));
        let minus_ln_q = Ball::ln2(FRACTION).scaled((-64 - e) as u64, 0).plus(&z.times(&z.log_series()));
        q.times(&minus_ln_q).plus(&one().minus(&q).times(&q).times(&q.log_series()))
    }

    fn ball(x: Fixed) -> Ball {
        let part = |m: u128, e| Ball::dyadic(m as u64, e, FRACTION);
        part(x.value >> 64, x.exponent + 64).plus(&part(x.value & u128::from(u64::MAX), x.exponent))
    }

    /// Whether `x ln 2` is within `2^exponent` of a number.
    fn near(x: Fixed, entropy: &Ball, exponent: i32) -> bool {
        let found = ball(x).times(&Ball::ln2(FRACTION));
        let tolerance = Ball::dyadic(1, exponent, FRACTION);
        entropy.clone().plus(&tolerance).is_above(&found) == Some(true)
            && found.plus(&tolerance).is_above(entropy) == Some(true)
    }

    proptest! {
        /// The argument being exact, only the kernels' errors are left: below `2^-72`.
        #[test]
        fn the_next_bits_are_taken_into_account(m in 1_u64 << 63..=u64::MAX, scale in 0_i32..80) {
            // Below 15/32.
            let m = if scale == 0 { m.min(15 << 60) } else { m };
            let (entropy, information) = at_smaller_probability(Leading { m, e: -65 - scale });
            let exact = entropy_ln2(m, -65 - scale);
            prop_assert!(near(entropy, &exact, -72));
            let complement = Ball::ln2(FRACTION).minus(&exact);
            prop_assert!(near(information, &complement, -72));
        }

        /// `I ln 2 = d^2 sum d^2j / ((2j + 1) (2j + 2))`, relative to `d^2`: the slope is off by `d^2 2^-52` of
        /// `I < 2^-8`.
        #[test]
        fn so_they_are_near_unknown(m in 1_u64 << 63..=u64::MAX, scale in 4_i32..90) {
            let (entropy, information) = at_distance_from_unknown(Leading { m, e: -64 - scale }).unwrap();
            let root = Ball::dyadic(m, -64, FRACTION);
            let square = root.times(&root);
            let exact = square.times(&square.scaled(1, -2 * scale).information_series());
            let scaled = Fixed { exponent: information.exponent + 2 * scale, ..information };
            let found = ball(scaled).times(&Ball::ln2(FRACTION));
            let tolerance = Ball::dyadic(1, -62, FRACTION);
            prop_assert!(exact.clone().plus(&tolerance).is_above(&found) == Some(true));
            prop_assert!(found.plus(&tolerance).is_above(&exact) == Some(true));
            let rest = Ball::ln2(FRACTION).minus(&exact.scaled(1, -2 * scale));
            prop_assert!(near(entropy, &rest, -68));
        }
    }

    #[test]
    fn the_two_forms_part_at_a_sixteenth() {
        assert!(at_distance_from_unknown(Leading { m: u64::MAX, e: -68 }).is_some());
        assert!(at_distance_from_unknown(Leading { m: 1 << 63, e: -67 }).is_none());
    }
}
