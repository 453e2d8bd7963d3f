//! The tally of a map: all that Eqs. 2 to 4 need.

use super::exact_sum::ExactSum;
#[cfg(feature = "std")]
use super::{apart, blocks};
use crate::cell::{Cell, State};
#[cfg(feature = "std")]
use crate::elementwise;
use crate::real::Real;
use crate::rounded::beyond_float::Both;
#[cfg(feature = "std")]
use crate::rounded::lanes;
use core::marker::PhantomData;

/// The message for more cells than counts can hold.
pub(super) const TOO_MANY: &str = "a tally holds at most 2^64 - 1 cells";

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
    pub(super) entropy: ExactSum,
    pub(super) information: ExactSum,
    pub(super) unknown: u64,
    pub(super) free: u64,
    pub(super) occupied: u64,
    pub(super) format: PhantomData<T>,
}

/// Equality of sums and counts, which are integers; `derive` would ask for `T: Eq`.
impl<T: Real> Eq for Tally<T> {}

impl<T: Real> Default for Tally<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real> Tally<T> {
    /// Creates an empty tally.
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

    /// Adds one cell.
    ///
    /// # Panics
    /// If the tally would hold more than `2^64 - 1` cells.
    #[inline]
    pub fn add(&mut self, cell: Cell<T>) {
        self.add_many(cell, 1);
    }

    /// Adds `count` equal cells, with the same result as `count` calls of [`Tally::add`].
    ///
    /// # Panics
    /// If the tally would hold more than `2^64 - 1` cells.
    pub fn add_many(&mut self, cell: Cell<T>, count: u64) {
        assert!(self.cells().checked_add(count).is_some(), "{TOO_MANY}");
        // Both values are correctly rounded; from here on nothing rounds: sums.md, theorem (exact sums).
        self.count(cell.state(), count);
        self.entropy.add_many(cell.entropy(), count);
        self.information.add_many(cell.information(), count);
    }

    /// Creates the tally of cells from their occupancies, without the values that are no probabilities: if there are any,
    /// [`Tally::cells`] is below the number of values given.
    ///
    /// Equal, bit for bit, to the tally of the single cells (Eqs. 2 to 4; proved,
    /// [`sums`](crate::book::sums), "Many cells at once"), and many times as fast (feature `std`): blocks
    /// of cells are summed up by the processor's vector unit. The first call makes a table of 384 KB,
    /// in two milliseconds.
    ///
    /// Those are values outside `[0, 1]`, and NaN; [`Grid::new`](crate::map::Grid::new) refuses them. Percentages as floats
    /// are mostly such values, and those that are not mean something else:
    ///
    /// ```
    /// use mean_information::Tally;
    /// let percentages = [0.0, 50.0, 100.0, 1.0];
    /// let tally = Tally::from_occupancies(&percentages);
    /// assert_eq!((tally.cells(), tally.free(), tally.occupied()), (2, 1, 1)); // of 4; and 1 % is certainly occupied
    /// ```
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
            // The integers of a block are its cells' sums, bit for bit: sums.md, theorem (blocks).
            tally.add_block(block);
            // Where the error bound does not decide the rounding, the single cell does: the same theorem, "Rounding test".
            tally.extend(left.flat_map(Cell::from_occupancy));
        });
        // The cells after the last block, or all of them without vector kernels.
        tally.extend(cells.iter().flat_map(|&p| Cell::from_occupancy(p)));
        tally
    }

    /// Creates the tally of cells from their log-odds (nats), without NaN: if there are any, [`Tally::cells`] is below the
    /// number of values given.
    ///
    /// Equal, bit for bit, to the tally of the single cells (Eqs. 2 to 4; proved, [`sums`](crate::book::sums), "Blocks of
    /// log-odds" and "Far log-odds"), and many times as fast (feature `std`), as [`Tally::from_occupancies`] is. The first call makes a table
    /// of 476 KB (`f64`; `f32` has none), in some three milliseconds.
    ///
    /// ```
    /// use mean_information::{Tally, cell::Cell};
    /// let cells: Vec<f64> = (0..10_000).map(|k| k as f64 / 1024.0 - 5.0).collect();
    /// let tally = Tally::from_log_odds(&cells);
    /// assert_eq!(tally.mean_information(), 0.5294652555959756); // bits per observed cell
    /// assert_eq!(tally, cells.into_iter().flat_map(Cell::from_log_odds).collect());
    /// ```
    pub fn from_log_odds(cells: &[T]) -> Self {
        let mut tally = Self::new();
        #[cfg(feature = "std")]
        apart::each(cells, |near, far| {
            tally.add_near(near);
            tally.add_far(far);
        });
        #[cfg(not(feature = "std"))]
        tally.extend(cells.iter().flat_map(|&l| Cell::from_log_odds(l)));
        tally
    }

    /// Adds cells of log-odds, of which few are far.
    #[cfg(feature = "std")]
    fn add_near(&mut self, cells: &[T]) {
        let cells = blocks::each(cells, lanes::sums_from_log_odds, |block, left| {
            // The integers of a block are its cells' sums, bit for bit: sums.md, theorem (log-odds).
            self.add_block(block);
            self.extend(left.flat_map(Cell::from_log_odds));
        });
        self.extend(cells.iter().flat_map(|&l| Cell::from_log_odds(l)));
    }

    /// Adds cells of log-odds, all of which are far.
    #[cfg(feature = "std")]
    fn add_far(&mut self, cells: &[T]) {
        let mut entropies = [T::zero(); lanes::BLOCK];
        for cells in cells.chunks(lanes::BLOCK) {
            let entropies = &mut entropies[..cells.len()];
            // Theorem (far log-odds), "Sums": correctly rounded, then added exactly.
            elementwise::entropy_from_log_odds(cells, entropies);
            self.entropy.add_all(entropies);
            let occupied = cells.iter().filter(|&&l| l > T::zero()).count() as u64;
            self.occupied += occupied;
            self.free += cells.len() as u64 - occupied;
        }
        // The information is 1 to the last bit: sums.md, theorem (log-odds), "Domain in f64".
        self.information.add_many(T::one(), cells.len() as u64);
    }

    /// Adds the sums and counts of a block of cells.
    #[cfg(feature = "std")]
    fn add_block(&mut self, block: &lanes::Block) {
        self.entropy.add_parts::<T>(block.entropy);
        self.information.add_parts::<T>(block.information);
        self.unknown += block.unknown;
        self.occupied += block.occupied;
        self.free += block.free;
    }

    /// Adds `count` equal cells whose entropy and information are known beyond the precision of a float.
    pub(crate) fn add_fixed(&mut self, state: State, (entropy, information): Both, count: u64) {
        // Each is within 2^-63 bits of the exact one: expected.md. ExactSum cuts them below the smallest T.
        self.count(state, count);
        self.entropy.add_fixed::<T>(entropy, count);
        self.information.add_fixed::<T>(information, count);
    }

    /// Adds `count` cells of one state to the counts, not to the sums.
    fn count(&mut self, state: State, count: u64) {
        // Each of the three is at most the number of all cells, which was checked.
        match state {
            State::Unknown => self.unknown += count,
            State::Free => self.free += count,
            State::Occupied => self.occupied += count,
        }
    }

    /// Adds the cells of another tally.
    ///
    /// # Panics
    /// If the tally would hold more than `2^64 - 1` cells.
    pub fn merge(&mut self, other: &Self) {
        assert!(self.cells().checked_add(other.cells()).is_some(), "{TOO_MANY}");
        // Integers add without rounding, so any tree of merges gives the same bits.
        self.entropy.merge(&other.entropy);
        self.information.merge(&other.information);
        self.unknown += other.unknown;
        self.free += other.free;
        self.occupied += other.occupied;
    }

    /// Returns `H(m)`, Eq. 2: the entropy of all cells in bits, with 1 bit for each unknown cell.
    ///
    /// The exact sum of the correctly rounded entropies of the cells, rounded once to nearest: within 1.5 ulp of the
    /// exact entropy of the cells given (proved, [`sums`](crate::book::sums), "The results"). If entropies of cells are
    /// below the normal numbers, half a unit of the smallest number more for each of these.
    pub fn entropy(&self) -> T {
        // One rounding, of the exact sum.
        self.entropy.value()
    }

    /// Returns `I(m)`, Eq. 3: the information of all cells in bits. Unknown cells add nothing.
    ///
    /// The exact sum of the correctly rounded information of the cells, rounded once to nearest: within 1.5 ulp of the
    /// exact information of the cells given, subnormal ones apart (proved, [`sums`](crate::book::sums), "The results").
    pub fn information(&self) -> T {
        // One rounding, of the exact sum.
        self.information.value()
    }

    /// Returns the mean information `I(m) / N_obs`, Eq. 4, in bits per observed cell, in `[0, 1]`.
    ///
    /// The exact sum of the correctly rounded information of the cells over the count, rounded once to nearest: within
    /// 1.5 ulp of the exact mean information of the cells given, subnormal ones apart (proved,
    /// [`sums`](crate::book::sums), "The results").
    /// If no cell is observed, it is 0 by the paper's convention (property 1 of section I).
    pub fn mean_information(&self) -> T {
        // One rounding, of the exact quotient: sums.md, theorem (exact sums).
        self.information.mean(self.observed())
    }

    /// Returns the mean information in another format of floats: the same exact quotient, rounded once to that.
    pub(crate) fn mean_information_as<U: Real>(&self) -> U {
        self.information.mean(self.observed())
    }

    /// Returns `N_obs`, Eq. 4: the number of cells with `p != 1/2`.
    pub fn observed(&self) -> u64 {
        self.free + self.occupied
    }

    /// Returns the number of cells with `p = 1/2`.
    pub fn unknown(&self) -> u64 {
        self.unknown
    }

    /// Returns the number of observed cells with `p < 1/2`.
    pub fn free(&self) -> u64 {
        self.free
    }

    /// Returns the number of observed cells with `p > 1/2`.
    pub fn occupied(&self) -> u64 {
        self.occupied
    }

    /// Returns the number of all cells.
    pub fn cells(&self) -> u64 {
        self.unknown + self.free + self.occupied
    }
}
