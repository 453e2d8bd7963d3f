//! The parts of `meaninfo`, as a library, so that tests and fuzz targets reach them.
//!
//! What rows hold, and the port protocol, is in [`mean_information_report`]. A module depends only on those above it:
//!
//! | module | holds |
//! |---|---|
//! | `metres` | lengths as the command line takes them |
//! | `progress` | a bar for long work |
//! | [`Failure`] | why a command was not done |
//! | [`reading`] | how files are read, in words of options |
//! | [`output`] | numbers, tables, JSON and CSV, and where they go |
//! | [`check`] | ports against the vectors |
//! | [`simulation`] | rooms, a robot in them, and the map it makes |
//! | `sweep` | the table of the measures against the size of cells |
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
pub mod commands;
pub mod convergence;
mod failure;
pub mod filter;
pub mod limits;
mod metres;
pub mod output;
pub mod paper;
pub mod plots;
mod progress;
pub mod reading;
mod run;
pub mod series;
pub mod simulation;
mod sweep;
pub mod trajectory;

pub use failure::Failure;
pub use run::run;
