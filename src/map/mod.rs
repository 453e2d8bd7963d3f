//! Occupancy maps: a Cartesian [`Grid`] of cells with its [`Geometry`], the [`PolarMap`] about a sensor, the [`encoding`]s that
//! maps are stored in, and the pooling of cells into coarser ones.

pub mod encoding;
mod geometry;
mod grid;
mod histogram;
mod polar;
mod pooling;

pub use encoding::Encoding;
pub use geometry::Geometry;
pub use grid::Grid;
pub use polar::PolarMap;
