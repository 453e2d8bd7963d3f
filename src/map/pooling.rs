//! Coarser maps: each `k x k` block of cells becomes one cell that holds the mean of their occupancies.

use super::encoding::Probability;
use super::grid::Grid;
use super::stored::Encoding;
use crate::error::Error;
use crate::tally::ExactSum;
use alloc::vec::Vec;

impl<E: Encoding> Grid<E> {
    /// Creates the grid of `k` times the resolution in which each cell holds the mean occupancy of its `k x k` block.
    ///
    /// Blocks start at row 0 and column 0. Where `k` does not divide the size, the blocks at the upper and right edges reach
    /// beyond the map, where all is unknown: the result is that of the map padded with unknown cells to whole blocks, which
    /// has the same mean information.
    ///
    /// Each mean is the exact mean of [`Encoding::occupancy`], rounded once to nearest. So a block of unknown cells is
    /// exactly 1/2, and stays unknown. By Jensen's inequality (`I` is convex) the information of a coarse cell is at
    /// most the mean information of the cells it pools, up to that rounding (proved, [`map`](crate::book::map)).
    ///
    /// Occupancies of log-odds are themselves rounded: a cell with `|l|` below about `2^-53` (`2^-24` in `f32`) pools as
    /// unknown, one above 37 (17) as certain.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if `k` is 0 or above `2^31`, or if the coarse resolution is not finite.
    ///
    /// # Panics
    /// If an [`Encoding`] of your own gives an occupancy outside `[0, 1]`.
    ///
    /// ```
    /// use mean_information::map::{Geometry, Grid, encoding::Probability};
    /// let geometry = Geometry::new(0.1, [0.0, 0.0])?;
    /// let fine = Grid::<Probability<f64>>::new(3, 2, geometry, vec![0.25, 0.5, 0.5, 0.0, 0.125, 0.0])?;
    /// let coarse = fine.pooled(2)?;
    /// assert_eq!(coarse.cells(), [0.21875, 0.375]); // the second block is half outside: (0.5 + 0 + 2 * 0.5) / 4
    /// assert_eq!(coarse.geometry().resolution(), 0.2);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn pooled(&self, k: usize) -> Result<Grid<Probability<E::Float>>, Error> {
        if !(1..=1 << 31).contains(&k) {
            return Err(Error::out_of_range("cells per side of a block", k as f64, "1 to 2^31"));
        }
        let geometry = self.geometry().coarser(k)?;
        let (width, height) = (self.width().div_ceil(k), self.height().div_ceil(k));
        let mut cells = Vec::with_capacity(width * height);
        for row in (0..self.height()).step_by(k) {
            for column in (0..self.width()).step_by(k) {
                cells.push(self.mean_occupancy(row, column, k));
            }
        }
        Grid::new(width, height, geometry, cells)
    }

    /// Computes the exact mean occupancy of the block at this corner, rounded once to nearest.
    fn mean_occupancy(&self, row: usize, column: usize, k: usize) -> E::Float {
        let rows = row..(row + k).min(self.height());
        let columns = column..(column + k).min(self.width());
        let area = (k as u64).pow(2);
        let mut sum = ExactSum::new();
        // The part of the block beyond the map is unknown.
        sum.add_many(0.5_f64, area - (rows.len() * columns.len()) as u64);
        for row in rows.filter_map(|row| self.row(row)) {
            row[columns.clone()].iter().filter_map(|&stored| E::occupancy(stored)).for_each(|p| sum.add(p));
        }
        sum.mean(area)
    }
}
