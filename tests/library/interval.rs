//! Intervals: they contain the exact results, by integers of any size, and are no wider than they say.

use approx::abs_diff_eq;
use mean_information::Real;
use mean_information::elementary::{exp, ln, sqrt};
use mean_information::interval::{Endpoint, Interval};
use mean_information::scalar::Scalar;
use mean_information::{cell, elementary};
use num_bigint::BigInt;
use proptest::prelude::*;

/// `x 2^1200`, an integer for every float.
fn integer<T: Real>(x: T) -> BigInt {
    let (m, e) = x.parts();
    let magnitude = BigInt::from(m) << (1200 + e);
    if x.is_sign_negative() { -magnitude } else { magnitude }
}

/// Floats of all sizes, of few bits and of many.
fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<f64>().prop_filter("finite", |x| x.is_finite()),
        (-1e3_f64..1e3),
        (-40_i32..40, -60_i32..60).prop_map(|(m, e)| f64::from(m) * f64::from_parts(1, e)),
    ]
}

/// Numbers whose products and quotients are normal.
fn number() -> impl Strategy<Value = f64> {
    any_number().prop_filter("of moderate size", |x| *x == 0.0 || (1e-70..1e70).contains(&x.abs()))
}

fn interval() -> impl Strategy<Value = Interval<f64>> {
    (number(), number()).prop_map(|(a, b)| between(a.min(b), a.max(b)))
}

fn between<T: Real + Endpoint>(lower: T, upper: T) -> Interval<T> {
    Interval::new(lower, upper).expect("ends in order")
}

fn point<T: Real + Endpoint>(x: T) -> Interval<T> {
    between(x, x)
}

/// Both ends are the best floats about `exact / scale`: it lies between them, and they are neighbours, or it is one
/// of them.
fn is_best<T: Real + Endpoint>(x: Interval<T>, exact: &BigInt, scale: &BigInt) -> Result<(), TestCaseError> {
    let (lower, upper) = (integer(x.lower()) * scale, integer(x.upper()) * scale);
    prop_assert!(lower <= *exact && *exact <= upper, "{:?} misses it", x);
    prop_assert!(x.lower() == x.upper() || lower < *exact && *exact < upper, "{:?} is an ulp too wide", x);
    prop_assert!(next_up(x.lower()) >= x.upper(), "{:?} is too wide", x);
    Ok(())
}

/// The next float.
fn next_up<T: Real>(x: T) -> T {
    let step = |up: bool| {
        let (m, e) = x.parts();
        // The largest significand of an exponent has the next power of two as its neighbour, which `from_parts` makes
        // of it.
        let below = m == 1 << (T::PRECISION - 1) && e > T::MIN_EXPONENT;
        match (up, below) {
            (true, _) => T::from_parts(m + 1, e),
            (false, true) => T::from_parts(2 * m - 1, e - 1),
            (false, false) => T::from_parts(m - 1, e),
        }
    };
    if x >= T::zero() { step(true) } else { -step(false) }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn operations_on_points_give_the_best_ends(a in number(), b in number()) {
        let one = BigInt::from(1) << 1200_u32;
        let (x, y) = (integer(a), integer(b));
        is_best(point(a) + point(b), &(&x + &y), &BigInt::from(1))?;
        is_best(point(a) - point(b), &(&x - &y), &BigInt::from(1))?;
        is_best(point(a) * point(b), &(&x * &y), &one)?;
        if b != 0.0 {
            let sign = if b < 0.0 { -1 } else { 1 };
            is_best(point(a) / point(b), &(sign * (&x << 1200_u32)), &(sign * &y))?;
        }
        let (a, b) = (a as f32, b as f32);
        let (x, y) = (integer(a), integer(b));
        if a.is_finite() && b.is_finite() {
            if (a + b).is_finite() {
                is_best(point(a) + point(b), &(&x + &y), &BigInt::from(1))?;
            }
            if a == 0.0 || b == 0.0 || (1e-30..1e34).contains(&(a * b).abs()) && a.abs().max(b.abs()) < 1e34 {
                is_best(point(a) * point(b), &(&x * &y), &one)?;
            }
        }
    }

    /// Also where a product overflows or underflows.
    #[test]
    fn operations_contain_the_exact_result_for_any_floats(a in any_number(), b in any_number()) {
        let one = BigInt::from(1) << 1200_u32;
        let (x, y) = (integer(a), integer(b));
        let contains = |interval: Interval<f64>, exact: &BigInt, scale: &BigInt| {
            (interval.lower() == f64::NEG_INFINITY || integer(interval.lower()) * scale <= *exact)
                && (interval.upper() == f64::INFINITY || integer(interval.upper()) * scale >= *exact)
                && interval.lower() < f64::INFINITY && interval.upper() > f64::NEG_INFINITY
        };
        prop_assert!(contains(point(a) + point(b), &(&x + &y), &BigInt::from(1)));
        prop_assert!(contains(point(a) * point(b), &(&x * &y), &one));
        if b != 0.0 {
            let sign = if b < 0.0 { -1 } else { 1 };
            prop_assert!(contains(point(a) / point(b), &(sign * (&x << 1200_u32)), &(sign * &y)));
        }
        let root = point(a.abs()).sqrt();
        let square = integer(a.abs()) << 1200_u32;
        prop_assert!(integer(root.lower()).pow(2) <= square && square <= integer(root.upper()).pow(2));
    }

    /// The best ends about a value are neighbours, and one of them is its nearest float. Or they are the neighbours
    /// of that one, if the value is within `2^-66` of it, as `e^x` is of `1 + x` for tiny `x`.
    #[test]
    fn functions_of_points_give_the_best_ends(x in number(), p in super::common::occupancy()) {
        let y = x.abs();
        let cases = [
            (point(x % 700.0).exp(), exp(x % 700.0)),
            (if y == 0.0 { point(0.0) } else { point(y).ln() }, if y == 0.0 { 0.0 } else { ln(y) }),
            (point(y).sqrt(), sqrt(y)),
            (point(p).entropy(), cell::entropy(p)),
            (point(x).entropy_from_log_odds(), cell::entropy_from_log_odds(x)),
        ];
        for (interval, nearest) in cases {
            prop_assert!(interval.contains(nearest), "{interval:?} misses {nearest}");
            let nearest = between(nearest.next_down(), nearest.next_up());
            prop_assert!(interval.lower().next_up() >= interval.upper() || interval == nearest, "{interval:?}");
        }
        let x = (x % 80.0) as f32;
        prop_assert!(point(x).exp().contains(elementary::exp(x)));
        prop_assert!(point(p as f32).entropy().contains(cell::entropy(p as f32)));
    }

    /// Of any point in an interval, every function's nearest float lies in the interval of its values, ends included.
    #[test]
    fn functions_of_intervals_contain_those_of_points(
        x in interval(), p in interval(), share in 0.0_f64..=1.0
    ) {
        let inside = |x: Interval<f64>| (x.lower() + share * (x.upper() - x.lower())).clamp(x.lower(), x.upper());
        let at = inside(x);
        if at.abs() < 700.0 {
            prop_assert!(x.exp().contains(exp(at)));
        }
        if at > 0.0 {
            prop_assert!(x.ln().contains(ln(at)) && x.sqrt().contains(sqrt(at)));
        }
        prop_assert!(x.entropy_from_log_odds().contains(cell::entropy_from_log_odds(at)));
        let p = Interval::constant(1.0) / (Interval::constant(1.0) + p * p);
        prop_assert!(p.entropy().contains(cell::entropy(inside(p).min(1.0))));
    }

    #[test]
    fn operations_on_intervals_contain_those_of_their_points(
        x in interval(), y in interval(), s in 0.0_f64..=1.0, t in 0.0_f64..=1.0
    ) {
        let inside = |x: Interval<f64>, s: f64| (x.lower() + s * (x.upper() - x.lower())).clamp(x.lower(), x.upper());
        let (a, b) = (inside(x, s), inside(y, t));
        for (whole, part) in [(x + y, a + b), (x - y, a - b), (x * y, a * b), (x / y, a / b)] {
            // Rounding is monotone: the nearest float lies between the ends, which are floats.
            prop_assert!(part.is_nan() || whole.contains(part) || part.is_infinite(), "{part} not in {whole:?}");
        }
        for ends in [x * y, -((-x) * y), -(x * (-y)), (-x) * (-y), y * x] {
            prop_assert_eq!(ends, x * y);
        }
        // The ends of a product are products of ends.
        let products = [x.lower() * y.lower(), x.lower() * y.upper(), x.upper() * y.lower(), x.upper() * y.upper()];
        prop_assert!((x * y).lower() >= products.iter().fold(f64::INFINITY, |a, b| a.min(*b)).next_down());
        prop_assert!((x * y).upper() <= products.iter().fold(f64::NEG_INFINITY, |a, b| a.max(*b)).next_up());
    }

    /// What is contained stays contained.
    #[test]
    fn a_part_goes_into_the_whole(x in interval(), share in 0.0_f64..=0.5) {
        let trim = share * (x.upper() - x.lower());
        let lower = (x.lower() + trim).min(x.upper());
        let part = between(lower, (x.upper() - trim).max(lower));
        let functions: [fn(Interval<f64>) -> Interval<f64>; 5] =
            [Scalar::exp, Scalar::ln, Scalar::sqrt, Scalar::entropy_from_log_odds, |x| x * x - x / point(3.0)];
        for f in functions {
            let (inner, outer) = (f(part), f(x));
            prop_assert!(inner.is_empty() || outer.lower() <= inner.lower() && inner.upper() <= outer.upper());
        }
    }
}

#[test]
fn the_edges_of_the_domains() {
    let minus_one_to_four = between(-1.0_f64, 4.0);
    assert_eq!(minus_one_to_four.sqrt(), between(0.0, 2.0));
    assert_eq!(minus_one_to_four.ln().lower(), f64::NEG_INFINITY);
    for empty in [
        between(-2.0, -1.0).ln(),
        between(-2.0, 0.0).ln(),
        between(-2.0, -0.5).sqrt(),
        between(1.5, 2.0).entropy(),
        point(3.0) / point(0.0),
        Interval::constant(f64::NAN),
        Interval::constant(f64::INFINITY),
    ] {
        assert!(empty.is_empty());
        // Nothing comes of nothing.
        assert!((empty + point(2.0)).is_empty() && (point(0.0) * empty).is_empty() && empty.exp().is_empty());
        assert!((empty / point(2.0)).is_empty() && empty.entropy_from_log_odds().is_empty());
        let whole = Interval::WHOLE;
        assert!((empty + whole).is_empty() && (whole + empty).is_empty() && (whole * empty).is_empty());
        assert!((empty / whole).is_empty() && (whole / empty).is_empty());
        assert!(!empty.contains(0.0) && !empty.is_bounded());
    }
    assert_eq!(between(0.25, 1.5).entropy(), between(0.0, 1.0));
    assert_eq!(between(-0.25, 0.25).entropy(), between(0.0, 0.811_278_124_459_132_8_f64.next_up()));
    assert_eq!(between(-0.25, 0.5).entropy_from_log_odds().upper(), 1.0);
}

#[test]
fn without_bounds() {
    let whole = Interval::<f64>::WHOLE;
    let (below, above) = (between(f64::NEG_INFINITY, 2.5), between(2.5, f64::INFINITY));
    assert_eq!([whole, below, above, point(2.5)].map(|x| x.is_bounded()), [false, false, false, true]);
    assert_eq!(point(1.0) / between(-1.0, 2.0), whole);
    assert_eq!(point(1.0) / between(0.0, 2.0), between(0.5, f64::INFINITY));
    assert_eq!(point(1.0) / between(-2.0, 0.0), between(f64::NEG_INFINITY, -0.5));
    assert_eq!(whole * point(0.0), point(0.0));
    assert_eq!(whole.exp(), between(0.0, f64::INFINITY));
    assert_eq!((-whole - whole, whole.sqrt().lower()), (whole, 0.0));
    assert_eq!(whole.entropy_from_log_odds(), between(0.0, 1.0));
    // Overflow is no number, but no bound either.
    assert_eq!(point(f64::MAX) + point(f64::MAX), between(f64::MAX, f64::INFINITY));
    assert_eq!(point(800.0_f64).exp(), between(f64::MAX, f64::INFINITY));
    assert_eq!(point(-800.0_f64).exp(), between(0.0, f64::from_bits(1)));
    assert_eq!(Interval::<f32>::constant(1e300), between(f32::MAX, f32::INFINITY));
}

#[test]
fn what_is_no_interval_is_refused_with_its_reason() {
    let refused = |lower: f64, upper: f64| Interval::new(lower, upper).unwrap_err().to_string();
    assert_eq!(refused(2.5, 2.25), "upper end is 2.25, allowed is a number not below the lower end, or inf");
    assert_eq!(refused(f64::NAN, 2.25), "lower end is NaN, allowed is a number or -inf");
    assert!(refused(2.5, f64::NAN).starts_with("upper end is NaN"));
    assert!(refused(f64::INFINITY, f64::INFINITY).starts_with("lower end is inf"));
    assert!(refused(f64::NEG_INFINITY, f64::NEG_INFINITY).starts_with("upper end is -inf"));
}

proptest! {
    /// Powers and `x ln x` of an interval hold those of its numbers, and no negative even ones.
    #[test]
    fn powers_hold_those_of_the_numbers_within(
        a in -3.0_f64..3.0, length in 0.0_f64..2.0, share in 0.0_f64..=1.0, n in -6_i32..7,
    ) {
        let x = between(a, a + length);
        let within = (a + share * length).clamp(a, a + length);
        // By points: products of intervals without width.
        let at = point(within);
        let product = (0..n.unsigned_abs()).fold(Interval::constant(1.0), |power, _| power * at);
        let exact = if n < 0 { Interval::constant(1.0) / product } else { product };
        let power = x.powi(n);
        prop_assert!(power.lower() <= exact.upper() && exact.lower() <= power.upper(), "{:?}^{}", x, n);
        prop_assert!(n % 2 != 0 || power.lower() >= 0.0);
        prop_assert_eq!(x.square(), x.powi(2));
        if within > 0.0 {
            let (term, exact) = (x.x_ln_x(), at * at.ln());
            prop_assert!(term.lower() <= exact.upper() && exact.lower() <= term.upper(), "{:?}", x);
            prop_assert!(term.lower() >= -0.367_879_441_171_442_4);
        }
    }
}

#[test]
fn powers_at_the_edges() {
    let interval = |lower, upper| between::<f64>(lower, upper);
    assert_eq!(interval(-1.0, 2.0).powi(0), point(1.0));
    assert_eq!(interval(-2.0, 0.5).powi(3), interval(-8.0, 0.125));
    assert_eq!(interval(0.0, 2.0).powi(-2), interval(0.25, f64::INFINITY));
    assert_eq!(interval(-0.5, 2.0).powi(-2), interval(0.25, f64::INFINITY));
    assert_eq!(interval(-0.5, 2.0).powi(-1), Interval::WHOLE);
    assert_eq!(interval(-0.5, f64::INFINITY).square(), interval(0.0, f64::INFINITY));
    assert!(Interval::<f64>::EMPTY.powi(0).is_empty() && interval(-2.0, -1.0).x_ln_x().is_empty());
    assert_eq!(interval(-1.0, 0.0).x_ln_x(), point(0.0));
    // Falling before 1/e, rising after, least about it.
    let term = |lower, upper| interval(lower, upper).x_ln_x();
    assert!(term(0.1, 0.2).upper() > -0.231 && term(0.1, 0.2).lower() > -0.322);
    assert!(term(0.5, 2.0).lower() > -0.347 && term(0.5, 2.0).upper() > 1.386);
    assert_eq!(term(0.25, 1.0), interval(-0.367_879_441_171_442_33, 0.0));
}

proptest! {
    /// The bounds of [`Scalar::powi`] and [`Scalar::x_ln_x`] in `f32`, seen from `f64`, where they are far smaller.
    #[test]
    fn powers_of_floats_are_within_their_bounds(x in 0.3_f32..3.0, n in -60_i32..61) {
        let wide = f64::from(x);
        let ulp = |x: f64| f64::from((x as f32).abs().next_up() - (x as f32).abs());
        for (x, wide) in [(x, wide), (-x, -wide)] {
            let exact = Scalar::powi(wide, n);
            let error = (f64::from(Scalar::powi(x, n)) - exact).abs();
            prop_assert!(error <= (f64::from(n.abs()) + 1.0) * ulp(exact), "{x}^{n}: {error:e}");
        }
        prop_assert_eq!(Scalar::square(x), x * x);
        let exact = wide.x_ln_x();
        prop_assert!(abs_diff_eq!(f64::from(x.x_ln_x()), exact, epsilon = 1.5 * ulp(exact)) || x == 1.0, "{x}");
    }
}
