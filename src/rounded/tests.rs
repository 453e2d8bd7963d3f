//! The two steps of Ziv's strategy: the enclosures hold the values, the comparison gives the same floats, and the
//! second step is as rare as stated.

mod single_precision;

use super::fixed::floor_117;
use super::oracle::{Oracle, SCALE};
use super::round::{Midpoint, Rounded};
use super::*;
use crate::real::Real;
use core::cell::Cell;
use num_bigint::BigInt;
use std::vec::Vec;

/// SplitMix64 (Steele, Lea, Flood 2014).
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(super) fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }

    /// In `(0, 1)`.
    fn unit(&mut self) -> f64 {
        (self.next() >> 11 | 1) as f64 / (1_u64 << 53) as f64
    }

    /// In `(0, 2^-k)`, `0 <= k < depth`.
    fn shallow(&mut self, depth: u64) -> f64 {
        self.unit() * f64::from_parts(1, -(self.below(depth) as i32))
    }
}

/// One kind of argument, by name.
type Kind = (&'static str, fn(&mut Random) -> f64);

const OCCUPANCIES: [Kind; 5] = [
    ("uniform", Random::unit),
    ("near 1/2", |random| 0.5 + random.shallow(50) / 4.0),
    ("below 1/2", |random| 0.5 - random.shallow(50) / 4.0),
    ("near 0", |random| random.shallow(400)),
    ("near 1", |random| 1.0 - random.shallow(45) / 2.0),
];

const LOG_ODDS: [Kind; 5] = [
    ("up to 4", |random| 4.0 * random.unit()),
    ("about 8 ln 2", |random| 5.5 + random.unit() / 4.0),
    ("up to 40", |random| 40.0 * random.unit()),
    ("near 0", |random| random.shallow(200)),
    ("up to 300", |random| 300.0 * random.unit()),
];

/// `count` arguments of each kind, not special: the argument, its significand and its exponent.
fn each(kinds: &[Kind], seed: u64, count: usize) -> impl Iterator<Item = (f64, u64, i32)> {
    let mut random = Random(seed);
    let drawn =
        kinds.iter().flat_map(move |&(_, draw)| (0..count).map(|_| draw(&mut random)).collect::<Vec<_>>());
    drawn.filter(|&x| x != 0.5 && x != 1.0).map(|x| {
        let (m, e) = normalised(x);
        (x, m, e)
    })
}

/// A number in `(1, 2]` for one in `(0, 1)`.
fn above_one(x: f64) -> f64 {
    1.0 + x.max(f64::EPSILON)
}

fn assert_holds(enclosure: FixedEnclosure, exact: &Oracle, what: f64) {
    let FixedEnclosure { lo, width, exponent } = enclosure;
    let [low, high] = [lo, lo + width].map(|end| BigInt::from(end) << (SCALE as i32 + exponent));
    assert!(&low <= exact.bounds()[0] && exact.bounds()[1] <= &high, "{enclosure:?} at {what:e}");
    // docs/rounding.md: the width is below 2^-13 of the spacing of `f64`.
    assert!(width < 1 << (62 - lo.leading_zeros()), "{enclosure:?} at {what:e}");
}

/// `(x - z)^2 / (2 s^2)`, for signs that agree and that differ and for any gap between `x` and `z`.
#[test]
fn the_square_is_within_its_error() {
    let mut random = Random(53);
    let mut significand = || 1 << 52 | random.next() >> 12;
    for j in 0..400 {
        let (large, small, m) = ((significand(), -52), (significand() >> 1, -52 - j % 110), significand());
        let distance = gaussian::Distance { large, small, same_sign: j % 2 == 0 };
        let (d, e) = distance.cut();
        let r = gaussian::half_square(d, e, m).expect("below 2^10");
        let [large, small] = [large, small].map(|(m, e)| Oracle::dyadic(m, e));
        let exact = if j % 2 == 0 { large.minus(&small) } else { large.plus(&small) };
        let ratio = exact.over(&Oracle::dyadic(m, -52));
        let square = ratio.times(&ratio).over(&Oracle::dyadic(2, 0));
        let [lo, hi] = square.bounds().map(|end| end >> (SCALE - 117));
        let (r, error) = (BigInt::from(r), BigInt::from(1 << 9));
        assert!(&r - lo < error && hi - &r < error, "{j}");
    }
}

#[test]
fn the_enclosures_hold_the_values() {
    for (x, m, e) in each(&LOG_ODDS, 29, 50) {
        let power = Oracle::dyadic(m, e).exp_neg();
        assert_holds(approximate::exp(m, e, true), &power, x);
        assert_holds(approximate::exp(m, e, false), &Oracle::dyadic(1, 0).over(&power), x);
    }
    for (x, m, e) in each(&OCCUPANCIES, 30, 50) {
        assert_holds(approximate::ln(m, e), &Oracle::dyadic(m, e).minus_ln(), x);
        // Above 1: ln x = -ln (1/x).
        let (m, e) = normalised(above_one(x));
        let inverse = Oracle::dyadic(1, 0).over(&Oracle::dyadic(m, e));
        assert_holds(approximate::ln(m, e), &inverse.minus_ln(), above_one(x));
    }
    for (p, m, e) in each(&OCCUPANCIES, 31, 50) {
        let (entropy, information) = approximate::from_occupancy(m, e);
        let exact = oracle::from_occupancy(&Oracle::dyadic(m, e));
        assert_holds(entropy, &exact[0], p);
        assert_holds(information, &exact[1], p);
    }
    for (l, m, e) in each(&LOG_ODDS, 37, 50) {
        let (entropy, information) = approximate::from_log_odds(m, e);
        let exact = oracle::from_log_odds(&Oracle::dyadic(m, e));
        assert_holds(entropy, &exact[0], l);
        assert_holds(information, &exact[1], l);
        assert_holds(approximate::occupancy(floor_117(m, e), false), &exact[2], l);
        assert_holds(approximate::occupancy(floor_117(m, e), true), &exact[3], l);
    }
}

/// The comparison alone: the value is above the midpoint below `result`, and not above the midpoint above it.
fn assert_parted<T: Real>(result: T, x: f64, is_above: impl Fn(Midpoint) -> bool) {
    let (m, e) = result.parts();
    if result < T::one() {
        assert!(!is_above(Midpoint { m: 2 * m + 1, exponent: e - 1 }), "{result:e} at {x:e}");
    }
    if m > 0 {
        // The spacing below a power of two is half the spacing above, down to the smallest normal number.
        let narrow = m == 1 << (T::PRECISION - 1) && e > T::MIN_EXPONENT;
        let (m, exponent) = if narrow { (4 * m - 1, e - 2) } else { (2 * m - 1, e - 1) };
        assert!(is_above(Midpoint { m, exponent }), "{result:e} at {x:e}");
    }
}

fn comparison_agrees<T: Real>(count: usize) {
    for (p, ..) in each(&OCCUPANCIES, 41, count) {
        let p = T::nearest(p);
        if p == T::HALF || p == T::one() || p.is_zero() {
            continue;
        }
        let (m, e) = normalised(p);
        let enclosures = CellEnclosures::at_occupancy(p);
        assert_parted(enclosures.entropy::<T>(), p.widen(), |midpoint| compare::entropy(m, e, midpoint));
        assert_parted(enclosures.information::<T>(), p.widen(), |midpoint| {
            compare::information(m, e, midpoint)
        });
    }
    for (l, ..) in each(&LOG_ODDS, 43, count) {
        let l = T::nearest(l);
        if T::PRECISION == 24 && l.widen() > 100.0 {
            // Results are 0 with no midpoint near; relative to them, a ball could not hold the first one.
            continue;
        }
        let (m, e) = normalised(l);
        let enclosures = CellEnclosures::at_log_odds(l);
        assert_parted(enclosures.entropy::<T>(), l.widen(), |midpoint| {
            compare::entropy_from_log_odds(m, e, midpoint)
        });
        assert_parted(enclosures.information::<T>(), l.widen(), |midpoint| {
            compare::information_from_log_odds(m, e, midpoint)
        });
        for (l, negative) in [(l, false), (-l, true)] {
            let is_above = |midpoint| compare::occupancy(m, e, negative, midpoint);
            assert_parted(occupancy_from_log_odds(l), l.widen(), is_above);
        }
    }
}

#[test]
fn the_comparison_alone_agrees_with_both_steps() {
    comparison_agrees::<f64>(100);
    comparison_agrees::<f32>(50);
}

#[test]
fn the_comparison_of_exponential_and_logarithm_agrees_with_both_steps() {
    for (x, m, e) in each(&LOG_ODDS, 59, 100) {
        assert_parted(exp(-x), -x, |midpoint| compare::exp(m, e, true, midpoint));
        assert_parted(exp(x), x, |midpoint| compare::exp(m, e, false, midpoint));
    }
    for (x, m, e) in each(&OCCUPANCIES, 61, 100) {
        assert_parted(-ln(x), x, |midpoint| compare::ln(m, e, true, midpoint));
        let (m, e) = normalised(above_one(x));
        assert_parted(ln(above_one(x)), above_one(x), |midpoint| compare::ln(m, e, false, midpoint));
        // Up to 2^400.
        let (m, e) = normalised(1.0 / x);
        assert_parted(ln(1.0 / x), 1.0 / x, |midpoint| compare::ln(m, e, false, midpoint));
    }
}

/// No argument is known that takes more than 256 bits of fraction: there may be one.
#[test]
fn a_comparison_takes_as_many_bits_as_it_needs() {
    let last = Cell::new(0);
    let above = compare::decide(|fraction| {
        assert!(fraction > last.replace(fraction), "no more bits than before");
        (fraction > 100).then_some(true)
    });
    assert!(above);
}

/// Distances of either sign, of numbers a few and of many bits apart, from 1/64 to 35 standard deviations.
#[test]
fn the_comparison_of_the_gaussian_agrees_with_both_steps() {
    let mut random = Random(67);
    let mut uniform = || (random.next() >> 11) as f64 / (1_u64 << 53) as f64;
    for j in 0..160 {
        let s = 0.37 + uniform();
        let t = f64::from(1 + j % 35) - uniform() + 1.0 / 64.0;
        // z beside the distance: comparable, huge, small, tiny, or 0.
        let z = [1.0 + uniform(), 2e9 * uniform(), 1e-8 * uniform(), 1e-25 * uniform(), 0.0][j as usize % 5];
        let x = if j % 2 == 0 { z + s * t } else { z - s * t };
        let (m, e) = normalised(s);
        let distance = gaussian::Distance::new(x, z, -52 - e);
        let (d, exponent) = distance.cut();
        let r = gaussian::half_square(d, exponent, m).expect("below 2^10");
        let (_, _, t) = fixed::exp_neg(r);
        assert_parted(gaussian(x, z, s), x, |midpoint| {
            compare::gaussian(|fraction| distance.ball(fraction), m, t, midpoint)
        });
    }
}

/// The ball of a distance against integers: whatever the gap, and where both numbers are huge beside their distance.
#[test]
fn the_ball_of_a_distance_holds_it() {
    const FRACTION: usize = 4;
    const UNIT: i32 = -64 * FRACTION as i32;
    let mut random = Random(71);
    let mut significand = || 1 << 52 | random.next() >> 12;
    for j in 0..600 {
        let (gap, same_sign) = (j % 200, j % 3 > 0);
        // Next to one another at 2^90, where the distance is below 2^40.
        let near = j % 5 == 0 && same_sign;
        let exponent = if near { 38 } else { -49 };
        let large = (significand(), exponent);
        let small = if near {
            (large.0 - 1 - u64::from(j as u32), exponent)
        } else {
            (significand(), exponent - gap - 1)
        };
        let ball = gaussian::Distance { large, small, same_sign }.ball(FRACTION);
        // In units of 2^UNIT / 2^64, so that nothing is cut.
        let integer = |(m, e): (u64, i32)| BigInt::from(m) << (e - 6 - UNIT + 64);
        let (large, small) = (integer(large), integer(small));
        let exact = if same_sign { large - small } else { large + small };
        let [lo, hi] = ball.bounds().map(|end| end << 64);
        assert!(lo <= exact && exact <= hi, "{j}: {exact} is not in [{lo}, {hi}]");
        assert!(hi - lo <= BigInt::from(8) << 64, "{j}: too wide");
    }
}

#[test]
fn the_square_is_refused_from_1024_on() {
    // t^2 / 2 in units of s = 2^-52 2^52: d = t 2^122, exponent -122.
    for (t, below) in [(45_u128, true), (46, false), (64, false), (1 << 20, false), (1, true)] {
        let shift = t.leading_zeros() as i32;
        let square = gaussian::half_square(t << shift, -shift, 1 << 52);
        assert_eq!(square.is_some(), below, "{t}");
        if let Some(square) = square {
            let exact = (t * t) << 116;
            assert!(square <= exact && exact - square < 1 << 9, "{t}: {square}");
        }
    }
}

/// Subnormal results: the midpoints are few and the comparison sees them at other scales.
#[test]
fn the_comparison_agrees_on_subnormal_results() {
    for l in [709.0, 735.5, 744.4, 745.1, 745.2, 751.9, 752.2] {
        let (m, e) = normalised(l);
        let entropy: f64 = CellEnclosures::at_log_odds(l).entropy();
        assert_parted(entropy, l, |midpoint| compare::entropy_from_log_odds(m, e, midpoint));
        assert_parted(occupancy_from_log_odds(-l), l, |midpoint| compare::occupancy(m, e, true, midpoint));
    }
    for p in [1, 3, 1000, 1 << 40].map(f64::from_bits) {
        let (m, e) = normalised(p);
        let entropy: f64 = CellEnclosures::at_occupancy(p).entropy();
        assert_parted(entropy, p, |midpoint| compare::entropy(m, e, midpoint));
    }
}

/// docs/rounding.md: fewer than one `f64` in `2^12` meets a midpoint, and one `f32` in `2^41`.
#[test]
fn the_comparison_is_rarely_needed() {
    fn check(kind: &Kind, enclose: fn(u64, i32) -> (FixedEnclosure, FixedEnclosure)) {
        const COUNT: usize = 1 << 17;
        let values = each(std::slice::from_ref(kind), 47, COUNT)
            .flat_map(|(_, m, e)| <[FixedEnclosure; 2]>::from(enclose(m, e)));
        let (mut double, mut single) = (0, 0);
        for value in values {
            double += u32::from(matches!(value.round::<f64>(), Rounded::Between { .. }));
            single += u32::from(matches!(value.round::<f32>(), Rounded::Between { .. }));
        }
        std::println!("{}: {double} of {} undecided in f64", kind.0, 2 * COUNT);
        assert!(double << 12 < 2 * COUNT as u32 && single == 0, "{}: {double}, {single}", kind.0);
    }
    for kind in &OCCUPANCIES {
        check(kind, approximate::from_occupancy);
    }
    for kind in &LOG_ODDS {
        check(kind, approximate::from_log_odds);
    }
}
