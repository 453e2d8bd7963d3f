//! The kernels of log-odds in `f32`, in lanes of `f64`: polynomials, no table.
//!
//! Up to `l = 2` the information is `l^2` times a polynomial in `l^2`; from there on the entropy is `e` times two
//! polynomials in `e = e^-l`. Each value is known to `2^-37.8` of itself, where a result has 24 bits. The bounds are those of
//! theorem (log-odds) in the chapter [`sums`](crate::book::sums), whose paragraphs the comments name.

use super::polynomials::{EXP, INFORMATION, INVERSE, LOG};
use super::{NEAR, Quantity};
use crate::rounded::lanes::format::{BLOCK, Lane};
use crate::rounded::lanes::kernel::{Block, Results, fused, halves, mark};
use core::f64::consts::LOG2_E;

/// Bounds the error before rounding, relative to each of entropy, information and occupancy.
pub(super) const ERROR: f64 = 4e-12; // 2^-37.86
/// The magnitude from which on results are those of infinity: entropies are below `2^-150`.
const FAR: f64 = 128.0;

/// `3/2 2^52`: added to a number below `2^51`, it leaves the nearest integer in the last bits.
const ROUND: f64 = 6755399441055744.0;
/// The first 32 bits of ln 2, and the rest.
const LN_2_HIGH: f64 = f64::from_bits(0x3fe6_2e42_fee0_0000);
const LN_2_LOW: f64 = 1.9082149292705877e-10;

/// Stores a result of each cell: the nearest float, NaN at NaN, and [`Lane::OPEN`] where the rounding is not decided.
#[inline(always)]
pub(in super::super) fn results<Q: Quantity, const FUSED: bool>(
    cells: &[f32; BLOCK],
    results: &mut [f32; BLOCK],
) {
    for (&l, result) in cells.iter().zip(results) {
        let magnitude = magnitude(l);
        let e = exp_minus::<FUSED>(magnitude);
        let v = if Q::OF_OCCUPANCY { e / (1.0 + e) } else { value::<FUSED>(magnitude, e) };
        let (lower, upper) = bounds(if Q::is_complement(l.into()) { 1.0 - v } else { v });
        let decided = if lower == upper { lower } else { f32::OPEN };
        *result = if l.is_nan() { l } else { decided };
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
        let magnitude = magnitude(l);
        let v = value::<FUSED>(magnitude, exp_minus::<FUSED>(magnitude));
        let near = magnitude < NEAR;
        let (value, above) = bounds(v);
        let (other, other_above) = bounds(1.0 - v);
        let (i, decided) = if near { (value, value == above) } else { (other, other == other_above) };
        let mut done = decided & !l.is_nan();
        if ENTROPY {
            let (h, decided) = if near { (other, other == other_above) } else { (value, value == above) };
            done &= decided;
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

/// Returns the magnitude of log-odds, and [`FAR`] for NaN and whatever is beyond.
#[inline(always)]
fn magnitude(l: f32) -> f64 {
    let magnitude = f64::from(l).abs();
    if magnitude < FAR { magnitude } else { FAR }
}

/// Rounds a value from both sides of its error.
#[inline(always)]
fn bounds(x: f64) -> (f32, f32) {
    ((x * (1.0 - ERROR)) as f32, (x * (1.0 + ERROR)) as f32)
}

/// Computes `e^-a` for `a` up to [`FAR`].
#[inline(always)]
pub(super) fn exp_minus<const FUSED: bool>(a: f64) -> f64 {
    let fused = fused::<f64, FUSED>;
    // Exponential: `a = k ln 2 + r`, `|r| <= ln 2 / 2`; the last bits of `shifted` are those of `k`.
    let shifted = fused(a, LOG2_E, ROUND);
    let k = shifted - ROUND;
    // Exponential: `k` has 8 bits, so that the product is exact, and the difference is a float.
    let r = fused(k, -LN_2_LOW, a - k * LN_2_HIGH);
    let power = f64::from_bits(1023_u64.wrapping_sub(shifted.to_bits()) << 52);
    power * horner::<FUSED, _>(&EXP, r)
}

/// Computes `V`: the information up to [`NEAR`], the entropy from there on.
#[inline(always)]
pub(super) fn value<const FUSED: bool>(a: f64, e: f64) -> f64 {
    let square = a * a;
    let information = square * horner::<FUSED, _>(&INFORMATION, square);
    // Entropy: `log2 (1 + e) + l / ln 2 e / (1 + e)`.
    let inverse = horner::<FUSED, _>(&INVERSE, e);
    let entropy = e * fused::<f64, FUSED>(a * LOG2_E, inverse, horner::<FUSED, _>(&LOG, e));
    if a < NEAR { information } else { entropy }
}

/// Evaluates a polynomial by Horner's rule.
#[inline(always)]
fn horner<const FUSED: bool, const N: usize>(coefficients: &[f64; N], x: f64) -> f64 {
    let last = coefficients[N - 1];
    coefficients[..N - 1].iter().rev().fold(last, |sum, &c| fused::<f64, FUSED>(sum, x, c))
}
