//! Maps of files, read.

use crate::errors::{of_file, one_of};
use crate::interruptible::run;
use crate::long_work::watched;
use crate::pickled::{Made, made};
use crate::scans::words;
use crate::tally::PyTally;
use mean_information_files::bags::{self, MapTopic};
use mean_information_files::{
    ArrayEncoding, Cells, Map, Mode, Options, Semantics, read_array_type_from, read_map_from, with_grid,
};
use mean_information_report::{Measures, uses};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use std::path::PathBuf;

/// A map as it was read.
///
/// Attributes
/// ----------
/// cells : ndarray, shape (rows, columns)
///     The cells as they are stored; row 0 is the lowest.
/// encoding : str
///     What they are: for `tally(map.cells, encoding=map.encoding)`.
/// resolution : float or None
///     The side of a cell in metres; None if the file does not say.
/// origin : tuple of float
///     x and y of the lower left corner in metres.
/// tally : Tally
///     The measures of the map.
/// warnings : list of str
///     Signs that the map means less than it seems; the last one says why its mean information means nothing, if so
///     (`map.tally.meaningful` is False then, or two greys were read as probabilities).
#[pyclass(frozen, get_all, name = "Map", module = "mean_information")]
pub(crate) struct PyMap {
    cells: Py<PyAny>,
    encoding: String,
    resolution: Option<f64>,
    origin: (f64, f64),
    tally: Py<PyTally>,
    warnings: Vec<String>,
}

#[pymethods]
impl PyMap {
    /// Mean information of the map, in bits per observed cell.
    #[getter]
    fn mean_information(&self) -> f64 {
        self.tally.get().mean_information()
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let shape = self.cells.bind(py).getattr("shape")?;
        let tally = self.tally.bind(py).repr()?;
        Ok(format!("<Map of shape {shape}, {}: {tally}>", self.encoding))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Made<'py, (State,)>> {
        let Self { cells, encoding, resolution, origin, tally, warnings } = self;
        let (cells, tally) = (cells.clone_ref(py), tally.clone_ref(py));
        let state = (cells, encoding.clone(), *resolution, *origin, tally, warnings.clone());
        made(py, "_map", (state,))
    }
}

/// What pickle keeps of a map.
type State = (Py<PyAny>, String, Option<f64>, (f64, f64), Py<PyTally>, Vec<String>);

/// Makes a map of what pickle has kept.
#[pyfunction]
pub(crate) fn _map(state: State) -> PyMap {
    let (cells, encoding, resolution, origin, tally, warnings) = state;
    PyMap { cells, encoding, resolution, origin, tally, warnings }
}

/// Says which files an argument of `read_map` is for, if the one at `path` has no use for it.
#[pyfunction]
pub(crate) fn no_use(argument: &str, path: PathBuf) -> Option<&'static str> {
    uses::no_use(argument, &path)
}

/// Reads the type of the elements of an array; `None` of other files.
#[pyfunction]
pub(crate) fn type_of_array(py: Python<'_>, path: PathBuf) -> PyResult<Option<String>> {
    run(py, |source| read_array_type_from(source, &path))
}

const SEMANTICS: [(&str, Semantics); 3] =
    [("nav2", Semantics::Nav2), ("nav2-humble", Semantics::Nav2Humble), ("ros1", Semantics::Ros1)];
const MODES: [(&str, Mode); 4] = [
    ("trinary", Mode::Trinary),
    ("scale", Mode::Scale),
    ("raw", Mode::Raw),
    ("probability", Mode::Probability),
];
const ENCODINGS: [(&str, ArrayEncoding); 4] = [
    ("probability", ArrayEncoding::Probability),
    ("percent", ArrayEncoding::Percent),
    ("log-odds", ArrayEncoding::LogOdds),
    ("mrpt", ArrayEncoding::Mrpt),
];

/// Read a map, for whose kind `_files.py` has found the arguments fit.
#[pyfunction]
#[pyo3(signature = (
    path, *, semantics=None, mode=None, unknown=None, encoding=None, resolution=None, topic=None, max_cells=None,
))]
#[expect(clippy::too_many_arguments, reason = "the options of the command")]
pub(crate) fn read_map(
    py: Python<'_>,
    path: PathBuf,
    semantics: Option<&str>,
    mode: Option<&str>,
    unknown: Option<f64>,
    encoding: Option<&str>,
    resolution: Option<f64>,
    topic: Option<String>,
    max_cells: Option<u64>,
) -> PyResult<PyMap> {
    let semantics = semantics.map_or(Ok(Semantics::Nav2), |word| one_of("semantics", word, &SEMANTICS))?;
    let mode = mode.map(|word| one_of("mode", word, &MODES)).transpose()?;
    let encoding = encoding.map(|word| one_of("encoding", word, &ENCODINGS)).transpose()?;
    let options = Options { semantics, mode, unknown, encoding, resolution, max_cells };
    let map = if bags::is_bag(&path) {
        let topic = MapTopic { name: topic, costmaps: false };
        watched(py, move || bags::last_map(&path, &topic, &options))?.map_err(of_file)?
    } else {
        run(py, |source| read_map_from(source, &path, &options))?
    };
    as_python(py, map)
}

/// Hands a map over to Python.
fn as_python(py: Python<'_>, map: Map) -> PyResult<PyMap> {
    let Map { cells, resolution, warnings, .. } = map;
    let encoding = match cells {
        Cells::Percent(_) => "percent",
        Cells::Mrpt(_) => "mrpt",
        Cells::Probability32(_) | Cells::Probability64(_) => "probability",
        Cells::LogOdds32(_) | Cells::LogOdds64(_) => "log-odds",
    };
    let (cells, tally, measures) = watched(py, move || {
        let (tally, measures) = with_grid!(&cells, grid => {
            let tally = grid.tally();
            let measures = Measures::of_tallied(grid, &tally);
            (PyTally::from(tally), measures)
        });
        (cells, tally, measures)
    })?;
    let not_meaningful = measures.noticing(&warnings).warning();
    let (array, origin) = with_grid!(&cells, grid => {
        let array = PyArray1::from_slice(py, grid.cells()).reshape([grid.height(), grid.width()])?;
        (array.into_any().unbind(), grid.geometry().origin().into())
    });
    let tally = Py::new(py, tally)?;
    let mut warnings = words(&warnings);
    warnings.extend(not_meaningful);
    Ok(PyMap { cells: array, encoding: encoding.to_owned(), resolution, origin, tally, warnings })
}
