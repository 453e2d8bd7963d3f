//! Break points that crowd towards a point.

use crate::error::Error;
use crate::real::Real;
use alloc::vec::Vec;

/// The largest number of panels that are graded: an `f64` halved that often has long been 0.
const MOST: usize = 10_000;

/// Returns break points from `from` to `towards` whose panels shrink geometrically: `towards + (from - towards)
/// ratio^k` for `k = 0, 1, ..., panels - 1`, and `towards`. In ascending order, whichever end is the upper.
///
/// For [`integrate_between`](super::GaussKronrod::integrate_between): towards a singularity, to spare the halvings
/// that would find it; towards the end where the mass of a long interval lies.
///
/// **Error**: each point is within `(k + 2) ε` of the largest magnitude of the ends, `ε` being the spacing of floats at 1
/// (proved: by IEEE 754 the distance, at most
/// twice that magnitude, is rounded `k + 1` times by half an `ε`, and the sum once). Points
/// that coincide are harmless, and left.
///
/// # Errors
/// [`Error::OutOfRange`] if an end is not finite, `ratio` not in (0, 1), or `panels` not in 1 to 10 000.
///
/// ```
/// use mean_information::quadrature::adaptive::graded;
/// assert_eq!(graded(0.0, 2.0, 0.25, 4)?, [0.0, 1.5, 1.875, 1.96875, 2.0]);
/// assert_eq!(graded(1000.0, 0.0, 0.125, 4)?, [0.0, 1.953125, 15.625, 125.0, 1000.0]);
/// # Ok::<(), mean_information::Error>(())
/// ```
pub fn graded<T: Real>(from: T, towards: T, ratio: T, panels: usize) -> Result<Vec<T>, Error> {
    for end in [from, towards] {
        if !end.is_finite() {
            return Err(Error::out_of_range("end of a grading", end.widen(), "finite numbers"));
        }
    }
    if !(ratio > T::zero() && ratio < T::one()) {
        return Err(Error::out_of_range("ratio of a grading", ratio.widen(), "above 0 and below 1"));
    }
    if !(1..=MOST).contains(&panels) {
        return Err(Error::out_of_range("number of panels", panels as f64, "1 to 10000"));
    }
    // Half of each: the distance of two floats may be none.
    let (half, distance) = (towards * T::HALF, from * T::HALF - towards * T::HALF);
    let (low, high) = (from.min(towards), from.max(towards));
    let mut points = Vec::with_capacity(panels + 1);
    let mut power = T::one();
    for _ in 0..panels {
        let point = half + distance * power;
        // Doubled back, and kept between the ends.
        points.push((point + point).max(low).min(high));
        // One more rounding of the distance: the k of the bound.
        power = power * ratio;
    }
    // The ends exactly: half of a subnormal number may be rounded.
    points[0] = from;
    points.push(towards);
    // Break points ascend.
    if towards < from {
        points.reverse();
    }
    Ok(points)
}
