//! The properties that fuzzing tries to break: each takes any bytes and panics if one does not hold.
//!
//! `fuzz/` has a target for each; `cargo test` replays the committed seeds on them, on stable.
#![allow(clippy::missing_panics_doc, reason = "a property panics if it does not hold")]

#[cfg(feature = "formats")]
mod bags;
mod builders;
#[cfg(feature = "formats")]
mod filters;
#[cfg(feature = "formats")]
mod formats;
mod grid;
mod integral;
#[cfg(feature = "formats")]
mod octrees;
mod room;
#[cfg(feature = "formats")]
mod scans;
mod tally;

#[cfg(feature = "formats")]
pub use bags::{bag, bag_folder, db3, pbstream};
pub use builders::{expected, scan};
#[cfg(feature = "formats")]
pub use filters::filter_log;
#[cfg(feature = "formats")]
pub use formats::{decoded, gridmap, npy, npz, pgm, png, stack, yaml};
pub use grid::grid;
pub use integral::integrate;
#[cfg(feature = "formats")]
pub use octrees::octree;
pub use room::room;
#[cfg(feature = "formats")]
pub use scans::{carmen_log, trajectory};
