//! The command `meaninfo`, and the operations of the port protocol by their names.

use mean_information::Real;
use mean_information::operations::{self, Answer, OPERATIONS, Refusal, Shape, Value};
use pyo3::exceptions::{PyKeyError, PyOverflowError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::ffi::OsString;

/// Runs the command with these arguments, the first of which is its name. Returns the exit status.
#[pyfunction]
pub(crate) fn command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| mean_information_cli::run(arguments))
}

/// Lists the names of the operations of the port protocol.
#[pyfunction]
pub(crate) fn operation_names() -> Vec<&'static str> {
    OPERATIONS.iter().map(|operation| operation.name).collect()
}

/// Lists the names of the arguments of an operation.
#[pyfunction]
pub(crate) fn arguments_of(name: &str) -> PyResult<Vec<&'static str>> {
    let operation = operations::find(name).ok_or_else(|| PyKeyError::new_err(name.to_owned()))?;
    Ok(operation.arguments.iter().map(|argument| argument.name).collect())
}

/// Computes an operation of the port protocol by its name, in format "f64" or "f32"; the arguments in the order of the
/// operation. ``ValueError`` outside its domain, ``OverflowError`` if it would take too long.
#[pyfunction]
#[pyo3(signature = (name, format, /, *arguments))]
pub(crate) fn run_operation<'py>(
    py: Python<'py>,
    name: &str,
    format: &str,
    arguments: &Bound<'py, PyTuple>,
) -> PyResult<Bound<'py, PyAny>> {
    match format {
        "f32" => run::<f32>(py, name, arguments),
        "f64" => run::<f64>(py, name, arguments),
        _ => Err(PyValueError::new_err(format!("format is {format:?}, allowed are \"f32\" and \"f64\""))),
    }
}

/// Computes an operation in one format.
fn run<'py, T: Real + for<'a> FromPyObject<'a, 'py, Error = PyErr> + IntoPyObject<'py>>(
    py: Python<'py>,
    name: &str,
    arguments: &Bound<'py, PyTuple>,
) -> PyResult<Bound<'py, PyAny>> {
    let operation = operations::find(name).ok_or_else(|| PyKeyError::new_err(name.to_owned()))?;
    if operation.arguments.len() != arguments.len() {
        let (wanted, given) = (operation.arguments.len(), arguments.len());
        return Err(PyTypeError::new_err(format!("{name} takes {wanted} arguments, not {given}")));
    }
    let mut values = Vec::with_capacity(arguments.len());
    for (argument, given) in operation.arguments.iter().zip(arguments) {
        values.push(match argument.shape {
            Shape::Float => Value::Float(given.extract::<T>()?),
            Shape::List => Value::List(given.extract::<Vec<T>>()?),
            Shape::Rows => Value::Rows(given.extract::<Vec<Vec<T>>>()?),
            other => return Err(PyTypeError::new_err(format!("{name} takes a {}", other.name()))),
        });
    }
    match py.detach(|| operation.run(&values)) {
        Ok(Answer::Float(x)) => Ok(x.widen().into_pyobject(py)?.into_any()),
        Ok(Answer::Count(count)) => Ok(count.into_pyobject(py)?.into_any()),
        Err(Refusal::Domain(error)) => Err(PyValueError::new_err(error.to_string())),
        Err(Refusal::TooLarge(error)) => Err(PyOverflowError::new_err(error.to_string())),
        Ok(_) => Err(PyTypeError::new_err("a result of another kind")),
        Err(_) => Err(PyTypeError::new_err("arguments of other shapes")),
    }
}
