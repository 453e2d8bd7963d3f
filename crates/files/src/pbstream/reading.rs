//! The records of a saved state.

use super::fields::{array, fields_to_end};
use super::submap::Submap;
use crate::error::{Error, ErrorKind, Place};
use crate::options::{MAX_COUNTED, Options};
use flate2::read::GzDecoder;
use std::io::Read;

const MAGIC: u64 = 0x7b1d_1f7b_5bf5_01db;
/// The most bytes of a cell, and of a message beside its cells.
const BYTES_PER_CELL: u64 = 3;
const BESIDE_CELLS: u64 = 1 << 30;

/// Reads the submaps of a saved state of `length` bytes, in the order of the file.
///
/// # Errors
/// An [`Error`] with the byte of the record if this is no saved state, is cut short, has submaps in three dimensions or of
/// signed distances, or a grid whose cells are not as many as it says or more than the limit.
pub fn read(mut input: impl Read, length: u64, options: &Options) -> Result<Vec<Submap>, Error> {
    let mut magic = Vec::new();
    input.by_ref().take(8).read_to_end(&mut magic)?;
    if magic != MAGIC.to_le_bytes() {
        let refused = Error::new(ErrorKind::Format, "is no saved state of Cartographer by its first bytes");
        return Err(refused.at(Place::Byte(0)));
    }
    let max_cells = options.max_cells.unwrap_or(MAX_COUNTED);
    let mut submaps = Vec::new();
    let mut at = 8;
    while at < length {
        let of = |error: Error| error.preceded_by(&format!("record at byte {at}: ")).at(Place::Byte(at));
        let size = u64::from_le_bytes(array(&mut input).map_err(|error| of(error.into()))?);
        let end = at.checked_add(8).and_then(|start| start.checked_add(size));
        let Some(end) = end.filter(|&end| end <= length) else {
            let words = format!(
                "claims {size} bytes, but {} are left: the file is cut short",
                (length - at).saturating_sub(8)
            );
            return Err(of(Error::new(ErrorKind::CutShort, words).with_value(size.to_string())));
        };
        let mut record = (&mut input).take(size);
        submaps.extend(read_record(&mut record, max_cells).map_err(of)?);
        std::io::copy(&mut record, &mut std::io::sink()).map_err(|error| of(error.into()))?;
        at = end;
    }
    Ok(submaps)
}

/// Reads the submap of a record, if it has one.
fn read_record(record: &mut dyn Read, max_cells: u64) -> Result<Option<Submap>, Error> {
    let most = max_cells.saturating_mul(BYTES_PER_CELL).saturating_add(BESIDE_CELLS);
    let mut submap = None;
    fields_to_end(&mut GzDecoder::new(record), most, &mut |number, value, input| {
        if number == 3 {
            submap = Some(Submap::read(input, value.length()?, max_cells)?);
        }
        Ok(())
    })?;
    Ok(submap)
}
