//! Fusion of independent observations of one place, with prior 1/2: log-odds add.

use crate::cell::in_unit_interval;
use crate::error::Error;
use crate::real::Real;
use crate::rounded;

/// Fuses independent observations of one place, each made with prior 1/2, into its occupancy
/// `p = prod p_i / (prod p_i + prod (1 - p_i))`: the log-odds `ln(p_i / (1 - p_i))` add.
///
/// Correctly rounded, ties to even (proved, [`fusion`](crate::book::fusion)): the order of the observations changes
/// no bit.
///
/// Special cases: no observations give 1/2; observations of 1/2 change nothing; one observation is returned as it is; a
/// certain observation, 0 or 1, outweighs all uncertain ones.
///
/// # Errors
/// [`Error::Item`] naming the first observation that is NaN or outside `[0, 1]`; [`Error::Contradiction`] if one says
/// 0 and another says 1: then the formula is 0/0.
///
/// ```
/// use mean_information::fusion::fuse;
/// assert_eq!(fuse(&[0.75, 0.75, 0.25_f64])?, 0.75);
/// assert_eq!(fuse(&[0.7, 0.9, 0.4_f64])?, 0.9333333333333333); // odds 7/3 * 9 * 2/3 = 14
/// assert_eq!(fuse(&[0.0, 0.9, 0.4_f64])?, 0.0);
/// # Ok::<(), mean_information::Error>(())
/// ```
pub fn fuse<T: Real>(observations: &[T]) -> Result<T, Error> {
    let outside = |&p: &T| !in_unit_interval(p);
    if let Some(index) = observations.iter().position(outside) {
        let value = observations[index].widen();
        return Err(Error::Item { what: "observation", index, value, allowed: "0 to 1" });
    }
    let first = |certain: T| observations.iter().position(|&p| p == certain);
    match (first(T::zero()), first(T::one())) {
        (Some(free), Some(occupied)) => Err(Error::Contradiction { free, occupied }),
        (Some(_), None) => Ok(T::zero()),
        (None, Some(_)) => Ok(T::one()),
        (None, None) => Ok(rounded::fused(observations.iter().copied())),
    }
}
