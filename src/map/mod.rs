//! Occupancy maps: a Cartesian [`Grid`] of cells with its [`Geometry`], the [`PolarMap`] about a sensor, the
//! [`encoding`]s that maps are stored in, the [`Histogram`] of maps of bytes, and the pooling of cells into coarser ones.

mod cell_rows;
pub mod encoding;
mod geometry;
mod grid;
mod histogram;
pub(crate) mod parts;
mod polar;
mod pooling;
#[cfg(feature = "serde")]
mod portable;
pub(crate) mod repeated;
mod stored;

pub use geometry::Geometry;
pub use grid::Grid;
pub use histogram::{Byte, Histogram};
pub use polar::PolarMap;
pub use stored::Encoding;
