//! The expected map of weighted hypotheses, such as the particles of a Rao-Blackwellized particle filter:
//! `EM(x, y) = sum w_i p_i(x, y) / sum w_i`. Its mean information is the EMMI of Blanco's report.

use super::alignment::Alignment;
use super::raster::too_many;
use super::weights::{Mean, Weights};
use crate::cell::{Cell, State};
use crate::error::Error;
use crate::map::encoding::{LogOdds, Probability};
use crate::map::{Encoding, Grid};
use crate::real::Real;
use crate::rounded::mean;
use crate::tally::Tally;
use alloc::vec::Vec;
use core::cmp::Ordering;
use num_traits::Zero;
use num_traits::float::FloatCore;

/// Maps of one place, each with a weight: the particles of a filter.
///
/// Beyond its own extent a map is unknown. All share one lattice of cells; weights need not add up to 1.
///
/// ```
/// use mean_information::build::Hypotheses;
/// use mean_information::map::{Geometry, Grid, encoding::Probability};
///
/// // The second map begins one cell further right.
/// type Map = Grid<Probability<f64>>;
/// let map = |x, cells: [f64; 2]| Map::new(2, 1, Geometry::new(0.25, [x, 0.0])?, cells.to_vec());
/// let maps = [map(1.0, [0.125, 0.5])?, map(1.25, [0.5, 0.875])?];
/// let expected = Hypotheses::new(&maps, &[6.0, 2.0])?.expected_map()?;
/// assert_eq!(expected.grid().cells(), [0.21875, 0.5, 0.59375]);
/// assert_eq!(expected.tally().observed(), 2);
/// assert_eq!(expected.tally().mean_information(), 0.13381606703177606); // EMMI
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Hypotheses<'a, E: Encoding> {
    maps: &'a [Grid<E>],
    weights: Weights,
    max_cells: u64,
}

/// An expected map, and the sums over its cells.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpectedMap<T: Real> {
    grid: Grid<Probability<T>>,
    tally: Tally<T>,
}

impl<T: Real> ExpectedMap<T> {
    /// The weighted means of the occupancies, each rounded once to nearest.
    pub fn grid(&self) -> &Grid<Probability<T>> {
        &self.grid
    }

    /// The sums over the expected map; its mean information is the EMMI.
    ///
    /// A cell counts as observed if its exact mean is not 1/2, even where the float nearest to it is. Entropy and
    /// information of a cell are those of the exact mean within `2^-63` bits, whatever the format, so that EMMI is
    /// the nearest float of the exact one or within `2^-63` bits of being so (proved,
    /// [`expected`](crate::book::expected)).
    pub fn tally(&self) -> &Tally<T> {
        &self.tally
    }
}

impl<'a, E: Encoding> Hypotheses<'a, E> {
    /// The most cells an expected map may have unless the caller says otherwise.
    pub const MAX_CELLS: u64 = 1 << 28;

    /// Maps and their weights, in the same order.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if there is no map or no weight above 0; [`Error::WeightCount`] if there is not one weight
    /// for each map; [`Error::Item`] naming the first weight that is NaN, negative or infinite.
    pub fn new(maps: &'a [Grid<E>], weights: &[f64]) -> Result<Self, Error> {
        if maps.is_empty() {
            return Err(Error::out_of_range("number of maps", 0.0, "1 or more"));
        }
        let weights = Weights::new(weights, maps.len())?;
        Ok(Self { maps, weights, max_cells: Self::MAX_CELLS })
    }

    /// Refuses expected maps of more cells than this; [`Self::MAX_CELLS`] otherwise.
    #[must_use]
    pub fn with_max_cells(self, max_cells: u64) -> Self {
        Self { max_cells, ..self }
    }

    /// The marginal of each cell over the hypotheses, the *linear opinion pool* `sum w_i p_i / sum w_i`.
    ///
    /// The sums are exact and rounded once, so that a cell that is unknown in all maps is exactly 1/2, and neither
    /// order nor scale of the weights changes a bit. `p_i` is [`Encoding::occupancy`].
    ///
    /// # Errors
    /// [`Error::Item`] naming a map of another resolution or yaw than the first, or whose origin is not a whole
    /// number of cells from the others' (within 1/1024, for the rounding of file formats); [`Error::TooManyCells`] if
    /// the least grid that holds all maps exceeds the limit.
    pub fn expected_map(&self) -> Result<ExpectedMap<E::Float>, Error> {
        let mut tally = Tally::new();
        let mut occupancies = Vec::with_capacity(self.maps.len());
        let grid = self.pool(E::Float::HALF, |stored| {
            occupancies.clear();
            occupancies.extend(stored.iter().filter_map(|&stored| E::occupancy(stored)));
            let mean = self.weights.mean(&occupancies);
            count(&mut tally, &mean);
            Some(mean.nearest())
        })?;
        tally.add_many(Cell::unknown(), grid.cells().len() as u64 - tally.cells());
        Ok(ExpectedMap { grid, tally })
    }

    /// The *log-linear pool*: the weighted mean of the log-odds, `sum w_i l_i / sum w_i`, the exact mean rounded once
    /// to nearest.
    ///
    /// It is not the expected map: no probability law has it for a marginal, and certainty in one map outweighs doubt
    /// in all others. MRPT averages its particles' maps so, in `f32`, and cuts the result to a byte. `l_i` is
    /// [`Encoding::log_odds`].
    ///
    /// # Errors
    /// As [`Self::expected_map`]; [`Error::Cell`] if a cell is certainly free in one map and certainly occupied in
    /// another, both of positive weight.
    pub fn log_linear_pool(&self) -> Result<Grid<LogOdds<E::Float>>, Error> {
        let mut finite = Vec::with_capacity(self.maps.len());
        self.pool(E::Float::zero(), |stored| {
            finite.clear();
            let (mut free, mut occupied) = (false, false);
            for (index, &stored) in stored.iter().enumerate() {
                let l = E::log_odds(stored)?;
                if l.is_infinite() && self.weights.is_positive(index) {
                    free |= l < E::Float::zero();
                    occupied |= l > E::Float::zero();
                }
                finite.push(if l.is_infinite() { E::Float::zero() } else { l });
            }
            match (free, occupied) {
                (true, true) => None,
                (true, false) => Some(E::Float::neg_infinity()),
                (false, true) => Some(E::Float::infinity()),
                (false, false) => Some(self.weights.mean(&finite).nearest()),
            }
        })
    }

    /// The weighted mean of the maps' own mean information, rounded once to nearest: what EMMI would be if the
    /// hypotheses agreed in every cell.
    pub fn mean_of_mean_information(&self) -> E::Float {
        let values: Vec<_> = self.maps.iter().map(|map| map.tally().mean_information()).collect();
        self.weights.mean(&values).nearest()
    }

    /// The grid of what `of` makes of the values stored for a cell, `unknown` where no map knows it.
    fn pool<P: Encoding>(
        &self,
        unknown: P::Stored,
        mut of: impl FnMut(&[E::Stored]) -> Option<P::Stored>,
    ) -> Result<Grid<P>, Error> {
        let Alignment { geometry, width, height, offsets } = Alignment::of(self.maps, self.max_cells)?;
        let mut cells = Vec::new();
        let count = width * height;
        cells.try_reserve_exact(count).map_err(|_| too_many(count as u128, self.max_cells))?;
        let mut stored = Vec::with_capacity(self.maps.len());
        for row in 0..height {
            for column in 0..width {
                stored.clear();
                stored.extend(self.maps.iter().zip(&offsets).map(|(map, &[left, lower])| {
                    let row = row.checked_sub(lower).and_then(|row| map.row(row));
                    let cell = column.checked_sub(left).and_then(|column| row?.get(column));
                    cell.copied().unwrap_or(E::unknown())
                }));
                let cell = if stored.iter().all(|&stored| stored == E::unknown()) {
                    Some(unknown)
                } else {
                    of(&stored)
                };
                let value = f64::NAN;
                let allowed = "log-odds that are not infinite of both signs";
                cells.push(cell.ok_or(Error::Cell { row, column, value, allowed })?);
            }
        }
        Grid::new(width, height, geometry, cells)
    }
}

/// Counts the cell of an exact mean of occupancies.
fn count<T: Real>(tally: &mut Tally<T>, mean: &Mean<'_>) {
    let distance = mean.beside_half();
    let (state, minor) = match distance.sign() {
        Ordering::Less => (State::Free, mean.leading()),
        Ordering::Greater => (State::Occupied, mean.complement().leading()),
        Ordering::Equal => return tally.add(Cell::unknown()),
    };
    // Of a certain mean, 0 or 1, nothing is left.
    let both = distance.leading().and_then(mean::beside_unknown).or_else(|| minor.map(mean::of_minor));
    tally.add_fixed(state, both.unwrap_or(mean::CERTAIN));
}
