//! The polar map `m_ρ`: cells of equal `dρ dθ` about a sensor.

use super::cell_rows::CellRows;
use super::stored::Encoding;
use crate::error::{Error, positive};
use crate::tally::Tally;
use alloc::vec::Vec;

/// An occupancy map in polar coordinates about a sensor: equal sectors of the full turn, each cut into rings of equal width.
///
/// Cell `(sector, ring)` covers `θ` from `sector 2π/sectors` to `(sector + 1) 2π/sectors`, measured from the direction of
/// the first beam, and `ρ` from `ring` to `ring + 1` times the resolution. Cells are stored sector by sector, from the sensor
/// outwards, as a scanner delivers its beams.
///
/// All cells have the same weight, although the area of a cell grows with its distance: the mean information of a polar map is a mean
/// over `dρ dθ`, as in Eq. 6, and not the one of the [`Grid`](super::Grid) of the same place
/// ([`grids`](crate::book::grids)).
///
/// ```
/// use mean_information::map::{PolarMap, encoding::Probability};
/// // Two beams of three cells of 40 cm: the obstacle is in the third cell of one, in the second of the other.
/// let map = PolarMap::<Probability<f64>>::new(2, 3, 0.4, vec![0.1, 0.1, 0.9, 0.1, 0.9, 0.5])?;
/// assert_eq!(map.occupancy(1, 1), Some(0.9));
/// assert_eq!(map.tally().observed(), 5);
/// assert_eq!(map.tally().mean_information(), 0.5310044064107188);
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PolarMap<E: Encoding> {
    /// A row is a sector, a column a ring.
    rows: CellRows<E>,
    resolution: f64,
}

impl<E: Encoding> PolarMap<E> {
    /// Creates a map of `sectors` times `rings` cells, `resolution` (metres) from ring to ring, from its cells sector by
    /// sector.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the resolution is not positive and finite; [`Error::CellCount`] if there are not sectors times
    /// rings cells; [`Error::Cell`] naming the first cell (its sector as the row, its ring as the column) whose value the
    /// encoding does not allow.
    pub fn new(sectors: usize, rings: usize, resolution: f64, cells: Vec<E::Stored>) -> Result<Self, Error> {
        let resolution = positive("resolution", resolution)?;
        Ok(Self { rows: CellRows::new(rings, sectors, cells)?, resolution })
    }

    /// Returns the number of sectors in the full turn.
    pub fn sectors(&self) -> usize {
        self.rows.height()
    }

    /// Returns the number of cells along a beam.
    pub fn rings(&self) -> usize {
        self.rows.width()
    }

    /// Returns the width of a ring, in metres.
    pub fn resolution(&self) -> f64 {
        self.resolution
    }

    /// Returns the stored cells, sector by sector, each from the sensor outwards.
    pub fn cells(&self) -> &[E::Stored] {
        self.rows.cells()
    }

    /// Returns the stored cells and frees the map.
    ///
    /// ```
    /// use mean_information::map::{PolarMap, encoding::Probability};
    /// let map = PolarMap::<Probability<f64>>::new(2, 2, 0.4, vec![0.1, 0.9, 0.9, 0.5])?;
    /// assert_eq!(map.into_cells(), [0.1, 0.9, 0.9, 0.5]);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn into_cells(self) -> Vec<E::Stored> {
        self.rows.into_cells()
    }

    /// Returns the stored cells of one sector, from the sensor outwards; `None` beyond the last.
    pub fn sector(&self, sector: usize) -> Option<&[E::Stored]> {
        self.rows.row(sector)
    }

    /// Returns the occupancy of one cell, with the bits of [`Encoding::occupancy`]; `None` outside the map.
    pub fn occupancy(&self, sector: usize, ring: usize) -> Option<E::Float> {
        self.rows.occupancy(sector, ring)
    }

    /// Computes entropy, information and counts over all cells (Eqs. 2 to 4), each counted once whatever its area; the
    /// sums are exact.
    pub fn tally(&self) -> Tally<E::Float> {
        self.rows.tally()
    }

    /// Computes the mean information (Eq. 4), in bits per observed cell; 0 if no cell is observed. It has the bits of
    /// [`Tally::mean_information`], within 1.5 ulp of that of the cells given, but is faster, because no entropies are
    /// computed.
    ///
    /// ```
    /// use mean_information::map::{PolarMap, encoding::Probability};
    /// let map = PolarMap::<Probability<f64>>::new(2, 3, 0.4, vec![0.1, 0.9, 0.5, 0.1, 0.1, 0.9])?;
    /// assert_eq!(map.mean_information(), 0.5310044064107188);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn mean_information(&self) -> E::Float {
        self.rows.mean_information()
    }
}
