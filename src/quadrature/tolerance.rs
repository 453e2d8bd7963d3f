//! The wanted error of an integral: absolute, or relative to its magnitude, whichever is larger.

use crate::error::Error;
use crate::real::Real;

/// A tolerance as it was asked for: not yet checked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tolerance<T> {
    pub(crate) absolute: T,
    pub(crate) relative: T,
}

/// The finest relative tolerance of a method, and the words that refuse a finer one.
pub(super) struct Finest<T> {
    pub(super) relative: T,
    pub(super) allowed: &'static str,
}

impl<T: Real> Tolerance<T> {
    /// Returns the error that is tolerated in an integral of the given magnitude.
    pub(crate) fn of(self, magnitude: T) -> T {
        self.absolute.max(self.relative * magnitude)
    }

    /// Refuses a tolerance that no result can meet.
    pub(super) fn check(self, finest: &Finest<T>) -> Result<(), Error> {
        let refused = |what, value: T, allowed| Err(Error::out_of_range(what, value.widen(), allowed));
        let Self { absolute, relative } = self;
        // Written so that NaN is refused, too.
        if !(absolute >= T::zero() && absolute.is_finite()) {
            return refused("absolute tolerance", absolute, "0, or positive and finite");
        }
        if !(relative.is_zero() || relative >= finest.relative && relative <= T::one()) {
            return refused("relative tolerance", relative, finest.allowed);
        }
        if absolute.is_zero() && relative.is_zero() {
            return refused("tolerance", T::zero(), "a positive absolute or relative one");
        }
        Ok(())
    }
}
