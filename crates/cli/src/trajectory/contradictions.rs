//! Where the scans of one trajectory contradict one another most, and which two of them do.

use super::setup::Setup;
use crate::output::Record;
use mean_information::Error;
use mean_information::scan::{Beam, Layer, Pose, Scan, ScanMap, blocks};
use mean_information_files::scans::RangeScan;

/// The side of a place, in metres; at least two cells.
const SIDE: f64 = 1.0;
/// The most places that are named.
const PLACES: usize = 3;

/// A place where scans contradict one another, and the two of them that do most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contradiction {
    /// The times of the two scans, in seconds after the first scan of all.
    pub times: [f64; 2],
    /// The middle of the contradiction, in metres.
    pub place: [f64; 2],
    /// The part of the contradiction of the whole map that lies in the square of a metre there, from 0 to 1.
    pub share: f64,
}

impl Contradiction {
    /// Says in words which scans contradict one another, and where.
    pub(super) fn in_words(&self) -> String {
        let Self { times: [first, second], place: [x, y], share } = self;
        format!(
            "scans at {first:.1} s and {second:.1} s after the first contradict each other at x {x:.1} m, y {y:.1} m: within a \
             metre there is {:.0} % of the contradiction of all scans",
            100.0 * share
        )
    }

    /// Returns the values of JSON.
    pub(super) fn record(&self) -> Record {
        let [[first, second], [x, y]] = [self.times, self.place];
        Record::computed([
            ("first_s", first),
            ("second_s", second),
            ("x_m", x),
            ("y_m", y),
            ("share", self.share),
        ])
    }
}

/// Finds the places, at most three, that have most of the contradiction of a map, and of each the two scans, of different ones
/// of `parts` equal parts of the log, that say the most against what the other part says there.
///
/// # Errors
/// Never for scans that a map was made of.
pub(super) fn contradictions(
    setup: &Setup,
    records: &[&RangeScan],
    poses: &[Pose],
    layer: &Layer<f64>,
    parts: usize,
) -> Result<Vec<Contradiction>, Error> {
    let whole: f64 = layer.cells().iter().sum();
    let blocks: Vec<_> = blocks(records.len(), parts).collect();
    let mut found = Vec::new();
    for place in Tiles::of(layer).places() {
        let told = |scan: usize| match setup.scan(records[scan], poses[scan])? {
            Some(beams) => place.told(setup, &beams),
            None => Ok(None),
        };
        let mut sums = Vec::with_capacity(blocks.len());
        for block in &blocks {
            let mut sum = vec![0.0; place.cells()];
            for scan in block.clone() {
                let told = told(scan)?.unwrap_or_default();
                sum.iter_mut().zip(told).for_each(|(sum, nats)| *sum += nats);
            }
            sums.push(sum);
        }
        let Some([first, second]) = opponents(&sums) else { continue };
        // The scan of one part that says most against the other part; of equal ones the first.
        let against = |own: usize, other: usize| {
            let mut most = (0.0, blocks[own].start);
            for scan in blocks[own].clone() {
                let nats = contradiction(&told(scan)?.unwrap_or_default(), &sums[other]);
                if nats > most.0 {
                    most = (nats, scan);
                }
            }
            Ok::<_, Error>(most.1)
        };
        let scans = [against(first, second)?, against(second, first)?];
        let times = scans.map(|scan| records[scan].time() - records[0].time());
        // Both are rounded sums, in other orders: of all that there is a part may be above the whole.
        let share = (place.nats / whole).min(1.0);
        found.push(Contradiction { times, place: place.middle, share });
    }
    Ok(found)
}

/// Finds the two parts of the log that contradict most by what they tell the cells of a place; `None` if none do.
fn opponents(sums: &[Vec<f64>]) -> Option<[usize; 2]> {
    let mut most = (0.0, None);
    for (k, later) in sums.iter().enumerate() {
        for (j, earlier) in sums[..k].iter().enumerate() {
            let nats = contradiction(earlier, later);
            if nats > most.0 {
                most = (nats, Some([j, k]));
            }
        }
    }
    most.1
}

/// Adds up what cancels of two tellings of the same cells: twice the lesser where their signs differ, in nats.
fn contradiction(one: &[f64], other: &[f64]) -> f64 {
    let cancels = |(&a, &b): (&f64, &f64)| if a * b < 0.0 { 2.0 * a.abs().min(b.abs()) } else { 0.0 };
    one.iter().zip(other).map(cancels).sum()
}

/// The contradictions of a map, added up in squares of half the side of a place.
struct Tiles<'a> {
    layer: &'a Layer<f64>,
    /// The cells of a tile's side.
    side: usize,
    columns: usize,
    nats: Vec<f64>,
}

impl<'a> Tiles<'a> {
    fn of(layer: &'a Layer<f64>) -> Self {
        let side = (SIDE / layer.geometry().resolution() / 2.0).round().max(1.0) as usize;
        let columns = layer.width().div_ceil(side);
        let mut nats = vec![0.0; columns * layer.height().div_ceil(side)];
        for (row, cells) in layer.cells().chunks(layer.width().max(1)).enumerate() {
            for (column, cell) in cells.iter().enumerate() {
                nats[row / side * columns + column / side] += cell;
            }
        }
        Self { layer, side, columns, nats }
    }

    /// Chooses the places with the most contradiction, each of two by two tiles, none of which another has.
    fn places(mut self) -> Vec<Place> {
        let mut places = Vec::new();
        for _ in 0..PLACES {
            let square = |first: usize| {
                let has_right = first % self.columns + 1 < self.columns;
                let right = |tile: usize| has_right.then_some(tile + 1);
                let above = Some(first + self.columns).filter(|&tile| tile < self.nats.len());
                [Some(first), right(first), above, above.and_then(right)].into_iter().flatten()
            };
            let sum = |first: usize| square(first).map(|tile| self.nats[tile]).sum::<f64>();
            let most =
                (0..self.nats.len()).map(|first| (first, sum(first))).max_by(|a, b| a.1.total_cmp(&b.1));
            let Some((first, nats)) = most.filter(|&(_, nats)| nats > 0.0) else { break };
            places.push(self.place(first, nats));
            let tiles: Vec<_> = square(first).collect();
            for tile in tiles {
                self.nats[tile] = 0.0;
            }
        }
        places
    }

    /// Returns the place whose lowest and leftmost tile this is.
    fn place(&self, first: usize, nats: f64) -> Place {
        let layer = self.layer;
        let low = [first % self.columns * self.side, first / self.columns * self.side];
        let size = [layer.width() - low[0], layer.height() - low[1]].map(|left| left.min(2 * self.side));
        let geometry = layer.geometry();
        let (side, origin) = (geometry.resolution(), geometry.origin());
        let mut sums = [0.0; 3];
        for row in low[1]..low[1] + size[1] {
            for column in low[0]..low[0] + size[0] {
                let cell = layer.cells()[row * layer.width() + column];
                for (sum, weight) in sums.iter_mut().zip([1.0, column as f64 + 0.5, row as f64 + 0.5]) {
                    *sum += weight * cell;
                }
            }
        }
        let middle = [0, 1].map(|axis: usize| origin[axis] + side * sums[axis + 1] / sums[0]);
        let corner = [0, 1].map(|axis: usize| origin[axis] + side * low[axis] as f64);
        Place { corner, size, side, middle, nats }
    }
}

/// A rectangle of cells of a map.
struct Place {
    /// The lower left corner, in metres.
    corner: [f64; 2],
    /// The numbers of columns and rows.
    size: [usize; 2],
    /// The side of a cell, in metres.
    side: f64,
    /// The middle of the contradiction, in metres.
    middle: [f64; 2],
    /// The contradiction of its cells, in nats.
    nats: f64,
}

impl Place {
    /// Counts the cells.
    fn cells(&self) -> usize {
        self.size[0] * self.size[1]
    }

    /// Finds what a scan tells the cells of the place, in nats, row by row; `None` if it touches none.
    fn told(&self, setup: &Setup, scan: &Scan<f64>) -> Result<Option<Vec<f64>>, Error> {
        let beams: Vec<_> = scan.beams().iter().copied().filter(|beam| self.is_near(scan, beam)).collect();
        if beams.is_empty() {
            return Ok(None);
        }
        let near = Scan::new(*scan.pose(), scan.maximum_range(), beams)?;
        let map = ScanMap::new(setup.resolution)?.with_reading_limit(setup.reading_limit)?;
        let mut map = map.with_max_cells(setup.max_cells);
        map.insert(&near, |range| setup.sensor.of_range(range))?;
        let grid = map.log_odds()?;
        let origin = grid.geometry().origin();
        // Corners of cells of one resolution: whole cells apart.
        let apart = [0, 1].map(|axis: usize| ((self.corner[axis] - origin[axis]) / self.side).round() as i64);
        let mut cells = vec![0.0; self.cells()];
        for (row, cells) in cells.chunks_mut(self.size[0]).enumerate() {
            let row = usize::try_from(apart[1] + row as i64).ok().and_then(|row| grid.row(row));
            for (column, cell) in cells.iter_mut().enumerate() {
                let column = usize::try_from(apart[0] + column as i64).ok();
                *cell = row.zip(column).and_then(|(row, column)| row.get(column)).copied().unwrap_or(0.0);
            }
        }
        Ok(cells.iter().any(|&nats| nats != 0.0).then_some(cells))
    }

    /// Tells whether a beam may cross the place: all that do are, and some beside it.
    fn is_near(&self, scan: &Scan<f64>, beam: &Beam<f64>) -> bool {
        let pose = scan.pose();
        let half = [0, 1].map(|axis: usize| self.side * self.size[axis] as f64 / 2.0);
        let [x, y] = [0, 1].map(|axis: usize| self.corner[axis] + half[axis] - pose.position()[axis]);
        // The lattice of the map moves a beam by less than a cell.
        let reach = libm::hypot(half[0], half[1]) + 2.0 * self.side;
        let (sin, cos) = libm::sincos(pose.theta() + beam.bearing);
        let (along, across) = (cos * x + sin * y, cos * y - sin * x);
        across.abs() <= reach && along >= -reach
    }
}
