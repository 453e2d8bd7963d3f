//! Sums that keep what their additions lose (Knuth's two-sum; Ogita, Rump and Oishi's `Sum2`).

use crate::real::Real;

/// A sum and what rounding has taken from it: `sum + lost` is as good as if computed with twice the digits and
/// rounded once.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Compensated<T> {
    sum: T,
    lost: T,
}

impl<T: Real> Compensated<T> {
    /// Creates the sum of one term.
    pub(super) fn new(x: T) -> Self {
        Self { sum: x, lost: T::zero() }
    }

    /// Adds a term.
    #[must_use]
    pub(super) fn plus(self, x: T) -> Self {
        let sum = self.sum + x;
        // Knuth's two-sum: what the addition has lost, exactly.
        let of_x = sum - self.sum;
        let lost = (self.sum - (sum - of_x)) + (x - of_x);
        // The losses are of the second order: what their own sum loses is of the third.
        Self { sum, lost: self.lost + lost }
    }

    /// Adds another sum.
    #[must_use]
    pub(super) fn merged(self, other: Self) -> Self {
        // What adding both sums loses, and what either has lost before.
        let Self { sum, lost } = self.plus(other.sum);
        Self { sum, lost: lost + other.lost }
    }

    /// Returns the sum, rounded once.
    pub(super) fn value(self) -> T {
        self.sum + self.lost
    }
}
