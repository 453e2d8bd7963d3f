//! A survey of an integrand by its ranges alone: about how large the integral is, where points do not tell.
//!
//! ```text
//! sum of |I| min |f(I)|  <=  int |f|  <=  sum of |I| max |f(I)|
//! ```
//!
//! over panels `I`, of which the one that leaves most open is halved. About a peak they shrink in proportion to their
//! distance from it, so that their number grows like the logarithm of the width (chapter
//! [`integration`](crate::book::integration), "Panels").

use alloc::vec;
use alloc::vec::Vec;

use super::state::{NARROWEST, Search};
use crate::interval::Interval;
use crate::quadrature::Tolerance;
use crate::scalar::Integrand;

/// A sum over points this much below the bound by ranges has perhaps cancelled: the tolerance begins with this share of
/// the bound.
const DOUBT: f64 = 1.0 / (1_u64 << 20) as f64;
/// A sum over points this much below the bound by ranges has perhaps seen nothing: the survey begins.
const BLIND: f64 = DOUBT * DOUBT;
/// The survey ends when its bounds on `int |f|` are within this factor.
const APART: f64 = 4.0;
/// The survey takes at most this share of the evaluations.
const SHARE: u64 = 16;
/// The survey takes at most this many evaluations.
const MOST: u64 = 1024;

/// A panel, and the range of the integrand over it.
struct Panel {
    from: f64,
    to: f64,
    range: Interval<f64>,
}

impl Panel {
    fn new(search: &mut Search<'_, impl Integrand>, from: f64, to: f64) -> Self {
        Self { from, to, range: search.range(from, to) }
    }

    /// Returns the length times a bound on the range: a float, as nothing is proved by it.
    fn times(&self, bound: f64) -> f64 {
        // Halves of the ends cannot overflow; 0 times no bound is 0.
        if bound == 0.0 { 0.0 } else { (0.5 * self.to - 0.5 * self.from) * bound * 2.0 }
    }

    /// Returns what the panel leaves open.
    fn open(&self) -> f64 {
        self.times(self.range.magnitude() - self.range.mignitude())
    }
}

/// Estimates the magnitude of an integral, of which a sum over points is given: that sum, if the ranges allow it.
pub(super) fn magnitude(
    search: &mut Search<'_, impl Integrand>,
    by_points: f64,
    tolerance: Tolerance<f64>,
) -> f64 {
    // The points have seen something, or all that ranges allow is within the absolute tolerance.
    let is_enough = |most| by_points >= BLIND * most || tolerance.relative * most <= tolerance.absolute;
    let panels = crowded(search, is_enough);
    // Of one sign on most of its panels the integral has that size; or it cancels, and some of the bound is left.
    let [lower, upper] = [Interval::lower, Interval::upper].map(|bound| total(&panels, bound));
    let most = total(&panels, Interval::magnitude);
    // Without a bound nothing is known: every panel that has one will do, to find those that have none.
    if most.is_finite() { by_points.max(lower).max(-upper).max(DOUBT * most) } else { f64::MAX }
}

/// Returns break points that crowd where ranges leave most of `int |f|` open, the ends among them, in ascending order.
pub(super) fn break_points(search: &mut Search<'_, impl Integrand>) -> Vec<f64> {
    let mut points: Vec<f64> = crowded(search, |_| false).iter().map(|panel| panel.from).collect();
    points.push(search.to);
    // Panels stand in the order in which they were made.
    points.sort_unstable_by(f64::total_cmp);
    points
}

/// Halves the panels that leave most open, until the bounds on `int |f|` are near each other, or its upper bound is
/// enough.
fn crowded(search: &mut Search<'_, impl Integrand>, is_enough: impl Fn(f64) -> bool) -> Vec<Panel> {
    let (from, to) = (search.from, search.to);
    let mut panels = vec![Panel::new(search, from, to)];
    let last = search.evaluations + (search.limit.saturating_sub(search.evaluations) / SHARE).min(MOST);
    loop {
        let most = total(&panels, Interval::magnitude);
        // Both bounds are on ∫ |f|, so that nothing cancels.
        let is_known = APART * total(&panels, Interval::mignitude) >= most;
        if is_known || is_enough(most) || search.evaluations + 2 > last || !halve_worst(search, &mut panels) {
            return panels;
        }
    }
}

/// Adds up the lengths times a bound on the ranges.
fn total(panels: &[Panel], bound: impl Fn(&Interval<f64>) -> f64) -> f64 {
    panels.iter().map(|panel| panel.times(bound(&panel.range))).sum()
}

/// Halves the panel that leaves most open; false if floats end there.
fn halve_worst(search: &mut Search<'_, impl Integrand>, panels: &mut Vec<Panel>) -> bool {
    let worst = (0..panels.len()).max_by(|&i, &j| {
        let [first, second] = [i, j].map(|k| (panels[k].open(), panels[k].to - panels[k].from));
        // Of panels without bound the longest.
        first.0.total_cmp(&second.0).then(first.1.total_cmp(&second.1))
    });
    let Some(worst) = worst else { return false };
    let Panel { from, to, .. } = panels[worst];
    // Halves first: the sum of the ends may overflow.
    let middle = 0.5 * from + 0.5 * to;
    if !(from < middle && middle < to && to - from > NARROWEST * search.to - NARROWEST * search.from) {
        return false;
    }
    panels[worst] = Panel::new(search, from, middle);
    panels.push(Panel::new(search, middle, to));
    true
}
