//! The properties that fuzzing tries to break: each takes any bytes and panics if one does not hold.
//!
//! `cargo test` replays the committed seeds on them, on stable.

mod builders;
mod integral;
mod room;

pub use builders::{expected, scan};
pub use integral::integrate;
pub use room::room;

use mean_information::map::encoding::{LogOdds, MrptLogOdds, Percent, Probability};
use mean_information::map::{Encoding, Geometry, Grid};
use mean_information::{Error, Real, Tally};
use mean_information_cli::maps::ros::{Description, read_image};
use mean_information_cli::maps::{
    ArrayEncoding, Cells, Fault, Map, Mode, Options, Readable, Semantics, gridmap, npy,
};
use std::io::Cursor;

/// Small, so that a claim is soon above it.
const MAX_CELLS: u64 = 1 << 16;

/// A description of a map is read or refused; what is read can be meant.
pub fn yaml(bytes: &[u8]) {
    for semantics in [Semantics::Nav2, Semantics::Ros1] {
        let Some(read) = kept(Description::read(bytes, semantics)) else {
            continue;
        };
        assert!(!read.image.is_empty());
        assert!(read.resolution > 0.0 && read.resolution.is_finite());
        assert!(read.origin.iter().all(|x| x.is_finite()));
        assert!(read.free_thresh < read.occupied_thresh);
    }
}

/// An image is read or refused under every loader and mode.
pub fn pgm(bytes: &[u8]) {
    image(bytes);
}

/// An image is read or refused under every loader and mode.
pub fn png(bytes: &[u8]) {
    image(bytes);
}

fn image(bytes: &[u8]) {
    let sizes = [Mode::Trinary, Mode::Scale, Mode::Raw, Mode::Probability].map(|mode| {
        [(Semantics::Nav2, false), (Semantics::Ros1, true)].map(|(semantics, negate)| {
            let description = Description {
                image: "image".to_owned(),
                resolution: 0.05,
                origin: [-3.5, 2.25, 0.125],
                negate,
                occupied_thresh: 0.65,
                free_thresh: 0.25,
                mode,
            };
            let options =
                Options { semantics, max_cells: Some(MAX_CELLS), unknown: Some(1), ..Options::default() };
            kept(read_image(Cursor::new(bytes), &description, &options)).map(|map| checked(&map))
        })
    });
    let first = sizes[0][0];
    assert!(sizes.iter().flatten().all(|&size| size == first), "{sizes:?}");
}

/// An array is read or refused in every encoding.
pub fn npy(bytes: &[u8]) {
    for encoding in [
        None,
        Some(ArrayEncoding::Probability),
        Some(ArrayEncoding::Percent),
        Some(ArrayEncoding::LogOdds),
        Some(ArrayEncoding::Mrpt),
    ] {
        let options = Options { encoding, max_cells: Some(MAX_CELLS), ..Options::default() };
        if let Some(map) = kept(npy::read(bytes, bytes.len() as u64, &options)) {
            checked(&map);
        }
    }
}

/// An array is read as a stack of particles' maps, and as weights, or refused.
pub fn stack(bytes: &[u8]) {
    for encoding in [None, Some(ArrayEncoding::LogOdds), Some(ArrayEncoding::Mrpt)] {
        let options = Options { encoding, max_cells: Some(MAX_CELLS), ..Options::default() };
        kept(npy::read_stack(bytes, bytes.len() as u64, &options, Checked));
    }
    let options = Options { max_cells: Some(MAX_CELLS), ..Options::default() };
    if let Some(weights) = kept(npy::read_weights(bytes, bytes.len() as u64, &options)) {
        assert!(weights.len() as u64 <= MAX_CELLS);
    }
}

/// Checks the maps of a stack.
struct Checked;

impl npy::WithMaps for Checked {
    type Output = ();

    fn with<E: Readable>(self, maps: Vec<Grid<E>>) {
        let cells: usize = maps.iter().map(|map| map.cells().len()).sum();
        assert!(!maps.is_empty() && cells as u64 <= MAX_CELLS);
        let size = [maps[0].width(), maps[0].height()];
        for map in maps {
            assert_eq!(checked_grid(&map), size);
        }
    }
}

/// A grid map is read or refused, plain and zipped.
pub fn gridmap(bytes: &[u8]) {
    let options = Options { max_cells: Some(MAX_CELLS), ..Options::default() };
    if let Some(map) = kept(gridmap::read(bytes, &options)) {
        checked(&map);
    }
}

/// What was read, or nothing if it was refused, in words.
fn kept<T>(read: Result<T, Fault>) -> Option<T> {
    read.inspect_err(|fault| assert!(!fault.to_string().is_empty())).ok()
}

/// The size of a map that keeps its promises.
fn checked(map: &Map) -> [usize; 2] {
    match &map.cells {
        Cells::Percent(grid) => checked_grid(grid),
        Cells::Mrpt(grid) => checked_grid(grid),
        Cells::Probability32(grid) => checked_grid(grid),
        Cells::Probability64(grid) => checked_grid(grid),
        Cells::LogOdds32(grid) => checked_grid(grid),
        Cells::LogOdds64(grid) => checked_grid(grid),
    }
}

fn checked_grid<E: Encoding>(grid: &Grid<E>) -> [usize; 2] {
    assert!(grid.cells().len() as u64 <= MAX_CELLS);
    check_tally(grid);
    [grid.width(), grid.height()]
}

/// Grids of any size from any cells in every encoding. The bytes are the encoding, the columns, the rows that are claimed,
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

/// Every cell is counted once, and the mean is in [0, 1]; the sums are those of the cells.
fn check_tally<E: Encoding>(grid: &Grid<E>) {
    let tally = grid.tally();
    assert_eq!(tally.observed() + tally.unknown(), (grid.width() * grid.height()) as u64);
    assert_eq!(tally.free() + tally.occupied(), tally.observed());
    let mean = tally.mean_information().widen();
    assert!((0.0..=1.0).contains(&mean), "{mean}");
    assert!(tally.observed() > 0 || mean == 0.0);
    let one_by_one: Tally<E::Float> = grid.cells().iter().filter_map(|&stored| E::cell(stored)).collect();
    assert_eq!(tally, one_by_one);
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
