//! The edges: intervals and values at the ends of the formats, what cannot be integrated, and what is refused.

use super::{any_rule, peak};
use approx::abs_diff_eq;
use mean_information::Error;
use mean_information::elementary::exp;
use mean_information::estimate::{Estimate, Status};
use mean_information::quadrature::adaptive::{GaussKronrod, Rule, graded};
use proptest::prelude::*;

proptest! {
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

#[test]
fn nothing_costs_nothing() {
    let settings = GaussKronrod::<f64>::new();
    let told =
        |estimate: Estimate<f64>| (estimate.value, estimate.error, estimate.status, estimate.evaluations);
    let nothing = (0.0, 0.0, Status::Converged, 0);
    assert_eq!(told(settings.integrate(|_| f64::NAN, 3.5, 3.5).unwrap()), nothing);
    assert_eq!(told(settings.integrate_between(|_| f64::NAN, &[3.5, 3.5, 3.5]).unwrap()), nothing);
    let zero = settings.integrate(|_| 0.0, -2.0, 3.0).unwrap();
    // A rule, and a value next to either end.
    assert_eq!(told(zero), (0.0, 0.0, Status::AllZero, 21 + 2));
}

/// `∫ x^2 dx`, where the two ends have hardly anything in between.
#[test]
fn intervals_that_vanish() {
    for &rule in Rule::ALL {
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
    // Of two, the one that matters more is named, wherever it is.
    for (near, far) in [(1.0, 1000.0), (1000.0, 1.0)] {
        let both = |x: f64| near / (x - 0.3).abs().sqrt() + far / (x - 1.1).abs().sqrt();
        let estimate = settings.integrate_between(both, &[0.0, 0.3, 0.7, 1.1, 2.0]).unwrap();
        let Status::Unresolved { lower, upper } = estimate.status else { panic!("{estimate:?}") };
        let at = if near > far { 0.3 } else { 1.1 };
        assert!((lower..=upper).contains(&at), "{lower} {upper}");
    }
    // Of many alike none is most of the error.
    let points = [0.3, 0.7, 1.1, 1.3, 1.7];
    let many = |x: f64| points.iter().map(|at| 1.0 / (x - at).abs().sqrt()).sum();
    let ends = [&[0.0], &points[..], &[2.0]].concat();
    assert_eq!(settings.integrate_between(many, &ends).unwrap().status, Status::RoundOff);
    // Cancellation: the integral of a large odd function.
    let odd = settings.integrate(|x| 1e6 * x, -3.0, 3.0).unwrap();
    assert_eq!(odd.status, Status::RoundOff);
    assert!(odd.value.abs() <= odd.error && odd.error < 1e-7);
    // Noise in the ninth digit, which a tolerance of twelve digits does not accept.
    let noisy = settings.integrate(|x: f64| 1.0 + 1e-9 * ((x * 1e15) % 1.0), 1.0, 3.0).unwrap();
    assert_eq!(noisy.status, Status::RoundOff);
    assert!(
        abs_diff_eq!(noisy.value, 2.0, epsilon = 1e-8) && noisy.error > 1e-12 && noisy.evaluations < 10_000,
        "{noisy:?}"
    );
    // Too few evaluations: the value and the error stand.
    let short = settings.limit(63).integrate(|x: f64| x.sqrt(), 0.0, 4.0).unwrap();
    assert_eq!((short.status, short.evaluations), (Status::EvaluationLimit, 63));
    assert!((short.value - 16.0 / 3.0).abs() <= short.error && short.error < 0.01);
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
    for (rule, limit) in Rule::ALL.iter().copied().map(|rule| (rule, rule.evaluations())) {
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
    assert!(matches!(between(&[0.0, f64::NAN, 1.5]), Error::Item { what: "break point", index: 1, .. }));
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
