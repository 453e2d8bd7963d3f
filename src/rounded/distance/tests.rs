//! Distances against squares of big integers, with ties and cancellation sought out.

use super::*;
use num_bigint::BigInt;
use proptest::prelude::*;

/// `x 2^2300`, an integer for every float.
fn integer(x: f64) -> BigInt {
    let (m, e) = x.parts();
    let magnitude = BigInt::from(m) << (e + 2300);
    if x < 0.0 { -magnitude } else { magnitude }
}

fn square(x: &BigInt) -> BigInt {
    x * x
}

/// Whether `distance` is the float nearest to the exact distance, by the squares of the midpoints beside it.
fn check<T: Real>(step: T, scale: i32, [i, j]: [i64; 2], [f, g]: [T; 2]) -> T {
    let result = distance(step, scale, Coordinate::new(i, f), Coordinate::new(j, g));
    let place = |k: i64, f: T| (BigInt::from(k) << 2300_u32) + integer(f.widen());
    // (2^4600 distance)^2, and twice that distance in the midpoints.
    let exact = (square(&place(i, f)) + square(&place(j, g))) * square(&integer(step.widen()));
    let exact: BigInt = exact << (2 * scale + 2 + 200);
    let (m, e) = result.parts();
    let neighbour = |m: u64| integer(1.0) * (BigInt::from(m) << (e + 2300 + 100));
    let twice = neighbour(m) << 1;
    // Below a power of two the floats lie twice as close.
    let spacing = neighbour(1);
    let below_spacing =
        if m.is_power_of_two() && e > T::MIN_EXPONENT { &spacing >> 1 } else { spacing.clone() };
    let (low, high) = (square(&(&twice - &below_spacing)), square(&(&twice + &spacing)));
    let even = m & 1 == 0;
    if m > 0 {
        assert!(low < exact || low == exact && even, "{result:e} is too large: {step} {i} {j} {f:e} {g:e}");
    }
    assert!(exact < high || high == exact && even, "{result:e} is too small: {step} {i} {j} {f:e} {g:e}");
    result
}

fn fraction() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(0.0),
        Just(0.5),
        -1.0..1.0,
        (0_u64..1.0_f64.to_bits()).prop_map(f64::from_bits),
        (0_u64..0.5_f64.to_bits()).prop_map(|bits| -f64::from_bits(bits)),
        (0_i32..60).prop_map(|k| 1.0 - f64::from_parts(1, -k)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn distances_are_correctly_rounded(
        step in 1e-6_f64..10.0, i in -70000_i64..70000, j in -5_i64..70000, f in fraction(), g in fraction(), scale in -12_i32..0,
    ) {
        check(step, scale, [i, j], [f, g]);
        check(step, scale, [i.signum(), j.signum()], [f, g]);
        check(step as f32, scale, [i, j], [f as f32, g as f32]);
    }

    /// Fractions that nearly cancel the index.
    #[test]
    fn cancellation_is_exact(step in 1e-3_f64..10.0, i in 1_i64..64, j in -64_i64..64, k in 0_i32..50) {
        let f = -(i as f64) * (1.0 - f64::from_parts(1, -k));
        check(step, -3, [i, j], [f, -(j as f64)]);
        check(step, -3, [i, j], [-(i as f64), f]);
        check(step, -3, [-i, j], [-f, f]);
    }

    /// Integer triples: the root is exact, and the product with a step of 53 bits often a midpoint.
    #[test]
    fn ties_go_to_even(m in 1_u64 << 52..1 << 53, a in 1_i64..60, b in 1_i64..60, scale in -5_i32..0) {
        let (x, y, hypotenuse) = (a * a - b * b, 2 * a * b, a * a + b * b);
        let step = f64::from_parts(m, -60);
        let rounded = check(step, scale, [x, y], [0.0; 2]);
        prop_assert_eq!(rounded, multiple(step, scale, hypotenuse as u128));
        prop_assert_eq!(rounded, step * hypotenuse as f64 * f64::from_parts(1, scale));
        let step = step as f32;
        prop_assert_eq!(check(step, scale, [x, y], [0.0; 2]), multiple(step, scale, hypotenuse as u128));
    }

    /// A midpoint and the smallest number more: every bit of the squares is needed, wherever limbs end.
    #[test]
    fn a_tie_is_broken_by_the_least_bit(half in 1_u64 << 51..(1 << 53) / 3, k in 0_i32..40) {
        let step = f64::from_parts(2 * half + 1, -60);
        let rounded = check(step, 0, [3 << k, 0], [0.0, f64::from_bits(1)]);
        let tie = check(step, 0, [3 << k, 0], [0.0; 2]);
        prop_assert!(tie <= rounded && rounded <= tie.next_up());
    }

    #[test]
    fn both_ends_of_the_format(bits in 1_u64..f64::MAX.to_bits(), i in 0_i64..9, j in 0_i64..9, f in fraction(), g in fraction()) {
        let step = f64::from_bits(bits);
        prop_assume!(step < 1e300);
        check(step, -5, [i, j], [f, g]);
        let single = f32::from_bits(bits as u32 & 0x7fff_ffff);
        if single > 0.0 && single < 1e36 {
            check(single, -5, [i, j], [f as f32, g as f32]);
        }
    }
}

/// Solutions of `k^2 - N m^2 = d` (Pell, Brahmagupta): `m √N` is `d / (2 k)` beside the midpoint `k`, of 54 bits, by
/// `2^-105` of it, and on the side to which a tie would not go.
#[test]
fn the_nearest_that_is_no_tie() {
    for (m, x, y, k, d) in [
        (1196605283526901_u64, 9, 1, 10835721700666209_i128, -1),
        (3148310371686478, 5, 2, 16954170215542571, 5),
        (2870059236275285, 5, 3, 16735177342077629, -9),
    ] {
        assert_eq!(k * k - i128::from(x * x + y * y) * i128::from(m).pow(2), d);
        let result = check(m as f64, -3, [x, y], [0.0; 2]);
        assert_eq!(result * 8.0, (k - d.signum()) as f64);
    }
}

#[test]
fn no_distance_is_no_distance() {
    for step in [1e-300, 0.05, 1e300] {
        let origin = Coordinate::new(-3, 3.0);
        assert_eq!(distance::<f64>(step, -2, origin, origin), 0.0);
        assert_eq!(distance(step, 0, Coordinate::new(0, -0.5), origin), step / 2.0);
        assert_eq!(
            distance(step, 0, origin, Coordinate::new(0, f64::from_bits(1))),
            step * f64::from_bits(1)
        );
    }
    let far = Coordinate::new(3, 0.0);
    assert_eq!(distance(f64::MAX, 0, far, far), f64::INFINITY);
}
