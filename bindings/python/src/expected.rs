//! The expected map of a particle filter's hypotheses.

use crate::cells::shown;
use crate::encodings::{Array, with_encoding};
use crate::errors::{out_of_memory, refused};
use crate::long_work::watched;
use crate::pickled::{Made, made};
use crate::tally::{Format, PyTally};
use mean_information::expected::Hypotheses;
use mean_information::map::{Encoding, Geometry, Grid};
use mean_information::{Error, Real};
use num_traits::float::FloatCore;
use numpy::PyArrayMethods;
use numpy::ndarray::ArrayView2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// An expected map: the weighted mean of a particle filter's maps, cell by cell.
///
/// Attributes
/// ----------
/// probabilities : ndarray
///     The mean occupancies, each rounded once; NaN where cells were left out.
/// tally : Tally
///     The sums over the exact means; `tally.mean_information` is the EMMI.
/// mean_of_particles : float
///     The weighted mean of the particles' own mean information.
#[pyclass(frozen, get_all, name = "ExpectedMap", module = "mean_information")]
pub(crate) struct PyExpectedMap {
    probabilities: Py<PyAny>,
    tally: Py<PyTally>,
    mean_of_particles: f64,
}

#[pymethods]
impl PyExpectedMap {
    /// Mean information of the expected map, EMMI, in bits per observed cell.
    #[getter]
    fn mean_information(&self) -> f64 {
        self.tally.get().mean_information()
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let shape = self.probabilities.bind(py).getattr("shape")?;
        let (emmi, mean) = (self.mean_information(), self.mean_of_particles);
        Ok(format!(
            "<ExpectedMap of shape {shape}: EMMI {emmi:?} bits per observed cell; particles {mean:?}>"
        ))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Made<'py, State>> {
        let Self { probabilities, tally, mean_of_particles } = self;
        made(py, "_expected_map", (probabilities.clone_ref(py), tally.clone_ref(py), *mean_of_particles))
    }
}

/// What pickle keeps of an expected map.
type State = (Py<PyAny>, Py<PyTally>, f64);

/// Makes an expected map of what pickle has kept.
#[pyfunction]
pub(crate) fn _expected_map(
    probabilities: Py<PyAny>,
    tally: Py<PyTally>,
    mean_of_particles: f64,
) -> PyExpectedMap {
    PyExpectedMap { probabilities, tally, mean_of_particles }
}

/// Compute the expected map of particles, which `_expected.py` has prepared.
#[pyfunction]
pub(crate) fn expected_map(
    py: Python<'_>,
    particles: Vec<Bound<'_, PyAny>>,
    weights: Vec<f64>,
    encoding: &str,
    mask: Option<numpy::PyReadonlyArray2<'_, u8>>,
) -> PyResult<PyExpectedMap> {
    let Some(first) = particles.first() else {
        return Err(PyValueError::new_err("number of particles is 0, allowed is 1 or more"));
    };
    let mask = mask.as_ref().map(numpy::PyReadonlyArray2::as_array);
    with_encoding!(Array::new(first, encoding)?, _first, Encoding_ => {
        let mut maps = Vec::with_capacity(particles.len());
        for (index, particle) in particles.iter().enumerate() {
            let array = particle.extract::<numpy::PyReadonlyArray2<'_, <Encoding_ as Encoding>::Stored>>()?;
            maps.push(grid::<Encoding_>(index, array.as_array(), mask)?);
        }
        expected::<Encoding_>(py, maps, weights, mask)
    })
}

/// Computes the expected map of grids.
fn expected<E>(
    py: Python<'_>,
    maps: Vec<Grid<E>>,
    weights: Vec<f64>,
    mask: Option<ArrayView2<'_, u8>>,
) -> PyResult<PyExpectedMap>
where
    E: Encoding<Float: Format, Stored: Send> + Send + 'static,
{
    let computed = watched(py, move || {
        let hypotheses = Hypotheses::new(&maps, &weights)?;
        Ok::<_, mean_information::Error>((hypotheses.expected_map()?, hypotheses.mean_of_mean_information()))
    })?;
    let (map, mean) = computed.map_err(refused)?;
    let cells = map.grid().cells();
    let probabilities = match mask {
        None => numpy::PyArray1::from_slice(py, cells).reshape([map.grid().height(), map.grid().width()])?,
        Some(mask) => {
            let mut chosen = cells.iter().copied();
            let cell = |&meant: &u8| {
                let next = if meant == 0 { None } else { chosen.next() };
                next.unwrap_or_else(FloatCore::nan)
            };
            numpy::PyArray2::from_owned_array(py, mask.map(cell))
        }
    };
    Ok(PyExpectedMap {
        probabilities: probabilities.into_any().unbind(),
        tally: Py::new(py, PyTally::from(map.tally().clone()))?,
        mean_of_particles: mean.widen(),
    })
}

/// Copies the map of a particle from an array; where there is a mask, those of its cells that are meant, as one row.
fn grid<E: Encoding>(
    particle: usize,
    cells: ArrayView2<'_, E::Stored>,
    mask: Option<ArrayView2<'_, u8>>,
) -> PyResult<Grid<E>> {
    let (mut height, mut width) = cells.dim();
    let mut copied = Vec::new();
    copied.try_reserve_exact(cells.len()).map_err(|_| out_of_memory())?;
    match (mask, cells.as_slice()) {
        (Some(mask), _) => {
            copied.extend(cells.iter().zip(&mask).filter(|&(_, &meant)| meant != 0).map(|(cell, _)| cell));
            (height, width) = (1, copied.len());
        }
        (None, Some(cells)) => copied.extend_from_slice(cells),
        (None, None) => copied.extend(cells.iter()),
    }
    let place = |row: usize, column: usize| {
        let meant = |mask: ArrayView2<'_, u8>| {
            let chosen = mask.indexed_iter().filter(|&(_, &meant)| meant != 0);
            chosen.map(|(place, _)| place).nth(column)
        };
        mask.and_then(meant).unwrap_or((row, column))
    };
    let map = Geometry::new(1.0, [0.0; 2]).and_then(|geometry| Grid::new(width, height, geometry, copied));
    map.map_err(|error| {
        PyValueError::new_err(match error {
            Error::Cell { row, column, value, allowed, .. } => {
                let (row, column) = place(row, column);
                format!("particles[{particle}][{row}, {column}] is {}, allowed is {allowed}", shown(value))
            }
            error => format!("particles[{particle}]: {error}"),
        })
    })
}
