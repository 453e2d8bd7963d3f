//! Step 1 of Ziv's strategy: enclosures of the value at most `2^-66` wide, relative to it.
//!
//! Notation of [`docs/rounding.md`](crate::book::rounding): `q = min(p, 1-p)`, `d = |2p - 1|`, `l` the magnitude of the
//! log-odds, `x = e^-l`, so that `q = x / (1 + x)`. Significands `m` are in `[2^52, 2^53)`.

use super::constants::{INV_LN2, LN2};
use super::enclosure::Enclosure;
use super::fixed::{
    EXP_ERROR, LOG_1P_OVER_ERROR, LOG_ERROR, ONE_120, SERIES_ERROR, exp_neg, exp2_neg, information_series,
    information_series_log_odds, log2, log2_1p_over, mul_high, reciprocal, scale_117, shift_right,
};

/// `H(p)` and `I(p)` for `p = m 2^e` in `(0, 1)`, not 1/2.
#[inline]
pub(super) fn from_occupancy(m: u64, e: i32) -> (Enclosure, Enclosure) {
    let n = -e;
    if let Some(d) = distance_from_unknown(m, n) {
        return beside_unknown(d, n);
    }
    let (m, n) = minor(m, n);
    if n <= 60 { with_two_logarithms(m, n) } else { with_small_occupancy(m, n) }
}

/// `H(p)` and `I(p)` at `|2p - 1| = d 2^-n < 2^-4`, `d < 2^53`.
#[inline]
pub(super) fn beside_unknown(d: u64, n: i32) -> (Enclosure, Enclosure) {
    let (value, exponent) = information_series(d, n);
    near_unknown(value, exponent)
}

/// `|2p - 1| = d 2^-n` for `p = m 2^-n`, if it is below `2^-4`; exact.
#[inline]
pub(super) fn distance_from_unknown(m: u64, n: i32) -> Option<u64> {
    // n = 53 above one half, n = 54 in [1/4, 1/2), more below.
    if n <= 54 {
        let d = (2 * m).abs_diff(1 << n);
        if d < 1 << (n - 4) {
            return Some(d);
        }
    }
    None
}

/// Whether `l = m 2^e` is below `2^-3`, where `2^52 <= m < 2^53`.
#[inline]
pub(super) fn is_small(e: i32) -> bool {
    e < -55
}

/// `q = min(p, 1 - p)` for `p = m 2^-n`, exactly.
#[inline]
pub(super) fn minor(m: u64, n: i32) -> (u64, i32) {
    if n == 53 {
        let rest = (1 << 53) - m;
        let shift = rest.leading_zeros() as i32 - 11;
        (rest << shift, 53 + shift)
    } else {
        (m, n)
    }
}

/// From `I`, given by a series near `p = 1/2`: `I` itself, and `H = 1 - I`.
#[inline]
fn near_unknown(value: u128, exponent: i32) -> (Enclosure, Enclosure) {
    let information = Enclosure::around(value, SERIES_ERROR + 2, exponent);
    // I < 2^-8 at scale 120: cut by less than one unit, wrong by less than 2^-67 I.
    let cut = shift_right(value, -120 - exponent);
    let error = shift_right(SERIES_ERROR + 2, -120 - exponent) + 2;
    (Enclosure::around(ONE_120 - cut, error, -120), information)
}

/// `q >= 2^-8`: `H = -q log2 q - (1-q) log2 (1-q)`, `I = 1 - H`.
#[inline]
fn with_two_logarithms(m: u64, n: i32) -> (Enclosure, Enclosure) {
    let rest = (1 << n) - m;
    let minus_log2_q = ((n - 52) as i128 * ONE_120 as i128 - log2(m, 52)) as u128;
    let minus_log2_rest = (ONE_120 as i128 - log2(rest, n as u32 - 1)) as u128;
    let entropy = mul_high(u128::from(m) << (128 - n), minus_log2_q)
        + mul_high(u128::from(rest) << (128 - n), minus_log2_rest);
    complements(entropy, LOG_ERROR + 2)
}

/// `H` at scale 120 and `I = 1 - H`, with an error in units of `2^-120`.
#[inline]
fn complements(entropy: u128, error: u128) -> (Enclosure, Enclosure) {
    (Enclosure::around(entropy, error, -120), Enclosure::around(ONE_120 - entropy, error, -120))
}

/// `q < 2^-8`: `H = q G` with `G = -log2 q + (1-q) (-log2 (1-q) / q)`.
#[inline]
fn with_small_occupancy(m: u64, n: i32) -> (Enclosure, Enclosure) {
    let significand = u128::from(m) << 75;
    let q_71 = if n <= 71 { m << (71 - n) } else { shift_right(u128::from(m), n - 71) as u64 };
    let slope = log2_1p_over(q_71, true);
    let of_rest = slope - shift_right(mul_high(significand, slope), n - 53);
    let minus_log2_q = ((n - 52) as i128 * (1 << 112) - (log2(m, 52) >> 8)) as u128;
    let value = mul_high(significand, minus_log2_q + of_rest);
    from_product(value, LOG_1P_OVER_ERROR + (LOG_ERROR >> 8) + 8, n + 59)
}

/// `H = value 2^-scale`, small, with an error in units of `2^-scale`, and `I = 1 - H`.
#[inline]
fn from_product(value: u128, error: u128, scale: i32) -> (Enclosure, Enclosure) {
    let entropy = Enclosure::around(value, error, -scale);
    let at_120 = |x: u128| if scale < 120 { x << (120 - scale) } else { shift_right(x, scale - 120) };
    (entropy, Enclosure::around(ONE_120 - at_120(value), at_120(error) + 2, -120))
}

/// `H` and `I` at log-odds `±l`, `l = m 2^e`, `0 < l < 2^10`.
#[inline]
pub(super) fn from_log_odds(m: u64, e: i32) -> (Enclosure, Enclosure) {
    if is_small(e) {
        let (value, exponent) = information_series_log_odds(m, e);
        return near_unknown(value, exponent);
    }
    let (y, k, t) = exp_neg(scale_117(m, e));
    let x = shift_right(y, k);
    let inverse = reciprocal((1 << 126) + x);
    if k < 8 { with_large_odds(x, inverse, t) } else { with_small_odds(y, k, inverse, t) }
}

/// `x > 2^-8`: `H = log2 (1 + x) + t x / (1 + x)` with `t = l / ln 2` of scale 116, `x` and `1 / (1 + x)` of scale 126.
#[inline]
fn with_large_odds(x: u128, inverse: u128, t: u128) -> (Enclosure, Enclosure) {
    let w = (1 << 126) + x;
    // log2 w = log2 n + log2 (1 + rest/n), and rest/n < 2^-60: its square is below one unit.
    let (n, rest) = ((w >> 66) as u64, w & ((1 << 66) - 1));
    let ratio = (rest * (inverse >> 66)) >> 66;
    let correction = (ratio * (INV_LN2 >> 64)) >> 63;
    let log2_w = (log2(n, 60) + correction as i128) as u128;
    let q = mul_high(x << 1, inverse << 1);
    let product = mul_high(t << 8, q << 2) >> 4;
    complements(log2_w + product, 2 * LOG_ERROR)
}

/// `x <= 2^-8`: `H = x G` with `G = log2 (1 + x) / x + t / (1 + x)`, `x = y 2^-k`.
#[inline]
fn with_small_odds(y: u128, k: i32, inverse: u128, t: u128) -> (Enclosure, Enclosure) {
    let slope = log2_1p_over(shift_right(y, k + 55) as u64, false);
    let product = mul_high(t, inverse << 1) >> 3;
    let value = mul_high(y << 1, slope + product);
    // The error of y is relative, 2^-77, and G may be large.
    from_product(value, 2 * LOG_1P_OVER_ERROR + (value >> 76), k + 111)
}

/// `1 / (1 + e^-l)` at log-odds `±l`, `0 <= l < 2^10` of scale 117, cut by less than one unit.
#[inline]
pub(super) fn occupancy(l: u128, negative: bool) -> Enclosure {
    let (y, k, _) = exp_neg(l);
    let inverse = reciprocal((1 << 126) + shift_right(y, k));
    let q = mul_high(y << 1, inverse << 1);
    if negative {
        Enclosure::around(q, 2 * EXP_ERROR, -126 - k)
    } else {
        let error = shift_right(2 * EXP_ERROR, k) + 2;
        Enclosure::around((1 << 126) - shift_right(q, k), error, -126)
    }
}

/// `e^±l` for `l = m 2^e < 2^10`.
pub(super) fn exp(m: u64, e: i32, negative: bool) -> Enclosure {
    let (y, k, t) = exp_neg(scale_117(m, e));
    // e^l = 2^(k+1) 2^-(1-f), f the fraction of t.
    let fraction = t & ((1 << 116) - 1);
    let rest = (1 << 116) - 1 - fraction;
    if negative {
        Enclosure::around(y, EXP_ERROR, -126 - k)
    } else {
        Enclosure::around(exp2_neg(rest), EXP_ERROR, k - 125)
    }
}

/// `|ln x|` for `x = m 2^e`, not 1.
pub(super) fn ln(m: u64, e: i32) -> Enclosure {
    // x = 1 ± d 2^-s, within a factor of 2 of 1.
    let (d, s, negative) = if e == -52 { (m - (1 << 52), 52, false) } else { ((1 << 53) - m, 53, true) };
    if (e == -52 || e == -53) && d >> (s - 8) == 0 { ln_near_one(d, s, negative) } else { ln_by_log2(m, e) }
}

/// `|ln (1 ± d 2^-s)|` for `d 2^-s < 2^-8`.
fn ln_near_one(d: u64, s: i32, negative: bool) -> Enclosure {
    let log2_slope = log2_1p_over(d << (71 - s), negative);
    let slope = mul_high(log2_slope << 15, LN2);
    let shift = d.leading_zeros() as i32;
    let significand = u128::from(d << shift) << 64;
    let value = mul_high(significand, slope);
    Enclosure::around(value, LOG_1P_OVER_ERROR << 14, -62 - shift - s)
}

/// `|ln x| = |log2 x| ln 2` for `x = m 2^e`, not within `2^-8` of 1.
fn ln_by_log2(m: u64, e: i32) -> Enclosure {
    let log2_x = (e + 52) as i128 * (1 << 112) + (log2(m, 52) >> 8);
    let magnitude = log2_x.unsigned_abs();
    let value = mul_high(magnitude << 4, LN2 << 1);
    Enclosure::around(value, LOG_ERROR >> 4, -116)
}
