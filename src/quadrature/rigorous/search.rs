//! The search for panels: from the left, each panel is enclosed by a rule, or by the range of the integrand, or cut
//! in half.

use alloc::vec;

use super::gauss::{self, Chooser};
use super::state::{Integral, NARROWEST, Search};
use super::survey;
use crate::estimate::Status;
use crate::interval::{Endpoint, Interval, Toward, Wide};
use crate::quadrature::Tolerance;
use crate::scalar::{Integrand, Scalar};

/// The sum over panels.
struct Sum {
    value: Interval<Wide>,
    /// About the integral of the magnitude: what roundings are relative to.
    size: f64,
    status: Status<f64>,
}

/// The fate of a panel.
enum Fate {
    /// Enclosed; the status tells why no narrower.
    Enclosed { value: Interval<Wide>, status: Status<f64> },
    /// Cut at this point: its halves are next.
    Cut(f64),
    /// Failed: nothing is known of its integral.
    Failed(Status<f64>),
}

/// The tolerance grows by this factor when evaluations run out.
const LAXER: f64 = 4096.0;
/// A bound on the evaluations of a panel: all rectangles, the longest rule, and a few ranges.
const MOST_EVALUATIONS: u64 = 72;
/// A panel may take this share of the width that is left.
const SHARE: f64 = 1.0 / 32.0;
/// The finest width of sums in 128 bits relative to the integral of the magnitude, above their roundings: lemma (128
/// bits).
const ROUND_OFF: f64 = 1.0 / (1_u128 << 66) as f64;
impl<F: Integrand> Search<'_, F> {
    /// Encloses the integral, within the tolerance if that can be.
    pub(super) fn run(&mut self, tolerance: Tolerance<f64>) -> Integral {
        let wanted = |magnitude: f64| tolerance.of(magnitude);
        // A quarter: rounding to the result's format, and the shares of later panels, take the rest.
        let mut target = wanted(self.estimate(tolerance)).min(f64::MAX) / 4.0;
        let mut value = Interval::WHOLE;
        loop {
            // Half of the evaluations that are left: if they are too few, there are some for a laxer tolerance.
            let limit = self.evaluations + self.limit.saturating_sub(self.evaluations) / 2;
            let sum = self.pass(target, limit);
            // Each contains the integral: theorem (enclosure).
            value = value.intersection(sum.value);
            let wanted = wanted(smallest_magnitude(value));
            let status = match sum.status {
                _ if width(value) <= wanted => Status::Converged,
                // Each panel is as narrow as was asked for, their sum is not: roundings.
                Status::Converged => Status::RoundOff,
                other => other,
            };
            // Too wide, though every panel is as narrow as was asked for: ask for more, if there is more.
            let finer = wanted.max(ROUND_OFF * sum.size) / 4.0;
            // Any target is sound: it decides the work only ("Panels").
            target = match status {
                Status::RoundOff if finer < target / 2.0 => finer,
                Status::EvaluationLimit if self.evaluations + MOST_EVALUATIONS < self.limit => target * LAXER,
                _ => return Integral { value, status, evaluations: self.evaluations },
            };
        }
    }

    /// Estimates the magnitude of the integral: a tolerance to begin with.
    pub(super) fn estimate(&mut self, tolerance: Tolerance<f64>) -> f64 {
        let (centre, radius) = (0.5 * self.from + 0.5 * self.to, 0.5 * self.to - 0.5 * self.from);
        let mut sum = 0.0;
        for (node, weight) in gauss::floats() {
            for x in [centre - radius * node, centre + radius * node] {
                let value: f64 = self.f.evaluate(x);
                // A node may hit a singular point: an estimate does without.
                sum += if value.is_finite() { weight * value } else { 0.0 };
                self.evaluations += 1;
            }
        }
        survey::magnitude(self, radius * sum.abs(), tolerance)
    }

    /// Adds up the panels, with a width of about `target`, from evaluations up to a limit.
    fn pass(&mut self, target: f64, limit: u64) -> Sum {
        let mut left = target;
        let mut sum = Sum { value: Interval::constant(0.0), size: 0.0, status: Status::Converged };
        let mut chooser = Chooser::new();
        let mut panels = vec![(self.from, self.to)];
        while let Some((a, b)) = panels.pop() {
            // Two ranges are kept for each panel that waits: all of them are enclosed.
            let limited = self.evaluations + 2 * panels.len() as u64 + MOST_EVALUATIONS > limit;
            match self.panel(&mut chooser, a, b, left * SHARE, limited) {
                Fate::Enclosed { value, status } => {
                    // What a panel does not use is left to those after it.
                    left -= width(value).min(left * SHARE);
                    sum.value = sum.value + value;
                    // Roundings are relative to this, also where the sum cancels: lemma (128 bits).
                    sum.size += value.magnitude().to_real::<f64>(Toward::Up);
                    if status != Status::Converged {
                        sum.status = status;
                    }
                }
                Fate::Cut(middle) => panels.extend([(middle, b), (a, middle)]),
                Fate::Failed(status) => return Sum { value: Interval::WHOLE, size: f64::INFINITY, status },
            }
        }
        sum
    }

    /// Decides what to do with the panel from `a` to `b`, which may add `allowed` to the width.
    fn panel(&mut self, chooser: &mut Chooser, a: f64, b: f64, allowed: f64, limited: bool) -> Fate {
        // 1. The width times the range: "Panels".
        let length = Interval::constant(b) - Interval::constant(a);
        let range: Interval<f64> = self.range(a, b);
        let undefined = Fate::Failed(Status::NotFinite { lower: a, upper: b });
        if range.is_empty() {
            return undefined;
        }
        let strip = length * range.into();
        if width(strip) <= allowed || limited {
            if self.is_undefined_within(a, b) {
                return undefined;
            }
            let status = if width(strip) <= allowed { Status::Converged } else { Status::EvaluationLimit };
            return Fate::Enclosed { value: strip, status };
        }
        // 2. A rule, half of whose share the remainder may take: theorem (remainder).
        if let Some(choice) = chooser.choose(self.f, a, b, allowed / 2.0, &mut self.evaluations) {
            let value = gauss::integrate(self.f, a, b, &choice, &mut self.evaluations);
            if value.is_empty() {
                return undefined;
            }
            return Fate::Enclosed { value, status: Status::Converged };
        }
        // 3. Two halves, unless roundings at one point make the range: lemma (128 bits).
        let middle = 0.5 * a + 0.5 * b;
        let can_be_cut = a < middle && middle < b && b - a > NARROWEST * self.to - NARROWEST * self.from;
        if can_be_cut && !self.is_noise(range, middle) {
            return Fate::Cut(middle);
        }
        // In floats it is noise: once more in 128 bits.
        let range: Interval<Wide> = self.range(a, b);
        // Both contain the integral.
        let strip = strip.intersection(length * range);
        if can_be_cut && width(strip) > allowed && !self.is_noise(range, middle) {
            return Fate::Cut(middle);
        }
        let unresolved = Status::Unresolved { lower: a, upper: b };
        // An integrand without bound cannot be enclosed by ranges.
        if !strip.is_bounded() {
            return Fate::Failed(unresolved);
        }
        if self.is_undefined_within(a, b) {
            return undefined;
        }
        Fate::Enclosed { value: strip, status: if can_be_cut { Status::Converged } else { unresolved } }
    }

    /// Encloses the values of the integrand between `a` and `b`.
    pub(super) fn range<T: Endpoint>(&mut self, a: f64, b: f64) -> Interval<T> {
        self.evaluations += 1;
        self.f.evaluate(Interval::constant(a).hull(Interval::constant(b)))
    }

    /// Returns true if the integrand is nowhere defined on the middle half of a panel: its range, that of the part where
    /// it is defined, may be that of an end alone.
    fn is_undefined_within(&mut self, a: f64, b: f64) -> bool {
        let [from, to] = [0.75 * a + 0.25 * b, 0.25 * a + 0.75 * b];
        // Between neighbouring floats there is no half.
        a < from && from < to && to < b && self.range::<f64>(from, to).is_empty()
    }

    /// Returns true if roundings at one point make half of a range: then cutting does not help.
    fn is_noise<T: Endpoint>(&mut self, range: Interval<T>, x: f64) -> bool {
        if !range.is_bounded() {
            return false;
        }
        let point: Interval<T> = self.range(x, x);
        // The width at one point is roundings alone: lemma (128 bits).
        let width = point.width();
        width.add(width, Toward::Up) >= range.width()
    }
}

/// Returns the width, rounded up.
fn width(x: Interval<Wide>) -> f64 {
    x.width().to_real(Toward::Up)
}

/// Returns the smallest magnitude, rounded down.
fn smallest_magnitude(x: Interval<Wide>) -> f64 {
    // 0 where the enclosure leaves the sign open: only an absolute tolerance can be met.
    let [lower, upper] = [x.lower(), -x.upper()].map(|end| end.to_real::<f64>(Toward::Down));
    lower.max(upper).max(0.0)
}
