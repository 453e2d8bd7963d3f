//! Bags on the disk: a file, or the folder that rosbag2 makes.

use super::delivery::{Delivery, Visitor};
use super::stream::read_file;
use crate::error::{Error, ErrorKind};
use crate::options::Options;
use crate::source::{Disk, Source};
use crate::warning::Warning;
use std::fs;
use std::path::{Path, PathBuf};

/// Tells whether a path is that of a bag: by the ending of its name, `.mcap`, `.bag`, `.bag.active` or `.db3`, or a
/// folder that holds such files.
pub fn is_bag(path: &Path) -> bool {
    if path.is_dir() { files_of(path).is_ok_and(|files| !files.is_empty()) } else { is_bag_file(path) }
}

/// Tells whether a file is a bag by its name.
fn is_bag_file(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    [".mcap", ".bag", ".bag.active", ".db3"].iter().any(|&ending| name.ends_with(ending))
}

/// Reads a bag on the disk, a file or the folder of one that was split, and hands its messages to `visitor`, in the
/// order in which they were recorded.
///
/// # Errors
/// An [`Error`] naming the file: as [`read_stream`](super::read_stream); for `.db3` also where SQLite refuses it, or the
/// feature `sqlite` is missing.
pub fn read_bag(path: &Path, options: &Options, visitor: &mut dyn Visitor) -> Result<Vec<Warning>, Error> {
    let mut delivery = Delivery::new(visitor, options.max_kept());
    if !path.is_dir() {
        return read_one(path, &mut delivery).map_err(|error| error.in_file(path));
    }
    let files = files_of(path).map_err(|error| Error::from(error).in_file(path))?;
    if files.is_empty() {
        let refused = Error::new(ErrorKind::NotFound, "is a folder without a bag");
        return Err(refused.allowing("; allowed are ", "folders with .db3 or .mcap files").in_file(path));
    }
    let mut warnings = Vec::new();
    for file in files {
        warnings.extend(read_one(&file, &mut delivery).map_err(|error| error.in_file(&file))?);
    }
    Ok(warnings)
}

/// Reads a file of a bag.
fn read_one(path: &Path, delivery: &mut Delivery<'_>) -> Result<Vec<Warning>, Error> {
    let mut opened = Disk.open(path)?;
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

/// Returns the files of a folder that are bags, in the order in which rosbag2 numbers them: `run_2` before `run_10`.
fn files_of(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if is_bag_file(&path) {
            files.push(path);
        }
    }
    files.sort_by_key(|path| (path.as_os_str().len(), path.clone()));
    Ok(files)
}
