//! Grids as `.npy` arrays of probabilities in double precision, row 0 the lowest: no bit is lost.

use mean_information::Real;
use mean_information::map::{Encoding, Grid};

/// The header's length is brought to a multiple of this, as numpy does.
const ALIGNMENT: usize = 64;

/// The bytes of the file.
pub fn save<E: Encoding>(grid: &Grid<E>) -> Vec<u8> {
    let mut header = format!(
        "{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}), }}",
        grid.height(),
        grid.width()
    );
    let start = b"\x93NUMPY\x01\x00";
    // With the start, two bytes of length, and a newline at the end.
    let length = (start.len() + 2 + header.len() + 1).next_multiple_of(ALIGNMENT) - start.len() - 2;
    header.push_str(&" ".repeat(length - 1 - header.len()));
    header.push('\n');

    let mut npy = Vec::with_capacity(start.len() + 2 + length + 8 * grid.cells().len());
    npy.extend(start);
    npy.extend((length as u16).to_le_bytes());
    npy.extend(header.into_bytes());
    for &stored in grid.cells() {
        let p = E::occupancy(stored).map_or(0.5, Real::widen);
        npy.extend(p.to_le_bytes());
    }
    npy
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::maps::{Cells, Options, npy};
    use mean_information::map::Geometry;
    use mean_information::map::encoding::{Percent, Probability};

    #[test]
    fn what_is_saved_is_read() {
        let geometry = Geometry::new(0.05, [0.0; 2]).unwrap();
        let cells = vec![0.0, 0.1, 0.5, 0.5_f64.next_up(), 1.0, f64::MIN_POSITIVE];
        let grid = Grid::<Probability<f64>>::new(3, 2, geometry, cells.clone()).unwrap();
        let bytes = save(&grid);
        assert_eq!(bytes.len(), 128 + 8 * 6);
        assert_eq!(bytes[127], b'\n');
        let map = npy::read(&bytes[..], bytes.len() as u64, &Options::default()).unwrap();
        let Cells::Probability64(read) = map.cells else { panic!("{:?}", map.cells) };
        assert_eq!((read.width(), read.height(), read.cells()), (3, 2, &*cells));
        let percent = Grid::<Percent>::new(2, 1, geometry, vec![-1, 25]).unwrap();
        assert_eq!(save(&percent)[128..], [0.5_f64.to_le_bytes(), 0.25_f64.to_le_bytes()].concat());
    }
}
