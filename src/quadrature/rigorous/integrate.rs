//! Enclosures of an integral between two floats, or between two numbers that are enclosed.

use super::settings::Rigorous;
use super::state::{Integral, Search};
use super::survey;
use crate::error::Error;
use crate::estimate::{Enclosure, Status};
use crate::interval::{Interval, Toward, Wide};
use crate::quadrature::tolerance::Tolerance;
use crate::real::Real;
use crate::scalar::{Integrand, Scalar};
use alloc::vec::Vec;

impl<T: Real> Rigorous<T> {
    /// Encloses the integral of `f` from `from` to `to`: the negative of the one from `to` to `from`, 0 if they are
    /// equal.
    ///
    /// `f` must be defined between the ends, but at single points: the caller's part. It is evaluated over intervals,
    /// and over rectangles of the complex plane, to prove that it is analytic there. Where it is not, as `√x` at 0,
    /// panels are bisected until their width times the range of `f` is small enough: singular ends cost little, singular
    /// points inside as much as twice an end.
    ///
    /// Error: none; the enclosure contains the integral (proved in [`integration`](crate::book::integration)).
    ///
    /// Special cases: a panel on which `f` is not defined, or not on its middle half, is named by
    /// [`Status::NotFinite`], one on which it has no bound by [`Status::Unresolved`]. The enclosure then has no bounds:
    /// `-inf` to `inf`. A stretch without values elsewhere in a panel can pass unseen: a range is that of the part where
    /// `f` is defined.
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
        // Panels ascend; backwards the integral is the negative.
        if from > to {
            let reversed = self.between_floats(f, to, from);
            return Integral { value: -reversed.value, ..reversed };
        }
        if from == to {
            return Integral { value: Interval::constant(0.0), status: Status::Converged, evaluations: 0 };
        }
        let mut search = Search { f, from, to, evaluations: 0, limit: self.limit };
        search.run(Tolerance {
            absolute: self.tolerance().absolute.widen(),
            relative: self.tolerance().relative.widen(),
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
    // From below, so that the sliver is never negative.
    let near = x.lower().to_real::<f64>(Toward::Down);
    let start = Interval::constant(near);
    if x == start {
        // No sliver; and the integrand need not be defined at a single point.
        return (near, Interval::constant(0.0));
    }
    // First degree: the length times the range, theorem (enclosure).
    (near, (x - start) * f.evaluate(start.hull(x)))
}
