//! The records of a saved state.

use super::fields::{Each, array, fields_to_end};
use super::header::check_version;
use super::nodes::Nodes;
use super::submap::Submap;
use crate::error::{Error, ErrorKind, Place};
use crate::options::{MAX_COUNTED, Options};
use crate::scans::{Kept, ScanLog, ScanOptions, Selection};
use flate2::read::GzDecoder;
use std::collections::BTreeSet;
use std::io::{BufReader, Read};

const MAGIC: u64 = 0x7b1d_1f7b_5bf5_01db;
/// The byte of the first record.
const FIRST: u64 = 8;
/// The most bytes of a cell, and of a message beside its cells.
const BYTES_PER_CELL: u64 = 3;
const BESIDE_CELLS: u64 = 1 << 30;
/// The numbers that a submap takes beside those of its values.
const OF_SUBMAP: usize = 16;

/// Reads the submaps of a saved state of `length` bytes, in the order of the file.
///
/// # Errors
/// An [`Error`] with the byte of the record if this is no saved state of format 1 or 2, is cut short, has submaps in three dimensions or of
/// signed distances, the same submap twice, or a grid whose cells are not as many as it says or more than the limit.
pub fn read(input: impl Read, length: u64, options: &Options) -> Result<Vec<Submap>, Error> {
    submaps(input, length, options, &mut Kept::default())
}

/// Reads the submaps, and counts what is kept of them: a record may repeat them, compressed.
fn submaps(input: impl Read, length: u64, options: &Options, kept: &mut Kept) -> Result<Vec<Submap>, Error> {
    let max_cells = options.max_cells.unwrap_or(MAX_COUNTED);
    let (mut submaps, mut names) = (Vec::new(), BTreeSet::new());
    let most = max_cells.saturating_mul(BYTES_PER_CELL).saturating_add(BESIDE_CELLS);
    records(input, length, most, &mut |number, value, input| {
        if number == 3 {
            let submap = Submap::read(input, value.length()?, max_cells)?;
            let (trajectory, index) = (submap.trajectory, submap.index);
            // Its cells would count twice.
            if !names.insert((trajectory, index)) {
                let words =
                    format!("submap {trajectory}, {index}: stands here again, allowed is once in a state");
                return Err(Error::new(ErrorKind::Format, words).with_value(format!("{trajectory}, {index}")));
            }
            // A value takes a probability and a count.
            kept.add(OF_SUBMAP + 2 * submap.counts.values.len())?;
            submaps.push(submap);
        }
        Ok(())
    })?;
    Ok(submaps)
}

/// Reads the scans of a saved state of `length` bytes: its nodes, each with the pose of the tracking frame as it was matched
/// to the submaps ("local") and as the pose graph has it ("global"), both turned upright.
///
/// The ranges are those of the points of a node from where `selection` mounts the laser in the tracking frame; if it
/// does not, from the origin of that frame, whence Cartographer draws its beams.
///
/// ```
/// use mean_information_files::{ErrorKind, pbstream, scans::{ScanOptions, Selection}};
/// let refused = pbstream::read_scans(&b"P5 3 2 255"[..], 10, &ScanOptions::default(), &Selection::default());
/// assert_eq!(refused.unwrap_err().kind(), ErrorKind::Format);
/// ```
///
/// # Errors
/// An [`Error`] with the byte of the record if this is no saved state of format 1 or 2, is cut short, has scans in three
/// dimensions or a node of another form than Cartographer's; of kind [`ErrorKind::Choice`] if it has several trajectories and `selection`
/// names none of them; if there is no scan.
pub fn read_scans(
    input: impl Read,
    length: u64,
    options: &ScanOptions,
    selection: &Selection,
) -> Result<ScanLog, Error> {
    let mut nodes = Nodes::default();
    all_nodes(input, length, &mut nodes)?;
    nodes.log(options, selection)
}

/// Reads the nodes and their poses.
fn all_nodes(input: impl Read, length: u64, nodes: &mut Nodes) -> Result<(), Error> {
    let most = MAX_COUNTED.saturating_mul(BYTES_PER_CELL).saturating_add(BESIDE_CELLS);
    records(input, length, most, &mut |number, value, input| match number {
        1 => nodes.read_graph(input, value.length()?),
        4 => nodes.read_node(input, value.length()?),
        _ => Ok(()),
    })
}

/// Checks the first record, the header, and hands the fields of all others, of at most `most` bytes each, to `each`.
fn records(mut input: impl Read, length: u64, most: u64, each: &mut Each<'_>) -> Result<(), Error> {
    let mut magic = Vec::new();
    input.by_ref().take(8).read_to_end(&mut magic)?;
    if magic != MAGIC.to_le_bytes() {
        let refused = Error::new(ErrorKind::Format, "is no saved state of Cartographer by its first bytes");
        return Err(refused.at(Place::Byte(0)));
    }
    let mut at = FIRST;
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
        // Numbers are read byte by byte.
        let mut unpacked = BufReader::new(GzDecoder::new(&mut record));
        let read = if at == FIRST {
            check_version(&mut unpacked, most)
        } else {
            fields_to_end(&mut unpacked, most, each)
        };
        read.map_err(of)?;
        std::io::copy(&mut record, &mut std::io::sink()).map_err(|error| of(error.into()))?;
        at = end;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::Compression;
    use flate2::write::GzEncoder;
    use std::io::Write;

    /// A field that is a message, or a list of integers, of these bytes, fewer than 128.
    fn message(number: u8, parts: &[&[u8]]) -> Vec<u8> {
        let bytes = parts.concat();
        [&[number << 3 | 2, bytes.len() as u8], bytes.as_slice()].concat()
    }

    /// A state of a header of format 2 and this record.
    fn state(record: &[u8]) -> Vec<u8> {
        let records: [&[u8]; 2] = [&[1 << 3, 2], record];
        let packed = records.map(|bytes| {
            let mut packer = GzEncoder::new(Vec::new(), Compression::fast());
            packer.write_all(bytes).unwrap();
            let packed = packer.finish().unwrap();
            [(packed.len() as u64).to_le_bytes().as_slice(), &packed].concat()
        });
        [MAGIC.to_le_bytes().into(), packed.concat()].concat()
    }

    /// What is kept of a state that a small file repeats is counted: of a submap 16 numbers and 2 a value, of a node 32, and of
    /// a point the integer that it is stored as and 3.
    #[test]
    fn what_is_kept_is_counted() {
        // Cells of 0.25 m, 3 x 2 of them, of the values 0 to 3.
        let resolution = [&[0x09], 0.25_f64.to_le_bytes().as_slice()].concat();
        let limits = message(1, &[&resolution, &message(3, &[&[1 << 3, 3, 2 << 3, 2]])]);
        let grid = message(4, &[&limits, &message(2, &[&[0, 1, 2, 3, 3, 3]])]);
        let submap = |index| {
            message(3, &[&message(1, &[&[1 << 3, 2, 2 << 3, index]]), &message(2, &[&[3 << 3, 1], &grid])])
        };
        let bytes = state(&[submap(5), submap(6)].concat());
        let kept = |room| {
            let mut kept = Kept::with_room(room);
            submaps(&*bytes, bytes.len() as u64, &Options::default(), &mut kept).map(|found| found.len())
        };
        assert_eq!(kept(48).unwrap(), 2);
        assert_eq!(kept(47).unwrap_err().kind(), ErrorKind::OutOfMemory);
        // A node at time 1 with a cloud of 2 points and an empty one.
        let points = message(3, &[&[1 << 3, 2], &message(3, &[&[2, 0, 0, 0, 7, 9]])]);
        let data = message(5, &[&[1 << 3, 1], &points, &message(9, &[])]);
        let bytes = state(&message(4, &[&message(1, &[&[1 << 3, 0, 2 << 3, 0]]), &data]));
        let kept = |room| {
            let mut nodes = Nodes::default();
            nodes.kept = Kept::with_room(room);
            all_nodes(&*bytes, bytes.len() as u64, &mut nodes)
        };
        kept(32 + 6 + 2 * 3).unwrap();
        assert_eq!(kept(32 + 6 + 2 * 3 - 1).unwrap_err().kind(), ErrorKind::OutOfMemory);
    }
}
