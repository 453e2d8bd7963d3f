//! Adaptive Gauss-Kronrod quadrature: halve the worst panel until the claimed error is within the tolerance.
//!
//! What the error claims and why is derived in [`book::quadrature`](crate::book::quadrature).

mod compensated;
mod doubts;
mod grading;
mod integration;
mod panels;
mod rule;
mod stretch;
mod tables;
#[cfg(test)]
mod tests;

pub use grading::graded;
pub use rule::Rule;

use crate::error::Error;
use crate::estimate::Estimate;
#[cfg(doc)]
use crate::estimate::Status;
use crate::quadrature::Tolerance;
use crate::quadrature::tolerance::Finest;
use crate::real::Real;
use integration::Integration;
use stretch::Stretch;

/// Adaptive Gauss-Kronrod quadrature: the settings, and [`integrate`](Self::integrate).
///
/// `∫ f(x) dx` over a finite interval. A [`Rule`] is applied to the panels between break points; the panel with the
/// largest claimed error is halved, until the sum of the claims is at most `max(absolute, relative |value|)`.
///
/// **Error**: [`Estimate::error`] is an estimate, not a proof. It holds in every case of the battery (measured,
/// [`guarantees`](crate::book::guarantees)). It takes the values of the integrand to be within 2 ulp of exact, at
/// arguments within 2 ulp of those given. Kinks and jumps are seen wherever they are, also beside the ends of panels
/// (measured: 0 false claims of 20 000 places). No method that only evaluates can know of a peak that none of its nodes
/// meets: give break points where the integrand is known to change.
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

    /// Integrates `f` from `from` to `to`: the negative of the integral from `to` to `from`.
    ///
    /// **Error**: as [`GaussKronrod`] says. **Status**: [`Converged`](Status::Converged) within the tolerance, or
    /// [`AllZero`](Status::AllZero) if every value was 0;
    /// [`EvaluationLimit`](Status::EvaluationLimit) before that; [`RoundOff`](Status::RoundOff) where rounding is
    /// most of the claimed error and above the tolerance; [`Unresolved`](Status::Unresolved) where a panel that
    /// floats are too coarse to halve is, or one of which a half met infinite values; an infinite error there means that
    /// halving did not help (a divergent integral); [`NotFinite`](Status::NotFinite), with the value NaN and an infinite
    /// error, where the integrand is NaN, or its integral over a panel between break points is not finite.
    ///
    /// Special case: 0, without an evaluation, if `from == to`.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if an end is not finite, or a setting not as its function says; also if both tolerances
    /// are 0. An infinite interval needs a substitution that knows the scale of the integrand, such as `x = s t / (1
    /// - t)`.
    ///
    /// ```
    /// use mean_information::quadrature::adaptive::GaussKronrod;
    /// let quarter = GaussKronrod::<f32>::new().integrate(|x| x * x * x, 0.0, 3.0)?;
    /// assert_eq!((quarter.value, quarter.evaluations), (20.25, 23));
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn integrate(&self, f: impl FnMut(T) -> T, from: T, to: T) -> Result<Estimate<T>, Error> {
        for (what, end) in [("lower end", from), ("upper end", to)] {
            if !end.is_finite() {
                return Err(Error::out_of_range(what, end.widen(), "finite numbers"));
            }
        }
        if from <= to {
            return self.integrate_between(f, &[from, to]);
        }
        let estimate = self.integrate_between(f, &[to, from])?;
        Ok(Estimate { value: -estimate.value, ..estimate })
    }

    /// Integrates `f` from the first of the points to the last, with panels that begin between them: give those
    /// where `f` or its derivatives jump or are infinite, and a few about each narrow peak ([`graded`]).
    ///
    /// **Error**: the claim of [`integrate`](Self::integrate), whose status and special case hold, too. Points may repeat.
    ///
    /// # Errors
    /// As for [`integrate`](Self::integrate), with fewer than two points among them; [`Error::Item`] if a point
    /// is not finite or below the one before it.
    ///
    /// ```
    /// use mean_information::quadrature::adaptive::GaussKronrod;
    /// let step = |x: f64| if x < 0.3 { 0.0 } else { x };
    /// let integral = GaussKronrod::new().integrate_between(step, &[0.0, 0.3, 2.0])?;
    /// assert_eq!((integral.value, integral.evaluations), (1.9549999999999998, 46));
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn integrate_between(&self, f: impl FnMut(T) -> T, points: &[T]) -> Result<Estimate<T>, Error> {
        for (index, &point) in points.iter().enumerate() {
            let refused =
                |allowed| Err(Error::Item { what: "break point", index, value: point.widen(), allowed });
            if !point.is_finite() {
                return refused("finite numbers");
            }
            if index > 0 && point < points[index - 1] {
                return refused("the point before it, or above");
            }
        }
        let (Some(&lower), Some(&upper)) = (points.first(), points.get(1..).and_then(<[T]>::last)) else {
            return Err(Error::out_of_range("number of break points", points.len() as f64, "2 or more"));
        };
        let stretches = points
            .windows(2)
            .map(|ends| Stretch { lower: ends[0], upper: ends[1] })
            .filter(|stretch| stretch.lower < stretch.upper);
        self.check(stretches.clone().count() as u64)?;
        Ok(Integration::new(self, f, Stretch { lower, upper }).run(stretches))
    }

    /// Refuses settings that cannot be met with the given number of first panels.
    fn check(&self, panels: u64) -> Result<(), Error> {
        self.tolerance.check(&Finest {
            relative: T::epsilon(),
            allowed: "0, or from the spacing of floats at 1 up to 1",
        })?;
        if self.limit < panels.max(1).saturating_mul(self.rule.evaluations()) {
            return Err(Error::out_of_range("evaluation limit", self.limit as f64, self.rule.least()));
        }
        Ok(())
    }
}
