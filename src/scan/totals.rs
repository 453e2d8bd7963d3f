//! Sums of any readings: integers of 128 bits for each cell, and their magnitudes if wanted.

use super::codes::{FREE, OCCUPIED};
use super::raster::{Area, Raster};
use super::readings::Readings;
use crate::error::Error;

/// For each cell the sum of the log-odds that scans told it, and if wanted that of their magnitudes, in units of `2^-80` nats.
#[derive(Clone, Debug)]
pub(super) struct Totals {
    log_odds: Raster<i128>,
    /// `Σ|l|`, if the map was asked to keep it.
    magnitudes: Option<Raster<i128>>,
}

impl Totals {
    /// Creates the sums of an area from those of each cell and of its magnitudes, row by row from the lowest.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] if there are more cells than the limit; [`Error::NoMemory`].
    pub(super) fn new(
        area: Area,
        with_magnitudes: bool,
        limit: u64,
        pairs: impl Iterator<Item = (i128, i128)>,
    ) -> Result<Self, Error> {
        let raster = || Raster::new(area, 0, limit);
        let (mut log_odds, mut magnitudes) =
            (raster()?, if with_magnitudes { Some(raster()?) } else { None });
        for (index, (sum, magnitude)) in pairs.enumerate() {
            log_odds.set(index, sum);
            if let Some(magnitudes) = &mut magnitudes {
                magnitudes.set(index, magnitude);
            }
        }
        Ok(Self { log_odds, magnitudes })
    }

    /// Makes room for the area `whole`, of which only `used` has sums so far.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] if `whole` exceeds the limit; [`Error::NoMemory`]. Then no sum changes.
    pub(super) fn make_room(&mut self, used: Area, whole: Area, limit: u64) -> Result<(), Error> {
        self.log_odds.make_room(used, whole, 0, limit)?;
        if let Some(magnitudes) = &mut self.magnitudes {
            magnitudes.make_room(used, whole, 0, limit)?;
        }
        Ok(())
    }

    /// Adds readings of cells within the area, or takes them out again.
    pub(super) fn add(&mut self, readings: &Readings, is_removal: bool) {
        let sign = if is_removal { -1 } else { 1 };
        // 2^41 scans of 40 nats would not fill the integer: `scan.md`, "The sum".
        change(&mut self.log_odds, readings, |log_odds| sign * log_odds);
        if let Some(magnitudes) = &mut self.magnitudes {
            change(magnitudes, readings, |log_odds| sign * log_odds.abs());
        }
    }

    /// Tells whether magnitudes are no less than the sums that they belong to, in the cells of these readings.
    pub(super) fn are_magnitudes(&self, readings: &Readings) -> bool {
        let mut are_magnitudes = true;
        if let Some(magnitudes) = &self.magnitudes {
            readings.for_each(|reading| {
                are_magnitudes &= *magnitudes.cell(reading.cell) >= self.sum_of(reading.cell).abs();
            });
        }
        are_magnitudes
    }

    /// Returns the sum of log-odds of a cell of the rasters.
    pub(super) fn sum_of(&self, cell: [i64; 2]) -> i128 {
        *self.log_odds.cell(cell)
    }

    /// Returns runs of cells of one sum, with their lengths, of the columns of a row of an area.
    pub(super) fn runs(
        &self,
        area: Area,
        row: i64,
        columns: core::ops::Range<usize>,
    ) -> impl Iterator<Item = (i128, u64)> {
        let runs = self.log_odds.row(area, row)[columns].chunk_by(|a, b| a == b);
        runs.map(|run| (run[0], run.len() as u64))
    }

    /// Returns the sum of log-odds of each cell of an area, and that of their magnitudes, which are 0 if they are not kept, row by
    /// row from the lowest.
    pub(super) fn pairs(&self, area: Area) -> impl Iterator<Item = (i128, i128)> {
        let mut magnitudes =
            self.magnitudes.iter().flat_map(move |magnitudes| magnitudes.rows(area).flatten());
        let sums = self.log_odds.rows(area).flatten();
        sums.map(move |&sum| (sum, magnitudes.next().copied().unwrap_or(0)))
    }

    /// Tells whether the cells of `area` that are not in `inner` are all 0; without an inner area, all cells.
    pub(super) fn are_within(&self, area: Area, inner: Option<Area>) -> bool {
        let is_zero = |raster: &Raster<i128>| raster.is_filled_outside(area, inner, 0);
        is_zero(&self.log_odds) && self.magnitudes.as_ref().is_none_or(is_zero)
    }
}

/// Adds to the sum of each cell what `of` makes of its reading, which makes 0 of 0.
fn change(sums: &mut Raster<i128>, readings: &Readings, of: impl Fn(i128) -> i128) {
    let [free, occupied] = readings.levels.map(&of);
    // By code.
    let levels = [0, free, occupied, 0];
    for row in readings.area.rows() {
        let sums = sums.row_mut(readings.area, row);
        let (start, codes) = readings.told(row);
        for (sum, &code) in sums[start..].iter_mut().zip(codes) {
            *sum += levels[usize::from(code & (FREE | OCCUPIED))];
        }
    }
    for reading in &readings.others {
        *sums.cell_mut(reading.cell) += of(reading.log_odds);
    }
}
