//! GMapping's log of its own particles: `.gfs`, a line for each thing that happened.
//!
//! | line | is read as |
//! |---|---|
//! | `LASER_READING n r₁ … rₙ x y θ t` | a scan that was matched, at the bearings of [CARMEN](crate::scans::carmen)'s; the pose by odometry, the time in seconds |
//! | `SM_UPDATE n (x y θ w)…` | the pose of each particle after it was matched, and the *logarithm* of its weight |
//! | `NEFF e` | how many particles count, as GMapping computed it |
//! | `RESAMPLE n i…` | from now on particle `k` continues particle `iₖ`, with its trajectory and its map |
//! | `PARAM ogain g`, `PARAM maxrange m` | the gain of the weights, the greatest range in metres |
//! | `ODO_UPDATE n (x y θ w)… t` | its number of particles must be that of the others; poses between scans are passed over |
//! | `ODOM`, `FRAME`, `SIMULATOR_POS`, `ENTROPY`, `COMMENT`, other `PARAM`, `#` and an empty line | nothing: passed over |
//!
//! Where the number of beams is even, GMapping itself has none at 0: those from there on lie a step further on than CARMEN's. The
//! number of particles never changes: GMapping's programs ask for no other, though its library could. A last line without an end
//! is left out where its last number may be cut. Lines of any other first word are passed over and counted. The first scan of a
//! run is not in the log: GMapping writes a scan only after it was matched against a map.
//!
//! The logarithms add up from one resampling to the next. What GMapping weighs particles by is
//! `exp((w - max w) / (g n))` for `n` particles ([`FilterStep::weights`]): without the divisor, which tempers them, one
//! particle would have all the weight after a few scans.

mod log;
mod reader;
mod step;

pub use log::FilterLog;
pub use step::FilterStep;
