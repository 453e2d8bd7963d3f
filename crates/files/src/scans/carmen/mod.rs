//! CARMEN logs: a message a line, `NAME fields… ipc_timestamp host logger_timestamp`.
//!
//! | message | is read as |
//! |---|---|
//! | `FLASER n r₁ … rₙ x y θ odom_x odom_y odom_θ` | a scan, the pose of the laser, the pose of the robot by odometry |
//! | `ROBOTLASER1 type start fov step max accuracy mode n r₁ … rₙ m e₁ … eₘ x y θ odom_x odom_y odom_θ tv rv front side turn` | the same, with its own bearings and greatest range |
//! | `ODOM x y θ tv rv accel` | a pose by odometry |
//! | `PARAM name value` | see below; without the three fields of time at will |
//! | `RLASER`, `ROBOTLASER2`, `RAWLASER…`, `SYNC`, `TRUEPOS`, `#` and an empty line | nothing: passed over |
//!
//! Lines of any other first word are passed over and counted in
//! [`LinesNotUnderstood`](crate::Warning::LinesNotUnderstood).
//!
//! The beams of an `FLASER` are at equal angles about the heading. `PARAM laser_front_laser_resolution` has their distance
//! in degrees, and `laser_front_laser_fov`, if it is there, must fit. Without it the number of beams decides, as in CARMEN:
//!
//! | beams | first bearing | distance |
//! |---|---|---|
//! | 180, 181 | -90° | 1° |
//! | 360, 361 | -90° | 0.5° |
//! | 400, 401 | -50° | 0.25° |
//!
//! A greatest range from 81.83 to 82 m, in a message or a parameter, means 81.83 m: SICK's scanners send 81.83 m and more as
//! codes for errors and for no return.
//!
//! Further parameters: `robot_front_laser_max` is the greatest range (metres), `robot_frontlaser_offset`,
//! `robot_frontlaser_side_offset` and `robot_frontlaser_angular_offset` are the mount of the laser (metres, radians). A log
//! of `ROBOTLASER1` without them has the mount that lies between the poses of laser and robot, if it is the same in all.

mod message;
mod parameters;
mod records;
mod write;

pub use parameters::MAXIMUM_RANGE;
pub(crate) use parameters::{customary_bearings, stated_maximum_range};
pub use records::{Record, Records};
pub use write::write;
