//! Ziv's strategy: a value is rounded from its enclosure, and compared with a midpoint only if the enclosure holds one.
//!
//! Here are also the two ways in which arguments are taken apart, `|x| = m 2^e`, and the range beyond which no
//! exponential needs a computation.

use super::round::{FixedEnclosure, Midpoint, Rounded};
use crate::real::Real;

/// Rounds the value in the enclosure to the nearest float; calls `is_above`, which says whether the value lies above a
/// midpoint, only if the enclosure holds that midpoint.
#[inline]
pub(super) fn round_to_nearest<T: Real>(value: FixedEnclosure, is_above: impl FnOnce(Midpoint) -> bool) -> T {
    match value.round() {
        Rounded::Decided(x) => x,
        Rounded::Between { below, above, midpoint } => {
            if is_above(midpoint) {
                above
            } else {
                below
            }
        }
    }
}

/// Returns `m` and `e` with `|x| = m 2^e` and `m` in `[2^52, 2^53)`, for `x` finite and not 0.
pub(crate) fn normalised<T: Real>(x: T) -> (u64, i32) {
    let (m, e) = x.parts();
    let shift = m.leading_zeros() as i32 - 11;
    (m << shift, e - shift)
}

/// Returns `m` and `e` with `|x| = m 2^e` and `m` odd, for `x` finite; `None` for 0.
pub(crate) fn odd_parts<T: Real>(x: T) -> Option<(u64, i32)> {
    let (m, e) = x.parts();
    let zeros = m.trailing_zeros();
    (m != 0).then(|| (m >> zeros, e + zeros as i32))
}

/// Returns true if `|l| >= 2^10`: then `e^-|l| < 2^-1477`, so that `H`, `1 - p` and `e^-|l|` are below half of the
/// smallest subnormal, and `e^|l|` is above the largest number.
pub(super) fn beyond_exponential<T: Real>(l: T) -> bool {
    l.abs().widen() >= 1024.0
}
