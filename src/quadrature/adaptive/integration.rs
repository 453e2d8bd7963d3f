//! One integration: halve the panel with the largest claim until the claims are within the tolerance.

use super::panel::{Panel, SIDES};
use super::panels::{Panels, Totals};
use super::rule::RuleValue;
use super::settings::GaussKronrod;
use super::stretch::Stretch;
use crate::estimate::{Estimate, Status};
use crate::real::Real;

/// The state of an integration.
pub(super) struct Integration<'a, T, F> {
    settings: &'a GaussKronrod<T>,
    f: F,
    /// The stretch from the first point to the last.
    whole: Stretch<T>,
    panels: Panels<T>,
    /// The places of the first and of the last panel.
    outer: [usize; 2],
    evaluations: u64,
    /// True if every value was 0.
    all_zero: bool,
    /// The panel with the largest claim of those that cannot be halved.
    unresolved: Option<Panel<T>>,
}

impl<'a, T: Real, F: FnMut(T) -> T> Integration<'a, T, F> {
    /// Creates an integration that has evaluated nothing.
    pub(super) fn new(settings: &'a GaussKronrod<T>, f: F, whole: Stretch<T>) -> Self {
        let panels = Panels::new();
        Self { settings, f, whole, panels, outer: [0, 0], evaluations: 0, all_zero: true, unresolved: None }
    }

    /// Integrates over the stretches, which make up the whole.
    pub(super) fn run(mut self, stretches: impl Iterator<Item = Stretch<T>>) -> Estimate<T> {
        let mut before = None;
        for stretch in stretches {
            let panel = self.measured(stretch, None);
            // No panel stands above this one whose value could be kept.
            if !panel.value.is_finite() {
                return self.ended(T::zero(), T::zero(), not_finite(stretch));
            }
            let place = self.panels.push(panel, before);
            self.panels.doubt(place, self.whole, self.settings.rule);
            (before, self.outer[1]) = (Some(place), place);
        }
        loop {
            // No stretch: all points are the same, and the integral is 0.
            let Some(totals) = self.panels.totals() else {
                return self.ended(T::zero(), T::zero(), Status::Converged);
            };
            let value = totals.value();
            if !value.is_finite() {
                return self.ended(value, value, not_finite(self.whole));
            }
            // The sum of all claims: they may all err to one side.
            let error = totals.reducible + totals.fixed;
            let tolerance = self.settings.tolerance.of(value.abs());
            let end = if error <= tolerance {
                Some(if self.all_zero { Status::AllZero } else { Status::Converged })
            } else if totals.fixed > tolerance && totals.reducible <= totals.fixed {
                // More halving would spend evaluations on the smaller half of the claim.
                Some(self.out_of_reach(totals.fixed))
            } else {
                None
            };
            let step = match (end, self.next_outer_gap()) {
                // No panel stands beside the outer ends: a value tells what their gaps hide.
                (Some(_), Some((place, side))) => self.look(place, side),
                (Some(status), None) => Err(status),
                (None, _) => self.reduce(&totals),
            };
            if let Err(status) = step {
                return self.ended(value, error, status);
            }
        }
    }

    /// Returns an outer end whose gap nobody has looked into, of a panel that seems smooth.
    fn next_outer_gap(&self) -> Option<(usize, usize)> {
        SIDES.map(|side| (self.outer[side], side)).into_iter().find(|&(place, side)| {
            let panel = self.panels.at(place);
            panel.witnesses[side].is_none() && !panel.is_settled
        })
    }

    /// Evaluates next to an end of a panel.
    fn look(&mut self, place: usize, side: usize) -> Result<(), Status<T>> {
        if self.evaluations == self.settings.limit {
            return Err(Status::EvaluationLimit);
        }
        let panel = *self.panels.at(place);
        // Outside of the nodes: the value stays, only the doubt changes ("What the ends hide").
        let x = panel.stretch.witness(side, self.whole);
        let value = (self.f)(x);
        self.evaluations += 1;
        self.all_zero &= value.is_zero();
        let mut witnesses = panel.witnesses;
        witnesses[side] = Some((x, value));
        self.panels.replace(place, Panel { witnesses, ..panel });
        self.panels.doubt(place, self.whole, self.settings.rule);
        Ok(())
    }

    /// Reduces the claim on the worst panel; an error is the reason why it cannot go on.
    fn reduce(&mut self, totals: &Totals<T>) -> Result<(), Status<T>> {
        let (rule, place) = (self.settings.rule, totals.worst);
        let worst = *self.panels.at(place);
        // What a gap hides is dealt with before what the nodes see.
        let doubtful = worst.doubtful_side();
        if let Some(side) = doubtful
            && worst.witnesses[side].is_none()
        {
            // The panel beside seems to go on elsewhere: a jump of the integrand at the end itself, or in the gap?
            return self.look(place, side);
        }
        let [left, right] = match doubtful {
            // What the gap hides is seen by the nodes of a panel that ends at the outermost one.
            Some(side) => worst.stretch.cut_at(worst.stretch.pair(rule.outermost())[side]),
            None => worst.stretch.halves(),
        };
        if !(left.has_room_for(rule.outermost()) && right.has_room_for(rule.outermost())) {
            self.settle(place);
            return Ok(());
        }
        // Both halves or none: a panel is never replaced by a part of it.
        if self.settings.limit - self.evaluations < 2 * rule.evaluations() {
            return Err(Status::EvaluationLimit);
        }
        let halves = [self.measured(left, Some(&worst)), self.measured(right, Some(&worst))];
        for half in &halves {
            if half.value.is_nan() {
                return Err(not_finite(half.stretch));
            }
            if half.value.is_infinite() {
                // The whole had a value, and a claim.
                self.settle(place);
                return Ok(());
            }
        }
        let [mut left, mut right] =
            if doubtful.is_some() { halves } else { compared(&worst, halves, totals.fixed) };
        // Outer ends stay where they are, and so do their witnesses; the new end between has none.
        (left.witnesses[0], right.witnesses[1]) = (worst.witnesses[0], worst.witnesses[1]);
        self.panels.replace(place, left);
        let other = self.panels.push(right, Some(place));
        if self.outer[1] == place {
            self.outer[1] = other;
        }
        self.panels.doubt(place, self.whole, rule);
        self.panels.doubt(other, self.whole, rule);
        Ok(())
    }

    /// Settles a panel: its claim stays as it is, and halving will not come back.
    fn settle(&mut self, place: usize) {
        let panel = *self.panels.at(place);
        // Nothing will reduce it any more.
        let fixed = panel.fixed + panel.reducible;
        let settled = Panel { reducible: T::zero(), fixed, is_settled: true, ..panel };
        let claim = |panel: &Panel<T>| panel.claim()[1];
        if self.unresolved.is_none_or(|panel| claim(&panel) < claim(&settled)) {
            self.unresolved = Some(settled);
        }
        self.panels.replace(place, settled);
    }

    /// Measures the panel on a stretch, given the panel that it is a half of.
    fn measured(&mut self, stretch: Stretch<T>, parent: Option<&Panel<T>>) -> Panel<T> {
        let rule = self.settings.rule;
        self.evaluations += rule.evaluations();
        // Of all the values: a peak between nodes leaves them 0 ("What cannot be known").
        let reading = rule.apply(&mut self.f, stretch);
        self.all_zero &= reading.is_zero;
        claimed(&reading, stretch, parent)
    }

    /// Returns the reason why halving does not help, given the part of the error that it does not reduce.
    fn out_of_reach(&self, fixed: T) -> Status<T> {
        // Half of what is left or more is one panel's: that is the reason. Else roundings everywhere are.
        match self.unresolved {
            Some(panel) if panel.claim()[1] + panel.claim()[1] >= fixed => {
                Status::Unresolved { lower: panel.stretch.lower, upper: panel.stretch.upper }
            }
            _ => Status::RoundOff,
        }
    }

    /// Returns the estimate at the end; one that is not finite has the value NaN and an infinite error.
    fn ended(&self, value: T, error: T, status: Status<T>) -> Estimate<T> {
        let (value, error, status) = match status {
            Status::NotFinite { .. } => (T::nan(), T::infinity(), status),
            // Values next to the ends alone, over an interval of no float between.
            Status::Converged if error.is_zero() && !self.all_zero => {
                (value, T::from_parts(1, T::MIN_EXPONENT), Status::RoundOff)
            }
            _ => (value, error, status),
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
fn claimed<T: Real>(reading: &RuleValue<T>, stretch: Stretch<T>, parent: Option<&Panel<T>>) -> Panel<T> {
    let RuleValue { value, difference, decay, noise, spread, ends, .. } = *reading;
    // The slowest of the bands' fall and of the last two halvings' ("Slow convergence").
    let ratio = match parent {
        Some(parent) => decay.max(difference / parent.difference),
        // A first panel has no history: its bands must fall to less than half.
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
    Panel {
        stretch,
        value,
        difference,
        ratio,
        alike: false,
        decay,
        noise,
        spread,
        reducible,
        fixed,
        is_settled: false,
        ends,
        witnesses: [None; 2],
        doubts: [T::zero(); 2],
        beside: [None; 2],
    }
}

/// The factor within which the difference of a half counts as of the size of the whole's.
const ALIKE: u64 = 8;

/// Compares the halves of a panel with it. A smooth integrand reduces the difference in both, a singular point in
/// one. If it is of the same size in both, and was so when the whole was a half, and is in the lower half of the
/// digits of the integral (whose last ones are `fixed`), then the integrand is less smooth than its floats: it is
/// noise, which no halving reduces.
pub(super) fn compared<T: Real>(whole: &Panel<T>, halves: [Panel<T>; 2], fixed: T) -> [Panel<T>; 2] {
    let times = T::from_parts(ALIKE, 0);
    // A smooth integrand would have reduced both, a singular point one.
    let alike = halves.iter().all(|half| times * half.difference > whole.difference);
    // Noise is searched in the lower half of the digits only: above it a kink may look alike.
    let half_the_digits = T::from_parts(1, T::PRECISION as i32 / 2);
    if alike && whole.alike && whole.difference < half_the_digits * fixed {
        halves.map(|half| Panel { reducible: T::zero(), fixed: half.fixed + times * half.difference, ..half })
    } else {
        halves.map(|half| Panel { alike, ..half })
    }
}
