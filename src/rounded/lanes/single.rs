//! The kernels of occupancies in `f32`: value and slope of the table in `f64`, what is left of the series in `f32`.
//!
//! What is left is at most `2^-15.6` of `V`, so that `f32` has it to `2^-36.9` of `V`, where a result has 24 bits. It needs no table,
//! and goes to arrays, from which lanes of `f64` take it. The bounds are those of theorem (blocks) in the chapter
//! [`sums`](crate::book::sums), whose paragraphs the comments name.

use super::format::{BLOCK, HALF, LEAST, Lane};
use super::kernel::{Block, Results, distance, fused, halves, mark};
use super::table::{Rows, Table, row};
use crate::real::Real;
use core::f64::consts::LN_2;

/// Bounds the error before rounding, relative to `V`: theorem (blocks), *Error*.
pub(super) const ERROR: f64 = 8e-12; // 2^-36.86

/// Holds what a block's cells take from `f32` to `f64`.
struct Parts {
    /// Holds the row of the table.
    row: [u32; BLOCK],
    /// Holds the distance from its centre.
    h: [f32; BLOCK],
    /// Holds what is left of the series.
    rest: [f32; BLOCK],
}

impl Parts {
    /// Computes the parts of a block, sixteen lanes at a time where a vector has 512 bits.
    #[inline(always)]
    fn of<const FUSED: bool, const ENTROPY: bool>(cells: &[f32; BLOCK]) -> Self {
        let mut parts = Self { row: [0; BLOCK], h: [0.0; BLOCK], rest: [0.0; BLOCK] };
        let places = parts.row.iter_mut().zip(&mut parts.h).zip(&mut parts.rest);
        for (&p, ((row_place, h_place), rest_place)) in cells.iter().zip(places) {
            let (x, near) = distance(p);
            // Not 0 itself: subnormal numbers are slow.
            let inside = if x > LEAST { x } else { LEAST };
            let (c, number) = f32::centre(inside);
            *row_place = row::<ENTROPY>(number, near) as u32;
            (*h_place, *rest_place) = rest::<FUSED, ENTROPY>(inside, c, near);
        }
        parts
    }

    /// Returns `V` of each cell, and the number of its row.
    #[inline(always)]
    fn values<'a, const FUSED: bool>(&'a self, rows: &Rows<'a>) -> impl Iterator<Item = (f64, usize)> + 'a {
        let (values, slopes) = (rows.value, rows.slope);
        self.row.iter().zip(&self.h).zip(&self.rest).map(move |((&row, &h), &rest)| {
            let row = row as usize % (2 * HALF);
            (value::<FUSED>(values[row], slopes[row], h, rest), row)
        })
    }
}

/// Stores the entropies of the cells, or their information: the nearest floats, NaN where a cell is no probability, and
/// [`Lane::OPEN`] where the rounding is not decided.
#[inline(always)]
pub(super) fn results<const FUSED: bool, const ENTROPY: bool>(
    table: &Table,
    cells: &[f32; BLOCK],
    results: &mut [f32; BLOCK],
) {
    let parts = Parts::of::<FUSED, ENTROPY>(cells);
    for ((v, row), result) in parts.values::<FUSED>(&table.rows::<ENTROPY>()).zip(&mut *results) {
        // The entropy is `1 - V` near 1/2, where `V` is the information.
        let v = if ENTROPY & (row >= HALF) { 1.0 - v } else { v };
        let (lower, upper) = bounds(v);
        *result = if lower == upper { lower } else { f32::OPEN };
    }
    for (&p, result) in cells.iter().zip(results) {
        let (x, near) = distance(p);
        // Domain: nearer to 0 there is no cell of the table; where the distance is 0 the answer is exact.
        let decided = if x >= LEAST { *result } else { f32::OPEN };
        let edge = if near == ENTROPY { 1.0 } else { 0.0 };
        let exact = if x == 0.0 { edge } else { decided };
        *result = if x >= 0.0 { exact } else { f32::NAN };
    }
}

/// Sums information over the cells of the given occupancies, and entropies or not.
#[inline(always)]
pub(super) fn sums<const FUSED: bool, const ENTROPY: bool>(
    table: &Table,
    cells: &[f32; BLOCK],
    places: &mut Results<f32>,
) -> Block {
    let parts = Parts::of::<FUSED, ENTROPY>(cells);
    let (entropies, informations) = halves(places);
    // `V` and, with entropies, `1 - V`, or open both.
    let numbers = parts.values::<FUSED>(&table.rows::<ENTROPY>());
    for ((v, _), (entropy, information)) in numbers.zip(entropies.iter_mut().zip(&mut *informations)) {
        let (value, value_above) = bounds(v);
        let mut done = value == value_above;
        if ENTROPY {
            let (other, other_above) = complements::<FUSED>(v);
            done &= other == other_above;
            *entropy = other;
        }
        *information = if done { value } else { f32::OPEN };
    }
    let mut marks = [mark::OPEN; BLOCK];
    let places = entropies.iter_mut().zip(&mut *informations).zip(&mut marks);
    for (&p, ((entropy, information), mark)) in cells.iter().zip(places) {
        let (x, near) = distance(p);
        // Domain: nearer to 0 there is no cell of the table.
        let mut done = (x >= LEAST) & (*information >= 0.0);
        let value = if done { *information } else { 0.0 };
        // Domain: certain or unknown, where the distance is 0 and the answer exact.
        let edge = x == 0.0;
        if ENTROPY {
            let other = if done { *entropy } else { 0.0 };
            let other = if edge { 1.0 } else { other };
            *entropy = if near { other } else { value };
            *information = if near { value } else { other };
        } else {
            *information = if edge & !near { 1.0 } else { value };
        }
        done |= edge;
        let observed = if ENTROPY & (p > f32::HALF) { mark::OCCUPIED } else { mark::FREE };
        let seen = if edge & near { mark::UNKNOWN } else { observed };
        // Domain: what is no probability has a distance that is negative or NaN.
        let left = if x >= 0.0 { mark::OPEN } else { mark::NONE };
        *mark = if done { seen } else { left };
    }
    Block::new::<f32, ENTROPY>(entropies, informations, marks)
}

/// Computes `h = x - c` and the rest `h y E(b, y)` of the series about the centre `c` of `x`, see [`value`]: `y = ∓h / (2 q (1 - q))`,
/// `b = ∓(1 - 2q)`.
#[inline(always)]
pub(super) fn rest<const FUSED: bool, const ENTROPY: bool>(x: f32, c: f32, near: bool) -> (f32, f32) {
    // Series: exact, since `x` and `c` agree in their leading bits.
    let h = x - c;
    // Series: `c^2 / 2` is exact, as `c` has 9 bits.
    let square = c * c * f32::HALF;
    // Error, `R`: `2 q (1 - q)` with its sign, and `b`, each rounded once; `b` is exact where `c` is a multiple of `2^-24`.
    let (curvature, b) = if near {
        (f32::HALF - square, -c)
    } else if ENTROPY {
        (square - c, c - 1.0)
    } else {
        (c - square, 1.0 - c)
    };
    let y = h / curvature;
    let series = series::<FUSED>(b, y);
    (h, h * y * series)
}

/// Computes `E(b, y) = 1/(2 ln 2) sum of e_k y^k`, whose coefficients are polynomials in `b`: those of the chapter.
#[inline(always)]
pub(super) fn series<const FUSED: bool>(b: f32, y: f32) -> f32 {
    let fused = fused::<f32, FUSED>;
    // Series: 1/(2 ln 2) times 1/2, -1/6 and so on.
    let unit = |numerator: f64, denominator: f64| (numerator / denominator / (2.0 * LN_2)) as f32;
    // Error, terms left out: the series ends with `y^2`.
    let even = fused(b * b, unit(3.0, 48.0), unit(1.0, 48.0));
    // Error, `R`: `|y| < 2^-8` and `1/2` leads, so that only the last two operations round by `u` of the sum.
    fused(b * y, unit(-1.0, 6.0), fused(y * y, even, unit(1.0, 2.0)))
}

/// Computes `V = V_c + s h + h y E(b, y)` from value and slope of a row.
#[inline(always)]
pub(super) fn value<const FUSED: bool>(value: f64, slope: f64, h: f32, rest: f32) -> f64 {
    // Error, sums: each operation rounds by `2^-53 V`, which is little beside the rounding of `R`.
    let first = fused::<f64, FUSED>(f64::from(h), slope, value);
    first + f64::from(rest)
}

/// Rounds `V` from both sides of its error; and `1 - V`, where that is the greater.
#[inline(always)]
fn bounds(v: f64) -> (f32, f32) {
    // Rounding test: `V` is between; and if both are rounded to the same float, so is `V`.
    let (less, more) = (1.0 - ERROR, 1.0 + ERROR);
    ((v * less) as f32, (v * more) as f32)
}

/// Rounds `1 - V` from both sides of the error of `V`.
#[inline(always)]
fn complements<const FUSED: bool>(v: f64) -> (f32, f32) {
    let complement = 1.0 - v;
    // Rounding test of `1 - V`: `2^-52` for the roundings of `1 - V` and of either side, by `2^-54` below 1 and `2^-53` above.
    let margin = fused::<f64, FUSED>(v, ERROR, f64::EPSILON);
    ((complement - margin) as f32, (complement + margin) as f32)
}
