//! What the scans of a step say, before it is known that all of them can be inserted.

use super::index::no_number;
use super::patterns::Patterns;
use super::values::Values;
use crate::error::Error;
use crate::real::Real;
use crate::scan::beams::Scan;
use crate::scan::raster::{Area, Raster};
use crate::scan::rays::Rays;
use crate::scan::readings::{Reading, Readings};
use crate::scan::scan_map::ScanMap;
use crate::sensor::InverseSensorModel;
use alloc::{vec, vec::Vec};

/// What the scan of one particle says of each cell, and the rectangle that its beams cross.
pub(super) struct Draft {
    pub(super) area: Area,
    readings: Readings,
}

impl Draft {
    /// Finds what a scan says.
    ///
    /// # Errors
    /// Those of [`ScanMap::insert`].
    pub(super) fn of<T: Real, M: InverseSensorModel<Float = T>>(
        empty: &ScanMap<T>,
        scan: &Scan<T>,
        model: impl Fn(T) -> Result<M, Error>,
    ) -> Result<Self, Error> {
        let rays = Rays::new(empty.lattice, empty.limit, scan, model)?;
        // Before the work, which is at most what a map within the limit takes.
        rays.area().within(empty.max_cells)?;
        Ok(Self { area: rays.area(), readings: rays.readings(empty.max_cells)? })
    }
}

/// The cells that scans of a step touch, with what each particle will say of them.
pub(super) struct Drafts {
    particles: usize,
    /// The place of each cell in the list of those that are touched, [`NONE`] of the others.
    places: Raster<u32>,
    /// The cells, and the number of the pattern that each has.
    cells: Vec<([i64; 2], u32)>,
    /// The values of the particles, cell by cell.
    values: Vec<u32>,
    /// How many more cells of the particle at hand have each value.
    changes: Vec<i64>,
}

/// The place of a cell that is not touched.
const NONE: u32 = u32::MAX;

impl Drafts {
    /// Creates the drafts of a step, whose scans all lie in `area`.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] if that has more cells than the limit, or than numbers; [`Error::NoMemory`].
    pub(super) fn new(particles: usize, area: Area, limit: u64) -> Result<Self, Error> {
        let places = Raster::new(area, NONE, limit.min(NONE.into()))?;
        Ok(Self { particles, places, cells: Vec::new(), values: Vec::new(), changes: Vec::new() })
    }

    /// Adds what the scan of a particle says to what it said so far; returns each value of which it will have more or fewer
    /// cells, and how many.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if there are more values than numbers.
    pub(super) fn apply<T: Real>(
        &mut self,
        particle: usize,
        draft: &Draft,
        raster: &Raster<u32>,
        patterns: &Patterns,
        values: &mut Values<T>,
    ) -> Result<Vec<(u32, i64)>, Error> {
        let mut changed = Vec::new();
        // Neighbours often have the same.
        let mut last = (0, 0, 0);
        draft.readings.try_for_each(|Reading { cell, log_odds }| {
            let place = self.places.cell_mut(cell);
            if *place == NONE {
                *place = self.cells.len() as u32;
                let pattern = *raster.cell(cell);
                self.cells.push((cell, pattern));
                self.values.extend(patterns.values(pattern));
            }
            let value = &mut self.values[*place as usize * self.particles + particle];
            if (*value, log_odds) != (last.0, last.1) {
                let sum = values.get(*value).sum + log_odds;
                let new = values.number(sum).ok_or_else(no_number)?;
                last = (*value, log_odds, new);
                self.changes.resize(values.len(), 0);
            }
            for (number, change) in [(*value, -1), (last.2, 1)] {
                let count = &mut self.changes[number as usize];
                if *count == 0 {
                    changed.push(number);
                }
                *count += change;
            }
            *value = last.2;
            Ok(())
        })?;
        // A value may be there twice, where its count went through 0: once with all of it.
        let take = |number: u32| (number, core::mem::take(&mut self.changes[number as usize]));
        Ok(changed.into_iter().map(take).filter(|&(_, change)| change != 0).collect())
    }

    /// Returns the cells that are touched, each with the number of its pattern before.
    pub(super) fn cells(&self) -> &[([i64; 2], u32)] {
        &self.cells
    }

    /// Returns the numbers of their patterns from now on, which are added where they are new.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if there are more patterns than numbers.
    pub(super) fn numbers(&self, patterns: &mut Patterns) -> Result<Vec<u32>, Error> {
        let mut numbers = vec![0; self.cells.len()];
        for (number, values) in numbers.iter_mut().zip(self.values.chunks(self.particles)) {
            *number = patterns.number(values).ok_or_else(no_number)?;
        }
        Ok(numbers)
    }
}
