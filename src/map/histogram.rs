//! How often each of the 256 bytes occurs: all that a measure needs of a map of bytes.
//!
//! Maps of bytes mostly hold very few values. So where a stretch held at most [`FEW`], the next is compared with
//! these, many cells at once; only where something else turns up are its cells counted one by one, or in runs.

use super::Encoding;
use crate::cell::Cell;
use crate::tally::{Information, Tally};
use core::iter::Sum;
use core::ops::AddAssign;

/// The most cells of a stretch: counts below fit a byte and 64 lanes.
const STRETCH: usize = 255 * LANES;
const LANES: usize = 64;
/// Comparing with more values takes as long as counting.
const FEW: usize = 4;
/// The cells of a run that is counted at once.
const RUN: usize = 32;
/// The cells that tables of their own are worth, which must be cleared and added up.
const TABLES_FROM: usize = 2048;
/// The cells that comparing with few values is worth.
const FEW_FROM: usize = 2 * LANES;
/// After so many cells in pieces of fewer it is asked whether all values so far are few.
const ASK_AFTER: u64 = 4096;
/// More than counts can hold.
pub(super) const TOO_MANY: &str = "a histogram counts at most 2^64 - 1 cells";

mod sealed {
    pub trait Sealed: Copy {
        /// The same bits, without sign.
        fn byte(self) -> u8;
        /// The value of these bits.
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

/// How often each of the 256 values of an 8-bit map occurs: all that its measures need, in 2 KB for any number of
/// cells.
///
/// Count a map in pieces as they are read, or parts of it on several threads and [merge](Histogram::merge) them; the
/// [`tally`](Histogram::tally) then has the bits of the whole map's. A cell is counted by its bits, so those that are
/// `i8` may come as the `u8` of a file. A cell takes 0.06 ns in long runs of few values, 0.15 in those of many, 0.3 if all
/// are mixed; in pieces of some hundred cells 0.15, 0.3 and 0.3, in pieces of 8 up to 2 (measured, 2026-11-22).
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
    /// All values of the last stretch, if they were few; of short ones, of all before them.
    recent: Option<[u8; FEW]>,
}

/// By the counts: what was counted last is no matter.
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
    /// That of no cells.
    pub const fn new() -> Self {
        Self { counts: [0; 256], cells: 0, recent: None }
    }

    /// That of the given cells.
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

    /// That of so many cells of each value, at the value's bits; `None` if they are more than `2^64 - 1`.
    #[cfg(feature = "serde")]
    pub(super) fn from_counts(counts: &[u64; 256]) -> Option<Self> {
        let cells = counts.iter().try_fold(0_u64, |cells, &count| cells.checked_add(count))?;
        Some(Self { counts: *counts, cells, recent: None })
    }

    /// Counts more cells.
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

    /// Counts `count` cells that hold `value`.
    ///
    /// # Panics
    /// If there would be more than `2^64 - 1` cells.
    pub fn add_many<B: Byte>(&mut self, value: B, count: u64) {
        self.add_to_cells(count);
        self.counts[usize::from(value.byte())] += count;
    }

    /// Counts the cells of another part of the map.
    ///
    /// # Panics
    /// If there would be more than `2^64 - 1` cells.
    pub fn merge(&mut self, other: &Self) {
        self.add_to_cells(other.cells);
        for (count, more) in self.counts.iter_mut().zip(other.counts) {
            *count += more;
        }
    }

    fn add_to_cells(&mut self, more: u64) {
        self.cells = self.cells.checked_add(more).expect(TOO_MANY);
    }

    /// The number of cells that hold `value`.
    pub fn count<B: Byte>(&self, value: B) -> u64 {
        self.counts[usize::from(value.byte())]
    }

    /// The number of cells of each value, at the value's bits: -1 is at 255.
    pub fn counts(&self) -> &[u64; 256] {
        &self.counts
    }

    /// The number of all cells, also of those whose value an encoding does not allow.
    pub fn cells(&self) -> u64 {
        self.cells
    }

    /// The tally of the cells in an encoding, passing over values that it does not allow: the bits of
    /// [`Encoding::tally`] of all cells counted. At most 256 exact terms are added (Eqs. 2 to 4; proved,
    /// [`sums`](crate::book::sums)).
    ///
    /// An encoding of your own in 8 bits has a fast [`Encoding::tally`] by
    /// `Histogram::from_cells(cells).tally::<Self>()`.
    pub fn tally<E: Encoding<Stored: Byte>>(&self) -> Tally<E::Float> {
        let mut tally = Tally::new();
        self.cells_of::<E>().for_each(|(cell, count)| tally.add_many(cell, count));
        tally
    }

    /// The information of the cells in an encoding, passing over values that it does not allow: the bits of
    /// that of their [`tally`](Histogram::tally), all that Eq. 4 needs.
    ///
    /// ```
    /// use mean_information::map::{Histogram, encoding::Percent};
    /// let mut histogram = Histogram::from_cells(&[-1_i8, 100]);
    /// histogram.add_many(25_i8, 3);
    /// let information = histogram.information::<Percent>();
    /// assert_eq!((information.observed(), information.unknown()), (4, 1));
    /// assert_eq!(information.mean(), 0.39154140665565035); // bits per observed cell
    /// ```
    pub fn information<E: Encoding<Stored: Byte>>(&self) -> Information<E::Float> {
        let mut information = Information::new();
        self.cells_of::<E>().for_each(|(cell, count)| information.add_many(cell, count));
        information
    }

    /// The allowed cells that occur, and how often.
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

/// That of all parts of a map, also of a rayon iterator: [`merge`](Histogram::merge) by `sum()`.
impl Sum for Histogram {
    fn sum<I: Iterator<Item = Self>>(parts: I) -> Self {
        parts.fold(Self::new(), |mut sum, part| {
            sum.merge(&part);
            sum
        })
    }
}

/// The values that occur, if they are few; filled up with one of them.
fn few_values<C: PartialEq + From<u8>>(counts: &[C; 256]) -> Option<[u8; FEW]> {
    let mut present = (0_u8..=255).filter(|&byte| counts[usize::from(byte)] != C::from(0));
    let first = present.next()?;
    let mut values = [first; FEW];
    for value in &mut values[1..] {
        *value = present.next().unwrap_or(first);
    }
    present.next().is_none().then_some(values)
}

/// How often each value occurs, if no other does; the first takes what is its own only once.
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

/// Into four tables, since equal neighbours would wait for each other in one.
fn count_all<B: Byte>(cells: &[B]) -> [u32; 256] {
    let mut tables = [[0_u32; 256]; 4];
    count_into(&mut tables, cells);
    core::array::from_fn(|byte| tables.iter().map(|table| table[byte]).sum())
}

/// One by one, into each table in turn. But runs at once: grey maps are mostly runs of many values.
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
