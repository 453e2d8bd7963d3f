//! The constants against big arithmetic, digit by digit, and the kernels within their stated errors.

use super::super::integers::ball::Ball;
use super::super::oracle::{Oracle, SCALE};
use super::super::tests::Random;
use super::*;
use num_bigint::BigInt;
use std::format;

/// Whether `constant`, of the given scale, is the integer nearest to `value / unit`.
fn is_nearest(constant: u128, scale: i32, value: &Ball, unit: &Ball) -> bool {
    let [below, above] = [constant - 1, constant].map(|c| {
        let midpoint = Ball::fixed(c, scale, 4).plus(&Ball::fixed(1, scale + 1, 4));
        value.is_above(&midpoint.times(unit))
    });
    (below, above) == (Some(true), Some(false))
}

fn one() -> Ball {
    Ball::dyadic(1, 0, 4)
}

/// `ln 2` of the other oracle, by another series: `2 artanh(1/3)`.
fn ln2() -> Oracle {
    Oracle::dyadic(1, -1).minus_ln()
}

#[test]
fn the_logarithm_of_two_is_right() {
    assert!(is_nearest(LN2, 127, &Ball::ln2(4), &one()));
    for (constant, exponent) in [(INV_LN2, 0), (HALF_INV_LN2, -1), (EIGHTH_INV_LN2, -3)] {
        assert!(is_nearest(constant, 127, &Ball::dyadic(1, exponent, 4), &Ball::ln2(4)), "{constant}");
    }
    let nearest = ln2().bounds().map(|end| ((end >> (SCALE - 128)) + 1) >> 1);
    assert_eq!(nearest, [LN2, LN2].map(BigInt::from));
}

#[test]
fn the_table_of_logarithms_is_right() {
    for (i, &(r, minus_log2_r)) in (0..).zip(&LOG_TABLE) {
        for x in [256 + i, 257 + i] {
            assert!((x * r).abs_diff(1 << 19) < 1 << 11, "|x r - 1| < 2^-8 at {i}");
        }
        // r = 1 - q.
        let q = Ball::dyadic((1 << 11) - r, -11, 4);
        assert!(is_nearest(minus_log2_r, 120, &q.times(&q.log_series()), &Ball::ln2(4)), "{i}");
    }
}

#[test]
fn the_table_of_powers_is_right() {
    assert_eq!(EXP_TABLE[0], 1 << 127);
    for (i, &power) in (0..).zip(&EXP_TABLE).skip(1) {
        assert!(is_nearest(power, 127, &Ball::ln2(4).scaled(i, -8).exp_neg(), &one()), "{i}");
    }
}

/// Asserts that `|value - exact| < error` for numbers of one scale, given bounds of the exact one.
fn assert_within(value: u128, [lo, hi]: [&BigInt; 2], scale: usize, error: u128, what: &str) {
    let [value, error] = [value, error].map(|x| BigInt::from(x) << (SCALE - scale));
    assert!(&value - lo < error && hi - &value < error, "{what}");
}

/// `-log2 x` for `x` in `(0, 1]`.
fn minus_log2(x: &Oracle) -> Oracle {
    x.minus_ln().over(&ln2())
}

#[test]
fn logarithms_are_within_their_error() {
    let mut random = Random(11);
    for j in 0..300 {
        let k = if j % 2 == 0 { 52 } else { 60 };
        let n = 1 << k | random.next() >> (64 - k) >> (random.below(2) * random.below(k.into()));
        let log = ONE_120 - log2(n, k) as u128;
        let exact = minus_log2(&Oracle::dyadic(n, -(k as i32) - 1));
        assert_within(log, exact.bounds(), 120, LOG_ERROR, &format!("log2 ({n} / 2^{k})"));
    }
}

#[test]
fn quotients_of_logarithms_are_within_their_error() {
    let mut random = Random(13);
    for _ in 0..200 {
        // z from 2^-8 down to 2^-40, scale 71.
        let z = (random.next() >> 1 >> random.below(32)) | 1;
        let (one, magnitude) = (Oracle::dyadic(1, 0), Oracle::dyadic(z, -71));
        let exact = minus_log2(&one.minus(&magnitude)).over(&magnitude);
        let what = format!("log2 (1 ± z) / z at {z} / 2^71");
        assert_within(log2_1p_over(z, true), exact.bounds(), 112, LOG_1P_OVER_ERROR, &what);
        // log2 (1 + z) = 1 - (-log2 ((1 + z) / 2)).
        let half = Oracle::dyadic(1, -1).plus(&Oracle::dyadic(z, -72));
        let exact = one.minus(&minus_log2(&half)).over(&magnitude);
        assert_within(log2_1p_over(z, false), exact.bounds(), 112, LOG_1P_OVER_ERROR, &what);
    }
}

#[test]
fn exponentials_are_within_their_error() {
    let mut random = Random(17);
    for _ in 0..300 {
        let (m, e) = (1 << 52 | random.next() >> 12, -(random.below(80) as i32) - 45);
        let (y, k, t) = exp_neg(floor_117(m, e));
        assert!(((1 << 125) - EXP_ERROR..=1 << 126).contains(&y), "1/2 - 2^-78 <= y <= 1");
        let l = Oracle::dyadic(m, e);
        let power = l.exp_neg().bounds().map(|end| end << k);
        assert_within(y, [&power[0], &power[1]], 126, EXP_ERROR, &format!("e^-l at l = {m} 2^{e}"));
        assert_within(t, l.over(&ln2()).bounds(), 116, 2, &format!("l / ln 2 at l = {m} 2^{e}"));
    }
}

#[test]
fn reciprocals_are_within_their_error() {
    let mut random = Random(19);
    let mut check = |w: u128| {
        // |w inverse - 2^252| < 2^(252 - 116).
        let error: BigInt = BigInt::from(w) * reciprocal(w) - (BigInt::from(1) << 252);
        assert!(error.magnitude().bits() <= 252 - 116, "{w}: {error}");
    };
    [1 << 126, (1 << 126) + 1, (1 << 127) - 1, 1 << 127].into_iter().for_each(&mut check);
    for j in 0..2000 {
        let fraction = u128::from(random.next()) << 62 | u128::from(random.next() >> 2);
        check((1 << 126) + (fraction >> (j % 100)));
    }
}

#[test]
fn high_products_are_exact() {
    let mut random = Random(23);
    let mut operand = || {
        let pick = [0, u64::MAX, 1, random.next(), random.next()];
        let [high, low] = [0, 1].map(|_| pick[random.below(5) as usize]);
        u128::from(high) << 64 | u128::from(low)
    };
    for _ in 0..5000 {
        let (a, b) = (operand(), operand());
        assert_eq!(BigInt::from(mul_high(a, b)), (BigInt::from(a) * b) >> 128);
    }
}
