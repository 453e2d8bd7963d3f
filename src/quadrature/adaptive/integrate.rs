//! Integrals over an interval, or between break points.

use super::integration::Integration;
use super::settings::GaussKronrod;
use super::stretch::Stretch;
use crate::error::Error;
use crate::estimate::Estimate;
#[cfg(doc)]
use crate::estimate::Status;
use crate::real::Real;

#[cfg(doc)]
use super::grading::graded;

impl<T: Real> GaussKronrod<T> {
    /// Integrates `f` from `from` to `to`: the negative of the integral from `to` to `from`.
    ///
    /// **Error**: as [`GaussKronrod`] says; derived in [`quadrature`](crate::book::quadrature). **Status**: [`Converged`](Status::Converged) within the tolerance, or
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
        // Panels ascend; backwards the integral is the negative.
        if from <= to {
            return self.integrate_between(f, &[from, to]);
        }
        let estimate = self.integrate_between(f, &[to, from])?;
        Ok(Estimate { value: -estimate.value, ..estimate })
    }

    /// Integrates `f` from the first of the points to the last, with panels that begin between them: give those
    /// where `f` or its derivatives jump or are infinite, and a few about each narrow peak ([`graded`]).
    ///
    /// **Error**: the claim of [`integrate`](Self::integrate), whose status and special case hold, too; derived in
    /// [`quadrature`](crate::book::quadrature). Points may repeat.
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
            // Points that repeat leave nothing between them.
            .filter(|stretch| stretch.lower < stretch.upper);
        // Every stretch is measured once, or there would be no value to claim an error of.
        self.check(stretches.clone().count() as u64)?;
        Ok(Integration::new(self, f, Stretch { lower, upper }).run(stretches))
    }
}
