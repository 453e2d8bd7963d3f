//! The heat map: the information of every cell of a map, unknown cells apart.

use super::drawing::drawing_failure;
use super::map_picture::{Key, MapPicture, block};
use crate::failure::Failure;
use mean_information::map::{Encoding, Grid};
use mean_information_files::{Map, with_grid};
use mean_information_report::squares::{UNKNOWN, colour, squares};

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
        let squares = squares(grid, 0..size[0], 0..size[1], block);
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

#[cfg(test)]
mod tests {
    use super::*;
    use mean_information::map::Geometry;
    use mean_information::map::encoding::Probability;

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
