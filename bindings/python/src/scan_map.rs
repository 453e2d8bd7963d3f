//! Maps from range scans.

use crate::errors::{count, one_of, refused};
use crate::long_work::watched;
use crate::readings::{Masked, floats};
use crate::sensors::{FunctionReading, PySteppedSensor, Sensor};
use crate::tally::PyTally;
use mean_information::Error;
use mean_information::scan::{Beam, Pose, Scan, ScanMap};
use mean_information_files::scans::NoReturn;
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::exceptions::{PyRuntimeError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::MutexExt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, ThreadId};

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
#[pyclass(frozen, name = "ScanMap", module = "mean_information")]
pub(crate) struct PyScanMap {
    /// Locked by who changes it. Shared with who measures it, who needs no lock: what changes it meanwhile changes a copy.
    map: Mutex<Arc<ScanMap<f64>>>,
    /// Who changes it.
    changer: Mutex<Option<ThreadId>>,
    #[pyo3(get)]
    sensor: Py<PyAny>,
}

/// The cells below which a map is measured sooner than a thread begins that could be left for a signal.
const FEW_CELLS: u64 = 100_000;

/// What is done with a scan.
#[derive(Clone, Copy)]
enum Change {
    Insert,
    Remove,
}

/// A scan as Python hands it over: pose, bearings, ranges, greatest range, what no return means.
type Given<'a, 'py> = (&'a Bound<'py, PyAny>, &'a Bound<'py, PyAny>, &'a Bound<'py, PyAny>, f64, &'a str);

const NO_RETURN: [(&str, NoReturn); 2] = [("free", NoReturn::Free), ("left-out", NoReturn::LeftOut)];

impl PyScanMap {
    fn of(map: Arc<ScanMap<f64>>, sensor: Py<PyAny>) -> Self {
        Self { map: Mutex::new(map), changer: Mutex::default(), sensor }
    }

    /// Waits, without the interpreter, until no other thread changes the map.
    ///
    /// # Errors
    /// `RuntimeError` if this thread does: the model of its readings asks for the map.
    fn locked(&self, py: Python<'_>) -> PyResult<MutexGuard<'_, Arc<ScanMap<f64>>>> {
        if *unpoisoned(self.changer.lock()) == Some(thread::current().id()) {
            return Err(PyRuntimeError::new_err(
                "the map is asked for while a scan is inserted or removed, by its sensor",
            ));
        }
        Ok(unpoisoned(self.map.lock_py_attached(py)))
    }

    /// Returns the map as it is now.
    fn now(&self, py: Python<'_>) -> PyResult<Arc<ScanMap<f64>>> {
        self.locked(py).map(|map| Arc::clone(&map))
    }

    /// Computes something of the map as it is now, without the interpreter.
    fn measured<T: Send + 'static>(
        &self,
        py: Python<'_>,
        measure: impl FnOnce(&ScanMap<f64>) -> T + Send + 'static,
    ) -> PyResult<T> {
        let map = self.now(py)?;
        if map.cells() < FEW_CELLS {
            Ok(py.detach(|| measure(&map)))
        } else {
            watched(py, move || measure(&map))
        }
    }

    /// Changes the map by a scan and the model of its readings; a scan without beams says nothing.
    fn change(&self, py: Python<'_>, change: Change, given: Given<'_, '_>) -> PyResult<()> {
        let (pose, bearings, ranges, max_range, no_return) = given;
        let no_return = one_of("no_return", no_return, &NO_RETURN)?;
        let bearings = floats("bearings", bearings, Masked::Refused)?;
        let ranges = floats("ranges", ranges, Masked::Nan)?;
        let Some(scan) = scan(pose_of(pose)?, &bearings, &ranges, max_range, no_return)? else {
            return Ok(());
        };
        let sensor = Sensor::new(self.sensor.bind(py))?;
        let mut map = self.locked(py)?;
        *unpoisoned(self.changer.lock()) = Some(thread::current().id());
        let map = Arc::make_mut(&mut map);
        /// Inserts or removes.
        macro_rules! apply {
            ($model:expr) => {
                match change {
                    Change::Insert => map.insert(&scan, $model),
                    Change::Remove => map.remove(&scan, $model),
                }
            };
        }
        let changed = match sensor {
            Sensor::Named(model) => py.detach(|| apply!(|range| model.of_range(range))).map_err(refused),
            Sensor::Function(function) => {
                let model = |range| Ok::<_, Error>(FunctionReading::new(&function, range));
                apply!(model).map_err(|error| function.raised(error))
            }
        };
        *unpoisoned(self.changer.lock()) = None;
        changed
    }
}

/// Takes what a lock guards, also after a fault in another thread.
fn unpoisoned<T>(locked: Result<T, PoisonError<T>>) -> T {
    locked.unwrap_or_else(PoisonError::into_inner)
}

/// Takes a scan of Python: beams whose range is NaN are left out, those at the greatest range and beyond did not return, and
/// are left out too if that means nothing.
fn scan(
    pose: Pose,
    bearings: &PyReadonlyArray1<'_, f64>,
    ranges: &PyReadonlyArray1<'_, f64>,
    max_range: f64,
    no_return: NoReturn,
) -> PyResult<Option<Scan<f64>>> {
    let (bearings, ranges) = (bearings.as_array(), ranges.as_array());
    if bearings.len() != ranges.len() {
        let (bearings, ranges) = (bearings.len(), ranges.len());
        return Err(PyValueError::new_err(format!("{bearings} bearings were given for {ranges} ranges")));
    }
    let is_left_out = |range: f64| range.is_nan() || no_return == NoReturn::LeftOut && range >= max_range;
    let beams = bearings.iter().zip(ranges).filter(|&(_, &range)| !is_left_out(range));
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
        Ok(Self::of(Arc::new(map), sensor))
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
    ///     What came back, in metres. NaN, or masked: the beam is left out. `max_range` and more: nothing came back.
    /// max_range : float
    ///     The greatest range of the sensor, in metres.
    /// no_return : {"free", "left-out"}
    ///     What it means that nothing came back: the space up to `max_range` is free, or nothing, as by default to the command,
    ///     since glass and dark surfaces do not return either.
    ///
    /// Raises
    /// ------
    /// TypeError, ValueError
    ///     If an argument is no list of numbers, or poses or bearings are masked; if a number is out of its range, the first of
    ///     which is named; then the map has not changed.
    /// MemoryError
    ///     If the map would grow beyond 2**26 cells, as it does where poses lie some hundred metres apart; then it has not
    ///     changed. At that size it takes 0.3 to 2 GiB, and while it grows twice that.
    #[pyo3(signature = (pose, bearings, ranges, *, max_range, no_return="free"))]
    fn insert(
        &self,
        py: Python<'_>,
        pose: &Bound<'_, PyAny>,
        bearings: &Bound<'_, PyAny>,
        ranges: &Bound<'_, PyAny>,
        max_range: f64,
        no_return: &str,
    ) -> PyResult<()> {
        self.change(py, Change::Insert, (pose, bearings, ranges, max_range, no_return))
    }

    /// Remove a scan that was inserted: the exact inverse of `insert` with the same arguments.
    ///
    /// Parameters
    /// ----------
    /// pose, bearings, ranges, max_range, no_return
    ///     As of `insert`.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the map does not hold the scan; then the map has not changed.
    #[pyo3(signature = (pose, bearings, ranges, *, max_range, no_return="free"))]
    fn remove(
        &self,
        py: Python<'_>,
        pose: &Bound<'_, PyAny>,
        bearings: &Bound<'_, PyAny>,
        ranges: &Bound<'_, PyAny>,
        max_range: f64,
        no_return: &str,
    ) -> PyResult<()> {
        self.change(py, Change::Remove, (pose, bearings, ranges, max_range, no_return))
    }

    /// Measure the cells of the rectangle that scans have crossed.
    ///
    /// Returns
    /// -------
    /// Tally
    fn tally(&self, py: Python<'_>) -> PyResult<PyTally> {
        self.measured(py, |map| map.tally()).map(PyTally::from)
    }

    /// Measure the mean information of the cells that scans have crossed: `tally().mean_information`.
    ///
    /// Returns
    /// -------
    /// float
    ///     In bits per observed cell.
    fn mean_information(&self, py: Python<'_>) -> PyResult<f64> {
        self.measured(py, |map| map.tally().mean_information())
    }

    /// Return the occupancies of the rectangle that scans have crossed, 1/2 where nothing is known.
    ///
    /// Returns
    /// -------
    /// ndarray of float64, shape (rows, columns)
    ///     Row 0 is the lowest, column 0 the leftmost; its lower left corner is at `origin`.
    fn probabilities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let grid = self.measured(py, |map| map.probabilities())?.map_err(refused)?;
        let cells = PyArray1::from_slice(py, grid.cells()).reshape([grid.height(), grid.width()])?;
        Ok(cells.into_any())
    }

    /// Lower left corner of the rectangle that scans have crossed: x and y in metres.
    #[getter]
    fn origin(&self, py: Python<'_>) -> PyResult<(f64, f64)> {
        self.now(py)?.geometry().map(|geometry| geometry.origin().into()).map_err(refused)
    }

    /// Agreement of the scans, in [0, 1]: the part of the readings' log-odds that do not contradict one another; None if the
    /// map does not keep it.
    #[getter]
    fn agreement(&self, py: Python<'_>) -> PyResult<Option<f64>> {
        self.now(py).map(|map| map.agreement())
    }

    /// Side of a cell, in metres.
    #[getter]
    fn resolution(&self, py: Python<'_>) -> PyResult<f64> {
        self.now(py).map(|map| map.resolution())
    }

    /// Number of scans that the map holds.
    #[getter]
    fn scans(&self, py: Python<'_>) -> PyResult<u64> {
        self.now(py).map(|map| map.scans())
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let map = self.now(py)?;
        Ok(format!("<ScanMap of {}, cells of {:?} m>", count(map.scans(), "scan"), map.resolution()))
    }

    /// A copy is a map of its own: what is inserted into one is not in the other.
    fn __copy__(&self, py: Python<'_>) -> PyResult<Self> {
        Ok(Self::of(self.now(py)?, self.sensor.clone_ref(py)))
    }

    fn __deepcopy__(&self, py: Python<'_>, memo: &Bound<'_, PyAny>) -> PyResult<Self> {
        let sensor = py.import("copy")?.call_method1("deepcopy", (&self.sensor, memo))?;
        Ok(Self::of(self.now(py)?, sensor.unbind()))
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
        Err(_) => match *floats("pose", given, Masked::Refused)?.as_array().to_vec() {
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
