//! The first record of a saved state: `SerializationHeader`, with the version of the format.

use super::fields::{WireValue, fields_to_end};
use crate::error::{Error, ErrorKind};
use std::io::Read;

/// The versions that are read. They differ by histograms of submaps in three dimensions, which are refused.
const VERSIONS: [u64; 2] = [1, 2];

/// Reads the first record, of at most `most` bytes. States that Cartographer saved before its version 1.0 begin with the pose
/// graph in its place.
pub(super) fn check_version(input: &mut dyn Read, most: u64) -> Result<(), Error> {
    let mut found = None;
    fields_to_end(input, most, &mut |number, value, _| {
        if let (1, WireValue::Varint(version)) = (number, value) {
            found = Some(version);
        }
        Ok(())
    })?;
    match found {
        Some(version) if VERSIONS.contains(&version) => Ok(()),
        Some(version) => Err(Error::new(ErrorKind::Unsupported, format!("is of format version {version}"))
            .with_value(version.to_string())
            .allowing(", allowed are ", "1 and 2")),
        None => {
            Err(Error::new(ErrorKind::Unsupported, "has no header, as states from before Cartographer 1.0")
                .followed_by("; `cartographer_pbstream migrate OLD NEW` of Cartographer 1.0 converts those")
                .allowing("; allowed are ", "headers of format version 1 and 2"))
        }
    }
}
