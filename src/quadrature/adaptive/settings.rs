//! The settings of an adaptive integration.

use super::rule::Rule;
use crate::error::Error;
#[cfg(doc)]
use crate::estimate::Estimate;
use crate::quadrature::tolerance::{Finest, Tolerance};
use crate::real::Real;

/// Adaptive Gauss-Kronrod quadrature: the settings, and [`integrate`](Self::integrate).
///
/// `∫ f(x) dx` over a finite interval. A [`Rule`] is applied to the panels between break points; the panel with the
/// largest claimed error is halved, until the sum of the claims is at most `max(absolute, relative |value|)`.
///
/// **Error**: [`Estimate::error`] is an estimate, not a proof. It holds in every case of the battery (measured,
/// [`guarantees`](crate::book::guarantees)). It takes the values of the integrand to be within 2 ulp of exact, at
/// arguments within 2 ulp of those given. Kinks and jumps are seen wherever they are, also beside the ends of panels and
/// where they are small beside a smooth part (measured: 0 false claims of 20 000 places, twelve families); small singular
/// points inside can be claimed too low (up to 2.5 % of the places by `K15`). No method that only evaluates can know of a peak that
/// none of its nodes meets: give break points where the integrand is known to change.
///
/// ```
/// use mean_information::cell::entropy;
/// use mean_information::elementary::exp;
/// use mean_information::estimate::Status;
/// use mean_information::quadrature::adaptive::{GaussKronrod, Rule};
///
/// // What one reading lacks from 10 standard deviations in front of the obstacle up to it, in bits times σ.
/// let deficit = |t: f64| entropy(exp(-0.5 * t * t));
/// let integral = GaussKronrod::new().relative(1e-13).rule(Rule::K31).integrate(deficit, -10.0, 0.0)?;
/// assert_eq!(integral.status, Status::Converged);
/// assert!((integral.value - 1.6786248471532531).abs() <= integral.error);
/// assert!(integral.error < 1e-13 * integral.value);
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussKronrod<T> {
    pub(crate) rule: Rule,
    pub(crate) tolerance: Tolerance<T>,
    pub(crate) limit: u64,
}

impl<T: Real> Default for GaussKronrod<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real> GaussKronrod<T> {
    /// Creates the settings of the rule [`K21`](Rule::K21), three quarters of the digits (a relative tolerance of
    /// `2^-39` in `f64`, `2^-18` in `f32`, and none absolute), and at most 100 000 evaluations.
    pub fn new() -> Self {
        let digits = (3 * T::PRECISION / 4) as i32;
        Self {
            rule: Rule::K21,
            tolerance: Tolerance { absolute: T::zero(), relative: T::from_parts(1, -digits) },
            limit: 100_000,
        }
    }

    /// Sets the rule for each panel.
    #[must_use]
    pub fn rule(self, rule: Rule) -> Self {
        Self { rule, ..self }
    }

    /// Sets the tolerance relative to the value: 0 for none, or from the spacing of floats at 1 (`2^-52` in `f64`,
    /// `2^-23` in `f32`) up to 1.
    #[must_use]
    pub fn relative(self, relative: T) -> Self {
        Self { tolerance: Tolerance { relative, ..self.tolerance }, ..self }
    }

    /// Sets the absolute tolerance, in units of the integral: 0 for none, or any positive number.
    #[must_use]
    pub fn absolute(self, absolute: T) -> Self {
        Self { tolerance: Tolerance { absolute, ..self.tolerance }, ..self }
    }

    /// Sets the largest number of evaluations: at least one rule for every panel between break points.
    #[must_use]
    pub fn limit(self, limit: u64) -> Self {
        Self { limit, ..self }
    }

    /// Refuses settings that cannot be met with the given number of first panels.
    pub(super) fn check(&self, panels: u64) -> Result<(), Error> {
        self.tolerance.check(&Finest {
            relative: T::epsilon(),
            allowed: "0, or from the spacing of floats at 1 up to 1",
        })?;
        // The first panels are measured in any case.
        if self.limit < panels.max(1).saturating_mul(self.rule.evaluations()) {
            return Err(Error::out_of_range("evaluation limit", self.limit as f64, self.rule.least()));
        }
        Ok(())
    }
}
