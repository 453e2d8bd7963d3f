//! The conflict map: where the scans of a map contradict one another, over a faint picture of the map.

use super::map_picture::{Key, MapPicture, block};
use super::panels::{MapPanel, colour as map_colour};
use super::scale::ticks;
use super::timed_path::{TimedPath, colour as path_colour};
use crate::failure::Failure;
use mean_information::Real;
use mean_information::map::encoding::LogOdds;
use mean_information::map::{Encoding, Grid};
use mean_information::scan::Layer;

/// The part of the contradictions that have colours of their own; the greatest of all would leave the others pale.
const WITHIN: f64 = 0.99;
/// The part of its darkness that an occupied cell keeps beside the colours.
const FAINT: f64 = 0.35;

/// The contradictions of the scans of a map, as squares of colour.
#[derive(Debug)]
pub struct ConflictMap {
    size: [usize; 2],
    squares: Vec<[u8; 3]>,
    /// The contradiction of the darkest colour, in nats.
    top: f64,
    geometry: mean_information::map::Geometry,
    path: TimedPath,
}

/// Returns a scale for the contradictions of several maps, in nats: 99 % of those above 0 are within it.
pub fn conflict_scale<'a>(layers: impl IntoIterator<Item = &'a Layer<f64>>) -> f64 {
    let cells = layers.into_iter().flat_map(Layer::cells).copied();
    let mut above: Vec<_> = cells.filter(|&nats| nats > 0.0).collect();
    let place = (WITHIN * above.len() as f64) as usize;
    let place = place.min(above.len().saturating_sub(1));
    if above.is_empty() { 1.0 } else { *above.select_nth_unstable_by(place, f64::total_cmp).1 }
}

impl ConflictMap {
    /// Colours the cells of a map on the scale of [`conflict_scale`]; `path` is that of the laser.
    pub fn new(grid: &Grid<LogOdds<f64>>, layer: &Layer<f64>, top: f64, path: TimedPath) -> Self {
        let size = [grid.width(), grid.height()];
        let block = block(size);
        let columns = size[0].div_ceil(block);
        let mut squares = Vec::with_capacity(columns * size[1].div_ceil(block));
        for first in (0..size[1]).step_by(block) {
            for left in (0..size[0]).step_by(block) {
                let columns = left..(left + block).min(size[0]);
                let rows = first..(first + block).min(size[1]);
                let cells = rows.flat_map(|row| columns.clone().map(move |column| row * size[0] + column));
                let mut greatest = 0.0_f64;
                let mut ground = None;
                for cell in cells {
                    greatest = greatest.max(layer.cells().get(cell).copied().unwrap_or(0.0));
                    let occupancy = grid.cells().get(cell).and_then(|&stored| LogOdds::occupancy(stored));
                    let occupancy: Option<f64> = occupancy.map(Real::widen).filter(|&p| p != 0.5);
                    // Of several cells the most occupied: walls are thin.
                    ground = [ground, occupancy].into_iter().flatten().reduce(f64::max);
                }
                squares.push(if greatest > 0.0 { colour(greatest / top) } else { faint(ground) });
            }
        }
        Self { size, squares, top, geometry: *grid.geometry(), path }
    }

    /// Returns the picture without its titles.
    pub(super) fn picture(&self) -> MapPicture {
        let key = Key {
            title: "contradiction (nats per cell)",
            gradient: colour,
            ticks: ticks(0.0, self.top, 5).into_iter().map(|(nats, text)| (nats / self.top, text)).collect(),
            swatches: vec![
                ("none", faint(Some(0.0))),
                ("unknown", faint(None)),
                ("path: first", path_colour(0.0)),
                ("path: last", path_colour(1.0)),
            ],
            reduction: "the greatest of them",
        };
        let resolution = Some(self.geometry.resolution());
        let picture = MapPicture::new(self.size, &self.geometry, resolution, self.squares.clone(), key);
        picture.with_path(self.path.clone())
    }

    /// Returns the panel of a page.
    ///
    /// # Errors
    /// None is known, but for a map without cells.
    pub fn panel(&self, title: &str, text: String) -> Result<MapPanel, Failure> {
        let panel = MapPanel::of_squares(self.size, &self.geometry, &self.squares, title, text)?;
        Ok(panel.with_path(self.path.clone()))
    }
}

/// Returns the colour of a contradiction, as a part of the scale.
fn colour(part: f64) -> [u8; 3] {
    // From a yellow that is seen on white.
    colorous::YELLOW_ORANGE_RED.eval_continuous(0.2 + 0.8 * part.clamp(0.0, 1.0)).into_array()
}

/// Returns the colour of a cell without contradiction.
fn faint(occupancy: Option<f64>) -> [u8; 3] {
    match occupancy {
        Some(_) => map_colour(occupancy).map(|grey| 255 - (FAINT * f64::from(255 - grey)).round() as u8),
        None => map_colour(None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mean_information::scan::{Beam, Pose, Scan, ScanMap};
    use mean_information::sensor::SteppedSensor;

    /// Two scans along a row of cells, of which the second sees through the wall of the first.
    #[test]
    fn contradictions_have_colours_and_the_rest_is_faint() {
        let mut map = ScanMap::<f64>::new(0.25).unwrap().with_agreement().unwrap();
        for range in [0.5, 1.0] {
            let beam = Beam { bearing: 0.0, range: Some(range) };
            let scan = Scan::new(Pose::new(0.13, 0.12, 0.0).unwrap(), 4.0, vec![beam]).unwrap();
            map.insert(&scan, |range| SteppedSensor::new(range, 0.25, 0.25, 0.875)).unwrap();
        }
        let (grid, layer) = (map.log_odds().unwrap(), map.contradictions().unwrap().unwrap());
        let top = conflict_scale([&layer]);
        assert_eq!(top, 2.0 * 1.0986122886681098); // 2 ln 3
        let map = ConflictMap::new(&grid, &layer, top, TimedPath::new(vec![(0.0, [0.13, 0.12])]));
        let free = faint(grid.cells().first().and_then(|&l| LogOdds::occupancy(l)));
        assert_eq!(map.squares[0], free);
        assert_eq!(map.squares[2], colour(1.0));
        assert!(map.squares.iter().filter(|&&square| square == colour(1.0)).count() == 1);
        assert_eq!(conflict_scale([]), 1.0);
    }
}
