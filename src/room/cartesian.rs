//! The Cartesian grid of the circular room.

use super::axis::{Axis, AxisCell, first_false};
use super::sampling::{Samples, Sampling};
use crate::cell::Cell;
use crate::error::{Error, finite};
use crate::map::encoding::Probability;
use crate::map::{Geometry, Grid};
use crate::real::Real;
use crate::rounded::{Coordinate, distance};
use crate::sensor::InverseSensorModel;
use crate::tally::Tally;
use alloc::vec::Vec;
use num_traits::Zero;

/// The Cartesian grid of a circular room with the sensor at the origin: square cells of side `h` with their centres at
/// `((i + offset_x) h, (j + offset_y) h)`, `i` and `j` integers; all columns and all rows that have a sample within the
/// sensor's reach of the axis.
///
/// Offsets of 0 put the sensor on a cell's centre, offsets of 1/2 on a corner. A sample's distance is the exact one, from the
/// exact values of the floats, rounded once to nearest; its occupancy is what the model gives for that float
/// ([`grids`](crate::book::grids)).
///
/// ```
/// use mean_information::room::CartesianRoom;
/// use mean_information::sensor::GaussianSensor;
/// let room = CartesianRoom::new(GaussianSensor::new(2.0_f64, 0.2)?, 0.01, [0.5, 0.5])?;
/// assert_eq!((room.width()?, room.height()?), (448, 448));
/// assert_eq!(room.tally()?.mean_information(), 0.6524332571256078); // the limit is 0.65251
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct CartesianRoom<M: InverseSensorModel> {
    samples: Samples<M>,
    offsets: [M::Float; 2],
}

/// The name of the grid in errors.
const WHAT: &str = "the Cartesian grid of a room";

/// The axes of a grid, with the numbers of distances along each.
struct Extent<T> {
    x: Axis<T>,
    y: Axis<T>,
    columns: u64,
    rows: u64,
}

impl<M: InverseSensorModel> CartesianRoom<M> {
    /// Creates the room that `model` sees, in cells of side `resolution` (metres) at `offsets` (cells), sampled at their
    /// centres.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the resolution or the reach of the model is not positive and finite, or an offset not finite.
    pub fn new(model: M, resolution: M::Float, offsets: [M::Float; 2]) -> Result<Self, Error> {
        for offset in offsets {
            finite("offset", offset, "finite, in cells")?;
        }
        Ok(Self { samples: Samples::new(model, resolution)?, offsets })
    }

    /// Sets how cells are sampled. Each has as many rows of samples as the number of [`Sampling::Averaged`] says,
    /// and as many in a row.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if that number is not a power of two up to 1024.
    pub fn with_sampling(mut self, sampling: Sampling) -> Result<Self, Error> {
        self.samples.set_sampling(sampling)?;
        Ok(self)
    }

    /// Sets the largest number of samples, counted over the whole rectangle; the default is `2^34`.
    #[must_use]
    pub fn with_limit(mut self, limit: u64) -> Self {
        self.samples.limit = limit;
        self
    }

    /// Computes the distance (metres) of the centre of cell `(i, j)`, correctly rounded:
    /// `h √((i + offset_x)^2 + (j + offset_y)^2)`.
    ///
    /// Here `i` and `j` count from the cell nearest to the sensor: whole cells in the offsets are dropped.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if `i` or `j` is `2^44` or more.
    ///
    /// ```
    /// use mean_information::room::CartesianRoom;
    /// use mean_information::sensor::GaussianSensor;
    /// let room = CartesianRoom::new(GaussianSensor::new(2.0_f64, 0.2)?, 0.01, [0.0, 0.25])?;
    /// assert_eq!(room.distance(-3, 7)?, 0.07846177413237608);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn distance(&self, i: i64, j: i64) -> Result<M::Float, Error> {
        for k in [i, j] {
            if k.unsigned_abs() >= 1 << 44 {
                return Err(Error::out_of_range("cell index", k as f64, "below 2^44"));
            }
        }
        let [x, y] = self.axes(1);
        let centre = |cell: AxisCell<M::Float>| cell.far();
        Ok(distance(self.samples.resolution, -1, centre(x.at(i)), centre(y.at(j))))
    }

    /// Returns the number of columns.
    ///
    /// # Errors
    /// [`Error::TooManySamples`] if the grid has more samples than the limit.
    pub fn width(&self) -> Result<u64, Error> {
        self.extent().map(|extent| extent.width())
    }

    /// Returns the number of rows.
    ///
    /// # Errors
    /// [`Error::TooManySamples`] if the grid has more samples than the limit.
    pub fn height(&self) -> Result<u64, Error> {
        self.extent().map(|extent| extent.height())
    }

    /// Computes entropy, information and counts over all cells (Eqs. 2 to 4) without the map: the bits of the tally of
    /// [`map`](Self::map), within 1.5 ulp of those of its occupancies.
    ///
    /// Mirror images of a cell are counted at once, as are the cells of the model's
    /// [plateau](InverseSensorModel::plateau). With offsets of 0 or 1/2, one cell in eight is evaluated.
    ///
    /// # Errors
    /// [`Error::TooManySamples`] if the grid has more samples than the limit; [`Error::OutOfRange`] if the model gives an
    /// occupancy outside `[0, 1]`.
    pub fn tally(&self) -> Result<Tally<M::Float>, Error> {
        self.tally_part(0, 1)
    }

    /// Computes part `part` of `parts` of the tally, for threads or machines. Parts take about equal work; merged in any
    /// order they have the bits of the tally.
    ///
    /// # Errors
    /// Those of [`tally`](Self::tally), and [`Error::OutOfRange`] if `part` is not below `parts`.
    ///
    /// ```
    /// use mean_information::room::CartesianRoom;
    /// use mean_information::sensor::GaussianSensor;
    /// let room = CartesianRoom::new(GaussianSensor::new(2.0_f64, 0.2)?, 0.02, [0.0, 0.0])?;
    /// let mut tally = room.tally_part(1, 2)?;
    /// tally.merge(&room.tally_part(0, 2)?);
    /// assert_eq!(tally, room.tally()?);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn tally_part(&self, part: usize, parts: usize) -> Result<Tally<M::Float>, Error> {
        if part >= parts {
            return Err(Error::out_of_range("part", part as f64, "below the number of parts"));
        }
        let extent = self.extent()?;
        let mut tally = Tally::new();
        let mut cells = 0;
        for row in (part as u64..extent.rows).step_by(parts) {
            cells += extent.cells_of_row(row);
            self.add_row(&extent, row, &mut tally)?;
        }
        // Cells beyond the reach are unknown.
        tally.add_many(Cell::unknown(), cells - tally.cells());
        Ok(tally)
    }

    /// Computes [`CartesianRoom::tally`] on rayon's threads: the same bits for any number of them.
    ///
    /// # Errors
    /// Those of [`tally`](Self::tally).
    ///
    /// ```
    /// use mean_information::room::CartesianRoom;
    /// use mean_information::sensor::GaussianSensor;
    /// let room = CartesianRoom::new(GaussianSensor::new(2.0_f64, 0.2)?, 0.02, [0.5, 0.5])?;
    /// assert_eq!(room.par_tally()?, room.tally()?);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    #[cfg(feature = "rayon")]
    pub fn par_tally(&self) -> Result<Tally<M::Float>, Error>
    where
        M: Sync,
    {
        use rayon::prelude::*;
        // Rows differ in the time they take: more parts than threads.
        let parts = 16 * rayon::current_num_threads();
        (0..parts).into_par_iter().map(|part| self.tally_part(part, parts)).sum()
    }

    /// Creates the map, row 0 the lowest, with its place in the world. Each cell has the model's occupancy at its
    /// [`distance`](Self::distance), or the exact mean over its samples, rounded once.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] if it has more than `max_cells` cells, [`Error::TooManySamples`] if it has more samples than the
    /// limit; [`Error::OutOfRange`] if the model gives an occupancy outside `[0, 1]`.
    ///
    /// ```
    /// use mean_information::room::CartesianRoom;
    /// use mean_information::sensor::GaussianSensor;
    /// let room = CartesianRoom::new(GaussianSensor::new(2.0_f64, 0.2)?, 0.25, [0.0, 0.5])?;
    /// let map = room.map(400)?;
    /// assert_eq!((map.width(), map.height()), (17, 18));
    /// assert_eq!(map.occupancy(2, 8), Some(0.17242162389375285)); // at x = 0, y = -1.625 metres
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn map(&self, max_cells: usize) -> Result<Grid<Probability<M::Float>>, Error> {
        let extent = self.extent()?;
        let (width, height) = (extent.width(), extent.height());
        let count = u128::from(width) * u128::from(height);
        if count > max_cells as u128 {
            return Err(Error::TooManyCells { what: WHAT, count: count as f64, limit: max_cells as u64 });
        }
        let (columns, rows) = (extent.x.indices(extent.columns), extent.y.indices(extent.rows));
        let resolution = self.samples.resolution.widen();
        let origin = [(&extent.x, &columns), (&extent.y, &rows)]
            .map(|(axis, indices)| (axis.centre(indices.start) - 0.5) * resolution);
        let mut cells = Vec::with_capacity(count as usize);
        for j in rows {
            for i in columns.clone() {
                cells.push(self.occupancy(extent.x.at(i), extent.y.at(j))?);
            }
        }
        Grid::new(width as usize, height as usize, Geometry::new(resolution, origin)?, cells)
    }

    /// Returns the axes of cells with `per_side` samples along each.
    fn axes(&self, per_side: u32) -> [Axis<M::Float>; 2] {
        self.offsets.map(|offset| Axis::new(offset, per_side))
    }

    /// Finds how many columns and rows have a sample within the reach, and refuses too many samples.
    fn extent(&self) -> Result<Extent<M::Float>, Error> {
        let samples = &self.samples;
        let along = 2.0 * samples.along_a_beam();
        // The estimate is good to four cells. Up to it, indices stay far below 2^44.
        let at_least = (along - 4.0 * f64::from(samples.per_side)).max(0.0);
        if at_least * at_least > 2.0 * samples.limit as f64 {
            return Err(samples.refused(WHAT, along * along));
        }
        let [x, y] = self.axes(samples.per_side);
        let on_axis = Coordinate::new(0, M::Float::zero());
        let within = |axis: Axis<M::Float>| {
            let end = (along / f64::from(samples.per_side)) as u64 + 4;
            first_false(end, |order| self.at(axis.nearest(order).near(), on_axis) <= samples.reach)
        };
        let extent = Extent { x, y, columns: within(x), rows: within(y) };
        let count = [extent.width(), extent.height(), samples.per_side.into(), samples.per_side.into()];
        let count = count.into_iter().map(u128::from).product::<u128>();
        if count > u128::from(samples.limit) { Err(samples.refused(WHAT, count as f64)) } else { Ok(extent) }
    }

    /// Adds the cells within reach of the rows at one distance. If both axes have the same distances, only cells that are not
    /// farther out along x than along y are evaluated, and counted for both.
    fn add_row(&self, extent: &Extent<M::Float>, row: u64, tally: &mut Tally<M::Float>) -> Result<(), Error> {
        let samples = &self.samples;
        let y = extent.y.nearest(row);
        let columns = extent.columns_of_row(row);
        let columns = first_false(columns, |column| {
            self.at(extent.x.nearest(column).near(), y.near()) <= samples.reach
        });
        let plateau = first_false(columns, |column| {
            self.at(extent.x.nearest(column).far(), y.far()) <= samples.plateau
        });
        tally.add_many(samples.plateau_cell()?, extent.cells(0, plateau, row));
        for column in plateau..columns {
            let p = self.occupancy(extent.x.nearest(column), y)?;
            tally.add_many(Cell::from_occupancy(p)?, extent.cells(column, column + 1, row));
        }
        Ok(())
    }

    /// Computes the distance of a sample from the sensor.
    fn at(&self, x: Coordinate, y: Coordinate) -> M::Float {
        distance(self.samples.resolution, self.samples.scale(), x, y)
    }

    /// Computes the occupancy of a cell by its sampling.
    fn occupancy(&self, x: AxisCell<M::Float>, y: AxisCell<M::Float>) -> Result<M::Float, Error> {
        if self.samples.per_side == 1 {
            self.samples.at(self.at(x.far(), y.far()))
        } else {
            self.samples.mean(y.samples().flat_map(|y| x.samples().map(move |x| self.at(x, y))))
        }
    }
}

impl<T: Real> Extent<T> {
    /// Returns the number of columns.
    fn width(&self) -> u64 {
        self.x.cells(self.columns)
    }

    /// Returns the number of rows.
    fn height(&self) -> u64 {
        self.y.cells(self.rows)
    }

    /// Returns whether exchanging x and y maps the grid to itself.
    fn is_diagonal(&self) -> bool {
        self.x.has_the_distances_of(&self.y)
    }

    /// Returns the number of columns that are evaluated in a row: up to the diagonal, if that is a mirror.
    fn columns_of_row(&self, row: u64) -> u64 {
        if self.is_diagonal() { self.columns.min(row + 1) } else { self.columns }
    }

    /// Returns the number of cells that the columns from `start` to `end` (not included) of a row represent.
    fn cells(&self, start: u64, end: u64, row: u64) -> u64 {
        let columns = |end: u64| self.x.cells(end);
        let rows = self.y.cells(row + 1) - self.y.cells(row);
        let beside = |end: u64| rows * columns(end);
        if self.is_diagonal() {
            // On the diagonal once, below it twice.
            let upto = |end: u64| beside(end.min(row)) * 2 + if end > row { rows * rows } else { 0 };
            upto(end) - upto(start)
        } else {
            beside(end) - beside(start)
        }
    }

    /// Returns the number of cells that a row represents.
    fn cells_of_row(&self, row: u64) -> u64 {
        self.cells(0, self.columns_of_row(row), row)
    }
}
