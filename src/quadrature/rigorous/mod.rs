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

use crate::error::Error;
use crate::estimate::{Enclosure, Status};
use crate::interval::{Interval, Toward, Wide};
use crate::real::Real;
use crate::scalar::{Integrand, Scalar};
use search::Search;

/// The wanted width, and how much work it may take.
///
/// The result contains the integral whatever is asked for; a tolerance only says when to stop. The width is first
/// that of the enclosure as computed, in 128 bits; rounding to `T` adds at most 1 ulp at each end.
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
    pub(crate) absolute: T,
    pub(crate) relative: T,
    pub(crate) limit: u64,
}

/// The finest relative tolerance, a 64th of the distance from 1 to the next float: then rounding to `T` makes the
/// width.
fn finest<T: Real>() -> T {
    T::epsilon() * T::from_parts(1, -6)
}

/// The finest tolerance that `T` can tell, and a hundred thousand evaluations.
impl<T: Real> Default for Rigorous<T> {
    fn default() -> Self {
        Self { absolute: T::zero(), relative: finest(), limit: 100_000 }
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
    /// A width of at most `absolute`, or at most `relative` times the magnitude of the integral, whichever is larger.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if `absolute` is not in `[0, inf)`, `relative` not in `[0, 1)`, or both are too small to
    /// be reached: `absolute` is 0 and `relative` below a 64th of the distance from 1 to the next float.
    pub fn new(absolute: T, relative: T) -> Result<Self, Error> {
        if !(absolute >= T::zero() && absolute.is_finite()) {
            return Err(Error::out_of_range("absolute tolerance", absolute.widen(), "0 or more, finite"));
        }
        if !(relative >= T::zero() && relative < T::one()) {
            return Err(Error::out_of_range("relative tolerance", relative.widen(), "0 or more, below 1"));
        }
        if absolute.is_zero() && relative < finest() {
            let allowed = "2^-58 or more (f32: 2^-29), unless there is an absolute tolerance";
            return Err(Error::out_of_range("relative tolerance", relative.widen(), allowed));
        }
        Ok(Self { absolute, relative, ..Self::default() })
    }

    /// The same with a limit on the number of evaluations; some 20 are made in any case.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if it is 0.
    pub fn with_limit(self, evaluations: u64) -> Result<Self, Error> {
        if evaluations == 0 {
            return Err(Error::out_of_range("evaluation limit", 0.0, "1 or more"));
        }
        Ok(Self { limit: evaluations, ..self })
    }

    /// The integral of `f` from `from` to `to`: negative of the one from `to` to `from`, 0 if they are equal.
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
    /// [`Error::OutOfRange`] if an end is not finite.
    pub fn integrate(&self, f: &impl Integrand, from: T, to: T) -> Result<Enclosure<T>, Error> {
        for (what, end) in [("lower limit of the integral", from), ("upper limit of the integral", to)] {
            if !end.is_finite() {
                return Err(Error::out_of_range(what, end.widen(), "finite"));
            }
        }
        let integral = self.between_floats(f, from.widen(), to.widen());
        let (lower, upper) = (integral.value.lower(), integral.value.upper());
        Ok(Enclosure {
            lower: lower.to_real(Toward::Down),
            upper: upper.to_real(Toward::Up),
            status: integral.status.nearest(),
            evaluations: integral.evaluations,
        })
    }

    /// The integral between two ends that need not be floats: between the nearest ones, and two slivers of the first
    /// degree.
    pub(crate) fn between(&self, f: &impl Integrand, from: Interval<Wide>, to: Interval<Wide>) -> Integral {
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

    fn between_floats(&self, f: &impl Integrand, from: f64, to: f64) -> Integral {
        if from > to {
            let reversed = self.between_floats(f, to, from);
            return Integral { value: -reversed.value, ..reversed };
        }
        if from == to {
            return Integral { value: Interval::constant(0.0), status: Status::Converged, evaluations: 0 };
        }
        let mut search = Search { f, from, to, evaluations: 0, limit: self.limit };
        search.run(self.absolute.widen(), self.relative.widen())
    }
}

/// The float nearest to `x`, and the integral from there to `x`.
fn split(f: &impl Integrand, x: Interval<Wide>) -> (f64, Interval<Wide>) {
    let near = x.lower().to_real::<f64>(Toward::Down);
    let start = Interval::constant(near);
    if x == start {
        // No sliver; and the integrand need not be defined at a single point.
        return (near, Interval::constant(0.0));
    }
    (near, (x - start) * f.evaluate(start.hull(x)))
}

#[cfg(test)]
mod tests;
