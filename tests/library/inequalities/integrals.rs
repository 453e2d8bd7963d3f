//! The limits and their series, and what Gauss's rules leave out.

use super::search::{IN_F64, between, choice, in_ulps, inequalities, scaled};
use approx::{abs_diff_eq, assert_abs_diff_eq};
use core::f64::consts::{LN_2, PI};
use mean_information::cell::entropy;
use mean_information::elementary::{exp, ln};
use mean_information::estimate::Enclosure;
use mean_information::limit::{Weight, closed_form};
use mean_information::quadrature::rigorous::Rigorous;
use mean_information::scalar::{Integrand, Scalar};
use mean_information::sensor::GaussianSensor;
use std::sync::LazyLock;

/// `1 / (x + c)`, or `e^(c x)`.
enum Known {
    Reciprocal(f64),
    Exponential(f64),
}

impl Integrand for Known {
    fn evaluate<S: Scalar>(&self, x: S) -> S {
        match *self {
            Self::Reciprocal(c) => S::constant(1.0) / (x + S::constant(c)),
            Self::Exponential(c) => (S::constant(c) * x).exp(),
        }
    }
}

/// How far the exact integral is from the middle of its enclosure, over half the width, which has room for 8 roundings.
fn enclosed(u: &[f64]) -> f64 {
    let (from, width, c) = (between(u[0], 0.0, 3.0), scaled(u[1], 0.01, 10.0), scaled(u[2], 0.01, 3.0));
    let to = from + width;
    let (integrand, exact) = if u[3] < 0.5 {
        (Known::Reciprocal(c), ln((to + c) / (from + c)))
    } else {
        (Known::Exponential(-c), (exp(-c * from) - exp(-c * to)) / c)
    };
    let rule = Rigorous::new().absolute(0.0).relative(scaled(u[4], 1e-12, 0.1));
    let Enclosure { lower, upper, .. } = rule.integrate(&integrand, from, to).unwrap();
    // The terms of the difference are below 1, and over c.
    let rounding = 8.0 * f64::EPSILON * (1.0 + 1.0 / c);
    (exact - f64::midpoint(lower, upper)).abs() / ((upper - lower) / 2.0 + rounding)
}

/// The coefficients `φ_k` and `ψ_k` for `k < 150`, times `(2π)^k`; made once.
static COEFFICIENTS: LazyLock<(Vec<f64>, Vec<f64>)> = LazyLock::new(coefficients);

/// By Euler's product.
fn coefficients() -> (Vec<f64>, Vec<f64>) {
    const TERMS: usize = 150;
    let tau = 2.0 * PI;
    let (mut phi, mut power, mut log) = (vec![0.0; TERMS], vec![0.0; TERMS], vec![0.0; TERMS]);
    let mut term = 1.0; // (-2π)^k / k!
    for k in 0..TERMS {
        power[k] = term;
        phi[k] = term / (k + 1) as f64;
        term *= -tau / (k + 1) as f64;
    }
    log[1] = -tau / 2.0;
    for j in 1..TERMS / 2 {
        // ζ(2 j): its first terms, and the rest by its integral from the middle of two.
        let n_to = |n: f64| exp(-2.0 * j as f64 * ln(n));
        let rest = 2000.5 * n_to(2000.5) / (2.0 * j as f64 - 1.0);
        let zeta = (1..=2000).rev().map(|n| n_to(f64::from(n))).sum::<f64>() + rest;
        log[2 * j] = if j % 2 == 0 { -zeta } else { zeta } / j as f64;
    }
    let product = |k: usize| (0..=k).map(|j| phi[j] * log[k - j]).sum::<f64>();
    let psi = (0..TERMS).map(|k| power[k] - product(k)).collect();
    (phi, psi)
}

/// The integral of `(t - a)^moment η(t)` from `a` on, by eight nodes in each of 40 steps of `1/a`, over which the integrand
/// falls by `e` and more: what is left is below `e^-40` of it.
fn tail(u: &[f64], moment: u32) -> f64 {
    let a = between(u[0], 16.0, 30.0);
    let bound = (a * a + 2.0) * exp(-a * a / 2.0) / LN_2;
    let rule = gauss(8);
    let step = |k: u32| {
        let of_node = |&(x, weight): &(f64, f64)| {
            let beyond = (f64::from(k) + f64::midpoint(x, 1.0)) / a;
            let t = a + beyond;
            let factor = if moment == 0 { 1.0 } else { beyond };
            weight / (2.0 * a) * factor * entropy(exp(-t * t / 2.0))
        };
        rule.iter().map(of_node).sum::<f64>()
    };
    (0..40).map(step).sum::<f64>() / bound
}

/// Two places in one of the three monotone parts of a limit: the value that should be the less, over the other.
fn monotone(u: &[f64], weight: Weight, [maximum, minimum]: [f64; 2]) -> Option<f64> {
    let parts = [(1e-3, maximum), (maximum, minimum), (minimum, 1e4)];
    let part = choice(u[0], 3);
    let place = |u: f64| scaled(u, parts[part].0, parts[part].1);
    let (first, second) = (place(u[1].min(u[2])), place(u[1].max(u[2])));
    if first == second {
        return None;
    }
    let [first, second] =
        [first, second].map(|alpha| closed_form(&GaussianSensor::new(alpha, 1.0).unwrap(), weight));
    Some(if part == 1 { second / first } else { first / second })
}

/// Legendre's polynomial of degree `n` and its derivative.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, x);
    for k in 1..n {
        let k = k as f64;
        (before, value) = (value, ((2.0 * k + 1.0) * x * value - k * before) / (k + 1.0));
    }
    (value, n as f64 * (x * value - before) / (x * x - 1.0))
}

/// Nodes and weights of the rule of `n` nodes: sign changes on a grid, halved until they are floats.
fn gauss(n: usize) -> Vec<(f64, f64)> {
    let grid: Vec<f64> = (0..=400).map(|k| -0.999 + 1.998 * f64::from(k) / 400.0 + 1e-5).collect();
    let mut rule = Vec::new();
    for pair in grid.windows(2) {
        let [mut low, mut high] = [pair[0], pair[1]];
        if legendre(n, low).0 * legendre(n, high).0 >= 0.0 {
            continue;
        }
        for _ in 0..60 {
            let middle = f64::midpoint(low, high);
            if legendre(n, low).0 * legendre(n, middle).0 <= 0.0 { high = middle } else { low = middle }
        }
        let slope = legendre(n, low).1;
        rule.push((low, 2.0 / ((1.0 - low * low) * slope * slope)));
    }
    assert_eq!(rule.len(), n);
    rule
}

fn leaves_out(n: usize, exact: f64, g: impl Fn(f64) -> f64, largest: f64, r: f64) -> f64 {
    let sum: f64 = gauss(n).into_iter().map(|(x, weight)| weight * g(x)).sum();
    let to_minus_2n = exp(-2.0 * n as f64 * ln(r));
    (exact - sum).abs() / (64.0 / 15.0 * largest * to_minus_2n / (1.0 - 1.0 / (r * r)))
}

inequalities! {
    extrema_radial: "limit", "Theorem (extrema)", 3, 4.0 * f64::EPSILON, |u| {
        monotone(u, Weight::Radial, [0.457_663_790_838_69, 1.902_825_719_235_39])
    };
    extrema_area: "limit", "Theorem (extrema)", 3, 4.0 * f64::EPSILON, |u| {
        monotone(u, Weight::Area, [1.177_410_022_515_47, 2.549_942_984_682_18])
    };
    series: "closed_form", "Lemma (series)", 2, 1e-9, |u| {
        let (k, (phi, psi)) = ((u[0] * 150.0) as usize, &*COEFFICIENTS);
        Some(if u[1] < 0.5 { phi[k].abs() / 86.0 } else { psi[k].abs() / 876.0 })
    };
    tail_of_entropy: "closed_form", "Lemma (tail)", 1, 1e-6, |u| Some(tail(u, 0));
    tail_of_its_integral: "closed_form", "Lemma (tail)", 1, 1e-6, |u| Some(tail(u, 1));
    // In f32, beside the f64 function, which is 2^-28 ulp off.
    closed_form_f32: "closed_form", "Theorem (closed form)", 3, IN_F64, |u| {
        let z = between(u[0], 0.01, 40.0) as f32;
        let sigma = z / scaled(u[1], 1e-9, 1e9) as f32;
        let weight = if u[2] < 0.5 { Weight::Radial } else { Weight::Area };
        let wide = closed_form(&GaussianSensor::new(f64::from(z), f64::from(sigma)).unwrap(), weight);
        Some(in_ulps(closed_form(&GaussianSensor::new(z, sigma).unwrap(), weight), wide, 0.5))
    };
    // 1 / (c - x), whose largest value on the ellipse is at its vertex; of few nodes, so that rounding is no matter.
    remainder_of_a_pole: "integration", "Theorem (remainder)", 3, 1e-6, |u| {
        let (n, r) = (2 + choice(u[0], 3), scaled(u[1], 1.05, 4.0));
        let vertex = f64::midpoint(r, 1.0 / r);
        let c = vertex + scaled(u[2], 0.001, 10.0);
        Some(leaves_out(n, ln((c + 1.0) / (c - 1.0)), |x| 1.0 / (c - x), 1.0 / (c - vertex), r))
    };
    // Chebyshev's polynomial of degree 2 n, the first that the rule does not integrate.
    remainder_of_a_polynomial: "integration", "Theorem (remainder)", 2, 1e-9, |u| {
        let (n, r) = (2 + choice(u[0], 7), scaled(u[1], 1.01, 100.0));
        let chebyshev = |x: f64| {
            let (mut before, mut value) = (1.0, x);
            for _ in 1..2 * n { (before, value) = (value, 2.0 * x * value - before); }
            value
        };
        let to_2n = exp(2.0 * n as f64 * ln(r));
        let exact = 2.0 / (1.0 - 4.0 * (n * n) as f64);
        Some(leaves_out(n, exact, chebyshev, f64::midpoint(to_2n, 1.0 / to_2n), r))
    };
    enclosure: "integration", "Theorem (enclosure)", 5, 0.0, |u| Some(enclosed(u));
}

/// The first coefficients, by hand.
#[test]
fn the_coefficients_are_those_of_the_chapter() {
    let (phi, psi) = &*COEFFICIENTS;
    assert!(
        abs_diff_eq!(phi[1], -PI, epsilon = 1e-14)
            && abs_diff_eq!(phi[2], 4.0 * PI * PI / 6.0, epsilon = 1e-13)
    );
    // ψ = 1 - s/2 + …: e^-s is 1 - s, φ ln φ is -s/2.
    assert!(abs_diff_eq!(psi[0], 1.0, epsilon = 1e-15) && abs_diff_eq!(psi[1], -PI, epsilon = 1e-13));
    // ln φ = -s/2 + s^2/24: φ ln φ is -s/2 + s^2/4 + s^2/24, and e^-s is 1 - s + s^2/2.
    let second = (0.5 - 0.25 - 1.0 / 24.0) * 4.0 * PI * PI;
    assert_abs_diff_eq!(psi[2], second, epsilon = 1e-6);
}
