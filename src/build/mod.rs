//! Builders of maps: what an inverse sensor model gives of a circular room ([`CartesianRoom`], [`PolarRoom`]), range scans
//! inserted into a grid ([`ScanMap`]), observations of one place fused ([`fuse`]), and the expected map of weighted
//! hypotheses ([`Hypotheses`]).
//!
//! What is rounded, and how, are the chapters [`grids`](crate::book::grids), [`scan`](crate::book::scan),
//! [`fusion`](crate::book::fusion) and [`expected`](crate::book::expected).

mod alignment;
mod direction;
mod expected;
mod fusion;
mod lattice;
mod marginals;
mod parts;
mod raster;
mod room;
mod scan;
mod scan_map;
mod stack;
mod traversal;
mod weights;

pub use direction::Direction;
pub use expected::{ExpectedMap, Hypotheses};
pub use fusion::fuse;
pub use room::{CartesianRoom, PolarRoom, Sampling};
pub use scan::{Beam, Pose, Scan};
pub use scan_map::ScanMap;
pub use weights::weighted_mean;
