//! The one error type: what was wrong, where, and what is allowed.

use crate::real::Real;
use core::fmt;

/// Why an input was refused: the place, the value and the allowed range.
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
        /// Its value.
        value: f64,
        /// The allowed range, in words.
        allowed: &'static str,
    },
    /// An item of a list outside its domain.
    Item {
        /// What it is of which item.
        what: &'static str,
        /// Which item, from 0.
        index: usize,
        /// Its value.
        value: f64,
        /// The allowed range, in words.
        allowed: &'static str,
    },
    /// Two certain observations that contradict each other.
    Contradiction {
        /// Which one, from 0, says 0.
        free: usize,
        /// Which one, from 0, says 1.
        occupied: usize,
    },
    /// A cell of a map outside the domain of its encoding.
    Cell {
        /// Row, from 0.
        row: usize,
        /// Column, from 0.
        column: usize,
        /// The stored value.
        value: f64,
        /// The allowed range, in words.
        allowed: &'static str,
    },
    /// The number of cells is not width times height.
    CellCount {
        /// Cells given.
        given: usize,
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// More cells than the limit allows: to count them would not end, or to store them take too much memory.
    TooManyCells {
        /// What has the cells.
        what: &'static str,
        /// How many there are.
        count: f64,
        /// How many are allowed.
        limit: u64,
    },
    /// Not one weight for each item.
    WeightCount {
        /// Weights given.
        given: usize,
        /// What they are for.
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

/// The error if `value` is not positive and finite.
pub(crate) fn positive<T: Real>(what: &'static str, value: T) -> Result<T, Error> {
    if value > T::zero() && value.is_finite() {
        Ok(value)
    } else {
        Err(Error::out_of_range(what, value.widen(), "positive and finite, in metres"))
    }
}

/// The error if `value` is not finite.
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
