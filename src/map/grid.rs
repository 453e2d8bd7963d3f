//! The Cartesian occupancy grid.

use super::{Encoding, Geometry};
use crate::error::Error;
#[cfg(feature = "rayon")]
use crate::tally::Information;
use crate::tally::Tally;
use alloc::vec::Vec;
#[cfg(feature = "rayon")]
use rayon::prelude::*;

/// An occupancy map: rows of square cells in one [`Encoding`], with its place in the world.
///
/// Row 0 is the lowest (smallest y), as in ROS's `OccupancyGrid` and in MRPT; cells are stored row by row.
/// Memory: one stored value per cell. Its measures are Eqs. 2 to 4 of the report ([`map`](crate::book::map)).
///
/// ```
/// use mean_information::map::{Geometry, Grid, encoding::Percent};
/// let geometry = Geometry::new(0.05, [0.0, 0.0])?;
/// let map = Grid::<Percent>::new(3, 2, geometry, vec![0, 2, 50, -1, 97, 100])?;
/// let tally = map.tally();
/// assert_eq!((tally.free(), tally.occupied(), tally.unknown()), (2, 2, 2));
/// assert_eq!(tally.mean_information(), 0.9160418999066507); // bits per observed cell
/// assert_eq!((map.occupancy(1, 1), map.occupancy(2, 1)), (Some(0.97), None));
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Grid<E: Encoding> {
    width: usize,
    height: usize,
    geometry: Geometry,
    cells: Vec<E::Stored>,
}

impl<E: Encoding> Grid<E> {
    /// A grid of `width` columns and `height` rows from its cells, row by row from the lowest.
    ///
    /// # Errors
    /// [`Error::CellCount`] if there are not width times height cells; [`Error::Cell`] naming the first cell whose
    /// value the encoding does not allow.
    pub fn new(
        width: usize,
        height: usize,
        geometry: Geometry,
        cells: Vec<E::Stored>,
    ) -> Result<Self, Error> {
        if width.checked_mul(height) != Some(cells.len()) {
            return Err(Error::CellCount { given: cells.len(), width, height });
        }
        if let Some(bad) = cells.iter().position(|&stored| !E::is_valid(stored)) {
            let (row, column, value) = (bad / width, bad % width, E::value(cells[bad]));
            return Err(Error::Cell { row, column, value, allowed: E::ALLOWED });
        }
        Ok(Self { width, height, geometry, cells })
    }

    /// Columns.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Resolution and origin.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// The stored cells, row by row from the lowest.
    pub fn cells(&self) -> &[E::Stored] {
        &self.cells
    }

    /// The stored cells of one row; `None` beyond the last.
    pub fn row(&self, row: usize) -> Option<&[E::Stored]> {
        (row < self.height).then(|| &self.cells[row * self.width..][..self.width])
    }

    /// The occupancy of one cell, the bits of [`Encoding::occupancy`]; `None` outside the grid.
    pub fn occupancy(&self, row: usize, column: usize) -> Option<E::Float> {
        self.row(row)?.get(column).and_then(|&stored| E::occupancy(stored))
    }

    /// Entropy, information and counts over all cells (Eqs. 2 to 4); the sums are exact.
    pub fn tally(&self) -> Tally<E::Float> {
        E::tally(&self.cells)
    }

    /// The mean information (Eq. 4), in bits per observed cell: the bits of [`Tally::mean_information`], sooner,
    /// since no entropies are computed; 0 if nothing is observed.
    ///
    /// ```
    /// use mean_information::map::{Geometry, Grid, encoding::Probability};
    /// let cells = vec![0.25_f32, 0.5, 0.96875, 0.125];
    /// let map = Grid::<Probability<f32>>::new(2, 2, Geometry::new(0.05, [0.0, 0.0])?, cells)?;
    /// assert_eq!(map.mean_information(), 0.4815117); // bits per observed cell
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn mean_information(&self) -> E::Float {
        E::information(&self.cells).mean()
    }
}

/// What a thread takes at once: 1 MiB of cells.
#[cfg(feature = "rayon")]
const PART: usize = 1 << 20;

#[cfg(feature = "rayon")]
impl<E: Encoding> Grid<E> {
    /// [`Grid::tally`] by as many threads as rayon has: the same bits for any number of them.
    ///
    /// ```
    /// use mean_information::map::{Geometry, Grid, encoding::Percent};
    /// let cells = (0..2_000_000).map(|k| [0, -1, 87][k % 3]).collect();
    /// let map = Grid::<Percent>::new(2000, 1000, Geometry::new(0.05, [0.0, 0.0])?, cells)?;
    /// assert_eq!(map.par_tally(), map.tally());
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn par_tally(&self) -> Tally<E::Float> {
        self.parts().map(E::tally).sum()
    }

    /// [`Grid::mean_information`] by as many threads as rayon has: the same bits for any number of them.
    ///
    /// ```
    /// use mean_information::map::{Geometry, Grid, encoding::MrptLogOdds};
    /// let cells = (0..2_000_000).map(|k| [0, -32, 24][k % 3]).collect();
    /// let map = Grid::<MrptLogOdds>::new(2000, 1000, Geometry::new(0.05, [0.0, 0.0])?, cells)?;
    /// assert_eq!(map.par_mean_information(), map.mean_information());
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn par_mean_information(&self) -> E::Float {
        self.parts().map(E::information).sum::<Information<_>>().mean()
    }

    fn parts(&self) -> impl ParallelIterator<Item = &[E::Stored]> {
        self.cells.par_chunks((PART / size_of::<E::Stored>().max(1)).max(1))
    }
}
