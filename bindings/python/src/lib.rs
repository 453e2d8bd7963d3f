//! The native module of the Python package `mean_information`: the library on NumPy's arrays, the readers of files, and the
//! command. Nothing is computed here.
//!
//! | module | holds |
//! |---|---|
//! | `errors` | refusals as Python's exceptions |
//! | `pickled` | how plain data travels by pickle |
//! | `long_work` | work without the interpreter, which Ctrl-C ends |
//! | `cells` | cells of arrays, in pieces |
//! | `encodings` | encodings by their names |
//! | `axes` | many maps in one array |
//! | `tally` | tallies, and arrays measured |
//! | `expected` | the expected map of a filter's particles |
//! | `limit` | the limit of the mean information |
//! | `sensors` | inverse sensor models |
//! | `readings` | lists of numbers of a scan, whose masks are kept |
//! | `scan_map` | maps from range scans |
//! | `interruptible` | a disk whose files Ctrl-C closes |
//! | `trajectory` | trajectories, read |
//! | `scans` | logs of scans, read |
//! | `maps` | maps, read |
//! | `bag` | the maps of a bag, measured |
//! | `ufuncs` | functions of a cell as NumPy's ufuncs |
//! | `command` | the command `meaninfo`, and the operations of ports |

mod axes;
mod bag;
mod cells;
mod command;
mod encodings;
mod errors;
mod expected;
mod interruptible;
mod limit;
mod long_work;
mod maps;
mod pickled;
mod readings;
mod scan_map;
mod scans;
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
    use super::expected::{_expected_map, PyExpectedMap, expected_map};

    #[pymodule_export]
    use super::bag::{_bag_map, PyBagMap, read_bag};

    #[pymodule_export]
    use super::maps::{_map, PyMap, no_use, read_map, type_of_array};

    #[pymodule_export]
    use super::scans::{_range_scan, _scan_log, PyRangeScan, PyScanLog, read_scans, read_trajectory};

    #[pymodule_export]
    use super::limit::{_limit, PyLimit, limit_of};

    #[pymodule_export]
    use super::scan_map::PyScanMap;

    #[pymodule_export]
    use super::sensors::{PyGaussianSensor, PySteppedSensor};

    #[pymodule_export]
    use super::tally::{PyTally, mean_of, tally_of};

    #[pymodule_export]
    use super::trajectory::{_trajectory, PyTrajectory};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        ufuncs::add_to(module)
    }
}
