//! Trajectories in the plane: poses by their times, read from TUM text, and asked for a pose at a time.
//!
//! TUM text has a pose a line, `time x y z qx qy qz qw` in seconds and metres, with a quaternion for the orientation.
//! Of the orientation the yaw is kept,
//!
//! `yaw = atan2(2 (w z + x y), w² + x² - y² - z²)`,
//!
//! and of the position `x` and `y`.

mod association;
mod poses;
mod quaternion;
mod rigid;
mod tilts;
pub mod tum;

pub use association::Association;
pub(crate) use association::part;
pub use poses::{Trajectory, seconds};
pub(crate) use poses::{check_time, compose};
pub(crate) use quaternion::Quaternion;
pub(crate) use rigid::Rigid;
pub(crate) use tilts::Tilts;
