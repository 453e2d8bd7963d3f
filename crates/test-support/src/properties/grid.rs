//! Grids and their tallies.

use super::tally::check_tally;
use mean_information::map::encoding::{LogOdds, MrptLogOdds, Percent, Probability};
use mean_information::map::{Encoding, Geometry, Grid};
use mean_information::{Error, Real};

/// Checks grids of any size from any cells in every encoding. The bytes are the encoding, the columns, the rows that are claimed,
/// the side of a block, the place to split at, and the cells.
pub fn grid(bytes: &[u8]) {
    let [encoding, width, height, k, split, cells @ ..] = bytes else {
        return;
    };
    let shape = Shape {
        width: usize::from(*width),
        height: usize::from(*height),
        k: usize::from(*k),
        split: usize::from(*split),
    };
    match encoding % 6 {
        0 => shape.check::<Percent, 1>(cells, i8::from_le_bytes),
        1 => shape.check::<MrptLogOdds, 1>(cells, i8::from_le_bytes),
        2 => shape.check::<Probability<f32>, 4>(cells, f32::from_le_bytes),
        3 => shape.check::<Probability<f64>, 8>(cells, f64::from_le_bytes),
        4 => shape.check::<LogOdds<f32>, 4>(cells, f32::from_le_bytes),
        _ => shape.check::<LogOdds<f64>, 8>(cells, f64::from_le_bytes),
    }
}

struct Shape {
    width: usize,
    height: usize,
    k: usize,
    split: usize,
}

impl Shape {
    fn check<E: Encoding, const N: usize>(&self, bytes: &[u8], stored: fn([u8; N]) -> E::Stored) {
        let cells: Vec<E::Stored> = bytes.as_chunks().0.iter().map(|&bytes| stored(bytes)).collect();
        let geometry = Geometry::new(0.05, [-3.5, 2.25]).expect("a good geometry");
        let claimed = Grid::<E>::new(self.width, self.height, geometry, cells.clone());
        if self.width * self.height != cells.len() {
            assert!(matches!(claimed, Err(Error::CellCount { .. })));
        }

        let height = cells.len().checked_div(self.width).unwrap_or(0);
        let cells = &cells[..self.width * height];
        let first_bad = cells.iter().position(|&stored| E::cell(stored).is_none());
        let grid = match (Grid::<E>::new(self.width, height, geometry, cells.to_vec()), first_bad) {
            (Ok(grid), None) => grid,
            (Err(Error::Cell { row, column, .. }), Some(bad)) => {
                assert_eq!(row * self.width + column, bad);
                return;
            }
            (other, bad) => panic!("{other:?}, the first bad cell being {bad:?}"),
        };
        check_tally(&grid);
        let split = self.split.min(cells.len());
        check_parts(&grid, split);
        if self.k > 0 {
            check_pooling(&grid, self.k);
        }
    }
}

/// Splitting and merging, another order, and unknown cells around the map change no bit.
fn check_parts<E: Encoding>(grid: &Grid<E>, split: usize) {
    let tally = grid.tally();
    let (low, high) = grid.cells().split_at(split);
    let mut merged = E::tally(high);
    merged.merge(&E::tally(low));
    assert_eq!(merged, tally);
    let backwards: Vec<_> = grid.cells().iter().rev().copied().collect();
    assert_eq!(E::tally(&backwards), tally);
    let mut padded = backwards;
    padded.resize(padded.len() + split + 1, E::unknown());
    let padded = E::tally(&padded);
    assert_eq!(padded.mean_information(), tally.mean_information());
    assert_eq!(padded.observed(), tally.observed());
}

/// A block has at most the mean information of its cells (Jensen), up to the rounding of occupancies. That of `p` is at
/// most half an ulp, and `p` times the slope of `I`, `log2(p / (1 - p))`, is below 64 wherever a float is not 0 or 1;
/// so 64 epsilons also cover the rounding of `I` itself.
fn check_pooling<E: Encoding>(grid: &Grid<E>, k: usize) {
    let coarse = grid.pooled(k).expect("a block of cells");
    assert_eq!([coarse.width(), coarse.height()], [grid.width(), grid.height()].map(|side| side.div_ceil(k)));
    let bound = 64.0 * f64::from_parts(1, 1 - E::Float::PRECISION as i32);
    for row in 0..coarse.height() {
        for column in 0..coarse.width() {
            let rows = row * k..((row + 1) * k).min(grid.height());
            let columns = column * k..((column + 1) * k).min(grid.width());
            let block: Vec<E::Stored> = rows
                .filter_map(|row| grid.row(row))
                .flat_map(|cells| cells[columns.clone()].iter().copied())
                .collect();
            let fine: f64 = block
                .iter()
                .filter_map(|&stored| E::cell(stored))
                .map(|cell| cell.information().widen())
                .sum();
            let pooled = coarse.row(row).expect("a row")[column];
            let pooled = Probability::<E::Float>::cell(pooled).expect("a probability").information().widen();
            // What lies beyond the edge is unknown, and adds nothing.
            let mean = fine / (k * k) as f64;
            assert!(pooled <= mean + bound, "{pooled} above {mean} in block {row}, {column} of {block:?}");
        }
    }
}
