//! Names of files: their endings, and those of arrays within archives.

use crate::npz;
use std::path::Path;

/// Returns the file that is opened for `path`: that before the key of an array in `FILE.npz:KEY`.
pub fn file_of(path: &Path) -> &Path {
    npz::split(path).map_or(path, |(file, _)| file)
}

/// Tells whether a file is an array by its name, `.npy` or `.npz`, or one within an archive.
pub fn is_array(path: &Path) -> bool {
    has_ending(path, &[".npy"]) || npz::split(path).is_some()
}

/// Tells whether a file describes a ROS map by its name, `.yaml` or `.yml`.
pub fn is_description(path: &Path) -> bool {
    has_ending(path, &[".yaml", ".yml"])
}

/// Tells whether the name of a file ends so, in letters of either case.
pub(crate) fn has_ending(path: &Path, endings: &[&str]) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    endings.iter().any(|&ending| name.ends_with(ending))
}
