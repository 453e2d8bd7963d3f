//! What a map of scans stores: for each cell the sum of the log-odds that scans told it, and if wanted the sum of their magnitudes,
//! in units of `2^-80` nats.

use super::counts::Counts;
use super::raster::Area;
use super::readings::Readings;
use super::totals::Totals;
use crate::error::Error;
use core::ops::Range;

/// The sums of the cells of a rectangle. Cells outside of it are 0.
#[derive(Clone, Debug)]
pub(super) struct Sums {
    /// The rectangle that beams have crossed; the rasters may have room beyond it.
    seen: Area,
    with_magnitudes: bool,
    cells: Cells,
}

/// The sums of cells, as small as they can be stored.
#[derive(Clone, Debug)]
enum Cells {
    /// While readings are of two levels at most, one for free and one for occupied: 5 bytes a cell, which have the magnitudes, too.
    Counted(Counts<u16>),
    /// After more than `2^16 - 1` scans: 9 bytes a cell.
    CountedFar(Counts<u32>),
    /// 16 bytes a cell, and 16 for magnitudes.
    Summed(Totals),
}

impl Sums {
    /// Creates the sums of an area, all 0.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] if there are more cells than the limit; [`Error::NoMemory`].
    pub(super) fn new(seen: Area, with_magnitudes: bool, limit: u64) -> Result<Self, Error> {
        Ok(Self { seen, with_magnitudes, cells: Cells::Counted(Counts::new(seen, limit)?) })
    }

    /// Grows to the area `whole`, which holds the one so far.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] if `whole` exceeds the limit; [`Error::NoMemory`]. Then no sum changes.
    pub(super) fn grow(&mut self, whole: Area, limit: u64) -> Result<(), Error> {
        match &mut self.cells {
            Cells::Counted(counts) => counts.make_room(self.seen, whole, limit)?,
            Cells::CountedFar(counts) => counts.make_room(self.seen, whole, limit)?,
            Cells::Summed(totals) => totals.make_room(self.seen, whole, limit)?,
        }
        self.seen = whole;
        Ok(())
    }

    /// Makes the sums able to take readings, whatever their levels.
    ///
    /// # Errors
    /// [`Error::NoMemory`]; then no sum changes.
    pub(super) fn learn(&mut self, readings: &Readings, limit: u64) -> Result<(), Error> {
        let is_known = match &mut self.cells {
            Cells::Counted(counts) => {
                if counts.are_full() {
                    self.cells = Cells::CountedFar(counts.copied(self.seen, limit)?);
                    return self.learn(readings, limit);
                }
                counts.learn(readings)
            }
            Cells::CountedFar(counts) => !counts.are_full() && counts.learn(readings),
            Cells::Summed(_) => true,
        };
        if is_known { Ok(()) } else { self.sum_up(limit) }
    }

    /// Stores sums in place of counts.
    fn sum_up(&mut self, limit: u64) -> Result<(), Error> {
        let totals = Totals::new(self.seen, self.with_magnitudes, limit, self.all_pairs())?;
        self.cells = Cells::Summed(totals);
        Ok(())
    }

    /// Adds readings that were [learned](Self::learn), of cells within the area.
    pub(super) fn add(&mut self, readings: &Readings) {
        match &mut self.cells {
            Cells::Counted(counts) => counts.add(readings),
            Cells::CountedFar(counts) => counts.add(readings),
            Cells::Summed(totals) => totals.add(readings, false),
        }
    }

    /// Takes readings out, after which all cells outside of `left` must be 0, and magnitudes no less than their sums; no area is
    /// none of the cells. If that is not so, the answer is false, and no sum has changed.
    ///
    /// # Errors
    /// [`Error::NoMemory`]; then no sum changes.
    pub(super) fn take(
        &mut self,
        readings: &Readings,
        left: Option<Area>,
        limit: u64,
    ) -> Result<bool, Error> {
        let is_taken = match &mut self.cells {
            Cells::Counted(counts) => counts.take(readings),
            Cells::CountedFar(counts) => counts.take(readings),
            Cells::Summed(_) => false,
        };
        if !is_taken {
            // Never told, or not so often: sums can be less than nothing.
            self.sum_up(limit)?;
        }
        if let Cells::Summed(totals) = &mut self.cells {
            totals.add(readings, true);
        }
        let is_gone = left == Some(self.seen) || self.are_within(left);
        let is_whole = match &self.cells {
            Cells::Summed(totals) => totals.are_magnitudes(readings),
            _ => true,
        };
        if !(is_gone && is_whole) {
            self.add(readings);
        }
        Ok(is_gone && is_whole)
    }

    /// Tells whether all cells outside of `area` are 0; no area is none of the cells.
    fn are_within(&self, area: Option<Area>) -> bool {
        match &self.cells {
            Cells::Counted(counts) => counts.are_within(self.seen, area),
            Cells::CountedFar(counts) => counts.are_within(self.seen, area),
            Cells::Summed(totals) => totals.are_within(self.seen, area),
        }
    }

    /// Shrinks to an area outside of which all cells are 0. The memory stays, for scans to come.
    pub(super) fn shrink(&mut self, area: Area) {
        self.seen = area;
    }

    /// Returns the rectangle that beams have crossed.
    pub(super) fn seen(&self) -> Area {
        self.seen
    }

    /// Returns the sum of log-odds of a cell of the rasters.
    pub(super) fn sum_of(&self, cell: [i64; 2]) -> i128 {
        match &self.cells {
            Cells::Counted(counts) => counts.sum_of(cell),
            Cells::CountedFar(counts) => counts.sum_of(cell),
            Cells::Summed(totals) => totals.sum_of(cell),
        }
    }

    /// Returns runs of cells of one sum of log-odds, with their lengths, of the columns of a row of the rectangle.
    pub(super) fn runs(&self, row: i64, columns: Range<usize>) -> impl Iterator<Item = (i128, u64)> {
        let (counted, far, summed) = self.either();
        let counted = counted.map(|counts| counts.runs(self.seen, row, columns.clone()));
        let far = far.map(|counts| counts.runs(self.seen, row, columns.clone()));
        let summed = summed.map(|totals| totals.runs(self.seen, row, columns));
        counted.into_iter().flatten().chain(far.into_iter().flatten()).chain(summed.into_iter().flatten())
    }

    /// Returns the sums of log-odds, row by row from the lowest.
    pub(super) fn log_odds(&self) -> impl Iterator<Item = i128> {
        self.all_pairs().map(|(sum, _)| sum)
    }

    /// Returns `Σ l` and `Σ|l|` of each cell, row by row from the lowest; `None` if magnitudes are not kept.
    pub(super) fn pairs(&self) -> Option<impl Iterator<Item = (i128, i128)>> {
        self.with_magnitudes.then(|| self.all_pairs())
    }

    /// Returns `Σ l` and `Σ|l|` of each cell, the latter 0 if it is not known.
    fn all_pairs(&self) -> impl Iterator<Item = (i128, i128)> {
        let (counted, far, summed) = self.either();
        let counted = counted.map(|counts| counts.pairs(self.seen));
        let far = far.map(|counts| counts.pairs(self.seen));
        let summed = summed.map(|totals| totals.pairs(self.seen));
        counted.into_iter().flatten().chain(far.into_iter().flatten()).chain(summed.into_iter().flatten())
    }

    /// Returns what there is of the three.
    fn either(&self) -> (Option<&Counts<u16>>, Option<&Counts<u32>>, Option<&Totals>) {
        match &self.cells {
            Cells::Counted(counts) => (Some(counts), None, None),
            Cells::CountedFar(counts) => (None, Some(counts), None),
            Cells::Summed(totals) => (None, None, Some(totals)),
        }
    }
}

/// The same rectangle and the same sums in it, whatever room there is beyond, and however they are stored.
impl PartialEq for Sums {
    fn eq(&self, other: &Self) -> bool {
        let same_sums = match (self.pairs(), other.pairs()) {
            (Some(a), Some(b)) => a.eq(b),
            (a, b) => a.is_none() && b.is_none() && self.log_odds().eq(other.log_odds()),
        };
        self.seen == other.seen && same_sums
    }
}
