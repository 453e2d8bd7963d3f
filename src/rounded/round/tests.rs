//! Rounding, exhaustively where it is hard: against the conversions of the standard library, which are exact.

use super::*;

/// `v 2^exponent`, exact for a small `v` and `exponent >= -1000`.
fn power(exponent: i32) -> f64 {
    f64::from_parts(1, exponent)
}

/// Judges one enclosure in `f32` by the conversion from `f64`, where all of its numbers are exact.
fn check_single(lo: u128, width: u128, exponent: i32) {
    let at = |v: u128| v as f64 * power(exponent);
    match (FixedEnclosure { lo, width, exponent }).round::<f32>() {
        Rounded::Decided(x) => {
            assert_eq!((at(lo) as f32, at(lo + width) as f32), (x, x), "{lo} + {width}, {exponent}");
        }
        Rounded::Between { below, above, midpoint } => {
            let value = midpoint.m as f64 * power(midpoint.exponent);
            assert!(at(lo) <= value && value <= at(lo + width), "the enclosure holds the midpoint");
            assert_eq!(above, below.next_up());
            assert_eq!(value, f64::midpoint(below.into(), above.into()));
        }
    }
}

#[test]
fn enclosures_of_single_precision_round_to_what_all_their_numbers_round_to() {
    // Significands at both ends of a binade and in between; exponents from the normal range down to where all is 0.
    for kept in [1 << 23, (1 << 23) + 1, 0xc0_0001, (1 << 24) - 2, (1 << 24) - 1] {
        for exponent in [-80, -148, -155, -156, -160, -175, -177, -178, -179, -180, -185, -190] {
            for rest in 0..1 << 6 {
                for width in 0..1 << 4 {
                    check_single(kept << 6 | rest, width, exponent);
                }
            }
        }
    }
    // Subnormal results of few bits, down to the midpoint between 0 and the smallest.
    for lo in 0..1 << 10 {
        for width in 0..1 << 4 {
            check_single(lo, width, -149 - 6);
            check_single(lo, width, -149 - 8);
        }
    }
}

#[test]
fn enclosures_of_double_precision_round_to_what_all_their_numbers_round_to() {
    // Subnormal: units of 2^-8 of the smallest number, rounded by the standard library.
    let to_even = |v: u128| f64::from_bits((v as f64 / 256.0).round_ties_even() as u64);
    for lo in 0..1 << 12 {
        for width in 0..1 << 5 {
            match (FixedEnclosure { lo, width, exponent: -1074 - 8 }).round::<f64>() {
                Rounded::Decided(x) => assert_eq!((to_even(lo), to_even(lo + width)), (x, x)),
                Rounded::Between { below, above, midpoint } => {
                    assert_eq!(above, below.next_up());
                    let Midpoint { m, exponent: -1075 } = midpoint else { panic!("{midpoint:?}") };
                    assert_eq!(m, 2 * below.to_bits() + 1);
                    assert!(lo <= u128::from(m) << 7 && u128::from(m) << 7 <= lo + width);
                }
            }
        }
    }
    // Normal: the conversion of integers.
    for kept in [1_u128 << 52, (1 << 52) + 1, (1 << 53) - 2, (1 << 53) - 1] {
        for rest in 0..1 << 7 {
            for width in 0..1 << 5 {
                let lo = kept << 7 | rest;
                match (FixedEnclosure { lo, width, exponent: 0 }).round::<f64>() {
                    Rounded::Decided(x) => assert_eq!((lo as f64, (lo + width) as f64), (x, x)),
                    Rounded::Between { below, above, midpoint } => {
                        assert_eq!((below, above), ((kept << 7) as f64, ((kept + 1) << 7) as f64));
                        assert_eq!(midpoint, Midpoint { m: 2 * kept as u64 + 1, exponent: 6 });
                        assert!((lo..=lo + width).contains(&(u128::from(midpoint.m) << 6)));
                    }
                }
            }
        }
    }
}

#[test]
fn an_enclosure_far_below_the_smallest_number_is_zero() {
    for exponent in [-1074 - 127, -1074 - 128, -1074 - 140, -1500] {
        let Rounded::Decided(x) = (FixedEnclosure { lo: 1 << 125, width: 1 << 40, exponent }).round::<f64>()
        else {
            panic!("undecided at {exponent}");
        };
        // At the first, lo is 2^-1076: a quarter of the smallest number.
        assert_eq!(x.to_bits(), 0);
    }
    let around = FixedEnclosure::around(5, 7, -3);
    assert_eq!((around.lo, around.width, around.exponent), (0, 14, -3), "no less than 0");
}

#[test]
fn integers_of_limbs_round_like_the_conversions_of_the_standard_library() {
    // Patterns with the rounding position of both formats at every bit, and ties.
    let patterns = (0..128_u32).flat_map(|k| {
        let one = 1_u128 << k;
        let tie = |bits: u32| (one | one >> 1 | one >> (bits - 1)) | one.checked_shr(bits).unwrap_or(0);
        [
            one,
            one - 1,
            one | one >> 3,
            tie(24),
            tie(53),
            tie(53) ^ one >> 52,
            tie(24) ^ one >> 23,
            one.wrapping_neg(),
        ]
    });
    for m in patterns.filter(|&m| m > 0) {
        let limbs = [m as u64, (m >> 64) as u64];
        assert_eq!(round_limbs::<f64>(&limbs, 0, false), m as f64, "{m:#x}");
        assert_eq!(round_limbs::<f32>(&limbs, 0, false), m as f32, "{m:#x}");
        assert_eq!(round_limbs::<f64>(&limbs, -1100, false), m as f64 * power(-500) * power(-600), "{m:#x}");
        if m >= 1 << 60 {
            // A little more, below the bits of m or in limbs below, is like the lowest bit.
            let [expected, even] = [m | 1, m & !1];
            let (low, high) = (even as u64, (even >> 64) as u64);
            assert_eq!(round_limbs::<f64>(&[low, high], 0, true), expected as f64, "{m:#x}");
            assert_eq!(round_limbs::<f64>(&[7, 0, low, high, 0], -128, false), expected as f64, "{m:#x}");
            assert_eq!(round_limbs::<f32>(&[7, 0, low, high, 0], -128, false), expected as f32, "{m:#x}");
        }
    }
    assert_eq!(round_limbs::<f64>(&[0, 0, 0], 5, false), 0.0);
    assert_eq!(round_limbs::<f32>(&[], 0, false), 0.0);
}

#[test]
fn small_integers_round_into_the_subnormal_range() {
    for m in 0..1_u64 << 12 {
        let expected = (m as f64 / 64.0).round_ties_even() as u64;
        assert_eq!(round_limbs::<f64>(&[m, 0], -1080, false).to_bits(), expected);
        assert_eq!(u64::from(round_limbs::<f32>(&[m], -155, false).to_bits()), expected);
        let above = ((2 * m + 1) as f64 / 128.0).round() as u64;
        assert_eq!(round_limbs::<f64>(&[m], -1080, true).to_bits(), above);
    }
    // All bits are below half of the smallest number.
    assert_eq!(round_limbs::<f64>(&[u64::MAX, u64::MAX], -1074 - 129, true).to_bits(), 0);
    assert_eq!(round_limbs::<f64>(&[u64::MAX, u64::MAX], -1074 - 128, true).to_bits(), 1);
}

/// Three quarters of the smallest float, in the top bits of the integer.
#[test]
fn the_smallest_float_of_the_largest_integers() {
    fn rounded<T: Real>(lo: u128) -> Rounded<T> {
        FixedEnclosure { lo, width: 1, exponent: T::MIN_EXPONENT - 127 }.round()
    }
    assert!(matches!(rounded::<f64>(3 << 125), Rounded::Decided(x) if x == f64::from_bits(1)));
    assert!(matches!(rounded::<f32>(3 << 125), Rounded::Decided(x) if x == f32::from_bits(1)));
    assert!(matches!(rounded::<f64>(1 << 125), Rounded::Decided(0.0)));
}
