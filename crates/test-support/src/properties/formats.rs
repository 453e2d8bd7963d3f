//! Files: each is read or refused, and what is read keeps its promises.

use super::tally::check_tally;
use mean_information::map::{Encoding, Grid};
use mean_information_files::npy::MapsVisitor;
use mean_information_files::ros::{Description, read_image};
use mean_information_files::{
    ArrayEncoding, Error, Map, Mode, Options, Readable, Semantics, gridmap as mrpt, npy as arrays, with_grid,
};
use std::io::Cursor;

/// Small, so that a claim is soon above it.
const MAX_CELLS: u64 = 1 << 16;

/// Reads a description of a map: it is refused, or what is read can be meant.
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

/// Reads an image under every loader and mode.
pub fn pgm(bytes: &[u8]) {
    image(bytes);
}

/// Reads an image under every loader and mode.
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

/// Reads an array in every encoding.
pub fn npy(bytes: &[u8]) {
    for encoding in [
        None,
        Some(ArrayEncoding::Probability),
        Some(ArrayEncoding::Percent),
        Some(ArrayEncoding::LogOdds),
        Some(ArrayEncoding::Mrpt),
    ] {
        let options = Options { encoding, max_cells: Some(MAX_CELLS), ..Options::default() };
        if let Some(map) = kept(arrays::read(bytes, bytes.len() as u64, &options)) {
            checked(&map);
        }
    }
}

/// Reads an array as a stack of particles' maps, and as weights.
pub fn stack(bytes: &[u8]) {
    for encoding in [None, Some(ArrayEncoding::LogOdds), Some(ArrayEncoding::Mrpt)] {
        let options = Options { encoding, max_cells: Some(MAX_CELLS), ..Options::default() };
        kept(arrays::read_stack(bytes, bytes.len() as u64, &options, Checked));
    }
    let options = Options { max_cells: Some(MAX_CELLS), ..Options::default() };
    if let Some(weights) = kept(arrays::read_weights(bytes, bytes.len() as u64, &options)) {
        assert!(weights.len() as u64 <= MAX_CELLS);
    }
}

/// Checks the maps of a stack.
struct Checked;

impl MapsVisitor for Checked {
    type Output = ();

    fn visit<E: Readable>(self, maps: Vec<Grid<E>>) {
        let cells: usize = maps.iter().map(|map| map.cells().len()).sum();
        assert!(!maps.is_empty() && cells as u64 <= MAX_CELLS);
        let size = [maps[0].width(), maps[0].height()];
        for map in maps {
            assert_eq!(checked_grid(&map), size);
        }
    }
}

/// Reads a grid map, plain and zipped.
pub fn gridmap(bytes: &[u8]) {
    let options = Options { max_cells: Some(MAX_CELLS), ..Options::default() };
    if let Some(map) = kept(mrpt::read(bytes, &options)) {
        checked(&map);
    }
}

/// Returns what was read, or nothing if it was refused, in words.
fn kept<T>(read: Result<T, Error>) -> Option<T> {
    read.inspect_err(|fault| assert!(!fault.to_string().is_empty())).ok()
}

/// Returns the size of a map that keeps its promises.
fn checked(map: &Map) -> [usize; 2] {
    with_grid!(&map.cells, grid => checked_grid(grid))
}

fn checked_grid<E: Encoding>(grid: &Grid<E>) -> [usize; 2] {
    assert!(grid.cells().len() as u64 <= MAX_CELLS);
    check_tally(grid);
    [grid.width(), grid.height()]
}
