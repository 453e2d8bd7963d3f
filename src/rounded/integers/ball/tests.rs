//! Balls against exact integers: every result must hold what the operation gives for the ends of its operands.

use super::Ball;
use crate::rounded::oracle::{self, Oracle};
use crate::rounded::tests::Random;
use num_bigint::{BigInt, BigUint};
use std::cmp::Ordering;
use std::vec::Vec;

/// Fraction limbs; not the four that the exact path begins with.
const FRACTION: usize = 3;

impl Ball {
    /// The ends, in units of `2^-(64 fraction)`.
    pub(crate) fn bounds(&self) -> [BigInt; 2] {
        let digits = self.limbs.iter().flat_map(|&limb| [limb as u32, (limb >> 32) as u32]).collect();
        let value = BigInt::from(BigUint::new(digits));
        [&value - self.error, value + self.error]
    }

    /// `value` of the given scale, exactly.
    pub(crate) fn fixed(value: u128, scale: i32, fraction: usize) -> Self {
        let mut high = Self::dyadic((value >> 64) as u64, 64 - scale, fraction);
        let low = Self::dyadic(value as u64, -scale, fraction);
        high.error = 0;
        high.plus(&Self { error: 0, ..low })
    }

    /// A ball below `2^(64 fraction + bits)` units, half of them exact.
    fn random(random: &mut Random, bits: u32) -> Self {
        let mut limbs: Vec<u64> = (0..=FRACTION).map(|_| random.next()).collect();
        // A limb of zeros or ones, at times: carries that run far.
        limbs[random.below(FRACTION as u64) as usize] =
            [0, u64::MAX, random.next()][random.below(3) as usize];
        limbs[FRACTION] = if bits == 0 { 0 } else { random.next() >> (64 - bits) };
        let error = if random.below(2) == 0 { 0 } else { u128::from(random.next() >> random.below(64)) };
        Self { limbs, error }
    }

    /// Asserts that the ball holds the numbers `low / 2^scale` to `high / 2^scale`, and that its error is at most
    /// `error`.
    fn assert_holds(&self, [low, high]: [BigInt; 2], scale: usize, error: u128) {
        let [lo, hi] = self.bounds().map(|end| end << scale);
        assert!(lo <= low << (64 * (self.limbs.len() - 1)), "{self:?}");
        assert!(hi >= high << (64 * (self.limbs.len() - 1)), "{self:?}");
        assert!(self.error <= error, "{} > {error}", self.error);
    }
}

const UNIT: usize = 64 * FRACTION;

#[test]
fn sums_and_differences_are_exact() {
    let mut random = Random(2);
    for _ in 0..2000 {
        let (a, b) = (Ball::random(&mut random, 40), Ball::random(&mut random, 40));
        let ([a0, a1], [b0, b1]) = (a.bounds(), b.bounds());
        a.clone().plus(&b).assert_holds([&a0 + &b0, &a1 + &b1], UNIT, a.error + b.error);
        let (a, b, range) = if a.exact_order(&b) == Ordering::Less {
            (b, a, [b0 - a1, b1 - a0])
        } else {
            (a, b, [a0 - b1, a1 - b0])
        };
        a.clone().minus(&b).assert_holds(range, UNIT, a.error + b.error);
        // A difference that is not negative, but whose limbs are: 0, and the error says so.
        assert!(b.clone().minus(&a).limbs.iter().all(|&limb| limb == 0));
    }
}

#[test]
fn products_floor_and_count_it() {
    let mut random = Random(3);
    for _ in 0..2000 {
        let (a, b) = (Ball::random(&mut random, 20), Ball::random(&mut random, 30));
        let product = a.times(&b);
        let error = (a.integer_part() + 1) * b.error + (b.integer_part() + 1) * a.error + 2;
        let [low, high] = [0, 1].map(|end| &a.bounds()[end] * &b.bounds()[end]);
        product.assert_holds([low.max(BigInt::ZERO), high], 2 * UNIT, error);
        let (m, shift) = (random.next() >> random.below(64), 30 + random.below(160) as u32);
        let range = a.bounds().map(|end| end * m);
        let error = (a.error * u128::from(m)).checked_shr(shift).unwrap_or(0) + 2;
        a.scaled(m, -(shift as i32)).assert_holds(range, UNIT + shift as usize, error);
        let up = Ball { error: a.error >> 10, ..a.clone() };
        let range = up.bounds().map(|end| (end * (m >> 40)) << 7);
        up.scaled(m >> 40, 7).assert_holds(range, UNIT, ((up.error * u128::from(m >> 40)) << 7) + 1);
        let quotient = a.clone().over(m | 1);
        // Times the divisor, which avoids a division here.
        let [lo, hi] = quotient.bounds().map(|end| end * (m | 1));
        assert!(
            lo <= a.bounds()[0] && hi >= a.bounds()[1] && quotient.error <= a.error / u128::from(m | 1) + 2
        );
    }
}

#[test]
fn quotients_hold_the_exact_ones() {
    let mut random = Random(5);
    for _ in 0..200 {
        let mut divisor = Ball::random(&mut random, 0);
        divisor.limbs[FRACTION] = 1;
        let mut dividend = Ball::random(&mut random, 0);
        dividend.limbs[FRACTION] = random.below(2);
        let quotient = dividend.divided_by(&divisor);
        let ([a0, a1], [b0, b1], [lo, hi]) = (dividend.bounds(), divisor.bounds(), quotient.bounds());
        // quotient >= a1 / b0 and <= a0 / b1, without a division.
        assert!(hi * &b0 >= a1 << UNIT && (lo * &b1 <= a0.clone() << UNIT));
        assert!(quotient.error <= dividend.error + 2 * divisor.error + 2);
    }
}

/// What a series of 200 terms may lose, some units a term. A count that doubles with each term would be far beyond.
const SERIES: u128 = 4000;

/// `x` of the other oracle in units of `2^-UNIT`, rounded outwards.
fn range(x: &Oracle) -> [BigInt; 2] {
    let [lo, hi] = x.bounds();
    [lo >> (oracle::SCALE - UNIT), (hi >> (oracle::SCALE - UNIT)) + 1]
}

#[test]
fn logarithms_and_exponentials_hold_the_exact_ones() {
    let mut random = Random(7);
    for _ in 0..60 {
        // q from 2^-20 to 1/2, and 1 - q in 63 bits.
        let shift = 1 + random.below(20) as i32;
        let m = (random.next() >> shift) | 1;
        let q = Ball::dyadic(m, -64, FRACTION);
        let log = q.times(&q.log_series());
        let [lo, hi] = range(&Oracle::dyadic(m.wrapping_neg(), -64).minus_ln());
        assert!(log.bounds()[0] <= hi && log.bounds()[1] >= lo && log.error < SERIES, "{}", log.error);
        let exp = q.exp_neg();
        let [lo, hi] = range(&Oracle::dyadic(m, -64).exp_neg());
        assert!(exp.bounds()[0] <= hi && exp.bounds()[1] >= lo && exp.error < SERIES, "{}", exp.error);
    }
    let [lo, hi] = range(&Oracle::dyadic(1, -1).minus_ln());
    let ln2 = Ball::ln2(FRACTION);
    assert!(ln2.bounds()[0] <= hi && ln2.bounds()[1] >= lo && ln2.error < SERIES);
}

#[test]
fn an_order_is_told_only_where_balls_part() {
    let ball = |low: u64, error: u128| Ball { limbs: vec![low, 7, 3], error };
    assert_eq!(ball(100, 10).is_above(&ball(79, 10)), Some(true));
    assert_eq!(ball(79, 10).is_above(&ball(100, 10)), Some(false));
    assert_eq!(ball(100, 10).is_above(&ball(80, 10)), None, "they touch");
    assert_eq!(ball(100, 10).is_above(&ball(100, 0)), None);
    // The difference is in the second and the third limb.
    let high = |k: usize| Ball { limbs: (0..3).map(|j| u64::from(j == k)).collect(), error: 1 << 60 };
    assert_eq!(high(1).is_above(&ball(5, 0)), Some(false));
    assert_eq!(high(1).is_above(&high(0)), Some(true), "2^64 units are more than 2^61");
    assert_eq!(high(2).is_above(&high(1)), Some(true));
}
