//! Step 1 of Ziv's strategy: enclosures of the value at most `2^-66` wide, relative to it.
//!
//! Notation of [`docs/rounding.md`](crate::book::rounding): `q = min(p, 1-p)`, `d = |2p - 1|`, `l` the magnitude of the
//! log-odds, `x = e^-l`, so that `q = x / (1 + x)`. Significands `m` are in `[2^52, 2^53)`. Numbers in comments, as
//! (3), are those of its section "The enclosures", where each error is derived.

use super::constants::{INV_LN2, LN2};
use super::fixed::{
    EXP_ERROR, LOG_1P_OVER_ERROR, LOG_ERROR, ONE_120, SERIES_ERROR, exp_neg, exp2_neg, floor_71, floor_117,
    information_series, information_series_log_odds, log2, log2_1p_over, minus_log2_112, minus_log2_120,
    mul_high, reciprocal, shift_right,
};
use super::round::FixedEnclosure;

/// Encloses `H(p)` and `I(p)` for `p = m 2^e` in `(0, 1)`, not 1/2.
#[inline]
pub(super) fn from_occupancy(m: u64, e: i32) -> (FixedEnclosure, FixedEnclosure) {
    let n = -e;
    if let Some(d) = distance_from_unknown(m, n) {
        return with_information_series(d, n);
    }
    let (m, n) = smaller_probability(m, n);
    if n <= 60 { with_two_logarithms(m, n) } else { with_small_occupancy(m, n) }
}

/// Encloses `H(p)` and `I(p)` at `|2p - 1| = d 2^-n < 2^-4`, `d < 2^53` (1): `I` by its series in `d^2`.
#[inline]
pub(super) fn with_information_series(d: u64, n: i32) -> (FixedEnclosure, FixedEnclosure) {
    let (value, exponent) = information_series(d, n);
    from_series(value, exponent)
}

/// Returns `d` with `|2p - 1| = d 2^-n` for `p = m 2^-n`, exactly, if that is below `2^-4`.
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

/// Returns true if `l = m 2^e` is below `2^-3`, where `2^52 <= m < 2^53`.
#[inline]
pub(super) fn is_small(e: i32) -> bool {
    e < -55
}

/// Returns the significand and the negated exponent of `q = min(p, 1 - p)` for `p = m 2^-n`, exactly.
#[inline]
pub(super) fn smaller_probability(m: u64, n: i32) -> (u64, i32) {
    // p >= 1/2 if and only if n = 53; then 1 - p is normalised again.
    if n == 53 {
        let rest = (1 << 53) - m;
        let shift = rest.leading_zeros() as i32 - 11;
        (rest << shift, 53 + shift)
    } else {
        (m, n)
    }
}

/// Encloses `H = 1 - I` and `I`, given `I` by one of the two series (1, 4).
#[inline]
fn from_series(value: u128, exponent: i32) -> (FixedEnclosure, FixedEnclosure) {
    // The series' error, the unit of its last product, and one to spare: below 2^-69 of I (1), 2^-67 (4).
    let information = FixedEnclosure::around(value, SERIES_ERROR + 2, exponent);
    // I < 2^-8 at scale 120: cut by less than one unit, and so is the error that it brings, hence two more.
    let cut = shift_right(value, -120 - exponent);
    let error = shift_right(SERIES_ERROR + 2, -120 - exponent) + 2;
    (FixedEnclosure::around(ONE_120 - cut, error, -120), information)
}

/// Encloses `H = -q log2 q - (1-q) log2 (1-q)` and `I = 1 - H` for `q = m 2^-n >= 2^-8` (2).
#[inline]
fn with_two_logarithms(m: u64, n: i32) -> (FixedEnclosure, FixedEnclosure) {
    let rest = (1 << n) - m;
    let minus_log2_q = minus_log2_120(m, 52, n) as u128;
    let minus_log2_rest = minus_log2_120(rest, n as u32 - 1, n) as u128;
    // The weights q and 1 - q have scale 128, so that mul_high keeps scale 120; it floors twice.
    let entropy = mul_high(u128::from(m) << (128 - n), minus_log2_q)
        + mul_high(u128::from(rest) << (128 - n), minus_log2_rest);
    // The weights add to 1: the error is that of one logarithm, and the two floors (2).
    complements(entropy, LOG_ERROR + 2)
}

/// Encloses `H`, given at scale 120 with an error in units of `2^-120`, and `I = 1 - H`, which has the same error.
#[inline]
fn complements(entropy: u128, error: u128) -> (FixedEnclosure, FixedEnclosure) {
    (FixedEnclosure::around(entropy, error, -120), FixedEnclosure::around(ONE_120 - entropy, error, -120))
}

/// Encloses `H = q G` with `G = -log2 q + (1-q) (-log2 (1-q) / q)`, and `I`, for `q = m 2^-n < 2^-8` (3). Nothing
/// cancels in `G`, so `H` keeps its relative precision however small `q` is.
#[inline]
fn with_small_occupancy(m: u64, n: i32) -> (FixedEnclosure, FixedEnclosure) {
    // q = significand 2^(-75 - n): its leading one at bit 127.
    let significand = u128::from(m) << 75;
    // q cut to scale 71, for the slope only: log2_1p_over allows for the cut (lemma "fall").
    let q_71 = floor_71(m, n);
    // -log2 (1-q) / q, scale 112.
    let slope = log2_1p_over(q_71, true);
    // (1-q) times the slope, scale 112: the mul_high is q slope 2^(n - 53). Two floors.
    let of_rest = slope - shift_right(mul_high(significand, slope), n - 53);
    let minus_log2_q = minus_log2_112(m, n) as u128;
    // q G, scale n + 59 = 75 + n + 112 - 128.
    let value = mul_high(significand, minus_log2_q + of_rest);
    // The errors of the slope and of the logarithm at scale 112, and at most 8 floors (3): 2^-73 of G > 9.
    from_product(value, LOG_1P_OVER_ERROR + (LOG_ERROR >> 8) + 8, n + 59)
}

/// Encloses `H = value 2^-scale < 2^-4`, with an error in units of `2^-scale`, and `I = 1 - H`.
#[inline]
fn from_product(value: u128, error: u128, scale: i32) -> (FixedEnclosure, FixedEnclosure) {
    let entropy = FixedEnclosure::around(value, error, -scale);
    // I needs no more than scale 120. Value and error are each cut by less than one unit: two more.
    let at_120 = |x: u128| if scale < 120 { x << (120 - scale) } else { shift_right(x, scale - 120) };
    (entropy, FixedEnclosure::around(ONE_120 - at_120(value), at_120(error) + 2, -120))
}

/// Encloses `H` and `I` at log-odds `±l`, `l = m 2^e`, `0 < l < 2^10`.
#[inline]
pub(super) fn from_log_odds(m: u64, e: i32) -> (FixedEnclosure, FixedEnclosure) {
    if is_small(e) {
        let (value, exponent) = information_series_log_odds(m, e);
        return from_series(value, exponent);
    }
    // e^-l = y 2^-k, y of scale 126, and t = l / ln 2 of scale 116.
    let (y, k, t) = exp_neg(floor_117(m, e));
    // x and 1 + x at scale 126, where an absolute error is enough: 1 + x is at least 1.
    let x = shift_right(y, k);
    let inverse = reciprocal((1 << 126) + x);
    if k < 8 { with_large_odds(x, inverse, t) } else { with_small_odds(y, k, inverse, t) }
}

/// Encloses `H = log2 (1 + x) + t x / (1 + x)` and `I = 1 - H` for `x > 2^-8` (5), given `t = l / ln 2` of scale 116,
/// `x` and `inverse = 1 / (1 + x)` of scale 126.
#[inline]
fn with_large_odds(x: u128, inverse: u128, t: u128) -> (FixedEnclosure, FixedEnclosure) {
    let w = (1 << 126) + x;
    // log2 w = log2 n + log2 (1 + rest/n), n the leading 61 bits; rest/n < 2^-60, so its square is below one unit of
    // 2^-120 (lemma "square").
    let (n, rest) = ((w >> 66) as u64, w & ((1 << 66) - 1));
    // rest/n as rest/w, scale 120 = 126 + 60 - 66.
    let ratio = (rest * (inverse >> 66)) >> 66;
    // Times 1 / ln 2, scale 120 = 120 + 63 - 63.
    let correction = (ratio * (INV_LN2 >> 64)) >> 63;
    let log2_w = (log2(n, 60) + correction as i128) as u128;
    // q = x / (1 + x), scale 126 = 127 + 127 - 128.
    let q = mul_high(x << 1, inverse << 1);
    // t q, scale 120 = 124 + 128 - 128 - 4.
    let product = mul_high(t << 8, q << 2) >> 4;
    // 1.5 2^-78 of y (lemmas "middle", "halving") and the 2^-77.66 of log2: below 2^-76.5 (5).
    complements(log2_w + product, 2 * LOG_ERROR)
}

/// Encloses `H = x G` with `G = log2 (1 + x) / x + t / (1 + x)`, and `I`, for `x = y 2^-k <= 2^-8` (6), `y` and
/// `inverse` of scale 126, `t` of scale 116. Nothing cancels in `G`.
#[inline]
fn with_small_odds(y: u128, k: i32, inverse: u128, t: u128) -> (FixedEnclosure, FixedEnclosure) {
    // x cut to scale 71 = 126 - 55, below 2^63 (lemma "eight ln 2"); the slope has scale 112.
    let slope = log2_1p_over(shift_right(y, k + 55) as u64, false);
    // t / (1 + x), scale 112 = 116 + 127 - 128 - 3.
    let product = mul_high(t, inverse << 1) >> 3;
    // y G, scale 111 = 127 + 112 - 128.
    let value = mul_high(y << 1, slope + product);
    // The error of G, and that of y, which is relative, 2^-77, and meets a G that may be large (6).
    from_product(value, 2 * LOG_1P_OVER_ERROR + (value >> 76), k + 111)
}

/// Encloses `1 / (1 + e^-l)` at log-odds `±l` (7), `0 <= l < 2^10` of scale 117, cut by less than one unit.
#[inline]
pub(super) fn occupancy(l: u128, negative: bool) -> FixedEnclosure {
    let (y, k, _) = exp_neg(l);
    // 1 / (1 + x) and q 2^k = y / (1 + x), both of scale 126.
    let inverse = reciprocal((1 << 126) + shift_right(y, k));
    let q = mul_high(y << 1, inverse << 1);
    // q 2^k has a derivative of at most 1 in y, so EXP_ERROR of y stays EXP_ERROR, and as much again holds all floors.
    if negative {
        FixedEnclosure::around(q, 2 * EXP_ERROR, -126 - k)
    } else {
        // 1 - q: value and error cut by 2^k, each by less than one unit.
        let error = shift_right(2 * EXP_ERROR, k) + 2;
        FixedEnclosure::around((1 << 126) - shift_right(q, k), error, -126)
    }
}

/// Encloses `e^±l` for `l = m 2^e < 2^10` (8).
pub(super) fn exp(m: u64, e: i32, negative: bool) -> FixedEnclosure {
    let (y, k, t) = exp_neg(floor_117(m, e));
    // e^l = 2^(k+1) 2^-(1-f), f the fraction of t, scale 116; 1 - f a unit short, so that it stays below 1.
    let fraction = t & ((1 << 116) - 1);
    let rest = (1 << 116) - 1 - fraction;
    if negative {
        FixedEnclosure::around(y, EXP_ERROR, -126 - k)
    } else {
        FixedEnclosure::around(exp2_neg(rest), EXP_ERROR, k - 125)
    }
}

/// Encloses `|ln x|` for `x = m 2^e`, not 1.
pub(super) fn ln(m: u64, e: i32) -> FixedEnclosure {
    // x = 1 ± d 2^-s, within a factor of 2 of 1.
    let (d, s, negative) = if e == -52 { (m - (1 << 52), 52, false) } else { ((1 << 53) - m, 53, true) };
    if (e == -52 || e == -53) && d >> (s - 8) == 0 { ln_near_one(d, s, negative) } else { ln_by_log2(m, e) }
}

/// Encloses `|ln (1 ± d 2^-s)| = d 2^-s (log2 (1 + z) / z) ln 2`, `z = ±d 2^-s`, for `d 2^-s < 2^-8` (9).
fn ln_near_one(d: u64, s: i32, negative: bool) -> FixedEnclosure {
    // z is exact at scale 71, as s is at most 53.
    let log2_slope = log2_1p_over(d << (71 - s), negative);
    // ln (1 + z) / z, scale 126 = 127 + 127 - 128.
    let slope = mul_high(log2_slope << 15, LN2);
    // d with its leading one at bit 127: nothing of z is lost.
    let shift = d.leading_zeros() as i32;
    let significand = u128::from(d << shift) << 64;
    let value = mul_high(significand, slope);
    // The slope's error from scale 112 to 126, times ln 2 < 0.7, leaves room for the two floors (9).
    FixedEnclosure::around(value, LOG_1P_OVER_ERROR << 14, -62 - shift - s)
}

/// Encloses `|ln x| = |log2 x| ln 2` for `x = m 2^e`, not within `2^-8` of 1 (10).
fn ln_by_log2(m: u64, e: i32) -> FixedEnclosure {
    // Scale 112 holds exponents down to -1074.
    let minus_log2_x = minus_log2_112(m, -e);
    let magnitude = minus_log2_x.unsigned_abs();
    // Scale 116 = 116 + 128 - 128.
    let value = mul_high(magnitude << 4, LN2 << 1);
    // LOG_ERROR from scale 120 to 116, times ln 2 < 0.7, leaves room for the floors (10).
    FixedEnclosure::around(value, LOG_ERROR >> 4, -116)
}
