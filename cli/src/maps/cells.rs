//! A map's cells, whatever their encoding.

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
