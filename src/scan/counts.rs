//! Sums of readings of two levels, as counts: how often each cell was told either.

use super::codes::FREE;
use super::raster::{Area, Raster};
use super::readings::Readings;
use crate::error::Error;
use core::ops::{AddAssign, Range, SubAssign};

/// How often a cell was told one thing.
pub(super) trait Count: Copy + PartialOrd + AddAssign + SubAssign + From<u8> + Into<u32> {
    /// The most scans that are counted.
    const SCANS: u32;

    /// Converts a count that the caller knows to fit.
    fn new(count: u32) -> Self;
}

impl Count for u16 {
    const SCANS: u32 = Self::MAX as u32;

    #[inline]
    fn new(count: u32) -> Self {
        count as Self
    }
}

impl Count for u32 {
    const SCANS: u32 = Self::MAX;

    #[inline]
    fn new(count: u32) -> Self {
        count
    }
}

/// For each cell how often it was told free, and how often occupied, by scans that have one level of log-odds for either.
///
/// The sum of a cell is `n_1 l_1 + n_2 l_2`, multiplied once for all of its readings, and exactly: there is nothing to round.
#[derive(Clone, Debug)]
pub(super) struct Counts<C> {
    /// The levels below and above 0, in units of `2^-80` nats; 0 before there is one.
    levels: [i128; 2],
    /// How often each cell was told free, but for the last scans. The three rasters are of one area.
    free: Raster<C>,
    /// How often each cell was told free by the last scans: in bytes, of which 16 are added at once.
    lately: Raster<u8>,
    /// How many scans those are, some of which may be taken out again: no byte is more.
    late: u8,
    /// How often each cell was told occupied.
    occupied: Raster<C>,
    /// The number of scans learned, those taken out again included: no count is more.
    scans: u32,
}

impl<C: Count> Counts<C> {
    /// Creates the counts of an area, all 0.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] if there are more cells than the limit; [`Error::NoMemory`].
    pub(super) fn new(area: Area, limit: u64) -> Result<Self, Error> {
        let raster = || Raster::new(area, C::new(0), limit);
        let lately = Raster::new(area, 0, limit)?;
        Ok(Self { levels: [0; 2], free: raster()?, lately, late: 0, occupied: raster()?, scans: 0 })
    }

    /// Makes room for the area `whole`, of which only `used` has counts so far.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] if `whole` exceeds the limit; [`Error::NoMemory`]. Then nothing changes.
    pub(super) fn make_room(&mut self, used: Area, whole: Area, limit: u64) -> Result<(), Error> {
        let grown = |counts: &Raster<C>| counts.grown(used, whole, C::new(0), limit);
        let grown = (grown(&self.free)?, self.lately.grown(used, whole, 0, limit)?, grown(&self.occupied)?);
        // All or none: they stay of one area.
        if let (Some(free), Some(lately), Some(occupied)) = grown {
            (self.free, self.lately, self.occupied) = (free, lately, occupied);
        }
        Ok(())
    }

    /// Copies the counts of an area into integers of another width, in which they fit.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] if there are more cells than the limit; [`Error::NoMemory`].
    pub(super) fn copied<D: Count>(&self, area: Area, limit: u64) -> Result<Counts<D>, Error> {
        let mut copies = Counts::new(area, limit)?;
        for (index, [free, occupied]) in self.counts(area).enumerate() {
            copies.free.set(index, D::new(free));
            copies.occupied.set(index, D::new(occupied));
        }
        Ok(Counts { levels: self.levels, scans: self.scans, ..copies })
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
        if self.late == u8::MAX {
            self.settle();
        }
        self.late += 1;
        for row in readings.area.rows() {
            let counts = self.lately.row_mut(readings.area, row);
            for (count, &code) in counts.iter_mut().zip(readings.codes.row(readings.area, row)) {
                // The codes are bits.
                *count += code & FREE;
            }
        }
        self.for_each_other(readings, |count| *count += C::from(1));
    }

    /// Adds what the last scans told to what all others did.
    fn settle(&mut self) {
        for (free, lately) in self.free.all_mut().iter_mut().zip(self.lately.all_mut()) {
            *free += C::from(core::mem::take(lately));
        }
        self.late = 0;
    }

    /// Takes readings out; if counts are less than those told, none is changed, and the answer is false.
    pub(super) fn take(&mut self, readings: &Readings) -> bool {
        if self.levels_with(readings) != Some(self.levels) {
            return false;
        }
        let mut are_held = true;
        self.for_each_free(readings, |free, lately, told| {
            are_held &= told == 0 || *lately > 0 || *free > C::from(0);
        });
        self.for_each_other(readings, |count| are_held &= *count > C::from(0));
        if are_held {
            self.for_each_free(readings, |free, lately, told| {
                let late = told.min(*lately);
                *lately -= late;
                *free -= C::from(told - late);
            });
            self.for_each_other(readings, |count| *count -= C::from(1));
        }
        are_held
    }

    /// Calls `each` with both free counts of each cell that is told free, and 1; of others perhaps with 0.
    #[inline]
    fn for_each_free(&mut self, readings: &Readings, mut each: impl FnMut(&mut C, &mut u8, u8)) {
        for row in readings.area.rows() {
            let (free, lately) =
                (self.free.row_mut(readings.area, row), self.lately.row_mut(readings.area, row));
            let (start, codes) = readings.told(row);
            for ((free, lately), &code) in free[start..].iter_mut().zip(&mut lately[start..]).zip(codes) {
                each(free, lately, code & FREE);
            }
        }
    }

    /// Calls `each` with the count of each cell that is told occupied, or has a reading of its own.
    #[inline]
    fn for_each_other(&mut self, readings: &Readings, mut each: impl FnMut(&mut C)) {
        for &index in &readings.occupied {
            each(self.occupied.cell_mut(readings.codes.cell_at(index)));
        }
        for reading in &readings.others {
            // Of two occupancies both may be at the upper limit; at the lower one they are the same to a scan, and elsewhere their
            // log-odds differ: no second one of free cells was learned.
            debug_assert!(reading.log_odds > 0);
            each(self.occupied.cell_mut(reading.cell));
        }
    }

    /// Returns how often each cell of an area was told free, and how often occupied, row by row from the lowest.
    fn counts(&self, area: Area) -> impl Iterator<Item = [u32; 2]> {
        area.rows().flat_map(move |row| self.counts_of(area, row, 0..area.size()[0]))
    }

    /// Returns the same of the columns of a row of an area.
    #[inline]
    fn counts_of(&self, area: Area, row: i64, columns: Range<usize>) -> impl Iterator<Item = [u32; 2]> {
        let [free, occupied] =
            [&self.free, &self.occupied].map(|counts| &counts.row(area, row)[columns.clone()]);
        let lately = &self.lately.row(area, row)[columns];
        let cells = free.iter().zip(lately).zip(occupied);
        cells.map(|((&free, &lately), &occupied)| [free.into() + u32::from(lately), occupied.into()])
    }

    /// Computes the sum of log-odds of counts, and that of their magnitudes: below `2^33 40 2^80`.
    #[inline]
    fn pair(&self, counts: [u32; 2]) -> (i128, i128) {
        let ([free, occupied], [below, above]) = (counts.map(i128::from), self.levels);
        let (below, above) = (free * below, occupied * above);
        (above + below, above - below)
    }

    /// Returns the sum of log-odds of a cell of the rasters.
    pub(super) fn sum_of(&self, cell: [i64; 2]) -> i128 {
        let free = (*self.free.cell(cell)).into() + u32::from(*self.lately.cell(cell));
        self.pair([free, (*self.occupied.cell(cell)).into()]).0
    }

    /// Returns runs of cells of one sum, with their lengths, of the columns of a row of an area.
    pub(super) fn runs(
        &self,
        area: Area,
        row: i64,
        columns: Range<usize>,
    ) -> impl Iterator<Item = (i128, u64)> {
        let mut cells = self.counts_of(area, row, columns);
        let mut next = cells.next();
        core::iter::from_fn(move || {
            let (first, mut length) = (next?, 1);
            next = cells.find(|&counts| {
                let is_same = counts == first;
                length += u64::from(is_same);
                !is_same
            });
            Some((self.pair(first).0, length))
        })
    }

    /// Returns the sum of log-odds of each cell of an area, and that of their magnitudes, row by row from the lowest.
    pub(super) fn pairs(&self, area: Area) -> impl Iterator<Item = (i128, i128)> {
        self.counts(area).map(|counts| self.pair(counts))
    }

    /// Tells whether the cells of `area` that are not in `inner` were told nothing; without an inner area, all cells.
    pub(super) fn are_within(&self, area: Area, inner: Option<Area>) -> bool {
        let are_none = |counts: &Raster<C>| counts.is_filled_outside(area, inner, C::new(0));
        are_none(&self.free) && are_none(&self.occupied) && self.lately.is_filled_outside(area, inner, 0)
    }
}

#[cfg(test)]
mod tests;
