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
    pub(super) fn new(x: T) -> Self {
        Self { sum: x, lost: T::zero() }
    }

    #[must_use]
    pub(super) fn plus(self, x: T) -> Self {
        let sum = self.sum + x;
        let of_x = sum - self.sum;
        let lost = (self.sum - (sum - of_x)) + (x - of_x);
        Self { sum, lost: self.lost + lost }
    }

    #[must_use]
    pub(super) fn merged(self, other: Self) -> Self {
        let Self { sum, lost } = self.plus(other.sum);
        Self { sum, lost: lost + other.lost }
    }

    pub(super) fn value(self) -> T {
        self.sum + self.lost
    }
}
