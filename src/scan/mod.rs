//! Maps from range scans: beams are inserted into a grid whose cells sum log-odds in integers, so that no order of scans
//! changes a bit ([`ScanMap`]).
//!
//! What is rounded, and how, is the chapter [`scan`](crate::book::scan). Four words for places:
//!
//! | word | is |
//! |---|---|
//! | `Lattice` | the plane in integers: units of `2^-28` of a cell, on which beams begin and end |
//! | `Area` | a rectangle of cells, by their columns and rows on the lattice |
//! | `Raster` | the stored cells of one area, which grows as scans come |
//! | [`Grid`](crate::map::Grid) | a finished map: cells in an encoding, at a place in the world |

mod beams;
mod direction;
mod lattice;
mod pose;
mod raster;
mod scan_map;
mod traversal;

pub use beams::{Beam, Scan};
pub use direction::Direction;
pub use pose::Pose;
pub use scan_map::ScanMap;
