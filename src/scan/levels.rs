//! Where the model of a beam says one thing, by squares of distances: most cells need neither the distance nor the model.

use super::lattice::Lattice;
use crate::real::Real;
use crate::sensor::InverseSensorModel;

/// The levels of the model of one beam, and the squares of the distances in units, as floats, from and to which cells have them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Levels<T> {
    /// The occupancy up to the square `plateau`.
    pub(super) nearest: T,
    plateau: f64,
    /// The occupancy from the first to the second square.
    pub(super) wall: T,
    obstacle: [f64; 2],
    /// The square from which on nothing is observed.
    beyond: f64,
}

impl<T: Real> Levels<T> {
    /// Finds the levels of a model that gives the occupancy `nearest` up to `plateau` units and reaches so far.
    #[inline]
    pub(super) fn new<M: InverseSensorModel<Float = T>>(
        lattice: Lattice,
        model: &M,
        reach: T,
        nearest: T,
        plateau: u64,
    ) -> Self {
        let (obstacle, wall) = match model.obstacle() {
            Some(([from, to], p)) => {
                ([lattice.square_beyond(from.widen()), lattice.square_within(to.widen())], p)
            }
            None => ([1.0, 0.0], T::HALF),
        };
        // A distance beyond the next float is beyond this one when it is rounded.
        let next = reach + (reach * T::epsilon() + T::min_positive_value());
        let (plateau, beyond) = (plateau as f64, lattice.square_beyond(next.widen()));
        Self { nearest, plateau: plateau * plateau, wall, obstacle, beyond }
    }

    /// Returns the occupancy of a cell by the square of the distance of its centre, within `2^-51` of it; `None` where the model is to
    /// be asked (`scan.md`, Theorem (levels)).
    #[inline]
    pub(super) fn at(&self, square: f64) -> Option<T> {
        if self.is_near(square) {
            Some(self.nearest)
        } else if self.is_wall(square) {
            Some(self.wall)
        } else {
            self.is_beyond(square).then_some(T::HALF)
        }
    }

    /// Tells whether a cell surely has the occupancy `nearest`.
    #[inline]
    pub(super) fn is_near(&self, square: f64) -> bool {
        square <= self.plateau
    }

    /// Tells whether a cell surely has the occupancy `wall`, unless it has the other.
    #[inline]
    pub(super) fn is_wall(&self, square: f64) -> bool {
        self.obstacle[0] <= square && square <= self.obstacle[1]
    }

    /// Tells whether a cell surely is beyond all.
    #[inline]
    pub(super) fn is_beyond(&self, square: f64) -> bool {
        square >= self.beyond
    }
}
