//! Logs of range scans and trajectories, read.

use crate::errors::{count, in_python, of_file, one_of, refused};
use crate::interruptible::run;
use crate::pickled::{Made, made};
use crate::trajectory::{PyTrajectory, numbers};
use mean_information::scan::Pose;
use mean_information_files::bags::{bag_files, is_bag};
use mean_information_files::scans::{Bearings, Frame, RangeScan, Reading, ScanLog, ScanOptions, TimeField};
use mean_information_files::{Warning, read_scans_from, read_trajectory_from};
use mean_information_report::words::in_words;
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::path::PathBuf;

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
        format!("<ScanLog of {}>", count(self.scans.len() as u64, "scan"))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Made<'py, LogState>> {
        let scans = self.scans.iter().map(|scan| scan.clone_ref(py)).collect();
        made(py, "_scan_log", (scans, self.trajectories.clone_ref(py), self.mount, self.warnings.clone()))
    }
}

/// What pickle keeps of a log.
type LogState = (Vec<Py<PyRangeScan>>, Py<PyAny>, Option<(f64, f64, f64)>, Vec<String>);

/// Makes a log of what pickle has kept.
#[pyfunction]
pub(crate) fn _scan_log(
    scans: Vec<Py<PyRangeScan>>,
    trajectories: Py<PyAny>,
    mount: Option<(f64, f64, f64)>,
    warnings: Vec<String>,
) -> PyScanLog {
    PyScanLog { scans, trajectories, mount, warnings }
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
        let without = one_of("no_return", no_return, &[("left-out", f64::NAN), ("free", f64::INFINITY)])?;
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
        format!("<RangeScan of {} at {:?} s>", count(self.0.ranges().len() as u64, "beam"), self.0.time())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Made<'py, ScanState<'py>>> {
        let even = match *self.0.bearings() {
            Bearings::Even { start, increment } => Some((start, increment)),
            Bearings::Each(_) => None,
        };
        let bearings = even.is_none().then(|| self.bearings(py));
        let numbers = (self.0.time(), even, bearings, self.ranges(py));
        made(py, "_range_scan", (numbers, self.0.limits().into(), self.laser(), self.odometry()))
    }
}

/// The time, even bearings or others, and the ranges, as pickle keeps them.
type Numbers<A> = (f64, Option<(f64, f64)>, Option<A>, A);
/// What pickle keeps of a scan: numbers, least and greatest range, poses.
type ScanState<'py> =
    (Numbers<Bound<'py, PyArray1<f64>>>, (f64, f64), Option<(f64, f64, f64)>, Option<(f64, f64, f64)>);

/// Makes a scan of what pickle has kept.
#[pyfunction]
pub(crate) fn _range_scan(
    numbers: Numbers<Vec<f64>>,
    limits: (f64, f64),
    laser: Option<(f64, f64, f64)>,
    odometry: Option<(f64, f64, f64)>,
) -> PyResult<PyRangeScan> {
    let (time, even, bearings, ranges) = numbers;
    let bearings = match even {
        Some((start, increment)) => Bearings::Even { start, increment },
        None => Bearings::Each(bearings.unwrap_or_default().into()),
    };
    let pose = |(x, y, theta): (f64, f64, f64)| Pose::new(x, y, theta).map_err(refused);
    let mut scan = RangeScan::new(time, bearings, ranges, limits.into()).map_err(of_file)?;
    if let Some(laser) = laser {
        scan = scan.with_laser(pose(laser)?);
    }
    if let Some(odometry) = odometry {
        scan = scan.with_odometry(pose(odometry)?);
    }
    Ok(PyRangeScan(scan))
}

/// Returns warnings in words, with options as Python's arguments.
pub(crate) fn words(warnings: &[Warning]) -> Vec<String> {
    in_words(warnings).iter().map(|text| in_python(text)).collect()
}

/// Read a log of range scans: CARMEN's, `.log` or `.clf`, or the nodes of Cartographer's state, `.pbstream`.
///
/// Bags are refused: `read_bag` reads their maps, and the command ``meaninfo trajectory`` compares trajectories by their scans.
///
/// Parameters
/// ----------
/// path : path-like
///     The file.
/// max_range : float, optional
///     The greatest range in metres, from which on a number means no return; the file's own by default.
/// time : {"sent", "logged"}, optional
///     The field of a CARMEN message that has its time, "sent" by default; Cartographer's state has no such fields.
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
#[pyo3(signature = (path, *, max_range=None, time=None))]
pub(crate) fn read_scans(
    py: Python<'_>,
    path: PathBuf,
    max_range: Option<f64>,
    time: Option<&str>,
) -> PyResult<PyScanLog> {
    if is_bag(&path) {
        // A folder without one is refused as such.
        bag_files(&path).map_err(of_file)?;
        let words = "is a bag: read_bag reads its maps, and the command `meaninfo trajectory` its scans";
        return Err(PyValueError::new_err(format!("{}: {words}", path.display())));
    }
    let is_state = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("pbstream"));
    let time = match time {
        Some(time) if is_state => {
            let words = format!("{}: time is '{time}', which is for CARMEN logs", path.display());
            return Err(PyValueError::new_err(words));
        }
        time => {
            let named = [("sent", TimeField::Sent), ("logged", TimeField::Logged)];
            time.map_or(Ok(TimeField::Sent), |word| one_of("time", word, &named))?
        }
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
