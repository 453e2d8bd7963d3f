//! The meaning of a stored cell: the trait [`Encoding`].

use crate::cell::{self, Cell};
use crate::real::Real;
use crate::tally::{InformationSum, Tally};
use core::fmt::Debug;

/// The meaning of a stored cell.
///
/// Implement it to measure maps in a format of your own. Then [`Encoding::occupancy`] must lie in `[0, 1]`, and all
/// methods that return an `Option` must return `None` for the same values. For cells of 8 bits a
/// [`Histogram`](super::Histogram) gives a fast [`Encoding::tally`]. The measures are those of
/// [`map`](crate::book::map) (Eqs. 1 to 4).
///
/// ```
/// use mean_information::map::{Encoding, encoding::Percent};
/// assert_eq!(Percent::value(83), 83.0);
/// assert_eq!(Percent::occupancy(83), Some(0.83));
/// assert_eq!(Percent::log_odds(83), Some(1.5856272637403817)); // nats
/// assert_eq!(Percent::cell(83).map(|cell| cell.entropy()), Some(0.6577047787442195)); // bits
/// assert_eq!(Percent::occupancy(101), None);
/// let cells = [83, -1, 12];
/// assert_eq!(Percent::tally(&cells).entropy(), 2.187065644031584); // bits
/// assert_eq!(Percent::information_sum(&cells).total(), 0.8129343559684161); // bits
/// ```
pub trait Encoding: Copy + Debug {
    /// The type of a stored cell.
    type Stored: Copy + Debug + PartialEq + Send + Sync;
    /// The type of the cell's occupancy, entropy and information.
    type Float: Real;
    /// The allowed values in words, for error messages.
    const ALLOWED: &'static str;

    /// Returns the stored value of an unknown cell.
    fn unknown() -> Self::Stored;

    /// Returns the stored value as a number, exactly, for error messages.
    fn value(stored: Self::Stored) -> f64;

    /// Decodes the cell, with its entropy and information (bits) correctly rounded from its occupancy or from its
    /// log-odds; `None` if the value is not allowed.
    fn cell(stored: Self::Stored) -> Option<Cell<Self::Float>>;

    /// Decodes the occupancy of the cell, correctly rounded, 1/2 if unknown; `None` if the value is not allowed.
    fn occupancy(stored: Self::Stored) -> Option<Self::Float>;

    /// Decodes the log-odds of the cell in nats, correctly rounded, 0 if unknown; `None` if the value is not allowed. By
    /// default they are computed from its [`occupancy`](Self::occupancy).
    fn log_odds(stored: Self::Stored) -> Option<Self::Float> {
        Self::occupancy(stored).map(cell::log_odds_from_occupancy)
    }

    /// Returns whether the value is allowed, that is, whether [`Encoding::cell`] and [`Encoding::occupancy`] are `Some`.
    fn is_valid(stored: Self::Stored) -> bool {
        Self::occupancy(stored).is_some()
    }

    /// Computes the exact sums over the stored cells, skipping values that are not allowed.
    fn tally(cells: &[Self::Stored]) -> Tally<Self::Float> {
        cells.iter().filter_map(|&stored| Self::cell(stored)).collect()
    }

    /// Computes the exact sum of the information of the stored cells, skipping values that are not allowed: the same bits
    /// as in their tally, but entropies need not be computed.
    fn information_sum(cells: &[Self::Stored]) -> InformationSum<Self::Float> {
        (&Self::tally(cells)).into()
    }
}
