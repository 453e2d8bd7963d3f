//! Angles as turns modulo 1, and their cosine and sine, in integers.

use super::fixed::mul_high;
use crate::real::Real;

/// The number `1 / (2π)`, cut to 1216 bits, the highest first.
const TURNS_PER_RADIAN: [u64; 19] = [
    0x28be_60db_9391_054a,
    0x7f09_d5f4_7d4d_3770,
    0x36d8_a566_4f10_e410,
    0x7f94_58ea_f7ae_f158,
    0x6dc9_1b8e_9093_74b8,
    0x0192_4bba_8274_6487,
    0x3f87_7ac7_2c4a_69cf,
    0xba20_8d7d_4bae_d121,
    0x3a67_1c09_ad17_df90,
    0x4e64_758e_60d4_ce7d,
    0x2721_17e2_ef7e_4a0e,
    0xc7fe_25ff_f781_6603,
    0xfbcb_c462_d682_9b47,
    0xdb4d_9fb3_c9f2_c26d,
    0xd3d1_8fd9_a797_fa8b,
    0x5d49_eeb1_faf9_7c5e,
    0xcf41_ce7d_e294_a4ba,
    0x9afe_d7ec_47e3_5742,
    0x1580_cc11_bf1e_daea,
];

/// The number `π / 2`, scale 126, to nearest.
const HALF_PI: u128 = 0x6487_ed51_10b4_611a_6263_3145_c06e_0e69;

/// Converts a finite angle of `x` radians to turns modulo 1, in units of `2^-128`, within 2 units.
///
/// Sums of turns wrap, as angles do.
#[inline]
pub(crate) fn turns(x: f64) -> u128 {
    let (m, e) = x.parts();
    // The bits of 1 / (2π) of weight 2^-(e + 1) to 2^-(e + 192): times m 2^e, they make its fraction and no less than
    // its first 139 bits.
    let bits = |last: i32| {
        let limb = |k: i32| {
            usize::try_from(k).ok().and_then(|k| TURNS_PER_RADIAN.get(k)).map_or(0, |&l| u128::from(l))
        };
        let (k, shift) = (last.div_euclid(64), last.rem_euclid(64));
        (limb(k - 1) << 64 | limb(k)) >> (64 - shift) & u128::from(u64::MAX)
    };
    let (low, middle, high) = (bits(e + 192), bits(e + 128), bits(e + 64));
    let m = u128::from(m);
    // m times the 192 bits, modulo 1 turn: the wrapping products drop whole turns, the floor of the lowest one unit.
    let turns = (m * middle).wrapping_add((m * low) >> 64).wrapping_add((m * high) << 64);
    if x < 0.0 { turns.wrapping_neg() } else { turns }
}

/// Computes the cosine and the sine of an angle in turns, scale 62, within 0.51 units.
#[inline]
pub(crate) fn cos_sin(turns: u128) -> [i64; 2] {
    // The part of a quarter turn, scale 126, and its complement: both functions of the smaller one.
    let part = turns & (QUARTER - 1);
    let rest = QUARTER - part;
    let [cos, sin] = if part <= rest { cos_sin_of_part(part) } else { swapped(cos_sin_of_part(rest)) };
    // Each quarter turn takes (cos, sin) to (-sin, cos).
    match turns >> 126 {
        0 => [cos, sin],
        1 => [-sin, cos],
        2 => [-cos, -sin],
        _ => [sin, -cos],
    }
}

/// Converts a finite angle of `x` radians to turns modulo 1, in units of `2^-64`, within 10 units.
#[inline]
pub(crate) fn short_turns(x: f64) -> u64 {
    let (m, e) = x.parts();
    // Cut after 64 bits 1 / (2π) lacks less than 2^-64, which makes 8 units up to 8 radians; the floor another.
    let turns = if x.abs() <= 8.0 {
        let product = u128::from(m) * u128::from(TURNS_PER_RADIAN[0]);
        product.checked_shr(e.unsigned_abs()).unwrap_or(0) as u64
    } else {
        return (turns(x) >> 64) as u64;
    };
    if x < 0.0 { turns.wrapping_neg() } else { turns }
}

/// Computes the cosine and the sine of an angle in turns, given in units of `2^-64`, within `2^-52` ([`scan`](crate::book::scan),
/// Theorem (ends in floats)).
#[inline]
pub(crate) fn short_cos_sin(turns: u64) -> [f64; 2] {
    // As in `cos_sin`, the part of a quarter turn and its complement, scale 62, and the middles of 128 parts.
    let part = turns & ((1 << 62) - 1);
    let is_swapped = part > 1 << 61;
    let part = if is_swapped { (1 << 62) - part } else { part };
    let middle = ((part >> 54) as usize).min(MIDDLES.len() - 1);
    let [cos, sin] = SHORT_MIDDLES[middle];
    // The angle from there in radians, of magnitude at most π 2^-10, its sine, and what the cosine lacks to 1.
    let a = (part as i64 - ((2 * middle as i64 + 1) << 53)) as f64 * SHORT_HALF_PI;
    let square = a * a;
    let rise = a - a * square * (1.0 / 6.0 - square * (1.0 / 120.0));
    let fall = square * (0.5 - square * (1.0 / 24.0));
    let (cos, sin) = (cos - (cos * fall + sin * rise), sin - (sin * fall - cos * rise));
    let [cos, sin] = if is_swapped { [sin, cos] } else { [cos, sin] };
    match turns >> 62 {
        0 => [cos, sin],
        1 => [-sin, cos],
        2 => [-cos, -sin],
        _ => [sin, -cos],
    }
}

/// The radians of `2^-64` of a turn, as a float: `π / 2` times `2^-62`.
const SHORT_HALF_PI: f64 = HALF_PI as f64 / (1_u128 << 126) as f64 / (1_u64 << 62) as f64;

/// The [`MIDDLES`] as floats.
static SHORT_MIDDLES: [[f64; 2]; 128] = {
    let mut middles = [[0.0; 2]; 128];
    let mut k = 0;
    while k < 128 {
        let [cos, sin] = MIDDLES[k];
        middles[k] = [cos as f64 / QUARTER as f64, sin as f64 / QUARTER as f64];
        k += 1;
    }
    middles
};

/// Swaps cosine and sine: those of the complement of an angle to a quarter turn.
#[inline]
fn swapped([cos, sin]: [i64; 2]) -> [i64; 2] {
    [sin, cos]
}

/// The number 1, scale 126: a quarter turn, and the radius.
const QUARTER: u128 = 1 << 126;

/// Cosine and sine, scale 126, in the middle of 128 parts of half of a quarter turn.
static MIDDLES: [[u128; 2]; 128] = {
    let mut middles = [[0; 2]; 128];
    let mut k = 0;
    while k < 128 {
        middles[k] = series_of_part((2 * k as u128 + 1) << 117);
        k += 1;
    }
    middles
};

/// Computes cosine and sine, scale 62, of at most half of a quarter turn, given as a part of a quarter turn, scale 126: what the
/// series rounds to, mostly without it ([`scan`](crate::book::scan), Theorem (directions)).
#[inline]
fn cos_sin_of_part(part: u128) -> [i64; 2] {
    // Half of the quarter turn itself belongs to the last part.
    let middle = ((part >> 118) as usize).min(MIDDLES.len() - 1);
    let from_middle = part as i128 - ((2 * middle as i128 + 1) << 117);
    let [cos, sin] = turned(MIDDLES[middle], from_middle);
    // To nearest; the bits that are rounded off decide, unless they are those of one half, or nearly.
    let is_decided = |x: i128| (x as u64).wrapping_sub((1 << 63) - ANGLE_ERROR) >= 2 * ANGLE_ERROR;
    if is_decided(cos) && is_decided(sin) { [rounded(cos), rounded(sin)] } else { cos_sin_by_series(part) }
}

/// Rounds a number of scale 126 to scale 62, to nearest.
#[inline]
fn rounded(x: i128) -> i64 {
    ((x + (1 << 63)) >> 64) as i64
}

/// Computes what [`cos_sin_of_part`] does, by the series alone.
#[cold]
fn cos_sin_by_series(part: u128) -> [i64; 2] {
    series_of_part(part).map(|x| rounded(x as i128))
}

/// The error of [`turned`], in units of `2^-126`; that of the series is far below one.
const ANGLE_ERROR: u64 = 1 << 50;

/// Computes cosine and sine, scale 126, of the angle whose cosine and sine are given, turned by a part of a quarter turn of
/// magnitude at most `2^117`, scale 126: within `2^48` units ([`scan`](crate::book::scan), Theorem (directions)).
#[inline]
fn turned([cos, sin]: [u128; 2], by: i128) -> [i128; 2] {
    const ONE: u64 = u64::MAX;
    let product = |a: u64, b: u64| ((u128::from(a) * u128::from(b)) >> 64) as u64;
    // Radians, scale 135 = 136 + 127 - 128, below 2^127; cut to scale 72, and their square, scale 80.
    let angle = mul_high(by.unsigned_abs() << 10, HALF_PI << 1);
    let a = (angle >> 63) as u64;
    let square = product(a, a);
    // a - sin a = a (a^2 / 6) (1 - a^2 / 20 (1 - a^2 / 42)): factors of scale 64, the second of scale 80.
    let factor = ONE - product(product(square, (1 << 48) / 20), ONE - product(square, (1 << 48) / 42));
    let short = (u128::from(a) * u128::from(product(product(square, u64::MAX / 6), factor))) >> 17;
    // 1 - cos a = (a^2 / 2) (1 - a^2 / 12 (1 - a^2 / 30)), scale 81.
    let factor = ONE - product(product(square, (1 << 48) / 12), ONE - product(square, (1 << 48) / 30));
    let fall = product(square, factor);
    // sin a, scale 136, times either: scale 126 = 136 + 126 - 128 - 8. The fall: 126 = 64 + 81 - 19.
    let rise = (angle - short) << 1;
    let along = |x: u128| (mul_high(x, rise) >> 8) as i128;
    let across = |x: u128| (((x >> 62) * u128::from(fall)) >> 19) as i128;
    let (by_cos, by_sin) = if by < 0 { (-along(cos), -along(sin)) } else { (along(cos), along(sin)) };
    [cos as i128 - across(cos) - by_sin, sin as i128 - across(sin) + by_cos]
}

/// Computes cosine and sine, scale 126, of at most half of a quarter turn, given as a part of a quarter turn, scale 126.
///
/// Taylor's series goes to the 30th power: the terms left out are below `2^-120`. Each of the 15 steps floors twice, 2
/// units of `2^-126`.
const fn series_of_part(part: u128) -> [u128; 2] {
    // Radians, and their square, scale 126 = 127 + 127 - 128.
    let angle = mul_high(part << 1, HALF_PI << 1);
    let square = mul_high(angle << 1, angle << 1);
    [series(square, 1), mul_high(angle << 1, series(square, 2) << 1)]
}

/// Computes `1 - a^2 / (f (f+1)) (1 - a^2 / ((f+2) (f+3)) (1 - ...))`, scale 126, from `f = 1` or 2.
const fn series(square: u128, first: u128) -> u128 {
    let (mut sum, mut k) = (QUARTER, 15);
    while k > 0 {
        k -= 1;
        let factor = first + 2 * k;
        sum = QUARTER - mul_high(square << 1, sum << 1) / (factor * (factor + 1));
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_bigint::BigInt;
    use proptest::prelude::*;
    use std::sync::OnceLock;

    const PLACES: u32 = 1400;

    /// `arctan(1/n)`, scale [`PLACES`].
    fn arctan_of_inverse(n: u32) -> BigInt {
        let mut power = (BigInt::from(1) << PLACES) / n;
        let mut sum = power.clone();
        for k in (3_u32..).step_by(2).take_while(|&k| k < 2 * PLACES) {
            power = -power / (n * n);
            sum += &power / k;
        }
        sum
    }

    /// Machin's formula.
    fn pi() -> &'static BigInt {
        static PI: OnceLock<BigInt> = OnceLock::new();
        PI.get_or_init(|| arctan_of_inverse(5) * 16 - arctan_of_inverse(239) * 4)
    }

    #[test]
    fn the_constants_are_those_of_machins_formula() {
        let turns = (BigInt::from(1) << (PLACES + 1216 - 1)) / pi();
        let stated = TURNS_PER_RADIAN.iter().fold(BigInt::from(0), |sum, &limb| (sum << 64) + limb);
        assert_eq!(turns, stated);
        assert_eq!((pi() + (BigInt::from(1) << (PLACES - 126))) >> (PLACES - 125), HALF_PI.into());
    }

    /// `|sin^2 + cos^2 - 1|`, in units of `2^-62`, is at most `2 (0.51 + 0.51)` and a little.
    fn on_the_circle([cos, sin]: [i64; 2]) -> bool {
        let [cos, sin] = [cos, sin].map(i128::from);
        (cos * cos + sin * sin - (1 << 124)).unsigned_abs() <= 3 << 62
    }

    /// `2^62 cos` or `2^62 sin` of an angle in turns, scale 200: Taylor's series from the power `first`, 0 or 1.
    fn exact(turns: u128, first: u32) -> BigInt {
        const SCALE: u32 = 200;
        let angle: BigInt = (pi() * turns) >> (PLACES + 128 - 1 - SCALE);
        let mut term = if first == 0 { BigInt::from(1) << SCALE } else { angle.clone() };
        let mut sum = term.clone();
        for k in (first + 1..80).step_by(2) {
            term = (-term * &angle * &angle) >> (2 * SCALE);
            term /= k * (k + 1);
            sum += &term;
        }
        sum << 62
    }

    /// Angles all over, and those next to the ends of the parts, and to ties: sines of one half.
    fn part() -> impl Strategy<Value = u128> {
        prop_oneof![
            0..=QUARTER / 2,
            (0_u128..=128, -4_i128..5, 0_u32..118)
                .prop_map(|(k, off, shift)| (k << 118).saturating_add_signed(off << shift).min(QUARTER / 2)),
            (0_u32..125, 0_u128..9).prop_map(|(shift, off)| (1 << shift) + off),
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        /// The bits of the series rounded, which are those that directions have always had.
        #[test]
        fn the_short_way_is_the_series(part in part()) {
            let series = series_of_part(part);
            prop_assert_eq!(cos_sin_of_part(part), cos_sin_by_series(part));
            let middle = ((part >> 118) as usize).min(127);
            let near = turned(MIDDLES[middle], part as i128 - ((2 * middle as i128 + 1) << 117));
            for (near, exact) in near.into_iter().zip(series) {
                prop_assert!(near.abs_diff(exact as i128) < 1 << 48, "{}", near - exact as i128);
            }
        }
    }

    proptest! {
        #[test]
        fn cosine_and_sine_are_within_0_51_units(turns in any::<u128>()) {
            for (found, first) in cos_sin(turns).into_iter().zip([0, 1]) {
                let error: BigInt = (BigInt::from(found) << 200) - exact(turns, first);
                let hundredths = (error * 100) >> 200;
                prop_assert!((-51..51).any(|k| hundredths == k.into()), "{hundredths} hundredths of a unit");
            }
        }

        /// Against what is computed to 128 and to 62 bits.
        #[test]
        fn short_turns_and_functions_are_near(x in prop_oneof![any::<f64>().prop_filter("finite", |x| x.is_finite()), -9.0_f64..9.0], part in part(), turn in 0_u128..4, is_beyond in any::<bool>()) {
            let (short, long) = (short_turns(x), (turns(x) >> 64) as u64);
            prop_assert!(short.wrapping_sub(long).min(long.wrapping_sub(short)) <= 10);
            let angle = (turn << 126).wrapping_add(if is_beyond { QUARTER - part } else { part });
            for (near, exact) in short_cos_sin((angle >> 64) as u64).into_iter().zip(cos_sin(angle)) {
                // As integers of scale 62, exactly; an angle is cut by 2 π units of scale 64.
                let near = (near * (1_u64 << 62) as f64) as i64;
                prop_assert!(near.abs_diff(exact) <= 1 << 10, "{near} {exact}");
            }
        }

        #[test]
        fn turns_are_the_angle_over_2_pi_modulo_1(x in any::<f64>().prop_filter("finite", |x| x.is_finite())) {
            let (m, e) = x.parts();
            // Scale 1400 + 1074; the error of 1 / 2π is far below 2^-128 of m 2^e.
            let whole = (BigInt::from(m) << (2 * 1400 - 1)) / pi();
            let at_128 = if e >= 1272 { whole << (e - 1272) } else { whole >> (1272 - e) };
            let modulo = at_128 & ((BigInt::from(1) << 128) - 1);
            let expected = u128::try_from(modulo).unwrap();
            let found = if x < 0.0 { turns(x).wrapping_neg() } else { turns(x) };
            prop_assert!(expected.wrapping_sub(found).min(found.wrapping_sub(expected)) <= 2, "{expected} {found}");
        }

        #[test]
        fn cosine_and_sine_are_on_the_circle_and_turn_with_the_angle(turns in any::<u128>()) {
            let [cos, sin] = cos_sin(turns);
            prop_assert!(on_the_circle([cos, sin]));
            prop_assert_eq!(cos_sin(turns.wrapping_add(1 << 126)), [-sin, cos]);
            prop_assert_eq!(cos_sin(turns.wrapping_add(1 << 127)), [-cos, -sin]);
            prop_assert_eq!(cos_sin(turns.wrapping_neg()), [cos, -sin]);
        }
    }
}
