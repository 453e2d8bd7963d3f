//! Maps from range scans: beams are inserted into a grid whose cells sum log-odds in integers, so that no order of scans
//! changes a bit, and a scan that is removed leaves none ([`ScanMap`]).
//!
//! What is rounded, and how, is the chapter [`scan`](crate::book::scan); what such maps tell of trajectories is the chapter
//! [`evidence`](crate::book::evidence). The words for places:
//!
//! | word | is |
//! |---|---|
//! | `Lattice` | the plane in integers: units of `2^-28` of a cell, on which beams begin and end |
//! | `Area` | a rectangle of cells, by their columns and rows on the lattice |
//! | `Raster` | the stored cells of one area, which grows as scans come |
//! | [`Layer`] | a number for each cell of a finished map, at a place in the world |
//! | [`Grid`](crate::map::Grid) | a finished map: cells in an encoding, at a place in the world |
//!
//! And on the way from a scan to its map: `Rays` are its beams on the lattice, which `Ends` finds. A beam's cells are a `Track`,
//! drawn on a `Canvas` column by column; what neighbours share, `Fans` finds, and it is drawn once, as `Stretches`. `Readings` are
//! what the scan says of the cells, `Sums` is what the map stores, as `Counts` or as `Totals`, `Inserted` which scans it holds.

mod agreement;
mod beams;
mod codes;
mod columns;
mod counts;
mod direction;
mod distances;
mod ends;
mod fans;
mod inserted;
mod jackknife;
mod lattice;
mod layer;
mod levels;
mod measures;
mod particles;
mod pose;
mod raster;
mod rays;
mod readings;
#[cfg(test)]
mod reference;
#[cfg(test)]
mod refusal;
mod scan_map;
mod stretches;
mod sums;
mod tallied;
mod totals;
#[cfg(test)]
mod traversal;

pub use beams::{Beam, Scan};
pub use direction::Direction;
pub use jackknife::{Difference, blocks};
pub use layer::Layer;
pub use particles::ParticleMaps;
pub use pose::Pose;
pub use scan_map::ScanMap;
pub use tallied::TalliedMap;
