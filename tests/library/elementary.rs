//! The elementary functions against another correctly rounded implementation, their inverses, and their special cases.

use approx::abs_diff_eq;
use mean_information::Real;
use mean_information::cell::entropy;
use mean_information::elementary::{exp, ln, sqrt};
use mean_information::scalar::Scalar;
use proptest::prelude::*;

fn positive() -> impl Strategy<Value = f64> {
    prop_oneof![
        (1..f64::MAX.to_bits()).prop_map(f64::from_bits),
        (0.5_f64..2.0),
        (1_i32..=52, any::<bool>())
            .prop_map(|(k, up)| 1.0 + f64::from_parts(1, -k) * if up { 1.0 } else { -0.5 }),
    ]
}

/// Whether `x` is within 2 ulp of what rounds to `rounded`, half an ulp apart.
fn within_two_ulp<T: Real>(x: T, rounded: T) -> bool {
    let (m, e) = rounded.abs().parts();
    let ulp = T::from_parts(m + 1, e) - T::from_parts(m, e);
    x == rounded || (x - rounded).abs() <= ulp + ulp + ulp * T::HALF
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn they_agree_with_core_math_to_the_bit(x in positive(), y in -746.0_f64..710.0) {
        prop_assert_eq!(ln(x), core_math::log(x));
        prop_assert_eq!(exp(y), core_math::exp(y));
        prop_assert_eq!(exp(y.fract()), core_math::exp(y.fract()));
        let (x, y) = (x as f32, (y / 7.0) as f32);
        prop_assert_eq!(ln(x), core_math::logf(x));
        prop_assert_eq!(exp(y), core_math::expf(y));
        prop_assert_eq!(sqrt(f64::from(x)) as f32, sqrt(x));
    }

    /// The complement of the occupancy, and the entropy from its logarithm, within 2 ulp also next to certainty.
    #[test]
    fn next_to_certainty(x in -1.0_f64..1.0, k in 0_i32..1060, l in -800.0_f64..-0.5) {
        let scaled = x * f64::from_parts(1, -k / 2) * f64::from_parts(1, -(k + 1) / 2);
        for x in [x, x / 4.0, scaled, 700.0 * x] {
            prop_assert!(within_two_ulp(Scalar::exp_m1(x), core_math::expm1(x)), "{:e}", x);
            prop_assert!(within_two_ulp(Scalar::exp_m1(x as f32), core_math::expm1f(x as f32)), "{:e}", x);
            let (l, single) = (-x.abs(), -(x as f32).abs());
            let expected = if l > -0.5 { entropy(-core_math::expm1(l)) } else { entropy(exp(l)) };
            prop_assert!(within_two_ulp(l.entropy_from_log_occupancy(), expected), "{:e}", l);
            let expected = entropy(-core_math::expm1(f64::from(single))) as f32;
            prop_assert!(single < -0.5 || within_two_ulp(single.entropy_from_log_occupancy(), expected), "{:e}", single);
        }
        prop_assert!(within_two_ulp(l.entropy_from_log_occupancy(), entropy(exp(l))), "{:e}", l);
    }

    /// Integers decide: the nearest float to the root of `x` has neighbours' midpoints on either side.
    #[test]
    fn the_root_is_the_nearest(m in 1_u64..1 << 53, e in -20_i32..20) {
        let (root_m, root_e) = sqrt(f64::from_parts(m, 2 * e)).parts();
        // 2 root ± 1 at half the last place, squared, against 4 m 2^(2 e - 2 root_e).
        let shift = 2 * (e - root_e);
        prop_assume!((0..=70).contains(&shift));
        let square = u128::from(m) << (shift as u32 + 2);
        let twice = 2 * u128::from(root_m);
        prop_assert!((twice - 1).pow(2) < square && square < (twice + 1).pow(2));
    }

    #[test]
    fn logarithm_inverts_exponential(x in -700.0_f64..700.0) {
        // Half an ulp of e^x moves ln by 2^-53; both round.
        prop_assert!(abs_diff_eq!(ln(exp(x)), x, epsilon = f64::EPSILON * (1.0 + x.abs())));
    }

    #[test]
    fn rounding_keeps_them_monotone(x in -745.0_f64..709.0, y in positive()) {
        prop_assert!(exp(x) <= exp(x.next_up()));
        prop_assert!(ln(y) <= ln(y.next_up()));
        prop_assert!(sqrt(y) <= sqrt(y.next_up()));
    }
}

fn special_cases<T: Real>() {
    let (zero, one, infinity) = (T::zero(), T::one(), T::infinity());
    assert_eq!([exp(zero), exp(-zero), exp(-infinity), exp(infinity)], [one, one, zero, infinity]);
    assert_eq!([exp(T::max_value()), exp(T::min_value())], [infinity, zero]);
    assert_eq!([exp(T::min_positive_value()), exp(-T::min_positive_value())], [one, one]);
    assert_eq!([ln(zero), ln(one), ln(infinity)], [T::neg_infinity(), zero, infinity]);
    assert_eq!([sqrt(zero), sqrt(one), sqrt(infinity)], [zero, one, infinity]);
    assert!(sqrt(T::neg_zero()).is_sign_negative());
    assert!([exp(T::nan()), ln(T::nan()), sqrt(T::nan())].iter().all(|x| x.is_nan()));
    assert!(
        [ln(-one), ln(T::neg_infinity()), sqrt(-one), sqrt(T::neg_infinity())].iter().all(|x| x.is_nan())
    );
}

#[test]
fn the_special_cases_hold_in_both_formats() {
    special_cases::<f32>();
    special_cases::<f64>();
}

#[test]
fn overflow_and_underflow_begin_where_they_must() {
    assert_eq!(exp(709.782_712_893_384_f64), 1.797_693_134_862_273_2e308);
    assert_eq!(exp(709.782_712_893_384_1_f64), f64::INFINITY);
    assert_eq!(exp(-745.133_219_101_941_1_f64).to_bits(), 1);
    assert_eq!(exp(-745.133_219_101_941_2_f64), 0.0);
    assert_eq!(ln(f64::from_bits(1)), -744.440_071_921_381_2);
    assert_eq!(exp(88.722_84_f32), f32::INFINITY);
}
