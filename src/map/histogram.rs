//! The histogram of a map of bytes: the number of cells of each of the 256 values, which is all that a measure needs.
//!
//! Maps of bytes mostly hold very few values. So if a stretch of cells held at most [`FEW`] values, the next stretch is
//! compared with these, many cells at once. Only if it holds another value are its cells counted one by one, or in runs.

use super::stored::Encoding;
use crate::cell::Cell;
use crate::error::Error;
use crate::tally::{InformationSum, Tally};
use core::iter::Sum;
use core::ops::AddAssign;

/// The largest number of cells in a stretch: each of 64 lanes counts at most 255 in a byte.
const STRETCH: usize = 255 * LANES;
/// The number of counters that work side by side.
const LANES: usize = 64;
/// The largest number of values to compare with; with more, counting is as fast.
const FEW: usize = 4;
/// The number of equal cells that are counted at once.
const RUN: usize = 32;
/// The number of cells from which separate tables pay, which must be cleared and added up.
const TABLES_FROM: usize = 2048;
/// The number of cells from which comparing with few values pays.
const FEW_FROM: usize = 2 * LANES;
/// The number of cells, in short pieces, after which the histogram is searched again for few values.
const ASK_AFTER: u64 = 4096;
/// The message for more cells than counts can hold.
const TOO_MANY: &str = "a histogram counts at most 2^64 - 1 cells";

mod sealed {
    pub trait Sealed: Copy {
        /// Returns the bits, without sign.
        fn byte(self) -> u8;
        /// Returns the value of these bits.
        fn from_byte(byte: u8) -> Self;
    }

    impl Sealed for u8 {
        fn byte(self) -> u8 {
            self
        }

        fn from_byte(byte: u8) -> Self {
            byte
        }
    }

    impl Sealed for i8 {
        fn byte(self) -> u8 {
            self as u8
        }

        fn from_byte(byte: u8) -> Self {
            byte as i8
        }
    }
}

/// A stored cell of 8 bits: `u8` or `i8`. Sealed.
pub trait Byte: sealed::Sealed {}

impl Byte for u8 {}
impl Byte for i8 {}

/// The histogram of an 8-bit map: the number of cells of each of the 256 values, in 2 KB for any number of cells.
///
/// Add the pieces of a map as they are read, or count parts of it on several threads and [merge](Histogram::merge) them;
/// the [`tally`](Histogram::tally) has the bits of the whole map's tally (Eqs. 2 to 4). A cell is counted by its bits, so
/// cells of type `i8` may be added as the `u8` of a file. A cell takes 0.06 ns in long runs of few values, 0.15 ns in
/// long runs of many values, 0.3 ns if values are mixed; in pieces of some hundred cells 0.15, 0.3 and 0.3 ns, in pieces
/// of 8 cells up to 2 ns (measured, 2026-11-22).
///
/// ```
/// use mean_information::map::{Histogram, encoding::Percent};
/// let mut histogram = Histogram::new();
/// // 255 is -1, unknown.
/// for piece in [&[0_u8, 2, 50, 255][..], &[97, 100]] {
///     histogram.add_cells(piece);
/// }
/// assert_eq!((histogram.cells(), histogram.count(-1_i8)), (6, 1));
/// let tally = histogram.tally::<Percent>();
/// assert_eq!(tally.mean_information(), 0.9160418999066507); // bits per observed cell
/// ```
#[derive(Clone, Debug)]
pub struct Histogram {
    counts: [u64; 256],
    cells: u64,
    /// The values of the last stretch, if they were few; after short pieces, those of the whole histogram.
    recent: Option<[u8; FEW]>,
}

/// Equality of the counts, whatever was counted last.
impl PartialEq for Histogram {
    fn eq(&self, other: &Self) -> bool {
        self.counts == other.counts
    }
}

impl Eq for Histogram {}

impl Default for Histogram {
    fn default() -> Self {
        Self::new()
    }
}

impl Histogram {
    /// Creates an empty histogram.
    pub const fn new() -> Self {
        Self { counts: [0; 256], cells: 0, recent: None }
    }

    /// Creates the histogram of the given cells.
    ///
    /// ```
    /// use mean_information::map::Histogram;
    /// assert_eq!(Histogram::from_cells(&[7_i8, -7, 7]).count(7_i8), 2);
    /// ```
    pub fn from_cells<B: Byte>(cells: &[B]) -> Self {
        let mut histogram = Self::new();
        histogram.add_cells(cells);
        histogram
    }

    /// Creates a histogram from the number of cells of each value, indexed by the value's bits: what
    /// [`counts`](Self::counts) returns, and NumPy's `bincount` of the bytes.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if there are more than `2^64 - 1` cells.
    ///
    /// ```
    /// use mean_information::map::{Histogram, encoding::Percent};
    /// let mut counts = [0; 256];
    /// (counts[3], counts[255]) = (5, 2); // 255 is -1, unknown
    /// let histogram = Histogram::from_counts(&counts)?;
    /// assert_eq!((histogram.cells(), histogram.count(-1_i8)), (7, 2));
    /// assert_eq!(histogram.tally::<Percent>().mean_information(), 0.8056081421684238); // bits per observed cell
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn from_counts(counts: &[u64; 256]) -> Result<Self, Error> {
        let Some(cells) = counts.iter().try_fold(0_u64, |cells, &count| cells.checked_add(count)) else {
            let cells = counts.iter().map(|&count| count as f64).sum();
            return Err(Error::out_of_range("number of cells of the histogram", cells, "at most 2^64 - 1"));
        };
        Ok(Self { counts: *counts, cells, recent: None })
    }

    /// Adds cells.
    ///
    /// # Panics
    /// If there would be more than `2^64 - 1` cells.
    pub fn add_cells<B: Byte>(&mut self, cells: &[B]) {
        let before = self.cells;
        self.add_to_cells(cells.len() as u64);
        for stretch in cells.chunks(STRETCH) {
            if stretch.len() >= FEW_FROM
                && let Some(values) = self.recent
                && let Some(few) = count_few(stretch, values)
            {
                for (value, count) in values.into_iter().zip(few) {
                    self.counts[usize::from(value)] += u64::from(count);
                }
                continue;
            }
            if stretch.len() < TABLES_FROM {
                count_into(core::array::from_mut(&mut self.counts), stretch);
                let ask = before / ASK_AFTER != self.cells / ASK_AFTER;
                self.recent = if ask { few_values(&self.counts) } else { None };
                continue;
            }
            let found = count_all(stretch);
            self.recent = few_values(&found);
            for (count, more) in self.counts.iter_mut().zip(found) {
                *count += u64::from(more);
            }
        }
    }

    /// Adds `count` cells that hold `value`.
    ///
    /// # Panics
    /// If there would be more than `2^64 - 1` cells.
    pub fn add_many<B: Byte>(&mut self, value: B, count: u64) {
        self.add_to_cells(count);
        self.counts[usize::from(value.byte())] += count;
    }

    /// Adds the cells of another part of the map.
    ///
    /// # Panics
    /// If there would be more than `2^64 - 1` cells.
    pub fn merge(&mut self, other: &Self) {
        self.add_to_cells(other.cells);
        for (count, more) in self.counts.iter_mut().zip(other.counts) {
            *count += more;
        }
    }

    /// Adds to the number of all cells.
    fn add_to_cells(&mut self, more: u64) {
        self.cells = self.cells.checked_add(more).expect(TOO_MANY);
    }

    /// Returns the number of cells that hold `value`.
    pub fn count<B: Byte>(&self, value: B) -> u64 {
        self.counts[usize::from(value.byte())]
    }

    /// Returns the number of cells of each value, indexed by the value's bits: -1 is at 255.
    pub fn counts(&self) -> &[u64; 256] {
        &self.counts
    }

    /// Returns the number of all cells, including cells whose value an encoding does not allow.
    pub fn cells(&self) -> u64 {
        self.cells
    }

    /// Computes the tally of the cells in an encoding, without the values that it does not allow: the bits of
    /// [`Encoding::tally`] of all cells counted. At most 256 exact terms are added (Eqs. 2 to 4; proved,
    /// [`sums`](crate::book::sums)).
    ///
    /// For an 8-bit encoding of your own, `Histogram::from_cells(cells).tally::<Self>()` is a fast
    /// [`Encoding::tally`].
    pub fn tally<E: Encoding<Stored: Byte>>(&self) -> Tally<E::Float> {
        let mut tally = Tally::new();
        self.cells_of::<E>().for_each(|(cell, count)| tally.add_many(cell, count));
        tally
    }

    /// Computes the sum of information of the cells in an encoding, skipping values that it does not allow: the same bits
    /// as in their [`tally`](Histogram::tally), and all that Eq. 4 needs.
    ///
    /// ```
    /// use mean_information::map::{Histogram, encoding::Percent};
    /// let mut histogram = Histogram::from_cells(&[-1_i8, 100]);
    /// histogram.add_many(25_i8, 3);
    /// let information = histogram.information_sum::<Percent>();
    /// assert_eq!((information.observed(), information.unknown()), (4, 1));
    /// assert_eq!(information.mean(), 0.39154140665565035); // bits per observed cell
    /// ```
    pub fn information_sum<E: Encoding<Stored: Byte>>(&self) -> InformationSum<E::Float> {
        let mut information = InformationSum::new();
        self.cells_of::<E>().for_each(|(cell, count)| information.add_many(cell, count));
        information
    }

    /// Returns the allowed cells that occur, with their counts.
    fn cells_of<E: Encoding<Stored: Byte>>(&self) -> impl Iterator<Item = (Cell<E::Float>, u64)> {
        let present = (0..=255).zip(self.counts).filter(|&(_, count)| count > 0);
        present.filter_map(|(byte, count)| Some((E::cell(sealed::Sealed::from_byte(byte))?, count)))
    }
}

impl<B: Byte> Extend<B> for Histogram {
    fn extend<I: IntoIterator<Item = B>>(&mut self, cells: I) {
        for cell in cells {
            self.add_many(cell, 1);
        }
    }
}

impl<B: Byte> FromIterator<B> for Histogram {
    fn from_iter<I: IntoIterator<Item = B>>(cells: I) -> Self {
        let mut histogram = Self::new();
        histogram.extend(cells);
        histogram
    }
}

/// Merges the histograms of an iterator's parts, so that `sum()` works on serial and rayon iterators.
impl Sum for Histogram {
    fn sum<I: Iterator<Item = Self>>(parts: I) -> Self {
        parts.fold(Self::new(), |mut sum, part| {
            sum.merge(&part);
            sum
        })
    }
}

/// Merges borrowed parts.
impl<'a> Sum<&'a Self> for Histogram {
    fn sum<I: Iterator<Item = &'a Self>>(parts: I) -> Self {
        parts.fold(Self::new(), |mut sum, part| {
            sum.merge(part);
            sum
        })
    }
}

/// Returns the values that occur, if they are at most [`FEW`]; the first one fills the places that are left.
fn few_values<C: PartialEq + From<u8>>(counts: &[C; 256]) -> Option<[u8; FEW]> {
    let mut present = (0_u8..=255).filter(|&byte| counts[usize::from(byte)] != C::from(0));
    let first = present.next()?;
    let mut values = [first; FEW];
    for value in &mut values[1..] {
        *value = present.next().unwrap_or(first);
    }
    present.next().is_none().then_some(values)
}

/// Counts the cells of each of `values`; `None` if a cell has another value. Repetitions of the first value count 0.
// Apart from its caller: the compiler makes faster vector code of it alone.
#[inline(never)]
fn count_few<B: Byte>(stretch: &[B], values: [u8; FEW]) -> Option<[u32; FEW]> {
    let mut lanes = [[0_u8; LANES]; FEW];
    let (rows, rest) = stretch.as_chunks::<LANES>();
    for row in rows {
        for (lanes, &value) in lanes.iter_mut().zip(&values) {
            for (count, &cell) in lanes.iter_mut().zip(row) {
                *count += u8::from(cell.byte() == value);
            }
        }
    }
    let mut counts = lanes.map(|lanes| lanes.iter().map(|&count| u32::from(count)).sum());
    for (count, value) in counts.iter_mut().zip(values) {
        *count += rest.iter().map(|cell| u32::from(cell.byte() == value)).sum::<u32>();
    }
    for k in 1..FEW {
        if values[k] == values[0] {
            counts[k] = 0;
        }
    }
    (counts.iter().sum::<u32>() as usize == stretch.len()).then_some(counts)
}

/// Counts cells in four tables, because in one table equal neighbours would wait for each other.
fn count_all<B: Byte>(cells: &[B]) -> [u32; 256] {
    let mut tables = [[0_u32; 256]; 4];
    count_into(&mut tables, cells);
    core::array::from_fn(|byte| tables.iter().map(|table| table[byte]).sum())
}

/// Counts cells one by one, in each table in turn; a run of equal cells at once, since grey maps mostly consist of runs.
fn count_into<B: Byte, C: AddAssign + From<u8>, const N: usize>(tables: &mut [[C; 256]; N], cells: &[B]) {
    let (runs, rest) = cells.as_chunks::<RUN>();
    for run in runs {
        let first = run[0].byte();
        // The last one first: mixed cells should not pay for it.
        if run[RUN - 1].byte() == first && run.iter().fold(true, |same, cell| same & (cell.byte() == first)) {
            tables[0][usize::from(first)] += C::from(RUN as u8);
            continue;
        }
        for (k, &cell) in run.iter().enumerate() {
            tables[k % N][usize::from(cell.byte())] += C::from(1);
        }
    }
    for &cell in rest {
        tables[0][usize::from(cell.byte())] += C::from(1);
    }
}

#[cfg(test)]
mod tests;
