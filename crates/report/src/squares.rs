//! The information of squares of cells, and the colours that show it.

use crate::cell_cache::CellCache;
use mean_information::Real;
use mean_information::cell::State;
use mean_information::map::{Encoding, Grid};
use std::ops::Range;

/// The colour of squares of which nothing is observed. No colour of the scale is grey.
pub const UNKNOWN: [u8; 3] = [190, 190, 190];

/// Returns the colour of `bits` of information, in `0..=1`.
pub fn colour(bits: f64) -> [u8; 3] {
    colorous::VIRIDIS.eval_continuous(bits).into_array()
}

/// Returns the mean information of the observed cells of each square of `block` x `block` cells, `None` where none is
/// observed, to about an ulp a cell: row by row from the lowest, from the lower left corner of this part of the grid.
pub fn squares<E: Encoding>(
    grid: &Grid<E>,
    columns: Range<usize>,
    rows: Range<usize>,
    block: usize,
) -> impl Iterator<Item = Option<f64>> {
    let block = block.max(1);
    let mut cache = CellCache::new();
    let rows = rows.start..rows.end.min(grid.height());
    rows.clone().step_by(block).flat_map(move |first| {
        row_of_squares(grid, &mut cache, columns.clone(), first..rows.end.min(first + block), block)
    })
}

/// The squares of these rows.
fn row_of_squares<E: Encoding>(
    grid: &Grid<E>,
    cache: &mut CellCache<E>,
    columns: Range<usize>,
    rows: Range<usize>,
    block: usize,
) -> Vec<Option<f64>> {
    let columns = columns.start.min(grid.width())..columns.end.min(grid.width());
    let mut sums = vec![(0.0, 0_u64); columns.len().div_ceil(block)];
    for row in rows.filter_map(|row| grid.row(row)?.get(columns.clone())) {
        for ((sum, observed), cells) in sums.iter_mut().zip(row.chunks(block)) {
            let known =
                cells.iter().filter_map(|&stored| cache.cell(stored)).filter(|c| c.state() != State::Unknown);
            for cell in known {
                *sum += cell.information().widen();
                *observed += 1;
            }
        }
    }
    sums.into_iter().map(|(sum, observed)| (observed > 0).then(|| sum / observed as f64)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use mean_information::map::Geometry;
    use mean_information::map::encoding::Probability;

    #[test]
    fn a_square_is_the_mean_of_the_observed_cells_under_it() {
        let geometry = Geometry::new(0.2, [0.0; 2]).unwrap();
        let cells = vec![0.0, 0.5, 0.5, 0.25, 0.5, 0.5];
        let grid = Grid::<Probability<f64>>::new(3, 2, geometry, cells).unwrap();
        let squares = |columns, rows, block| squares(&grid, columns, rows, block).collect::<Vec<_>>();
        // H(1/4) = 2 - (3/4) log2 3.
        let information = 0.75 * libm::log2(3.0) - 1.0;
        let all = squares(0..3, 0..2, 2);
        assert_eq!(all.len(), 2);
        assert!(all[0].is_some_and(|bits| (bits - f64::midpoint(1.0, information)).abs() < 1e-15));
        assert_eq!(all[1], None);
        assert_eq!(squares(0..3, 1..2, 3).len(), 1);
        // A part, and what lies beyond the grid.
        assert_eq!(squares(0..1, 0..1, 1), [Some(1.0)]);
        assert_eq!(squares(2..9, 0..9, 1), [None, None]);
        assert_eq!(squares(7..9, 0..2, 1), []);
    }
}
