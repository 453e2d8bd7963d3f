//! The heat map: the information of every cell of a map, unknown cells apart.

use super::cell_cache::CellCache;
use super::drawing::drawing_failure;
use super::map_picture::{Key, MapPicture, UNKNOWN, block};
use crate::failure::Failure;
use mean_information::Real;
use mean_information::cell::State;
use mean_information::map::{Encoding, Grid};
use mean_information_files::{Map, with_grid};

/// A map as squares of colour: the mean information of the observed cells of each.
#[derive(Debug)]
pub struct HeatMap(MapPicture);

impl HeatMap {
    /// Colours the cells of `map`.
    pub fn new(map: &Map) -> Self {
        with_grid!(&map.cells, grid => Self::of_grid(grid, map.resolution))
    }

    /// Colours the cells of a grid, whose side in metres is `None` if it is not known.
    pub fn of_grid<E: Encoding>(grid: &Grid<E>, resolution: Option<f64>) -> Self {
        let size = [grid.width(), grid.height()];
        let block = block(size);
        let mut cache = CellCache::new();
        let rows = (0..grid.height()).step_by(block);
        let squares = rows.flat_map(|first| row_of_squares(grid, &mut cache, first, block));
        let squares = squares.map(|bits| bits.map_or(UNKNOWN, colour)).collect();
        let ticks = [(0.0, "0"), (0.25, "0.25"), (0.5, "0.5"), (0.75, "0.75"), (1.0, "1")];
        let key = Key {
            title: "information (bits per cell)",
            gradient: colour,
            ticks: ticks.map(|(bits, text)| (bits, text.to_owned())).to_vec(),
            swatches: vec![("unknown", UNKNOWN)],
            reduction: "the mean of those observed",
        };
        Self(MapPicture::new(size, grid.geometry(), resolution, squares, key))
    }

    /// Draws the picture, under two lines of title.
    ///
    /// # Errors
    /// None is known, but for a map without cells.
    pub fn to_png(&self, titles: &[String; 2]) -> Result<Vec<u8>, Failure> {
        self.0.draw(titles)?.png().map_err(drawing_failure)
    }

    /// Returns the picture without its titles.
    pub(super) fn into_picture(self) -> MapPicture {
        self.0
    }
}

/// The row of squares that starts at row `first` of the grid.
fn row_of_squares<E: Encoding>(
    grid: &Grid<E>,
    cache: &mut CellCache<E>,
    first: usize,
    block: usize,
) -> Vec<Option<f64>> {
    let mut sums = vec![(0.0, 0_u32); grid.width().div_ceil(block)];
    for row in (first..first + block).filter_map(|row| grid.row(row)) {
        for ((sum, observed), cells) in sums.iter_mut().zip(row.chunks(block)) {
            let known =
                cells.iter().filter_map(|&stored| cache.cell(stored)).filter(|c| c.state() != State::Unknown);
            for cell in known {
                *sum += cell.information().widen();
                *observed += 1;
            }
        }
    }
    sums.into_iter().map(|(sum, observed)| (observed > 0).then(|| sum / f64::from(observed))).collect()
}

/// The colour of `bits` of information, in `0..=1`.
fn colour(bits: f64) -> [u8; 3] {
    colorous::VIRIDIS.eval_continuous(bits).into_array()
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
        // H(1/4) = 2 - (3/4) log2 3.
        let information = 0.75 * libm::log2(3.0) - 1.0;
        let squares = row_of_squares(&grid, &mut CellCache::new(), 0, 2);
        assert_eq!(squares.len(), 2);
        assert!(squares[0].is_some_and(|bits| (bits - f64::midpoint(1.0, information)).abs() < 1e-15));
        assert_eq!(squares[1], None);
        assert_eq!(row_of_squares(&grid, &mut CellCache::new(), 1, 3).len(), 1);
    }

    #[test]
    fn at_most_2000_pixels_a_side() {
        for (width, block, columns) in [(1999, 1, 1999), (2000, 1, 2000), (2001, 2, 1001), (6001, 4, 1501)] {
            let geometry = Geometry::new(0.2, [0.0; 2]).unwrap();
            let grid = Grid::<Probability<f32>>::new(width, 2, geometry, vec![0.25; 2 * width]).unwrap();
            let map = HeatMap::of_grid(&grid, None).into_picture();
            assert_eq!((map.block, map.columns, map.zoom), (block, columns, 1), "{width}");
        }
    }
}
