//! Bags on the disk: a file, or the folder that rosbag2 makes.

use super::delivery::{Delivery, Visitor};
use super::folder::{is_packed, parts};
use super::stream::read_file;
use crate::error::{Error, ErrorKind};
use crate::options::Options;
use crate::source::{Disk, Source};
use crate::warning::Warning;
use std::path::Path;

/// Reads a bag on the disk, a file or the folder of one that was split, and hands its messages to `visitor`, in the
/// order in which they stand in its files.
///
/// # Errors
/// An [`Error`] naming the file: as [`read_stream`](super::read_stream) and [`bag_files`](super::bag_files); for `.db3` also
/// where SQLite refuses it, or the feature `sqlite` is missing; for a file that rosbag2 compressed as a whole.
pub fn read_bag(path: &Path, options: &Options, visitor: &mut dyn Visitor) -> Result<Vec<Warning>, Error> {
    let mut delivery = Delivery::new(visitor, options.max_kept());
    let mut warnings = Vec::new();
    for file in parts(path)? {
        warnings.extend(read_one(&file, &mut delivery).map_err(|error| error.in_file(&file))?);
    }
    Ok(warnings)
}

/// Reads a file of a bag.
fn read_one(path: &Path, delivery: &mut Delivery<'_>) -> Result<Vec<Warning>, Error> {
    let mut opened = Disk.open(path)?;
    if is_packed(path) {
        let words = "is compressed as a whole, by rosbag2's compression mode file; `zstd -d` unpacks it, and then it is read";
        return Err(Error::new(ErrorKind::Unsupported, words));
    }
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("db3")) {
        #[cfg(feature = "sqlite")]
        return super::sqlite::read_file(path, delivery);
        #[cfg(not(feature = "sqlite"))]
        return Err(Error::new(
            ErrorKind::Unsupported,
            "is a bag in SQLite, for which the feature sqlite is missing",
        ));
    }
    read_file(&mut opened.input, opened.length, delivery)
}
