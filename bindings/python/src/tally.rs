//! Tallies: the class, and arrays measured.

use crate::axes::along;
use crate::cells::Chosen;
use crate::encodings::{Array, with_encoding};
use crate::errors::refused;
use crate::long_work::Steps;
use mean_information::tally::format_of_bytes;
use mean_information::{InformationSum, Real, Tally};
use mean_information_report::Measures;
use numpy::{Element, PyArrayDescr, PyArrayDescrMethods, PyArrayDyn, PyReadonlyArrayDyn, dtype};
use pyo3::exceptions::{PyOverflowError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyString, PyType};
use std::hash::{DefaultHasher, Hash, Hasher};

/// A tally in either format.
#[derive(Clone, PartialEq)]
pub(crate) enum Either {
    Single(Tally<f32>),
    Double(Tally<f64>),
}

/// A float that tallies are in.
pub(crate) trait Format: Real + Element {
    fn either(tally: Tally<Self>) -> Either;
}

impl Format for f32 {
    fn either(tally: Tally<Self>) -> Either {
        Either::Single(tally)
    }
}

impl Format for f64 {
    fn either(tally: Tally<Self>) -> Either {
        Either::Double(tally)
    }
}

/// Runs the same code on a tally in either format.
macro_rules! with_tally {
    ($either:expr, $tally:ident => $body:expr) => {
        match $either {
            Either::Single($tally) => $body,
            Either::Double($tally) => $body,
        }
    };
}

/// The sums over the cells of a map, exact: entropy, information, and how many cells are unknown, free and occupied.
///
/// Tallies of parts add up, in any order, to the tally of the whole, bit for bit. They are immutable, compare and hash by
/// their sums, and travel as `bytes` (`to_bytes`) or by pickle.
///
/// Parameters
/// ----------
/// dtype : {float64, float32}, optional
///     The precision of the cells of this empty tally: a type or its name; `tally` makes tallies of cells.
///
/// Examples
/// --------
/// >>> import mean_information as mi
/// >>> whole = mi.tally([0.25, 0.5, 0.96875])
/// >>> whole.observed, whole.mean_information
/// (2, 0.49404977561407626)
/// >>> sum([mi.tally([0.25]), mi.tally([0.5, 0.96875])]) == whole
/// True
#[pyclass(frozen, name = "Tally", module = "mean_information", eq)]
#[derive(Clone, PartialEq)]
pub(crate) struct PyTally(pub(crate) Either);

impl<T: Format> From<Tally<T>> for PyTally {
    fn from(tally: Tally<T>) -> Self {
        Self(T::either(tally))
    }
}

impl Either {
    fn bytes(&self) -> [u8; mean_information::tally::TALLY_BYTES] {
        with_tally!(self, tally => tally.to_bytes())
    }
}

#[pymethods]
impl PyTally {
    #[new]
    #[pyo3(signature = (dtype=None))]
    fn new(py: Python<'_>, dtype: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let Some(given) = dtype else { return Ok(Tally::<f64>::new().into()) };
        // A type or its name. NumPy would take anything that has a type, a scalar or a column of numbers, too.
        let of_cells = || {
            let words = "Tally() makes an empty tally, and takes a dtype; tally(cells) measures an array";
            PyTypeError::new_err(words)
        };
        let is_type = given.is_instance_of::<PyType>()
            || given.is_instance_of::<PyString>()
            || given.is_instance_of::<PyArrayDescr>();
        if !is_type {
            return Err(of_cells());
        }
        let found = PyArrayDescr::new(py, given).map_err(|_| of_cells())?;
        if found.is_equiv_to(&numpy::dtype::<f64>(py)) {
            Ok(Tally::<f64>::new().into())
        } else if found.is_equiv_to(&numpy::dtype::<f32>(py)) {
            Ok(Tally::<f32>::new().into())
        } else {
            Err(PyValueError::new_err(format!("dtype is {found}, allowed are float64 and float32")))
        }
    }

    /// Entropy of all cells in bits, Eq. 2; 1 bit for each unknown cell. Within 1.5 ulp of the exact one (proved).
    #[getter]
    fn entropy(&self) -> f64 {
        with_tally!(&self.0, tally => tally.entropy().widen())
    }

    /// Information of all cells in bits, Eq. 3. Within 1.5 ulp of the exact one (proved).
    #[getter]
    fn information(&self) -> f64 {
        with_tally!(&self.0, tally => tally.information().widen())
    }

    /// Mean information in bits per observed cell, Eq. 4; 0.0 if no cell is observed, where the command prints none: see
    /// `meaningful`. Within 1.5 ulp of the exact one (proved).
    #[getter]
    pub(crate) fn mean_information(&self) -> f64 {
        with_tally!(&self.0, tally => tally.mean_information().widen())
    }

    /// Number of observed cells: those whose occupancy is not 1/2.
    #[getter]
    fn observed(&self) -> u64 {
        with_tally!(&self.0, tally => tally.observed())
    }

    /// Number of unknown cells: those whose occupancy is 1/2 exactly.
    #[getter]
    fn unknown(&self) -> u64 {
        with_tally!(&self.0, tally => tally.unknown())
    }

    /// Number of cells whose occupancy is below 1/2.
    #[getter]
    fn free(&self) -> u64 {
        with_tally!(&self.0, tally => tally.free())
    }

    /// Number of cells whose occupancy is above 1/2.
    #[getter]
    fn occupied(&self) -> u64 {
        with_tally!(&self.0, tally => tally.occupied())
    }

    /// Number of all cells.
    #[getter]
    fn cells(&self) -> u64 {
        with_tally!(&self.0, tally => tally.cells())
    }

    /// True if the mean information means something: not if no cell is observed, or if all that are have an occupancy of 0 or 1,
    /// as thresholded maps do, whose mean information is 1 whatever they show.
    #[getter]
    fn meaningful(&self) -> bool {
        with_tally!(&self.0, tally => Measures::of_tally([0; 2], tally).not_meaningful.is_none())
    }

    /// Precision that cells were rounded to, and that results are: float64 or float32. Results are Python floats, which hold
    /// either exactly.
    #[getter]
    fn dtype<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDescr> {
        match &self.0 {
            Either::Single(_) => dtype::<f32>(py),
            Either::Double(_) => dtype::<f64>(py),
        }
    }

    /// Write the tally as 324 bytes, the same from every language and on every machine; equal tallies have equal bytes.
    ///
    /// Returns
    /// -------
    /// bytes
    ///     For `Tally.from_bytes`. The format is told in the book, in its chapter "The bytes of a tally".
    ///
    /// Examples
    /// --------
    /// >>> import mean_information as mi
    /// >>> len(mi.tally([0.25, 0.5]).to_bytes())
    /// 324
    fn to_bytes<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.0.bytes())
    }

    /// Read a tally from the bytes that `to_bytes` wrote.
    ///
    /// Parameters
    /// ----------
    /// data : bytes-like
    ///     324 bytes.
    ///
    /// Returns
    /// -------
    /// Tally
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If they are no tally's, damaged, of a later version, or of sums and counts that no cells have.
    ///
    /// Examples
    /// --------
    /// >>> import mean_information as mi
    /// >>> tally = mi.tally([0.25, 0.5])
    /// >>> mi.Tally.from_bytes(tally.to_bytes()) == tally
    /// True
    #[classmethod]
    #[pyo3(signature = (data, /))]
    fn from_bytes(_class: &Bound<'_, PyType>, data: &Bound<'_, PyAny>) -> PyResult<Self> {
        // A buffer of any kind, as bytes; `bytes(324)` would be zeros.
        let data = if let Ok(data) = data.cast::<PyBytes>() {
            data.clone()
        } else {
            let view = data.py().import("builtins")?.getattr("memoryview")?.call1((data,))?;
            view.call_method0("tobytes")?.cast_into::<PyBytes>()?
        };
        let data = data.as_bytes();
        match format_of_bytes(data).map_err(refused)? {
            f32::FORMAT => Tally::<f32>::from_bytes(data).map(Self::from),
            _ => Tally::<f64>::from_bytes(data).map(Self::from),
        }
        .map_err(refused)
    }

    fn __add__(&self, other: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        let py = other.py();
        let Ok(other) = other.cast::<Self>() else { return Ok(py.NotImplemented()) };
        if self.cells().checked_add(other.get().cells()).is_none() {
            return Err(PyOverflowError::new_err("a tally holds at most 2^64 - 1 cells"));
        }
        let mut sum = self.0.clone();
        match (&mut sum, &other.get().0) {
            (Either::Single(sum), Either::Single(other)) => sum.merge(other),
            (Either::Double(sum), Either::Double(other)) => sum.merge(other),
            _ => {
                return Err(PyTypeError::new_err(
                    "tallies of float32 and of float64 cells do not add up: their cells are rounded differently",
                ));
            }
        }
        Ok(Py::new(py, Self(sum))?.into_any())
    }

    /// The 0 that `sum()` begins with.
    fn __radd__(slf: Bound<'_, Self>, other: &Bound<'_, PyAny>) -> Py<PyAny> {
        match other.extract::<u8>() {
            Ok(0) => slf.into_any().unbind(),
            _ => slf.py().NotImplemented(),
        }
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.0.bytes().hash(&mut hasher);
        hasher.finish()
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        let from_bytes = slf.get_type().getattr("from_bytes")?;
        Ok((from_bytes, (slf.get().to_bytes(slf.py()),)))
    }

    fn __repr__(&self) -> String {
        let [observed, unknown, free, occupied] =
            [self.observed(), self.unknown(), self.free(), self.occupied()];
        with_tally!(&self.0, tally => format!(
            "<Tally: {:?} bits per observed cell; {observed} observed ({free} free, {occupied} occupied), {unknown} unknown>",
            tally.mean_information(),
        ))
    }
}

/// Measure the cells of an array, which `_arrays.py` has prepared.
#[pyfunction]
#[pyo3(name = "tally")]
pub(crate) fn tally_of(
    py: Python<'_>,
    cells: &Bound<'_, PyAny>,
    encoding: &str,
    mask: Option<PyReadonlyArrayDyn<'_, u8>>,
) -> PyResult<PyTally> {
    let mask = mask.as_ref().map(PyReadonlyArrayDyn::as_array);
    with_encoding!(Array::new(cells, encoding)?, cells, Encoding_ => {
        let chosen = Chosen { cells: cells.as_array(), mask };
        let measured = py.detach(|| {
            let sums = chosen.measure::<Encoding_, Tally<_>>(&mut Steps::default());
            sums.map_err(|stop| chosen.refusal::<Encoding_>(stop))
        });
        measured.map(PyTally::from)
    })
}

/// Compute the mean information along axes of an array, which `_arrays.py` has prepared; of all cells without axes.
#[pyfunction]
#[pyo3(name = "mean_information")]
pub(crate) fn mean_of<'py>(
    py: Python<'py>,
    cells: &Bound<'py, PyAny>,
    encoding: &str,
    axes: Option<Vec<usize>>,
    mask: Option<PyReadonlyArrayDyn<'py, u8>>,
) -> PyResult<Bound<'py, PyAny>> {
    let mask = mask.as_ref().map(PyReadonlyArrayDyn::as_array);
    with_encoding!(Array::new(cells, encoding)?, cells, Encoding_ => {
        let chosen = Chosen { cells: cells.as_array(), mask };
        let Some(axes) = axes else {
            let sum = py.detach(|| {
                let sum = chosen.measure::<Encoding_, InformationSum<_>>(&mut Steps::default());
                sum.map_err(|stop| chosen.refusal::<Encoding_>(stop))
            })?;
            return Ok(sum.mean().widen().into_pyobject(py)?.into_any());
        };
        let means = py.detach(|| along::<Encoding_>(&chosen, &axes))?;
        Ok(PyArrayDyn::from_owned_array(py, means).into_any())
    })
}
