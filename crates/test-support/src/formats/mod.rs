//! Maps made on the spot, whole or broken, and folders for them.

pub mod bag;
mod folder;
mod gridmap;
mod map;
mod octree;
pub mod pbstream;
mod png;

pub use crate::real_data::shared_data;
pub use folder::Folder;
pub use gridmap::{GridMap, gzip};
pub use map::{npy, pgm, yaml};
pub use octree::{Node, Seen};
pub use png::{raw_png, zlib};
