//! What Eq. 4 needs and no more: the information of a map and the number of its observed cells.

#[cfg(feature = "std")]
use super::blocks;
use super::{ExactSum, TOO_MANY, Tally};
use crate::cell::{self, Cell, State};
use crate::real::Real;
#[cfg(feature = "std")]
use crate::rounded::lanes;
use core::marker::PhantomData;

/// The sum of the information of a map, and how many of its cells are observed and unknown: the half of a [`Tally`]
/// that the mean information needs. Occupancies without their entropies are summed up faster.
///
/// Adding cells in any order, or merging parts in any tree, gives the same bits as a tally does.
///
/// ```
/// use mean_information::{Information, Tally};
/// let cells = [0.25, 0.5, 0.96875];
/// let mut information = Information::from_occupancies(&cells[..2]);
/// information.merge(&Information::from_occupancies(&cells[2..]));
/// assert_eq!((information.observed(), information.unknown()), (2, 1));
/// assert_eq!(information.total(), 0.9880995512281525); // bits
/// assert_eq!(information.mean(), 0.49404977561407626); // bits per observed cell
/// assert_eq!(information.mean(), Tally::from_occupancies(&cells).mean_information());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Information<T> {
    pub(super) sum: ExactSum,
    pub(super) unknown: u64,
    pub(super) observed: u64,
    pub(super) format: PhantomData<T>,
}

/// Sum and counts are integers; `derive` would ask `T: Eq`.
impl<T: Real> Eq for Information<T> {}

impl<T: Real> Default for Information<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real> Information<T> {
    /// That of no cells.
    pub const fn new() -> Self {
        Self { sum: ExactSum::new(), unknown: 0, observed: 0, format: PhantomData }
    }

    /// Counts one cell.
    ///
    /// # Panics
    /// If there would be more than `2^64 - 1` cells.
    pub fn add(&mut self, cell: Cell<T>) {
        self.add_many(cell, 1);
    }

    /// Counts `count` equal cells, with the same result as `count` calls of [`Information::add`].
    ///
    /// # Panics
    /// If there would be more than `2^64 - 1` cells.
    pub fn add_many(&mut self, cell: Cell<T>, count: u64) {
        let [unknown, observed] = if cell.state() == State::Unknown { [count, 0] } else { [0, count] };
        self.count(unknown, observed);
        self.sum.add_many(cell.information(), count);
    }

    /// Of cells by their occupancies; what is no probability is passed over, as in [`Tally::from_occupancies`].
    ///
    /// The sum is that of the correctly rounded information of the cells, exactly (proved,
    /// [`sums`](crate::book::sums)).
    pub fn from_occupancies(cells: &[T]) -> Self {
        let mut sums = Self::new();
        #[cfg(feature = "std")]
        let cells = blocks::each(cells, lanes::information, |block, left| {
            sums.sum.add_fixed::<T>(block.information, 1);
            sums.unknown += block.unknown;
            sums.observed += block.free;
            left.for_each(|p| sums.add_occupancy(p));
        });
        for &p in cells {
            sums.add_occupancy(p);
        }
        sums
    }

    /// Without the entropy, which a [`Cell`] has.
    fn add_occupancy(&mut self, p: T) {
        if p == T::HALF {
            self.unknown += 1;
        } else if cell::in_unit_interval(p) {
            self.sum.add(cell::information(p));
            self.observed += 1;
        }
    }

    /// Counts the cells of another part of the map.
    ///
    /// # Panics
    /// If there would be more than `2^64 - 1` cells.
    pub fn merge(&mut self, other: &Self) {
        self.count(other.unknown, other.observed);
        self.sum.merge(&other.sum);
    }

    fn count(&mut self, unknown: u64, observed: u64) {
        let more = unknown + observed;
        assert!(self.cells().checked_add(more).is_some(), "{TOO_MANY}");
        self.unknown += unknown;
        self.observed += observed;
    }

    /// `I(m)`, Eq. 3, in bits: the exact sum of the correctly rounded information of the cells, rounded once to
    /// nearest, within 1.5 ulp of the exact information, as [`Tally::information`].
    pub fn total(&self) -> T {
        self.sum.value()
    }

    /// `I(m) / N_obs`, Eq. 4, in bits per observed cell: the exact quotient of that sum, rounded once to nearest; 0 if
    /// nothing is observed. The bits of [`Tally::mean_information`], within 1.5 ulp of the exact mean information.
    pub fn mean(&self) -> T {
        self.sum.mean(self.observed)
    }

    /// `N_obs`, Eq. 4: the number of cells with `p != 1/2`.
    pub fn observed(&self) -> u64 {
        self.observed
    }

    /// The number of cells with `p = 1/2`.
    pub fn unknown(&self) -> u64 {
        self.unknown
    }

    /// The number of all cells.
    pub fn cells(&self) -> u64 {
        self.unknown + self.observed
    }
}

impl<T: Real> From<&Tally<T>> for Information<T> {
    fn from(tally: &Tally<T>) -> Self {
        Self {
            sum: tally.information.clone(),
            unknown: tally.unknown(),
            observed: tally.observed(),
            format: PhantomData,
        }
    }
}
