//! Logs of range scans in the plane, read record by record.
//!
//! A [`RangeScan`] is one record: its time, the ranges as the file has them, their bearings, and the poses beside them.
//! The numbers in a range's place that are no range mean, in every format:
//!
//! | number `r` | is | in a scan |
//! |---|---|---|
//! | from the least range of the sensor, above 0, and below the greatest | a return | a beam with this range |
//! | the greatest range and more, infinity | no return within the greatest range | as [`NoReturn`] says |
//! | 0, negative, minus infinity, below the least range | nothing: too near, or an error code | no beam |
//! | NaN | nothing: the reading failed | no beam |
//!
//! The greatest range is the caller's ([`ScanOptions::maximum_range`]), or else the file's own: of the record
//! (`ROBOTLASER1`), of the log (`PARAM robot_front_laser_max`), or else [`carmen::MAXIMUM_RANGE`]. The last two rows are
//! those of ROS (REP 117) and of GMapping. Of the messages of bags finite ranges above the sensor's own greatest are nothing
//! (REP 117), and the greatest itself is no return: drivers wrote it for that before the REP, which counts it as a return.
//! Where a message has an infinite greatest range and the caller none, infinity is nothing, too.

pub mod carmen;
mod kept;
mod log;
mod mount;
mod options;
mod range_scan;

pub(crate) use kept::Kept;
pub use log::{Frame, RecordedTrajectory, ScanLog};
pub(crate) use options::FARTHEST;
pub use options::{ScanOptions, Selection, TimeField};
pub use range_scan::{Bearings, NoReturn, RangeScan, Reading};
