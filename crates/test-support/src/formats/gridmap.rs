//! MRPT grid maps put together from their parts, so that any part can be wrong.

use flate2::Compression;
use flate2::write::GzEncoder;
use std::io::Write;

/// The parts of a grid map.
#[derive(Clone, Debug)]
pub struct GridMap {
    /// The name of the object.
    pub name: &'static [u8],
    /// The version.
    pub version: u8,
    /// The bits of a cell.
    pub bits: u8,
    /// Columns and rows.
    pub size: [u32; 2],
    /// x from, x to, y from, y to, resolution.
    pub place: [f32; 5],
    /// The cells, the lowest row first.
    pub cells: Vec<u8>,
    /// The bytes after the cells: options and the end mark.
    pub tail: Vec<u8>,
}

impl GridMap {
    /// Creates a map of 3 x 2 cells of 0.25 m, whose options are some bytes.
    pub fn small() -> Self {
        Self {
            name: b"mrpt::maps::COccupancyGridMap2D",
            version: 6,
            bits: 8,
            size: [3, 2],
            place: [-0.5, 0.25, 2.0, 2.5, 0.25],
            cells: [-128_i8, -127, -1, 0, 1, 127].map(i8::cast_unsigned).to_vec(),
            tail: [vec![7; 500], vec![0x88]].concat(),
        }
    }

    /// Returns the bytes before the cells.
    pub fn header(&self) -> Vec<u8> {
        let mut bytes = vec![0x80 + self.name.len() as u8];
        bytes.extend(self.name);
        bytes.extend([self.version, self.bits]);
        self.size.iter().for_each(|n| bytes.extend(n.to_le_bytes()));
        self.place.iter().for_each(|x| bytes.extend(x.to_le_bytes()));
        bytes
    }

    /// Returns the bytes of the file.
    pub fn bytes(&self) -> Vec<u8> {
        [self.header(), self.cells.clone(), self.tail.clone()].concat()
    }
}

/// Compresses bytes as gzip.
///
/// # Panics
/// If memory lacks.
pub fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}
