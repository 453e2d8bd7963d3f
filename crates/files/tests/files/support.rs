//! What was read of a file, and why it was refused.

use mean_information::map::{Encoding, Grid};
use mean_information::{Real, Tally};
use mean_information_files::{
    Cells, CellsVisitor, Contents, Counted, Counts, Error, Map, Options, Readable, read_map,
    read_map_contents, with_grid,
};
use mean_information_test_support::formats::Folder;
use std::path::Path;

/// Refuses to read `bytes` under `name`; returns the one line that says why.
pub(crate) fn refusal(name: &str, bytes: impl AsRef<[u8]>, options: &Options) -> String {
    let folder = Folder::new();
    refusal_of(&folder.write(name, bytes), options)
}

pub(crate) fn refusal_of(path: &Path, options: &Options) -> String {
    let line = read_twice(path, options).expect_err("must be refused").to_string();
    assert!(!line.contains('\n'), "{line}");
    line
}

/// Reads the cells of a map; then only what is measured. Both must say the same.
pub(crate) fn read_twice(path: &Path, options: &Options) -> Result<Map, Error> {
    let kept = read_map(path, options);
    let mut visited = Visited::default();
    match (&kept, read_map_contents(path, options, &mut visited)) {
        (Ok(kept), Ok(counted)) => {
            let name = path.display();
            match &counted.cells {
                Contents::Cells(cells) => assert_eq!(measure_cells(cells), measure(kept), "{name}"),
                Contents::Counted(Counted::Percent(counts)) => assert_counts(counts, kept),
                Contents::Counted(Counted::Mrpt(counts)) => assert_counts(counts, kept),
                Contents::Counted(Counted::Probability(counts)) => assert_counts(counts, kept),
                Contents::Visited { width, height } => {
                    let of = |m: Measured| (m.width, m.height, m.free, m.occupied, m.unknown);
                    let [free, occupied, unknown] = visited.0;
                    assert_eq!((*width, *height, free, occupied, unknown), of(measure(kept)), "{name}");
                }
            }
            assert_eq!(kept.warnings, counted.warnings);
            assert_eq!((kept.resolution, &kept.files), (counted.resolution, &counted.files));
        }
        (Err(kept), Err(counted)) => assert_eq!(format!("{kept:?}"), format!("{counted:?}")),
        (kept, counted) => panic!("{}: {kept:?}, but {counted:?}", path.display()),
    }
    kept
}

/// The free, occupied and unknown cells of those that were visited.
#[derive(Default)]
struct Visited([u64; 3]);

impl CellsVisitor for Visited {
    fn visit<E: Readable>(&mut self, cells: &[E::Stored]) {
        let tally = E::tally(cells);
        for (all, more) in self.0.iter_mut().zip([tally.free(), tally.occupied(), tally.unknown()]) {
            *all += more;
        }
    }
}

/// A visitor that looks at no cell.
pub(crate) struct Nobody;

impl CellsVisitor for Nobody {
    fn visit<E: Readable>(&mut self, _: &[E::Stored]) {}
}

/// Asserts that the tally of counts is that of the cells, and that a value is counted if and only if a cell has it.
fn assert_counts<E: Encoding>(counts: &Counts<E>, kept: &Map) {
    let mut tally = Tally::<E::Float>::new();
    for &(stored, count) in &counts.values {
        assert!(count > 0);
        tally.add_many(E::cell(stored).unwrap(), count);
    }
    assert_eq!(measured([counts.width, counts.height], &tally), measure(kept));
    let marked = counts.values.iter().any(|&(stored, _)| E::value(stored) == E::value(E::unknown()));
    assert_eq!(marked, with_grid!(&kept.cells, grid => is_marked(grid)));
}

/// Tells whether a cell is marked as unknown.
fn is_marked<E: Encoding>(grid: &Grid<E>) -> bool {
    grid.cells().iter().any(|&stored| stored == E::unknown())
}

/// The warnings of a map in words.
pub(crate) fn warnings(map: &Map) -> Vec<String> {
    map.warnings.iter().map(ToString::to_string).collect()
}

/// What a test asks of a map.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Measured {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) mean_information: f64,
    pub(crate) free: u64,
    pub(crate) occupied: u64,
    pub(crate) unknown: u64,
}

pub(crate) fn measure(map: &Map) -> Measured {
    measure_cells(&map.cells)
}

fn measure_cells(cells: &Cells) -> Measured {
    with_grid!(cells, grid => measured([grid.width(), grid.height()], &grid.tally()))
}

fn measured<T: Real>([width, height]: [usize; 2], tally: &Tally<T>) -> Measured {
    Measured {
        width,
        height,
        mean_information: tally.mean_information().widen(),
        free: tally.free(),
        occupied: tally.occupied(),
        unknown: tally.unknown(),
    }
}

pub(crate) fn percents(map: &Map) -> &[i8] {
    match &map.cells {
        Cells::Percent(grid) => grid.cells(),
        other => panic!("{other:?} are no percentages"),
    }
}

pub(crate) fn probabilities(map: &Map) -> &[f64] {
    match &map.cells {
        Cells::Probability64(grid) => grid.cells(),
        other => panic!("{other:?} are no probabilities in double precision"),
    }
}

/// A generator good enough to fill images: xorshift.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    pub(crate) fn below(&mut self, n: u32) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        ((self.0 >> 32) % u64::from(n)) as u32
    }
}
