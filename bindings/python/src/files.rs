//! Files of the field, read.

use crate::errors::{in_python, of_file};
use crate::interruptible::run;
use crate::limit::choice;
use crate::long_work::watched;
use crate::tally::PyTally;
use crate::trajectory::{PyTrajectory, numbers};
use mean_information_files::scans::{Bearings, Frame, RangeScan, ScanLog, ScanOptions, TimeField};
use mean_information_files::{
    ArrayEncoding, Cells, Map, Mode, Options, Semantics, Warning, bags, read_map_from, read_scans_from,
    read_trajectory_from, with_grid,
};
use mean_information_report::words::in_words;
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
///     Signs that the map means less than it seems.
#[pyclass(frozen, get_all, name = "Map", module = "mean_information")]
pub(crate) struct PyMap {
    cells: Py<PyAny>,
    encoding: &'static str,
    resolution: Option<f64>,
    origin: (f64, f64),
    tally: Py<PyTally>,
    warnings: Vec<String>,
}

#[pymethods]
impl PyMap {
    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let shape = self.cells.bind(py).getattr("shape")?;
        let tally = self.tally.bind(py).repr()?;
        Ok(format!("<Map of shape {shape}, {}: {tally}>", self.encoding))
    }
}

/// A log of range scans.
///
/// Attributes
/// ----------
/// scans : list of RangeScan
///     The scans, by their times.
/// trajectories : dict of str to Trajectory
///     The trajectories that the log holds, as poses of the laser: of a CARMEN log "laser" and "odometry".
/// mount : tuple of float or None
///     x, y and heading of the laser in the frame of the robot, where the log says so.
/// warnings : list of str
///     Signs that the log means less than it seems.
#[pyclass(frozen, get_all, name = "ScanLog", module = "mean_information")]
pub(crate) struct PyScanLog {
    scans: Vec<Py<PyRangeScan>>,
    trajectories: Py<PyAny>,
    mount: Option<(f64, f64, f64)>,
    warnings: Vec<String>,
}

#[pymethods]
impl PyScanLog {
    fn __repr__(&self) -> String {
        format!("<ScanLog of {} scans>", self.scans.len())
    }
}

/// A scan as a log has it: for ``ScanMap.insert(pose, scan.bearings, scan.beams(), max_range=scan.max_range)``.
///
/// Attributes
/// ----------
/// time : float
///     Seconds.
/// bearings : ndarray, shape (n,)
///     The directions of the beams from the heading, in radians, counter-clockwise.
/// ranges : ndarray, shape (n,)
///     What the file has, in metres.
/// min_range, max_range : float
///     The least and the greatest range of the sensor, in metres.
/// laser, odometry : tuple of float or None
///     x, y and heading of the laser, and of the robot by its odometry, where the log has them.
#[pyclass(frozen, name = "RangeScan", module = "mean_information")]
pub(crate) struct PyRangeScan(RangeScan);

#[pymethods]
impl PyRangeScan {
    #[getter]
    fn time(&self) -> f64 {
        self.0.time()
    }

    #[getter]
    fn bearings<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let bearings: Vec<f64> = match self.0.bearings() {
            Bearings::Each(bearings) => bearings.to_vec(),
            even @ Bearings::Even { .. } => (0..self.0.ranges().len()).map(|index| even.at(index)).collect(),
        };
        PyArray1::from_vec(py, bearings)
    }

    #[getter]
    fn ranges<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.0.ranges())
    }

    /// Return the ranges as `ScanMap.insert` takes them: NaN for a beam that says nothing, and for one that did not return
    /// unless `no_return` is "free".
    ///
    /// Parameters
    /// ----------
    /// no_return : {"left-out", "free"}
    ///     What a beam that did not return means: nothing, as glass and dark surfaces do not return either, or free space up to
    ///     the greatest range.
    ///
    /// Returns
    /// -------
    /// ndarray of float64, shape (n,)
    #[pyo3(signature = (*, no_return="left-out"))]
    fn beams<'py>(&self, py: Python<'py>, no_return: &str) -> PyResult<Bound<'py, PyArray1<f64>>> {
        use mean_information_files::scans::Reading;
        let without = match no_return {
            "left-out" => f64::NAN,
            "free" => f64::INFINITY,
            _ => return Err(choice("no_return", no_return, "'left-out' and 'free'")),
        };
        let ranges = self.0.readings().map(|reading| match reading {
            Reading::Return(range) => range,
            Reading::NoReturn => without,
            Reading::Invalid => f64::NAN,
        });
        Ok(PyArray1::from_vec(py, ranges.collect()))
    }

    #[getter]
    fn min_range(&self) -> f64 {
        self.0.limits()[0]
    }

    #[getter]
    fn max_range(&self) -> f64 {
        self.0.limits()[1]
    }

    #[getter]
    fn laser(&self) -> Option<(f64, f64, f64)> {
        self.0.laser().map(numbers)
    }

    #[getter]
    fn odometry(&self) -> Option<(f64, f64, f64)> {
        self.0.odometry().map(numbers)
    }

    fn __repr__(&self) -> String {
        format!("<RangeScan of {} beams at {} s>", self.0.ranges().len(), self.0.time())
    }
}

/// Returns warnings in words, with options as Python's arguments.
fn words(warnings: &[Warning]) -> Vec<String> {
    in_words(warnings).iter().map(|text| in_python(text)).collect()
}

/// Read a map: a ROS yaml with its image, an array of NumPy, MRPT's grid map, the last map of a bag.
///
/// Parameters
/// ----------
/// path : path-like
///     `.yaml`, `.npy`, `.npz` (``FILE.npz:KEY``), `.gridmap`, `.gridmap.gz`, `.mcap`, `.db3`, `.bag`.
/// semantics : {"nav2", "nav2-humble", "ros1"}
///     The loader whose rules turn the grey levels of a ROS map into percentages.
/// mode : {"trinary", "scale", "raw", "probability"}, optional
///     How grey levels are meant; the file's own mode by default.
/// unknown : float, optional
///     The value that means unknown: a grey level with mode "probability", or a number of an array of floats.
/// encoding : {"probability", "percent", "log-odds", "mrpt"}, optional
///     What the numbers of an `.npy` array are; by default floats are probabilities and int8 percentages.
/// resolution : float, optional
///     The side of a cell of an `.npy` array, in metres.
/// max_cells : int, optional
///     Larger maps are refused before any cell is read; 2**28 by default.
///
/// Returns
/// -------
/// Map
///
/// Raises
/// ------
/// FileNotFoundError, OSError
///     If the file cannot be read.
/// MemoryError
///     If the map is too large.
/// ValueError
///     If the file is damaged, or no map; in the words of the command.
#[pyfunction]
#[pyo3(signature = (path, *, semantics="nav2", mode=None, unknown=None, encoding=None, resolution=None, max_cells=None))]
#[expect(clippy::too_many_arguments, reason = "the options of the command")]
pub(crate) fn read_map(
    py: Python<'_>,
    path: PathBuf,
    semantics: &str,
    mode: Option<&str>,
    unknown: Option<f64>,
    encoding: Option<&str>,
    resolution: Option<f64>,
    max_cells: Option<u64>,
) -> PyResult<PyMap> {
    let semantics = match semantics {
        "nav2" => Semantics::Nav2,
        "nav2-humble" => Semantics::Nav2Humble,
        "ros1" => Semantics::Ros1,
        _ => return Err(choice("semantics", semantics, "'nav2', 'nav2-humble' and 'ros1'")),
    };
    let mode = match mode {
        None => None,
        Some("trinary") => Some(Mode::Trinary),
        Some("scale") => Some(Mode::Scale),
        Some("raw") => Some(Mode::Raw),
        Some("probability") => Some(Mode::Probability),
        Some(mode) => return Err(choice("mode", mode, "'trinary', 'scale', 'raw' and 'probability'")),
    };
    let encoding = match encoding {
        None => None,
        Some("probability") => Some(ArrayEncoding::Probability),
        Some("percent") => Some(ArrayEncoding::Percent),
        Some("log-odds") => Some(ArrayEncoding::LogOdds),
        Some("mrpt") => Some(ArrayEncoding::Mrpt),
        Some(encoding) => {
            return Err(choice("encoding", encoding, "'probability', 'percent', 'log-odds' and 'mrpt'"));
        }
    };
    let options = Options { semantics, mode, unknown, encoding, resolution, max_cells };
    let map = if bags::is_bag(&path) {
        watched(py, move || mean_information_files::read_map(&path, &options))?.map_err(of_file)?
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
    let (cells, tally) = watched(py, move || {
        let tally = with_grid!(&cells, grid => PyTally::from(grid.tally()));
        (cells, tally)
    })?;
    let (array, origin) = with_grid!(&cells, grid => {
        let array = PyArray1::from_slice(py, grid.cells()).reshape([grid.height(), grid.width()])?;
        (array.into_any().unbind(), grid.geometry().origin().into())
    });
    let (tally, warnings) = (Py::new(py, tally)?, words(&warnings));
    Ok(PyMap { cells: array, encoding, resolution, origin, tally, warnings })
}

/// Read a log of range scans: CARMEN's, `.log` or `.clf`.
///
/// Parameters
/// ----------
/// path : path-like
///     The file.
/// max_range : float, optional
///     The greatest range in metres, from which on a number means no return; the file's own by default.
/// time : {"sent", "logged"}
///     The field of a message that has its time.
///
/// Returns
/// -------
/// ScanLog
///
/// Raises
/// ------
/// FileNotFoundError, OSError, MemoryError, ValueError
///     As `read_map`.
#[pyfunction]
#[pyo3(signature = (path, *, max_range=None, time="sent"))]
pub(crate) fn read_scans(
    py: Python<'_>,
    path: PathBuf,
    max_range: Option<f64>,
    time: &str,
) -> PyResult<PyScanLog> {
    let time = match time {
        "sent" => TimeField::Sent,
        "logged" => TimeField::Logged,
        _ => return Err(choice("time", time, "'sent' and 'logged'")),
    };
    let options = ScanOptions { maximum_range: max_range, time };
    let log = run(py, |source| read_scans_from(source, &path, &options))?;
    let ScanLog { scans, trajectories, mount, warnings, .. } = log;
    let held = pyo3::types::PyDict::new(py);
    for recorded in trajectories {
        let trajectory = match (recorded.frame, &mount) {
            (Frame::Robot, Some(mount)) => recorded.trajectory.mounted(mount).map_err(of_file)?,
            _ => recorded.trajectory,
        };
        let trajectory = PyTrajectory { trajectory, warnings: words(&recorded.warnings) };
        held.set_item(recorded.name, Py::new(py, trajectory)?)?;
    }
    let scans = scans.into_iter().map(|scan| Py::new(py, PyRangeScan(scan))).collect::<PyResult<_>>()?;
    let mount = mount.as_ref().map(numbers);
    Ok(PyScanLog { scans, trajectories: held.into_any().unbind(), mount, warnings: words(&warnings) })
}

/// Read a trajectory: TUM text, ``time x y z qx qy qz qw``, as evo reads it.
///
/// Parameters
/// ----------
/// path : path-like
///     The file.
///
/// Returns
/// -------
/// Trajectory
///
/// Raises
/// ------
/// FileNotFoundError, OSError, MemoryError, ValueError
///     As `read_map`.
#[pyfunction]
pub(crate) fn read_trajectory(py: Python<'_>, path: PathBuf) -> PyResult<PyTrajectory> {
    let (trajectory, warnings) = run(py, |source| read_trajectory_from(source, &path))?;
    Ok(PyTrajectory { trajectory, warnings: words(&warnings) })
}
