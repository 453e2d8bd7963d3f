//! The limit of the mean information as cells shrink (Eqs. 6 and 7), and how far a grid can be from it.

pub mod bounds;
mod closed_form;
mod model;
mod repeated;
mod upwards;

pub use closed_form::closed_form;
pub use model::{Piece, RadialModel};
pub use repeated::RepeatedScans;

/// Which cells the limit belongs to: the weight of the integral in Eq. 6.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weight {
    /// Cells of equal `dρ dθ`: polar maps. The limit of the report's Eq. 7.
    Radial,
    /// Cells of equal area `ρ dρ dθ`: Cartesian grids.
    Area,
}
