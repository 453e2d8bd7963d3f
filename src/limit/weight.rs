//! The weight of the integral in Eq. 6.

/// The weight of the integral in Eq. 6, which says for which cells the limit is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Weight {
    /// The weight of cells of equal `dρ dθ`: polar maps. It gives the limit of the report's Eq. 7.
    Radial,
    /// The weight of cells of equal area `ρ dρ dθ`: Cartesian grids.
    Area,
}
