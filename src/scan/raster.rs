//! Rectangles of cells on an endless grid, and values for each cell of one.

use crate::error::Error;
use alloc::vec::Vec;

/// The cells from column and row `low` to before `high`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Area {
    low: [i64; 2],
    high: [i64; 2],
}

impl Area {
    /// Returns the area of one cell.
    #[inline]
    pub(super) fn of_cell(cell: [i64; 2]) -> Self {
        Self { low: cell, high: cell.map(|k| k + 1) }
    }

    /// Returns the least area that holds both.
    #[inline]
    pub(super) fn union(self, other: Self) -> Self {
        Self {
            low: [self.low[0].min(other.low[0]), self.low[1].min(other.low[1])],
            high: [self.high[0].max(other.high[0]), self.high[1].max(other.high[1])],
        }
    }

    /// Grows the sides beyond which `wanted` lies: by half of its own size, at least to `wanted`.
    fn grown_to(self, wanted: Self) -> Self {
        let margin = |k: usize| (self.high[k] - self.low[k]) / 2;
        let low = |k: usize| {
            if wanted.low[k] < self.low[k] { wanted.low[k].min(self.low[k] - margin(k)) } else { self.low[k] }
        };
        let high = |k: usize| {
            if wanted.high[k] > self.high[k] {
                wanted.high[k].max(self.high[k] + margin(k))
            } else {
                self.high[k]
            }
        };
        Self { low: [low(0), low(1)], high: [high(0), high(1)] }
    }

    /// Returns the numbers of the rows, from the lowest.
    pub(super) fn rows(self) -> core::ops::Range<i64> {
        self.low[1]..self.high[1]
    }

    /// Returns the column and the row of the lowest cell.
    pub(super) fn low(self) -> [i64; 2] {
        self.low
    }

    /// Returns how many columns and rows there are.
    #[inline]
    pub(super) fn size(self) -> [usize; 2] {
        [0, 1].map(|k| (self.high[k] - self.low[k]) as usize)
    }

    /// Returns the area of so many columns from the lowest cell on.
    pub(super) fn with_columns(self, columns: usize) -> Self {
        Self { high: [self.low[0] + columns as i64, self.high[1]], ..self }
    }

    /// Counts the cells.
    pub(super) fn cells(self) -> u128 {
        let [columns, rows] = [0, 1].map(|k| self.high[k].abs_diff(self.low[k]));
        u128::from(columns) * u128::from(rows)
    }

    /// Counts the cells, if there are no more than the limit.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] otherwise; [`Error::NoMemory`] if there are more than can be addressed.
    pub(super) fn within(self, limit: u64) -> Result<usize, Error> {
        let cells = self.cells();
        if cells > u128::from(limit) {
            return Err(Error::too_many_cells(cells, limit));
        }
        usize::try_from(cells).map_err(|_| Error::no_memory(cells))
    }

    /// Tells whether all cells of `other` are in this area.
    fn holds(self, other: Self) -> bool {
        self.union(other) == self
    }

    /// Tells whether this area lies within `outer` and meets none of its sides.
    pub(super) fn is_inside(self, outer: Self) -> bool {
        [0, 1].iter().all(|&k| outer.low[k] < self.low[k] && self.high[k] < outer.high[k])
    }
}

/// A value for each cell of an area, row by row from the lowest.
#[derive(Clone, Debug)]
pub(super) struct Raster<C> {
    area: Area,
    cells: Vec<C>,
}

impl<C: Copy> Raster<C> {
    /// Creates a raster with the same value everywhere.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] if there are more cells than the limit; [`Error::NoMemory`].
    pub(super) fn new(area: Area, fill: C, limit: u64) -> Result<Self, Error> {
        let count = area.within(limit)?;
        #[cfg(test)]
        super::refusal::ask(count)?;
        let mut cells = Vec::new();
        cells.try_reserve_exact(count).map_err(|_| Error::no_memory(count as u128))?;
        cells.resize(count, fill);
        Ok(Self { area, cells })
    }

    /// Makes room for the area `whole`, of which only `used` is not `fill` so far.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] if `whole` exceeds the limit; [`Error::NoMemory`]. Then nothing changes.
    pub(super) fn make_room(&mut self, used: Area, whole: Area, fill: C, limit: u64) -> Result<(), Error> {
        if let Some(raster) = self.grown(used, whole, fill, limit)? {
            *self = raster;
        }
        Ok(())
    }

    /// Copies the area `used` into a raster with room for the area `whole`, which is `fill` elsewhere; `None` if this one has the room.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] if `whole` exceeds the limit; [`Error::NoMemory`].
    pub(super) fn grown(&self, used: Area, whole: Area, fill: C, limit: u64) -> Result<Option<Self>, Error> {
        if self.area.holds(whole) {
            return Ok(None);
        }
        // With room to spare, so that growing costs a fixed time per cell in the end; without, where the limit is near.
        let spare = self.area.grown_to(whole);
        let area = if spare.cells() <= u128::from(limit) { spare } else { whole };
        let mut raster = Self::new(area, fill, limit)?;
        for row in used.low[1]..used.high[1] {
            raster.row_mut(used, row).copy_from_slice(self.row(used, row));
        }
        Ok(Some(raster))
    }

    /// Returns where the cells of a row that lie in `area` are stored.
    fn range(&self, area: Area, row: i64) -> core::ops::Range<usize> {
        let start = self.index([area.low[0], row]);
        start..start + area.size()[0]
    }

    /// Returns the cell that is stored at an index.
    #[inline]
    pub(super) fn cell_at(&self, index: usize) -> [i64; 2] {
        let [columns, _] = self.area.size();
        [self.area.low[0] + (index % columns) as i64, self.area.low[1] + (index / columns) as i64]
    }

    /// Returns the part of a row that lies in `area`, which the raster must hold.
    pub(super) fn row(&self, area: Area, row: i64) -> &[C] {
        &self.cells[self.range(area, row)]
    }

    /// Returns the part of a row that lies in `area`, which the raster must hold, to be changed.
    pub(super) fn row_mut(&mut self, area: Area, row: i64) -> &mut [C] {
        let range = self.range(area, row);
        &mut self.cells[range]
    }

    /// Returns all values, to be changed.
    pub(super) fn all_mut(&mut self) -> &mut [C] {
        &mut self.cells
    }

    /// Returns the place in the raster of a cell, which it must hold.
    #[inline]
    pub(super) fn index(&self, [column, row]: [i64; 2]) -> usize {
        let [width, _] = self.area.size();
        (row - self.area.low[1]) as usize * width + (column - self.area.low[0]) as usize
    }

    /// Returns how far it is in the raster to the next cell along an axis.
    #[inline]
    pub(super) fn stride(&self, axis: usize) -> isize {
        if axis == 0 { 1 } else { self.area.size()[0] as isize }
    }

    /// Sets the value at a place in the raster.
    #[inline]
    pub(super) fn set(&mut self, index: usize, value: C) {
        self.cells[index] = value;
    }

    /// Returns the value at a place in the raster.
    #[inline]
    pub(super) fn at(&self, index: usize) -> C {
        self.cells[index]
    }

    /// Returns the value of a cell, which the raster must hold.
    #[inline]
    pub(super) fn cell(&self, cell: [i64; 2]) -> &C {
        &self.cells[self.index(cell)]
    }

    /// Returns the value of a cell, which the raster must hold, to be changed.
    #[inline]
    pub(super) fn cell_mut(&mut self, cell: [i64; 2]) -> &mut C {
        let index = self.index(cell);
        &mut self.cells[index]
    }

    /// Replaces the value of each cell of an area, which the raster must hold.
    pub(super) fn map_in(&mut self, area: Area, of: impl Fn(C) -> C) {
        for row in area.low[1]..area.high[1] {
            for cell in self.row_mut(area, row) {
                *cell = of(*cell);
            }
        }
    }

    /// Returns the rows of an area that the raster must hold, from the lowest.
    pub(super) fn rows(&self, area: Area) -> impl Iterator<Item = &[C]> {
        (area.low[1]..area.high[1]).map(move |row| self.row(area, row))
    }
}

impl Raster<u8> {
    /// Sets bits of the value at a place in the raster.
    #[inline]
    pub(super) fn add_bits(&mut self, index: usize, bits: u8) {
        self.cells[index] |= bits;
    }
}

impl<C: Copy + PartialEq> Raster<C> {
    /// Tells whether the cells of `area` that are not in `inner` are all `fill`; without an inner area, all cells.
    pub(super) fn is_filled_outside(&self, area: Area, inner: Option<Area>, fill: C) -> bool {
        let is_filled = |cells: &[C]| cells.iter().all(|&cell| cell == fill);
        (area.low[1]..area.high[1]).all(|row| {
            let cells = self.row(area, row);
            match inner.filter(|inner| (inner.low[1]..inner.high[1]).contains(&row)) {
                Some(inner) => {
                    let [left, right] = [inner.low[0], inner.high[0]].map(|k| (k - area.low[0]) as usize);
                    is_filled(&cells[..left]) && is_filled(&cells[right..])
                }
                None => is_filled(cells),
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_is_found_again_by_its_place() {
        let area = Area::of_cell([-7, 3]).union(Area::of_cell([4, 9]));
        let raster = Raster::new(area, 0, u64::MAX).unwrap();
        for row in area.rows() {
            for column in -7..5 {
                assert_eq!(raster.cell_at(raster.index([column, row])), [column, row]);
            }
        }
    }

    /// Cell by cell in each direction: the side grows by half each time, so that all copies together cost a few times the
    /// last one.
    #[test]
    fn growing_costs_a_fixed_time_per_cell() {
        for direction in [[1, 0], [-1, 0], [0, 1], [0, -1]] {
            let mut used = Area::of_cell([1000, -1000]);
            let mut raster = Raster::new(used, 0, u64::MAX).unwrap();
            let (mut copied, mut room) = (0, raster.area.cells());
            for k in 1..2000 {
                let cell = [1000 + k * direction[0], -1000 + k * direction[1]];
                let whole = used.union(Area::of_cell(cell));
                raster.make_room(used, whole, 0, u64::MAX).unwrap();
                used = whole;
                *raster.cell_mut(cell) = k;
                assert!(raster.area.holds(used) && raster.area.cells() <= 2 * used.cells() + 1);
                if raster.area.cells() != room {
                    (copied, room) = (copied + used.cells(), raster.area.cells());
                }
            }
            assert!(copied <= 4 * used.cells(), "{copied} of {}", used.cells());
            let sum: i64 = raster.rows(used).flatten().sum();
            assert_eq!(sum, 1999 * 2000 / 2);
        }
    }

    /// On the sides where there is room nothing is added.
    #[test]
    fn it_grows_on_one_side() {
        let area = Area { low: [10, 20], high: [18, 26] };
        let grown = |low, high| area.grown_to(Area { low, high });
        assert_eq!(grown([11, 20], [19, 26]), Area { low: [10, 20], high: [22, 26] });
        assert_eq!(grown([9, 21], [18, 25]), Area { low: [6, 20], high: [18, 26] });
        assert_eq!(grown([10, 19], [12, 22]), Area { low: [10, 17], high: [18, 26] });
        assert_eq!(grown([10, 20], [18, 99]), Area { low: [10, 20], high: [18, 99] });
    }

    #[test]
    fn what_is_outside_is_each_cell_that_is_not_inside() {
        let area = Area { low: [-3, 2], high: [4, 7] };
        let inner = Area { low: [-1, 3], high: [2, 6] };
        assert!(inner.is_inside(area) && !area.is_inside(area));
        for row in 2..7 {
            for column in -3..4 {
                let cell = [column, row];
                let mut raster = Raster::new(area, 5, 35).unwrap();
                *raster.cell_mut(cell) = 6;
                assert_eq!((*raster.cell(cell), raster.cells.iter().sum::<i32>()), (6, 35 * 5 + 1));
                let is_within = inner.holds(Area::of_cell(cell));
                assert_eq!(raster.is_filled_outside(area, Some(inner), 5), is_within, "{cell:?}");
                assert!(!raster.is_filled_outside(area, None, 5));
                assert!(raster.is_filled_outside(area, Some(area), 5));
                // Sides that two areas share.
                let touching = Area { low: [-3, 2], high: [2, 6] };
                assert!(!touching.is_inside(area));
            }
        }
    }

    #[test]
    fn what_has_room_is_left_alone() {
        let area = Area { low: [-3, -3], high: [5, 5] };
        let mut raster = Raster::new(area, 7, 64).unwrap();
        raster.cells.shrink_to_fit();
        let before = raster.cells.as_ptr();
        raster.make_room(area, Area::of_cell([4, -3]), 0, 64).unwrap();
        assert_eq!(raster.cells.as_ptr(), before);
    }
}
