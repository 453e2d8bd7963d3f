//! Rows of stored cells and their measures (Eqs. 2 to 4): what a [`Grid`](super::Grid) and a
//! [`PolarMap`](super::PolarMap) have in common.

use super::stored::Encoding;
use crate::error::Error;
use crate::tally::Tally;
use alloc::vec::Vec;

/// Cells of one encoding, row by row, all of them allowed values.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CellRows<E: Encoding> {
    width: usize,
    height: usize,
    cells: Vec<E::Stored>,
}

impl<E: Encoding> CellRows<E> {
    /// Creates `height` rows of `width` cells.
    ///
    /// # Errors
    /// [`Error::CellCount`] if there are not width times height cells; [`Error::Cell`] naming the first cell whose value
    /// the encoding does not allow.
    pub(super) fn new(width: usize, height: usize, cells: Vec<E::Stored>) -> Result<Self, Error> {
        if width.checked_mul(height) != Some(cells.len()) {
            return Err(Error::CellCount { given: cells.len(), width, height });
        }
        if let Some(bad) = cells.iter().position(|&stored| !E::is_valid(stored)) {
            let (row, column, value) = (bad / width, bad % width, E::value(cells[bad]));
            return Err(Error::Cell { row, column, value, allowed: E::ALLOWED });
        }
        Ok(Self { width, height, cells })
    }

    /// Returns the number of cells in a row.
    pub(super) fn width(&self) -> usize {
        self.width
    }

    /// Returns the number of rows.
    pub(super) fn height(&self) -> usize {
        self.height
    }

    /// Returns all cells, row by row.
    pub(super) fn cells(&self) -> &[E::Stored] {
        &self.cells
    }

    /// Returns all cells and frees the rest.
    pub(super) fn into_cells(self) -> Vec<E::Stored> {
        self.cells
    }

    /// Returns the cells of one row; `None` beyond the last.
    pub(super) fn row(&self, row: usize) -> Option<&[E::Stored]> {
        (row < self.height).then(|| &self.cells[row * self.width..][..self.width])
    }

    /// Returns the occupancy of one cell; `None` beyond the rows or the cells of a row.
    pub(super) fn occupancy(&self, row: usize, column: usize) -> Option<E::Float> {
        self.row(row)?.get(column).and_then(|&stored| E::occupancy(stored))
    }

    /// Returns the exact sums over all cells.
    pub(super) fn tally(&self) -> Tally<E::Float> {
        E::tally(&self.cells)
    }

    /// Returns the mean information, without computing entropies.
    pub(super) fn mean_information(&self) -> E::Float {
        E::information_sum(&self.cells).mean()
    }
}
