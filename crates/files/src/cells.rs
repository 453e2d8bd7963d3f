//! A map's cells, or how often each value occurs, whatever their encoding.

use mean_information::map::encoding::{LogOdds, MrptLogOdds, Percent, Probability};
use mean_information::map::{Encoding, Grid};

/// A map's cells in the encoding they were stored in.
#[derive(Clone, Debug)]
pub enum Cells {
    /// ROS percentages.
    Percent(Grid<Percent>),
    /// MRPT bytes.
    Mrpt(Grid<MrptLogOdds>),
    /// Probabilities in single precision.
    Probability32(Grid<Probability<f32>>),
    /// Probabilities in double precision.
    Probability64(Grid<Probability<f64>>),
    /// Log-odds in single precision.
    LogOdds32(Grid<LogOdds<f32>>),
    /// Log-odds in double precision.
    LogOdds64(Grid<LogOdds<f64>>),
}

/// The contents of a map that its measures need: its cells, or how often each value occurs.
#[derive(Clone, Debug)]
pub enum Contents {
    /// The cells.
    Cells(Cells),
    /// The values of an image or of an array of integers.
    Counted(Counted),
    /// Nothing: all cells were given to a [`CellsVisitor`].
    Visited {
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
    },
}

/// A visitor of the cells of a map of floats, some at a time, which are not kept: all are in one encoding.
///
/// ```
/// use mean_information_files::{CellsVisitor, Readable};
///
/// /// Counts the cells.
/// struct Count(usize);
///
/// impl CellsVisitor for Count {
///     fn visit<E: Readable>(&mut self, cells: &[E::Stored]) {
///         self.0 += cells.len();
///     }
/// }
/// ```
pub trait CellsVisitor {
    /// Visits the next cells, all of which are allowed in their encoding.
    fn visit<E: Readable>(&mut self, cells: &[E::Stored]);
}

impl From<Cells> for Contents {
    fn from(cells: Cells) -> Self {
        Self::Cells(cells)
    }
}

/// The values of a map that were counted, in their encoding.
#[derive(Clone, Debug)]
pub enum Counted {
    /// ROS percentages.
    Percent(Counts<Percent>),
    /// MRPT bytes.
    Mrpt(Counts<MrptLogOdds>),
    /// Probabilities, of [`Mode::Probability`](crate::Mode::Probability).
    Probability(Counts<Probability<f64>>),
}

/// The number of times that each value occurs in a map whose cells were counted and not kept.
#[derive(Clone, Debug)]
pub struct Counts<E: Encoding> {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Each value that occurs, with the number of its cells; a value may be listed more than once.
    pub values: Vec<(E::Stored, u64)>,
}

/// An encoding that the pixels of images become cells of.
pub(crate) trait ImageEncoding: Readable<Float = f64> {
    /// Returns counts in this encoding as those of a map.
    fn counted(counts: Counts<Self>) -> Counted;
}

impl ImageEncoding for Percent {
    fn counted(counts: Counts<Self>) -> Counted {
        Counted::Percent(counts)
    }
}

impl ImageEncoding for Probability<f64> {
    fn counted(counts: Counts<Self>) -> Counted {
        Counted::Probability(counts)
    }
}

/// An encoding that files come in.
pub trait Readable: Encoding {
    /// Returns a grid in this encoding as a map's cells.
    fn cells(grid: Grid<Self>) -> Cells;
}

/// An encoding in bytes, whose cells can be counted by value.
pub(crate) trait ByteEncoding: Readable<Stored = i8> {
    /// Returns counts in this encoding as those of a map.
    fn counted(counts: Counts<Self>) -> Counted;
}

impl ByteEncoding for Percent {
    fn counted(counts: Counts<Self>) -> Counted {
        Counted::Percent(counts)
    }
}

impl ByteEncoding for MrptLogOdds {
    fn counted(counts: Counts<Self>) -> Counted {
        Counted::Mrpt(counts)
    }
}

macro_rules! readable {
    ($($encoding:ty => $variant:ident,)*) => {
        $(impl Readable for $encoding {
            fn cells(grid: Grid<Self>) -> Cells {
                Cells::$variant(grid)
            }
        })*
    };
}

readable! {
    Percent => Percent,
    MrptLogOdds => Mrpt,
    Probability<f32> => Probability32,
    Probability<f64> => Probability64,
    LogOdds<f32> => LogOdds32,
    LogOdds<f64> => LogOdds64,
}

/// Runs the same code on a reference to the grid of `$cells`, whatever its encoding.
///
/// ```
/// # use mean_information_files::{Cells, with_grid};
/// fn width(cells: &Cells) -> usize {
///     with_grid!(cells, grid => grid.width())
/// }
/// ```
#[macro_export]
macro_rules! with_grid {
    ($cells:expr, $grid:ident => $body:expr) => {
        match $cells {
            $crate::Cells::Percent($grid) => $body,
            $crate::Cells::Mrpt($grid) => $body,
            $crate::Cells::Probability32($grid) => $body,
            $crate::Cells::Probability64($grid) => $body,
            $crate::Cells::LogOdds32($grid) => $body,
            $crate::Cells::LogOdds64($grid) => $body,
        }
    };
}
