//! What Eq. 4 needs and no more: the information of a map and the number of its observed cells.

#[cfg(feature = "std")]
use super::blocks;
use super::{ExactSum, Tally};
use crate::cell;
use crate::real::Real;
#[cfg(feature = "std")]
use crate::rounded::lanes;
use core::marker::PhantomData;

/// The sum of the information of a map and the number of its observed cells: the half of a [`Tally`] that the mean
/// information needs. Cells without their entropies are summed up faster.
///
/// Adding cells in any order, or merging parts in any tree, gives the same bits as a tally does.
///
/// ```
/// use mean_information::{Information, Tally};
/// let cells = [0.25, 0.5, 0.96875];
/// let mut information = Information::from_occupancies(&cells[..2]);
/// information.merge(&Information::from_occupancies(&cells[2..]));
/// assert_eq!(information.observed(), 2);
/// assert_eq!(information.mean(), 0.49404977561407626); // bits per cell
/// assert_eq!(information.mean(), Tally::from_occupancies(&cells).mean_information());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Information<T> {
    sum: ExactSum,
    observed: u64,
    format: PhantomData<T>,
}

/// Sum and count are integers; `derive` would ask `T: Eq`.
impl<T: Real> Eq for Information<T> {}

impl<T: Real> Default for Information<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real> Information<T> {
    /// That of no cells.
    pub const fn new() -> Self {
        Self { sum: ExactSum::new(), observed: 0, format: PhantomData }
    }

    /// Of cells by their occupancies; what is no probability is passed over, as in [`Tally::from_occupancies`].
    ///
    /// The sum is that of the correctly rounded information of the cells, exactly (proved,
    /// [`rounding`](crate::book::rounding)).
    pub fn from_occupancies(cells: &[T]) -> Self {
        let mut sums = Self::new();
        #[cfg(feature = "std")]
        let cells = blocks::each(cells, lanes::information, |block, left| {
            sums.sum.add_fixed::<T>(block.information);
            sums.observed += block.free;
            left.for_each(|p| sums.add(p));
        });
        for &p in cells {
            sums.add(p);
        }
        sums
    }

    fn add(&mut self, p: T) {
        if cell::in_unit_interval(p) && p != T::HALF {
            self.sum.add(cell::information(p));
            self.observed += 1;
        }
    }

    /// Counts the cells of another part of the map.
    ///
    /// # Panics
    /// If there would be more than `2^64 - 1` observed cells.
    pub fn merge(&mut self, other: &Self) {
        let observed = self.observed.checked_add(other.observed);
        self.observed = observed.expect("a map has at most 2^64 - 1 cells");
        self.sum.merge(&other.sum);
    }

    /// `I(m)`, Eq. 3, in bits: the exact sum of the correctly rounded information of the cells, rounded once to nearest.
    pub fn total(&self) -> T {
        self.sum.value()
    }

    /// `I(m) / N_obs`, Eq. 4, in bits per observed cell: the exact quotient of that sum, rounded once to nearest; 0 if
    /// nothing is observed. The bits of [`Tally::mean_information`].
    pub fn mean(&self) -> T {
        self.sum.mean(self.observed)
    }

    /// `N_obs`, Eq. 4: the number of cells with `p != 1/2`.
    pub fn observed(&self) -> u64 {
        self.observed
    }
}

impl<T: Real> From<&Tally<T>> for Information<T> {
    fn from(tally: &Tally<T>) -> Self {
        Self { sum: tally.information.clone(), observed: tally.observed(), format: PhantomData }
    }
}
