//! Trajectories compared by the maps that they make of the same scans, without ground truth
//! (`docs/evidence.md`).
//!
//! [`SensorModel`] says what a beam means, [`Setup`] how maps are made; [`Common`] finds the scans for which every
//! [`Candidate`] has a pose; [`measure_all`] measures the map of each, by several threads; [`Comparison`] has the rows, and
//! [`Pictures`] draws them.

mod alike;
mod common;
mod comparison;
mod constant;
mod contradictions;
mod labels;
mod laser;
mod measure;
mod motion;
mod page;
mod parting;
mod pictures;
mod recorded;
mod row;
mod sensor;
mod setup;
mod verdict;
mod warnings;

pub use common::{Candidate, Common, far_pose};
pub use comparison::Comparison;
pub use contradictions::Contradiction;
pub use labels::labels;
pub use laser::Laser;
pub use measure::{BLOCKS, Measured, Wanted, measure, measure_all};
pub use parting::Parting;
pub use pictures::Pictures;
pub use recorded::Recorded;
pub use row::{Row, Used};
pub use sensor::{BeamModel, SensorModel};
pub use setup::{Refused, Setup};
