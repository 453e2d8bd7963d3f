//! One panel by a Gauss-Legendre rule: `int_-1^1 g = sum w_i g(x_i) + R_n`, with a bound on `R_n`.
//!
//! If `g` is analytic on the ellipse with foci ±1 and half axes that add to `r > 1`, and `|g| <= G` there, then
//! `|R_n| <= (64/15) G r^-2n / (1 - r^-2)` for `n >= 2` (derived in [`integration`](crate::book::integration)).

use super::nodes::RULES;
use crate::interval::{Complex, Interval, Wide};
use crate::scalar::{Integrand, Scalar};

/// The ellipses that are tried, by their `r`.
const ELLIPSES: [f64; 4] = [5.0, 3.0, 2.0, 1.5];

/// Five rectangles that cover the upper half of an ellipse: from one fraction of the half axis to the other, as high as
/// a third fraction of the other half axis, `√(1 - x^2)` or a little more at the end nearer to the middle. Outer ones
/// first: singularities lie there.
pub(super) const RECTANGLES: [(f64, f64, f64); 5] =
    [(-1.0, -0.8, 0.601), (0.8, 1.0, 0.601), (-0.8, -0.35, 0.937), (0.35, 0.8, 0.937), (-0.35, 0.35, 1.0)];

/// Returns the nodes and weights of one of the rules, as floats.
pub(super) fn floats() -> impl Iterator<Item = (f64, f64)> {
    // Scale 127: the upper 64 bits, over 2^63.
    let float = |value: u128| (value >> 64) as f64 / (1_u64 << 63) as f64;
    RULES[6].iter().map(move |&(node, weight)| (float(node), float(weight)))
}

/// A rule, and a bound on what it leaves out on one panel.
pub(super) struct Choice {
    rule: &'static [(u128, u128)],
    remainder: f64,
}

/// The memory of which ellipse fitted last: neighbours are alike.
pub(super) struct Chooser {
    last: usize,
    /// True if the last panel had none, and so perhaps its half has none.
    none: bool,
}

impl Chooser {
    /// Creates a memory without panels.
    pub(super) fn new() -> Self {
        Self { last: 0, none: false }
    }

    /// Chooses the shortest rule whose remainder between `a` and `b` is at most `allowed`.
    pub(super) fn choose(
        &mut self,
        f: &impl Integrand,
        a: f64,
        b: f64,
        allowed: f64,
        evaluations: &mut u64,
    ) -> Option<Choice> {
        let ends = (Interval::point(a), Interval::point(b));
        let half = Interval::constant(0.5);
        // Enclosed, as the middle need not be a float; halves first, so that nothing overflows.
        let (centre, radius) = (half * ends.0 + half * ends.1, half * ends.1 - half * ends.0);
        let mut largest = |ellipse: f64, rectangles: &[(f64, f64, f64)]| {
            let (rho, inverse) =
                (Interval::point(ellipse), Interval::constant(1.0) / Interval::point(ellipse));
            // Half axes (r ± 1/r) / 2 of the half width.
            let (long, short) = (half * (rho + inverse) * radius, half * (rho - inverse) * radius);
            let mut largest = 0.0_f64;
            for &(from, to, height) in rectangles {
                let end = |fraction| centre + Interval::<f64>::constant(fraction) * long;
                let height = short * Interval::constant(height);
                // The upper half tells all: f of the conjugate is the conjugate ("Rectangles").
                let rectangle = Complex::new(end(from).hull(end(to)), Interval::between(0.0, height.upper()));
                largest = largest.max(f.evaluate(rectangle).bound());
                *evaluations += 1;
                // Not analytic, or without bound: larger ellipses are not, either.
                if largest.is_infinite() {
                    break;
                }
            }
            largest
        };
        // The outer rectangles of the smallest ellipse tell first.
        if self.none && largest(ELLIPSES[ELLIPSES.len() - 1], &RECTANGLES[..2]).is_infinite() {
            return None;
        }
        // From one larger than the last that fitted: panels on the way out of a singular point grow.
        for (index, &ellipse) in ELLIPSES.iter().enumerate().skip(self.last.saturating_sub(1)) {
            let bound = largest(ellipse, &RECTANGLES);
            if bound.is_finite()
                && let Some(choice) = rule(ellipse, bound, radius, allowed)
            {
                self.last = index;
                self.none = false;
                return Some(choice);
            }
        }
        self.none = true;
        None
    }
}

/// Returns the shortest rule for an integrand that is at most `bound` on an ellipse.
fn rule(ellipse: f64, bound: f64, radius: Interval<f64>, allowed: f64) -> Option<Choice> {
    let inverse = Interval::constant(1.0) / Interval::point(ellipse);
    let square = inverse * inverse;
    let (one, ratio) = (Interval::constant(1.0), square * square);
    // (64/15) G r^-2n / (1 - r^-2), times the half width: theorem (remainder).
    let scale = Interval::constant(64.0) / Interval::constant(15.0) * radius / (one - square);
    // n = 2: r^-4.
    let mut remainder = scale * Interval::point(bound) * ratio;
    let mut nodes = 2;
    for rule in RULES {
        // Two nodes more, r^-4 less.
        while nodes < 2 * rule.len() {
            remainder = remainder * ratio;
            nodes += 2;
        }
        if remainder.upper() <= allowed {
            return Some(Choice { rule, remainder: remainder.upper() });
        }
    }
    None
}

/// Encloses the integral between `a` and `b`.
pub(super) fn integrate(
    f: &impl Integrand,
    a: f64,
    b: f64,
    choice: &Choice,
    evaluations: &mut u64,
) -> Interval<Wide> {
    type Value = Interval<Wide>;
    let half = Value::constant(0.5);
    let (a, b) = (Value::constant(a), Value::constant(b));
    // In 128 bits: lemma (128 bits) gives the width of the sum.
    let (centre, radius) = (half * (a + b), half * (b - a));
    let mut sum = Value::constant(0.0);
    for &(node, weight) in choice.rule {
        // Scale 127: node and weight lie in a unit above the table's integers.
        let offset = radius * floored(node);
        // Nodes come in pairs of one weight.
        let pair = f.evaluate(centre + offset) + f.evaluate(centre - offset);
        sum = sum + floored(weight) * pair;
    }
    let remainder = Value::constant(choice.remainder);
    // Two for each positive node.
    *evaluations += 2 * choice.rule.len() as u64;
    // The error term: ± the remainder.
    radius * sum + (-remainder).hull(remainder)
}

/// Encloses a number of which `value` is the floor, scale 127.
pub(super) fn floored(value: u128) -> Interval<Wide> {
    Interval::between(Wide::from_integer(value, -127), Wide::from_integer(value + 1, -127))
}
