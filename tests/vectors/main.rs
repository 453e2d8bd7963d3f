//! The vectors: every result of a function of a cell must be the float nearest to the exact value, and every limit as near
//! to it as the table of guarantees says.
//!
//! Decided in integers of any size, from the decimals as they are written; no decimal is ever parsed as a float.

mod exact;

use exact::{Exact, float};
use mean_information::Real;
use mean_information::cell::{
    entropy, entropy_from_log_odds, information, information_from_log_odds, occupancy_from_log_odds,
};
use mean_information::limit::{Weight, closed_form};
use mean_information::sensor::GaussianSensor;
use serde_json::Value;
use std::collections::HashSet;
use std::fs;

/// The midpoints of a non-negative float and its neighbours; there is none below 0.
fn midpoints<T: Real>(x: T) -> (Option<Exact>, Exact) {
    let (m, e) = x.parts();
    let midpoint = |m: u64, e: i32| Exact { m: m.into(), binary: e, decimal: 0 };
    // The spacing below a power of two is half the spacing above, down to the smallest normal number.
    let below = if m == 1 << (T::PRECISION - 1) && e > T::MIN_EXPONENT {
        Some(midpoint(4 * m - 1, e - 2))
    } else {
        (m > 0).then(|| midpoint(2 * m - 1, e - 1))
    };
    (below, midpoint(2 * m + 1, e - 1))
}

/// Whether `x` is the float nearest to every number of the enclosure.
fn is_nearest<T: Real>(x: T, lo: &Exact, hi: &Exact) -> bool {
    let (below, above) = midpoints(x);
    below.is_none_or(|below| below.cmp(lo).is_lt()) && hi.cmp(&above).is_lt()
}

/// The enclosure of a test.
fn wanted(test: &Value) -> (Exact, Exact) {
    let end = |name: &str| test["want"][name].as_str().and_then(Exact::decimal).expect("a decimal");
    let (lo, hi) = (end("lo"), end("hi"));
    assert!(lo.cmp(&hi).is_le(), "{}: an enclosure that holds nothing", test["id"]);
    (lo, hi)
}

/// What is wrong with the library's answer to a test, if anything.
fn judge<T: Real>(function: fn(T) -> T, test: &Value) -> Option<String> {
    let arguments = test["args"].as_object().expect("arguments");
    let argument = arguments.values().next().and_then(Value::as_str).expect("one argument");
    let result = function(float(argument).expect("a hexadecimal float"));
    let id = &test["id"];
    if test["want"]["error"] == "domain" {
        return (!result.is_nan()).then(|| format!("{id}: {result:e}, not NaN"));
    }
    let (lo, hi) = wanted(test);
    let right = result.is_sign_positive() && is_nearest(result, &lo, &hi);
    (!right).then(|| format!("{id}: {result:e} is not the nearest float"))
}

/// Judges the file of one operation; at least `least` tests, so that an empty file does not pass.
fn check_file(op: &str, tolerance: f64, least: usize, judge: impl Fn(&Value) -> Option<String>) {
    let path = format!("{}/vectors/v1/{op}.json", env!("CARGO_MANIFEST_DIR"));
    let file: Value = serde_json::from_str(&fs::read_to_string(path).expect("the file")).expect("JSON");
    assert_eq!((file["op"].as_str(), file["tolerance_ulp"].as_f64()), (Some(op), Some(tolerance)));
    let tests = file["tests"].as_array().expect("tests");
    let ids: HashSet<_> = tests.iter().map(|test| test["id"].as_str().expect("an id")).collect();
    assert_eq!(ids.len(), tests.len(), "an id means one test");
    assert!(tests.len() >= least, "{} tests", tests.len());
    let wrong: Vec<_> = tests.iter().filter_map(judge).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// The file of one function of a cell.
fn check(name: &str, single: fn(f32) -> f32, double: fn(f64) -> f64, least: usize) {
    check_file(&format!("cell.{name}"), 0.5, least, |test| match test["format"].as_str() {
        Some("f32") => judge(single, test),
        Some("f64") => judge(double, test),
        other => panic!("{}: no such format: {other:?}", test["id"]),
    });
}

/// Thousandths of an ulp that `closed_form` may be off: as `docs/guarantees.md` has it. The file allows ports 2 ulp.
const LIMIT_MILLIULPS: u64 = 501;

/// What is wrong with the closed form's answer to a test, if anything.
fn judge_limit<T: Real>(weight: Weight, test: &Value) -> Option<String> {
    let argument =
        |name: &str| test["args"][name].as_str().and_then(float::<T>).expect("a hexadecimal float");
    let sensor = GaussianSensor::new(argument("range"), argument("sigma"));
    if test["want"]["error"] == "domain" {
        return sensor.is_ok().then(|| format!("{}: not refused", test["id"]));
    }
    let (lo, hi) = wanted(test);
    let result = closed_form(&sensor.expect("positive and finite"), weight);
    let (m, e) = result.parts();
    let end = |m: u64| Exact { m: m.into(), binary: e, decimal: -3 };
    let (below, above) = (end(1000 * m - LIMIT_MILLIULPS), end(1000 * m + LIMIT_MILLIULPS));
    let right = below.cmp(&lo).is_le() && hi.cmp(&above).is_le();
    (!right).then(|| format!("{}: {result:e} is too far", test["id"]))
}

/// The file of one limit.
fn check_limit(name: &str, weight: Weight) {
    check_file(&format!("limit.{name}"), 2.0, 1200, |test| match test["format"].as_str() {
        Some("f32") => judge_limit::<f32>(weight, test),
        Some("f64") => judge_limit::<f64>(weight, test),
        other => panic!("{}: no such format: {other:?}", test["id"]),
    });
}

#[test]
fn the_radial_limit_is_as_near_as_guaranteed() {
    check_limit("radial", Weight::Radial);
}

#[test]
fn the_area_limit_is_as_near_as_guaranteed() {
    check_limit("area", Weight::Area);
}

#[test]
fn entropy_is_correctly_rounded() {
    check("entropy", entropy, entropy, 1800);
}

#[test]
fn information_is_correctly_rounded() {
    check("information", information, information, 1700);
}

#[test]
fn entropy_from_log_odds_is_correctly_rounded() {
    check("entropy_from_log_odds", entropy_from_log_odds, entropy_from_log_odds, 2000);
}

#[test]
fn information_from_log_odds_is_correctly_rounded() {
    check("information_from_log_odds", information_from_log_odds, information_from_log_odds, 2000);
}

#[test]
fn occupancy_from_log_odds_is_correctly_rounded() {
    check("occupancy_from_log_odds", occupancy_from_log_odds, occupancy_from_log_odds, 2000);
}

/// The judge itself: the neighbours of the right answer are wrong, also where the spacing changes, and at 0.
#[test]
fn a_neighbour_of_the_nearest_float_is_refused() {
    for (text, right) in
        [("4.99999999999999999e-1", 0.5_f64), ("1e-330", 0.0), ("3.5e-324", f64::from_bits(1))]
    {
        let exact = Exact::decimal(text).unwrap();
        assert!(is_nearest(right, &exact, &exact), "{text}");
        assert!(!is_nearest(right.next_up(), &exact, &exact), "{text}");
        assert!(right == 0.0 || !is_nearest(right.next_down(), &exact, &exact), "{text}");
    }
    // 1 - 2^-55 is a quarter of the spacing below 1: nearer to 1 than the midpoint, 1 - 2^-54, which 1 - 2^-53 is not.
    let exact = Exact { m: ((1_u64 << 55) - 1).into(), binary: -55, decimal: 0 };
    assert!(is_nearest(1.0_f64, &exact, &exact) && !is_nearest(1.0_f64.next_down(), &exact, &exact));
}
