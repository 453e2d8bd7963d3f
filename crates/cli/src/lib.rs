//! The parts of `meaninfo`, as a library, so that tests and fuzz targets reach them.
//!
//! A module depends only on those above it:
//!
//! | module | holds |
//! |---|---|
//! | [`hex_float`] | hexadecimal floats |
//! | [`protocol`] | the messages between `meaninfo check` and a port |
//! | [`port`] | the library as a port |
//! | [`maps`] | map files and how to read them |
//! | `progress` | a bar for long work |
//! | [`Failure`] | why a command was not done |
//! | [`output`] | numbers, tables, JSON and CSV, and where they go |
//! | [`check`] | ports against the vectors |
//! | [`measures`] | what is measured of a map |
//! | [`simulation`] | rooms, a robot in them, and the map it makes |
//! | [`sweep`] | the measures against the size of cells |
//! | [`convergence`] | grids of a circular room against their limit |
//! | [`plots`] | pictures of maps, curves, sweeps and convergence |
//! | [`paper`] | the figures and the claims of the report |
//! | [`commands`] | the arguments, and what they ask for |

pub mod check;
pub mod commands;
pub mod convergence;
mod failure;
pub mod hex_float;
pub mod maps;
pub mod measures;
pub mod output;
pub mod paper;
pub mod plots;
pub mod port;
mod progress;
pub mod protocol;
pub mod simulation;
pub mod sweep;

pub use failure::Failure;
