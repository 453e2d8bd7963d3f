//! Occupancy maps, range scans and trajectories as the field stores them, read for [`mean_information`] and written.
//!
//! A ROS map of 2 x 2 cells: occupied, unknown, free, and grey 64, which nav2 reads as 75 percent. The information of its
//! three observed cells is 1, 1 and 0.1887 bits.
//!
//! ```
//! use mean_information_files::{Memory, Options, read_map_from, with_grid};
//! use std::path::Path;
//!
//! let mut files = Memory::new();
//! files.add("map.pgm", b"P5\n2 2\n255\n\x00\x7f\xff\x40".to_vec());
//! let yaml = "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n\
//!             mode: scale\noccupied_thresh: 1\nfree_thresh: 0\n";
//! files.add("map.yaml", yaml.as_bytes().to_vec());
//!
//! let map = read_map_from(&files, Path::new("map.yaml"), &Options::default())?;
//! assert_eq!(map.resolution, Some(0.05));
//! let (observed, mean) = with_grid!(&map.cells, grid => {
//!     let tally = grid.tally();
//!     (tally.observed(), f64::from(tally.mean_information()))
//! });
//! assert_eq!(observed, 3);
//! assert_eq!(format!("{mean:.4}"), "0.7296");
//! # Ok::<(), mean_information_files::Error>(())
//! ```
//!
//! [`read_map`] takes a path on a disk, [`read_map_from`] any [`Source`] of files. [`read_map_contents`] counts the cells
//! of images and arrays, or hands them on in pieces, and keeps none, for who only measures them. [`read_scans`] reads a log
//! of range scans, [`read_trajectory`] the poses at which they may be inserted into a map. Nothing here measures, prints, or
//! knows of a command line.
//!
//! A module depends only on those above it:
//!
//! | module | holds |
//! |---|---|
//! | `error` | [`Error`]: its kind, the file, the place in it, the value, what is allowed, the cause |
//! | `options` | [`Options`]: how files are read |
//! | `warning` | [`Warning`]: what makes a map mean less than it seems, with its figures |
//! | `size` | sizes checked before memory is taken, and memory that grows with what was read |
//! | `source` | [`Source`]: where files come from, a [`Disk`] or [`Memory`] |
//! | `text` | lines of text and their fields |
//! | `cells` | [`Cells`]: a grid in one of the encodings, and [`Counts`] of its values |
//! | `map` | [`Map`]: cells, resolution, warnings |
//! | `image` | PGM and PNG, from the top a piece at a time; BMP, PPM, JPEG and others, decoded whole |
//! | [`ros`] | ROS maps: a yaml file that describes an image |
//! | [`npy`] | NumPy's arrays |
//! | `npz` | archives of them |
//! | `names` | names of files: their endings, and those of arrays within archives |
//! | [`gridmap`] | MRPT's grid maps |
//! | `kind` | [`FileKind`]: what a file is by the ending of its name |
//! | `words` | words that a reader does not understand, counted |
//! | [`octree`] | OctoMap's octrees, visited node by node |
//! | [`trajectory`] | [`Trajectory`]: poses by their times; TUM text |
//! | [`scans`] | [`ScanLog`](scans::ScanLog): logs of range scans, CARMEN's |
//! | [`pbstream`] | Cartographer's saved states: submaps, and scans |
//! | [`bags`] | bags of messages, and the maps and scans in them |
//! | [`particles`] | GMapping's logs of its particles |
//! | `read` | files by the ending of their names |
//!
//! The feature `clap` makes [`Semantics`], [`Mode`], [`ArrayEncoding`], [`scans::NoReturn`] and [`scans::TimeField`] values
//! of a command line's options.
// docs.rs says of each item which feature it takes.
#![cfg_attr(docsrs, feature(doc_cfg))]

pub mod bags;
mod cells;
mod error;
pub mod gridmap;
mod image;
mod kind;
mod map;
mod names;
pub mod npy;
mod npz;
pub mod octree;
mod options;
pub mod particles;
pub mod pbstream;
mod read;
pub mod ros;
pub mod scans;
mod size;
mod source;
mod text;
pub mod trajectory;
mod warning;
mod words;

pub use cells::{Cells, CellsVisitor, Contents, Counted, Counts, Readable};
pub use error::{Error, ErrorKind, Place};
pub use kind::FileKind;
pub use map::Map;
pub use names::{file_of, is_array, is_description};
pub use options::{ARRAY_NUMBERS, ArrayEncoding, MAX_CELLS, MAX_COUNTED, Mode, Options, Semantics};
pub use read::{
    read_array_type_from, read_filter_log, read_filter_log_from, read_map, read_map_contents,
    read_map_contents_from, read_map_from, read_octree, read_octree_from, read_particles,
    read_particles_from, read_scans, read_scans_from, read_selected_scans, read_submaps, read_submaps_from,
    read_trajectory, read_trajectory_from, read_weights, read_weights_from,
};
pub use source::{Disk, Memory, Opened, Source};
pub use trajectory::{Association, Trajectory, tum};
pub use warning::Warning;

/// The README, whose example is compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
