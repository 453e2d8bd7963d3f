//! The limit of the mean information as cells shrink (Eqs. 6 and 7), and how far a grid can be from it.

mod adaptive;
pub mod bounds;
mod closed_form;
mod deficit;
mod model;
mod repeated;
mod rigorous;
mod upwards;

pub use adaptive::adaptive;
pub use closed_form::closed_form;
pub use model::{Piece, RadialModel};
pub use repeated::RepeatedScans;
pub use rigorous::rigorous;

/// Which cells the limit belongs to: the weight of the integral in Eq. 6.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weight {
    /// Cells of equal `dρ dθ`: polar maps. The limit of the report's Eq. 7.
    Radial,
    /// Cells of equal area `ρ dρ dθ`: Cartesian grids.
    Area,
}
