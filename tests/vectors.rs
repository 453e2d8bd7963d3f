//! The vectors of the functions of a cell: every result must be the float nearest to the exact value.
//!
//! Decided in integers of any size, from the decimals as they are written; no decimal is ever parsed as a float.

use mean_information::Real;
use mean_information::cell::{
    entropy, entropy_from_log_odds, information, information_from_log_odds, occupancy_from_log_odds,
};
use num_bigint::BigUint;
use serde_json::Value;
use std::cmp::Ordering;
use std::collections::HashSet;
use std::fs;

/// The number `m 2^binary 10^decimal`.
struct Exact {
    m: BigUint,
    binary: i32,
    decimal: i32,
}

impl Exact {
    /// A decimal such as `1.25e-3`.
    fn decimal(text: &str) -> Option<Self> {
        let (significand, exponent) = text.split_once('e').unwrap_or((text, "0"));
        let (whole, fraction) = significand.split_once('.').unwrap_or((significand, ""));
        let m = format!("{whole}{fraction}").parse().ok()?;
        Some(Self { m, binary: 0, decimal: exponent.parse::<i32>().ok()? - fraction.len() as i32 })
    }

    fn cmp(&self, other: &Self) -> Ordering {
        let (binary, decimal) = (self.binary.min(other.binary), self.decimal.min(other.decimal));
        let integer = |x: &Self| {
            (&x.m << (x.binary - binary) as u32) * BigUint::from(10_u32).pow((x.decimal - decimal) as u32)
        };
        integer(self).cmp(&integer(other))
    }
}

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

/// A C99 hexadecimal float, exactly; `nan`, `inf` and `-inf` too.
fn float<T: Real>(text: &str) -> Option<T> {
    let (negative, magnitude) = text.strip_prefix('-').map_or((false, text), |rest| (true, rest));
    let x = match magnitude {
        "nan" => T::nan(),
        "inf" => T::infinity(),
        _ => {
            let (significand, exponent) = magnitude.strip_prefix("0x")?.split_once('p')?;
            let (whole, fraction) = significand.split_once('.').unwrap_or((significand, ""));
            let m = u64::from_str_radix(&format!("{whole}{fraction}"), 16).ok()?;
            T::from_parts(m, exponent.parse::<i32>().ok()? - 4 * fraction.len() as i32)
        }
    };
    Some(if negative { -x } else { x })
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
    let end = |name: &str| test["want"][name].as_str().and_then(Exact::decimal).expect("a decimal");
    let (lo, hi) = (end("lo"), end("hi"));
    assert!(lo.cmp(&hi).is_le(), "{id}: an enclosure that holds nothing");
    let right = result.is_sign_positive() && is_nearest(result, &lo, &hi);
    (!right).then(|| format!("{id}: {result:e} is not the nearest float"))
}

/// Judges the file of one function; at least `least` tests, so that an empty file does not pass.
fn check(name: &str, single: fn(f32) -> f32, double: fn(f64) -> f64, least: usize) {
    let path = format!("{}/vectors/v1/cell.{name}.json", env!("CARGO_MANIFEST_DIR"));
    let file: Value = serde_json::from_str(&fs::read_to_string(path).expect("the file")).expect("JSON");
    // That the tolerance is that of the nearest float: tests/library/guarantees.rs.
    assert_eq!(file["op"].as_str(), Some(&*format!("cell.{name}")));
    let tests = file["tests"].as_array().expect("tests");
    let ids: HashSet<_> = tests.iter().map(|test| test["id"].as_str().expect("an id")).collect();
    assert_eq!(ids.len(), tests.len(), "an id means one test");
    assert!(tests.len() >= least, "{} tests", tests.len());
    let wrong: Vec<_> = tests
        .iter()
        .filter_map(|test| match test["format"].as_str() {
            Some("f32") => judge(single, test),
            Some("f64") => judge(double, test),
            other => panic!("{}: no such format: {other:?}", test["id"]),
        })
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
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
