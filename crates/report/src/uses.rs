//! The files that have a use for an option of reading: one that none of the files has is refused, not ignored.

use crate::submaps::is_state;
use mean_information_files::bags::is_bag;
use mean_information_files::{is_array, is_description};
use std::path::Path;

/// An option of reading maps, and the files that have a use for it.
struct Use {
    option: &'static str,
    is_for: fn(&Path) -> bool,
    files: &'static str,
}

/// The options that are for some files only.
const USES: [Use; 8] = [
    Use { option: "semantics", is_for: is_description, files: "ROS maps" },
    Use { option: "mode", is_for: is_description, files: "ROS maps" },
    Use { option: "unknown", is_for: has_unknown, files: "ROS maps and arrays of floats" },
    Use { option: "encoding", is_for: is_array, files: ARRAYS },
    Use { option: "resolution", is_for: is_array, files: ARRAYS },
    Use {
        option: "clamp",
        is_for: is_clamped,
        files: "octrees that only tell free from occupied, .bt or in bags",
    },
    Use { option: "topic", is_for: is_bag, files: "bags" },
    Use { option: "submaps", is_for: is_state, files: "saved states, .pbstream" },
];

const ARRAYS: &str = "arrays, .npy and .npz; other files say it themselves";

/// Tells whether a value can be given for unknown.
fn has_unknown(path: &Path) -> bool {
    is_description(path) || is_array(path)
}

/// Tells whether a file may hold an octree that only tells free from occupied.
fn is_clamped(path: &Path) -> bool {
    is_bag(path) || path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("bt"))
}

/// Says which files an option is for, if the one at `path` has no use for it.
///
/// ```
/// use mean_information_report::uses::no_use;
/// use std::path::Path;
///
/// assert_eq!(no_use("mode", Path::new("room.npy")), Some("ROS maps"));
/// assert_eq!(no_use("mode", Path::new("room.yaml")), None);
/// assert_eq!(no_use("max-cells", Path::new("room.npy")), None);
/// ```
pub fn no_use(option: &str, path: &Path) -> Option<&'static str> {
    USES.iter().find(|of| of.option == option && !(of.is_for)(path)).map(|of| of.files)
}
