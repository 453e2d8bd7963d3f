//! The parts of `meaninfo`, as a library, so that tests and fuzz targets reach them.
//!
//! A module depends only on those above it:
//!
//! | module | holds |
//! |---|---|
//! | [`hex_float`] | hexadecimal floats |
//! | [`protocol`] | the messages between `meaninfo check` and a port |
//! | [`port`] | the library as a port |
//! | `one_line` | text of others in one line |
//! | `metres` | lengths as the command line takes them |
//! | `clamp` | the occupancies of a tree that only tells free from occupied |
//! | `progress` | a bar for long work |
//! | [`Failure`] | why a command was not done |
//! | [`reading`] | how files are read, and their warnings, in words of options |
//! | [`output`] | numbers, tables, JSON and CSV, and where they go |
//! | [`check`] | ports against the vectors |
//! | [`measures`] | what is measured of a map |
//! | `submaps` | the submaps of saved states, apart or together |
//! | [`octree`] | what is measured of an octree, at each depth |
//! | [`simulation`] | rooms, a robot in them, and the map it makes |
//! | [`sweep`] | the measures against the size of cells |
//! | [`series`] | the maps of a bag, measured one after the other |
//! | [`convergence`] | grids of a circular room against their limit |
//! | [`plots`] | pictures of maps, curves, sweeps, bags and convergence |
//! | [`limits`] | limits with their ends, by whichever method |
//! | [`paper`] | the figures and the claims of the report |
//! | [`trajectory`] | trajectories compared by the maps that they make of the same scans |
//! | [`filter`] | the expected map of a filter's log, step by step |
//! | [`commands`] | the arguments, and what they ask for |
//! | `run` | the command as a function |

pub mod check;
mod clamp;
pub mod commands;
pub mod convergence;
mod failure;
pub mod filter;
pub mod hex_float;
pub mod limits;
pub mod measures;
mod metres;
pub mod octree;
mod one_line;
pub mod output;
pub mod paper;
pub mod plots;
pub mod port;
mod progress;
pub mod protocol;
pub mod reading;
mod run;
pub mod series;
pub mod simulation;
mod submaps;
pub mod sweep;
pub mod trajectory;

pub use clamp::Clamp;
pub use failure::Failure;
pub use run::run;
