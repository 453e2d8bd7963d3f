//! `.npy` arrays: a map of two dimensions, whose row 0 is the lowest of the grid; a stack of such maps; a list of
//! weights.

mod header;
mod saving;
mod stack;

pub use saving::save;
pub use stack::{WithMaps, read_stack, read_weights};

use super::cells::Readable;
use super::{Cells, Fault, Map, Options};
use header::Header;
use mean_information::map::Grid;
use std::io::Read;

/// Reads an array from a file of `length` bytes.
///
/// # Errors
/// A [`Fault`] if this is no `.npy` file, holds anything but a two-dimensional array that fits the encoding, is not
/// exactly as long as its header says, or has a cell that is not allowed: the first one is named.
pub fn read(mut input: impl Read, length: u64, options: &Options) -> Result<Map, Fault> {
    let header = Header::read(&mut input, header::MAPS)?;
    let [rows, columns] = header.dimensions("rows and columns")?;
    let cells = stack::with_maps(input, length, &header, [1, rows, columns], options, Alone)?;
    let cells = cells.ok_or_else(|| Fault::new("holds no map"))?;
    Ok(Map { cells, resolution: options.resolution, warnings: Vec::new(), files: Vec::new() })
}

/// The one map of a stack.
struct Alone;

impl WithMaps for Alone {
    type Output = Option<Cells>;

    fn with<E: Readable>(self, maps: Vec<Grid<E>>) -> Option<Cells> {
        maps.into_iter().next().map(E::cells)
    }
}
