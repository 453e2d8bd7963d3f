//! The Cartesian occupancy grid.

use super::cell_rows::CellRows;
use super::geometry::Geometry;
use super::stored::Encoding;
use crate::error::Error;
#[cfg(feature = "rayon")]
use crate::tally::InformationSum;
use crate::tally::Tally;
use alloc::vec::Vec;
#[cfg(feature = "rayon")]
use rayon::prelude::*;

/// A Cartesian occupancy map: rows of square cells in one [`Encoding`], with its place in the world.
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
    rows: CellRows<E>,
    geometry: Geometry,
}

impl<E: Encoding> Grid<E> {
    /// Creates a grid of `width` columns and `height` rows from its cells, row by row from the lowest.
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
        Ok(Self { rows: CellRows::new(width, height, cells)?, geometry })
    }

    /// Returns the number of columns.
    pub fn width(&self) -> usize {
        self.rows.width()
    }

    /// Returns the number of rows.
    pub fn height(&self) -> usize {
        self.rows.height()
    }

    /// Returns the resolution and the place of the grid.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// Returns the stored cells, row by row from the lowest.
    pub fn cells(&self) -> &[E::Stored] {
        self.rows.cells()
    }

    /// Returns the stored cells and frees the grid.
    ///
    /// ```
    /// use mean_information::map::{Geometry, Grid, encoding::Percent};
    /// let map = Grid::<Percent>::new(3, 1, Geometry::new(0.05, [0.0, 0.0])?, vec![0, -1, 97])?;
    /// assert_eq!(map.into_cells(), [0, -1, 97]);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn into_cells(self) -> Vec<E::Stored> {
        self.rows.into_cells()
    }

    /// Returns the stored cells of one row; `None` beyond the last.
    pub fn row(&self, row: usize) -> Option<&[E::Stored]> {
        self.rows.row(row)
    }

    /// Returns the occupancy of one cell, with the bits of [`Encoding::occupancy`]; `None` outside the grid.
    pub fn occupancy(&self, row: usize, column: usize) -> Option<E::Float> {
        self.rows.occupancy(row, column)
    }

    /// Computes entropy, information and counts over all cells (Eqs. 2 to 4); the sums are exact.
    pub fn tally(&self) -> Tally<E::Float> {
        self.rows.tally()
    }

    /// Computes the mean information (Eq. 4), in bits per observed cell; 0 if no cell is observed. It has the bits of
    /// [`Tally::mean_information`], within 1.5 ulp of that of the cells given, but is faster, because no entropies are
    /// computed.
    ///
    /// ```
    /// use mean_information::map::{Geometry, Grid, encoding::Probability};
    /// let cells = vec![0.25_f32, 0.5, 0.96875, 0.125];
    /// let map = Grid::<Probability<f32>>::new(2, 2, Geometry::new(0.05, [0.0, 0.0])?, cells)?;
    /// assert_eq!(map.mean_information(), 0.4815117); // bits per observed cell
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn mean_information(&self) -> E::Float {
        self.rows.mean_information()
    }
}

/// The bytes of cells that a thread takes at once: 1 MiB.
#[cfg(feature = "rayon")]
const PART: usize = 1 << 20;

#[cfg(feature = "rayon")]
impl<E: Encoding> Grid<E> {
    /// Computes [`Grid::tally`] on rayon's threads: the same bits for any number of them.
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

    /// Computes [`Grid::mean_information`] on rayon's threads: the same bits for any number of them.
    ///
    /// ```
    /// use mean_information::map::{Geometry, Grid, encoding::MrptLogOdds};
    /// let cells = (0..2_000_000).map(|k| [0, -32, 24][k % 3]).collect();
    /// let map = Grid::<MrptLogOdds>::new(2000, 1000, Geometry::new(0.05, [0.0, 0.0])?, cells)?;
    /// assert_eq!(map.par_mean_information(), map.mean_information());
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn par_mean_information(&self) -> E::Float {
        self.parts().map(E::information_sum).sum::<InformationSum<_>>().mean()
    }

    /// Returns the cells in parts of [`PART`] bytes.
    fn parts(&self) -> impl ParallelIterator<Item = &[E::Stored]> {
        self.cells().par_chunks((PART / size_of::<E::Stored>().max(1)).max(1))
    }
}
