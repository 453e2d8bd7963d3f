//! The tables against the equations that define the rules, in integers; what one application of a rule tells.

use super::compensated::Compensated;
use super::integration::compared;
use super::panel::Panel;
use super::rule::Rule;
use super::stretch::Stretch;
use super::weights::{BANDS, top_degrees};
use crate::real::Real;
use alloc::vec::Vec;
use approx::abs_diff_eq;
use num_bigint::BigInt;
use num_traits::{Signed, Zero};
use std::string::String;

/// The arrays of the generated source, as written: name and decimals.
fn arrays() -> Vec<(&'static str, Vec<&'static str>)> {
    let source = include_str!("tables.rs");
    let array = |text: &'static str| {
        let (name, rest) = text.split_once(": [f64; ")?;
        let (_, rest) = rest.split_once("= [\n")?;
        let (numbers, _) = rest.split_once("];")?;
        Some((name, numbers.lines().map(|line| line.trim().trim_end_matches(',')).collect()))
    };
    source.split("pub(super) const ").filter_map(array).collect()
}

/// Decimal places of the integers that stand for decimals.
const PLACES: u32 = 45;

/// A decimal below 1 as an integer in units of `10^-45`.
fn fixed(decimal: &str) -> BigInt {
    let digits = decimal.strip_prefix("0.").expect("a decimal below 1");
    let padding = PLACES as usize - digits.len();
    let text: String = digits.chars().chain(core::iter::repeat_n('0', padding)).collect();
    text.parse().expect("digits")
}

/// Nodes, Kronrod's weights and Gauss's of each rule, in units of `10^-45`.
fn tables() -> Vec<[Vec<BigInt>; 3]> {
    let numbers = |list: &[&str]| list.iter().map(|decimal| fixed(decimal)).collect();
    arrays().chunks(3).map(|arrays| [0, 1, 2].map(|k: usize| numbers(&arrays[k].1))).collect()
}

/// `|sum of w_i x_i^k - 2 / (k + 1)|` over both sides, in units of `10^-45`, for even `k`.
fn defect(nodes: &[BigInt], weights: &[BigInt], k: u32) -> BigInt {
    let one = BigInt::from(10).pow(PLACES);
    let mut sum: BigInt = nodes
        .iter()
        .zip(weights)
        .map(|(node, weight)| {
            let power = (0..k).fold(one.clone(), |power, _| power * node / &one);
            let sides = if node.is_zero() { 1 } else { 2 };
            power * weight / &one * sides
        })
        .sum();
    sum -= one * 2 / (k + 1);
    sum.abs()
}

/// Each decimal is off by at most `10^-36 / 2`: the powers `x^k`, whose weights make 2, by `k 10^-36` in all, the up
/// to 61 weights by `31 10^-36`. One more covers the divisions, of `10^-45` each.
fn slack(k: u32) -> BigInt {
    BigInt::from(k + 32) * BigInt::from(10).pow(PLACES - 36)
}

#[test]
fn the_rules_are_exact_to_their_degree_and_no_further() {
    let tables = tables();
    assert_eq!(tables.len(), Rule::ALL.len());
    for ([nodes, kronrod, gauss], &rule) in tables.iter().zip(Rule::ALL) {
        let n = nodes.len() as u32 - 1;
        assert_eq!(u64::from(2 * n + 1), rule.evaluations());
        let degree = rule.degree() as u32;
        for k in (0..=degree).step_by(2) {
            assert!(defect(nodes, kronrod, k) <= slack(k), "{rule:?}, x^{k}");
        }
        assert!(defect(nodes, kronrod, degree + 1) > slack(degree + 1) * 2, "{rule:?}");
        let of_gauss: Vec<BigInt> = nodes.iter().skip(1).step_by(2).cloned().collect();
        for k in (0..2 * n).step_by(2) {
            assert!(defect(&of_gauss, gauss, k) <= slack(k), "{rule:?}, x^{k} by Gauss");
        }
        assert!(defect(&of_gauss, gauss, 2 * n) > slack(2 * n) * 2, "{rule:?} by Gauss");
        assert!(nodes.windows(2).all(|pair| pair[0] > pair[1]) && nodes[n as usize].is_zero());
        assert!(kronrod.iter().chain(gauss).all(BigInt::is_positive));
    }
}

#[test]
fn no_constant_is_rounded_twice_to_another_float() {
    let mut count = 0;
    for (name, decimals) in arrays() {
        for decimal in decimals {
            let (single, double): (f32, f64) =
                (decimal.parse().expect("a decimal"), decimal.parse().expect("a decimal"));
            assert_eq!(f32::nearest(double), single, "{name}: {decimal}");
            count += 1;
        }
    }
    assert_eq!(count, 2 * (8 + 11 + 16 + 21 + 26 + 31) + (4 + 5 + 8 + 10 + 13 + 15));
}

/// The orthonormal Legendre polynomial of degree `k`.
fn legendre(k: u32, x: f64) -> f64 {
    let (mut previous, mut current) = (0.0, 1.0);
    for j in 0..k {
        let j = f64::from(j);
        (previous, current) = (current, ((2.0 * j + 1.0) * x * current - j * previous) / (j + 1.0));
    }
    f64::from(2 * k + 1).sqrt() * current
}

const STRETCH: Stretch<f64> = Stretch { lower: -3.0, upper: 3.0 };

/// A polynomial of either band has the coefficient 1 there: over a stretch of length 6 it differs by 6 times the
/// ratio of the bands, 1 if it is in the upper, 0 if it is in the lower or below both.
#[test]
fn the_bands_are_coefficients_of_the_legendre_series() {
    // Some 3 k roundings in the recurrence, of numbers up to sqrt(2k + 1), weigh sqrt(2k + 1) and length 6 in up to
    // eight terms.
    let rounding = |k: u32| 6.0 * 8.0 * f64::from(3 * k * (2 * k + 1)) * f64::EPSILON;
    for &rule in Rule::ALL {
        let n = (rule.evaluations() as u32 - 1) / 2;
        let high = (3 * n).div_ceil(2);
        for k in 1..=high {
            let reading = rule.apply(&mut |x| legendre(k, x / 3.0), STRETCH);
            let rounding = rounding(k);
            assert!(reading.value.abs() <= rounding, "{rule:?}, degree {k}: {reading:?}");
            if k + 3 >= high {
                assert!(
                    abs_diff_eq!(reading.difference, 6.0, epsilon = rounding),
                    "{rule:?}, degree {k}: {reading:?}"
                );
                assert_eq!(reading.decay, 1.0);
            } else {
                assert!(reading.difference <= rounding, "{rule:?}, degree {k}: {reading:?}");
            }
        }
        // Both bands at once: the ratio of the coefficients, 8 in the lower band from its first degree to its last.
        for (k, decay) in [(n - 4, 1.0), (n - 3, 0.25), (n - 1, 0.25), (n, 0.25)] {
            let both = |x: f64| 8.0 * legendre(k, x / 3.0) + 2.0 * legendre(high - 2, x / 3.0);
            let reading = rule.apply(&mut { both }, STRETCH);
            assert!(abs_diff_eq!(reading.decay, decay, epsilon = rounding(high)), "{rule:?}, degree {k}");
            assert!(
                abs_diff_eq!(reading.difference, 6.0 * 2.0 * decay, epsilon = 8.0 * rounding(high)),
                "{rule:?}, degree {k}"
            );
        }
    }
}

/// The top band is orthonormal under Kronrod's sum, and orthogonal to all lower degrees: that determines it.
#[test]
fn the_top_band_is_of_the_highest_degrees() {
    for (rule, arrays) in Rule::ALL.iter().copied().zip(arrays().chunks(3)) {
        let floats = |k: usize| -> Vec<f64> {
            arrays[k].1.iter().map(|decimal| decimal.parse().expect("a decimal")).collect()
        };
        let (half, weights) = (floats(0), floats(1));
        let n = half.len() - 1;
        let top = top_degrees(n);
        let table = rule.bands();
        let mut rows: Vec<Vec<f64>> =
            (0..top).map(|k| (0..=n).map(|i| table[i][BANDS + k]).collect()).collect();
        let highest = rows.len();
        rows.extend((0..=2 * n - top).map(|k| half.iter().map(|&x| legendre(k as u32, x)).collect()));
        let parity = |row: usize| if row < highest { row % 2 } else { (row - highest) % 2 };
        for (j, row) in rows[..highest].iter().enumerate() {
            for (k, other) in rows.iter().enumerate() {
                // Both sides, halved; the middle node counts once, and products of unlike parity add to 0.
                let product: f64 =
                    (0..=n).map(|i| weights[i] * row[i] * other[i] * if i == n { 0.5 } else { 1.0 }).sum();
                let product = if parity(j) == parity(k) { product } else { 0.0 };
                let exact = f64::from(u8::from(j == k));
                let rounding = 8.0 * f64::from(61 * 61_u16) * f64::EPSILON;
                assert!(abs_diff_eq!(product, exact, epsilon = rounding), "{rule:?}, {j}, {k}: {product}");
            }
        }
    }
}

/// A kink, a jump or a cusp between two nodes, the outermost ones apart: the error beside what the values suggest. Measured; a
/// square root, by `K15`, is the only one above it.
#[test]
fn what_lies_between_nodes_is_seen() {
    type Shape = (fn(f64, f64) -> f64, fn(f64) -> f64, f64);
    // Value and integral over [-1, 1], and the most that the error may be.
    let shapes: [Shape; 4] = [
        (|x, c| (x - c).max(0.0), |c| (1.0 - c) * (1.0 - c) / 2.0, 0.7),
        (|x, c| f64::from(u8::from(x > c)), |c| 1.0 - c, 0.5),
        (|x, c| (x - c).max(0.0).sqrt(), |c| (1.0 - c) * (1.0 - c).sqrt() / 1.5, 1.25),
        (|x, c| (x - c).max(0.0) * (x - c), |c| (1.0 - c) * (1.0 - c) * (1.0 - c) / 3.0, 0.7),
    ];
    let unit = Stretch { lower: -1.0, upper: 1.0 };
    for &rule in Rule::ALL {
        let [_, outermost] = unit.pair(rule.nodes()[1]);
        for (shape, integral, most) in shapes {
            for k in -200..=200 {
                let place = outermost * f64::from(k) / 200.0;
                let reading = rule.apply(&mut |x| shape(x, place), unit);
                let error = (reading.value - integral(place)).abs();
                assert!(
                    error <= most * reading.difference + reading.noise,
                    "{rule:?}, {place}: {error}, {reading:?}"
                );
            }
        }
    }
}

/// A polynomial that all values determine is carried on to both ends: orthonormal ones are `±√(2k + 1)` there.
#[test]
fn the_polynomial_goes_on_to_the_ends() {
    for &rule in Rule::ALL {
        for k in 0..rule.evaluations() as u32 {
            let reading = rule.apply(&mut |x| legendre(k, x / 3.0), STRETCH);
            let end = f64::from(2 * k + 1).sqrt();
            let lower = if k % 2 == 0 { end } else { -end };
            // Roundings of values up to √(2k + 1), by weights whose magnitudes add to less than 16.
            let rounding = 16.0 * f64::from(3 * k * (2 * k + 1) + 8) * f64::EPSILON;
            for (found, exact) in reading.ends.into_iter().zip([lower, end]) {
                assert!(
                    abs_diff_eq!(found, exact, epsilon = rounding),
                    "{rule:?}, degree {k}: {found} for {exact}"
                );
            }
        }
    }
}

/// The rules of Gauss and Kronrod disagree on `P_{2n}`, and the top band sees it, too.
#[test]
fn the_difference_of_the_two_rules_counts() {
    for &rule in Rule::ALL {
        let n = (rule.evaluations() as u32 - 1) / 2;
        let reading = rule.apply(&mut |x| legendre(2 * n, x / 3.0), STRETCH);
        assert!(reading.difference > 1.0, "{rule:?}: {reading:?}");
    }
}

/// A constant is a sum of `2n + 1` products that lose the sign of nothing: within the noise.
#[test]
fn the_noise_covers_rounding_and_vanishes_with_the_integrand() {
    for &rule in Rule::ALL {
        let reading = rule.apply(&mut |_| 0.1_f64, Stretch { lower: 1e5, upper: 1e5 + 0.7 });
        let width = (1e5 + 0.7) - 1e5;
        assert!((reading.value - 0.1 * width).abs() <= reading.noise);
        assert!(reading.noise <= 6.0 * f64::EPSILON * 0.1 * width);
        let nothing = rule.apply(&mut |_| 0.0_f64, STRETCH);
        assert_eq!([nothing.value, nothing.difference, nothing.noise, nothing.decay], [0.0; 4]);
        // Where every product is rounded to a multiple of the smallest float: four for each of up to 61 nodes.
        let smallest = f64::from_bits(1);
        let least = rule.apply(&mut |_| smallest, Stretch { lower: 3.0, upper: 3.125 });
        assert!(least.noise >= 4.0 * 61.0 * smallest && least.noise <= 300.0 * smallest);
        // 8 per step of the argument: the last digit of an argument near 1e5 is worth `8 * 2^-36`.
        let slope = rule.apply(&mut |x: f64| 8.0 * (x - 1e5), Stretch { lower: 1e5, upper: 1e5 + 1.0 });
        assert!((slope.value - 4.0).abs() <= slope.noise && slope.noise >= 8.0 * 1e5 * f64::EPSILON);
    }
}

/// No node leaves its stretch, whatever the stretch.
#[test]
fn nodes_stay_within_their_stretch() {
    let next = |x: f64| f64::from_bits(x.to_bits() + 1);
    let stretches = [
        (0.0, f64::from_bits(1)),
        (f64::from_bits(3), f64::from_bits(4)),
        (1.0, next(1.0)),
        (-next(2.0), -2.0),
        (-f64::MAX, f64::MAX),
        (0.3, 0.3 + 1e-14),
        (-1e-320, 1e300),
    ];
    for (lower, upper) in stretches {
        for &rule in Rule::ALL {
            let (mut seen, mut last) = (0, lower);
            let mut f = |x: f64| {
                assert!(lower <= x && x <= upper && last <= x, "{x} in {lower} to {upper}");
                (seen, last) = (seen + 1, x);
                2.0
            };
            let reading = rule.apply(&mut f, Stretch { lower, upper });
            assert_eq!(seen, rule.evaluations());
            let truth = 2.0 * (upper - lower);
            assert!(truth.is_infinite() || (reading.value - truth).abs() <= reading.noise);
        }
    }
}

/// What each addition loses is kept, in a sum and where two sums meet.
#[test]
fn sums_keep_what_they_lose() {
    let sum = |terms: &[f64]| terms.iter().fold(Compensated::default(), |sum, &x| sum.plus(x));
    let (large, small) = (9007199254740992.0, 0.75);
    assert_eq!(sum(&[large, small, small, -large]).value(), 1.5);
    let (left, right) = (sum(&[large, small]), sum(&[small, -large, small]));
    assert_eq!(left.merged(right).value(), 2.25);
    assert_eq!(right.merged(Compensated::new(large)).value(), 1.5);
}

/// Halves that err as much as the whole, twice in a row, and by less than `2^26` times the noise: nothing is to be
/// gained.
#[test]
fn what_no_halving_reduces_is_noise() {
    let panel = |difference: f64, alike| Panel {
        stretch: STRETCH,
        value: 2.0,
        difference,
        ratio: 0.5,
        alike,
        decay: 0.25,
        noise: 0.125,
        spread: 1.5,
        reducible: 3.0,
        fixed: 0.125,
        is_settled: false,
        ends: [0.5, 2.5],
        witnesses: [None; 2],
        doubts: [0.0; 2],
        beside: [None; 2],
    };
    let noise = 1.0 / f64::from(1 << 20);
    // The difference of the halves, that of the whole being 1; was it alike; the noise; alike now, and settled.
    for (halves, before, noise, alike, settled) in [
        ([0.5, 0.25], true, noise, true, true),
        ([0.5, 0.25], false, noise, true, false),
        ([0.5, 0.25], true, noise / 128.0, true, false),
        ([0.5, 0.1], true, noise, false, false),
        ([0.1, 0.5], true, noise, false, false),
    ] {
        let found = compared(&panel(1.0, before), halves.map(|d| panel(d, false)), noise);
        for (half, difference) in found.iter().zip(halves) {
            if settled {
                assert_eq!([half.reducible, half.fixed], [0.0, 0.125 + 8.0 * difference]);
            } else {
                assert_eq!((half.alike, half.reducible, half.fixed), (alike, 3.0, 0.125));
            }
        }
    }
}
