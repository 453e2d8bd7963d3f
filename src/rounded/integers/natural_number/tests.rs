//! Against `num-bigint`, and quotients against the integers between which they must lie.

use super::*;
use num_bigint::BigUint;
use proptest::collection::vec;
use proptest::prelude::*;

fn big(n: &NaturalNumber) -> BigUint {
    n.limbs.iter().rev().fold(BigUint::ZERO, |sum, &limb| (sum << 64) + limb)
}

/// Limbs of ones and zeros, where carries and estimates go wrong, are frequent.
fn limb() -> impl Strategy<Value = u64> {
    prop_oneof![any::<u64>(), Just(0), Just(u64::MAX), Just(1 << 63)]
}

/// Numbers of up to nine limbs.
fn natural() -> impl Strategy<Value = NaturalNumber> {
    vec(limb(), 0..9).prop_map(|limbs| NaturalNumber { limbs: limbs.into() }.trimmed())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn the_operations_are_those_of_integers(a in natural(), b in natural(), n in any::<u128>(), shift in 0_usize..300) {
        prop_assert_eq!(big(&a.times(&b)), big(&a) * big(&b));
        prop_assert_eq!(big(&a.shifted(shift)), big(&a) << shift);
        prop_assert_eq!(a.bits() as u64, big(&a).bits());
        prop_assert_eq!(a.cmp(&b), big(&a).cmp(&big(&b)));
        prop_assert!((a == b) == (big(&a) == big(&b)) && a != a.clone().plus(&1.into()));
        let (difference, negative) = a.difference(&b);
        let (large, small) = if negative { (&b, &a) } else { (&a, &b) };
        prop_assert_eq!(big(&difference) + big(small), big(large));
        for [a_shift, b_shift] in [[0, 0], [shift, 0], [1, shift], [shift, shift / 2]] {
            let (difference, negative) = a.shifted_difference(a_shift, &b, b_shift);
            let (a, b) = (big(&a) << a_shift, big(&b) << b_shift);
            prop_assert_eq!((big(&difference), negative), if a < b { (b - a, true) } else { (a - b, false) });
        }
        prop_assert_eq!(big(&a.clone().plus(&b)), big(&a) + big(&b));
        let mut sum = a.clone();
        sum.add_shifted(n, shift);
        prop_assert_eq!(big(&sum), big(&a) + (BigUint::from(n) << shift));
        prop_assert!(sum.limbs.last() != Some(&0));
        // In place or on the heap, whatever was there before.
        let kept = |limbs: &Limbs, wanted| {
            let mut limbs = limbs.clone();
            limbs.resize(wanted);
            limbs
        };
        for wanted in 0..12 {
            let mut expected = sum.limbs.to_vec();
            expected.resize(wanted, 0);
            prop_assert_eq!(&kept(&sum.limbs, wanted)[..], &expected[..]);
            expected.resize(5, 0);
            expected.resize(11, 0);
            prop_assert_eq!(&kept(&kept(&kept(&sum.limbs, wanted), 5), 11)[..], &expected[..]);
        }
        let [low, high] = [n, n.rotate_left(17)];
        prop_assert_eq!(big(&NaturalNumber::from([low, high])), BigUint::from(low) + (BigUint::from(high) << 128));
    }

    /// Not above the quotient, and short of it by less than one unit of 63 bits, two of 64.
    #[test]
    fn the_leading_bits_are_cut_not_rounded(n in natural(), d in natural(), near in any::<bool>(), e in -900_i32..300) {
        prop_assume!(!n.is_zero() && !d.is_zero());
        // Where the estimate of a digit is too large: a divisor whose top limb is least, and the next most.
        let mut limbs = d.limbs.to_vec();
        if near {
            limbs.extend([u64::MAX, 1 << 63]);
        }
        let d = NaturalNumber { limbs: limbs.into() };
        let (Leading { m, e: exponent }, sticky) = leading(&n, &d, e).unwrap();
        let shift = exponent - e;
        let (scaled, divisor) =
            if shift < 0 { (big(&n) << -shift, big(&d)) } else { (big(&n), big(&d) << shift) };
        let (whole, rest) = (&scaled / &divisor, &scaled % &divisor);
        prop_assert!(whole >= BigUint::from(m) && whole < BigUint::from(m) + 2_u32);
        prop_assert_eq!(sticky, whole != BigUint::from(m) || rest != BigUint::ZERO);
        prop_assert!(m >> 63 == 1 && m & 1 == 0);
    }

    /// Of two fractions that are one number.
    #[test]
    fn the_leading_bits_are_those_of_the_number(n in natural(), d in natural(), k in natural(), e in -900_i32..300) {
        prop_assume!(!d.is_zero() && !k.is_zero());
        let parts = |n, d| leading(n, d, e).map(|(Leading { m, e }, sticky)| (m, e, sticky));
        prop_assert_eq!(parts(&n, &d), parts(&n.times(&k), &d.times(&k)));
    }

    /// By a divisor of two limbs in 128 bits and limb by limb; where the estimate is too large, too.
    #[test]
    fn short_and_long_division_agree(
        n in [limb(), limb()], shift in 0_usize..64, d in [limb(), limb()], near in any::<bool>(),
    ) {
        let number = |[low, high]: [u64; 2]| NaturalNumber::from([u128::from(high) << 64 | u128::from(low), 0]);
        let (n, divisor) = (number(n).shifted(shift), number(if near { [d[0], 1 << 63] } else { d }));
        prop_assume!(!n.is_zero() && !divisor.is_zero());
        let scale = (divisor.bits() + 63) as i64 - n.bits() as i64;
        let (normalised, normalising) = short(&divisor).unwrap();
        prop_assert_eq!(big(&NaturalNumber::from([normalised, 0])), big(&divisor) << normalising);
        let moved = (scale + i64::from(normalising)) as usize;
        prop_assert_eq!(short_digit(&n, moved, normalised), long_digit(&n, scale, &divisor));
    }

    /// `x` is nearest to `n 2^e / d` if and only if `|2^k x d - 2^(k+e) n|` is at most half a spacing times `2^k d`.
    #[test]
    fn a_quotient_is_the_nearest_float(n in natural(), d in natural(), e in -900_i32..300) {
        prop_assume!(!d.is_zero());
        let x: f64 = round_quotient(&n, &d, e);
        prop_assume!(x.is_finite());
        let (m, exponent) = x.parts();
        let k = (-exponent + 1).max(-e);
        let exact = big(&n) << (k + e);
        let (found, half) = ((big(&d) * m) << (k + exponent), big(&d) << (k + exponent - 1));
        let error = if exact > found { &exact - &found } else { &found - &exact };
        prop_assert!(error < half || error == half && m % 2 == 0 || m == 1 << 52 && exact < found && error <= half);
        prop_assert!(!(m == 1 << 52 && exact < found && exponent > -1074) || error * 2_u32 <= half);
    }

    /// Exactly half-way between two floats, and a little beside.
    #[test]
    fn ties_go_to_even(m in 1_u64 << 52..1 << 53, d in natural(), e in -1000_i32..900) {
        prop_assume!(!d.is_zero());
        let midpoint = d.times(&NaturalNumber::from(2 * m + 1));
        let even = f64::from_parts(m + m % 2, e + 1);
        prop_assert_eq!(round_quotient::<f64>(&midpoint, &d, e), even);
        let wide = d.shifted(80);
        let near = midpoint.shifted(80).plus(&NaturalNumber::from(1));
        prop_assert_eq!(round_quotient::<f64>(&near, &wide, e), f64::from_parts(m + 1, e + 1));
    }
}
