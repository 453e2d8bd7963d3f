//! What a map of scans stores: for each cell the sum of the log-odds that scans told it, and if wanted the sum of their magnitudes,
//! in units of `2^-80` nats.

use super::raster::{Area, Raster};
use super::rays::Reading;
use crate::error::Error;

/// The sums of the cells of a rectangle. Cells outside of it are 0.
#[derive(Clone, Debug)]
pub(super) struct Sums {
    /// The rectangle that beams have crossed; the rasters may have room beyond it.
    seen: Area,
    log_odds: Raster<i128>,
    /// `Σ|l|`, if the map was asked to keep it.
    magnitudes: Option<Raster<i128>>,
}

impl Sums {
    /// Creates the sums of an area, all 0.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] if there are more cells than the limit, or no memory for them.
    pub(super) fn new(seen: Area, with_magnitudes: bool, limit: u64) -> Result<Self, Error> {
        let raster = || Raster::new(seen, 0, limit);
        let magnitudes = if with_magnitudes { Some(raster()?) } else { None };
        Ok(Self { seen, log_odds: raster()?, magnitudes })
    }

    /// Grows to the area `whole`, which holds the one so far.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] if `whole` exceeds the limit, or there is no memory; then no sum changes.
    pub(super) fn grow(&mut self, whole: Area, limit: u64) -> Result<(), Error> {
        self.log_odds.make_room(self.seen, whole, 0, limit)?;
        if let Some(magnitudes) = &mut self.magnitudes {
            magnitudes.make_room(self.seen, whole, 0, limit)?;
        }
        self.seen = whole;
        Ok(())
    }

    /// Adds readings of cells within the area, or takes them out again.
    pub(super) fn add(&mut self, readings: &[Reading], is_removal: bool) {
        let sign = if is_removal { -1 } else { 1 };
        // 2^41 scans of 40 nats would not fill the integer: `scan.md`, "The sum".
        for &Reading { cell, log_odds } in readings {
            *self.log_odds.cell_mut(cell) += sign * log_odds;
        }
        if let Some(magnitudes) = &mut self.magnitudes {
            for &Reading { cell, log_odds } in readings {
                *magnitudes.cell_mut(cell) += sign * log_odds.abs();
            }
        }
    }

    /// Tells whether magnitudes are no less than the sums that they belong to, in the cells of these readings.
    pub(super) fn are_magnitudes(&self, readings: &[Reading]) -> bool {
        self.magnitudes.as_ref().is_none_or(|magnitudes| {
            readings
                .iter()
                .all(|&Reading { cell, .. }| *magnitudes.cell(cell) >= self.log_odds_of(cell).abs())
        })
    }

    /// Tells whether all cells outside of `area` are 0; no area is none of the cells.
    pub(super) fn are_within(&self, area: Option<Area>) -> bool {
        let is_zero = |raster: &Raster<i128>| raster.is_filled_outside(self.seen, area, 0);
        is_zero(&self.log_odds) && self.magnitudes.as_ref().is_none_or(is_zero)
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
    pub(super) fn log_odds_of(&self, cell: [i64; 2]) -> i128 {
        *self.log_odds.cell(cell)
    }

    /// Returns the sums of log-odds of a row of the rectangle.
    pub(super) fn row(&self, row: i64) -> &[i128] {
        self.log_odds.row(self.seen, row)
    }

    /// Returns the sums of log-odds, row by row from the lowest.
    pub(super) fn rows(&self) -> impl Iterator<Item = &[i128]> {
        self.log_odds.rows(self.seen)
    }

    /// Returns `Σ l` and `Σ|l|` of each cell, row by row from the lowest; `None` if magnitudes are not kept.
    pub(super) fn pairs(&self) -> Option<impl Iterator<Item = (i128, i128)>> {
        let magnitudes = self.magnitudes.as_ref()?.rows(self.seen).flatten();
        Some(self.rows().flatten().copied().zip(magnitudes.copied()))
    }
}

/// The same rectangle and the same sums in it, whatever room there is beyond.
impl PartialEq for Sums {
    fn eq(&self, other: &Self) -> bool {
        let same_magnitudes = match (&self.magnitudes, &other.magnitudes) {
            (Some(a), Some(b)) => a.rows(self.seen).eq(b.rows(other.seen)),
            (a, b) => a.is_none() && b.is_none(),
        };
        self.seen == other.seen && self.rows().eq(other.rows()) && same_magnitudes
    }
}
