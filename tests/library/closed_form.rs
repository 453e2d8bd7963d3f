//! The closed form of the limit: relations, special cases, and another way to compute it. The vectors hold it to the truth.

use super::common::power;
use approx::abs_diff_eq;
use core::f64::consts::{LN_2, PI};
use mean_information::Real;
use mean_information::cell::entropy;
use mean_information::elementary::{exp, ln, sqrt};
use mean_information::limit::{Weight, closed_form};
use mean_information::sensor::GaussianSensor;
use proptest::prelude::*;

const WEIGHTS: [Weight; 2] = [Weight::Radial, Weight::Area];

fn limit<T: Real>(range: T, sigma: T, weight: Weight) -> T {
    closed_form(&GaussianSensor::new(range, sigma).expect("positive and finite"), weight)
}

/// Where the limit of a weight is largest, and where smallest: chapter `limit`, "Not monotone".
fn extrema(weight: Weight) -> [f64; 2] {
    match weight {
        Weight::Radial => [0.457_663_790_838_69, 1.902_825_719_235_39],
        Weight::Area => [1.177_410_022_515_47, 2.549_942_984_682_18],
        other => panic!("{other:?}: not known"),
    }
}

/// The coefficients of `φ(s) = (1 - e^-s) / s` and of `u = e^-s - φ ln φ`.
fn coefficients<const N: usize>() -> [[f64; N]; 2] {
    let [mut phi, mut log, mut u] = [[0.0; N]; 3];
    let mut factorial = 1.0; // of k + 1, with its sign
    for k in 0..N {
        phi[k] = 1.0 / factorial;
        factorial *= -(k as f64 + 2.0);
        // φ (ln φ)' = φ'.
        if k > 0 {
            let known: f64 = (1..k).map(|j| j as f64 * log[j] * phi[k - j]).sum();
            log[k] = phi[k] - known / k as f64;
        }
        u[k] = (k as f64 + 1.0) * phi[k] - (0..=k).map(|j| phi[k - j] * log[j]).sum::<f64>();
    }
    [phi, u]
}

/// Both limits by the power series of the chapter, for `α <= 1`: `s <= 1/2`, 30 terms leave `2^-90`.
fn by_power_series(alpha: f64) -> [f64; 2] {
    let [phi, u] = coefficients::<30>();
    let (s, log_s) = (alpha * alpha / 2.0, ln(alpha * alpha / 2.0));
    let (mut a, mut c, mut power) = (0.0, 0.0, alpha * alpha * alpha / (2.0 * LN_2));
    for k in 0..30 {
        let (m, n) = (2.0 * k as f64 + 3.0, 2.0 * k as f64 + 4.0);
        let inner = u[k] + phi[k] * (2.0 / m - log_s);
        a += power * inner / m;
        c += power * (inner + 2.0 * phi[k] / n) / (m * n);
        power *= s;
    }
    let b = sqrt(2.0 * LN_2);
    let at_edge = 0.676_043_132_003_130_5;
    let moment = (PI * PI / 12.0 + LN_2 * LN_2 / 2.0) / LN_2 - 1.0;
    let width = alpha + b;
    [1.0 - (at_edge + a) / width, 1.0 - 2.0 * (alpha * at_edge + moment + alpha * c) / (width * width)]
}

/// `int weight(t) h(t) dt` between two numbers of at least 1 that are at most 1/16 apart, `h(t) = H(e^(-t^2/2))`, by Gauss's rule
/// with five nodes: off by less than `2^-19 length^11` times the tenth coefficient of Taylor's series, which Cauchy's estimate on
/// discs of radius 3/4, where `|h| < 20`, bounds by 356. That is below `10^-16`.
fn integral(from: f64, to: f64, weight: impl Fn(f64) -> f64) -> f64 {
    const RULE: [(f64, f64); 3] = [
        (0.0, 0.568_888_888_888_888_9),
        (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
        (0.906_179_845_938_664, 0.236_926_885_056_189_1),
    ];
    let (middle, half) = (from.midpoint(to), (to - from) / 2.0);
    let f = |x: f64| {
        let t = middle + half * x;
        weight(t) * entropy(exp(-t * t / 2.0))
    };
    let sum: f64 = RULE.iter().map(|&(x, w)| if x == 0.0 { w * f(0.0) } else { w * (f(x) + f(-x)) }).sum();
    half * sum
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn scaling_by_a_power_of_two_changes_no_bit(z in 0.01_f64..80.0, sigma in 0.001_f64..3.0, k in -900_i32..900) {
        for weight in WEIGHTS {
            prop_assert_eq!(limit(z * power(k), sigma * power(k), weight), limit(z, sigma, weight));
        }
    }

    /// One is within half an ulp of `f32` and `2^-65`, the other within `2^-53`.
    #[test]
    fn single_precision_is_double_precision_rounded(z in 0.01_f32..80.0, sigma in 0.001_f32..3.0) {
        for weight in WEIGHTS {
            let (narrow, wide) = (limit(z, sigma, weight), limit(z.widen(), sigma.widen(), weight));
            let half_ulp = power(narrow.parts().1 - 1);
            prop_assert!(abs_diff_eq!(narrow.widen(), wide, epsilon = half_ulp + power(-52)));
        }
    }

    #[test]
    fn it_is_between_the_least_and_1_for_any_bits(z in 1_u64..f64::INFINITY.to_bits(), sigma in 1_u64..f64::INFINITY.to_bits()) {
        let (z, sigma) = (f64::from_bits(z), f64::from_bits(sigma));
        prop_assert!((0.357_163_42..=1.0).contains(&limit(z, sigma, Weight::Radial)));
        prop_assert!((0.230_837_66..=1.0).contains(&limit(z, sigma, Weight::Area)));
    }

    /// Rising to the maximum, falling to the minimum, rising from there on. Steps of `2^-14` change the limit by more than its
    /// error: near an extremum, from which they stay `2^-8` away, and up to `2^30`, by more than `2^-50`.
    #[test]
    fn it_rises_falls_and_rises(sigma in 0.1_f64..3.0, e in -20.0_f64..30.0) {
        let factor = 1.0 + power(-14);
        let alpha = power(e as i32) * (1.0 + e.abs().fract());
        for weight in WEIGHTS {
            let [maximum, minimum] = extrema(weight);
            prop_assume!([maximum, minimum].iter().all(|at| (alpha / at - 1.0).abs() > power(-8)));
            let (before, after) = (limit(alpha * sigma, sigma, weight), limit(alpha * factor * sigma, sigma, weight));
            let falls = maximum < alpha && alpha < minimum;
            prop_assert_eq!(after < before, falls, "{} {}", before, after);
            prop_assert!(after != before);
        }
    }

    /// The function is right to half an ulp, the series to fewer than 1000 roundings of numbers below 2.
    #[test]
    fn it_is_the_power_series(sigma in 0.1_f64..3.0, e in -40.0_f64..0.0) {
        let z = sigma * power(e as i32 - 1) * (1.0 + e.abs().fract());
        let [radial, area] = by_power_series(z / sigma);
        prop_assert!(abs_diff_eq!(limit(z, sigma, Weight::Radial), radial, epsilon = 1000.0 * f64::EPSILON));
        prop_assert!(abs_diff_eq!(limit(z, sigma, Weight::Area), area, epsilon = 1000.0 * f64::EPSILON));
    }

    /// `(α + b) (1 - radial)` grows by the integral of `h`, and `(α + b)^2 (1 - area) / 2` by that of what the other was.
    #[test]
    fn it_grows_by_the_integral(alpha in 1.0_f64..12.0, step in 0.001_f64..0.0625, sigma in 0.1_f64..3.0) {
        let b = sqrt(2.0 * LN_2);
        // As the floats have it.
        let (lower, upper) = (alpha * sigma, (alpha + step) * sigma);
        let (from, to) = (lower / sigma, upper / sigma);
        let deficit = |z: f64, alpha: f64| {
            let k = (alpha + b) * (1.0 - limit(z, sigma, Weight::Radial));
            (k, (alpha + b) * (alpha + b) * (1.0 - limit(z, sigma, Weight::Area)) / 2.0)
        };
        let ((k_0, m_0), (k_1, m_1)) = (deficit(lower, from), deficit(upper, to));
        // Each is off by fewer than 8 roundings, that of alpha among them, of numbers below 16, and below 64 by area.
        prop_assert!(abs_diff_eq!(k_1 - k_0, integral(from, to, |_| 1.0), epsilon = 64.0 * f64::EPSILON));
        // C(to) - C(from) = (to - from) A(from) + int (to - t) h(t) dt, and A(b) belongs to both.
        let expected = (to - from) * k_0 + integral(from, to, |t| to - t);
        prop_assert!(abs_diff_eq!(m_1 - m_0, expected, epsilon = 512.0 * f64::EPSILON), "{:e}", m_1 - m_0 - expected);
    }
}

/// The ends of `α`, and the two quotients at which the way to compute it changes, from both sides.
#[test]
fn quotients_at_the_ends_and_at_the_turns() {
    let (smallest, largest) = (f64::from_bits(1), f64::MAX);
    assert_eq!(WEIGHTS.map(|weight| limit(largest, smallest, weight)), [1.0; 2]);
    let blind = [0.425_821_830_054_750_3, 0.230_837_669_620_311_71];
    assert_eq!(WEIGHTS.map(|weight| limit(smallest, largest, weight)), blind);
    for z in [power(-24), power(4)] {
        for weight in WEIGHTS {
            let [below, at, above] = [z.next_down(), z, z.next_up()].map(|z| limit(3.0 * z, 3.0, weight));
            // A neighbour of z moves the limit by less than 2^-53.
            assert!(
                abs_diff_eq!(below, at, epsilon = power(-53))
                    && abs_diff_eq!(above, at, epsilon = power(-53))
            );
        }
    }
}

/// The maximum by area is the radial limit of the blindest reading.
#[test]
fn the_largest_by_area_is_the_radial_limit_at_0() {
    let b = sqrt(2.0 * LN_2);
    assert_eq!(limit(b, 1.0, Weight::Area), limit(1e-300, 7.0, Weight::Radial));
}

/// 1 - κ / (α + b) rounds to 1 where κ / α is below a quarter of an ulp.
#[test]
fn it_is_1_where_the_format_ends() {
    assert_eq!(limit(4.3e16, 1.0, Weight::Radial), 1.0);
    assert!(limit(4.2e16, 1.0, Weight::Radial) < 1.0);
    assert_eq!(limit(8.5e16_f64, 1.0, Weight::Area), 1.0);
    assert!(limit(8.4e16_f64, 1.0, Weight::Area) < 1.0);
    assert_eq!(limit(8e7_f32, 1.0, Weight::Radial), 1.0);
    assert!(limit(7.8e7_f32, 1.0, Weight::Radial) < 1.0);
}
