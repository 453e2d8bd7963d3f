//! The information of a map and the number of its observed cells: the part of a tally that Eq. 4 needs.

#[cfg(feature = "std")]
use super::blocks;
use super::exact_sum::ExactSum;
use super::map_tally::{TOO_MANY, Tally};
use crate::cell::{self, Cell, State};
use crate::real::Real;
#[cfg(feature = "std")]
use crate::rounded::lanes;
use core::marker::PhantomData;

/// The sum of the information of a map (Eq. 3), with the numbers of observed and unknown cells: the half of a [`Tally`]
/// that the mean information needs (Eq. 4). It is faster than a tally, because no entropies are computed.
///
/// Adding cells in any order, or merging parts in any tree, gives the bits of the tally.
///
/// ```
/// use mean_information::{InformationSum, Tally};
/// let cells = [0.25, 0.5, 0.96875];
/// let mut information = InformationSum::from_occupancies(&cells[..2]);
/// information.merge(&InformationSum::from_occupancies(&cells[2..]));
/// assert_eq!((information.observed(), information.unknown()), (2, 1));
/// assert_eq!(information.total(), 0.9880995512281525); // bits
/// assert_eq!(information.mean(), 0.49404977561407626); // bits per observed cell
/// assert_eq!(information.mean(), Tally::from_occupancies(&cells).mean_information());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct InformationSum<T> {
    pub(super) sum: ExactSum,
    pub(super) unknown: u64,
    pub(super) observed: u64,
    pub(super) format: PhantomData<T>,
}

/// Equality of sum and counts, which are integers; `derive` would ask for `T: Eq`.
impl<T: Real> Eq for InformationSum<T> {}

impl<T: Real> Default for InformationSum<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real> InformationSum<T> {
    /// Creates an empty sum.
    pub const fn new() -> Self {
        Self { sum: ExactSum::new(), unknown: 0, observed: 0, format: PhantomData }
    }

    /// Adds one cell.
    ///
    /// # Panics
    /// If there would be more than `2^64 - 1` cells.
    pub fn add(&mut self, cell: Cell<T>) {
        self.add_many(cell, 1);
    }

    /// Adds `count` equal cells, with the same result as `count` calls of [`InformationSum::add`].
    ///
    /// # Panics
    /// If there would be more than `2^64 - 1` cells.
    pub fn add_many(&mut self, cell: Cell<T>, count: u64) {
        let [unknown, observed] = if cell.state() == State::Unknown { [count, 0] } else { [0, count] };
        self.count(unknown, observed);
        // The value is correctly rounded; from here on nothing rounds: sums.md, theorem (exact sums).
        self.sum.add_many(cell.information(), count);
    }

    /// Creates the sum of cells from their occupancies, without the values that are no probabilities, as
    /// [`Tally::from_occupancies`] does: if there are any, [`InformationSum::cells`] is below the number of values given.
    ///
    /// The sum is that of the correctly rounded information of the cells, exactly (proved,
    /// [`sums`](crate::book::sums)).
    pub fn from_occupancies(cells: &[T]) -> Self {
        let mut sums = Self::new();
        #[cfg(feature = "std")]
        let cells = blocks::each(cells, lanes::information, |block, left| {
            // The integers of a block are its cells' sums, bit for bit: sums.md, theorem (blocks).
            sums.add_block(block);
            // Where the error bound does not decide the rounding, the single cell does.
            left.for_each(|p| sums.add_occupancy(p));
        });
        // The cells after the last block, or all of them without vector kernels.
        for &p in cells {
            sums.add_occupancy(p);
        }
        sums
    }

    /// Creates the sum of cells from their log-odds (nats), without NaN: if there are any, [`InformationSum::cells`] is below
    /// the number of values given.
    ///
    /// The sum is that of the correctly rounded information of the cells, exactly (proved,
    /// [`sums`](crate::book::sums)), as in [`Tally::from_log_odds`].
    ///
    /// ```
    /// let cells = [0.25_f32, 0.0, -1.5, f32::INFINITY];
    /// let information = mean_information::InformationSum::from_log_odds(&cells);
    /// assert_eq!((information.observed(), information.unknown()), (3, 1));
    /// assert_eq!(information.total(), 1.325829); // bits
    /// ```
    pub fn from_log_odds(cells: &[T]) -> Self {
        let mut sums = Self::new();
        #[cfg(feature = "std")]
        let cells = blocks::each(cells, lanes::information_from_log_odds, |block, left| {
            // The integers of a block are its cells' sums, bit for bit: sums.md, theorem (log-odds).
            sums.add_block(block);
            left.for_each(|l| sums.add_log_odds(l));
        });
        for &l in cells {
            sums.add_log_odds(l);
        }
        sums
    }

    /// Adds the sum and the counts of a block of cells: the kernels for information alone count every observed cell as
    /// free.
    #[cfg(feature = "std")]
    fn add_block(&mut self, block: &lanes::Block) {
        self.sum.add_parts::<T>(block.information);
        self.unknown += block.unknown;
        self.observed += block.free;
    }

    /// Adds a cell from its log-odds, without the entropy that a [`Cell`] computes.
    fn add_log_odds(&mut self, l: T) {
        if l.is_zero() {
            self.unknown += 1;
        } else if !l.is_nan() {
            self.sum.add(cell::information_from_log_odds(l));
            self.observed += 1;
        }
    }

    /// Adds a cell from its occupancy, without the entropy that a [`Cell`] computes.
    fn add_occupancy(&mut self, p: T) {
        if p == T::HALF {
            self.unknown += 1;
        } else if cell::in_unit_interval(p) {
            // I(p) = I(1 - p): free and occupied cells are counted alike.
            self.sum.add(cell::information(p));
            self.observed += 1;
        }
    }

    /// Adds the cells of another part of the map.
    ///
    /// # Panics
    /// If there would be more than `2^64 - 1` cells.
    pub fn merge(&mut self, other: &Self) {
        self.count(other.unknown, other.observed);
        self.sum.merge(&other.sum);
    }

    /// Adds to the counts, not to the sum.
    fn count(&mut self, unknown: u64, observed: u64) {
        // Counts of one cell state or of one sum, so this cannot overflow; the total may.
        let more = unknown + observed;
        assert!(self.cells().checked_add(more).is_some(), "{TOO_MANY}");
        self.unknown += unknown;
        self.observed += observed;
    }

    /// Returns `I(m)`, Eq. 3, in bits: the exact sum of the correctly rounded information of the cells, rounded once to
    /// nearest, within 1.5 ulp of the exact information, as [`Tally::information`].
    pub fn total(&self) -> T {
        // One rounding, of the exact sum.
        self.sum.value()
    }

    /// Returns the mean information `I(m) / N_obs`, Eq. 4, in bits per observed cell: the exact quotient of that sum,
    /// rounded once to nearest; 0 if no cell is observed. It has the bits of [`Tally::mean_information`], within 1.5 ulp
    /// of the exact mean information.
    pub fn mean(&self) -> T {
        // One rounding, of the exact quotient: sums.md, theorem (exact sums).
        self.sum.mean(self.observed)
    }

    /// Returns `N_obs`, Eq. 4: the number of cells with `p != 1/2`.
    pub fn observed(&self) -> u64 {
        self.observed
    }

    /// Returns the number of cells with `p = 1/2`.
    pub fn unknown(&self) -> u64 {
        self.unknown
    }

    /// Returns the number of all cells.
    pub fn cells(&self) -> u64 {
        self.unknown + self.observed
    }
}

impl<T: Real> From<&Tally<T>> for InformationSum<T> {
    fn from(tally: &Tally<T>) -> Self {
        Self {
            sum: tally.information.clone(),
            unknown: tally.unknown(),
            observed: tally.observed(),
            format: PhantomData,
        }
    }
}
