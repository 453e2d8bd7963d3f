//! Grids as `.npy` arrays of probabilities in double precision, row 0 the lowest: no bit is lost.

use crate::error::Error;
use mean_information::Real;
use mean_information::map::{Encoding, Grid};
use std::io::{self, Write};

/// The header's length is brought to a multiple of this, as numpy does.
const ALIGNMENT: usize = 64;

/// Writes the occupancies of a grid as an array of float64.
///
/// ```
/// use mean_information::map::encoding::Percent;
/// use mean_information::map::{Geometry, Grid};
///
/// let grid = Grid::<Percent>::new(2, 1, Geometry::new(0.05, [0.0; 2])?, vec![-1, 25])?;
/// let mut file = Vec::new();
/// mean_information_files::npy::write(&grid, &mut file)?;
/// assert_eq!(file[128..], [0.5_f64.to_le_bytes(), 0.25_f64.to_le_bytes()].concat());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// An [`Error`] where `output` fails.
pub fn write<E: Encoding>(grid: &Grid<E>, output: impl Write) -> Result<(), Error> {
    write_array(grid, output).map_err(Error::of_writer)
}

/// Writes the header and the cells.
fn write_array<E: Encoding>(grid: &Grid<E>, mut output: impl Write) -> io::Result<()> {
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
    output.write_all(start)?;
    output.write_all(&(length as u16).to_le_bytes())?;
    output.write_all(header.as_bytes())?;
    let mut bytes = Vec::with_capacity(8 * grid.width());
    for row in (0..grid.height()).filter_map(|row| grid.row(row)) {
        bytes.clear();
        let occupancies = row.iter().map(|&stored| E::occupancy(stored).map_or(0.5, Real::widen));
        bytes.extend(occupancies.flat_map(f64::to_le_bytes));
        output.write_all(&bytes)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cells::Cells;
    use crate::error::ErrorKind;
    use crate::npy;
    use crate::options::Options;
    use mean_information::map::Geometry;
    use mean_information::map::encoding::Probability;

    #[test]
    fn what_is_saved_is_read() {
        let geometry = Geometry::new(0.05, [0.0; 2]).unwrap();
        let cells = vec![0.0, 0.1, 0.5, 0.5_f64.next_up(), 1.0, f64::MIN_POSITIVE];
        let grid = Grid::<Probability<f64>>::new(3, 2, geometry, cells.clone()).unwrap();
        let mut bytes = Vec::new();
        write(&grid, &mut bytes).unwrap();
        assert_eq!(bytes.len(), 128 + 8 * 6);
        assert_eq!(bytes[127], b'\n');
        let map = npy::read(&bytes[..], bytes.len() as u64, &Options::default()).unwrap();
        let Cells::Probability64(read) = map.cells else { panic!("{:?}", map.cells) };
        assert_eq!((read.width(), read.height(), read.cells()), (3, 2, &*cells));
        let refused = write(&grid, &mut [0; 130][..]).unwrap_err();
        assert_eq!(refused.kind(), ErrorKind::Io);
    }
}
