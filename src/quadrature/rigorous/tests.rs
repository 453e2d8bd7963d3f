//! The rules, exactly; and the remainder, where it is known.

use super::gauss;
use super::nodes::RULES;
use super::settings::Rigorous;
use super::state::Search;
use crate::estimate::Status;
use crate::interval::{Interval, Toward, Wide};
use crate::quadrature::Tolerance;
use crate::scalar::{Integrand, Scalar};
use approx::assert_relative_eq;
use num_bigint::BigInt;

/// `P_n(x 2^-127) 2^(127 n) n!`, by the recurrence `k P_k = (2k - 1) x P_(k-1) - (k - 1) P_(k-2)`.
fn legendre(n: u32, x: &BigInt) -> BigInt {
    let (mut before, mut value) = (BigInt::from(1), x.clone());
    for k in 2..=n {
        // Scaled by 2^(127 k) k!, a step back brings (k - 1) 2^254.
        let next = (2 * k - 1) * x * &value - ((((k - 1) * (k - 1)) * before) << 254_u32);
        (before, value) = (value, next);
    }
    value
}

/// A node lies between the stored integer and the next: `P_n` changes its sign there. They are `n` different ones.
#[test]
fn nodes_are_the_roots_of_legendre_polynomials() {
    for rule in RULES {
        let n = 2 * rule.len() as u32;
        for (k, &(node, _)) in rule.iter().enumerate() {
            let signs = [node, node + 1].map(|x| legendre(n, &BigInt::from(x)).sign());
            assert!(signs[0] != signs[1], "node {k} of {n}");
            assert!(k == 0 || rule[k - 1].0 < node);
        }
    }
}

/// The weights integrate `x^0, x^2, .., x^(n - 2)` exactly, which determines them: `sum w x^2k = 1 / (2k + 1)` lies
/// between the sums of the stored integers and of the next ones.
#[test]
fn weights_integrate_all_powers() {
    for rule in RULES {
        for k in 0..rule.len() as u32 {
            let sum = |up: u128| {
                let term =
                    |&(node, weight): &(u128, u128)| BigInt::from(node + up).pow(2 * k) * (weight + up);
                rule.iter().map(term).sum::<BigInt>() * (2 * k + 1)
            };
            let one = BigInt::from(1) << (127 * (2 * k + 1));
            assert!(sum(0) <= one && one <= sum(1), "power {} of {}", 2 * k, 2 * rule.len());
        }
    }
}

struct Exponential;
impl Integrand for Exponential {
    fn evaluate<S: Scalar>(&self, x: S) -> S {
        x.exp()
    }
}

/// The rectangles cover the upper half of the unit disc, which half axes stretch to an ellipse: from left to right
/// without a gap, each at least as high as the circle at its end nearer to the middle. In thousandths, exactly.
#[test]
fn rectangles_cover_the_ellipse() {
    let thousandths = |x: f64| (x * 1000.0).round() as i64;
    let mut rectangles = gauss::RECTANGLES.map(|(from, to, height)| [from, to, height].map(thousandths));
    rectangles.sort_unstable();
    let mut reached = -1000;
    for [from, to, height] in rectangles {
        assert_eq!(from, reached);
        let nearest = if from < 0 && 0 < to { 0 } else { from.abs().min(to.abs()) };
        assert!(height.pow(2) + nearest.pow(2) >= 1_000_000);
        reached = to;
    }
    assert_eq!(reached, 1000);
}

/// Where the remainder makes most of the width: `e^x` about 0, whose integral is `e^r - e^-r`.
#[test]
fn the_remainder_is_within_its_bound() {
    let mut evaluations = 0;
    for (radius, allowed) in [(1.0, 1e-3), (1.0, 1e-9), (2.5, 1e-6), (4.0, 1e-4), (6.0, 1e-2)] {
        let choice = gauss::Chooser::new()
            .choose(&Exponential, -radius, radius, allowed, &mut evaluations)
            .expect("an entire function");
        let rough = gauss::integrate(&Exponential, -radius, radius, &choice, &mut evaluations);
        let e = Interval::<Wide>::constant(radius).exp();
        let exact = e - Interval::constant(1.0) / e;
        assert!(rough.lower() <= exact.lower() && exact.upper() <= rough.upper(), "radius {radius}");
        let width: f64 = rough.width().to_real(Toward::Up);
        assert!(width <= 2.0 * allowed);
    }
}

/// A cube, which has no integral between opposite ends.
struct Cube;
impl Integrand for Cube {
    fn evaluate<S: Scalar>(&self, x: S) -> S {
        x.clone() * x.clone() * x
    }
}

/// `1 / √|x - at|`, unbounded in the middle of things.
struct Peak {
    at: f64,
}
impl Integrand for Peak {
    fn evaluate<S: Scalar>(&self, x: S) -> S {
        let d = x - S::constant(self.at);
        S::constant(1.0) / (d.clone() * d).sqrt().sqrt()
    }
}

struct Root;
impl Integrand for Root {
    fn evaluate<S: Scalar>(&self, x: S) -> S {
        x.sqrt()
    }
}

#[test]
fn the_estimate_is_about_the_magnitude() {
    fn estimate(f: &impl Integrand, from: f64, to: f64) -> f64 {
        Search { f, from, to, evaluations: 0, limit: 1000 }
            .estimate(Tolerance { absolute: 0.0, relative: 1e-12 })
    }
    for (from, to) in [(0.5, 1.5), (-1.0, 2.0), (3.0, 3.125)] {
        let exact = core_math::exp(to) - core_math::exp(from);
        assert_relative_eq!(estimate(&Exponential, from, to), exact, epsilon = 0.0, max_relative = 1e-9);
    }
    // What cancels is not taken for nothing: some of the crudest bound is left, `4 (2 · 8)`.
    let cancelled = estimate(&Cube, -2.0, 2.0);
    assert!(cancelled > 0.0 && cancelled <= 64.0 / f64::from(1 << 20), "{cancelled}");
    let larger = estimate(&Cube, -200.0, 200.0);
    assert_relative_eq!(larger / cancelled, 1e8, epsilon = 0.0, max_relative = 1e-6);
}

/// Cut until floats end, or at `2^-120` of the whole.
#[test]
fn what_has_no_bound_is_named_as_closely_as_can_be() {
    for at in [0.7, 0.7_f64.next_up()] {
        let result = Rigorous::default().integrate(&Peak { at }, 0.25, 1.0).unwrap();
        let Status::Unresolved { lower, upper } = result.status else { panic!("{result:?}") };
        assert!(lower <= at && at <= upper && upper <= lower.next_up().next_up(), "{lower} {upper}");
    }
    for (from, to) in [(-1.0, 1.0), (0.0, 3.0), (-3.0, 0.0), (-3.0, 1.0)] {
        let result = Rigorous::default().integrate(&Peak { at: 0.0 }, from, to).unwrap();
        let Status::Unresolved { lower, upper } = result.status else { panic!("{result:?}") };
        let width = (upper - lower) / (to - from) * core_math::exp2(120.0);
        assert!(lower <= 0.0 && 0.0 <= upper && 0.25 < width && width <= 1.0, "{lower} {upper}");
    }
}

#[test]
fn the_limit_on_evaluations_is_kept() {
    for limit in (100..2000).step_by(37) {
        for to in [0.5, 30.0, 1e4] {
            let rule = Rigorous::<f64>::new().relative(1e-15).limit(limit);
            let result = rule.integrate(&Peak { at: -1e-3 }, 0.0, to).unwrap();
            assert!(result.evaluations <= limit, "{limit}: {result:?}");
        }
        // A hundred panels towards 0, each of which is evaluated once more.
        let rule = Rigorous::<f64>::new().absolute(1e-60).relative(0.0).limit(limit);
        let result = rule.integrate(&Root, 0.0, 3.0).unwrap();
        assert!(result.evaluations <= limit, "{limit}: {result:?}");
    }
}

/// `x^3 + 10^-9`: next to its range, the integral between opposite ends is nothing.
struct Offset;
impl Integrand for Offset {
    fn evaluate<S: Scalar>(&self, x: S) -> S {
        Cube.evaluate(x) + S::constant(1e-9)
    }
}

/// The same with the roots of twenty distances, each of which takes its share of the tolerance.
struct Kinks;
impl Integrand for Kinks {
    fn evaluate<S: Scalar>(&self, x: S) -> S {
        let root = |k: i32| {
            let d = x.clone() - S::constant(-1.9 + 0.2 * f64::from(k));
            (d.clone() * d).sqrt().sqrt()
        };
        let roots = (1..20).fold(root(0), |sum, k| sum + root(k));
        Cube.evaluate(x.clone()) + S::constant(1e-9) * roots
    }
}

/// The first tolerance is that of the range; then more is asked for.
#[test]
fn what_cancels_is_integrated_again() {
    for relative in [1e-2, 1e-3, 1e-6, 1e-9] {
        let result = Rigorous::<f64>::new().relative(relative).integrate(&Offset, -2.0, 2.0).unwrap();
        assert_eq!(result.status, Status::Converged, "{result:?}");
        assert!(result.contains(4e-9) && result.width() <= 4.1e-9 * relative, "{result:?}");
    }
    let kinks = Rigorous::<f64>::new().relative(1e-2).integrate(&Kinks, -2.0, 2.0).unwrap();
    assert_eq!(kinks.status, Status::Converged, "{kinks:?}");
}

/// The constants of the rules are cut: nodes and weights lie above.
#[test]
fn a_floor_stands_for_what_it_was_cut_from() {
    let interval = gauss::floored(5);
    let middle = Wide::from_integer(11, -128);
    assert!(interval.lower() < middle && middle < interval.upper());
}
