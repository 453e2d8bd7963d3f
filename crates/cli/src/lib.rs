//! The parts of `meaninfo`, as a library, so that tests and bindings reach them. Nothing here is promised but [`run()`] and
//! [`Failure`]: what stays is the command, and the keys of its JSON.
//!
//! What rows hold, and the port protocol, is in [`mean_information_report`]. A module depends only on those above it:
//!
//! | module | holds |
//! |---|---|
//! | `metres` | lengths as the command line takes them |
//! | `progress` | a bar for long work |
//! | [`Failure`] | why a command was not done |
//! | `reading` | how files are read, in words of options |
//! | `output` | numbers, tables, JSON and CSV, and where they go |
//! | `check` | ports against the vectors |
//! | `simulation` | rooms, a robot in them, and the map it makes |
//! | `sweep` | the table of the measures against the size of cells |
//! | `series` | the maps of a bag, measured one after the other |
//! | `convergence` | grids of a circular room against their limit |
//! | `plots` | pictures of maps, curves, sweeps, bags and convergence |
//! | `limits` | limits with their ends, by whichever method |
//! | `paper` | the figures and the claims of the report |
//! | `trajectory` | trajectories compared by the maps that they make of the same scans |
//! | `filter` | the expected map of a filter's log, step by step |
//! | `commands` | the arguments, and what they ask for |
//! | `run` | the command as a function |

#[doc(hidden)]
pub mod check;
#[doc(hidden)]
pub mod commands;
#[doc(hidden)]
pub mod convergence;
mod failure;
#[doc(hidden)]
pub mod filter;
#[doc(hidden)]
pub mod limits;
mod metres;
#[doc(hidden)]
pub mod output;
#[doc(hidden)]
pub mod paper;
#[doc(hidden)]
pub mod plots;
mod progress;
#[doc(hidden)]
pub mod reading;
mod run;
#[doc(hidden)]
pub mod series;
#[doc(hidden)]
pub mod simulation;
mod sweep;
#[doc(hidden)]
pub mod trajectory;

pub use failure::Failure;
pub use run::run;
