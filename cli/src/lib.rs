//! The parts of `meaninfo`, as a library, so that tests and fuzz targets reach them.

pub mod arguments;
pub mod commands;
mod failure;
pub mod hex_float;
pub mod maps;
pub mod measures;
pub mod output;
pub mod plots;

pub use failure::Failure;
