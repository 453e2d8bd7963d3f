//! The settings of a rigorous integration.

use crate::error::Error;
use crate::quadrature::tolerance::{Finest, Tolerance};
use crate::real::Real;

/// Rigorous integration: the wanted width and the work it may take, and [`integrate`](Self::integrate).
///
/// `∫ f(x) dx` over a finite interval, between two floats. The result contains the integral whatever is asked for; a
/// tolerance only says when to stop. The width is first that of the enclosure as computed, in 128 bits; rounding to `T`
/// adds at most 1 ulp at each end.
///
/// ```
/// use mean_information::quadrature::rigorous::Rigorous;
/// use mean_information::scalar::{Integrand, Scalar};
///
/// /// `1 / (1 + x^2)`, whose integral from 0 to 1 is `π/4`.
/// struct Witch;
/// impl Integrand for Witch {
///     fn evaluate<S: Scalar>(&self, x: S) -> S {
///         S::constant(1.0) / (S::constant(1.0) + x.clone() * x)
///     }
/// }
/// let quarter = Rigorous::<f64>::default().integrate(&Witch, 0.0, 1.0)?;
/// assert!(quarter.contains(core::f64::consts::FRAC_PI_4) && quarter.width() <= 2.3e-16);
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigorous<T> {
    tolerance: Tolerance<T>,
    pub(super) limit: u64,
}

impl<T: Real> Default for Rigorous<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real> Rigorous<T> {
    /// Returns the finest relative tolerance, a 64th of the distance from 1 to the next float: with it, rounding to `T`
    /// makes the width (a 16th of the spacing below 1/2, where a limit of 1 minus the integral shows no more).
    pub(crate) fn finest() -> T {
        T::epsilon() * T::from_parts(1, -6)
    }

    /// Creates the settings of the finest tolerance that `T` can tell, and at most 100 000 evaluations.
    pub fn new() -> Self {
        Self { tolerance: Tolerance { absolute: T::zero(), relative: Self::finest() }, limit: 100_000 }
    }

    /// Sets the width relative to the magnitude of the integral: 0 for none, or from a 64th of the spacing of floats at
    /// 1 (`2^-58` in `f64`, `2^-29` in `f32`) up to 1.
    #[must_use]
    pub fn relative(self, relative: T) -> Self {
        Self { tolerance: Tolerance { relative, ..self.tolerance }, ..self }
    }

    /// Sets the absolute width, in units of the integral: 0 for none, or any positive number.
    #[must_use]
    pub fn absolute(self, absolute: T) -> Self {
        Self { tolerance: Tolerance { absolute, ..self.tolerance }, ..self }
    }

    /// Sets the largest number of evaluations, 1 or more; some 20 are made in any case.
    #[must_use]
    pub fn limit(self, limit: u64) -> Self {
        Self { limit, ..self }
    }

    /// Returns the tolerance that was asked for.
    pub(crate) fn tolerance(&self) -> Tolerance<T> {
        self.tolerance
    }

    /// Refuses settings that no result can meet.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let allowed = "0, or from 2^-58 (f32: 2^-29) up to 1";
        self.tolerance.check(&Finest { relative: Self::finest(), allowed })?;
        if self.limit == 0 {
            return Err(Error::out_of_range("evaluation limit", 0.0, "1 or more"));
        }
        Ok(())
    }
}
