//! Files: each is read or refused, and what is read keeps its promises.

use super::tally::check_tally;
use mean_information::map::{Encoding, Grid};
use mean_information_files::npy::MapsVisitor;
use mean_information_files::ros::{Description, read_image};
use mean_information_files::{
    ArrayEncoding, CellsVisitor, Contents, Counted, Error, Map, Memory, Mode, Options, Readable, Semantics,
    gridmap as mrpt, npy as arrays, read_map_from, read_weights_from, with_grid,
};
use std::io::Cursor;
use std::path::Path;

/// Small, so that a claim is soon above it.
const MAX_CELLS: u64 = 1 << 16;

/// Reads a description of a map: it is refused, or what is read can be meant.
pub fn yaml(bytes: &[u8]) {
    for semantics in [Semantics::Nav2, Semantics::Nav2Humble, Semantics::Ros1] {
        let Some(read) = kept(Description::read(bytes, semantics)) else {
            continue;
        };
        assert!(!read.image.is_empty());
        assert!(read.resolution > 0.0 && read.resolution.is_finite());
        assert!(read.origin.iter().all(|x| x.is_finite()));
        let thresholds = [read.free_thresh, read.occupied_thresh];
        assert!(thresholds.into_iter().flatten().all(f64::is_finite));
    }
}

/// Reads an image under every loader and mode.
pub fn pgm(bytes: &[u8]) {
    image("image", bytes);
}

/// Reads an image under every loader and mode.
pub fn png(bytes: &[u8]) {
    image("image", bytes);
}

/// Reads an image that is decoded whole under every loader and mode; what has no mark is TGA.
pub fn decoded(bytes: &[u8]) {
    image("image.tga", bytes);
}

fn image(name: &str, bytes: &[u8]) {
    let sizes = [Mode::Trinary, Mode::Scale, Mode::Raw, Mode::Probability].map(|mode| {
        [(Semantics::Nav2, false), (Semantics::Nav2Humble, false), (Semantics::Ros1, true)].map(
            |(semantics, negate)| {
                let description = Description {
                    image: name.to_owned(),
                    resolution: 0.05,
                    origin: [-3.5, 2.25, 0.125],
                    negate,
                    occupied_thresh: Some(0.65),
                    free_thresh: Some(0.25),
                    mode,
                    warnings: Vec::new(),
                };
                let options = Options {
                    semantics,
                    max_cells: Some(MAX_CELLS),
                    unknown: Some(1.0),
                    ..Options::default()
                };
                kept(read_image(Cursor::new(bytes), &description, &options)).map(|map| checked(&map))
            },
        )
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
        let map = kept(arrays::read(bytes, bytes.len() as u64, &options));
        let mut visited = Visited(0);
        let contents =
            kept(arrays::read_contents(bytes, bytes.len() as u64, &options, MAX_CELLS, &mut visited));
        assert_eq!(map.is_some(), contents.is_some());
        if let (Some(map), Some(contents)) = (map, contents) {
            let [width, height] = checked(&map);
            let cells: u64 = match contents.cells {
                Contents::Counted(Counted::Percent(counts)) => counts.values.iter().map(|&(_, n)| n).sum(),
                Contents::Counted(Counted::Mrpt(counts)) => counts.values.iter().map(|&(_, n)| n).sum(),
                _ => visited.0,
            };
            assert_eq!((cells, contents.warnings), ((width * height) as u64, map.warnings));
        }
    }
}

/// Reads the one array of an archive as a map, and as weights.
pub fn npz(bytes: &[u8]) {
    let mut files = Memory::new();
    files.add("map.npz", bytes);
    let options = Options { max_cells: Some(MAX_CELLS), ..Options::default() };
    for name in ["map.npz", "map.npz:a"] {
        if let Some(map) = kept(read_map_from(&files, Path::new(name), &options)) {
            checked(&map);
        }
        kept(read_weights_from(&files, Path::new(name), &options));
    }
}

/// Counts the cells that it visits.
struct Visited(u64);

impl CellsVisitor for Visited {
    fn visit<E: Readable>(&mut self, cells: &[E::Stored]) {
        assert!(cells.iter().all(|&cell| E::is_valid(cell)));
        self.0 += cells.len() as u64;
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
pub(super) fn kept<T>(read: Result<T, Error>) -> Option<T> {
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
