//! What the scripts `proofs/log_odds_*.gappa` and `proofs/far_*.gappa` take from elsewhere: constants, polynomials with their bounds,
//! and what is certified of the rows of the tables.

use crate::definition;
use crate::lanes::{scripts_of_lanes, source_of};
use std::collections::BTreeMap;
use std::fs;

/// The scripts of one format, fused and not.
fn scripts_of(format: &str) -> impl Iterator<Item = (String, String)> {
    let prefix = format!("log_odds_{format}");
    scripts_of_lanes().into_iter().filter(move |(name, _)| name.starts_with(&prefix))
}

/// The coefficients of the polynomials, as they are written.
pub(crate) fn polynomials() -> BTreeMap<String, Vec<String>> {
    let text = source_of("log_odds/polynomials");
    let arrays = text.split("pub(super) const ").skip(1).map(|array| {
        let (name, rest) = array.split_once(": [f64; ").expect("a name");
        let (_, elements) = rest.split_once(" = [").expect("elements");
        let elements = elements.split_once("];").expect("an end").0.split(',').map(str::trim);
        (name.to_owned(), elements.filter(|element| !element.is_empty()).map(str::to_owned).collect())
    });
    arrays.collect()
}

/// The text of a statement such as `1.2e-19` in `const ERROR: f64 = 1.2e-19;`.
pub(crate) fn constant(file: &str, name: &str) -> String {
    let text = source_of(file);
    let (_, value) = text.split_once(&format!("const {name}: f64 = ")).expect("the constant");
    value.split_once(';').expect("an end").0.to_owned()
}

#[test]
fn the_constants_are_those_of_the_kernels() {
    for (name, script) in scripts_of("f64") {
        let has = |line: &str| assert!(script.lines().any(|l| l == line), "{name}: {line}");
        has("@rnd = float<ieee_64, ne>;");
        has("EPSILON = 1b-52;");
        has(&format!("ERROR = rnd({});", constant("log_odds/double", "ERROR")));
        if !name.contains("_fused") {
            has("@cut = float<9, -1074, zr>;");
        }
    }
    for (name, script) in scripts_of("f32") {
        let has = |line: &str| assert!(script.lines().any(|l| l == line), "{name}: {line}");
        has("@rnd = float<ieee_64, ne>;");
        let of_single = |constant_name: &str| constant("log_odds/single", constant_name);
        has(&format!("ERROR = rnd({});", of_single("ERROR")));
        has(&format!(
            "ROUND = {};",
            constant("log_odds/mod", "ROUND").strip_suffix(".0").expect("an integer")
        ));
        has("LOG2_E = 0x1.71547652b82fep0;");
        assert_eq!(core::f64::consts::LOG2_E.to_bits(), 0x3ff7_1547_652b_82fe);
        let mut coefficients = 0;
        for (polynomial, elements) in polynomials() {
            for (k, element) in elements.iter().enumerate() {
                has(&format!("{polynomial}_{k} = {};", element.replace('E', "e")));
                coefficients += 1;
            }
        }
        assert_eq!(coefficients, script.lines().filter(|line| is_coefficient(line)).count(), "{name}");
        // The bounds of 1 - V are those of V.
        has("lower = rnd(v * less);");
        has("upper = rnd(v * more);");
        has("complement_lower = rnd(complement * less);");
        has("complement_upper = rnd(complement * more);");
    }
}

#[test]
fn the_constants_are_those_of_the_far_kernel() {
    let script = fs::read_to_string("proofs/far_f64_fused.gappa").expect("the script is there");
    let has = |line: &str| assert!(script.lines().any(|l| l == line), "{line}");
    let of_far = |name: &str| constant("log_odds/far", name);
    has("@rnd = float<ieee_64, ne>;");
    has(&format!("ERROR = rnd({});", of_far("ERROR")));
    has(&format!("LN_2_LOW = rnd({});", of_far("LN_2_LOW")));
    has(&format!("ROUND = {};", constant("log_odds/mod", "ROUND").strip_suffix(".0").expect("an integer")));
    // The script quotes that they are 256 times the one, and the other over 256.
    has("STEPS = 0x1.71547652b82fep8;");
    has("STEP = 0x1.62e42fefa39efp-9;");
    assert_eq!(core::f64::consts::LOG2_E.to_bits(), 0x3ff7_1547_652b_82fe);
    assert_eq!(core::f64::consts::LN_2.to_bits(), 0x3fe6_2e42_fefa_39ef);
    let integers = fs::read_to_string("src/rounded/constants.rs").expect("the constants are there");
    let integer = |name: &str| {
        let (_, value) = integers.split_once(&format!("const {name}: u128 = ")).expect("the constant");
        value.split_once(';').expect("an end").0
    };
    has(&format!("LN2 = {};", integer("LN2")));
    assert!(script.contains(&format!("unit in [1b127, {}] /\\ ", integer("INV_LN2"))));
}

/// Whether a line defines `NAME_k`.
fn is_coefficient(line: &str) -> bool {
    let name = definition(line).map(|(name, _)| name);
    let parts = name.as_deref().and_then(|name| name.rsplit_once('_'));
    parts.is_some_and(|(polynomial, k)| polynomials().contains_key(polynomial) && k.parse::<usize>().is_ok())
}

/// A decimal number is that power of two, or less than a thousandth more.
fn is_just_above(decimal: &str, tenths: i32) -> bool {
    let value: f64 = decimal.parse().expect("a number");
    // The tenth power, since the exponent has tenths; never below the least float, since the whole powers come first.
    let power = |x: f64, n: i32| (0..n).fold(1.0, |power, _| power * x);
    let ratio = value * power(2.0, -tenths.div_euclid(10));
    (1.0..1.01).contains(&(power(ratio, 10) / power(2.0, tenths.rem_euclid(10))))
}

/// The tenths of an exponent such as `-40.2`.
fn tenths(exponent: &str) -> i32 {
    (exponent.parse::<f64>().expect("a number") * 10.0).round() as i32
}

/// `|polynomial_LOG -/ log_q| <= 8.358e-12 # LOG: 2^-36.8` assumes what `supnorm` has proved; the parts of a quotient have one
/// bound.
#[test]
fn the_polynomials_are_as_near_as_the_scripts_assume() {
    let source = source_of("log_odds/polynomials");
    for (name, script) in scripts_of("f32") {
        let mut checked = 0;
        for (polynomial, _) in polynomials() {
            let (before, _) = source.split_once(&format!("const {polynomial}:")).expect("the polynomial");
            let (_, bound) = before.rsplit_once("relative error at most `2^").expect("a bound");
            let exponent = bound.split_once('`').expect("an end").0;
            let (of, names) = match polynomial.as_str() {
                "EVEN" | "ODD" => ("over", "EVEN, ODD"),
                name => (name, name),
            };
            let start = format!("|polynomial_{of} -/ ");
            let line =
                script.lines().map(str::trim).find(|line| line.starts_with(&start)).expect("an assumption");
            let (assumed, reason) = line.split_once(" /\\ # ").expect("a reason");
            assert_eq!(reason, format!("{names}: 2^{exponent}"), "{name}");
            let decimal = assumed.split_once("| <= ").expect("a bound").1;
            assert!(is_just_above(decimal, tenths(exponent)), "{name}: {line}");
            checked += 1;
        }
        assert_eq!(checked, 4, "{name}");
    }
}

/// What a script assumes of the rows, `proofs/log_odds_rows.sollya` certifies: the bounds there in their order.
#[test]
fn the_rows_of_log_odds_are_certified_as_the_scripts_assume() {
    let rows = fs::read_to_string("proofs/log_odds_rows.sollya").expect("the certificate is there");
    let list = |name: &str| -> Vec<String> {
        let (_, list) = rows.split_once(&format!("{name} = [|")).expect("a list");
        list.split_once("|]").expect("an end").0.split(", ").map(|x| x.trim_matches('"').to_owned()).collect()
    };
    let bounds = list("bounds");
    let certified: BTreeMap<String, String> = list("names").into_iter().zip(bounds).collect();
    for (name, script) in scripts_of("f64") {
        let assumed: Vec<&str> =
            script.lines().filter(|line| line.ends_with("# log_odds_rows.sollya")).map(str::trim).collect();
        assert_eq!(assumed.len(), 10, "{name}");
        for assumption in assumed {
            let (what, rest) = assumption.split_once("| <= ").expect("a bound");
            let what =
                what.trim_start_matches('|').split(" -/ ").next().expect("a name").replace("ratio_", "a");
            let bound = rest.split(' ').next().expect("a number");
            let exponent = certified[&what].trim_start_matches("2^(").trim_end_matches(')');
            let holds = match bound.strip_prefix("1b") {
                Some(power) => power == exponent,
                None => is_just_above(bound, tenths(exponent)),
            };
            assert!(holds, "{name}: {assumption}, certified {exponent}");
        }
    }
}
