//! Bytes from the middle of a file.

use std::io::{self, Read, Seek, SeekFrom};

/// Returns up to `length` bytes from a place on; fewer at the end of the file.
pub(super) fn read_at(input: &mut (impl Read + Seek), place: u64, length: usize) -> io::Result<Vec<u8>> {
    input.seek(SeekFrom::Start(place))?;
    let mut bytes = Vec::new();
    input.take(length as u64).read_to_end(&mut bytes)?;
    Ok(bytes)
}
