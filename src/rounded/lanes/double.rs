//! The kernels of occupancies in `f64`: value and slope of the table in two floats each, and a polynomial.
//!
//! `V(c + h) = V(c) + h V'(c) + h y E(b, y)` about the centre `c` of a cell of the table, and a rounding test. The bounds
//! are those of theorem (blocks) in the chapter [`sums`](crate::book::sums), whose paragraphs the comments name.

use super::format::{BLOCK, LEAST as LEAST_SINGLE, Lane, Split};
use super::kernel::{Block, Results, distance, fused, halves, mark};
use super::table::{self, Rows, Table};
use core::f64::consts::LN_2;

/// Bounds the error before rounding, relative to the value that is summed up: theorem (blocks), *Error*.
pub(super) const ERROR: f64 = 6e-20; // 2^-63.85
/// Bounds the table.
const LEAST: f64 = LEAST_SINGLE as f64;

/// Stores the entropies of the cells, or their information: the nearest floats, NaN where a cell is no probability, and
/// [`Lane::OPEN`] where the rounding is not decided.
#[inline(always)]
pub(super) fn results<const FUSED: bool, const ENTROPY: bool>(
    table: &Table,
    cells: &[f64; BLOCK],
    results: &mut [f64; BLOCK],
) {
    let rows = table.rows::<ENTROPY>();
    for (&p, result) in cells.iter().zip(results) {
        let (x, near) = distance(p);
        // Not 0 itself: subnormal numbers are slow.
        let inside = if x > LEAST { x } else { LEAST };
        let (head, tail) = value::<FUSED, ENTROPY>(&rows, inside, near);
        let (below, above) = bounds::<FUSED>(head, tail);
        let (other, other_above) = complements(head, below, above);
        // The entropy is `1 - V` near 1/2, where `V` is the information.
        let complement = ENTROPY & near;
        let lower = if complement { other } else { head + below };
        let upper = if complement { other_above } else { head + above };
        // Domain: nearer to 0 there is no cell of the table; where the distance is 0 the answer is exact.
        let decided = if (x >= LEAST) & (lower == upper) { lower } else { f64::OPEN };
        let edge = if near == ENTROPY { 1.0 } else { 0.0 };
        let exact = if x == 0.0 { edge } else { decided };
        *result = if x >= 0.0 { exact } else { f64::NAN };
    }
}

/// Computes the sums over the cells of the given occupancies, with their entropies or without.
///
/// With `FUSED`, some products and sums are rounded at once, which only pays where the target has an
/// instruction for it. Loops without branches over arrays of fixed size: that is what compilers make vectors
/// of.
#[inline(always)]
pub(crate) fn sums<const FUSED: bool, const ENTROPY: bool>(
    table: &Table,
    cells: &[f64; BLOCK],
    results: &mut Results<f64>,
) -> Block {
    let rows = table.rows::<ENTROPY>();
    let mut marks = [mark::OPEN; BLOCK];
    let (entropies, informations) = halves(results);
    let places = entropies.iter_mut().zip(&mut *informations).zip(&mut marks);
    for (&p, ((entropy, information), mark)) in cells.iter().zip(places) {
        let (x, near) = distance(p);
        // Not 0 itself: subnormal numbers are slow.
        let inside = if x > LEAST { x } else { LEAST };
        let (head, tail) = value::<FUSED, ENTROPY>(&rows, inside, near);
        let (below, above) = bounds::<FUSED>(head, tail);
        let (value, value_above) = (head + below, head + above);
        // Domain: nearer to 0 there is no cell of the table.
        let mut done = (x >= LEAST) & (value == value_above);
        // Domain: certain or unknown, where the distance is 0 and the answer exact.
        let edge = x == 0.0;
        if ENTROPY {
            let (other, other_above) = complements(head, below, above);
            done &= other == other_above;
            let value = if done { value } else { 0.0 };
            let other = if edge {
                1.0
            } else if done {
                other
            } else {
                0.0
            };
            *entropy = if near { other } else { value };
            *information = if near { value } else { other };
        } else {
            let value = if done { value } else { 0.0 };
            *information = if edge & !near { 1.0 } else { value };
        }
        done |= edge;
        let observed = if ENTROPY & (p > 0.5) { mark::OCCUPIED } else { mark::FREE };
        let seen = if edge & near { mark::UNKNOWN } else { observed };
        // Domain: what is no probability has a distance that is negative or NaN.
        let left = if x >= 0.0 { mark::OPEN } else { mark::NONE };
        *mark = if done { seen } else { left };
    }
    Block::new::<f64, ENTROPY>(entropies, informations, marks)
}

/// Computes `V` at the distance `x`, as a float and a rest of at most `2^-14.2` of it.
///
/// With `h = x - c` the Taylor series about the centre, `V = V_c + s h + h y E(b, y)`: `y = ∓h / (2 q (1 - q))`, `b
/// = ∓(1 - 2q)`, and `E = 1/(2 ln 2) sum of e_k y^k`, whose coefficients are polynomials in `b`.
#[inline(always)]
pub(super) fn value<const FUSED: bool, const ENTROPY: bool>(
    rows: &Rows<'_>,
    x: f64,
    near: bool,
) -> (f64, f64) {
    let fused = fused::<f64, FUSED>;
    let (c, number) = f64::centre(x);
    let row = table::row::<ENTROPY>(number, near);
    let (value, slope, inverse) = (rows.value[row], rows.slope[row], rows.inverse[row]);
    let (value_low, slope_low) = f64::unpack(rows.low[row]);
    // Series: exact, since `x` and `c` agree in their leading bits.
    let h = x - c;
    let y = h * inverse;
    // Series: exact, as a centre is a multiple of `2^-40`.
    let b = if near {
        -c
    } else if ENTROPY {
        c - 1.0
    } else {
        1.0 - c
    };
    let series = series::<FUSED>(b, y);
    let (head, lost, second) = leading::<FUSED>(value, slope, h);
    // Error, `R` and sums: from here on all is at most `2^-14.2 V`, and each operation rounds by `u` of that.
    let products = fused(h * y, series, fused(slope_low, h, second));
    (head, products + (lost + value_low))
}

/// Computes `value + slope h`: a float, what the sum has lost, and what the product has.
#[inline(always)]
pub(super) fn leading<const FUSED: bool>(value: f64, slope: f64, h: f64) -> (f64, f64, f64) {
    // Error, slope: the product of slope and `h` and what it loses; not fused, the second is rounded at `2^-14.9 V`.
    let (first, second) = if FUSED {
        let first = slope * h;
        (first, f64::fused(slope, h, -first))
    } else {
        (slope.head() * h, (slope - slope.head()) * h)
    };
    // Error, sums: Dekker's fast sum, since `|first| < 2^-6.9 V`; what `head` has lost goes to the rest.
    let head = value + first;
    let lost = (value - head) + first;
    (head, lost, second)
}

/// Computes `E(b, y)`, see [`value`]: the coefficients of the chapter, even and odd ones apart.
#[inline(always)]
pub(super) fn series<const FUSED: bool>(b: f64, y: f64) -> f64 {
    let fused = fused::<f64, FUSED>;
    // Series: 1/(2 ln 2) times 1/2, -1/6 and so on.
    let unit = |numerator: f64, denominator: f64| numerator / denominator / (2.0 * LN_2);
    let (bb, yy, by) = (b * b, y * y, b * y);
    let e1 = unit(-1.0, 6.0);
    let e2 = fused(bb, unit(3.0, 48.0), unit(1.0, 48.0));
    let e3 = fused(bb, unit(-1.0, 40.0), unit(-1.0, 40.0));
    let e4 = fused(bb, fused(bb, unit(5.0, 480.0), unit(10.0, 480.0)), unit(1.0, 480.0));
    // Error, terms left out: the series ends with `y^5`.
    let e5 = fused(bb, fused(bb, unit(-3.0, 672.0), unit(-10.0, 672.0)), unit(-3.0, 672.0));
    let (odd, even) = (fused(yy, fused(yy, e5, e3), e1), fused(yy, e4, e2));
    // Error, `R`: `|y| < 2^-8` and `1/2` leads, so that only the last two operations round by `u` of the sum.
    fused(by, odd, fused(yy, even, unit(1.0, 2.0)))
}

/// Returns the rest of `V = head + tail` less and more the bound on its error.
#[inline(always)]
pub(super) fn bounds<const FUSED: bool>(head: f64, tail: f64) -> (f64, f64) {
    let fused = fused::<f64, FUSED>;
    // Rounding test: `V` is between; and if `head` plus either is rounded to the same float, so is `V`.
    (fused(head, -ERROR, tail), fused(head, ERROR, tail))
}

/// Rounds `1 - V` from both sides, where `V` is between `head + below` and `head + above`.
#[inline(always)]
pub(super) fn complements(head: f64, below: f64, above: f64) -> (f64, f64) {
    // Rounding test of `1 - V`: `4 u^2`, for two roundings of its rest by `u^2`.
    let tiny = f64::EPSILON * f64::EPSILON;
    // Error, sums: Dekker's fast sum; what `1 - head` has lost goes to the rest.
    let complement = 1.0 - head;
    let rest = (1.0 - complement) - head;
    let lower = rest - (above + tiny);
    let upper = rest - (below - tiny);
    (complement + lower, complement + upper)
}
