//! One map in an array.

use super::header::{self, Header};
use super::stack::{MapsVisitor, visit_maps};
use crate::cells::{Cells, Readable};
use crate::error::{Error, ErrorKind};
use crate::map::Map;
use crate::options::Options;
use mean_information::map::Grid;
use std::io::Read;

/// Reads an array from a file of `length` bytes.
///
/// # Errors
/// An [`Error`] if this is no `.npy` file, holds anything but a two-dimensional array that fits the encoding, is not
/// exactly as long as its header says, or has a cell that is not allowed: the first one is named.
pub fn read(mut input: impl Read, length: u64, options: &Options) -> Result<Map, Error> {
    let header = Header::read(&mut input, header::MAPS)?;
    let [rows, columns] = header.dimensions("rows and columns")?;
    let cells = visit_maps(input, length, &header, [1, rows, columns], options, OnlyMap)?;
    let cells = cells.ok_or_else(|| Error::new(ErrorKind::Format, "holds no map"))?;
    Ok(Map { cells, resolution: options.resolution, warnings: Vec::new(), files: Vec::new() })
}

/// Takes the one map of a stack.
struct OnlyMap;

impl MapsVisitor for OnlyMap {
    type Output = Option<Cells>;

    fn visit<E: Readable>(self, maps: Vec<Grid<E>>) -> Option<Cells> {
        maps.into_iter().next().map(E::cells)
    }
}
