//! Entropy and information of a mean of occupancies, which is no float: from its first 63 bits, in fixed point.
//!
//! Of an argument `x + δ`, `x` its first 53 bits, the value is that at `x` and `δ` times the slope there: `log2 ((1 -
//! q) / q)` of the entropy at `q`, twice the value over `d` of the information at `d`.

use super::constants::INV_LN2;
use super::enclose;
use super::enclosure::Enclosure;
use super::fixed::{mul_high, shift_right};
use super::log_odds;
use super::natural::Leading;

/// A number in fixed point, `value 2^exponent`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fixed {
    pub(crate) value: u128,
    pub(crate) exponent: i32,
}

/// Entropy and information in fixed point, each within `2^-63`.
pub(crate) type Both = (Fixed, Fixed);

/// Those of 0 and of 1.
pub(crate) const CERTAIN: Both =
    (Fixed { value: 0, exponent: -120 }, Fixed { value: 1 << 120, exponent: -120 });

/// Those of 1/2.
pub(crate) const UNKNOWN: Both = (CERTAIN.1, CERTAIN.0);

/// The first 53 bits as `m 2^-n`, and the 10 that follow with a 0.
fn split(x: Leading) -> (u64, i32, u64) {
    (x.m >> 11, -(x.e + 11), x.m & 0x7ff)
}

pub(super) fn middle(enclosure: Enclosure) -> Fixed {
    Fixed { value: enclosure.lo + enclosure.width / 2, exponent: enclosure.exponent }
}

/// At `|2p - 1| = d`, cut by less than `2^-62 d`, if it is below `2^-4`.
///
/// `I = d^2 S(d^2)`, so `δ` moves it by `2 I δ / d`, up to `2^-62` of it.
pub(crate) fn beside_unknown(d: Leading) -> Option<Both> {
    if d.e > -68 {
        return None;
    }
    let (m, n, rest) = split(d);
    let (_, information) = enclose::beside_unknown(m, n);
    let mut information = middle(information);
    information.value += (information.value / u128::from(m) * u128::from(rest)) >> 10;
    let at_120 = shift_right(information.value, -120 - information.exponent);
    Some((Fixed { value: (1 << 120) - at_120, exponent: -120 }, information))
}

/// At `min(p, 1 - p) = q`, cut by less than `2^-62 q`, for `|2p - 1| >= 2^-4`.
pub(crate) fn of_minor(q: Leading) -> Both {
    let (m, n, rest) = split(q);
    let (entropy, information) = enclose::from_occupancy(m, -n);
    let (mut entropy, mut information) = (middle(entropy), middle(information));
    let slope = log_odds::magnitude(m, n);
    // δ = rest 2^(-11 - n); the slope in bits is twice this product.
    let change = u128::from(rest) * (mul_high(slope.value, INV_LN2) >> 11);
    let exponent = slope.exponent + 1 - n;
    entropy.value += shift_right(change, entropy.exponent - exponent);
    information.value -= shift_right(change, information.exponent - exponent);
    (entropy, information)
}

#[cfg(test)]
mod tests {
    use super::super::big::Ball;
    use super::*;
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
            let (entropy, information) = of_minor(Leading { m, e: -65 - scale });
            let exact = entropy_ln2(m, -65 - scale);
            prop_assert!(near(entropy, &exact, -72));
            let complement = Ball::ln2(FRACTION).minus(&exact);
            prop_assert!(near(information, &complement, -72));
        }

        /// `I ln 2 = d^2 sum d^2j / ((2j + 1) (2j + 2))`, relative to `d^2`: the slope is off by `d^2 2^-52` of `I < 2^-8`.
        #[test]
        fn beside_unknown_too(m in 1_u64 << 63..=u64::MAX, scale in 4_i32..90) {
            let (entropy, information) = beside_unknown(Leading { m, e: -64 - scale }).unwrap();
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
        assert!(beside_unknown(Leading { m: u64::MAX, e: -68 }).is_some());
        assert!(beside_unknown(Leading { m: 1 << 63, e: -67 }).is_none());
    }
}
