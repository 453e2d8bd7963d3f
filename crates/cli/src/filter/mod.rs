//! The log of a particle filter, measured step by step: the mean information of the expected map (EMMI), the particles' own, and
//! how many particles count (`docs/expected.md`).

mod chart;
mod report;
mod steps;

pub use chart::chart;
pub use report::{FilterReport, Made};
pub use steps::{Refused, Row, measure};
