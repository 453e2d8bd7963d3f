//! What a file is by the ending of its name, for who is given another than is wanted.

use crate::error::{Error, ErrorKind};
use crate::names::{file_of, has_ending};
use std::path::Path;

/// The kind of a file, by the ending of its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FileKind {
    /// A map: a description of one, an array, a grid map or an octree.
    Map,
    /// The image of a map, which a description names.
    Image,
    /// A log of range scans.
    Scans,
    /// The log of a particle filter.
    FilterLog,
    /// A trajectory.
    Trajectory,
}

const ENDINGS: [(FileKind, &str, &[&str]); 5] = [
    (FileKind::Map, "a map", &[".yaml", ".yml", ".npy", ".npz", ".gridmap", ".gridmap.gz", ".ot", ".bt"]),
    (
        FileKind::Image,
        "the image of a map",
        &[
            ".pgm", ".png", ".bmp", ".ppm", ".pbm", ".pnm", ".pam", ".jpg", ".jpeg", ".tif", ".tiff", ".gif",
            ".webp", ".tga",
        ],
    ),
    (FileKind::Scans, "a log of scans", &[".log", ".clf"]),
    (FileKind::FilterLog, "the log of a particle filter", &[".gfs"]),
    (FileKind::Trajectory, "a trajectory", &[".tum"]),
];

impl FileKind {
    /// Tells what a file is by its name; of bags and saved states, which hold maps and scans, `None`.
    pub fn of(path: &Path) -> Option<Self> {
        Self::named(path).map(|(kind, _)| kind)
    }

    fn named(path: &Path) -> Option<(Self, &'static str)> {
        let path = file_of(path);
        let found = ENDINGS.iter().find(|(_, _, endings)| has_ending(path, endings));
        found.map(|&(kind, words, _)| (kind, words))
    }

    /// Refuses the file at `path` where one of the kind `wanted` is read, if its name says that it is another.
    pub(crate) fn refused(path: &Path, wanted: Self) -> Option<Error> {
        let (_, what) = Self::named(path).filter(|&(kind, _)| kind != wanted)?;
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let (_, wanted, _) = ENDINGS.iter().find(|&&(kind, ..)| kind == wanted)?;
        let words = format!("is {what} by its name, and {wanted} is wanted here");
        Some(Error::new(ErrorKind::OtherKind, words).with_value(name))
    }
}
