//! The kernels of log-odds in `f64`: Taylor's series about the centres of a table.
//!
//! `V(c + h) = V(c) + h V'(c) + h^2 (a_2 + a_3 h + ... + a_7 h^5)`, and a rounding test. The bounds are those of theorem
//! (log-odds) in the chapter [`sums`](crate::book::sums), whose paragraphs the comments name.

use super::far::CERTAIN;
use super::table::{FIRST, LAST, SEVENTH, SIXTH, Table, centre};
use super::{NEAR, Quantity};
use crate::rounded::lanes::double::{complements, leading};
use crate::rounded::lanes::format::{BLOCK, Lane, Split};
use crate::rounded::lanes::kernel::{Block, Results, fused, halves, mark};

/// Bounds the error before rounding, relative to `V`: theorem (log-odds), *Error in `f64`*.
pub(super) const ERROR: f64 = 1.2e-19; // 2^-62.85

/// Stores a result of each cell: the nearest float, NaN at NaN, and [`Lane::OPEN`] where it is not decided. Returns the number of
/// those that are open since they are beyond the table.
#[inline(always)]
pub(in super::super) fn results<Q: Quantity, const FUSED: bool>(
    table: &Table,
    cells: &[f64; BLOCK],
    results: &mut [f64; BLOCK],
) -> u64 {
    let mut left = 0;
    for (&l, result) in cells.iter().zip(results) {
        let a = l.abs();
        let (head, tail) = value::<FUSED>(table, inside(a));
        let (below, above) = bounds::<FUSED>(head, tail);
        let (other, other_above) = complements(head, below, above);
        let complement = Q::is_complement(l);
        let lower = if complement { other } else { head + below };
        let upper = if complement { other_above } else { head + above };
        let decided = if (a >= FIRST) & (lower == upper) { lower } else { f64::OPEN };
        // Domain: beyond the table `1 - V` is 1 to the last bit, and `V` is 0 at the end.
        let beyond = a > LAST;
        let is_left = beyond & (a < CERTAIN) & !complement;
        let end = if is_left { f64::OPEN } else { 0.0 };
        let certain = if complement { 1.0 } else { end };
        let known = if beyond { certain } else { decided };
        left += u64::from(is_left);
        let known = if a == 0.0 { Q::UNKNOWN } else { known };
        *result = if l.is_nan() { l } else { known };
    }
    left
}

/// Sums information over the cells of the given log-odds, and entropies or not.
#[inline(always)]
pub(in super::super) fn sums<const FUSED: bool, const ENTROPY: bool>(
    table: &Table,
    cells: &[f64; BLOCK],
    places: &mut Results<f64>,
) -> Block {
    let mut marks = [mark::OPEN; BLOCK];
    let (entropies, informations) = halves(places);
    let places = entropies.iter_mut().zip(&mut *informations).zip(&mut marks);
    for (&l, ((entropy, information), mark)) in cells.iter().zip(places) {
        let a = l.abs();
        let (head, tail) = value::<FUSED>(table, inside(a));
        let (below, above) = bounds::<FUSED>(head, tail);
        let (value, value_above) = (head + below, head + above);
        let (other, other_above) = complements(head, below, above);
        let near = a < NEAR;
        let unknown = a == 0.0;
        let beyond = a > LAST;
        let mut done = (a >= FIRST) & !beyond;
        let certain = if ENTROPY { a >= CERTAIN } else { beyond };
        if ENTROPY {
            done &= (value == value_above) & (other == other_above);
            let h = if near { other } else { value };
            let h = if done { h } else { 0.0 };
            *entropy = if unknown { 1.0 } else { h };
        } else {
            done &= if near { value == value_above } else { other == other_above };
        }
        let i = if near { value } else { other };
        let i = if done { i } else { 0.0 };
        *information = if certain { 1.0 } else { i };
        let observed = if ENTROPY & (l > 0.0) { mark::OCCUPIED } else { mark::FREE };
        let seen = if unknown { mark::UNKNOWN } else { observed };
        let left = if l.is_nan() { mark::NONE } else { mark::OPEN };
        *mark = if done | unknown | certain { seen } else { left };
    }
    Block::new::<f64, ENTROPY>(entropies, informations, marks)
}

/// Returns a magnitude of the table: the nearest one, any for NaN.
#[inline(always)]
fn inside(a: f64) -> f64 {
    let a = if a > FIRST { a } else { FIRST };
    if a < LAST { a } else { LAST }
}

/// Returns the rest of `V = head + tail` less and more the bound on its error.
#[inline(always)]
fn bounds<const FUSED: bool>(head: f64, tail: f64) -> (f64, f64) {
    let fused = fused::<f64, FUSED>;
    // Rounding test: theorem (blocks).
    (fused(head, -ERROR, tail), fused(head, ERROR, tail))
}

/// Computes `V` at the magnitude `x`, as a float and a rest of at most `2^-13.9` of it.
#[inline(always)]
pub(super) fn value<const FUSED: bool>(table: &Table, x: f64) -> (f64, f64) {
    let fused = fused::<f64, FUSED>;
    let (c, row) = centre(x);
    let (value, slope) = (table.value[row], table.slope[row]);
    let (value_low, slope_low) = f64::unpack(table.low[row]);
    let (a2, a3) = (table.second[row], table.third[row]);
    // Series: the seventh and the sixth are noise in the last bits of the fourth and the fifth.
    let (a4, a7) = unpack(table.fourth[row], SEVENTH);
    let (a5, a6) = unpack(table.fifth[row], SIXTH);
    // Series: exact, since `x` and `c` agree in their leading bits.
    let h = x - c;
    let hh = h * h;
    let high = fused(hh, fused(h, a7, a6), fused(h, a5, a4));
    let series = fused(hh, high, fused(h, a3, a2));
    // Slope, sums: the product of slope and `h` and the sum, and what they lose.
    let (head, lost, second) = leading::<FUSED>(value, slope, h);
    let products = fused(hh, series, fused(slope_low, h, second));
    (head, products + (lost + value_low))
}

/// Returns the floats of a word: all of it, and its last bits.
#[inline(always)]
pub(super) fn unpack(word: u64, bits: u32) -> (f64, f64) {
    (f64::from_bits(word), f64::from_bits(word << (u64::BITS - bits)))
}
