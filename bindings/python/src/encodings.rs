//! Encodings by their names, for arrays of the element types that they have.

use numpy::PyReadonlyArrayDyn;
use pyo3::prelude::*;

/// An array of cells in an encoding. `_arrays.py` has chosen the element type before; what comes here otherwise is refused by
/// PyO3.
pub(crate) enum Array<'py> {
    Probability32(PyReadonlyArrayDyn<'py, f32>),
    Probability64(PyReadonlyArrayDyn<'py, f64>),
    LogOdds32(PyReadonlyArrayDyn<'py, f32>),
    LogOdds64(PyReadonlyArrayDyn<'py, f64>),
    Percent(PyReadonlyArrayDyn<'py, i8>),
    Mrpt(PyReadonlyArrayDyn<'py, i8>),
}

impl<'py> Array<'py> {
    /// Takes an array whose cells are in the encoding of that name.
    pub(crate) fn new(cells: &Bound<'py, PyAny>, encoding: &str) -> PyResult<Self> {
        Ok(match encoding {
            "percent" => Self::Percent(cells.extract()?),
            "mrpt" => Self::Mrpt(cells.extract()?),
            "log-odds" => match cells.extract() {
                Ok(cells) => Self::LogOdds32(cells),
                Err(_) => Self::LogOdds64(cells.extract()?),
            },
            _ => match cells.extract() {
                Ok(cells) => Self::Probability32(cells),
                Err(_) => Self::Probability64(cells.extract()?),
            },
        })
    }
}

/// Runs the same code on an array whatever its encoding, which is named `$encoding` there.
macro_rules! with_encoding {
    ($array:expr, $cells:ident, $encoding:ident => $body:expr) => {
        match $array {
            Array::Probability32($cells) => with_encoding!(@ mean_information::map::encoding::Probability<f32>, $encoding, $body),
            Array::Probability64($cells) => with_encoding!(@ mean_information::map::encoding::Probability<f64>, $encoding, $body),
            Array::LogOdds32($cells) => with_encoding!(@ mean_information::map::encoding::LogOdds<f32>, $encoding, $body),
            Array::LogOdds64($cells) => with_encoding!(@ mean_information::map::encoding::LogOdds<f64>, $encoding, $body),
            Array::Percent($cells) => with_encoding!(@ mean_information::map::encoding::Percent, $encoding, $body),
            Array::Mrpt($cells) => with_encoding!(@ mean_information::map::encoding::MrptLogOdds, $encoding, $body),
        }
    };
    (@ $type:ty, $encoding:ident, $body:expr) => {{
        type $encoding = $type;
        $body
    }};
}
pub(crate) use with_encoding;
