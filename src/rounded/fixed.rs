//! Fixed-point kernels: `log2`, `2^-x`, the two power series about "unknown", the reciprocal.
//!
//! "Scale s" means an integer in units of `2^-s`. A product has the sum of the scales of its factors, `mul_high` takes
//! 128 from it, and a shift to the right takes what it shifts by. Every operation floors; the section "The kernels" of
//! [`docs/rounding.md`](crate::book::rounding) adds up the discarded fractions to the error bounds stated here, and
//! `proofs/*.gappa` checks the sums. Lemmas named in comments are of that chapter.

use super::constants::{
    EIGHTH_INV_LN2, EXP_R, EXP_TABLE, HALF_INV_LN2, INFO_V, INFO_W, INV_LN2, LN2, LOG_Q, LOG_TABLE,
};

/// The number one, scale 120.
pub(super) const ONE_120: u128 = 1 << 120;

/// The error of [`log2`], in units of `2^-120`: below `2^-77`.
pub(super) const LOG_ERROR: u128 = 1 << 43;
/// The error of [`log2_1p_over`] for `|z| < 2^-8`, cut by less than one unit, in units of `2^-112`: below `2^-70`.
pub(super) const LOG_1P_OVER_ERROR: u128 = 1 << 42;
/// The error of [`exp2_neg`], in units of `2^-126`: below `2^-78`.
pub(super) const EXP_ERROR: u128 = 1 << 48;
/// The error of [`information_series`] and [`information_series_log_odds`] before the last factor, in units of
/// `2^-127`.
pub(super) const SERIES_ERROR: u128 = 1 << 55;

/// Computes `floor(a b / 2^128)`, exactly.
#[inline]
pub(crate) const fn mul_high(a: u128, b: u128) -> u128 {
    const LOW: u128 = u64::MAX as u128;
    // a b = a1 b1 2^128 + (a1 b0 + a0 b1) 2^64 + a0 b0; neither sum of a product and a high half exceeds 2^128.
    let (a1, a0, b1, b0) = (a >> 64, a & LOW, b >> 64, b & LOW);
    let middle = a1 * b0 + ((a0 * b0) >> 64);
    let other = a0 * b1 + (middle & LOW);
    a1 * b1 + (middle >> 64) + (other >> 64)
}

/// Computes `x >> shift`, 0 if all bits are shifted out.
#[inline]
pub(crate) fn shift_right(x: u128, shift: i32) -> u128 {
    debug_assert!(shift >= 0);
    x.checked_shr(shift as u32).unwrap_or(0)
}

/// Evaluates the polynomial of the given coefficients (lowest first) at `x` of the given scale, by Horner's rule; the
/// result has the scale of the coefficients. Each of the `n - 1` steps floors once (lemma "Horner").
#[inline]
pub(crate) fn horner(coefficients: &[i64], x: i64, scale: u32) -> i64 {
    let (last, rest) = coefficients.split_last().expect("a polynomial has a coefficient");
    rest.iter().rev().fold(*last, |sum, &c| c + ((i128::from(sum) * i128::from(x)) >> scale) as i64)
}

/// Computes `log2(n / 2^k)`, scale 120, for `2^k <= n < 2^(k+1)` and `k <= 60`; error below [`LOG_ERROR`].
#[inline]
pub(super) fn log2(n: u64, k: u32) -> i128 {
    debug_assert!(k <= 60 && n >> k == 1);
    // The 8 bits below the leading one choose r, scale 11, with |x r - 1| < 2^-8 for x = n / 2^k.
    let (r, minus_log2_r) = LOG_TABLE[(n << (63 - k) << 1 >> 56) as usize];
    // z = x r - 1 exactly, scale 71 = 60 + 11: at most 61 + 11 bits before the subtraction, less than 2^63 after it.
    let z = (((u128::from(n) * u128::from(r)) << (60 - k)) as i128 - (1 << 71)) as i64;
    // log2 x = -log2 r + log2 (1 + z), both of scale 120.
    minus_log2_r as i128 + log2_1p(z)
}

/// Computes `log2(1 + z) = z / ln 2 + z^2 Q(z)`, scale 120, for `z` of scale 71, `|z| < 2^-8`.
#[inline]
fn log2_1p(z: i64) -> i128 {
    // z Q(z), scale 71 = 71 + 63 - 63. This floor, 2^-71, and z times the error of Q, 2^-70.4, are nearly all of
    // LOG_ERROR, once the other z < 2^-8 has multiplied them.
    let z_q = (i128::from(z) * i128::from(horner(&LOG_Q, z, 71))) >> 63;
    // All of 1 / ln 2, scale 127, in two halves, so that no product exceeds 127 bits.
    let z = i128::from(z);
    let (high, low) = ((INV_LN2 >> 64) as i128, INV_LN2 as u64 as i128);
    // Each summand has scale 134: 71 + 63, 71 + 127 - 64, 71 + 71 - 8.
    (z * high + ((z * low) >> 64) + ((z * z_q) >> 8)) >> 14
}

/// Computes `log2(1 + z) / z = 1 / ln 2 + z Q(z)`, scale 112, for `z = ±magnitude`, scale 71, `magnitude < 2^-8`;
/// error below [`LOG_1P_OVER_ERROR`], also for the `z` of which `magnitude` is the floor (lemma "fall").
#[inline]
pub(super) fn log2_1p_over(magnitude: u64, negative: bool) -> u128 {
    let z = if negative { -(magnitude as i64) } else { magnitude as i64 };
    // z Q(z), scale 112 = 71 + 63 - 22: the error of Q times |z| < 2^-8 is nearly all of LOG_1P_OVER_ERROR.
    let z_q = (i128::from(z) * i128::from(horner(&LOG_Q, z, 71))) >> 22;
    // 1 / ln 2 from scale 127 to 112, one unit.
    ((INV_LN2 >> 15) as i128 + z_q) as u128
}

/// Computes `-log2 (m 2^-n)`, scale 120, for `2^k <= m < 2^(k+1)`, `k <= 60` and `n - k` from 1 to
/// 64; error below [`LOG_ERROR`].
#[inline]
pub(super) fn minus_log2_120(m: u64, k: u32, n: i32) -> i128 {
    // -log2 (m 2^-n) = n - k - log2 (m / 2^k): exact but for the logarithm.
    (n - k as i32) as i128 * ONE_120 as i128 - log2(m, k)
}

/// Computes `-log2 (m 2^-n)`, scale 112, for `2^52 <= m < 2^53`, negative above one; error below `LOG_ERROR / 2^8 + 1`.
#[inline]
pub(super) fn minus_log2_112(m: u64, n: i32) -> i128 {
    // Eight bits less than above, for values up to 1126: the floor adds a unit to the error of the logarithm.
    (n - 52) as i128 * (1 << 112) - (log2(m, 52) >> 8)
}

/// Computes `m 2^-n < 2^-8`, scale 71, for `m < 2^53`; cut by less than one unit, and only for `n > 71`.
#[inline]
pub(super) fn floor_71(m: u64, n: i32) -> u64 {
    if n <= 71 { m << (71 - n) } else { shift_right(u128::from(m), n - 71) as u64 }
}

/// Computes `m 2^e < 2^10`, scale 117; cut by less than one unit, and only below `2^-64`.
#[inline]
pub(super) fn floor_117(m: u64, e: i32) -> u128 {
    let shift = 117 + e;
    if shift >= 0 { u128::from(m) << shift } else { shift_right(u128::from(m), -shift) }
}

/// Computes `2^-t = 2^(-i/256) (1 - g (ln 2 - g R(g)))`, scale 126, for `t = i/256 + g` in `[0, 1)`
/// of scale 116; error below [`EXP_ERROR`], also if `t` is off by `2^9` units.
#[inline]
pub(super) fn exp2_neg(t: u128) -> u128 {
    // The 8 leading bits of t choose from the table; g < 2^-8 are the others, scale 116.
    let i = (t >> 108) as usize;
    let g = t & ((1 << 108) - 1);
    // g cut to scale 71, for the polynomial only: R is below 1/4, so the slope is off by less than 2^-73.
    let g_71 = (g >> 45) as i64;
    // ln 2 - g R(g), scale 127 = 71 + 63 - 7; its error is below 2^-70.1, which g makes 2^-78.1.
    let slope = LN2 - ((i128::from(g_71) * i128::from(horner(&EXP_R, g_71, 71))) >> 7) as u128;
    // 2^-g, scale 127: g at scale 128 times the slope at 127.
    let power = (1 << 127) - mul_high(g << 12, slope);
    // Both factors have scale 127.
    mul_high(EXP_TABLE[i], power)
}

/// Computes `y`, `k` and `t` with `e^-l = y 2^-k`, `1/2 - 2^-78 <= y <= 1` of scale 126, and `t = l / ln 2` of scale
/// 116, for `l < 2^10` of scale 117.
///
/// The errors: `y` below [`EXP_ERROR`], also if `l` is off by `2^9` units; `t` below 2 units if `l` was cut by less
/// than one.
#[inline]
pub(super) fn exp_neg(l: u128) -> (u128, i32, u128) {
    // Scale 116 = 117 + 127 - 128. The floor and the constant are off by less than two units.
    let t = mul_high(l, INV_LN2);
    // e^-l = 2^-t = 2^-fraction 2^-k.
    let fraction = t & ((1 << 116) - 1);
    (exp2_neg(fraction), (t >> 116) as i32, t)
}

/// Computes `I = d^2 (1 / (2 ln 2) + d^2 V(d^2))` near `p = 1/2`, for `|2p - 1| = d 2^-e < 2^-4`, `d < 2^53`.
///
/// Returns `value` and `exponent`: `I = value * 2^exponent`, within `SERIES_ERROR + 1` units.
#[inline]
pub(super) fn information_series(d: u64, e: i32) -> (u128, i32) {
    // All 128 bits of the square, as it is the leading factor: I keeps its relative precision however small d is.
    let shift = d.leading_zeros() as i32;
    let square = u128::from(d << shift).pow(2);
    let exponent = -2 * (shift + e);
    // u = d^2 cut to scale 71, for the polynomial only: V's slope makes less than 2^-74 of it.
    let u = shift_right(square, -exponent - 71) as i64;
    // Scale 127 = 71 + 66 - 10; error below SERIES_ERROR.
    let series = HALF_INV_LN2 + ((i128::from(u) * i128::from(horner(&INFO_V, u, 71))) >> 10) as u128;
    // square 2^exponent times series 2^-127, of which mul_high has taken 2^128: one unit more of error.
    (mul_high(square, series), exponent + 1)
}

/// Computes `I = l^2 (1 / (8 ln 2) - l^2 W(l^2))` for `l = m 2^e < 2^-3`, `2^52 <= m < 2^53`; the result as in
/// [`information_series`].
#[inline]
pub(super) fn information_series_log_odds(m: u64, e: i32) -> (u128, i32) {
    // As above, with m of 53 bits moved to 64.
    let square = u128::from(m << 11).pow(2);
    let exponent = 2 * (e - 11);
    // u = l^2 < 2^-6 at scale 69, so that it has 63 bits: W's slope makes less than 2^-74 of the cut.
    let u = shift_right(square, -exponent - 69) as i64;
    // Scale 127 = 69 + 68 - 10; error below SERIES_ERROR.
    let series = EIGHTH_INV_LN2 - ((i128::from(u) * i128::from(horner(&INFO_W, u, 69))) >> 10) as u128;
    (mul_high(square, series), exponent + 1)
}

/// Computes `1 / w`, scale 126, for `w` in `[1, 2]` of scale 126; relative error below `2^-120`.
#[inline]
pub(crate) fn reciprocal(w: u128) -> u128 {
    // 62 good bits by one division, doubled by one step of Newton's iteration.
    let first = (1_u128 << 126) / (w >> 64);
    // 1 - w first, scale 125 = 126 + 127 - 128; it may be negative.
    let residual = (1 << 125) - mul_high(w, first << 63) as i128;
    // first (1 - w first), scale 126 = 62 + 125 - 61. What Newton's step leaves is the square of the residual, 2^-124.
    let correction = ((first >> 2) as i128 * residual) >> 61;
    ((first << 62) as i128 + correction) as u128
}

#[cfg(test)]
mod tests;
