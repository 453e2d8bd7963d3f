//! Sums of readings of two levels, as counts: how often each cell was told either.

use super::codes::{FREE, OCCUPIED};
use super::raster::{Area, Raster};
use super::readings::Readings;
use crate::error::Error;
use core::ops::{AddAssign, SubAssign};

/// How often a cell was told free, and how often occupied: the lower and the upper half of an integer.
pub(super) trait Pair: Copy + PartialEq + AddAssign + SubAssign {
    /// No count.
    const NONE: Self;
    /// The most scans that the counts can hold.
    const SCANS: u32;

    /// Joins two counts, which the caller knows to fit.
    fn new(counts: [u32; 2]) -> Self;

    /// Returns the counts of one reading of a code.
    fn of(code: u8) -> Self;

    /// Returns both counts.
    fn counts(self) -> [u32; 2];
}

/// Implements [`Pair`] for an integer of twice the bits of `$half`.
macro_rules! impl_pair {
    ($pair:ident, $half:ident) => {
        impl Pair for $pair {
            const NONE: Self = 0;
            const SCANS: u32 = $half::MAX as u32;

            fn new([free, occupied]: [u32; 2]) -> Self {
                $pair::from(free as $half) | $pair::from(occupied as $half) << $half::BITS
            }

            #[inline]
            fn of(code: u8) -> Self {
                // The codes are bits.
                $pair::from(code & FREE) | $pair::from(code & OCCUPIED) << ($half::BITS - 1)
            }

            #[inline]
            fn counts(self) -> [u32; 2] {
                [u32::from(self as $half), u32::from((self >> $half::BITS) as $half)]
            }
        }
    };
}
impl_pair!(u32, u16);
impl_pair!(u64, u32);

/// For each cell how often it was told free, and how often occupied, by scans that have one level of log-odds for either.
///
/// The sum of a cell is `n_1 l_1 + n_2 l_2`, multiplied once for all of its readings, and exactly: there is nothing to round.
#[derive(Clone, Debug)]
pub(super) struct Counts<C> {
    /// The levels below and above 0, in units of `2^-80` nats; 0 before there is one.
    levels: [i128; 2],
    cells: Raster<C>,
    /// The number of scans learned, those taken out again included: no count is more.
    scans: u32,
}

impl<C: Pair> Counts<C> {
    /// Creates the counts of an area, all 0.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] if there are more cells than the limit, or no memory for them.
    pub(super) fn new(area: Area, limit: u64) -> Result<Self, Error> {
        Ok(Self { levels: [0; 2], cells: Raster::new(area, C::NONE, limit)?, scans: 0 })
    }

    /// Makes room for the area `whole`, of which only `used` has counts so far.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] if `whole` exceeds the limit, or there is no memory; then nothing changes.
    pub(super) fn make_room(&mut self, used: Area, whole: Area, limit: u64) -> Result<(), Error> {
        self.cells.make_room(used, whole, C::NONE, limit)
    }

    /// Copies the counts of an area into integers of another width, in which they fit.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] if there are more cells than the limit, or no memory for them.
    pub(super) fn copied<D: Pair>(&self, area: Area, limit: u64) -> Result<Counts<D>, Error> {
        let mut cells = Raster::new(area, D::NONE, limit)?;
        for (index, counts) in self.cells.rows(area).flatten().enumerate() {
            cells.set(index, D::new(counts.counts()));
        }
        Ok(Counts { levels: self.levels, cells, scans: self.scans })
    }

    /// Tells whether another scan may be more than the counts can hold.
    pub(super) fn are_full(&self) -> bool {
        self.scans == C::SCANS
    }

    /// Makes the counts able to take the readings of another scan; if these have more levels than one below and one above 0,
    /// nothing changes, and the answer is false.
    pub(super) fn learn(&mut self, readings: &Readings) -> bool {
        let levels = self.levels_with(readings);
        if let Some(levels) = levels {
            self.levels = levels;
            self.scans += 1;
        }
        levels.is_some()
    }

    /// Finds the levels of these readings and of all before; `None` if they are too many.
    fn levels_with(&self, readings: &Readings) -> Option<[i128; 2]> {
        let mut levels = self.levels;
        let others = readings.others.iter().map(|reading| reading.log_odds);
        for level in readings.levels.into_iter().chain(others).filter(|&level| level != 0) {
            let known = &mut levels[usize::from(level > 0)];
            if *known == 0 {
                *known = level;
            }
            if *known != level {
                return None;
            }
        }
        Some(levels)
    }

    /// Adds readings that were [learned](Self::learn), of cells within the area.
    pub(super) fn add(&mut self, readings: &Readings) {
        self.change(readings, |counts, one| *counts += one);
    }

    /// Takes readings out; if counts are less than those told, none is changed, and the answer is false.
    pub(super) fn take(&mut self, readings: &Readings) -> bool {
        if self.levels_with(readings) != Some(self.levels) {
            return false;
        }
        let mut are_held = true;
        self.change(readings, |counts, one| {
            let [held, told] = [counts.counts(), one.counts()];
            are_held &= held[0] >= told[0] && held[1] >= told[1];
        });
        if are_held {
            self.change(readings, |counts, one| *counts -= one);
        }
        are_held
    }

    /// Calls `change` with the counts of each cell that has a reading, and those of the reading; for others perhaps with none.
    #[inline]
    fn change(&mut self, readings: &Readings, mut change: impl FnMut(&mut C, C)) {
        for row in readings.area.rows() {
            let counts = self.cells.row_mut(readings.area, row);
            let (start, codes) = readings.told(row);
            for (counts, &code) in counts[start..].iter_mut().zip(codes) {
                change(counts, C::of(code));
            }
        }
        for reading in &readings.others {
            let code = if reading.log_odds < 0 { FREE } else { OCCUPIED };
            change(self.cells.cell_mut(reading.cell), C::of(code));
        }
    }

    /// Computes the sum of log-odds of counts, and that of their magnitudes: below `2^33 40 2^80`.
    #[inline]
    fn pair(&self, counts: C) -> (i128, i128) {
        let ([free, occupied], [below, above]) = (counts.counts().map(i128::from), self.levels);
        let (below, above) = (free * below, occupied * above);
        (above + below, above - below)
    }

    /// Returns the sum of log-odds of a cell of the raster.
    pub(super) fn sum_of(&self, cell: [i64; 2]) -> i128 {
        self.pair(*self.cells.cell(cell)).0
    }

    /// Returns runs of cells of one sum, with their lengths, of the columns of a row of an area.
    pub(super) fn runs(
        &self,
        area: Area,
        row: i64,
        columns: core::ops::Range<usize>,
    ) -> impl Iterator<Item = (i128, u64)> {
        let runs = self.cells.row(area, row)[columns].chunk_by(|a, b| a == b);
        runs.map(|run| (self.pair(run[0]).0, run.len() as u64))
    }

    /// Returns the sum of log-odds of each cell of an area, and that of their magnitudes, row by row from the lowest.
    pub(super) fn pairs(&self, area: Area) -> impl Iterator<Item = (i128, i128)> {
        self.cells.rows(area).flatten().map(|&counts| self.pair(counts))
    }

    /// Tells whether the cells of `area` that are not in `inner` were told nothing; without an inner area, all cells.
    pub(super) fn are_within(&self, area: Area, inner: Option<Area>) -> bool {
        self.cells.is_filled_outside(area, inner, C::NONE)
    }
}

#[cfg(test)]
mod tests {
    use super::super::codes::NOTHING;
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn pairs_hold_their_counts(free in any::<u16>(), occupied in any::<u16>()) {
            let counts = [free, occupied].map(u32::from);
            prop_assert_eq!((u32::new(counts).counts(), u64::new(counts).counts()), (counts, counts));
            let wide = counts.map(|count| count << 15);
            prop_assert_eq!(u64::new(wide).counts(), wide);
        }
    }

    #[test]
    fn codes_are_one_reading() {
        for (code, counts) in [(NOTHING, [0, 0]), (FREE, [1, 0]), (OCCUPIED, [0, 1])] {
            assert_eq!((u32::of(code).counts(), u64::of(code).counts()), (counts, counts));
        }
    }

    /// No count is lost where there are as many scans as the counts can hold, and one more.
    #[test]
    fn counts_are_full_before_they_overflow() {
        let area = Area::of_cell([3, -2]);
        let codes = Raster::new(area, FREE, 1).unwrap();
        let readings = Readings { area, codes, levels: [-7, 0], others: alloc::vec::Vec::new() };
        let mut counts = Counts::<u32>::new(area, 1).unwrap();
        while !counts.are_full() {
            assert!(counts.learn(&readings));
            counts.add(&readings);
        }
        assert_eq!(counts.sum_of([3, -2]), -7 * i128::from(u16::MAX));
        let mut wider: Counts<u64> = counts.copied(area, 1).unwrap();
        assert!(!wider.are_full() && wider.learn(&readings));
        wider.add(&readings);
        assert_eq!(wider.sum_of([3, -2]), -7 << 16);
        assert!(wider.take(&readings) && counts.take(&readings));
        assert_eq!(wider.sum_of([3, -2]), counts.sum_of([3, -2]) - 7);
        // More than it was told, and of a level that it was not told.
        let mut empty = Counts::<u32>::new(area, 1).unwrap();
        assert!(!empty.take(&readings) && empty.learn(&readings) && !empty.take(&readings));
        let codes = Raster::new(area, FREE, 1).unwrap();
        assert!(!wider.take(&Readings { area, codes, levels: [-8, 0], others: alloc::vec::Vec::new() }));
    }
}
