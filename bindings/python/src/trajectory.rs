//! Trajectories, read.

use crate::errors::{count, of_file, refused};
use crate::pickled::{Made, made};
use mean_information::scan::Pose;
use mean_information_files::Trajectory;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

/// Poses by their times.
///
/// Attributes
/// ----------
/// times : ndarray, shape (n,)
///     Seconds, ascending.
/// poses : ndarray, shape (n, 3)
///     x and y in metres, and the heading in radians.
/// warnings : list of str
///     Signs that the trajectory means less than it seems.
#[pyclass(frozen, name = "Trajectory", module = "mean_information")]
pub(crate) struct PyTrajectory {
    pub(crate) trajectory: Trajectory,
    #[pyo3(get)]
    pub(crate) warnings: Vec<String>,
}

#[pymethods]
impl PyTrajectory {
    #[getter]
    fn times<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.trajectory.times())
    }

    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let numbers = self.trajectory.poses().iter().flat_map(|pose| <[f64; 3]>::from(numbers(pose)));
        PyArray1::from_iter(py, numbers).reshape([self.trajectory.len(), 3])
    }

    /// Return the pose at a time: between two poses, the shorter way round.
    ///
    /// Parameters
    /// ----------
    /// time : float
    ///     Seconds.
    /// max_gap : float
    ///     The longest time between two poses that is bridged, in seconds.
    ///
    /// Returns
    /// -------
    /// tuple of float or None
    ///     x, y and heading; None beyond the ends and in longer gaps.
    #[pyo3(signature = (time, *, max_gap=1.0))]
    fn pose_at(&self, time: f64, max_gap: f64) -> Option<(f64, f64, f64)> {
        self.trajectory.pose_at(time, max_gap).as_ref().map(numbers)
    }

    fn __len__(&self) -> usize {
        self.trajectory.len()
    }

    fn __repr__(&self) -> String {
        let [first, last] = self.trajectory.span();
        format!(
            "<Trajectory of {} from {first:?} to {last:?} s>",
            count(self.trajectory.len() as u64, "pose")
        )
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Made<'py, State<'py>>> {
        made(py, "_trajectory", (self.times(py), self.poses(py)?, self.warnings.clone()))
    }
}

/// What pickle keeps of a trajectory.
type State<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray2<f64>>, Vec<String>);

/// Makes a trajectory of what pickle has kept.
#[pyfunction]
pub(crate) fn _trajectory(
    times: Vec<f64>,
    poses: Vec<[f64; 3]>,
    warnings: Vec<String>,
) -> PyResult<PyTrajectory> {
    let poses = poses.into_iter().map(|[x, y, theta]| Pose::new(x, y, theta).map_err(refused));
    let trajectory = Trajectory::new(times, poses.collect::<PyResult<_>>()?).map_err(of_file)?;
    Ok(PyTrajectory { trajectory, warnings })
}

/// Returns x, y and heading.
pub(crate) fn numbers(pose: &Pose) -> (f64, f64, f64) {
    let [x, y] = pose.position();
    (x, y, pose.theta())
}
