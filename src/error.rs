//! The one error type: the place, the value and the allowed range; of the bytes of a tally what is wrong with them.

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
    #[non_exhaustive]
    OutOfRange {
        /// The name of the argument.
        what: &'static str,
        /// The value.
        value: f64,
        /// The allowed range, in words.
        allowed: &'static str,
    },
    /// An item of a list outside its domain.
    #[non_exhaustive]
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
    #[non_exhaustive]
    Contradiction {
        /// The index, from 0, of an observation that is 0.
        free: usize,
        /// The index, from 0, of an observation that is 1.
        occupied: usize,
    },
    /// A cell of a map outside the domain of its encoding.
    #[non_exhaustive]
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
    #[non_exhaustive]
    CellCount {
        /// The number of cells given.
        given: usize,
        /// The number of columns.
        width: usize,
        /// The number of rows.
        height: usize,
    },
    /// A number of cells above the limit, which would take too much memory to store.
    #[non_exhaustive]
    TooManyCells {
        /// The name of what has the cells.
        what: &'static str,
        /// The number of cells.
        count: f64,
        /// The largest number allowed.
        limit: u64,
    },
    /// A number of samples of a sensor model above the limit, which would take too long.
    #[non_exhaustive]
    TooManySamples {
        /// The name of what is sampled.
        what: &'static str,
        /// The number of samples.
        count: f64,
        /// The largest number allowed.
        limit: u64,
    },
    /// Memory that cannot be had, for a number of cells within the limit.
    #[non_exhaustive]
    NoMemory {
        /// The number of cells.
        cells: f64,
    },
    /// A number of weights that is not one for each item.
    #[non_exhaustive]
    WeightCount {
        /// The number of weights given.
        given: usize,
        /// The number of items.
        items: usize,
    },
    /// Bytes from which no tally can be read.
    TallyBytes(TallyFault),
}

/// The fault of bytes from which no tally can be read.
///
/// ```
/// use mean_information::{Error, Tally, tally::TallyFault};
/// let mut bytes = Tally::from_occupancies(&[0.25_f32, 1.0]).to_bytes();
/// let fault = |bytes: &[u8]| match Tally::<f64>::from_bytes(bytes) {
///     Err(Error::TallyBytes(fault)) => Some(fault),
///     _ => None,
/// };
/// assert!(matches!(fault(&bytes), Some(TallyFault::OtherFormat { bits: 32, .. })));
/// assert_eq!(fault(b"a tally"), Some(TallyFault::NoTally));
/// bytes[40] ^= 1;
/// assert_eq!(fault(&bytes), Some(TallyFault::Damaged));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TallyFault {
    /// The first bytes are not those of a tally.
    NoTally,
    /// A later release wrote them.
    #[non_exhaustive]
    LaterVersion {
        /// The version of the bytes.
        version: u16,
    },
    /// They are too few or too many.
    #[non_exhaustive]
    Length {
        /// The number of bytes given.
        given: usize,
    },
    /// The checksum is not that of the bytes before it, or no release wrote this version.
    Damaged,
    /// The cells were rounded to floats of another format.
    #[non_exhaustive]
    OtherFormat {
        /// The bits of a float.
        bits: u16,
        /// The bits that can be read, in words.
        allowed: &'static str,
    },
}

impl fmt::Display for TallyFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoTally => f.write_str("the bytes are those of something else than a tally"),
            Self::LaterVersion { version } => {
                write!(
                    f,
                    "version of the bytes of a tally is {version}, allowed is 1: a later release wrote them"
                )
            }
            Self::Length { given } => write!(f, "number of bytes of a tally is {given}, allowed is 324"),
            Self::Damaged => f.write_str("the bytes of the tally are damaged: their checksum is another"),
            Self::OtherFormat { bits, allowed } => {
                write!(f, "bits of a float in the bytes of a tally is {bits}, allowed is {allowed}")
            }
        }
    }
}

impl Error {
    /// Creates an [`Error::OutOfRange`]: what a sensor model of one's own refuses with, in the words of this crate.
    ///
    /// ```
    /// use mean_information::Error;
    /// let refused = Error::out_of_range("opening angle of the sonar", -0.25, "positive, in radians");
    /// assert_eq!(refused.to_string(), "opening angle of the sonar is -0.25, allowed is positive, in radians");
    /// ```
    pub fn out_of_range(what: &'static str, value: f64, allowed: &'static str) -> Self {
        Self::OutOfRange { what, value, allowed }
    }

    /// Creates an [`Error::Cell`]: what a reader of maps refuses with, whose cells never become a [`Grid`](crate::map::Grid).
    ///
    /// ```
    /// use mean_information::{Error, map::{Encoding, encoding::Percent}};
    /// let refused = Error::cell(2, 7, 101.0, Percent::ALLOWED);
    /// let allowed = "a percentage from 0 to 100, or -1 for unknown";
    /// assert_eq!(refused.to_string(), format!("cell at row 2, column 7 is 101, allowed is {allowed}"));
    /// ```
    pub fn cell(row: usize, column: usize, value: f64, allowed: &'static str) -> Self {
        Self::Cell { row, column, value, allowed }
    }

    /// Returns whether what was asked for lies in the domain, but is more than this crate or the memory can do:
    /// [`Error::TooManyCells`], [`Error::TooManySamples`] and [`Error::NoMemory`].
    ///
    /// ```
    /// use mean_information::room::CartesianRoom;
    /// use mean_information::sensor::GaussianSensor;
    /// let sensor = GaussianSensor::new(4.0, 0.5)?;
    /// let fine = CartesianRoom::new(sensor, 1e-9, [0.0, 0.0])?;
    /// assert!(fine.tally().unwrap_err().is_too_large());
    /// assert!(!GaussianSensor::new(4.0, -0.5).unwrap_err().is_too_large());
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn is_too_large(&self) -> bool {
        matches!(self, Self::TooManyCells { .. } | Self::TooManySamples { .. } | Self::NoMemory { .. })
    }

    /// Creates the [`Error::NoMemory`] of a map of so many cells.
    pub(crate) fn no_memory(cells: u128) -> Self {
        Self::NoMemory { cells: cells as f64 }
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
            Self::TallyBytes(fault) => fault.fmt(f),
            Self::TooManyCells { what, count, limit } => {
                write!(f, "{what} has {count:.3e} cells, allowed are {limit}")
            }
            Self::TooManySamples { what, count, limit } => {
                write!(f, "{what} has {count:.3e} samples, allowed are {limit}")
            }
            Self::NoMemory { cells } => write!(f, "there is no memory for {cells:.3e} cells"),
        }
    }
}

impl core::error::Error for Error {}
