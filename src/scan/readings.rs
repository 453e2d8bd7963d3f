//! What one scan says of the cells that its beams cross: one reading of each, the strongest.
//!
//! Nearly all cells of a scan are told one of two things, free or occupied. These are a byte each in a raster of the scan's
//! rectangle; what remains is a list.

use super::codes::{FREE, NOTHING, OCCUPIED};
use super::columns::Canvas;
use super::raster::{Area, Raster};
use crate::error::Error;
use crate::real::Real;
use crate::rounded::{fixed_log_odds, occupancy_from_fixed_log_odds};
use alloc::vec::Vec;
use core::convert::Infallible;

/// The reading of one cell by one scan: log-odds in units of `2^-80` nats, not 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reading {
    pub(super) cell: [i64; 2],
    pub(super) log_odds: i128,
}

/// The readings of a scan, each cell once.
pub(super) struct Readings {
    pub(super) area: Area,
    /// The codes of the cells; [`NOTHING`] where `others` has a reading.
    pub(super) codes: Raster<u8>,
    /// The log-odds of [`FREE`] and [`OCCUPIED`], 0 where no cell has them.
    pub(super) levels: [i128; 2],
    /// The places among the codes of the cells that are [`OCCUPIED`], each once.
    pub(super) occupied: Vec<usize>,
    pub(super) others: Vec<Reading>,
}

impl Readings {
    /// Returns the codes of a row from the first that is any to the last, and some more, with the number of the first in the row.
    #[inline]
    pub(super) fn told(&self, row: i64) -> (usize, &[u8]) {
        let codes = self.codes.row(self.area, row);
        let is_told = |codes: &[u8; PIECE]| u128::from_ne_bytes(*codes) != 0;
        let (pieces, _) = codes.as_chunks();
        let start = PIECE * pieces.iter().position(is_told).unwrap_or(pieces.len());
        let (_, pieces) = codes[start..].as_rchunks();
        let empty = pieces.iter().rev().take_while(|codes| !is_told(codes)).count();
        (start, &codes[start..codes.len() - PIECE * empty])
    }

    /// Calls `each` for each reading.
    pub(super) fn for_each(&self, mut each: impl FnMut(Reading)) {
        let Ok(()) = self.try_for_each(|reading| {
            each(reading);
            Ok::<_, Infallible>(())
        });
    }

    /// Calls `each` for each reading, up to the first error, which is returned.
    pub(super) fn try_for_each<E>(&self, mut each: impl FnMut(Reading) -> Result<(), E>) -> Result<(), E> {
        let first = self.area.low()[0];
        for row in self.area.rows() {
            let (start, codes) = self.told(row);
            let columns = first + start as i64..;
            for (column, &code) in columns.zip(codes).filter(|&(_, &code)| code != NOTHING) {
                each(Reading { cell: [column, row], log_odds: self.levels[usize::from(code - FREE)] })?;
            }
        }
        self.others.iter().copied().try_for_each(each)
    }
}

/// So many cells are passed over at once if nothing is said of them: the bytes of an integer.
const PIECE: usize = 16;

/// The limits on the log-odds of a reading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Limit<T> {
    /// The greatest magnitude, in units of `2^-80` nats.
    units: i128,
    /// The greatest occupancy whose reading is limited to the least log-odds.
    surely_free: T,
}

impl<T: Real> Limit<T> {
    /// Creates the limit of `units > 0`.
    pub(super) fn new(units: i128) -> Self {
        // Within an ulp of it; log-odds in units rise from float to float.
        let mut surely_free = occupancy_from_fixed_log_odds::<T>(-units);
        while fixed_log_odds(surely_free) > -units {
            let (m, e) = surely_free.parts();
            surely_free = T::from_parts(m - 1, e);
        }
        Self { units, surely_free }
    }

    /// Returns the greatest occupancy whose reading is limited to the least log-odds.
    pub(super) fn surely_free(&self) -> T {
        self.surely_free
    }

    /// Returns 0 for all occupancies of the least reading, of which the scan says the same, and others as they are.
    #[inline]
    pub(super) fn canonical(&self, p: T) -> T {
        if p <= self.surely_free { T::zero() } else { p }
    }

    /// Computes the reading of an occupancy: log-odds in units of `2^-80` nats, within `2^4` of them, limited (`scan.md`, "The
    /// sum").
    fn reading(&self, p: T) -> i128 {
        fixed_log_odds(p).clamp(-self.units, self.units)
    }
}

/// The readings of a scan while its beams are drawn.
pub(super) struct Drafts<T> {
    area: Area,
    pub(super) canvas: Canvas,
    /// The occupancies of [`FREE`] and [`OCCUPIED`]; NaN, which is equal to none, before there is one.
    levels: [T; 2],
    /// The places of occupied cells, which are drawn when all free ones are: so many of these, what follows is spare.
    occupied: Vec<usize>,
    count: usize,
    others: Vec<Other<T>>,
}

/// The occupancy that one beam gives to a cell: neither level.
#[derive(Clone, Copy)]
struct Other<T> {
    index: usize,
    p: T,
}

impl<T: Real> Drafts<T> {
    /// Creates the drafts of an area; the beams say `free`, if that is a number, of most cells.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] if there are more cells than the limit; [`Error::NoMemory`].
    pub(super) fn new(area: Area, free: T, max_cells: u64) -> Result<Self, Error> {
        let canvas = Canvas::new(area, max_cells)?;
        Ok(Self {
            area,
            canvas,
            levels: [free, T::nan()],
            occupied: Vec::new(),
            count: 0,
            others: Vec::new(),
        })
    }

    /// Adds what a beam says of a cell: an occupancy that is not 1/2.
    #[inline]
    pub(super) fn say(&mut self, cell: [i64; 2], p: T) {
        let index = self.canvas.codes.index(cell);
        let level = &mut self.levels[usize::from(p > T::HALF)];
        if level.is_nan() {
            *level = p;
        }
        if p != *level {
            self.others.push(Other { index, p });
        } else if p > T::HALF {
            match self.occupied.get_mut(self.count) {
                Some(place) => *place = index,
                None => self.occupied.push(index),
            }
            self.count += 1;
        } else {
            self.canvas.codes.set(index, FREE);
        }
    }

    /// Tells whether these are the levels of free and of occupied cells.
    #[inline]
    pub(super) fn are(&self, levels: [T; 2]) -> bool {
        self.levels == levels
    }

    /// Adds what a beam says of the cells at some places: the one level, the other, or nothing.
    #[inline]
    pub(super) fn say_levels(&mut self, places: &[usize], are_free: &[bool], are_occupied: &[bool]) {
        if self.occupied.len() < self.count + places.len() {
            self.occupied.resize(2 * self.count + places.len(), 0);
        }
        for ((&index, &is_free), &is_occupied) in places.iter().zip(are_free).zip(are_occupied) {
            self.canvas.codes.add_bits(index, u8::from(is_free) * FREE);
            self.occupied[self.count] = index;
            self.count += usize::from(is_occupied);
        }
    }

    /// Chooses the strongest reading of each cell, and limits its log-odds.
    pub(super) fn readings(mut self, limit: &Limit<T>) -> Readings {
        let mut codes = self.canvas.settled();
        // Of an occupied and a free one the occupied; each cell once, which no branch foresees.
        let mut kept = 0;
        for k in 0..self.count {
            let index = self.occupied[k];
            self.occupied[kept] = index;
            kept += usize::from(codes.at(index) != OCCUPIED);
            codes.set(index, OCCUPIED);
        }
        self.occupied.truncate(kept);
        self.others.sort_unstable_by_key(|other| other.index);
        // Neighbours often have the same.
        let mut last = (T::HALF, 0);
        let mut others = Vec::new();
        for alike in self.others.chunk_by(|a, b| a.index == b.index) {
            let index = alike[0].index;
            let level = match codes.at(index) {
                NOTHING => T::HALF,
                code => self.levels[usize::from(code - FREE)],
            };
            let p = alike.iter().fold(level, |p, other| stronger(p, other.p));
            // Else the level was the stronger one.
            if p != level {
                codes.set(index, NOTHING);
                if p != last.0 {
                    last = (p, limit.reading(p));
                }
                others.push(Reading { cell: codes.cell_at(index), log_odds: last.1 });
            }
        }
        if !others.is_empty() {
            self.occupied.retain(|&index| codes.at(index) == OCCUPIED);
        }
        let levels = self.levels.map(|p| if p.is_nan() { 0 } else { limit.reading(p) });
        Readings { area: self.area, codes, levels, occupied: self.occupied, others }
    }
}

/// Chooses between two readings of a cell in one scan: an occupied one before a free one, the surer of two alike. In any order
/// the same, and never 1/2 if one of them is not.
pub(super) fn stronger<T: Real>(a: T, b: T) -> T {
    if a > T::HALF || b > T::HALF { a.max(b) } else { a.min(b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of an occupied and a free reading the former, of two alike the surer one, and of 1/2 and another the other, in either order.
    #[test]
    fn the_stronger_reading_is_so_in_any_order() {
        let by_strength = [0.5_f64, 0.375, 0.0, 0.5625, 0.875, 1.0];
        for (k, &b) in by_strength.iter().enumerate() {
            for &a in &by_strength[..=k] {
                assert_eq!([stronger(a, b), stronger(b, a)], [b; 2], "{a} and {b}");
            }
        }
    }
}
