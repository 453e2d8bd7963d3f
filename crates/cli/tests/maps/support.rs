//! Files written by the tests, and what was read from them.

use mean_information::map::{Encoding, Grid};
use mean_information_cli::maps::{self, Cells, Map, Options, Problem};
use mean_information_cli::measures::Measures;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A folder that goes when the test ends.
pub(crate) struct Folder(TempDir);

impl Folder {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        fs::write(&path, bytes).unwrap();
        path
    }
}

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

/// Reads the cells of a map; then only what is measured, as `meaninfo map` does. Both must say the same.
pub(crate) fn read_twice(path: &Path, options: &Options) -> Result<Map, Problem> {
    let kept = maps::read(path, options);
    match (&kept, maps::read_contents(path, options)) {
        (Ok(kept), Ok(counted)) => {
            assert_eq!(
                Measures::of(&kept.cells),
                Measures::of_contents(&counted.cells),
                "{}",
                path.display()
            );
            assert_eq!(kept.warnings, counted.warnings);
            assert_eq!((kept.resolution, &kept.files), (counted.resolution, &counted.files));
        }
        (Err(kept), Err(counted)) => assert_eq!(kept.to_string(), counted.to_string()),
        (kept, counted) => panic!("{}: {kept:?}, but {counted:?}", path.display()),
    }
    kept
}

/// A yaml file with the usual thresholds and these further lines.
pub(crate) fn yaml(image: &str, more: &str) -> String {
    format!(
        "image: {image}\nresolution: 0.05\norigin: [-3.5, 2.25, 0.125]\n\
         occupied_thresh: 0.65\nfree_thresh: 0.196\n{more}"
    )
}

/// A raw PGM.
pub(crate) fn pgm(width: usize, height: usize, max: u16, samples: &[u16]) -> Vec<u8> {
    let mut bytes = format!("P5\n# a comment 7\n{width} # another\n{height}\n{max}\n").into_bytes();
    for &sample in samples {
        bytes.extend(&sample.to_be_bytes()[usize::from(max < 256)..]);
    }
    bytes
}

/// An `.npy` file of version 1.
pub(crate) fn npy(descr: &str, fortran_order: bool, shape: &str, data: &[u8]) -> Vec<u8> {
    let order = if fortran_order { "True" } else { "False" };
    let mut header = format!("{{'descr': {descr}, 'fortran_order': {order}, 'shape': {shape}, }}");
    while (10 + header.len() + 1) % 64 != 0 {
        header.push(' ');
    }
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.into_bytes());
    bytes.extend(data);
    bytes
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
    match &map.cells {
        Cells::Percent(grid) => measure_grid(grid),
        Cells::Mrpt(grid) => measure_grid(grid),
        Cells::Probability32(grid) => measure_grid(grid),
        Cells::Probability64(grid) => measure_grid(grid),
        Cells::LogOdds32(grid) => measure_grid(grid),
        Cells::LogOdds64(grid) => measure_grid(grid),
    }
}

fn measure_grid<E: Encoding>(grid: &Grid<E>) -> Measured {
    let tally = grid.tally();
    Measured {
        width: grid.width(),
        height: grid.height(),
        mean_information: mean_information::Real::widen(tally.mean_information()),
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
