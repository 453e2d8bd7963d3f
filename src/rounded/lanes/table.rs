//! Value and slope at the centres, to twice the precision.

use super::format::{HALF, Lane};
use crate::rounded::constants::INV_LN2;
use crate::rounded::fixed::mul_high;
use crate::rounded::mean::{self, Fixed};
use crate::rounded::{enclose, log_odds, round_integer};
use alloc::boxed::Box;
use alloc::vec::Vec;

/// What the kernel knows of a centre `c`: of the information at `d = c`, in the second half; in the first of the
/// entropy at
/// `q = c / 2`, or, if no entropy is asked for, of the information there.
///
/// Four arrays, since one load of a vector unit gathers from one array.
pub(crate) struct Table<T: Lane> {
    /// The value `V`, rounded.
    pub(super) value: Box<[T; 2 * HALF]>,
    /// `dV/dc`, rounded.
    pub(super) slope: Box<[T; 2 * HALF]>,
    /// What rounding took from both.
    pub(super) low: Box<[T::Word; 2 * HALF]>,
    /// `1 / (2 q (1 - q))` with the sign of the curvature of `V`.
    pub(super) inverse: Box<[T; 2 * HALF]>,
}

impl<T: Lane> Table<T> {
    pub(super) fn new(entropy: bool) -> Self {
        let mut rows = Vec::with_capacity(2 * HALF);
        for small in [true, false] {
            let centres = (0..HALF).map_while(T::centre_of).map(|c| Row::new(c, small, entropy));
            rows.extend(centres);
            rows.resize(if small { HALF } else { 2 * HALF }, Row::default());
        }
        let column = |of: fn(&Row<T>) -> T| Box::new(core::array::from_fn(|k| of(&rows[k])));
        Self {
            value: column(|row| row.value),
            slope: column(|row| row.slope),
            inverse: column(|row| row.inverse),
            low: Box::new(core::array::from_fn(|k| rows[k].low)),
        }
    }
}

#[derive(Clone, Copy, Default)]
struct Row<T: Lane> {
    value: T,
    slope: T,
    low: T::Word,
    inverse: T,
}

impl<T: Lane> Row<T> {
    fn new(c: T, small: bool, with_entropy: bool) -> Self {
        // Both exact: a centre has few bits.
        let q = if small { c.widen() / 2.0 } else { (1.0 - c.widen()) / 2.0 };
        let (m, e) = crate::rounded::normalised(q);
        let (entropy, information) = enclose::from_occupancy(m, e);
        let concave = small && with_entropy;
        let (value, value_low) = pair(mean::middle(if concave { entropy } else { information }));
        // |dV/dq| = |l| / ln 2, and dq/dc = ±1/2.
        let magnitude = log_odds::magnitude(m, -e);
        let slope = Fixed { value: mul_high(magnitude.value, INV_LN2), exponent: magnitude.exponent };
        let (slope, slope_low) = pair::<T>(slope);
        let falls = small && !with_entropy;
        let (slope, slope_low) = if falls { (-slope, -slope_low) } else { (slope, slope_low) };
        let inverse = T::nearest(0.5 / (q * (1.0 - q)));
        let inverse = if concave { -inverse } else { inverse };
        Self { value, slope, low: T::pack(value_low, slope_low), inverse }
    }
}

/// The nearest float, and the float nearest to what is left.
fn pair<T: Lane>(x: Fixed) -> (T, T) {
    let nearest: T = round_integer(x.value, x.exponent, false);
    let (m, e) = nearest.parts();
    let units = u128::from(m) << (e - x.exponent);
    let rest: T = round_integer(x.value.abs_diff(units), x.exponent, false);
    (nearest, if x.value < units { -rest } else { rest })
}
