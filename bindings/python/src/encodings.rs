//! Encodings by their names, for arrays of the element types that they have.

use mean_information::cell::Cell;
use mean_information::map::encoding::{LogOdds, MrptLogOdds, Percent, Probability};
use mean_information::map::{Encoding, Histogram};
use mean_information::{InformationSum, Real, Tally, elementwise};
use numpy::PyReadonlyArrayDyn;
use pyo3::prelude::*;
use std::sync::LazyLock;

/// An array of cells in an encoding. `_arrays.py` has chosen the element type before; what comes here otherwise is refused by
/// PyO3.
pub(crate) enum Array<'py> {
    Probability32(PyReadonlyArrayDyn<'py, f32>),
    Probability64(PyReadonlyArrayDyn<'py, f64>),
    LogOdds32(PyReadonlyArrayDyn<'py, f32>),
    LogOdds64(PyReadonlyArrayDyn<'py, f64>),
    Percent(PyReadonlyArrayDyn<'py, i8>),
    UnsignedPercent(PyReadonlyArrayDyn<'py, u8>),
    Mrpt(PyReadonlyArrayDyn<'py, i8>),
}

impl<'py> Array<'py> {
    /// Takes an array whose cells are in the encoding of that name.
    pub(crate) fn new(cells: &Bound<'py, PyAny>, encoding: &str) -> PyResult<Self> {
        Ok(match encoding {
            "percent" => match cells.extract() {
                Ok(cells) => Self::Percent(cells),
                Err(_) => Self::UnsignedPercent(cells.extract()?),
            },
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

/// The encoding of percentages in bytes without sign: 255 is -1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UnsignedPercent;

impl Encoding for UnsignedPercent {
    type Stored = u8;
    type Float = f64;
    const ALLOWED: &'static str = "a percentage from 0 to 100, or 255 for unknown";

    fn unknown() -> u8 {
        255
    }

    fn value(percent: u8) -> f64 {
        f64::from(percent)
    }

    fn cell(percent: u8) -> Option<Cell<f64>> {
        Percent::cell(percent.cast_signed())
    }

    fn occupancy(percent: u8) -> Option<f64> {
        Percent::occupancy(percent.cast_signed())
    }

    fn tally(cells: &[u8]) -> Tally<f64> {
        Histogram::from_cells(cells).tally::<Self>()
    }

    fn information_sum(cells: &[u8]) -> InformationSum<f64> {
        Histogram::from_cells(cells).information_sum::<Self>()
    }
}

/// An encoding of which the information of many cells is computed one by one.
pub(crate) trait EachCell: Encoding {
    /// Stores the information of each cell: NaN where a value is not allowed.
    fn information(cells: &[Self::Stored], results: &mut [Self::Float]);
    /// Returns whether a cell is unknown.
    fn is_unknown(cell: Self::Stored) -> bool;
}

impl<T: Real> EachCell for Probability<T> {
    fn information(cells: &[T], results: &mut [T]) {
        elementwise::information(cells, results);
    }

    fn is_unknown(p: T) -> bool {
        p == T::HALF
    }
}

impl<T: Real> EachCell for LogOdds<T> {
    fn information(cells: &[T], results: &mut [T]) {
        elementwise::information_from_log_odds(cells, results);
    }

    fn is_unknown(l: T) -> bool {
        l == T::zero()
    }
}

/// Implements the trait for bytes, by a table.
macro_rules! bytes {
    ($($encoding:ty: $byte:ty;)*) => {
        $(impl EachCell for $encoding {
            fn information(cells: &[$byte], results: &mut [f64]) {
                static TABLE: LazyLock<[f64; 256]> = LazyLock::new(|| {
                    let cell = |byte: usize| <$encoding>::cell(byte as u8 as $byte);
                    std::array::from_fn(|byte| cell(byte).map_or(f64::NAN, |cell| cell.information()))
                });
                let table = &*TABLE;
                for (result, &cell) in results.iter_mut().zip(cells) {
                    *result = table[usize::from(cell as u8)];
                }
            }

            fn is_unknown(cell: $byte) -> bool {
                <$encoding>::occupancy(cell) == Some(0.5)
            }
        })*
    };
}

bytes! {
    Percent: i8;
    UnsignedPercent: u8;
    MrptLogOdds: i8;
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
            Array::UnsignedPercent($cells) => with_encoding!(@ crate::encodings::UnsignedPercent, $encoding, $body),
            Array::Mrpt($cells) => with_encoding!(@ mean_information::map::encoding::MrptLogOdds, $encoding, $body),
        }
    };
    (@ $type:ty, $encoding:ident, $body:expr) => {{
        type $encoding = $type;
        $body
    }};
}
pub(crate) use with_encoding;
