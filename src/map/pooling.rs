//! Coarser maps: each `k x k` block of cells becomes one cell that holds the mean of their occupancies.

use super::encoding::Probability;
use super::{Encoding, Grid};
use crate::error::Error;
use crate::tally::ExactSum;
use alloc::vec::Vec;
use core::ops::Range;

impl<E: Encoding> Grid<E> {
    /// The grid of `k` times the resolution in which each cell holds the mean occupancy of its `k x k` block.
    ///
    /// Blocks start at row 0 and column 0. Where `k` does not divide the size, the blocks at the upper and right edges
    /// hold fewer cells, and their mean is over the cells they hold.
    ///
    /// Each mean is the exact mean of the cells' occupancies, rounded once to nearest. So a block of unknown cells is
    /// exactly 1/2, and stays unknown. By Jensen's inequality (`I` is convex) the information of a coarse cell is at
    /// most the mean information of the cells it pools, up to that one rounding.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if `k` is 0, or if the coarse resolution is not finite.
    ///
    /// ```
    /// use mean_information::map::{Geometry, Grid, encoding::Probability};
    /// let geometry = Geometry::new(0.1, [0.0, 0.0])?;
    /// let fine = Grid::<Probability<f64>>::new(3, 2, geometry, vec![0.25, 0.5, 0.5, 0.0, 0.125, 0.5])?;
    /// let coarse = fine.pooled(2)?;
    /// assert_eq!(coarse.cells(), [0.21875, 0.5]);
    /// assert_eq!(coarse.geometry().resolution(), 0.2);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn pooled(&self, k: usize) -> Result<Grid<Probability<E::Float>>, Error> {
        if k == 0 {
            return Err(Error::out_of_range("cells per side of a block", 0.0, "at least 1"));
        }
        let geometry = self.geometry().coarser(k)?;
        let (width, height) = (self.width().div_ceil(k), self.height().div_ceil(k));
        let mut cells = Vec::with_capacity(width * height);
        for row in (0..self.height()).step_by(k) {
            let rows = row..row.saturating_add(k).min(self.height());
            for column in (0..self.width()).step_by(k) {
                let columns = column..column.saturating_add(k).min(self.width());
                cells.push(self.mean_occupancy(rows.clone(), columns));
            }
        }
        Grid::new(width, height, geometry, cells)
    }
    /// The exact mean occupancy of a block, rounded once to nearest.
    fn mean_occupancy(&self, rows: Range<usize>, columns: Range<usize>) -> E::Float {
        let count = (rows.len() * columns.len()) as u64;
        let mut sum = ExactSum::new();
        for row in rows.filter_map(|row| self.row(row)) {
            row[columns.clone()].iter().filter_map(|&stored| E::occupancy(stored)).for_each(|p| sum.add(p));
        }
        sum.mean(count)
    }
}
