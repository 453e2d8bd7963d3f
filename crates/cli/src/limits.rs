//! Limits of the mean information with their ends, by whichever method.

use mean_information::Real;
use mean_information::estimate::{self, Enclosure, Estimate};

/// A limit as any of the methods gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Computed<T> {
    /// The limit, in bits per observed cell.
    pub value: T,
    /// The lower end of where it lies: proved, or by an estimated error.
    pub lower: T,
    /// The upper end.
    pub upper: T,
    /// The way in which the computation ended: "converged", or why not.
    pub status: &'static str,
    /// The number of evaluations of the integrand.
    pub evaluations: u64,
}

/// The status of a result within its tolerance.
pub(crate) const CONVERGED: &str = "converged";

impl<T: Real> Computed<T> {
    /// Encloses a limit in closed form, which is wrong by less than 1 ulp (proved), so that its neighbours enclose it.
    pub fn closed_form(value: T) -> Self {
        let (m, e) = value.parts();
        let (lower, upper) = (T::from_parts(m - 1, e), T::from_parts(m + 1, e).min(T::one()));
        Self { value, lower, upper, status: CONVERGED, evaluations: 0 }
    }
}

impl<T: Real> From<Estimate<T>> for Computed<T> {
    fn from(estimate: Estimate<T>) -> Self {
        let Estimate { value, error, status, evaluations, .. } = estimate;
        let (lower, upper) = ((value - error).max(T::zero()), (value + error).min(T::one()));
        Self { value, lower, upper, status: name(status), evaluations }
    }
}

impl<T: Real> From<Enclosure<T>> for Computed<T> {
    fn from(enclosure: Enclosure<T>) -> Self {
        let Enclosure { lower, upper, status, evaluations, .. } = enclosure;
        Self { value: lower + (upper - lower) * T::HALF, lower, upper, status: name(status), evaluations }
    }
}

/// Returns the name of an integral's status.
fn name<T: Real>(status: estimate::Status<T>) -> &'static str {
    use estimate::Status as Integral;
    match status {
        Integral::Converged => CONVERGED,
        Integral::EvaluationLimit => "evaluation-limit",
        Integral::RoundOff => "round-off",
        Integral::Unresolved { .. } => "unresolved",
        Integral::NotFinite { .. } => "not-finite",
        _ => "not-converged",
    }
}
