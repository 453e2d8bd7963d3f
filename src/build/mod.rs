//! Grid builders: the maps that an inverse sensor model gives.
//!
//! What is rounded, and how, is the chapter [`grids`](crate::book::grids).

mod room;

pub use room::{CartesianRoom, PolarRoom, Sampling};
