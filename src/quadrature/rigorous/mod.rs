//! Rigorous integration: [`Rigorous`], whose results contain the integral, always.
//!
//! ```text
//! int_a^b f  in  sum of w_i f(x_i) + [-R, R],    |R| <= (64/15) (b - a)/2 G r^-2n / (1 - r^-2),    |f| <= G
//! ```
//!
//! on panels with an ellipse about them on which `f` is analytic, and `int_a^b f in (b - a) f([a, b])` on tiny ones
//! where it is not. The chapter [`integration`](crate::book::integration) derives the bound.

mod gauss;
mod nodes;
mod search;
mod survey;

use alloc::vec::Vec;

use crate::error::Error;
use crate::estimate::{Enclosure, Status};
use crate::interval::{Interval, Toward, Wide};
use crate::quadrature::Tolerance;
use crate::quadrature::tolerance::Finest;
use crate::real::Real;
use crate::scalar::{Integrand, Scalar};
use search::Search;

/// Rigorous integration: the wanted width and the work it may take, and [`integrate`](Self::integrate).
///
/// `∫ f(x) dx` over a finite interval, between two floats. The result contains the integral whatever is asked for; a
/// tolerance only says when to stop. The width is first that of the enclosure as computed, in 128 bits; rounding to `T`
/// adds at most 1 ulp at each end.
///
/// ```
/// use mean_information::quadrature::rigorous::Rigorous;
/// use mean_information::scalar::{Integrand, Scalar};
///
/// /// `1 / (1 + x^2)`, whose integral from 0 to 1 is `π/4`.
/// struct Witch;
/// impl Integrand for Witch {
///     fn evaluate<S: Scalar>(&self, x: S) -> S {
///         S::constant(1.0) / (S::constant(1.0) + x.clone() * x)
///     }
/// }
/// let quarter = Rigorous::<f64>::default().integrate(&Witch, 0.0, 1.0)?;
/// assert!(quarter.contains(core::f64::consts::FRAC_PI_4) && quarter.width() <= 2.3e-16);
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigorous<T> {
    tolerance: Tolerance<T>,
    limit: u64,
}

impl<T: Real> Default for Rigorous<T> {
    fn default() -> Self {
        Self::new()
    }
}

/// An integral in 128 bits, for results that are computed from several.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Integral {
    /// Contains the integral.
    pub(crate) value: Interval<Wide>,
    pub(crate) status: Status<f64>,
    pub(crate) evaluations: u64,
}

impl<T: Real> Rigorous<T> {
    /// Returns the finest relative tolerance, a 64th of the distance from 1 to the next float: with it, rounding to `T`
    /// makes the width (a 16th of the spacing below 1/2, where a limit of 1 minus the integral shows no more).
    pub(crate) fn finest() -> T {
        T::epsilon() * T::from_parts(1, -6)
    }

    /// Creates the settings of the finest tolerance that `T` can tell, and at most 100 000 evaluations.
    pub fn new() -> Self {
        Self { tolerance: Tolerance { absolute: T::zero(), relative: Self::finest() }, limit: 100_000 }
    }

    /// Sets the width relative to the magnitude of the integral: 0 for none, or from a 64th of the spacing of floats at
    /// 1 (`2^-58` in `f64`, `2^-29` in `f32`) up to 1.
    #[must_use]
    pub fn relative(self, relative: T) -> Self {
        Self { tolerance: Tolerance { relative, ..self.tolerance }, ..self }
    }

    /// Sets the absolute width, in units of the integral: 0 for none, or any positive number.
    #[must_use]
    pub fn absolute(self, absolute: T) -> Self {
        Self { tolerance: Tolerance { absolute, ..self.tolerance }, ..self }
    }

    /// Sets the largest number of evaluations, 1 or more; some 20 are made in any case.
    #[must_use]
    pub fn limit(self, limit: u64) -> Self {
        Self { limit, ..self }
    }

    /// Returns the tolerance that was asked for.
    pub(crate) fn tolerance(&self) -> Tolerance<T> {
        self.tolerance
    }

    /// Refuses settings that no result can meet.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let allowed = "0, or from 2^-58 (f32: 2^-29) up to 1";
        self.tolerance.check(&Finest { relative: Self::finest(), allowed })?;
        if self.limit == 0 {
            return Err(Error::out_of_range("evaluation limit", 0.0, "1 or more"));
        }
        Ok(())
    }

    /// Encloses the integral of `f` from `from` to `to`: the negative of the one from `to` to `from`, 0 if they are
    /// equal.
    ///
    /// `f` must be defined between the ends, but at single points. It is evaluated over intervals, and over
    /// rectangles of the complex plane, to prove that it is analytic there. Where it is not, as `√x` at 0, panels are
    /// bisected until their width times the range of `f` is small enough: singular ends cost little, singular points
    /// inside as much as twice an end.
    ///
    /// Error: none; the enclosure contains the integral (proved in [`integration`](crate::book::integration)).
    ///
    /// Special cases: where `f` is not defined, [`Status::NotFinite`] names the stretch; where it has no bound,
    /// [`Status::Unresolved`] does. The enclosure then has no bounds: `-inf` to `inf`.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if an end is not finite, or a setting not as its function says; also if both tolerances
    /// are 0.
    ///
    /// ```
    /// use mean_information::quadrature::rigorous::Rigorous;
    /// use mean_information::scalar::{Integrand, Scalar};
    /// struct Cube;
    /// impl Integrand for Cube {
    ///     fn evaluate<S: Scalar>(&self, x: S) -> S {
    ///         x.clone() * x.clone() * x
    ///     }
    /// }
    /// let quarter = Rigorous::new().relative(1e-6).integrate(&Cube, 0.0_f32, 3.0)?;
    /// assert!(quarter.contains(20.25) && quarter.width() <= 2.1e-5);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn integrate(&self, f: &impl Integrand, from: T, to: T) -> Result<Enclosure<T>, Error> {
        for (what, end) in [("lower limit of the integral", from), ("upper limit of the integral", to)] {
            if !end.is_finite() {
                return Err(Error::out_of_range(what, end.widen(), "finite"));
            }
        }
        self.check()?;
        let integral = self.between_floats(f, from.widen(), to.widen());
        let (lower, upper) = (integral.value.lower(), integral.value.upper());
        Ok(Enclosure {
            // Outward: at most an ulp at each end.
            lower: lower.to_real(Toward::Down),
            upper: upper.to_real(Toward::Up),
            status: integral.status.nearest(),
            evaluations: integral.evaluations,
        })
    }

    /// Encloses the integral between two ends that need not be floats, by settings that were checked: between the
    /// floats below them, and two slivers of the first degree.
    pub(crate) fn between(&self, f: &impl Integrand, from: Interval<Wide>, to: Interval<Wide>) -> Integral {
        // ∫ from..to = ∫ near..far + sliver at `to` - sliver at `from`.
        let (near, sliver_from) = split(f, from);
        let (far, sliver_to) = split(f, to);
        let integral = self.between_floats(f, near, far);
        let evaluations = integral.evaluations + 2;
        let value = integral.value + (sliver_to - sliver_from);
        if value.is_empty() {
            let status = Status::NotFinite { lower: near, upper: far };
            return Integral { value: Interval::WHOLE, status, evaluations };
        }
        Integral { value, evaluations, ..integral }
    }

    /// Encloses the integral between two floats.
    fn between_floats(&self, f: &impl Integrand, from: f64, to: f64) -> Integral {
        if from > to {
            let reversed = self.between_floats(f, to, from);
            return Integral { value: -reversed.value, ..reversed };
        }
        if from == to {
            return Integral { value: Interval::constant(0.0), status: Status::Converged, evaluations: 0 };
        }
        let mut search = Search { f, from, to, evaluations: 0, limit: self.limit };
        search.run(Tolerance {
            absolute: self.tolerance.absolute.widen(),
            relative: self.tolerance.relative.widen(),
        })
    }
}

/// Returns break points between two floats that crowd where ranges leave most of `∫ |f|` open, as about a peak, and the
/// number of evaluations.
pub(crate) fn break_points(f: &impl Integrand, from: f64, to: f64, limit: u64) -> (Vec<f64>, u64) {
    let mut search = Search { f, from, to, evaluations: 0, limit };
    (survey::break_points(&mut search), search.evaluations)
}

/// Returns the float below `x`, and the integral from there to `x`.
fn split(f: &impl Integrand, x: Interval<Wide>) -> (f64, Interval<Wide>) {
    let near = x.lower().to_real::<f64>(Toward::Down);
    let start = Interval::constant(near);
    if x == start {
        // No sliver; and the integrand need not be defined at a single point.
        return (near, Interval::constant(0.0));
    }
    // First degree: the length times the range, theorem (enclosure).
    (near, (x - start) * f.evaluate(start.hull(x)))
}

#[cfg(test)]
mod tests;
