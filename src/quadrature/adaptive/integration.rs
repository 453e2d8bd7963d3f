//! One integration: halve the panel with the largest claim until the claims are within the tolerance.

use super::GaussKronrod;
use super::panels::{Panel, Panels, Totals};
use super::rule::Reading;
use super::stretch::Stretch;
use crate::estimate::{Estimate, Status};
use crate::real::Real;

/// The state of an integration.
pub(super) struct Integration<'a, T, F> {
    settings: &'a GaussKronrod<T>,
    f: F,
    panels: Panels<T>,
    evaluations: u64,
    /// The panel with the largest claim of those that floats are too coarse to halve.
    unresolved: Option<Panel<T>>,
}

impl<'a, T: Real, F: FnMut(T) -> T> Integration<'a, T, F> {
    /// Creates an integration that has evaluated nothing.
    pub(super) fn new(settings: &'a GaussKronrod<T>, f: F) -> Self {
        Self { settings, f, panels: Panels::new(), evaluations: 0, unresolved: None }
    }

    /// Integrates over the stretches, which make up the whole.
    pub(super) fn run(
        mut self,
        stretches: impl Iterator<Item = Stretch<T>>,
        whole: Stretch<T>,
    ) -> Estimate<T> {
        for stretch in stretches {
            match self.measured(stretch, None) {
                Ok(panel) => self.panels.push(panel),
                Err(status) => return self.ended(T::zero(), T::zero(), status),
            }
        }
        loop {
            let Some(totals) = self.panels.totals() else {
                return self.ended(T::zero(), T::zero(), Status::Converged);
            };
            let value = totals.value();
            if !value.is_finite() {
                return self.ended(value, value, not_finite(whole));
            }
            let error = totals.reducible + totals.fixed;
            let tolerance = self.settings.tolerance.of(value.abs());
            if error <= tolerance {
                return self.ended(value, error, Status::Converged);
            }
            // More halving would spend evaluations on the smaller half of the claim.
            if totals.fixed > tolerance && totals.reducible <= totals.fixed {
                return self.ended(value, error, self.out_of_reach(totals.fixed));
            }
            if let Err(status) = self.halve(&totals) {
                return self.ended(value, error, status);
            }
        }
    }

    /// Halves the worst panel, or settles it; an error is the reason why it cannot go on.
    fn halve(&mut self, totals: &Totals<T>) -> Result<(), Status<T>> {
        let rule = self.settings.rule;
        let worst = self.panels.worst(totals);
        let [left, right] = worst.stretch.halves();
        if !(left.has_room_for(rule.outermost()) && right.has_room_for(rule.outermost())) {
            // Floats end here: the claim stays as it is, and halving will not come back.
            let settled = Panel { reducible: T::zero(), fixed: worst.fixed + worst.reducible, ..worst };
            if self.unresolved.is_none_or(|panel| panel.fixed < settled.fixed) {
                self.unresolved = Some(settled);
            }
            self.panels.replace_worst(totals, settled);
            return Ok(());
        }
        if self.settings.limit - self.evaluations < 2 * rule.evaluations() {
            return Err(Status::EvaluationLimit);
        }
        let halves = [self.measured(left, Some(&worst))?, self.measured(right, Some(&worst))?];
        let [left, right] = compared(&worst, halves, totals.fixed);
        self.panels.replace_worst(totals, left);
        self.panels.push(right);
        Ok(())
    }

    /// Measures the panel on a stretch, given the panel that it is a half of.
    fn measured(&mut self, stretch: Stretch<T>, parent: Option<&Panel<T>>) -> Result<Panel<T>, Status<T>> {
        let rule = self.settings.rule;
        self.evaluations += rule.evaluations();
        let panel = claimed(&rule.apply(&mut self.f, stretch), stretch, parent);
        if panel.value.is_finite() { Ok(panel) } else { Err(not_finite(stretch)) }
    }

    /// Returns the reason why halving does not help, given the part of the error that it does not reduce.
    fn out_of_reach(&self, fixed: T) -> Status<T> {
        match self.unresolved {
            Some(Panel { stretch: Stretch { lower, upper }, fixed: most, .. }) if most + most >= fixed => {
                Status::Unresolved { lower, upper }
            }
            _ => Status::RoundOff,
        }
    }

    /// Returns the estimate at the end; one that is not finite has the value NaN and an infinite error.
    fn ended(&self, value: T, error: T, status: Status<T>) -> Estimate<T> {
        let [value, error] = match status {
            Status::NotFinite { .. } => [T::nan(), T::infinity()],
            _ => [value, error],
        };
        Estimate { value, error, status, evaluations: self.evaluations }
    }
}

/// Returns the status of an integrand that is not finite on a stretch.
fn not_finite<T>(stretch: Stretch<T>) -> Status<T> {
    Status::NotFinite { lower: stretch.lower, upper: stretch.upper }
}

/// Claims an error on a stretch: the noise, and the series `d + 2 d r + 3 d r^2 + ... = d / (1 - r)^2` of the
/// difference `d`, were each further halving to reduce it by `r`, and could each err as all before it together.
///
/// `r` is the slowest of three: of the bands, of `d` to that of the panel before it was halved, and of the halving
/// before that. Where they do not fall nothing is known, and the claim is infinite: so it is in a first panel whose
/// bands fall by less than half, as those of any peak at its end do.
fn claimed<T: Real>(reading: &Reading<T>, stretch: Stretch<T>, parent: Option<&Panel<T>>) -> Panel<T> {
    let Reading { value, difference, decay, noise } = *reading;
    let ratio = match parent {
        Some(parent) => decay.max(difference / parent.difference),
        None if decay < T::HALF => decay,
        None => T::one(),
    };
    let slowest = parent.map_or(ratio, |parent| ratio.max(parent.ratio));
    let (reducible, fixed) = if difference <= noise {
        // Nothing to be gained by halving ("Rounding").
        (T::zero(), noise + difference)
    } else if slowest < T::one() {
        // Σ k d r^(k - 1): every further halving, each erring as all before it ("Slow convergence").
        let fall = T::one() - slowest;
        (difference / (fall * fall), noise)
    } else {
        (T::infinity(), noise)
    };
    Panel { stretch, value, difference, ratio, alike: false, reducible, fixed }
}

/// The factor within which the difference of a half counts as of the size of the whole's.
const ALIKE: u64 = 8;

/// Compares the halves of a panel with it. A smooth integrand reduces the difference in both, a singular point in
/// one. If it is of the same size in both, and was so when the whole was a half, and is in the lower half of the
/// digits of the integral (whose last ones are `fixed`), then the integrand is less smooth than its floats: it is
/// noise, which no halving reduces.
pub(super) fn compared<T: Real>(whole: &Panel<T>, halves: [Panel<T>; 2], fixed: T) -> [Panel<T>; 2] {
    let times = T::from_parts(ALIKE, 0);
    let alike = halves.iter().all(|half| times * half.difference > whole.difference);
    let half_the_digits = T::from_parts(1, T::PRECISION as i32 / 2);
    if alike && whole.alike && whole.difference < half_the_digits * fixed {
        halves.map(|half| Panel { reducible: T::zero(), fixed: half.fixed + times * half.difference, ..half })
    } else {
        halves.map(|half| Panel { alike, ..half })
    }
}
