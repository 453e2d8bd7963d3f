//! Hypotheses with their weights, and their expected map.

use super::alignment::Alignment;
use super::marginals::{self, Marginals};
use super::stack::{Run, Stack};
use super::weights::Weights;
use crate::error::Error;
use crate::map::encoding::{LogOdds, Probability};
#[cfg(feature = "rayon")]
use crate::map::parts;
use crate::map::{Encoding, Grid};
use crate::real::Real;
use crate::tally::Tally;
use alloc::vec::Vec;
use core::ops::Range;
use num_traits::Zero;
use num_traits::float::FloatCore;
#[cfg(feature = "rayon")]
use rayon::prelude::*;

/// The hypotheses about one place: maps, each with a weight, such as the particles of a filter.
///
/// Beyond its own extent a map is unknown. All maps share one lattice of cells; weights need not add up to 1. Means are
/// exact before they are rounded ([`expected`](crate::book::expected)).
///
/// ```
/// use mean_information::expected::Hypotheses;
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

/// An expected map with the sums over its cells. Memory: one float for each cell.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpectedMap<T: Real> {
    grid: Grid<Probability<T>>,
    tally: Tally<T>,
}

impl<T: Real> ExpectedMap<T> {
    /// Returns the map of weighted mean occupancies, each rounded once to nearest.
    pub fn grid(&self) -> &Grid<Probability<T>> {
        &self.grid
    }

    /// Returns the sums over the expected map; their mean information is the EMMI.
    ///
    /// A cell counts as observed if its exact mean is not 1/2, even where the float nearest to it is. Entropy and
    /// information of a cell are those of the exact mean within `2^-63` bits, whatever the format, so that EMMI is
    /// within half an ulp and `2^-63` bits of the exact one (proved,
    /// [`expected`](crate::book::expected)).
    pub fn tally(&self) -> &Tally<T> {
        &self.tally
    }
}

impl<'a, E: Encoding> Hypotheses<'a, E> {
    /// The default limit on the cells of an expected map.
    pub const MAX_CELLS: u64 = 1 << 28;

    /// Creates the hypotheses from maps and their weights, in the same order.
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

    /// Sets the largest number of cells of an expected map; the default is [`Self::MAX_CELLS`].
    #[must_use]
    pub fn with_max_cells(self, max_cells: u64) -> Self {
        Self { max_cells, ..self }
    }

    /// Computes the expected map: the marginal of each cell over the hypotheses, the *linear opinion pool*
    /// `sum w_i p_i / sum w_i`.
    ///
    /// The sums are exact and rounded once, so that a cell that is unknown in all maps is exactly 1/2, and neither
    /// order nor scale of the weights changes a bit. `p_i` is [`Encoding::occupancy`].
    ///
    /// # Errors
    /// [`Error::Item`] naming a map of another resolution or yaw than the first, or whose origin is not a whole
    /// number of cells from the others' (within 1/1024, for the rounding of file formats); [`Error::TooManyCells`] if
    /// the smallest grid that holds all maps exceeds the limit; [`Error::NoMemory`].
    pub fn expected_map(&self) -> Result<ExpectedMap<E::Float>, Error> {
        let alignment = self.alignment()?;
        let mut cells = reserved(&alignment)?;
        let stack = Stack::new(self.maps, &alignment);
        let tally =
            self.sums(&stack, 0..stack.cells(), |mean, count| cells.resize(cells.len() + count, mean))?;
        let Alignment { geometry, width, height, .. } = alignment;
        Ok(ExpectedMap { grid: Grid::new(width, height, geometry, cells)?, tally })
    }

    /// Computes the sums over the expected map without the map: the bits of [`ExpectedMap::tally`].
    ///
    /// Memory: nothing for a cell; 49 to 56 bytes for a map, 16 for its weight, and at most 80 KB. Cells on which all maps
    /// agree are counted by their value, which takes little more time than reading them.
    ///
    /// # Errors
    /// Those of [`Self::expected_map`], with the same limit on cells.
    ///
    /// ```
    /// use mean_information::expected::Hypotheses;
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
        let stack = Stack::new(self.maps, &alignment);
        self.sums(&stack, 0..stack.cells(), |_, _| ())
    }

    /// Computes [`Self::expected_tally`] on rayon's threads: the same bits for any number of them.
    ///
    /// # Errors
    /// Those of [`Self::expected_tally`].
    ///
    /// ```
    /// use mean_information::expected::Hypotheses;
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
        let stack = Stack::new(self.maps, &alignment);
        parts::for_threads(stack.cells()).map(|cells| self.sums(&stack, cells, |_, _| ())).sum()
    }

    /// Computes the sums over these cells. Calls `each` with the nearest float to the mean, and the number of neighbouring
    /// cells that have it, in order.
    fn sums(
        &self,
        stack: &Stack<E>,
        cells: Range<u64>,
        mut each: impl FnMut(E::Float, usize),
    ) -> Result<Tally<E::Float>, Error> {
        let mut marginals = Marginals::<E>::new(&self.weights, cells.end - cells.start);
        stack.each_run(cells, |run| {
            match run {
                Run::Agreed(stored, count) => {
                    marginals.add_agreed(stored, count as u64);
                    each(marginals::nearest::<E>(stored), count);
                }
                Run::Mixed(stored) => each(marginals.add(stored), 1),
            }
            Ok(())
        })?;
        Ok(marginals.into_tally())
    }

    /// Computes the *log-linear pool*: the weighted mean of the log-odds, `sum w_i l_i / sum w_i`, exactly, rounded once to
    /// nearest.
    ///
    /// It is not the expected map: it is the marginal of no probability law, and certainty in one map outweighs doubt in
    /// all others. MRPT averages its particles' maps in this way, in `f32`, and truncates the result to a byte. `l_i` is
    /// [`Encoding::log_odds`].
    ///
    /// # Errors
    /// Those of [`Self::expected_map`]; [`Error::Cell`] if a cell is certainly free in one map and certainly occupied in
    /// another, both of positive weight.
    ///
    /// ```
    /// use mean_information::expected::Hypotheses;
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
        let mut cells = reserved(&alignment)?;
        let (stack, mut finite) = (Stack::new(self.maps, &alignment), Vec::with_capacity(self.maps.len()));
        stack.each_run(0..stack.cells(), |run| {
            let stored = match run {
                Run::Agreed(stored, count) => {
                    // The mean of equal values, for any weights; adding 0 turns -0 into 0.
                    let l = E::log_odds(stored).unwrap_or(E::Float::zero()) + E::Float::zero();
                    cells.resize(cells.len() + count, l);
                    return Ok(());
                }
                Run::Mixed(stored) => stored,
            };
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
                    let (row, column) = (cells.len() / alignment.width, cells.len() % alignment.width);
                    let (value, allowed) = (f64::NAN, "log-odds that are not infinite of both signs");
                    return Err(Error::Cell { row, column, value, allowed });
                }
                (true, false) => E::Float::neg_infinity(),
                (false, true) => E::Float::infinity(),
                (false, false) => self.weights.mean(&finite).nearest(),
            });
            Ok(())
        })?;
        let Alignment { geometry, width, height, .. } = alignment;
        Grid::new(width, height, geometry, cells)
    }

    /// Computes the weighted mean of the maps' own mean information (Eq. 4, bits per observed cell): the EMMI if the
    /// hypotheses agreed in every cell.
    ///
    /// The exact mean of the floats of [`Tally::mean_information`], rounded once to nearest (proved,
    /// [`expected`](crate::book::expected)).
    ///
    /// ```
    /// use mean_information::expected::Hypotheses;
    /// use mean_information::map::{Geometry, Grid, encoding::Probability};
    /// let map = |p: f64| Grid::<Probability<f64>>::new(1, 1, Geometry::new(0.25, [1.0, 0.5])?, vec![p]);
    /// let maps = [map(0.125)?, map(0.75)?];
    /// let hypotheses = Hypotheses::new(&maps, &[6.0, 2.0])?;
    /// assert_eq!(hypotheses.mean_of_mean_information(), 0.3895071364855195);
    /// assert_eq!(hypotheses.expected_map()?.tally().mean_information(), 0.14285156257162834); // EMMI
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn mean_of_mean_information(&self) -> E::Float {
        // The bits of each map's tally, without its entropies.
        let values: Vec<_> = self.maps.iter().map(|map| E::information_sum(map.cells()).mean()).collect();
        self.weights.mean(&values).nearest()
    }

    /// Aligns the maps, within the limit.
    fn alignment(&self) -> Result<Alignment, Error> {
        Alignment::of(self.maps, self.max_cells)
    }
}

/// Reserves memory for the cells of the grid, or refuses.
fn reserved<C>(alignment: &Alignment) -> Result<Vec<C>, Error> {
    let (mut cells, count) = (Vec::new(), alignment.width as u128 * alignment.height as u128);
    let reserved = usize::try_from(count).is_ok_and(|count| cells.try_reserve_exact(count).is_ok());
    if reserved { Ok(cells) } else { Err(Error::no_memory(count)) }
}
