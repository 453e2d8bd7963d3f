//! The table of occupancies: value and slope of entropy and information at the centres, to twice the precision of `f64`. The kernels
//! of `f32` take the leading float of each.

use super::format::{HALF, Lane, Split};
use crate::real::Real;
use crate::rounded::beyond_float::{self, Both, Fixed};
use crate::rounded::constants::INV_LN2;
use crate::rounded::fixed::mul_high;
use crate::rounded::round::round_integer;
use crate::rounded::{approximate, log_odds};
use alloc::boxed::Box;
use alloc::vec::Vec;
use core::iter::repeat_n;

/// Holds what the kernels know of a centre `c`, in three thirds: of the entropy at `q = c / 2`, of the information at the
/// distance `c` from unknown, and of the information at `q = c / 2`. A kernel needs two that are next to each other.
///
/// Four arrays, since one load of a vector unit gathers from one array.
pub(crate) struct Table {
    value: Box<[f64; 3 * HALF]>,
    slope: Box<[f64; 3 * HALF]>,
    low: Box<[u64; 3 * HALF]>,
    inverse: Box<[f64; 3 * HALF]>,
}

/// Refers to the two thirds of a [`Table`] that a kernel needs.
pub(super) struct Rows<'a> {
    /// Holds the value `V`, rounded.
    pub(super) value: &'a [f64; 2 * HALF],
    /// Holds the slope `dV/dc`, rounded.
    pub(super) slope: &'a [f64; 2 * HALF],
    /// Holds what rounding took from both, packed into one word.
    pub(super) low: &'a [u64; 2 * HALF],
    /// Holds `1 / (2 q (1 - q))` with the sign of the curvature of `V`.
    pub(super) inverse: &'a [f64; 2 * HALF],
}

impl Table {
    /// Computes the table.
    pub(super) fn new() -> Self {
        let mut rows: Vec<Row> = repeat_n(Row::default(), 3 * HALF).collect();
        for (k, c) in (0..HALF).map_while(f64::centre_of).enumerate() {
            [rows[k], rows[2 * HALF + k]] = Row::small(c);
            rows[HALF + k] = Row::near(c);
        }
        let column = |of: fn(&Row) -> f64| Box::new(core::array::from_fn(|k| of(&rows[k])));
        Self {
            value: column(|row| row.value),
            slope: column(|row| row.slope),
            inverse: column(|row| row.inverse),
            low: Box::new(core::array::from_fn(|k| rows[k].low)),
        }
    }

    /// Returns the rows for a kernel with entropies or without.
    #[inline(always)]
    pub(super) fn rows<const ENTROPY: bool>(&self) -> Rows<'_> {
        Rows {
            value: two_thirds::<_, ENTROPY>(&self.value),
            slope: two_thirds::<_, ENTROPY>(&self.slope),
            low: two_thirds::<_, ENTROPY>(&self.low),
            inverse: two_thirds::<_, ENTROPY>(&self.inverse),
        }
    }
}

/// Returns the row of a centre by its number among those near unknown or among the others.
#[inline(always)]
pub(super) fn row<const ENTROPY: bool>(number: u32, near: bool) -> usize {
    (number + if near == ENTROPY { HALF as u32 } else { 0 }) as usize % (2 * HALF)
}

/// Returns the first two thirds, or the last two.
#[inline(always)]
fn two_thirds<X, const FIRST: bool>(all: &[X; 3 * HALF]) -> &[X; 2 * HALF] {
    let two = if FIRST { all.first_chunk() } else { all.last_chunk() };
    two.expect("three thirds have two")
}

/// Holds one row of the table.
#[derive(Clone, Copy, Default)]
struct Row {
    value: f64,
    slope: f64,
    low: u64,
    inverse: f64,
}

impl Row {
    /// Computes the rows of the entropy, which is concave, and of the information, which falls, at `q = c / 2`.
    fn small(c: f64) -> [Self; 2] {
        let ((entropy, information), slope, inverse) = around(c / 2.0);
        [Self::new(entropy, slope, -inverse, false), Self::new(information, slope, inverse, true)]
    }

    /// Computes the row of the information at the distance `c` from unknown.
    fn near(c: f64) -> Self {
        let ((_, information), slope, inverse) = around((1.0 - c) / 2.0);
        Self::new(information, slope, inverse, false)
    }

    /// Rounds a row: each of value and slope to a float and its rest.
    fn new(value: Fixed, slope: Fixed, inverse: f64, falls: bool) -> Self {
        let (value, value_low) = pair(value);
        let (slope, slope_low) = pair(slope);
        let (slope, slope_low) = if falls { (-slope, -slope_low) } else { (slope, slope_low) };
        Self { value, slope, low: f64::pack(value_low, slope_low), inverse }
    }
}

/// Computes entropy and information at `q`, the magnitude of their slopes, and that of their curvature's factor. `q` is
/// exact: a centre has few bits.
fn around(q: f64) -> (Both, Fixed, f64) {
    let (m, e) = crate::rounded::ziv::normalised(q);
    let (entropy, information) = approximate::from_occupancy(m, e);
    // Series: |dV/dq| = |l| / ln 2, and dq/dc = ±1/2: the scale 127 of the constant, of which 128 are dropped.
    let magnitude = log_odds::magnitude(m, -e);
    let slope = Fixed { value: mul_high(magnitude.value, INV_LN2), exponent: magnitude.exponent };
    // Error, `v(c)`: the middle of an enclosure.
    ((beyond_float::middle(entropy), beyond_float::middle(information)), slope, inverse(q))
}

/// Computes `1 / (2 q (1 - q))` to the nearest float.
fn inverse(q: f64) -> f64 {
    // The product in two parts, and the quotient with what is left of it.
    let rest = 1.0 - q;
    let product = q * rest;
    let lost = q.mul_add(rest, -product);
    let quotient = 0.5 / product;
    quotient + (quotient.mul_add(-product, 0.5) - quotient * lost) / product
}

/// Returns the nearest float, and the float nearest to what is left.
pub(super) fn pair(x: Fixed) -> (f64, f64) {
    let nearest: f64 = round_integer(x.value, x.exponent, false);
    let (m, e) = nearest.parts();
    let units = u128::from(m) << (e - x.exponent);
    // Error, `v(c)` and `v'(c)`: exact at the scale of `x`, then rounded to a float, of which `pack` keeps the leading bits.
    let rest: f64 = round_integer(x.value.abs_diff(units), x.exponent, false);
    (nearest, if x.value < units { -rest } else { rest })
}
