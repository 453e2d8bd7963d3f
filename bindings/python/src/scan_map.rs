//! Maps from range scans.

use crate::errors::{count, refused};
use crate::long_work::watched;
use crate::sensors::{FunctionReading, PySteppedSensor, Sensor};
use crate::tally::PyTally;
use mean_information::Error;
use mean_information::scan::{Beam, Pose, Scan, ScanMap};
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use std::sync::Arc;

/// A map that range scans are inserted into, and removed from again, to the bits of a map that never had them.
///
/// Cells are squares of one side whose corners lie at multiples of it. The map grows with the scans; each cell holds the sum
/// of the log-odds of the scans that crossed it, exactly, so that their order changes no bit.
///
/// Parameters
/// ----------
/// resolution : float
///     The side of a cell, in metres.
/// sensor : GaussianSensor, SteppedSensor or object, optional
///     The inverse sensor model. Any object with the methods ``occupancy(distance, range)``, the occupancy of a point at that
///     distance, and ``reach(range)``, the distance beyond which it is 1/2, both in metres, will do; by default
///     ``SteppedSensor(resolution, 0.4, 0.7)``, as of the command.
/// reading_limit : float
///     The log-odds in nats to which one reading of a cell is limited.
/// agreement : bool
///     Whether the map keeps what `agreement` needs: twice the memory.
///
/// Examples
/// --------
/// >>> import mean_information as mi
/// >>> scans = mi.ScanMap(0.25, sensor=mi.GaussianSensor(0.1))
/// >>> scans.insert((0.13, 0.27, 0.0), [0.0, 1.5], [1.5, float("inf")], max_range=2.0)
/// >>> tally = scans.tally()
/// >>> tally.free, tally.occupied
/// (14, 1)
/// >>> scans.remove((0.13, 0.27, 0.0), [0.0, 1.5], [1.5, float("inf")], max_range=2.0)
/// >>> scans.scans
/// 0
#[pyclass(name = "ScanMap", module = "mean_information")]
pub(crate) struct PyScanMap {
    /// Shared with who measures it without the interpreter; what changes it meanwhile changes a copy.
    map: Arc<ScanMap<f64>>,
    #[pyo3(get)]
    sensor: Py<PyAny>,
}

/// What is done with a scan.
#[derive(Clone, Copy)]
enum Change {
    Insert,
    Remove,
}

/// A scan as Python hands it over: pose, bearings, ranges, greatest range.
type Given<'a, 'py> = (&'a Bound<'py, PyAny>, &'a Bound<'py, PyAny>, &'a Bound<'py, PyAny>, f64);

impl PyScanMap {
    /// Changes the map by a scan and the model of its readings; a scan without beams says nothing.
    fn change(&mut self, py: Python<'_>, change: Change, given: Given<'_, '_>) -> PyResult<()> {
        let (pose, bearings, ranges, max_range) = given;
        let (bearings, ranges) = (floats("bearings", bearings)?, floats("ranges", ranges)?);
        let Some(scan) = scan(pose_of(pose)?, &bearings, &ranges, max_range)? else {
            return Ok(());
        };
        let sensor = Sensor::new(self.sensor.bind(py))?;
        let map = Arc::make_mut(&mut self.map);
        /// Inserts or removes.
        macro_rules! apply {
            ($model:expr) => {
                match change {
                    Change::Insert => map.insert(&scan, $model),
                    Change::Remove => map.remove(&scan, $model),
                }
            };
        }
        match sensor {
            Sensor::Named(model) => py.detach(|| apply!(|range| model.of_range(range))).map_err(refused),
            Sensor::Function(function) => {
                let model = |range| Ok::<_, Error>(FunctionReading::new(&function, range));
                apply!(model).map_err(|error| function.raised(error))
            }
        }
    }
}

/// Takes a scan of Python: beams whose range is NaN are left out, those at the greatest range and beyond did not return.
fn scan(
    pose: Pose,
    bearings: &PyReadonlyArray1<'_, f64>,
    ranges: &PyReadonlyArray1<'_, f64>,
    max_range: f64,
) -> PyResult<Option<Scan<f64>>> {
    let (bearings, ranges) = (bearings.as_array(), ranges.as_array());
    if bearings.len() != ranges.len() {
        let (bearings, ranges) = (bearings.len(), ranges.len());
        return Err(PyValueError::new_err(format!("{bearings} bearings were given for {ranges} ranges")));
    }
    let beams = bearings.iter().zip(ranges).filter(|(_, range)| !range.is_nan());
    let beams = beams.map(|(&bearing, &range)| Beam { bearing, range: (range < max_range).then_some(range) });
    let beams: Vec<_> = beams.collect();
    if beams.is_empty() { Ok(None) } else { Scan::new(pose, max_range, beams).map(Some).map_err(refused) }
}

#[pymethods]
impl PyScanMap {
    #[new]
    #[pyo3(signature = (resolution, *, sensor=None, reading_limit=3.5, agreement=false))]
    fn new(
        py: Python<'_>,
        resolution: f64,
        sensor: Option<Bound<'_, PyAny>>,
        reading_limit: f64,
        agreement: bool,
    ) -> PyResult<Self> {
        let map = ScanMap::new(resolution).and_then(|map| map.with_reading_limit(reading_limit));
        let map = if agreement { map.and_then(ScanMap::with_agreement) } else { map }.map_err(refused)?;
        let sensor = match sensor {
            Some(sensor) => sensor.unbind(),
            None => Py::new(py, PySteppedSensor::new(resolution, 0.4, 0.7)?)?.into_any(),
        };
        Sensor::new(sensor.bind(py))?;
        Ok(Self { map: Arc::new(map), sensor })
    }

    /// Insert a scan: along each beam, as far as the model of its range reaches, the cells that it crosses.
    ///
    /// Parameters
    /// ----------
    /// pose : sequence of float, shape (3,)
    ///     x and y of the sensor in metres, and its heading in radians, counter-clockwise from the x axis.
    /// bearings : array_like of float, shape (n,)
    ///     The directions of the beams from the heading, in radians, counter-clockwise.
    /// ranges : array_like of float, shape (n,)
    ///     What came back, in metres. NaN: the beam is left out. `max_range` and more: nothing came back, the space up to
    ///     there is free.
    /// max_range : float
    ///     The greatest range of the sensor, in metres.
    ///
    /// Raises
    /// ------
    /// TypeError, ValueError
    ///     If an argument is no list of numbers; if a number is out of its range, the first of which is named; then the map has not changed.
    /// MemoryError
    ///     If the map would grow beyond 2**26 cells; then it has not changed.
    #[pyo3(signature = (pose, bearings, ranges, *, max_range))]
    fn insert(
        &mut self,
        py: Python<'_>,
        pose: &Bound<'_, PyAny>,
        bearings: &Bound<'_, PyAny>,
        ranges: &Bound<'_, PyAny>,
        max_range: f64,
    ) -> PyResult<()> {
        self.change(py, Change::Insert, (pose, bearings, ranges, max_range))
    }

    /// Remove a scan that was inserted: the exact inverse of `insert` with the same arguments.
    ///
    /// Parameters
    /// ----------
    /// pose, bearings, ranges, max_range
    ///     As of `insert`.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the map does not hold the scan; then the map has not changed.
    #[pyo3(signature = (pose, bearings, ranges, *, max_range))]
    fn remove(
        &mut self,
        py: Python<'_>,
        pose: &Bound<'_, PyAny>,
        bearings: &Bound<'_, PyAny>,
        ranges: &Bound<'_, PyAny>,
        max_range: f64,
    ) -> PyResult<()> {
        self.change(py, Change::Remove, (pose, bearings, ranges, max_range))
    }

    /// Measure the cells of the rectangle that scans have crossed.
    ///
    /// Returns
    /// -------
    /// Tally
    fn tally(&self, py: Python<'_>) -> PyResult<PyTally> {
        let map = Arc::clone(&self.map);
        watched(py, move || map.tally()).map(PyTally::from)
    }

    /// Return the occupancies of the rectangle that scans have crossed, 1/2 where nothing is known.
    ///
    /// Returns
    /// -------
    /// ndarray of float64, shape (rows, columns)
    ///     Row 0 is the lowest, column 0 the leftmost; its lower left corner is at `origin`.
    fn probabilities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let map = Arc::clone(&self.map);
        let grid = watched(py, move || map.probabilities())?.map_err(refused)?;
        let cells = PyArray1::from_slice(py, grid.cells()).reshape([grid.height(), grid.width()])?;
        Ok(cells.into_any())
    }

    /// Lower left corner of the rectangle that scans have crossed: x and y in metres.
    #[getter]
    fn origin(&self) -> PyResult<(f64, f64)> {
        self.map.geometry().map(|geometry| geometry.origin().into()).map_err(refused)
    }

    /// Agreement of the scans, in [0, 1]: the part of the readings' log-odds that do not contradict one another; None if the
    /// map does not keep it.
    #[getter]
    fn agreement(&self) -> Option<f64> {
        self.map.agreement()
    }

    /// Side of a cell, in metres.
    #[getter]
    fn resolution(&self) -> f64 {
        self.map.resolution()
    }

    /// Number of scans that the map holds.
    #[getter]
    fn scans(&self) -> u64 {
        self.map.scans()
    }

    fn __repr__(&self) -> String {
        format!("<ScanMap of {}, cells of {:?} m>", count(self.map.scans(), "scan"), self.map.resolution())
    }

    /// A copy is a map of its own: what is inserted into one is not in the other.
    fn __copy__(&self, py: Python<'_>) -> Self {
        Self { map: Arc::clone(&self.map), sensor: self.sensor.clone_ref(py) }
    }

    fn __deepcopy__(&self, py: Python<'_>, memo: &Bound<'_, PyAny>) -> PyResult<Self> {
        let sensor = py.import("copy")?.call_method1("deepcopy", (&self.sensor, memo))?;
        Ok(Self { map: Arc::clone(&self.map), sensor: sensor.unbind() })
    }

    #[expect(clippy::unused_self, reason = "a method of Python")]
    fn __reduce__(&self) -> PyResult<()> {
        Err(PyTypeError::new_err(
            "a ScanMap is not pickled: insert its scans again where it is needed, or send its tally() or its \
             probabilities(); copy.copy(scan_map) copies it",
        ))
    }
}

/// Takes a pose: any sequence of three numbers.
fn pose_of(given: &Bound<'_, PyAny>) -> PyResult<Pose> {
    let [x, y, theta] = match given.extract::<(f64, f64, f64)>() {
        Ok((x, y, theta)) => [x, y, theta],
        Err(_) => match *floats("pose", given)?.as_array().to_vec() {
            [x, y, theta] => [x, y, theta],
            ref others => {
                let words = format!(
                    "pose is of {}, allowed are 3: x, y, heading",
                    count(others.len() as u64, "number")
                );
                return Err(PyValueError::new_err(words));
            }
        },
    };
    Pose::new(x, y, theta).map_err(refused)
}

/// Takes a list of numbers as floats, as NumPy does; `name` is that of the argument.
fn floats<'py>(name: &str, list: &Bound<'py, PyAny>) -> PyResult<PyReadonlyArray1<'py, f64>> {
    let py = list.py();
    let array = py.import("numpy")?.call_method1("asarray", (list, "float64"));
    let array = array.map_err(|error| {
        let words = format!("{name}: {}", error.value(py));
        if error.is_instance_of::<PyTypeError>(py) {
            PyTypeError::new_err(words)
        } else {
            PyValueError::new_err(words)
        }
    })?;
    let dimensions: usize = array.getattr("ndim")?.extract()?;
    array.extract().map_err(|_| {
        let words = format!(
            "{name} has {}, allowed is one dimension: a list of numbers",
            count(dimensions as u64, "dimension")
        );
        PyValueError::new_err(words)
    })
}
