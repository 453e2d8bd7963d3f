//! Inverse sensor models: the named ones, and functions of Python.

use crate::errors::refused;
use mean_information::Error;
use mean_information::sensor::{GaussianSensor, InverseSensorModel, SteppedSensor};
use mean_information_cli::trajectory::SensorModel;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use std::cell::RefCell;

/// The inverse sensor model of Eq. 5: a range read with Gaussian noise.
///
/// Parameters
/// ----------
/// sigma : float
///     The standard deviation of the sensor, in metres.
///
/// Examples
/// --------
/// >>> import mean_information as mi
/// >>> mi.GaussianSensor(0.2).occupancy(1.75, 2.0)
/// 0.4578333617716143
#[pyclass(frozen, get_all, eq, name = "GaussianSensor", module = "mean_information")]
#[derive(Clone, PartialEq)]
pub(crate) struct PyGaussianSensor {
    sigma: f64,
}

#[pymethods]
impl PyGaussianSensor {
    #[new]
    fn new(sigma: f64) -> PyResult<Self> {
        GaussianSensor::new(1.0, sigma).map_err(refused)?;
        Ok(Self { sigma })
    }

    /// Compute the occupancy of a point at `distance` metres by a reading of `range` metres.
    ///
    /// Returns
    /// -------
    /// float
    ///     Correctly rounded (proved).
    fn occupancy(&self, distance: f64, range: f64) -> PyResult<f64> {
        Ok(GaussianSensor::new(range, self.sigma).map_err(refused)?.occupancy(distance))
    }

    fn __repr__(&self) -> String {
        format!("GaussianSensor(sigma={})", self.sigma)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyAny>, (f64,)) {
        (slf.get_type().into_any(), (slf.get().sigma,))
    }
}

/// The inverse sensor model of steps: free up to the obstacle, occupied over its thickness, unknown behind it.
///
/// Parameters
/// ----------
/// thickness : float
///     The thickness of the obstacle, in metres, half of it before the range.
/// free, occupied : float
///     The occupancies of free space, in [0, 1/2], and of the obstacle, in [1/2, 1].
///
/// Examples
/// --------
/// >>> import mean_information as mi
/// >>> sensor = mi.SteppedSensor(thickness=0.5, free=0.25, occupied=0.875)
/// >>> [sensor.occupancy(distance, 2.0) for distance in (1.5, 1.75, 2.5)]
/// [0.25, 0.875, 0.5]
#[pyclass(frozen, get_all, eq, name = "SteppedSensor", module = "mean_information")]
#[derive(Clone, PartialEq)]
pub(crate) struct PySteppedSensor {
    thickness: f64,
    free: f64,
    occupied: f64,
}

#[pymethods]
impl PySteppedSensor {
    #[new]
    #[pyo3(signature = (thickness, free, occupied))]
    pub(crate) fn new(thickness: f64, free: f64, occupied: f64) -> PyResult<Self> {
        SteppedSensor::new(1.0, thickness, free, occupied).map_err(refused)?;
        Ok(Self { thickness, free, occupied })
    }

    /// Compute the occupancy of a point at `distance` metres by a reading of `range` metres.
    ///
    /// Returns
    /// -------
    /// float
    fn occupancy(&self, distance: f64, range: f64) -> PyResult<f64> {
        let sensor = SteppedSensor::new(range, self.thickness, self.free, self.occupied).map_err(refused)?;
        Ok(sensor.occupancy(distance))
    }

    fn __repr__(&self) -> String {
        let Self { thickness, free, occupied } = self;
        format!("SteppedSensor(thickness={thickness}, free={free}, occupied={occupied})")
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyAny>, (f64, f64, f64)) {
        let Self { thickness, free, occupied } = *slf.get();
        (slf.get_type().into_any(), (thickness, free, occupied))
    }
}

/// A model of readings.
pub(crate) enum Sensor<'py> {
    Named(SensorModel),
    Function(Function<'py>),
}

/// A model by functions of Python, and the first exception that one raised.
pub(crate) struct Function<'py> {
    occupancy: Bound<'py, PyAny>,
    reach: Bound<'py, PyAny>,
    raised: RefCell<Option<PyErr>>,
}

impl<'py> Sensor<'py> {
    /// Takes a named model, or any object with the methods `occupancy(distance, range)` and `reach(range)`.
    pub(crate) fn new(sensor: &Bound<'py, PyAny>) -> PyResult<Self> {
        if let Ok(gaussian) = sensor.cast::<PyGaussianSensor>() {
            return Ok(Self::Named(SensorModel::Gaussian { sigma: gaussian.get().sigma }));
        }
        if let Ok(stepped) = sensor.cast::<PySteppedSensor>() {
            let PySteppedSensor { thickness, free, occupied } = *stepped.get();
            return Ok(Self::Named(SensorModel::Stepped { free, occupied, thickness }));
        }
        match (sensor.getattr("occupancy"), sensor.getattr("reach")) {
            (Ok(occupancy), Ok(reach)) if occupancy.is_callable() && reach.is_callable() => {
                Ok(Self::Function(Function { occupancy, reach, raised: RefCell::new(None) }))
            }
            _ => Err(PyTypeError::new_err(format!(
                "sensor is {}, allowed are GaussianSensor, SteppedSensor, and objects with the methods \
                 occupancy(distance, range) and reach(range), all in metres",
                sensor.get_type().name()?
            ))),
        }
    }
}

impl Function<'_> {
    /// Calls a function, or notes what it raised and returns NaN.
    fn call(&self, function: &Bound<'_, PyAny>, arguments: &[f64]) -> f64 {
        if self.raised.borrow().is_some() {
            return f64::NAN;
        }
        let arguments = pyo3::types::PyTuple::new(function.py(), arguments);
        let result = arguments.and_then(|arguments| function.call1(arguments)).and_then(|x| x.extract());
        result.unwrap_or_else(|error| {
            self.raised.replace(Some(error));
            f64::NAN
        })
    }

    /// Returns the exception that a function raised, or `otherwise`.
    pub(crate) fn raised(&self, otherwise: Error) -> PyErr {
        self.raised.take().unwrap_or_else(|| refused(otherwise))
    }
}

/// A reading of a model by functions of Python.
pub(crate) struct FunctionReading<'a, 'py> {
    function: &'a Function<'py>,
    range: f64,
    reach: f64,
}

impl<'a, 'py> FunctionReading<'a, 'py> {
    pub(crate) fn new(function: &'a Function<'py>, range: f64) -> Self {
        Self { function, range, reach: function.call(&function.reach, &[range]) }
    }
}

impl InverseSensorModel for FunctionReading<'_, '_> {
    type Float = f64;

    fn occupancy(&self, rho: f64) -> f64 {
        self.function.call(&self.function.occupancy, &[rho, self.range])
    }

    fn reach(&self) -> f64 {
        self.reach
    }
}
