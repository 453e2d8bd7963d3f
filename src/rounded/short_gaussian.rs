//! `e^-r` with `r = (x - z)^2 / (2 s^2)` in 64 bits, which decide the nearest float of most arguments.
//!
//! The error is derived in [`docs/rounding.md`](crate::book::rounding), "The enclosures", 11.

use super::constants::{EXP_R, EXP_TABLE, INV_LN2, LN2};
use super::fixed::horner;
use super::round::FixedEnclosure;
use super::ziv::normalised;
use crate::real::Real;

/// The error of [`short_gaussian`], in units of `2^-62`: below `2^-58`.
const SHORT_ERROR: u128 = 16;

/// Encloses `e^-r` for `s = m 2^e`, `2^52 <= m < 2^53`, and unequal finite `x` and `z` within a factor of two of each other, for `r`
/// from `2^-61` to below 4; `None` for others.
#[inline]
pub(super) fn short_gaussian<T: Real>(x: T, z: T, m: u64, e: i32) -> Option<FixedEnclosure> {
    // Both are positive then, and their difference is a float (Sterbenz).
    if !(x <= z + z && z <= x + x) {
        return None;
    }
    let (d, exponent) = normalised(x - z);
    // 1 / m, scale 116, of 64 bits; d / m, scale 63 = 11 + 116 - 64.
    let inverse = ((1 << 116) - 1) / u128::from(m);
    let ratio = (u128::from(d << 11) * inverse) >> 64;
    // r, scale 62: the square of the ratio has scale 126, and half of it 127.
    let shift = 65 - 2 * (exponent - e);
    if !(0..128).contains(&shift) {
        return None;
    }
    let r = u64::try_from((ratio * ratio) >> shift).ok()?;
    // r / ln 2, scale 125 = 62 + 63: 3 bits before the point, 8 that choose from the table, and g of 64 bits, scale 72.
    let t = u128::from(r) * (INV_LN2 >> 64);
    let (k, i, g) = ((t >> 125) as i32, usize::from((t >> 117) as u8), (t >> 53) as u64);
    let g_71 = (g >> 1) as i64;
    // ln 2 - g R(g), scale 64 = 71 + 63 - 70.
    let slope = (LN2 >> 63) as u64 - ((i128::from(g_71) * i128::from(horner(&EXP_R, g_71, 71))) >> 70) as u64;
    // 2^-g, scale 63: g slope has scale 136.
    let power = (1 << 63) - ((u128::from(g) * u128::from(slope)) >> 73);
    // e^-r 2^k, scale 62 = 63 + 63 - 64.
    let y = ((EXP_TABLE[i] >> 64) * power) >> 64;
    Some(FixedEnclosure::around(y, SHORT_ERROR, -62 - k))
}

#[cfg(test)]
mod tests {
    use super::super::fixed::exp_neg;
    use super::super::gaussian::{Distance, half_square};
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        /// It holds what 128 bits say, which are within `2^-78`, as long as it says anything: always below `r = 4`.
        #[test]
        fn it_holds_the_value_of_128_bits(z in 1e-3_f64..100.0, s in 1e-3_f64..1.0, t in prop_oneof![-2.8_f64..2.8, -1e-6..1e-6]) {
            let x = z + s * t;
            let (m, e) = normalised(s);
            let is_near = x > z * 0.5 && x < z * 2.0;
            let short = if x == z { None } else { short_gaussian(x, z, m, e) };
            prop_assert!(short.is_some() || !is_near || x == z || (x - z).abs() < s * 1e-9);
            if let Some(FixedEnclosure { lo, width, exponent }) = short {
                let (d, unit) = Distance::new(x, z, -52 - e).cut();
                let (y, k, _) = exp_neg(half_square(d, unit, m).unwrap());
                // From scale 62 + j to 126 + k, less what the longer one may be off.
                let shift = 64 + k + exponent + 62;
                let (y, error) = (y >> 1, 1 << 49);
                prop_assert!((lo << (shift - 1)) + error <= y && y + error <= (lo + width) << (shift - 1), "{} {} {}", x, z, s);
            }
        }
    }

    #[test]
    fn it_says_nothing_of_what_it_is_not_made_for() {
        let (m, e) = normalised(0.5);
        // Further than a factor of two, of the other sign, r = 4 and more, and below 2^-61.
        for (x, z) in [(0.9, 2.0), (4.5, 2.0), (0.0, 1.0), (-1.0, 1.0), (-1.5, -1.0), (5.0, 3.5), (9.0, 5.0)]
        {
            assert!(short_gaussian(x, z, m, e).is_none(), "{x} {z}");
        }
        for (s, is_said) in [(1e-8, true), (1e5, false)] {
            let (m, e) = normalised(s);
            assert_eq!(short_gaussian(1.0, 1.0_f64.next_up(), m, e).is_some(), is_said);
        }
    }
}
