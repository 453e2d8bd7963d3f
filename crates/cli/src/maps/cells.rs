//! A map's cells, whatever their encoding.

use mean_information::Tally;
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

/// What is measured of a map: its cells, or how often each value occurs.
#[derive(Clone, Debug)]
pub enum Contents {
    /// Its cells.
    Cells(Cells),
    /// Its values.
    Counted(Box<Counted>),
}

impl From<Cells> for Contents {
    fn from(cells: Cells) -> Self {
        Self::Cells(cells)
    }
}

/// A map whose cells were counted and not kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Counted {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// The sums over its cells.
    pub tally: Tally<f64>,
    /// Whether a cell is marked as unknown, not only as `p = 1/2`.
    pub marked: bool,
}

impl Counted {
    /// From how often each stored value occurs.
    pub(super) fn new<E: Encoding<Float = f64>>(
        width: usize,
        height: usize,
        values: &[(E::Stored, u64)],
    ) -> Self {
        let mut tally = Tally::new();
        for &(stored, count) in values {
            if let Some(cell) = E::cell(stored) {
                tally.add_many(cell, count);
            }
        }
        Self { width, height, tally, marked: values.iter().any(|&(stored, _)| stored == E::unknown()) }
    }
}

/// An encoding that files come in.
pub trait Readable: Encoding {
    /// A grid in this encoding as a map's cells.
    fn cells(grid: Grid<Self>) -> Cells;
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
/// # use mean_information_cli::maps::{Cells, with_grid};
/// fn width(cells: &Cells) -> usize {
///     with_grid!(cells, grid => grid.width())
/// }
/// ```
#[macro_export]
#[doc(hidden)]
macro_rules! with_grid {
    ($cells:expr, $grid:ident => $body:expr) => {
        match $cells {
            $crate::maps::Cells::Percent($grid) => $body,
            $crate::maps::Cells::Mrpt($grid) => $body,
            $crate::maps::Cells::Probability32($grid) => $body,
            $crate::maps::Cells::Probability64($grid) => $body,
            $crate::maps::Cells::LogOdds32($grid) => $body,
            $crate::maps::Cells::LogOdds64($grid) => $body,
        }
    };
}

#[doc(inline)]
pub use with_grid;
