//! The kernel of log-odds beyond the tables, in `f64`: powers of two from a small table, and the exponential's series.
//!
//! There `V` is `e^-a` times 1, or times `(1 + a) / ln 2`, to more bits than are asked for. The bounds are those of theorem (far
//! log-odds) in the chapter [`sums`](crate::book::sums), whose paragraphs the comments name.

use super::table::LAST;
use super::{Quantity, ROUND};
use crate::rounded::constants::{EXP_TABLE, INV_LN2};
use crate::rounded::fixed::mul_high;
use crate::rounded::lanes::format::{BLOCK, Lane};
use core::f64::consts::{LN_2, LOG2_E};

/// Bounds the error before rounding, relative to `V`: theorem (far log-odds), *Error*.
pub(super) const ERROR: f64 = 1.1e-20; // 2^-66.3
/// The magnitude up to which results are normal numbers.
pub(super) const FARTHEST: f64 = 708.0;
/// The magnitude from which on results round to 0.
pub(super) const CERTAIN: f64 = 768.0;

/// The steps in a factor of 2.
const PARTS: usize = 256;
/// The steps in a factor of e.
const STEPS: f64 = LOG2_E * 256.0;
/// The low part of `ln 2`: what its nearest float leaves.
const LN_2_LOW: f64 = 2.3190468138462996e-17;
/// A step, `ln 2 / 256`: a multiple of `2^-61`.
const STEP: f64 = LN_2 / 256.0;
/// The low part of a step.
const STEP_LOW: f64 = LN_2_LOW / 256.0;

/// Holds the powers of two at each step, times a unit: rounded, and what rounding took.
pub(in super::super) struct Powers {
    high: [f64; PARTS],
    low: [f64; PARTS],
}

/// The powers that occupancies are made of.
pub(in super::super) static OF_OCCUPANCY: Powers = Powers::new(1 << 127);
/// The powers in bits of a nat each, that entropies are made of.
pub(in super::super) static OF_ENTROPY: Powers = Powers::new(INV_LN2);

impl Powers {
    /// Computes the powers in units of `unit 2^-127`.
    const fn new(unit: u128) -> Self {
        // The scale of a product of two numbers at scale 127, of which 128 bits are dropped.
        let scale = f64::from_bits((1023 - 126) << 52);
        let mut powers = Self { high: [0.0; PARTS], low: [0.0; PARTS] };
        let mut step = 0;
        while step < PARTS {
            // Powers: exact at that scale, then rounded twice.
            let power = mul_high(EXP_TABLE[step], unit);
            let high = power as f64;
            powers.high[step] = high * scale;
            powers.low[step] = (power as i128 - high as i128) as f64 * scale;
            step += 1;
        }
        powers
    }
}

/// Returns whether the kernel has log-odds of this magnitude.
#[inline(always)]
pub(in super::super) fn is_far(a: f64) -> bool {
    (a > LAST) & (a <= FARTHEST)
}

/// Stores a result of each far cell of a block: the nearest float, and [`Lane::OPEN`] where it is not decided. The other results
/// stay as they are.
#[inline(always)]
pub(in super::super) fn results<Q: Quantity, const FUSED: bool>(
    powers: &Powers,
    cells: &[f64; BLOCK],
    results: &mut [f64; BLOCK],
) {
    for (&l, result) in cells.iter().zip(results) {
        let a = l.abs();
        let (head, tail, scale) = value::<Q>(powers, inside(a));
        let (below, above) = bounds(head, tail);
        let (lower, upper) = (head + below, head + above);
        // Domain: without fused operations the value is not computed.
        let decided = FUSED & (lower == upper);
        // Scale: exact, as the result is a normal number.
        let small = if decided { lower * scale } else { f64::OPEN };
        // Domain: `1 - V` is 1 to the last bit.
        let known = if Q::is_complement(l) { 1.0 } else { small };
        *result = if is_far(a) { known } else { *result };
    }
}

/// Returns a far magnitude: the nearest one, any for NaN.
#[inline(always)]
fn inside(a: f64) -> f64 {
    let a = if a > LAST { a } else { LAST };
    if a < FARTHEST { a } else { FARTHEST }
}

/// Returns the rest of `2^k V = head + tail` less and more the bound on its error.
#[inline(always)]
fn bounds(head: f64, tail: f64) -> (f64, f64) {
    // Rounding test: theorem (blocks).
    (f64::fused(head, -ERROR, tail), f64::fused(head, ERROR, tail))
}

/// Computes `2^k V` at the magnitude `a`, as a float and a rest of at most `2^-19` of it; and `2^-k`.
#[inline(always)]
pub(super) fn value<Q: Quantity>(powers: &Powers, a: f64) -> (f64, f64, f64) {
    let fused = f64::fused;
    // Reduction: the nearest number of steps, which is in the last bits.
    let shifted = fused(a, STEPS, ROUND);
    let steps = shifted - ROUND;
    let number = shifted.to_bits();
    let row = number as usize % PARTS;
    let scale = f64::from_bits(1.0_f64.to_bits().wrapping_sub(number >> 8 << 52));
    // Reduction: `a` is the steps, and `r - r_low`; `r` is exact.
    let r = fused(steps, -STEP, a);
    let r_low = steps * STEP_LOW;
    // Factor: its product with the power, and what that loses.
    let (factor, factor_low) = factor::<Q>(a);
    let (power, power_low) = (powers.high[row], powers.low[row]);
    let product = power * factor;
    let product_lost = fused(power, factor, -product);
    let product_low = fused(power_low, factor, fused(power, factor_low, product_lost));
    // Series: of `r - r_low` in one float, but for the first two terms.
    let reduced = r - r_low;
    let square = reduced * reduced;
    let high = fused(reduced, -1.0 / 120.0, 1.0 / 24.0);
    let series = fused(square, high, fused(reduced, -1.0 / 6.0, 1.0 / 2.0));
    let rest = fused(square, series, r_low);
    // Series: the product with `r` and what that loses.
    let first = product * r;
    let second = fused(product, r, -first);
    // Error, sums: Dekker's fast sum; what `head` has lost goes to the rest.
    let head = product - first;
    let lost = (product - head) - first;
    let low = fused(product_low, -r, product_low);
    (head, fused(product, rest, low) + (lost - second), scale)
}

/// Returns the factor of a power, as a float and what rounding took.
#[inline(always)]
fn factor<Q: Quantity>(a: f64) -> (f64, f64) {
    // Factor: exact, Dekker's fast sum.
    let one_more = a + 1.0;
    if Q::OF_OCCUPANCY { (1.0, 0.0) } else { (one_more, 1.0 - (one_more - a)) }
}
