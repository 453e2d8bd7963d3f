//! Adaptive quadrature: its claims on the battery, a second opinion, relations, and the edges of the formats.

use super::battery::{Case, cases};
use super::common::power;
use mean_information::cell::entropy;
use mean_information::elementary::exp;
use mean_information::estimate::{Estimate, Status};
use mean_information::quadrature::adaptive::{GaussKronrod, Rule, graded};
use mean_information::{Error, Real};
use proptest::prelude::*;

/// The errors claimed on the battery, by every rule at several tolerances, are all above the true ones.
fn no_claim_is_below_the_truth<T: Real + num_traits::Float>(tolerances: &[f64], overflowing: usize) {
    let limit = 200_000;
    for rule in Rule::ALL {
        for &tolerance in tolerances {
            let settings = GaussKronrod::new().rule(rule).relative(T::nearest(tolerance)).limit(limit);
            let integrate = |case: &Case| {
                let points: Vec<T> = case.points.iter().map(|&x| T::nearest(x)).collect();
                settings.integrate_between(case.integrand::<T>(), &points).expect("good settings")
            };
            let mut not_finite = 0;
            for case in cases() {
                let estimate = integrate(&case);
                let Estimate { value, error, status, evaluations } = estimate;
                let context = format!("{rule:?}, {tolerance:e}, {case:?}, {estimate:?}");
                assert!(evaluations <= limit, "{context}");
                if let Status::NotFinite { lower, upper } = status {
                    assert!(lower < upper, "{context}");
                    assert!(value.widen().is_nan() && error.widen().is_infinite(), "{context}");
                    not_finite += 1;
                    continue;
                }
                assert!(case.error(value.widen()) <= error.widen(), "{context}");
                let infinite = error.widen().is_infinite();
                assert!(!infinite || matches!(status, Status::Unresolved { .. }), "{context}");
                assert!(!infinite || T::FORMAT == "f32", "{context}");
                if status == Status::Converged {
                    assert!(error <= T::nearest(tolerance) * T::nearest(value.widen().abs()), "{context}");
                }
            }
            assert_eq!(not_finite, overflowing, "{rule:?}, {tolerance:e}");
        }
    }
}

#[test]
fn no_claim_is_below_the_truth_f64() {
    no_claim_is_below_the_truth::<f64>(&[1e-3, 1e-6, 1e-10, 1e-13], 0);
}

/// One integrand overflows: `x^-0.9 ln(1/x)`, at subnormal arguments.
#[test]
fn no_claim_is_below_the_truth_f32() {
    no_claim_is_below_the_truth::<f32>(&[1e-2, 1e-4, 1e-6], 1);
}

/// `√(ln 4)`.
const EDGE: f64 = 1.1774100225154747;

/// Information that one reading lacks, in bits, at `t` standard deviations from it.
fn deficit<T: Real>(t: T) -> T {
    entropy(exp(-T::HALF * t * t))
}

/// Break points of the deficit over `[-alpha, √(ln 4)]`, graded towards its singularity `t^2 ln |t|` at 0.
fn room(alpha: f64) -> Vec<f64> {
    [graded(-alpha, 0.0, 0.125, 4), graded(EDGE, 0.0, 0.125, 3)].map(Result::unwrap).concat()
}

/// `K(10)` of docs/limit.md; the goal is GSL qagp's count.
#[test]
fn the_room_to_twelve_digits_in_fewer_evaluations_than_qagp() {
    let settings = GaussKronrod::new().relative(1e-12).rule(Rule::K31);
    let estimate = settings.integrate_between(deficit, &room(10.0)).unwrap();
    assert_eq!(estimate.status, Status::Converged);
    assert!((estimate.value - 2.354667979156384).abs() <= estimate.error);
    assert!(estimate.evaluations <= 550, "{estimate:?}");
}

proptest! {
    /// Double exponential quadrature by another hand, to the absolute error that it was asked for, piece by piece.
    #[test]
    fn a_second_opinion_on_the_room(alpha in 0.01_f64..12.0) {
        let estimate = GaussKronrod::new().relative(1e-12).integrate_between(deficit, &room(alpha))?;
        let target = 1e-11;
        let piece = |from, to| quadrature::integrate(deficit, from, to, target / 2.0).integral;
        let other = piece(-alpha, 0.0) + piece(0.0, EDGE);
        prop_assert_eq!(estimate.status, Status::Converged);
        prop_assert!((estimate.value - other).abs() <= estimate.error + target);
    }

    /// Scaling the argument or the value by a power of two changes no digit.
    #[test]
    fn scaling_by_a_power_of_two_scales(
        a in -3.0_f64..0.3, b in 0.6_f64..4.0, s in -300_i32..300, v in -300_i32..300, rule in any_rule(),
    ) {
        let settings = GaussKronrod::new().rule(rule).relative(1e-9);
        let plain = settings.integrate_between(peak, &[a, 0.3, b])?;
        let [x, y] = [power(s), power(v)];
        let scaled = settings.integrate_between(|t| y * peak(t / x), &[a * x, 0.3 * x, b * x])?;
        prop_assert_eq!(scaled.value, plain.value * x * y);
        // But for the spacing of subnormal numbers that every claim covers.
        prop_assert!((scaled.error - plain.error * x * y).abs() <= 1e-9 * scaled.error);
        prop_assert_eq!(scaled.evaluations, plain.evaluations);
    }

    #[test]
    fn reversed_ends_reverse_the_sign_and_mirrored_ones_nothing(
        a in -3.0_f64..4.0, b in -3.0_f64..4.0, rule in any_rule(),
    ) {
        let settings = GaussKronrod::new().rule(rule).relative(1e-9);
        let forth = settings.integrate(peak, a, b)?;
        let back = settings.integrate(peak, b, a)?;
        prop_assert_eq!((back.value, back.error, back.evaluations), (-forth.value, forth.error, forth.evaluations));
        let mirrored = settings.integrate(|x| peak(-x), -b, -a)?;
        prop_assert!((mirrored.value - forth.value).abs() <= mirrored.error + forth.error);
    }

    /// The parts make the whole, within the claims.
    #[test]
    fn the_integral_is_additive(a in -3.0_f64..0.0, share in 0.0_f64..=1.0, b in 1.0_f64..4.0, rule in any_rule()) {
        let settings = GaussKronrod::new().rule(rule).relative(1e-9);
        let middle = a + share * (b - a);
        let whole = settings.integrate(peak, a, b)?;
        let cut = settings.integrate_between(peak, &[a, middle, middle, b])?;
        let parts = [settings.integrate(peak, a, middle)?, settings.integrate(peak, middle, b)?];
        let sum = parts[0].value + parts[1].value;
        let slack = parts[0].error + parts[1].error + f64::EPSILON * sum;
        prop_assert!((whole.value - sum).abs() <= whole.error + slack);
        prop_assert!((cut.value - sum).abs() <= cut.error + slack);
    }

    /// A polynomial that the rule integrates exactly, about a centre so that Horner's scheme is stable.
    #[test]
    fn polynomials_within_their_claims(
        coefficients in prop::collection::vec(-8_i32..8, 1..12),
        centre in -20_i32..20,
        half in 1_u32..40,
        rule in any_rule(),
    ) {
        let (centre, half) = (f64::from(centre) / 4.0, f64::from(half) / 16.0);
        let horner = |x: f64| {
            let u = (x - centre) / half;
            coefficients.iter().rev().fold(0.0, |sum, &c| sum * u + f64::from(c))
        };
        let settings = GaussKronrod::new().absolute(1e-9).rule(rule);
        let estimate = settings.integrate(horner, centre - half, centre + half)?;
        let even = coefficients.iter().step_by(2).zip(0_u32..);
        let exact: f64 = even.map(|(&c, k)| 2.0 * half * f64::from(c) / f64::from(2 * k + 1)).sum();
        // Each of up to six terms is rounded twice, and so is its sum.
        let size: f64 = coefficients.iter().map(|&c| 2.0 * half * f64::from(c).abs()).sum();
        let slack = 8.0 * f64::EPSILON * size;
        prop_assert!((estimate.value - exact).abs() <= estimate.error + slack, "{:?} for {}", estimate, exact);
        prop_assert_eq!(estimate.status, Status::Converged);
    }

    /// Peaks of every width, with a break point at the top.
    #[test]
    fn peaks_within_their_claims(
        at in 0.01_f64..0.99, width in -30_i32..0, rule in any_rule(),
        tolerance in prop::sample::select(vec![1e-3, 1e-5, 1e-7, 1e-10]),
    ) {
        let width = 1.25 * power(width);
        let f = |x: f64| width / ((x - at) * (x - at) + width * width);
        let settings = GaussKronrod::new().rule(rule).relative(tolerance).limit(1_000_000);
        let estimate = settings.integrate_between(f, &[0.0, at, 1.0])?;
        let exact = num_traits::Float::atan((1.0 - at) / width) + num_traits::Float::atan(at / width);
        // Of the arc tangents and their sum.
        let rounding = 4.0 * f64::EPSILON * exact;
        prop_assert!((estimate.value - exact).abs() <= estimate.error + rounding, "{:?} for {}", estimate, exact);
    }

    /// Whatever the settings: within the limit, and what is not refused has an error that is no negative number or
    /// NaN.
    #[test]
    fn any_settings_end(
        ends in any::<[u64; 3]>(),
        tolerances in any::<[u64; 2]>(),
        limit in 0_u64..3000,
        rule in any_rule(),
        shape in 0..4,
    ) {
        let [a, b, c] = ends.map(f64::from_bits);
        let [absolute, relative] = tolerances.map(f64::from_bits);
        let f = |x: f64| match shape {
            0 => peak(x),
            1 => 1.0 / (x - c),
            2 => x * x,
            _ => exp(-x.abs()).sqrt(),
        };
        for relative in [relative, 1e-6] {
            let settings = GaussKronrod::new().absolute(absolute).relative(relative).limit(limit).rule(rule);
            let estimates = [settings.integrate(f, a, b), settings.integrate_between(f, &[a, b, c])];
            for estimate in estimates.into_iter().flatten() {
                prop_assert!(estimate.evaluations <= limit && estimate.error >= 0.0, "{:?}", estimate);
                prop_assert_eq!(estimate.value.is_nan(), matches!(estimate.status, Status::NotFinite { .. }));
            }
        }
    }
}

/// `1 / (1 + 16 (t - 0.3)^2)`.
fn peak(t: f64) -> f64 {
    let u = 4.0 * (t - 0.3);
    1.0 / (1.0 + u * u)
}

fn any_rule() -> impl Strategy<Value = Rule> {
    prop::sample::select(Rule::ALL.to_vec())
}

#[test]
fn nothing_costs_nothing() {
    let settings = GaussKronrod::<f64>::new();
    let nothing = Estimate { value: 0.0, error: 0.0, status: Status::Converged, evaluations: 0 };
    assert_eq!(settings.integrate(|_| f64::NAN, 3.5, 3.5).unwrap(), nothing);
    assert_eq!(settings.integrate_between(|_| f64::NAN, &[3.5, 3.5, 3.5]).unwrap(), nothing);
    let zero = settings.integrate(|_| 0.0, -2.0, 3.0).unwrap();
    assert_eq!(zero, Estimate { evaluations: 21, ..nothing });
}

/// `∫ x^2 dx`, where the two ends have hardly anything in between.
#[test]
fn intervals_that_vanish() {
    for rule in Rule::ALL {
        let settings = GaussKronrod::<f64>::new().rule(rule);
        for (a, b) in [
            (3.0, 3.0_f64.next_up()),
            (-3.0, (-3.0_f64).next_up()),
            (4.0_f64.next_down(), 4.0),
            (0.7, 0.7 + 1e-13),
            (1e-100, 1.1e-100),
        ] {
            let estimate = settings.integrate(|x| x * x, a, b).unwrap();
            // (b - a) (a^2 + a b + b^2) / 3: five roundings.
            let exact = (b - a) * (a * a + a * b + b * b) / 3.0;
            assert!(
                (estimate.value - exact).abs() <= estimate.error + 3.0 * f64::EPSILON * exact,
                "{estimate:?}"
            );
            assert_eq!(estimate.status, Status::Converged, "{estimate:?}");
        }
        // Widths and values below the normal range: the error says that digits are missing. In units of the smallest number.
        let smallest = f64::from_bits(1);
        for (count, height) in [(1.0, 3.0), (5.0, 0.3), (7.0, 0.1), (1e7, 1e-3), (3e40, 1e-38)] {
            let estimate = settings.absolute(1e-300).integrate(|_| height, 0.0, count * smallest).unwrap();
            let [value, error] = [estimate.value, estimate.error].map(|x| x / smallest);
            assert!((value - height * count).abs() <= error, "{rule:?}, {count} by {height}: {estimate:?}");
            assert!(error <= 1e-14 * height * count + 1000.0, "{estimate:?}");
        }
        // Values of few digits over a width that makes much of what they lack.
        let tiny = settings.absolute(1e-9).integrate(|_| 1234.0 * smallest, 0.0, 1e300).unwrap();
        assert!((tiny.value - 1234.0 * smallest * 1e300).abs() <= tiny.error, "{tiny:?}");
    }
}

#[test]
fn intervals_beyond_the_largest_width() {
    let settings = GaussKronrod::<f64>::new();
    let flat = settings.integrate(|_| 0.25, -f64::MAX, f64::MAX).unwrap();
    assert!((flat.value / 2.0 - 0.25 * f64::MAX).abs() <= flat.error / 2.0, "{flat:?}");
    assert_eq!(flat.status, Status::Converged);
    let slope = settings.integrate(|x| x / 1e300, -1e300, 3e300).unwrap();
    assert!((slope.value - 4e300).abs() <= slope.error && slope.status == Status::Converged, "{slope:?}");
    // Ends whose sum is no float: ∫ 2 (x / 1e308) dx.
    let high = settings.integrate(|x| 2.0 * (x / 1e308), 1e308, 1.5e308).unwrap();
    assert!((high.value - 1.25e308).abs() <= high.error && high.status == Status::Converged, "{high:?}");
    // A sum that is no float, of panels that are.
    let sum = settings.integrate_between(|_| 0.75, &[-f64::MAX, 0.0, f64::MAX]).unwrap();
    assert_eq!(sum.status, Status::NotFinite { lower: -f64::MAX, upper: f64::MAX });
}

/// What is not a number is not hidden, and where it is not, is said.
#[test]
fn an_integrand_that_is_not_finite() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let f = |x: f64| if (0.7..0.9).contains(&x) { bad } else { x };
        let estimate = GaussKronrod::new().integrate_between(f, &[0.0, 0.5, 2.0]).unwrap();
        let Status::NotFinite { lower, upper } = estimate.status else { panic!("{estimate:?}") };
        assert!((0.5..=0.9).contains(&lower) && (0.7..=2.0).contains(&upper));
        assert!(estimate.value.is_nan() && estimate.error.is_infinite());
    }
    // Finite values whose integral is none.
    let large = GaussKronrod::new().integrate(|_| 1e300, 0.0, 1e10_f64).unwrap();
    assert_eq!(large.status, Status::NotFinite { lower: 0.0, upper: 1e10 });
}

#[test]
fn what_cannot_be_known_is_said() {
    let settings = GaussKronrod::<f64>::new().relative(1e-12);
    // Divergent: halving does not help, and the error is infinite.
    let divergent = settings.integrate(|x| 1.0 / (x - 2.0), 2.0, 5.0).unwrap();
    assert!(matches!(divergent.status, Status::Unresolved { lower: 2.0, .. }), "{divergent:?}");
    assert!(divergent.error.is_infinite());
    // A singularity away from 0, which floats cannot resolve to twelve digits: 2 √(2 - 0.3) + 2 √0.3.
    let singular = settings.integrate_between(|x| 1.0 / (x - 0.3).abs().sqrt(), &[0.0, 0.3, 2.0]).unwrap();
    let Status::Unresolved { lower, upper } = singular.status else { panic!("{singular:?}") };
    assert!(lower <= 0.3 && 0.3 <= upper && upper - lower < 1e-12);
    assert!((singular.value - 2.0 * (1.7_f64.sqrt() + 0.3_f64.sqrt())).abs() <= singular.error);
    assert!(singular.error < 1e-5, "{singular:?}");
    // Cancellation: the integral of a large odd function.
    let odd = settings.integrate(|x| 1e6 * x, -3.0, 3.0).unwrap();
    assert_eq!(odd.status, Status::RoundOff);
    assert!(odd.value.abs() <= odd.error && odd.error < 1e-7);
    // Noise in the ninth digit, which a tolerance of twelve digits does not accept.
    let noisy = settings.integrate(|x: f64| 1.0 + 1e-9 * ((x * 1e15) % 1.0), 1.0, 3.0).unwrap();
    assert_eq!(noisy.status, Status::RoundOff);
    assert!(
        (noisy.value - 2.0).abs() <= 1e-8 && noisy.error > 1e-12 && noisy.evaluations < 10_000,
        "{noisy:?}"
    );
    // Too few evaluations: the value and the error stand.
    let short = settings.limit(63).integrate(|x: f64| x.sqrt(), 0.0, 4.0).unwrap();
    assert_eq!((short.status, short.evaluations), (Status::EvaluationLimit, 63));
    assert!((short.value - 16.0 / 3.0).abs() <= short.error && short.error < 0.01);
}

/// Both halves of the first panel are singular, and none of it is noise.
#[test]
fn singularities_at_both_ends_are_not_noise() {
    for rule in Rule::ALL {
        let settings = GaussKronrod::<f32>::new().rule(rule).relative(1e-4);
        let half_disc = settings.integrate(|x| (x * (3.0 - x)).sqrt(), 0.0, 3.0).unwrap();
        let truth = core::f32::consts::PI * 9.0 / 8.0;
        assert_eq!(half_disc.status, Status::Converged, "{rule:?}: {half_disc:?}");
        assert!((half_disc.value - truth).abs() <= half_disc.error + f32::EPSILON * truth);
    }
}

/// Places that no panel ends at: the difference scatters from halving to halving, and the claim covers it.
#[test]
fn a_singularity_that_nobody_names() {
    let power = |x: f64| num_traits::Float::powf(x, 0.6);
    for rule in [Rule::K15, Rule::K21, Rule::K31] {
        for tolerance in [1e-2, 1e-3, 1e-5, 1e-8] {
            for k in 1..200 {
                let place = (f64::from(k) * 0.6180339887498949).fract();
                let settings = GaussKronrod::new().rule(rule).relative(tolerance);
                let estimate = settings
                    .integrate(|x: f64| num_traits::Float::powf((x - place).abs(), -0.4), 0.0, 1.0)
                    .unwrap();
                let truth = (power(place) + power(1.0 - place)) / 0.6;
                // A node may hit the singularity.
                let hit = matches!(estimate.status, Status::NotFinite { .. });
                let error = (estimate.value - truth).abs();
                assert!(hit || error <= estimate.error, "{rule:?}, {tolerance:e}, {place}: {estimate:?}");
            }
        }
    }
}

#[test]
fn settings_that_mean_nothing_are_refused_with_what_is_allowed() {
    let settings = GaussKronrod::<f64>::new();
    let refused = |settings: GaussKronrod<f64>| settings.integrate(|x| x, 0.5, 2.0).unwrap_err().to_string();
    let relative = "allowed is 0, or from the spacing of floats at 1 up to 1";
    for x in [-1e-9, f64::EPSILON / 2.0, 1.5, f64::INFINITY, f64::NAN] {
        assert_eq!(refused(settings.relative(x)), format!("relative tolerance is {x}, {relative}"));
    }
    for x in [-1e-9, f64::INFINITY, f64::NAN] {
        assert_eq!(
            refused(settings.absolute(x)),
            format!("absolute tolerance is {x}, allowed is 0, or positive and finite")
        );
    }
    assert_eq!(
        refused(settings.relative(0.0)),
        "tolerance is 0, allowed is a positive absolute or relative one"
    );
    for (rule, limit) in Rule::ALL.into_iter().map(|rule| (rule, rule.evaluations())) {
        let allowed = format!("allowed is {limit} or more for each panel between break points");
        for limit in [0, limit - 1] {
            assert_eq!(
                refused(settings.rule(rule).limit(limit)),
                format!("evaluation limit is {limit}, {allowed}")
            );
        }
        let enough = settings.rule(rule).limit(2 * limit);
        assert_eq!(enough.integrate_between(|x| x, &[0.0, 0.5, 2.0]).unwrap().evaluations, 2 * limit);
        assert!(enough.integrate_between(|x| x, &[0.0, 0.5, 1.5, 2.0]).is_err());
    }
    for (ends, message) in [
        ([f64::NAN, 2.0], "lower end is NaN, allowed is finite numbers"),
        ([0.5, f64::INFINITY], "upper end is inf, allowed is finite numbers"),
    ] {
        assert_eq!(settings.integrate(|x| x, ends[0], ends[1]).unwrap_err().to_string(), message);
    }
    let between = |points: &[f64]| settings.integrate_between(|x| x, points).unwrap_err();
    assert_eq!(
        between(&[0.0, 2.0, 1.5]).to_string(),
        "break point 2 is 1.5, allowed is the point before it, or above"
    );
    assert!(matches!(between(&[0.0, f64::NAN, 1.5]), Error::BreakPoint { index: 1, .. }));
    assert_eq!(between(&[0.25]).to_string(), "number of break points is 1, allowed is 2 or more");
    assert!(matches!(between(&[]), Error::OutOfRange { .. }));
}

#[test]
fn graded_points_are_refused_or_ascend() {
    for (from, towards) in [(3.0, -0.5), (-6.6, 6.3), (f64::MAX, -f64::MAX), (1e-320, 0.0), (2.5, 2.5)] {
        for ratio in [0.01, 0.3, 0.999] {
            for panels in [1, 2, 7, 5000] {
                let points = graded(from, towards, ratio, panels).unwrap();
                assert_eq!(points.len(), panels + 1);
                assert!(points.is_sorted() && points.iter().all(|x| x.is_finite()));
                let (first, last) = (points[0], points[panels]);
                assert_eq!([first.min(last), first.max(last)], [from.min(towards), from.max(towards)]);
            }
        }
    }
    // The bound of its documentation, seen from double precision.
    for (from, towards, ratio) in [(-10.0_f32, 0.3, 0.15), (7.0, 1e-3, 0.8), (-1e-3, 1e3, 0.4)] {
        let wide = graded(f64::from(from), f64::from(towards), f64::from(ratio), 30).unwrap();
        let narrow = graded(from, towards, ratio, 30).unwrap();
        for k in 0..30 {
            let place = if from < towards { k } else { 30 - k };
            let error = (f64::from(narrow[place]) - wide[place]).abs();
            let bound = (k as f64 + 2.0) * f64::from(f32::EPSILON * from.abs().max(towards.abs()));
            assert!(error <= bound * (1.0 + 1e-8), "{error:e} at {k} from {from} towards {towards}");
        }
    }
    // Each distance is the ratio of the one before: the second power of 3/8 times 6.5.
    assert_eq!(graded(6.0, -0.5, 0.375, 3).unwrap(), [-0.5, 0.4140625, 1.9375, 6.0]);
    let refused =
        |from: f64, ratio: f64, panels: usize| graded(from, 0.0, ratio, panels).unwrap_err().to_string();
    assert_eq!(refused(f64::INFINITY, 0.5, 3), "end of a grading is inf, allowed is finite numbers");
    for ratio in [0.0, 1.0, -0.5, f64::NAN] {
        assert_eq!(
            refused(2.0, ratio, 3),
            format!("ratio of a grading is {ratio}, allowed is above 0 and below 1")
        );
    }
    for panels in [0, 10_001] {
        assert_eq!(refused(2.0, 0.5, panels), format!("number of panels is {panels}, allowed is 1 to 10000"));
    }
}
