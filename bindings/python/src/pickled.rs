//! How plain data travels by pickle, and is copied: the name of the function that makes it again, and its arguments.

use pyo3::prelude::*;

/// What `__reduce__` returns.
pub(crate) type Made<'py, T> = (Bound<'py, PyAny>, T);

/// Returns a function of the compiled part with its arguments.
pub(crate) fn made<'py, T>(py: Python<'py>, function: &str, arguments: T) -> PyResult<Made<'py, T>> {
    Ok((py.import("mean_information._native")?.getattr(function)?, arguments))
}
