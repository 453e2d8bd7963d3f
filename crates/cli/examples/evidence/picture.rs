//! The three numbers of Filatov et al., *2D SLAM quality evaluation methods* (FRUCT 2017), of a thresholded map: the share of
//! occupied cells, the number of corners, the number of enclosed areas. The less of each, the better the map, they say. They
//! leave thresholds open; those here are stated with each.

use mean_information::map::Grid;
use mean_information::map::encoding::LogOdds;

/// Harris's factor of the squared trace.
const HARRIS: f64 = 0.04;
/// The part of the greatest response from which on a cell can be a corner.
const CORNER: f64 = 0.1;
/// The least area that counts, in square metres: less is a hole in a wall.
const AREA: f64 = 0.25;

/// The numbers of a map.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Picture {
    /// Occupied cells per free cell.
    pub(crate) occupied_share: f64,
    /// Corners of occupied cells: greatest responses of Harris's detector among their eight neighbours.
    pub(crate) corners: usize,
    /// Areas of free or unknown cells, connected by their sides, that occupied cells enclose.
    pub(crate) enclosed_areas: usize,
}

/// Cells with 1 where they are occupied, with a margin of two cells round the map.
struct Binary {
    width: usize,
    cells: Vec<f64>,
}

impl Picture {
    /// Measures a map.
    pub(crate) fn new(grid: &Grid<LogOdds<f64>>) -> Self {
        let count = |is: fn(&f64) -> bool| grid.cells().iter().filter(|&l| is(l)).count() as f64;
        let binary = Binary::new(grid);
        let side = grid.geometry().resolution();
        Self {
            occupied_share: count(|&l| l > 0.0) / count(|&l| l < 0.0),
            corners: binary.corners(),
            enclosed_areas: binary.enclosed_areas((AREA / (side * side)) as usize),
        }
    }
}

impl Binary {
    fn new(grid: &Grid<LogOdds<f64>>) -> Self {
        let width = grid.width() + 4;
        let mut cells = vec![0.0; width * (grid.height() + 4)];
        for (row, line) in cells.chunks_mut(width).skip(2).take(grid.height()).enumerate() {
            for (cell, &l) in line[2..].iter_mut().zip(grid.row(row).unwrap_or_default()) {
                *cell = f64::from(u8::from(l > 0.0));
            }
        }
        Self { width, cells }
    }

    /// The cells that have all neighbours within so many cells.
    fn inner(&self, margin: usize) -> impl Iterator<Item = usize> {
        let (width, height) = (self.width, self.cells.len() / self.width);
        (margin..height - margin).flat_map(move |row| (margin..width - margin).map(move |x| row * width + x))
    }

    /// The nine cells round a cell, and itself.
    fn around(&self, at: usize) -> impl Iterator<Item = usize> {
        let width = self.width;
        (0..3).flat_map(move |row| (0..3).map(move |x| at + row * width + x - width - 1))
    }

    /// Counts the corners: Sobel's gradients, their products summed up over 3 by 3 cells, responses `det - 0.04 trace²` from a
    /// tenth of the greatest one on that no neighbour exceeds.
    fn corners(&self) -> usize {
        let mut products = vec![[0.0; 3]; self.cells.len()];
        for at in self.inner(1) {
            let [across, up] = [(1, self.width), (self.width, 1)].map(|(along, aside)| {
                let side = |at: usize| self.cells[at - aside] + 2.0 * self.cells[at] + self.cells[at + aside];
                side(at + along) - side(at - along)
            });
            products[at] = [across * across, across * up, up * up];
        }
        let mut responses = vec![0.0; self.cells.len()];
        for at in self.inner(1) {
            let sum = |k: usize| self.around(at).map(|cell| products[cell][k]).sum::<f64>();
            let [xx, xy, yy] = [sum(0), sum(1), sum(2)];
            responses[at] = xx * yy - xy * xy - HARRIS * (xx + yy) * (xx + yy);
        }
        let least = CORNER * responses.iter().copied().fold(0.0, f64::max);
        let is_corner = |&at: &usize| {
            let own = responses[at];
            // Of equal neighbours the first counts.
            let first = |cell: usize| responses[cell] < own || responses[cell] == own && cell >= at;
            own > 0.0 && own >= least && self.around(at).all(first)
        };
        self.inner(1).filter(is_corner).count()
    }

    /// Counts the areas without occupied cells of at least so many cells, without the one outside.
    fn enclosed_areas(&self, least: usize) -> usize {
        let mut reached: Vec<bool> = self.cells.iter().map(|&cell| cell > 0.0).collect();
        let (mut areas, mut waiting) = (0, Vec::new());
        for start in 0..reached.len() {
            if reached[start] {
                continue;
            }
            reached[start] = true;
            waiting.push(start);
            let mut size = 0;
            while let Some(at) = waiting.pop() {
                size += 1;
                let column = at % self.width;
                let neighbours = [
                    at.checked_sub(self.width),
                    Some(at + self.width),
                    (column > 0).then(|| at - 1),
                    (column + 1 < self.width).then_some(at + 1),
                ];
                for next in neighbours.into_iter().flatten() {
                    if let Some(is_reached @ false) = reached.get_mut(next) {
                        *is_reached = true;
                        waiting.push(next);
                    }
                }
            }
            areas += usize::from(size >= least);
        }
        areas - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mean_information::map::Geometry;

    /// Two rooms with walls one cell thick, one of them open: 14 by 9 cells of half a metre.
    #[test]
    fn of_rooms() {
        let plan = [
            "..............",
            ".#####..#####.",
            ".#...#..#...#.",
            ".#...#..#...#.",
            ".#...#......#.",
            ".#...#..#...#.",
            ".#...#..#...#.",
            ".#####..#####.",
            "..............",
        ];
        let cells: Vec<f64> = plan
            .iter()
            .flat_map(|row| row.bytes())
            .map(|cell| if cell == b'#' { 0.75 } else { -0.5 })
            .collect();
        let grid = Grid::new(14, 9, Geometry::new(0.5, [0.25, -3.0]).unwrap(), cells).unwrap();
        let picture = Picture::new(&grid);
        assert_eq!(picture.enclosed_areas, 1);
        assert_eq!(picture.occupied_share, 39.0 / 87.0);
        // The corners of the rooms, at least; ends of the walls at the opening, too.
        assert!((8..=12).contains(&picture.corners), "{picture:?}");
    }
}
