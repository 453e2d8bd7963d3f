//! Lists of numbers of a scan, as NumPy takes them, whose masks are kept.

use crate::errors::count;
use numpy::PyReadonlyArray1;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::intern;
use pyo3::prelude::*;

/// What masked numbers of a masked array become.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Masked {
    /// NaN, which leaves a beam out.
    Nan,
    Refused,
}

/// Takes a list of numbers as floats, as NumPy does; `name` is that of the argument.
///
/// # Errors
/// `TypeError` and `ValueError` for what are no numbers, complex ones, and masked ones that may not be.
pub(crate) fn floats<'py>(
    name: &str,
    list: &Bound<'py, PyAny>,
    masked: Masked,
) -> PyResult<PyReadonlyArray1<'py, f64>> {
    let py = list.py();
    let named = |error: PyErr| {
        let words = format!("{name}: {}", error.value(py));
        if error.is_instance_of::<PyTypeError>(py) {
            PyTypeError::new_err(words)
        } else {
            PyValueError::new_err(words)
        }
    };
    let numpy = py.import(intern!(py, "numpy"))?;
    let float = |array: &Bound<'py, PyAny>| numpy.call_method1(intern!(py, "asarray"), (array, "float64"));
    let mut array = numpy.call_method1(intern!(py, "asarray"), (list,)).map_err(named)?;
    // NumPy would drop the imaginary parts with a warning.
    if array.getattr(intern!(py, "dtype"))?.getattr(intern!(py, "kind"))?.eq("c")? {
        return Err(PyTypeError::new_err(format!("{name} has complex numbers, allowed are real ones")));
    }
    array = float(&array).map_err(named)?;
    let ma = numpy.getattr(intern!(py, "ma"))?;
    if ma.call_method1(intern!(py, "is_masked"), (list,))?.is_truthy()? {
        if masked == Masked::Refused {
            return Err(PyTypeError::new_err(format!(
                "{name} has masked numbers, which are unknown; allowed are masked ranges, whose beams are left out"
            )));
        }
        let mask = ma.call_method1(intern!(py, "getmaskarray"), (list,))?;
        array = numpy.call_method1(intern!(py, "where"), (mask, f64::NAN, array))?;
    }
    let dimensions: usize = array.getattr("ndim")?.extract()?;
    array.extract().map_err(|_| {
        let words = format!(
            "{name} has {}, allowed is one dimension: a list of numbers",
            count(dimensions as u64, "dimension")
        );
        PyValueError::new_err(words)
    })
}
