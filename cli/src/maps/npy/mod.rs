//! `.npy` arrays as maps: two dimensions, row 0 of the array is row 0 of the grid, the lowest.

mod header;

use super::size::{Size, read_pieces, reserve};
use super::{ArrayEncoding, Cells, Fault, Map, Options};
use header::{Element, Header};
use mean_information::map::encoding::{LogOdds, MrptLogOdds, Percent, Probability};
use mean_information::map::{Encoding, Grid};
use std::io::Read;

/// Reads an array from a file of `length` bytes.
///
/// # Errors
/// A [`Fault`] if this is no `.npy` file, holds anything but a two-dimensional array that fits the encoding, is not
/// exactly as long as its header says, or has a cell that is not allowed: the first one is named.
pub fn read(mut input: impl Read, length: u64, options: &Options) -> Result<Map, Fault> {
    let header = Header::read(&mut input)?;
    let [rows, columns] = header.shape;
    let size = Size::within(columns, rows, options.max_cells)?;
    let claimed = u128::from(header.length) + (size.cells() as u128) * header.element.bytes() as u128;
    if claimed != u128::from(length) {
        return Err(Fault::new(format!("has {length} bytes, its header claims {claimed}")));
    }
    let array = Array { header, size, options };
    let encoding = options.encoding.unwrap_or(match array.header.element {
        Element::Int8 => ArrayEncoding::Percent,
        Element::Float32 | Element::Float64 => ArrayEncoding::Probability,
    });
    let cells = match (encoding, array.header.element) {
        (ArrayEncoding::Probability, Element::Float32) => {
            Cells::Probability32(array.grid::<Probability<f32>, 4>(input, f32::from_le_bytes)?)
        }
        (ArrayEncoding::Probability, Element::Float64) => {
            Cells::Probability64(array.grid::<Probability<f64>, 8>(input, f64::from_le_bytes)?)
        }
        (ArrayEncoding::LogOdds, Element::Float32) => {
            Cells::LogOdds32(array.grid::<LogOdds<f32>, 4>(input, f32::from_le_bytes)?)
        }
        (ArrayEncoding::LogOdds, Element::Float64) => {
            Cells::LogOdds64(array.grid::<LogOdds<f64>, 8>(input, f64::from_le_bytes)?)
        }
        (ArrayEncoding::Percent, Element::Int8) => {
            Cells::Percent(array.grid::<Percent, 1>(input, i8::from_le_bytes)?)
        }
        (ArrayEncoding::Mrpt, Element::Int8) => {
            Cells::Mrpt(array.grid::<MrptLogOdds, 1>(input, i8::from_le_bytes)?)
        }
        (encoding, element) => return Err(mismatch(encoding, element)),
    };
    Ok(Map { cells, resolution: options.resolution, warnings: Vec::new(), files: Vec::new() })
}

fn mismatch(encoding: ArrayEncoding, element: Element) -> Fault {
    let (name, needed) = match encoding {
        ArrayEncoding::Probability => ("probability", "float32 or float64"),
        ArrayEncoding::LogOdds => ("log-odds", "float32 or float64"),
        ArrayEncoding::Percent => ("percent", "int8"),
        ArrayEncoding::Mrpt => ("mrpt", "int8"),
    };
    Fault::new(format!("holds {}, the encoding {name} needs {needed}", element.name()))
}

/// An array whose header was checked.
struct Array<'a> {
    header: Header,
    size: Size,
    options: &'a Options,
}

impl Array<'_> {
    fn grid<E: Encoding, const N: usize>(
        &self,
        input: impl Read,
        element: fn([u8; N]) -> E::Stored,
    ) -> Result<Grid<E>, Fault> {
        let Size { width, height } = self.size;
        let geometry = self.size.placed(self.options.resolution.unwrap_or(1.0), [0.0, 0.0], 0.0)?;
        let mut cells = Vec::new();
        read_pieces(input, self.size.cells(), N, |piece| {
            let elements = piece.as_chunks().0.iter();
            reserve(&mut cells, elements.len(), self.size.cells())?;
            if self.header.big_endian {
                cells.extend(elements.map(|&bytes| {
                    let mut bytes: [u8; N] = bytes;
                    bytes.reverse();
                    element(bytes)
                }));
            } else {
                cells.extend(elements.map(|&bytes| element(bytes)));
            }
            Ok(())
        })?;
        if self.header.fortran_order {
            cells = transposed(&cells, self.size)?;
        }
        Ok(Grid::new(width, height, geometry, cells)?)
    }
}

/// The rows of an array stored by columns.
fn transposed<T: Copy>(columns: &[T], size: Size) -> Result<Vec<T>, Fault> {
    let mut cells = Vec::new();
    reserve(&mut cells, columns.len(), columns.len())?;
    for row in 0..size.height {
        cells.extend(columns[row.min(columns.len())..].iter().step_by(size.height).copied());
    }
    Ok(cells)
}
