//! The native module of the Python package `mean_information`: the library on NumPy's arrays, the readers of files, and the
//! command. Nothing is computed here.
//!
//! | module | holds |
//! |---|---|
//! | `errors` | refusals as Python's exceptions |
//! | `long_work` | work without the interpreter, which Ctrl-C ends |
//! | `cells` | cells of arrays, in pieces |
//! | `encodings` | encodings by their names |
//! | `tally` | tallies, and arrays measured |
//! | `expected` | the expected map of a filter's particles |
//! | `limit` | the limit of the mean information |
//! | `sensors` | inverse sensor models |
//! | `scan_map` | maps from range scans |
//! | `interruptible` | a disk whose files Ctrl-C closes |
//! | `trajectory` | trajectories, read |
//! | `files` | files of the field, read |
//! | `ufuncs` | functions of a cell as NumPy's ufuncs |
//! | `command` | the command `meaninfo`, and the operations of ports |

mod cells;
mod command;
mod encodings;
mod errors;
mod expected;
mod files;
mod interruptible;
mod limit;
mod long_work;
mod scan_map;
mod sensors;
mod tally;
mod trajectory;
mod ufuncs;

use pyo3::prelude::*;

/// The compiled part of `mean_information`.
#[pymodule(gil_used = false)]
mod _native {
    use super::ufuncs;
    use pyo3::prelude::*;

    #[pymodule_export]
    use super::command::{arguments_of, command, operation_names, run_operation};

    #[pymodule_export]
    use super::expected::{PyExpectedMap, expected_map};

    #[pymodule_export]
    use super::files::{PyMap, PyRangeScan, PyScanLog, read_map, read_scans, read_trajectory};

    #[pymodule_export]
    use super::limit::{PyLimit, limit_of};

    #[pymodule_export]
    use super::scan_map::PyScanMap;

    #[pymodule_export]
    use super::sensors::{PyGaussianSensor, PySteppedSensor};

    #[pymodule_export]
    use super::tally::{PyTally, mean_of, tally_of};

    #[pymodule_export]
    use super::trajectory::PyTrajectory;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        ufuncs::add_to(module)
    }
}
