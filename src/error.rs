//! The one error type: the place, the value and the allowed range.

use crate::real::Real;
use core::fmt;

/// The reason why an input was refused: the place, the value and the allowed range.
///
/// ```
/// use mean_information::cell::Cell;
/// let refused = Cell::from_occupancy(1.25_f64).unwrap_err();
/// assert_eq!(refused.to_string(), "occupancy is 1.25, allowed is 0 to 1");
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A number outside its domain.
    OutOfRange {
        /// The name of the argument.
        what: &'static str,
        /// The value.
        value: f64,
        /// The allowed range, in words.
        allowed: &'static str,
    },
    /// An item of a list outside its domain.
    Item {
        /// The name of the quantity and of the items.
        what: &'static str,
        /// The index of the item, from 0.
        index: usize,
        /// The value.
        value: f64,
        /// The allowed range, in words.
        allowed: &'static str,
    },
    /// A contradiction of two certain observations.
    Contradiction {
        /// The index, from 0, of an observation that is 0.
        free: usize,
        /// The index, from 0, of an observation that is 1.
        occupied: usize,
    },
    /// A cell of a map outside the domain of its encoding.
    Cell {
        /// The row, from 0.
        row: usize,
        /// The column, from 0.
        column: usize,
        /// The stored value.
        value: f64,
        /// The allowed range, in words.
        allowed: &'static str,
    },
    /// A number of cells that is not width times height.
    CellCount {
        /// The number of cells given.
        given: usize,
        /// The number of columns.
        width: usize,
        /// The number of rows.
        height: usize,
    },
    /// A number of cells above the limit, which would take too long to count or too much memory to store.
    TooManyCells {
        /// The name of what has the cells.
        what: &'static str,
        /// The number of cells.
        count: f64,
        /// The largest number allowed.
        limit: u64,
    },
    /// A number of weights that is not one for each item.
    WeightCount {
        /// The number of weights given.
        given: usize,
        /// The number of items.
        items: usize,
    },
}

impl Error {
    /// Creates an [`Error::OutOfRange`].
    pub(crate) fn out_of_range(what: &'static str, value: f64, allowed: &'static str) -> Self {
        Self::OutOfRange { what, value, allowed }
    }

    /// Creates the [`Error::TooManyCells`] of a map that exceeds its limit.
    pub(crate) fn too_many_cells(cells: u128, limit: u64) -> Self {
        Self::TooManyCells { what: "the map", count: cells as f64, limit }
    }
}

/// Returns `value`, or the error if it is not positive and finite.
pub(crate) fn positive<T: Real>(what: &'static str, value: T) -> Result<T, Error> {
    if value > T::zero() && value.is_finite() {
        Ok(value)
    } else {
        Err(Error::out_of_range(what, value.widen(), "positive and finite, in metres"))
    }
}

/// Returns `value`, or the error if it is not finite.
pub(crate) fn finite<T: Real>(what: &'static str, value: T, allowed: &'static str) -> Result<T, Error> {
    if value.is_finite() { Ok(value) } else { Err(Error::out_of_range(what, value.widen(), allowed)) }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfRange { what, value, allowed } => write!(f, "{what} is {value}, allowed is {allowed}"),
            Self::Item { what, index, value, allowed } => {
                write!(f, "{what} {index} is {value}, allowed is {allowed}")
            }
            Self::Contradiction { free, occupied } => {
                write!(f, "observations {free} and {occupied} are 0 and 1, which contradict each other")
            }
            Self::Cell { row, column, value, allowed } => {
                write!(f, "cell at row {row}, column {column} is {value}, allowed is {allowed}")
            }
            Self::CellCount { given, width, height } => {
                write!(f, "{given} cells were given for a map of {width} columns and {height} rows")
            }
            Self::WeightCount { given, items } => {
                write!(f, "number of weights is {given}, allowed is {items}: one for each item")
            }
            Self::TooManyCells { what, count, limit } => {
                write!(f, "{what} has {count:.3e} cells, allowed are {limit}")
            }
        }
    }
}

impl core::error::Error for Error {}
