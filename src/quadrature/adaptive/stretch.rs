//! An interval of arguments, and where the nodes of a rule fall in it.

use crate::real::Real;

/// The arguments from `lower` to `upper`, both finite, `lower < upper`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch<T> {
    pub(super) lower: T,
    pub(super) upper: T,
}

impl<T: Real> Stretch<T> {
    /// Returns the middle, also where the sum of the ends is no float.
    pub(super) fn midpoint(self) -> T {
        // Halves first where the sum overflows.
        let sum = self.lower + self.upper;
        if sum.is_finite() { sum * T::HALF } else { self.lower * T::HALF + self.upper * T::HALF }
    }

    /// Returns `x (upper - lower)`, also where the width is no float.
    pub(super) fn widths(self, x: T) -> T {
        // Half the width times twice the factor, where the width overflows.
        let width = self.upper - self.lower;
        if width.is_finite() { width * x } else { (self.upper * T::HALF - self.lower * T::HALF) * (x + x) }
    }

    /// Returns the images of the nodes `-node` and `node` of `[-1, 1]`.
    pub(super) fn pair(self, node: T) -> [T; 2] {
        let (middle, offset) = (self.midpoint(), self.widths(node * T::HALF));
        // Rounding must not carry a node over an end.
        [(middle - offset).max(self.lower), (middle + offset).min(self.upper)]
    }

    /// Cuts the stretch at an argument.
    pub(super) fn cut_at(self, x: T) -> [Self; 2] {
        [Self { upper: x, ..self }, Self { lower: x, ..self }]
    }

    /// Cuts the stretch in the middle.
    pub(super) fn halves(self) -> [Self; 2] {
        self.cut_at(self.midpoint())
    }

    /// Returns true if floats are dense enough for the outermost nodes to stay off the ends, by some 8 spacings: with
    /// fewer, their rounding would show in how a singularity at the end converges.
    pub(super) fn has_room_for(self, outermost: T) -> bool {
        // Measured on the nodes as they are rounded.
        let [first, last] = self.pair(outermost);
        let room = T::from_parts(8, 0) * T::epsilon() * self.magnitude();
        first - self.lower > room && self.upper - last > room
    }

    /// Returns the largest magnitude of an argument.
    pub(super) fn magnitude(self) -> T {
        self.lower.abs().max(self.upper.abs())
    }
}
