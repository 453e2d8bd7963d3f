//! Enclosures of `e^x` and `ln x` at arguments of 128 bits, by the kernels of 53 bits: for the intervals of 128 bits.
//!
//! Significands `m` are in `[2^127, 2^128)`. The bounds are proved in [`integration`](crate::book::integration).

use super::constants::{INV_LN2, LN2};
use super::fixed::{
    EXP_ERROR, LOG_1P_OVER_ERROR, LOG_ERROR, exp_neg, exp2_neg, log2, log2_1p_over, mul_high,
};
use super::round::FixedEnclosure;

/// The constant `ln 2`, scale 127, to nearest.
pub(crate) const LN_2: u128 = LN2;

/// Encloses `e^±l` for `l = m 2^e < 2^10`.
pub(crate) fn exp(m: u128, e: i32, negative: bool) -> FixedEnclosure {
    // Scale 117; cut by less than one unit.
    let l = m.checked_shr((-117 - e) as u32).unwrap_or(0);
    let (y, k, t) = exp_neg(l);
    if negative {
        return FixedEnclosure::around(y, EXP_ERROR, -126 - k);
    }
    // e^l = 2^(k+1) 2^-(1-f), f the fraction of t.
    let rest = (1 << 116) - 1 - (t & ((1 << 116) - 1));
    FixedEnclosure::around(exp2_neg(rest), EXP_ERROR, k - 125)
}

/// Encloses `|ln x|`, and returns true with it if `x < 1`, for `x = m 2^e` not within `2^-8` of 1, with `|e| < 2^14`.
pub(crate) fn ln(m: u128, e: i32) -> (FixedEnclosure, bool) {
    // x = (n + rest 2^-67) 2^(e + 67), and rest / n, of 2^-67, is below 2^-60: its square is below 2^-120.
    let (n, rest) = ((m >> 67) as u64, m & ((1 << 67) - 1));
    // Scale 93: 2^-30 of it is lost, and 2^-91.
    let ratio = ((rest >> 35) as u64) << 31;
    let ratio = ratio / (n >> 30);
    // Times 1 / ln 2 at scale 63, from scale 156 to the 120 of the logarithm.
    let correction = (u128::from(ratio) * (INV_LN2 >> 64)) >> 36;
    // Scale 112, which holds exponents up to 2^14.
    let log2_x = i128::from(e + 127) * (1 << 112) + ((log2(n, 60) + correction as i128) >> 8);
    // Scale 111 = 112 + 127 - 128; the error is below 2^-77.4 (integration.md), and 2^-76 is stated.
    let value = mul_high(log2_x.unsigned_abs(), LN2);
    (FixedEnclosure::around(value, LOG_ERROR >> 8, -111), log2_x < 0)
}

/// Encloses `ln(1 + z) / z` for `z = ±m 2^e`, `|z| < 2^-8`.
pub(crate) fn ln_1p_over(m: u128, e: i32, negative: bool) -> FixedEnclosure {
    // Scale 71; cut by less than one unit.
    let z = m.checked_shr((-71 - e) as u32).unwrap_or(0) as u64;
    // Scale 126 = 127 + 127 - 128.
    let slope = mul_high(log2_1p_over(z, negative) << 15, LN2);
    FixedEnclosure::around(slope, LOG_1P_OVER_ERROR << 14, -126)
}
