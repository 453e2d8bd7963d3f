//! The limit of the mean information as cells shrink (Eqs. 6 and 7), and bounds on the distance of a grid from it.

mod adaptive;
pub mod bounds;
mod closed_form;
mod deficit;
mod model;
mod repeated;
mod rigorous;
mod upwards;
mod weight;

pub use adaptive::adaptive;
pub use closed_form::closed_form;
pub use model::{Piece, RadialModel};
pub use repeated::RepeatedScans;
pub use rigorous::rigorous;
pub use weight::Weight;
