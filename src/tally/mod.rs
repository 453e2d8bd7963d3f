//! The sums behind every measure of a map: Eq. 2, the entropy `H(m) = sum H`, Eq. 3, the information
//! `I(m) = sum I`, and Eq. 4, the mean information `I(m) / N_obs`.
//!
//! The sums are exact ([`ExactSum`]), so a [`Tally`] does not depend on the order of the cells, nor on how they
//! were split and merged.

#[cfg(feature = "std")]
mod blocks;
mod exact_sum;
mod information;
#[cfg(feature = "serde")]
mod portable;

pub use exact_sum::ExactSum;
pub use information::Information;

use crate::cell::{Cell, State};
use crate::real::Real;
#[cfg(feature = "std")]
use crate::rounded::lanes;
use crate::rounded::mean::Both;
use core::borrow::Borrow;
use core::iter::Sum;
use core::marker::PhantomData;

/// More than counts can hold.
const TOO_MANY: &str = "a tally holds at most 2^64 - 1 cells";

/// The sums over the cells of a map: entropy, information, and how many cells are unknown, free and occupied.
///
/// A tally holds the exact sums of the correctly rounded values of its cells, and rounds once when asked.
/// Adding cells in any order, or merging tallies of parts in any tree, gives the same bits.
///
/// ```
/// use mean_information::{Tally, cell::Cell};
/// let mut tally = Tally::<f64>::new();
/// for p in [0.25, 0.5, 0.96875] {
///     tally.add(Cell::from_occupancy(p)?);
/// }
/// assert_eq!((tally.observed(), tally.unknown()), (2, 1));
/// assert_eq!((tally.entropy(), tally.information()), (2.0119004487718476, 0.9880995512281525)); // bits
/// assert_eq!(tally.mean_information(), 0.49404977561407626); // bits per observed cell
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Tally<T> {
    entropy: ExactSum,
    information: ExactSum,
    unknown: u64,
    free: u64,
    occupied: u64,
    format: PhantomData<T>,
}

/// Sums and counts are integers; `derive` would ask `T: Eq`.
impl<T: Real> Eq for Tally<T> {}

impl<T: Real> Default for Tally<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real> Tally<T> {
    /// The tally of no cells.
    pub const fn new() -> Self {
        Self {
            entropy: ExactSum::new(),
            information: ExactSum::new(),
            unknown: 0,
            free: 0,
            occupied: 0,
            format: PhantomData,
        }
    }

    /// Counts one cell.
    ///
    /// # Panics
    /// If the tally would hold more than `2^64 - 1` cells.
    #[inline]
    pub fn add(&mut self, cell: Cell<T>) {
        self.add_many(cell, 1);
    }

    /// Counts `count` equal cells, with the same result as `count` calls of [`Tally::add`].
    ///
    /// # Panics
    /// If the tally would hold more than `2^64 - 1` cells.
    pub fn add_many(&mut self, cell: Cell<T>, count: u64) {
        assert!(self.cells().checked_add(count).is_some(), "{TOO_MANY}");
        self.count(cell.state(), count);
        self.entropy.add_many(cell.entropy(), count);
        self.information.add_many(cell.information(), count);
    }

    /// The tally of cells by their occupancies; what is no probability is passed over.
    ///
    /// Equal, bit for bit, to the tally of the single cells (Eqs. 2 to 4; proved,
    /// [`sums`](crate::book::sums), "Many cells at once"), and many times as fast (feature `std`): blocks
    /// of cells are summed up by the processor's vector unit. The first call makes a table of 192 KB (`f64`),
    /// in a millisecond.
    ///
    /// What is passed over is missing in [`Tally::cells`]; [`Grid::new`](crate::map::Grid::new) refuses it instead.
    ///
    /// ```
    /// use mean_information::{Tally, cell::Cell};
    /// let cells: Vec<f32> = (0..10_000).map(|k| k as f32 / 16_384.0).collect();
    /// let tally = Tally::from_occupancies(&cells);
    /// assert_eq!(tally.mean_information(), 0.23047143); // bits per observed cell
    /// assert_eq!(tally, cells.into_iter().flat_map(Cell::from_occupancy).collect());
    /// ```
    pub fn from_occupancies(cells: &[T]) -> Self {
        let mut tally = Self::new();
        #[cfg(feature = "std")]
        let cells = blocks::each(cells, lanes::sums, |block, left| {
            tally.entropy.add_fixed::<T>(block.entropy, 1);
            tally.information.add_fixed::<T>(block.information, 1);
            tally.unknown += block.unknown;
            tally.occupied += block.occupied;
            tally.free += block.free;
            tally.extend(left.flat_map(Cell::from_occupancy));
        });
        tally.extend(cells.iter().flat_map(|&p| Cell::from_occupancy(p)));
        tally
    }

    /// Counts equal cells whose entropy and information are known beyond the precision of a float.
    pub(crate) fn add_fixed(&mut self, state: State, (entropy, information): Both, count: u64) {
        self.count(state, count);
        self.entropy.add_fixed::<T>(entropy, count);
        self.information.add_fixed::<T>(information, count);
    }

    fn count(&mut self, state: State, count: u64) {
        match state {
            State::Unknown => self.unknown += count,
            State::Free => self.free += count,
            State::Occupied => self.occupied += count,
        }
    }

    /// Counts the cells of another tally.
    ///
    /// # Panics
    /// If the tally would hold more than `2^64 - 1` cells.
    pub fn merge(&mut self, other: &Self) {
        assert!(self.cells().checked_add(other.cells()).is_some(), "{TOO_MANY}");
        self.entropy.merge(&other.entropy);
        self.information.merge(&other.information);
        self.unknown += other.unknown;
        self.free += other.free;
        self.occupied += other.occupied;
    }

    /// `H(m)`, Eq. 2: the entropy of all cells, unknown ones at 1 bit each, in bits.
    ///
    /// The exact sum of the correctly rounded entropies of the cells, rounded once to nearest: within 1.5 ulp of
    /// the sum of the exact entropies, unless that is below the normal numbers, where half a unit of the smallest
    /// number for each cell is added.
    pub fn entropy(&self) -> T {
        self.entropy.value()
    }

    /// `I(m)`, Eq. 3: the information of all cells, in bits. Unknown cells add nothing.
    ///
    /// The exact sum of the correctly rounded information of the cells, rounded once to nearest: within 1.5 ulp of the
    /// exact information of the cells given, subnormal ones apart (proved, [`sums`](crate::book::sums), "The results").
    pub fn information(&self) -> T {
        self.information.value()
    }

    /// `I(m) / N_obs`, Eq. 4: the mean information of the observed cells, in bits per cell, in `[0, 1]`.
    ///
    /// The exact sum of the correctly rounded information of the cells over the count, rounded once to nearest: within
    /// 1.5 ulp of the exact mean information of the cells given, subnormal ones apart (proved,
    /// [`sums`](crate::book::sums), "The results").
    /// With nothing observed it is 0 by the paper's convention (property 1 of section I).
    pub fn mean_information(&self) -> T {
        self.information.mean(self.observed())
    }

    /// `N_obs`, Eq. 4: the number of cells with `p != 1/2`.
    pub fn observed(&self) -> u64 {
        self.free + self.occupied
    }

    /// The number of cells with `p = 1/2`.
    pub fn unknown(&self) -> u64 {
        self.unknown
    }

    /// The number of observed cells with `p < 1/2`.
    pub fn free(&self) -> u64 {
        self.free
    }

    /// The number of observed cells with `p > 1/2`.
    pub fn occupied(&self) -> u64 {
        self.occupied
    }

    /// The number of all cells.
    pub fn cells(&self) -> u64 {
        self.unknown + self.free + self.occupied
    }
}

/// Sums and collections of what has `new`, `add` and `merge`.
macro_rules! impl_collection {
    ($sums:ident) => {
        impl<T: Real> Extend<Cell<T>> for $sums<T> {
            fn extend<I: IntoIterator<Item = Cell<T>>>(&mut self, cells: I) {
                for cell in cells {
                    self.add(cell);
                }
            }
        }

        impl<T: Real> FromIterator<Cell<T>> for $sums<T> {
            fn from_iter<I: IntoIterator<Item = Cell<T>>>(cells: I) -> Self {
                let mut sums = Self::new();
                sums.extend(cells);
                sums
            }
        }

        impl<T: Real> $sums<T> {
            fn merged<B: Borrow<Self>>(parts: impl Iterator<Item = B>) -> Self {
                parts.fold(Self::new(), |mut sum, part| {
                    sum.merge(part.borrow());
                    sum
                })
            }
        }

        /// That of all cells of the parts of a map, also of a rayon iterator: [`merge`]($sums::merge) by `sum()`.
        impl<T: Real> Sum for $sums<T> {
            fn sum<I: Iterator<Item = Self>>(parts: I) -> Self {
                Self::merged(parts)
            }
        }

        /// The same of parts that are kept.
        impl<'a, T: Real> Sum<&'a Self> for $sums<T> {
            fn sum<I: Iterator<Item = &'a Self>>(parts: I) -> Self {
                Self::merged(parts)
            }
        }
    };
}

impl_collection!(Tally);
impl_collection!(Information);
