//! The expected map of weighted hypotheses, such as the particles of a Rao-Blackwellized particle filter:
//! `EM(x, y) = sum w_i p_i(x, y) / sum w_i`. Its mean information is the EMMI of Blanco's report.

use super::alignment::Alignment;
use super::raster::too_many;
use super::weights::{Mean, Weights};
use crate::cell::State;
use crate::error::Error;
use crate::map::encoding::{LogOdds, Probability};
use crate::map::{Encoding, Grid};
use crate::real::Real;
use crate::rounded::Natural;
use crate::rounded::mean::{self, Both};
use crate::tally::Tally;
use alloc::{vec, vec::Vec};
use core::cmp::Ordering;
use core::ops::Range;
use num_traits::Zero;
use num_traits::float::FloatCore;
#[cfg(feature = "rayon")]
use rayon::prelude::*;

/// Maps of one place, each with a weight: the particles of a filter.
///
/// Beyond its own extent a map is unknown. All share one lattice of cells; weights need not add up to 1. Means are exact
/// before they are rounded ([`expected`](crate::book::expected)).
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

/// An expected map, and the sums over its cells. Memory: one float for a cell.
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
        let alignment = self.alignment()?;
        let mut cells = self.room(&alignment)?;
        let (mut tally, mut marginals) = (Tally::new(), Marginals::<E>::new(&self.weights));
        for row in 0..alignment.height {
            self.each_of_row(&alignment, row, |_, stored| {
                let marginal = marginals.of(stored);
                tally.add_fixed(marginal.state, marginal.both);
                cells.push(marginal.nearest);
                Ok(())
            })?;
        }
        let Alignment { geometry, width, height, .. } = alignment;
        Ok(ExpectedMap { grid: Grid::new(width, height, geometry, cells)?, tally })
    }

    /// The sums over the expected map, without the map: the bits of [`ExpectedMap::tally`].
    ///
    /// Memory: nothing for a cell, some 40 bytes for a map. A cell that no map knows, or all know to be the same as the
    /// cell before on which all agreed, takes no arithmetic.
    ///
    /// # Errors
    /// As [`Self::expected_map`], of which the limit holds, too.
    ///
    /// ```
    /// use mean_information::build::Hypotheses;
    /// use mean_information::map::{Geometry, Grid, encoding::MrptLogOdds};
    /// let map = |cells: [i8; 3]| {
    ///     Grid::<MrptLogOdds>::new(3, 1, Geometry::new(0.25, [1.0, 0.5])?, cells.to_vec())
    /// };
    /// let maps = [map([32, 16, 0])?, map([32, -16, 0])?];
    /// let tally = Hypotheses::new(&maps, &[6.0, 2.0])?.expected_tally()?;
    /// assert_eq!((tally.free(), tally.occupied(), tally.unknown()), (2, 0, 1));
    /// assert_eq!(tally.mean_information(), 0.2558981086972227); // EMMI
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn expected_tally(&self) -> Result<Tally<E::Float>, Error> {
        let alignment = self.alignment()?;
        self.tally_of_rows(&alignment, 0..alignment.height)
    }

    /// [`Self::expected_tally`] by as many threads as rayon has: the same bits for any number of them.
    ///
    /// # Errors
    /// As [`Self::expected_tally`].
    ///
    /// ```
    /// use mean_information::build::Hypotheses;
    /// use mean_information::map::{Geometry, Grid, encoding::Percent};
    /// let map = |cells: [i8; 3]| Grid::<Percent>::new(1, 3, Geometry::new(0.25, [1.0, 0.5])?, cells.to_vec());
    /// let maps = [map([32, 16, -1])?, map([33, 99, 50])?];
    /// let hypotheses = Hypotheses::new(&maps, &[6.0, 2.0])?;
    /// assert_eq!(hypotheses.par_expected_tally()?, hypotheses.expected_tally()?);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    #[cfg(feature = "rayon")]
    pub fn par_expected_tally(&self) -> Result<Tally<E::Float>, Error> {
        let alignment = self.alignment()?;
        (0..alignment.height).into_par_iter().map(|row| self.tally_of_rows(&alignment, row..row + 1)).sum()
    }

    fn tally_of_rows(&self, alignment: &Alignment, rows: Range<usize>) -> Result<Tally<E::Float>, Error> {
        let (mut tally, mut marginals) = (Tally::new(), Marginals::<E>::new(&self.weights));
        for row in rows {
            self.each_of_row(alignment, row, |_, stored| {
                let marginal = marginals.of(stored);
                tally.add_fixed(marginal.state, marginal.both);
                Ok(())
            })?;
        }
        Ok(tally)
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
    ///
    /// ```
    /// use mean_information::build::Hypotheses;
    /// use mean_information::map::{Geometry, Grid, encoding::Probability};
    /// let map = |cells: [f64; 2]| {
    ///     Grid::<Probability<f64>>::new(2, 1, Geometry::new(0.25, [1.0, 0.5])?, cells.to_vec())
    /// };
    /// let maps = [map([0.125, 1.0])?, map([0.5, 0.75])?];
    /// let pool = Hypotheses::new(&maps, &[6.0, 2.0])?.log_linear_pool()?;
    /// assert_eq!(pool.cells(), [-1.4594326117914849, f64::INFINITY]); // nats: 3/4 of ln(1/7), and certainty
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn log_linear_pool(&self) -> Result<Grid<LogOdds<E::Float>>, Error> {
        let alignment = self.alignment()?;
        let mut cells = self.room(&alignment)?;
        let mut finite = Vec::with_capacity(self.maps.len());
        for row in 0..alignment.height {
            self.each_of_row(&alignment, row, |column, stored| {
                finite.clear();
                let (mut free, mut occupied) = (false, false);
                for (index, l) in stored.iter().filter_map(|&stored| E::log_odds(stored)).enumerate() {
                    if l.is_infinite() && self.weights.is_positive(index) {
                        free |= l < E::Float::zero();
                        occupied |= l > E::Float::zero();
                    }
                    finite.push(if l.is_infinite() { E::Float::zero() } else { l });
                }
                cells.push(match (free, occupied) {
                    (true, true) => {
                        let (value, allowed) = (f64::NAN, "log-odds that are not infinite of both signs");
                        return Err(Error::Cell { row, column, value, allowed });
                    }
                    (true, false) => E::Float::neg_infinity(),
                    (false, true) => E::Float::infinity(),
                    (false, false) => self.weights.mean(&finite).nearest(),
                });
                Ok(())
            })?;
        }
        let Alignment { geometry, width, height, .. } = alignment;
        Grid::new(width, height, geometry, cells)
    }

    /// The weighted mean of the maps' own mean information (Eq. 4, bits per observed cell): what EMMI would be if the
    /// hypotheses agreed in every cell.
    ///
    /// The exact mean of the floats of [`Tally::mean_information`], rounded once to nearest (proved,
    /// [`expected`](crate::book::expected)).
    ///
    /// ```
    /// use mean_information::build::Hypotheses;
    /// use mean_information::map::{Geometry, Grid, encoding::Probability};
    /// let map = |p: f64| Grid::<Probability<f64>>::new(1, 1, Geometry::new(0.25, [1.0, 0.5])?, vec![p]);
    /// let maps = [map(0.125)?, map(0.75)?];
    /// let hypotheses = Hypotheses::new(&maps, &[6.0, 2.0])?;
    /// assert_eq!(hypotheses.mean_of_mean_information(), 0.3895071364855195);
    /// assert_eq!(hypotheses.expected_map()?.tally().mean_information(), 0.14285156257162834); // EMMI
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn mean_of_mean_information(&self) -> E::Float {
        let values: Vec<_> = self.maps.iter().map(|map| map.tally().mean_information()).collect();
        self.weights.mean(&values).nearest()
    }

    fn alignment(&self) -> Result<Alignment, Error> {
        Alignment::of(self.maps, self.max_cells)
    }

    /// Memory for as many cells as the grid has.
    fn room<C>(&self, alignment: &Alignment) -> Result<Vec<C>, Error> {
        let (mut cells, count) = (Vec::new(), alignment.width * alignment.height);
        cells.try_reserve_exact(count).map_err(|_| too_many(count as u128, self.max_cells))?;
        Ok(cells)
    }

    /// Hands the column and what each map stores there to `of`, for each cell of a row.
    fn each_of_row(
        &self,
        alignment: &Alignment,
        row: usize,
        mut of: impl FnMut(usize, &[E::Stored]) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let part = |(map, &[left, lower]): (&'a Grid<E>, &[usize; 2])| {
            (left, row.checked_sub(lower).and_then(|row| map.row(row)).unwrap_or(&[]))
        };
        let parts: Vec<(usize, &[E::Stored])> = self.maps.iter().zip(&alignment.offsets).map(part).collect();
        let mut stored = vec![E::unknown(); parts.len()];
        for column in 0..alignment.width {
            for (stored, &(left, part)) in stored.iter_mut().zip(&parts) {
                // Before its left end a map has no cell either: the difference wraps around.
                *stored = part.get(column.wrapping_sub(left)).copied().unwrap_or(E::unknown());
            }
            of(column, &stored)?;
        }
        Ok(())
    }
}

/// The marginal of a cell: the nearest float, and what the sums take.
#[derive(Clone, Copy)]
struct Marginal<T> {
    nearest: T,
    state: State,
    both: Both,
}

impl<T: Real> Marginal<T> {
    /// Of an exact mean of occupancies.
    fn of(mean: &Mean<'_>) -> Self {
        let beside_half = mean.beside_half();
        let state = match beside_half.sign() {
            Ordering::Less => State::Free,
            Ordering::Greater => State::Occupied,
            Ordering::Equal => State::Unknown,
        };
        let first = mean.leading();
        let nearest = first.map_or(T::zero(), |(leading, cut)| leading.nearest(cut));
        // Of a certain mean, 0 or 1, nothing is left.
        let minor = || {
            let minor = if state == State::Free { first } else { mean.complement().leading() };
            minor.map_or(mean::CERTAIN, |(leading, _)| mean::of_minor(leading))
        };
        let beside_unknown = || beside_half.leading().and_then(|(leading, _)| mean::beside_unknown(leading));
        let both = match state {
            State::Unknown => mean::UNKNOWN,
            _ if beside_half.is_above_a_sixteenth() => minor(),
            _ => beside_unknown().unwrap_or_else(minor),
        };
        Self { nearest, state, both }
    }
}

/// The marginals of cells, one after another.
struct Marginals<'a, E: Encoding> {
    weights: &'a Weights,
    occupancies: Vec<E::Float>,
    /// The last value that all maps had stored of a cell.
    agreed: Option<(E::Stored, Marginal<E::Float>)>,
}

impl<'a, E: Encoding> Marginals<'a, E> {
    fn new(weights: &'a Weights) -> Self {
        Self { weights, occupancies: Vec::new(), agreed: None }
    }

    /// Of what the maps store of a cell.
    fn of(&mut self, stored: &[E::Stored]) -> Marginal<E::Float> {
        let first = stored.first().copied().unwrap_or(E::unknown());
        if stored.iter().any(|&other| other != first) {
            self.occupancies.clear();
            self.occupancies.extend(stored.iter().filter_map(|&stored| E::occupancy(stored)));
            return Marginal::of(&self.weights.mean(&self.occupancies));
        }
        if first == E::unknown() {
            return Marginal { nearest: E::Float::HALF, state: State::Unknown, both: mean::UNKNOWN };
        }
        match self.agreed {
            Some((stored, marginal)) if stored == first => marginal,
            _ => {
                let p = E::occupancy(first).unwrap_or(E::Float::HALF);
                let marginal = Marginal::of(&Mean::of_one(p, &Natural::from(1)));
                self.agreed = Some((first, marginal));
                marginal
            }
        }
    }
}
