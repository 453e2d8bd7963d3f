//! The fixed-point value against the vectors, which other tools made; the places in the panels; what the proof takes from the
//! tables.

use super::*;
use num_bigint::BigInt;
use num_rational::BigRational;
use proptest::prelude::*;
use serde_json::Value;
use std::{env, format, fs};

const WEIGHTS: [(Weight, &str, &[Polynomial; PANELS]); 2] =
    [(Weight::Radial, "radial", &tables::RADIAL), (Weight::Area, "area", &tables::AREA)];

/// What `proofs/limit_certify.py` prints of the tables that it proves. If they change, run it, and record it in RESULTS.md.
const CERTIFIED: u64 = 0xf7ac_621b_7b15_9dba;

/// The number `m 2^e`.
fn dyadic(m: impl Into<BigInt>, e: i32) -> BigRational {
    let power = BigInt::from(1) << e.unsigned_abs();
    if e < 0 { BigRational::new(m.into(), power) } else { (m.into() * power).into() }
}

/// The number that a decimal such as `1.25e-1` of the vectors stands for.
fn decimal(text: &str) -> BigRational {
    let (significand, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let (whole, fraction) = significand.split_once('.').unwrap_or((significand, ""));
    let digits: BigInt = format!("{whole}{fraction}").parse().expect("digits");
    let below = fraction.len() as i32 - exponent.parse::<i32>().expect("an exponent");
    BigRational::new(digits, BigInt::from(10).pow(below.try_into().expect("a value below 10")))
}

/// The float that a positive hexadecimal such as `0x1.8p-2` of the vectors stands for.
fn float<T: Real>(text: &str) -> T {
    let (significand, exponent) =
        text.strip_prefix("0x").and_then(|text| text.split_once('p')).expect("0x and p");
    let (whole, fraction) = significand.split_once('.').unwrap_or((significand, ""));
    let m = u64::from_str_radix(&format!("{whole}{fraction}"), 16).expect("hexadecimal digits");
    T::from_parts(m, exponent.parse::<i32>().expect("an exponent") - 4 * fraction.len() as i32)
}

/// The panel of a room of the vectors, and its value.
fn room<T: Real>(test: &Value, weight: Weight) -> (usize, u128) {
    let argument = |name: &str| float::<T>(test["args"][name].as_str().unwrap());
    let sensor = GaussianSensor::new(argument("range"), argument("sigma")).unwrap();
    (locate(sensor.range(), sensor.sigma()).0, value(&sensor, weight))
}

/// The bound of the chapter, `2^-65`, before anything is rounded to a float: on every panel, at its borders and inside.
#[test]
fn the_value_is_within_its_bound() {
    for (weight, name, _) in WEIGHTS {
        let path = format!("{}/vectors/v1/limit.{name}.json", env!("CARGO_MANIFEST_DIR"));
        let file: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
        let mut seen = [0; PANELS];
        for test in file["tests"].as_array().unwrap().iter().filter(|test| test["want"]["error"].is_null()) {
            let (panel, value) =
                if test["format"] == "f32" { room::<f32>(test, weight) } else { room::<f64>(test, weight) };
            let want = |name: &str| decimal(test["want"][name].as_str().unwrap());
            let (below, above) = (dyadic(value - (1 << 55), -120), dyadic(value + (1 << 55), -120));
            assert!(below < want("lo") && want("hi") < above, "{}", test["id"]);
            seen[panel] += 1;
        }
        assert!(seen.iter().all(|&count| count >= 2), "{seen:?}");
    }
}

/// Exactly: the quotient lies in its panel, at `y` or less than a unit above it; by `1/α`, up to a unit.
fn the_place_is_right<T: Real>(range: T, sigma: T) -> Result<(), TestCaseError> {
    let (panel, y) = locate(range, sigma);
    // The place from the beginning of the panel, in units of 2^-64 of its width.
    let place = u128::from(y as u64 ^ 1 << 63);
    let per_octave = 1 << SPLIT;
    let (first, width) = match panel {
        0 => (0, LOWEST),
        1..BEYOND => {
            let octave = LOWEST + ((panel - 1) / per_octave) as i32;
            (per_octave + (panel - 1) % per_octave, octave - SPLIT as i32)
        }
        _ => (panel - BEYOND, -HIGHEST - 1 - SPLIT as i32),
    };
    let of = |numerator: T, denominator: T| {
        // The bounds are place 2^(width - 64) and a unit more, times the denominator.
        let ((n, n_exponent), (d, d_exponent)) = (normalised(numerator), normalised(denominator));
        let place = ((first as u128) << 64) + place;
        let quotient = dyadic(n, n_exponent - d_exponent);
        let end = |place: u128| dyadic(BigInt::from(place) * d, width - 64);
        (end(place).cmp(&quotient), quotient.cmp(&end(place + 1)))
    };
    if panel < BEYOND {
        let (lower, upper) = of(range, sigma);
        prop_assert!(lower.is_le() && upper.is_lt());
    } else {
        let (lower, upper) = of(sigma, range);
        prop_assert!(lower.is_le() && upper.is_le());
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn the_place_is_right_for_any_bits(range in 1_u64..f64::INFINITY.to_bits(), sigma in 1_u64..f64::INFINITY.to_bits()) {
        the_place_is_right(f64::from_bits(range), f64::from_bits(sigma))?;
    }

    #[test]
    fn the_place_is_right_for_any_bits_f32(range in 1_u32..f32::INFINITY.to_bits(), sigma in 1_u32..f32::INFINITY.to_bits()) {
        the_place_is_right(f32::from_bits(range), f32::from_bits(sigma))?;
    }

    #[test]
    fn the_place_is_right_for_sizes_that_meet(sigma in 0.001_f64..3.0, e in -100_i32..100, fraction in 0_u64..1 << 52) {
        the_place_is_right(sigma * f64::from_parts(fraction | 1 << 52, e - 52), sigma)?;
    }

    #[test]
    fn the_place_is_right_at_borders(sigma in 1_u32..1 << 20, eighth in 8_u32..16, e in -30_i32..80, ulps in -2_i64..=2) {
        let range = f64::from(sigma) * f64::from_parts(eighth.into(), e);
        the_place_is_right(f64::from_bits((range.to_bits() as i64 + ulps) as u64), sigma.into())?;
        the_place_is_right(sigma.into(), range)?;
    }
}

/// Two of three things that the chapter's proof takes from the tables: a unit of `y` counts for at most `2^-68`, and the sums of
/// Horner's rule fit in 63 bits.
#[test]
fn the_tables_fit_the_proof() {
    for (_, name, table) in WEIGHTS {
        for (panel, (_, slopes)) in table.iter().enumerate() {
            // Units of 2^-67, a unit more for every floor.
            let (mut sum, mut derivative) = (0_u64, 0_u64);
            for (k, c) in slopes.iter().enumerate().rev() {
                sum = c.unsigned_abs() + sum / 2 + 2;
                derivative = (k as u64 + 1) * c.unsigned_abs() + derivative / 2 + 1;
            }
            assert!(sum < 1 << 63 && derivative <= 1 << 63, "{name}, panel {panel}");
        }
    }
}

#[test]
fn the_tables_are_those_that_are_certified() {
    // FNV-1a over the numbers as decimals.
    let mut digest = 0xcbf2_9ce4_8422_2325_u64;
    let mut update = |text: &str| {
        for byte in text.bytes() {
            digest = (digest ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    };
    for (_, _, table) in WEIGHTS {
        for (value, slopes) in table {
            update(&format!("{value}:"));
            slopes.iter().for_each(|slope| update(&format!("{slope},")));
        }
    }
    assert_eq!(digest, CERTIFIED, "{digest:#x}");
}
