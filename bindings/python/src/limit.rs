//! The limit of the mean information of one scan as cells shrink.

use crate::errors::{one_of, refused};
use crate::pickled::{Made, made};
use mean_information::limit::{self, Weight};
use mean_information::quadrature::adaptive::GaussKronrod;
use mean_information::quadrature::rigorous::Rigorous;
use mean_information::sensor::GaussianSensor;
use mean_information_cli::limits::Computed;
use pyo3::prelude::*;

/// How a limit is computed.
#[derive(Clone, Copy)]
enum Method {
    ClosedForm,
    Adaptive,
    Rigorous,
}

const METHODS: [(&str, Method); 3] =
    [("closed-form", Method::ClosedForm), ("adaptive", Method::Adaptive), ("rigorous", Method::Rigorous)];

/// A limit of the mean information, in bits per observed cell, and what is known of it.
///
/// Attributes
/// ----------
/// value : float
///     The limit.
/// lower, upper : float
///     Where the exact limit lies: proved for the methods "closed-form" and "rigorous", by an estimated error for "adaptive".
/// status : str
///     "converged", or why the method ended before.
/// evaluations : int
///     How often the integrand was evaluated.
#[pyclass(frozen, get_all, eq, name = "Limit", module = "mean_information")]
#[derive(PartialEq)]
pub(crate) struct PyLimit {
    value: f64,
    lower: f64,
    upper: f64,
    status: String,
    evaluations: u64,
}

#[pymethods]
impl PyLimit {
    fn __repr__(&self) -> String {
        let Self { value, lower, upper, status, evaluations } = self;
        format!(
            "Limit(value={value:?}, lower={lower:?}, upper={upper:?}, status='{status}', evaluations={evaluations})"
        )
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Made<'py, State>> {
        let Self { value, lower, upper, ref status, evaluations } = *self;
        made(py, "_limit", (value, lower, upper, status.clone(), evaluations))
    }
}

/// What pickle keeps of a limit.
type State = (f64, f64, f64, String, u64);

/// Makes a limit of what pickle has kept.
#[pyfunction]
pub(crate) fn _limit(value: f64, lower: f64, upper: f64, status: String, evaluations: u64) -> PyLimit {
    PyLimit { value, lower, upper, status, evaluations }
}

/// Compute what the mean information of one scan of a circular room tends to as cells shrink, Eq. 7 of the report [1]_.
///
/// Parameters
/// ----------
/// range : float
///     The range that the sensor reads, in metres.
/// sigma : float
///     The standard deviation of the sensor, in metres.
/// weight : {"radial", "area"}
///     "radial": polar maps, cells of equal width and angle, which Eq. 7 belongs to. "area": cells of equal area, as in
///     Cartesian grids.
/// method : {"closed-form", "adaptive", "rigorous"}
///     "closed-form": within 0.501 ulp (proved). "adaptive": by Gauss-Kronrod quadrature, with an estimated error.
///     "rigorous": by interval arithmetic, an enclosure (proved).
///
/// Returns
/// -------
/// Limit
///
/// Raises
/// ------
/// ValueError
///     If range or sigma is not positive and finite.
///
/// References
/// ----------
/// .. [1] J.-L. Blanco, "Derivation of an Expression for the Mean Information Maximum Value", University of Malaga.
///
/// Examples
/// --------
/// >>> import mean_information as mi
/// >>> mi.limit(2.0, 0.2).value
/// 0.7893368880256514
/// >>> enclosed = mi.limit(2.0, 0.2, weight="area", method="rigorous")
/// >>> enclosed.lower <= 0.6525109529727351 <= enclosed.upper
/// True
#[pyfunction]
#[pyo3(name = "limit", signature = (range, sigma, *, weight="radial", method="closed-form"))]
pub(crate) fn limit_of(
    py: Python<'_>,
    range: f64,
    sigma: f64,
    weight: &str,
    method: &str,
) -> PyResult<PyLimit> {
    let weight = one_of("weight", weight, &[("radial", Weight::Radial), ("area", Weight::Area)])?;
    let sensor = GaussianSensor::new(range, sigma).map_err(refused)?;
    let computed = match one_of("method", method, &METHODS)? {
        Method::ClosedForm => Ok(Computed::closed_form(limit::closed_form(&sensor, weight))),
        Method::Adaptive => {
            py.detach(|| limit::adaptive(&sensor, weight, &GaussKronrod::new()).map(Computed::from))
        }
        Method::Rigorous => {
            py.detach(|| limit::rigorous(&sensor, weight, &Rigorous::new()).map(Computed::from))
        }
    };
    let Computed { value, lower, upper, status, evaluations } = computed.map_err(refused)?;
    Ok(PyLimit { value, lower, upper, status: status.to_owned(), evaluations })
}
