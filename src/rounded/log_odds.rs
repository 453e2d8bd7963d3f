//! The log-odds `l = ln (p / (1 - p))` of an occupancy: correctly rounded, and in fixed point, so that sums are
//! exact.
//!
//! `|l| = ln ((1 - q) / q)` with `q = min(p, 1 - p)`. No ties: a tie `c` would make `e^c` rational (Lindemann). The
//! errors are derived in [`docs/rounding.md`](crate::book::rounding), "The enclosures", 12.

use super::approximate::{self, smaller_probability};
use super::compare::{decide, exp_neg_dyadic};
use super::constants::LN2;
use super::fixed::{
    LOG_1P_OVER_ERROR, LOG_ERROR, floor_71, log2_1p_over, minus_log2_112, minus_log2_120, mul_high,
    shift_right,
};
use super::integers::ball::Ball;
use super::round::{FixedEnclosure, Midpoint, round_integer};
use super::ziv::{normalised, round_to_nearest};
use crate::real::Real;

/// The scale of log-odds in fixed point: integers in units of `2^-80` nats.
pub(crate) const LOG_ODDS_SCALE: i32 = 80;

/// Computes `ln (p / (1 - p))`, correctly rounded, for `p` in `[0, 1]`.
pub(crate) fn log_odds_from_occupancy<T: Real>(p: T) -> T {
    if p == T::HALF {
        return T::zero();
    }
    let magnitude = if p.is_zero() || p == T::one() {
        T::infinity()
    } else {
        let (m, e) = normalised(p);
        let Magnitude { value, error, exponent } = magnitude(m, -e);
        round_to_nearest(FixedEnclosure::around(value, error, exponent), |midpoint| is_above(m, -e, midpoint))
    };
    if p < T::HALF { -magnitude } else { magnitude }
}

/// Computes `ln (p / (1 - p))` in units of `2^-80`, within `2^4` units, for `p` in `[0, 1]`; `±2^100` units for the
/// infinities.
///
/// The result is 0 only for `p = 1/2`: the least magnitude of the others is `2^-52`.
pub(crate) fn fixed_log_odds<T: Real>(p: T) -> i128 {
    if p == T::HALF {
        return 0;
    }
    let magnitude = if p.is_zero() || p == T::one() {
        1 << 100
    } else {
        let (m, e) = normalised(p);
        let Magnitude { value, exponent, .. } = magnitude(m, -e);
        // At most 12 units of error, and this floor.
        shift_right(value, -exponent - LOG_ODDS_SCALE) as i128
    };
    if p < T::HALF { -magnitude } else { magnitude }
}

/// Rounds a sum of log-odds in fixed point to the nearest float.
pub(crate) fn round_log_odds<T: Real>(sum: i128) -> T {
    let magnitude: T = round_integer(sum.unsigned_abs(), -LOG_ODDS_SCALE, false);
    if sum < 0 { -magnitude } else { magnitude }
}

/// Computes `1 / (1 + e^-l)` for log-odds in fixed point, within 0.501 ulp: as `l` is a rounded sum, no more is asked,
/// and an enclosure that holds a midpoint is rounded down.
pub(crate) fn occupancy_from_fixed_log_odds<T: Real>(sum: i128) -> T {
    if sum == 0 {
        return T::HALF;
    }
    let l = sum.unsigned_abs();
    // From 2^10 on, p is 0 or 1.
    if l >> (LOG_ODDS_SCALE + 10) != 0 {
        return if sum < 0 { T::zero() } else { T::one() };
    }
    // From scale 80 to 117: exact.
    round_to_nearest(approximate::occupancy(l << (117 - LOG_ODDS_SCALE), sum < 0), |_| false)
}

/// The magnitude of log-odds: `value 2^exponent`, within `error` units.
pub(super) struct Magnitude {
    pub(super) value: u128,
    error: u128,
    pub(super) exponent: i32,
}

/// Computes `|l|` for `p = m 2^-n`, `2^52 <= m < 2^53`.
pub(super) fn magnitude(m: u64, n: i32) -> Magnitude {
    // |2p - 1| = d 2^-n, exactly; below 2^-8 the two logarithms would cancel.
    if n <= 54 {
        let d = (2 * m).abs_diff(1 << n);
        if d < 1 << (n - 8) {
            return magnitude_near_unknown(d, n);
        }
    }
    let (m, n) = smaller_probability(m, n);
    if n <= 60 { magnitude_with_two_logarithms(m, n) } else { magnitude_with_small_occupancy(m, n) }
}

/// Computes `|l| = ln (1 + z) - ln (1 - z)` at `|2p - 1| = z = d 2^-n < 2^-8`, each logarithm a slope times `z`.
fn magnitude_near_unknown(d: u64, n: i32) -> Magnitude {
    // Exact at scale 71, as n is at most 54.
    let z = d << (71 - n);
    let above = log2_1p_over(z, false);
    let below = log2_1p_over(z, true);
    // The sum of both slopes, at scale 126 = 112 + 14, times ln 2: scale 125.
    let slope = mul_high((above + below) << 14, LN2);
    let shift = d.leading_zeros() as i32;
    let significand = u128::from(d << shift) << 64;
    let value = mul_high(significand, slope);
    // The error of the slopes, 2 LOG_1P_OVER_ERROR 2^14 (ln 2) / 2, leaves room for three floors.
    Magnitude { value, error: LOG_1P_OVER_ERROR << 14, exponent: -61 - shift - n }
}

/// Computes `|l| = (log2 (1 - q) - log2 q) ln 2` for `q = m 2^-n >= 2^-8`.
fn magnitude_with_two_logarithms(m: u64, n: i32) -> Magnitude {
    let minus_log2_q = minus_log2_120(m, 52, n);
    let rest = (1 << n) - m;
    let minus_log2_rest = minus_log2_120(rest, n as u32 - 1, n);
    // Scale 120 = 120 + 128 - 128. Two logarithms and ln 2 make 1.39 LOG_ERROR, and floors.
    let value = mul_high((minus_log2_q - minus_log2_rest) as u128, LN2 << 1);
    Magnitude { value, error: 2 * LOG_ERROR, exponent: -120 }
}

/// Computes `|l| = (log2 (1 - q) - log2 q) ln 2` for `q = m 2^-n < 2^-8`, with `-log2 (1 - q)` a slope times `q`.
fn magnitude_with_small_occupancy(m: u64, n: i32) -> Magnitude {
    let slope = log2_1p_over(floor_71(m, n), true);
    // q slope, scale 112: m 2^75 is q 2^(75 + n), so the mul_high is q slope 2^(n - 53).
    let minus_log2_rest = shift_right(mul_high(u128::from(m) << 75, slope), n - 53);
    let minus_log2_q = minus_log2_112(m, n) as u128;
    // Scale 112. The logarithm's LOG_ERROR >> 8 and 2^-8 of the slope's error: below 1.5 LOG_ERROR >> 8.
    let value = mul_high(minus_log2_q - minus_log2_rest, LN2 << 1);
    Magnitude { value, error: LOG_ERROR >> 6, exponent: -112 }
}

/// Compares `|l|` with the midpoint `c`, for `p = m 2^-n`: it is above if `q < (1 - q) e^-c`.
fn is_above(m: u64, n: i32, midpoint: Midpoint) -> bool {
    let (m, n) = smaller_probability(m, n);
    decide(|fraction| {
        let (y, k) = exp_neg_dyadic(midpoint.m, midpoint.exponent, fraction);
        let rest = Ball::dyadic(1, 0, fraction).minus(&Ball::dyadic(m, -n, fraction));
        // Both sides times 2^(n - 53): q itself may be too small for the ball.
        rest.times(&y).scaled(1, n - 53 - k).is_above(&Ball::dyadic(m, -53, fraction))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::abs_diff_eq;
    use proptest::prelude::*;

    fn occupancy() -> impl Strategy<Value = f64> {
        prop_oneof![
            (1_u64..1.0_f64.to_bits()).prop_map(f64::from_bits),
            0.0..1.0,
            (1_u64..1 << 46).prop_map(|k| 0.5 + k as f64 / (1_u64 << 53) as f64),
            (1_u64..1 << 46).prop_map(|k| 0.5 - k as f64 / (1_u64 << 54) as f64),
            (1_i32..53).prop_map(|k| 1.0 - f64::from_parts(1, -k)),
        ]
        .prop_filter("inside", |&p| p > 0.0 && p < 1.0 && p != 0.5)
    }

    const FRACTION: usize = 4;

    /// `|l| = -ln q + ln (1 - q)` for `p = m 2^-n`, in many bits.
    fn many_bits(m: u64, n: i32) -> Ball {
        let (m, n) = smaller_probability(m, n);
        let q = Ball::dyadic(m, -n, FRACTION);
        // q = (1 - y) 2^(53 - n)
        let y = Ball::dyadic((1 << 53) - m, -53, FRACTION);
        let minus_ln_q = Ball::ln2(FRACTION).scaled((n - 53) as u64, 0).plus(&y.times(&y.log_series()));
        minus_ln_q.minus(&q.times(&q.log_series()))
    }

    /// By about `2^-20` of half a spacing next to a midpoint, on either side: the comparison decides. The results are
    /// Arb's.
    #[test]
    fn log_odds_beside_a_midpoint() {
        for (m, expected) in [
            (0x10_0000_2645_eff9, f64::from_parts(0x13_22f7_fc80_0025, -74)),
            (0x10_0003_a266_1c25, f64::from_parts(0x1d_1330_e128_8004, -70)),
            (0x10_006c_d39a_529b, f64::from_parts(0x1b_34e6_964a_4cc8, -65)),
            (0x10_0640_1a49_0fb5, f64::from_parts(0x19_006a_69d4_5281, -61)),
        ] {
            let p = f64::from_parts(m, -53);
            let Magnitude { value, error, exponent } = magnitude(m, 53);
            let rounded = FixedEnclosure::around(value, error, exponent).round::<f64>();
            assert!(matches!(rounded, super::super::round::Rounded::Between { .. }), "{p:e}");
            assert_eq!(log_odds_from_occupancy(p), expected);
            assert_eq!(log_odds_from_occupancy(1.0 - p), -expected);
        }
    }

    #[test]
    fn the_ends_of_the_fixed_point() {
        assert_eq!(round_log_odds::<f64>(0).to_bits(), 0);
        for far in [1 << (LOG_ODDS_SCALE + 10), fixed_log_odds(1.0_f64), i128::MAX] {
            assert_eq!([-far, far].map(occupancy_from_fixed_log_odds::<f64>), [0.0, 1.0]);
        }
        let near = (1 << (LOG_ODDS_SCALE + 10)) - 1;
        assert_eq!([-near, near].map(occupancy_from_fixed_log_odds::<f64>), [0.0, 1.0]);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// The value lies in the enclosure, which is as narrow as the others of step 1.
        #[test]
        fn the_enclosure_holds_the_log_odds(p in occupancy()) {
            let (m, e) = normalised(p);
            let Magnitude { value, error, exponent } = magnitude(m, -e);
            let end = |x: u128| {
                let part = |x: u128, e| Ball::dyadic(x as u64, e, FRACTION);
                part(x >> 64, exponent + 64).plus(&part(x & u128::from(u64::MAX), exponent))
            };
            let exact = many_bits(m, -e);
            prop_assert_eq!(exact.is_above(&end(value - error)), Some(true), "{:e}", p);
            prop_assert_eq!(end(value + error).is_above(&exact), Some(true), "{:e}", p);
            prop_assert!(value >> 66 >= error);
        }

        /// The two forms agree, as far as the units of the fixed point go.
        #[test]
        fn fixed_and_floating_log_odds_agree(p in occupancy()) {
            let l = log_odds_from_occupancy(p);
            let fixed = fixed_log_odds(p);
            let rounded: f64 = round_log_odds(fixed);
            prop_assert!(abs_diff_eq!(rounded, l, epsilon = l.abs() * f64::EPSILON + f64::from_parts(1, -76)));
            prop_assert_eq!(fixed > 0, p > 0.5);
            prop_assert!(fixed != 0);
        }
    }
}
