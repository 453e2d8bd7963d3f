//! The circular room of the report: a sensor at its centre reads the same range in every direction, so that `p` depends on
//! the distance only.
//!
//! Eq. 4 of its maps: [`PolarRoom`] has cells of equal `dr dtheta`, which tend to Eq. 7; [`CartesianRoom`] has squares, which
//! tend to the limit by area. What is rounded, and how, is the chapter [`grids`](crate::book::grids).

mod axis;
mod cartesian;
mod polar;
mod sampling;

pub use cartesian::CartesianRoom;
pub use polar::PolarRoom;
pub use sampling::Sampling;
