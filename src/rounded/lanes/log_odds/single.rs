//! The kernels of log-odds in `f32`, in lanes of `f64`: polynomials, no table.
//!
//! `p = 1 / (1 + e^-l)` is one quotient, as `e^-l` is the quotient of two polynomials and a power of two. Up to `l = 2` the
//! information is `l^2` times a polynomial in `l^2`; from there on the entropy is the smaller probability `q` times the sum of
//! `l / ln 2` and a polynomial in `q`. Each value is known to `2^-37.2` of itself, where a result has 24 bits. The bounds are those
//! of theorem (log-odds) in the chapter [`sums`](crate::book::sums), whose paragraphs the comments name.

use super::polynomials::{EVEN, INFORMATION, LOG, ODD};
use super::{NEAR, Quantity, ROUND};
use crate::rounded::lanes::format::{BLOCK, Lane};
use crate::rounded::lanes::kernel::{Block, Results, fused, halves, mark};
use core::f64::consts::LOG2_E;

/// Bounds the error before rounding, relative to each of entropy, information and occupancy.
pub(super) const ERROR: f64 = 6e-12; // 2^-37.28
/// The magnitude from which on results are those of infinity: entropies are below `2^-150`.
const CERTAIN: f64 = 128.0;

/// Stores a result of each cell: the nearest float, NaN at NaN, and [`Lane::OPEN`] where the rounding is not decided.
#[inline(always)]
pub(in super::super) fn results<Q: Quantity, const FUSED: bool>(
    cells: &[f32; BLOCK],
    results: &mut [f32; BLOCK],
) {
    for (&l, result) in cells.iter().zip(results) {
        let (lower, upper) = bounds(unrounded::<Q, FUSED>(inside(l)));
        // NaN is not below NaN.
        *result = if lower < upper { f32::OPEN } else { lower };
    }
}

/// Sums information over the cells of the given log-odds, and entropies or not.
#[inline(always)]
pub(in super::super) fn sums<const FUSED: bool, const ENTROPY: bool>(
    cells: &[f32; BLOCK],
    places: &mut Results<f32>,
) -> Block {
    let mut marks = [mark::OPEN; BLOCK];
    let (entropies, informations) = halves(places);
    let places = entropies.iter_mut().zip(&mut *informations).zip(&mut marks);
    for (&l, ((entropy, information), mark)) in cells.iter().zip(places) {
        let magnitude = inside(l).abs();
        let v = value::<FUSED>(magnitude, occupancy::<FUSED>(-magnitude));
        let near = magnitude < NEAR;
        let (i, above) = bounds(if near { v } else { 1.0 - v });
        // NaN is not equal to NaN.
        let mut done = i == above;
        if ENTROPY {
            let (h, above) = bounds(if near { 1.0 - v } else { v });
            done &= h == above;
            *entropy = if done { h } else { 0.0 };
        }
        *information = if done { i } else { 0.0 };
        let observed = if ENTROPY & (l > 0.0) { mark::OCCUPIED } else { mark::FREE };
        let seen = if l == 0.0 { mark::UNKNOWN } else { observed };
        let left = if l.is_nan() { mark::NONE } else { mark::OPEN };
        *mark = if done { seen } else { left };
    }
    Block::new::<f32, ENTROPY>(entropies, informations, marks)
}

/// Returns the log-odds, and the nearest of `-CERTAIN` and [`CERTAIN`] for whatever is beyond; NaN at NaN.
#[inline(always)]
fn inside(l: f32) -> f64 {
    let l = f64::from(l);
    let l = if l < -CERTAIN { -CERTAIN } else { l };
    if l > CERTAIN { CERTAIN } else { l }
}

/// Computes a result at log-odds `l` up to [`CERTAIN`] in magnitude.
#[inline(always)]
fn unrounded<Q: Quantity, const FUSED: bool>(l: f64) -> f64 {
    if Q::OF_OCCUPANCY {
        return occupancy::<FUSED>(l);
    }
    let v = value::<FUSED>(l.abs(), occupancy::<FUSED>(-l.abs()));
    if Q::is_complement(l) { 1.0 - v } else { v }
}

/// Rounds a value from both sides of its error.
#[inline(always)]
fn bounds(x: f64) -> (f32, f32) {
    ((x * (1.0 - ERROR)) as f32, (x * (1.0 + ERROR)) as f32)
}

/// Computes the occupancy at log-odds `l` up to [`CERTAIN`] in magnitude.
#[inline(always)]
pub(super) fn occupancy<const FUSED: bool>(l: f64) -> f64 {
    let fused = fused::<f64, FUSED>;
    // Exponential: `-l / ln 2 = k + r`, `|r| <= 1/2`; the last bits of `shifted` are those of `k`.
    let shifted = fused(l, -LOG2_E, ROUND);
    let k = shifted - ROUND;
    let r = fused(l, -LOG2_E, -k);
    // Exponential: `2^r` is the quotient of `over` and `under`.
    let rr = r * r;
    let even = horner::<FUSED, _>(&EVEN, rr);
    let odd = horner::<FUSED, _>(&ODD, rr);
    let under = fused(-r, odd, even);
    let over = fused(r, odd, even);
    let scaled = f64::from_bits(over.to_bits().wrapping_add(shifted.to_bits() << 52));
    under / (under + scaled)
}

/// Computes `V` at the magnitude `a`, where the smaller probability is `q`: the information up to [`NEAR`], the entropy from there
/// on.
#[inline(always)]
pub(super) fn value<const FUSED: bool>(a: f64, q: f64) -> f64 {
    let square = a * a;
    let information = square * horner::<FUSED, _>(&INFORMATION, square);
    // Entropy: `q (l / ln 2 - log2(1 - q) / q)`.
    let entropy = q * fused::<f64, FUSED>(a, LOG2_E, horner::<FUSED, _>(&LOG, q));
    if a < NEAR { information } else { entropy }
}

/// Evaluates a polynomial by Horner's rule.
#[inline(always)]
fn horner<const FUSED: bool, const N: usize>(coefficients: &[f64; N], x: f64) -> f64 {
    let last = coefficients[N - 1];
    coefficients[..N - 1].iter().rev().fold(last, |sum, &c| fused::<f64, FUSED>(sum, x, c))
}
