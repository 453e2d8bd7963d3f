//! The observed cells of a map that leave the most doubt, and the square of cells that does.

use crate::cell_cache::CellCache;
use crate::number::Number;
use mean_information::cell::{Cell, State};
use mean_information::map::{Encoding, Grid};
use mean_information::{Real, Tally};
use mean_information_files::{Cells, with_grid};
use std::cmp::Ordering;
use std::ops::Range;

/// The units of entropy in a bit, by which squares are compared: sums of whole numbers are exact.
const UNITS: f64 = (1_u64 << 40) as f64;
/// The longest side of a square, for which sums of units stay below 2^64: 4096² cells of a bit would reach it.
pub const MAX_SIDE: usize = 4095;

/// The cells and the square of a map that leave the most doubt.
#[derive(Clone, Debug, PartialEq)]
pub struct Worst {
    /// Row and column of the observed cells with the largest entropies, the largest first; of equal ones those of the lower row,
    /// then column, come first.
    pub cells: Vec<[usize; 2]>,
    /// The number of observed cells whose entropy equals that of the first.
    pub equal: u64,
    /// The square; `None` if no observed cell has an entropy of 2^-40 bit or more.
    pub square: Option<Square>,
}

/// A square of cells, less where the map is narrower.
#[derive(Clone, Debug, PartialEq)]
pub struct Square {
    /// The columns.
    pub columns: Range<usize>,
    /// The rows.
    pub rows: Range<usize>,
    /// The number of observed cells in it.
    pub observed: u64,
    /// The sum of their entropies, in bits.
    pub entropy: Number,
    /// Their mean information, in bits per observed cell.
    pub mean_information: Number,
}

impl Worst {
    /// Finds [`Worst::of`] a map in any encoding.
    pub fn of_cells(cells: &Cells, most: usize, side: usize) -> Self {
        with_grid!(cells, grid => Self::of(grid, most, side))
    }

    /// Finds the `most` observed cells with the largest entropies `H` (Eq. 1), and the square of `side` x `side` cells with the
    /// largest sum of `H` over its observed cells, the first of equals from the lowest row and column on.
    ///
    /// A side is cut to [`MAX_SIDE`] and to the map's. Squares are compared by `H` rounded down to 2^-40 bit, so that the sum of
    /// the one found is less than `side`² · 2^-40 bit below the largest (proved: rounding takes less than a unit from a cell);
    /// its own sum is exact, rounded once.
    ///
    /// ```
    /// use mean_information::map::{Geometry, Grid, encoding::Percent};
    /// use mean_information_report::worst::Worst;
    /// let cells = vec![0, -1, 10, 0, 40, 30];
    /// let grid = Grid::<Percent>::new(3, 2, Geometry::new(0.05, [0.0, 0.0])?, cells)?;
    /// let worst = Worst::of(&grid, 2, 2);
    /// assert_eq!(worst.cells, [[1, 1], [1, 2]]); // 0.40, then 0.30
    /// assert_eq!(worst.square.map(|square| square.entropy.widen()), Some(2.3212370872746426)); // bits
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn of<E: Encoding>(grid: &Grid<E>, most: usize, side: usize) -> Self {
        let mut cache = CellCache::new();
        let (mut ranks, mut squares) = (Ranks::new(most), Squares::new([grid.width(), grid.height()], side));
        for row in 0..grid.height() {
            for (column, cell) in observed(grid, &mut cache, row, 0..grid.width()) {
                let entropy = cell.entropy().widen();
                ranks.add(entropy, [row, column]);
                squares.sums[column] += units(entropy);
            }
            let Some(lowest) = (row + 1).checked_sub(squares.height) else { continue };
            squares.compare(lowest);
            for (column, cell) in observed(grid, &mut cache, lowest, 0..grid.width()) {
                squares.sums[column] -= units(cell.entropy().widen());
            }
        }
        let square = squares.best.map(|(_, [row, column])| {
            let (rows, columns) = (row..row + squares.height, column..column + squares.width);
            let mut tally = Tally::<E::Float>::new();
            for row in rows.clone() {
                observed(grid, &mut cache, row, columns.clone()).for_each(|(_, cell)| tally.add(cell));
            }
            let [entropy, mean_information] = [tally.entropy(), tally.mean_information()].map(Number::new);
            Square { columns, rows, observed: tally.observed(), entropy, mean_information }
        });
        Self { cells: ranks.cells.into_iter().map(|(_, place)| place).collect(), equal: ranks.equal, square }
    }
}

/// Returns the observed cells of a part of a row, each with its column.
fn observed<E: Encoding>(
    grid: &Grid<E>,
    cache: &mut CellCache<E>,
    row: usize,
    columns: Range<usize>,
) -> impl Iterator<Item = (usize, Cell<E::Float>)> {
    let cells = grid.row(row).and_then(|row| row.get(columns.clone())).unwrap_or_default();
    columns
        .zip(cells)
        .filter_map(|(column, &stored)| cache.cell(stored).map(|cell| (column, cell)))
        .filter(|(_, cell)| cell.state() != State::Unknown)
}

/// Returns the whole units in an entropy.
fn units(entropy: f64) -> u64 {
    (entropy * UNITS) as u64
}

/// The cells with the largest entropies so far, row by row.
struct Ranks {
    most: usize,
    cells: Vec<(f64, [usize; 2])>,
    largest: f64,
    equal: u64,
}

impl Ranks {
    fn new(most: usize) -> Self {
        Self { most, cells: Vec::new(), largest: 0.0, equal: 0 }
    }

    /// Takes note of the next cell, unless nothing is in doubt there.
    fn add(&mut self, entropy: f64, place: [usize; 2]) {
        match entropy.total_cmp(&self.largest) {
            Ordering::Greater => (self.largest, self.equal) = (entropy, 1),
            Ordering::Equal if entropy > 0.0 => self.equal += 1,
            _ => {}
        }
        let is_full = self.cells.len() == self.most;
        if entropy > 0.0 && (!is_full || self.cells.last().is_some_and(|&(least, _)| entropy > least)) {
            self.cells.truncate(self.most.saturating_sub(1));
            let at = self.cells.partition_point(|&(other, _)| other >= entropy);
            self.cells.insert(at, (entropy, place));
        }
    }
}

/// The sums of entropy of each column of the rows that a square spans, in units, and the largest square so far.
struct Squares {
    sums: Vec<u64>,
    width: usize,
    height: usize,
    best: Option<(u64, [usize; 2])>,
}

impl Squares {
    fn new([width, height]: [usize; 2], side: usize) -> Self {
        let side = side.clamp(1, MAX_SIDE);
        Self { sums: vec![0; width], width: side.min(width), height: side.min(height), best: None }
    }

    /// Compares the squares whose lowest row is `row`.
    fn compare(&mut self, row: usize) {
        let mut sum: u64 = self.sums[..self.width].iter().sum();
        for column in 0..=self.sums.len() - self.width {
            if column > 0 {
                sum = sum - self.sums[column - 1] + self.sums[column + self.width - 1];
            }
            if sum > self.best.map_or(0, |(largest, _)| largest) {
                self.best = Some((sum, [row, column]));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mean_information::map::Geometry;
    use mean_information::map::encoding::{LogOdds, Percent};
    use proptest::prelude::*;

    fn percent(width: usize, cells: Vec<i8>) -> Grid<Percent> {
        let geometry = Geometry::new(0.05, [0.0; 2]).unwrap();
        Grid::new(width, cells.len() / width, geometry, cells).unwrap()
    }

    proptest! {
        /// By sorting all cells, and by adding up every square.
        #[test]
        fn the_worst_is_that_of_all(
            width in 1_usize..9,
            cells in proptest::collection::vec(prop_oneof![Just(-1_i8), Just(0), 0_i8..=100], 1..70),
            most in 1_usize..6,
            side in 1_usize..7,
        ) {
            prop_assume!(cells.len() >= width);
            let cells = cells[..cells.len() / width * width].to_vec();
            let grid = percent(width, cells);
            let doubt = |row: usize, column: usize| {
                let p = grid.occupancy(row, column).unwrap();
                if p == 0.5 { 0.0 } else { mean_information::cell::entropy(p) }
            };
            let mut all: Vec<_> = (0..grid.height()).flat_map(|row| (0..width).map(move |column| [row, column])).collect();
            all.retain(|&[row, column]| doubt(row, column) > 0.0);
            // Stable: of equal ones the first stays first.
            all.sort_by(|a, b| doubt(b[0], b[1]).total_cmp(&doubt(a[0], a[1])));
            let worst = Worst::of(&grid, most, side);
            prop_assert_eq!(&worst.cells[..], &all[..most.min(all.len())]);
            let equal = all.iter().filter(|place| doubt(place[0], place[1]) == doubt(all[0][0], all[0][1])).count();
            prop_assert_eq!(worst.equal, equal as u64);

            let (across, up) = (side.min(width), side.min(grid.height()));
            let sum = |row: usize, column: usize| -> f64 {
                (row..row + up).flat_map(|row| (column..column + across).map(move |column| doubt(row, column))).sum()
            };
            let sums = (0..=grid.height() - up).flat_map(|row| (0..=width - across).map(move |column| sum(row, column)));
            let largest = sums.fold(0.0, f64::max);
            match worst.square {
                None => prop_assert_eq!(largest, 0.0),
                Some(square) => {
                    let cells = (across * up) as f64;
                    prop_assert_eq!([square.columns.len(), square.rows.len()], [across, up]);
                    // The bound of the search, and the roundings of this test's own sums, each at most 2^-53 of a sum.
                    let apart = cells / UNITS + cells * cells * f64::EPSILON;
                    prop_assert!((square.entropy.widen() - largest).abs() <= apart, "{} {largest}", square.entropy);
                    prop_assert!((sum(square.rows.start, square.columns.start) - largest).abs() <= apart);
                }
            }
        }
    }

    /// All cells at 1 bit, which the largest entropies are rounded to; sums that overflow panic.
    #[test]
    fn the_largest_square_of_doubt_has_a_sum() {
        let bit = units(1.0);
        let mut squares = Squares::new([MAX_SIDE + 1, usize::MAX], usize::MAX);
        assert_eq!([squares.width, squares.height], [MAX_SIDE; 2]);
        squares.sums.fill(MAX_SIDE as u64 * bit);
        squares.sums[0] = 0;
        squares.compare(7);
        assert_eq!(squares.best, Some(((MAX_SIDE * MAX_SIDE) as u64 * bit, [7, 1])));
        // One more does not fit.
        assert_eq!((MAX_SIDE as u64 + 1).pow(2).checked_mul(bit), None);
    }

    #[test]
    fn nothing_in_doubt_has_no_worst() {
        for cells in [vec![0, 100, -1, 0], vec![-1; 4]] {
            assert_eq!(Worst::of(&percent(2, cells), 3, 2), Worst { cells: vec![], equal: 0, square: None });
        }
        let none = Grid::<Percent>::new(0, 0, Geometry::new(1.0, [0.0; 2]).unwrap(), vec![]).unwrap();
        assert_eq!(Worst::of(&none, 3, 2).square, None);
        // Doubt below a unit is found as a cell, and is no square.
        let faint =
            Grid::<LogOdds<f64>>::new(1, 1, Geometry::new(1.0, [0.0; 2]).unwrap(), vec![-60.0]).unwrap();
        let worst = Worst::of(&faint, 3, 2);
        assert_eq!((worst.cells, worst.square), (vec![[0, 0]], None));
    }
}
