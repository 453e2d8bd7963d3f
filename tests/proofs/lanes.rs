//! The Gappa scripts of the vector kernels, `proofs/lanes_*.gappa`, `proofs/sum_*.gappa`, `proofs/log_odds_*.gappa` and
//! `proofs/far_*.gappa`: every statement of the functions that they speak of is quoted, and every definition under a quotation is its
//! translation into rounded operations.
//!
//! In a script, fused or not, only one branch of `if FUSED` is there. Of occupancies in `f32` a part is computed in `f64`.

use crate::expression::{expressions, rounded_horner};
use crate::source::{statements, without_comments};
use crate::{Quotation, log_odds, quotations, scripts};
use std::collections::BTreeMap;
use std::fs;

const SUM: &str = "sum";
const OCCUPANCY_DOUBLE: &str = "double";
const OCCUPANCY_SINGLE: &str = "single";
const DOUBLE: &str = "log_odds/double";
const SINGLE: &str = "log_odds/single";
const FAR: &str = "log_odds/far";

/// The functions that a script quotes, each with its file.
fn quoted_by(script: &str) -> &'static [(&'static str, &'static str)] {
    if script.starts_with("sum_") {
        &[(SUM, "high_origin"), (SUM, "low_origin"), (SUM, "add")]
    } else if script.starts_with("log_odds_f64") {
        &[
            (DOUBLE, "value"),
            (DOUBLE, "bounds"),
            (OCCUPANCY_DOUBLE, "leading"),
            (OCCUPANCY_DOUBLE, "complements"),
        ]
    } else if script.starts_with("far_") {
        &[(FAR, "value"), (FAR, "factor"), (FAR, "bounds")]
    } else if script.starts_with("log_odds_f32") {
        &[(SINGLE, "occupancy"), (SINGLE, "value"), (SINGLE, "bounds")]
    } else if script.starts_with("lanes_f32") {
        &[
            (OCCUPANCY_SINGLE, "rest"),
            (OCCUPANCY_SINGLE, "series"),
            (OCCUPANCY_SINGLE, "value"),
            (OCCUPANCY_SINGLE, "bounds"),
            (OCCUPANCY_SINGLE, "complements"),
        ]
    } else {
        &[
            (OCCUPANCY_DOUBLE, "value"),
            (OCCUPANCY_DOUBLE, "leading"),
            (OCCUPANCY_DOUBLE, "series"),
            (OCCUPANCY_DOUBLE, "bounds"),
            (OCCUPANCY_DOUBLE, "complements"),
        ]
    }
}

/// The text of a file of the vector kernels.
pub(crate) fn source_of(file: &str) -> String {
    fs::read_to_string(format!("src/rounded/lanes/{file}.rs")).expect("the source is there")
}

/// The file of a script's kernel.
fn kernel_of(script: &str) -> &'static str {
    match script {
        _ if script.starts_with("log_odds_f64") => DOUBLE,
        _ if script.starts_with("log_odds_f32") => SINGLE,
        _ if script.starts_with("far_") => FAR,
        _ if script.starts_with("lanes_f32") => OCCUPANCY_SINGLE,
        _ => OCCUPANCY_DOUBLE,
    }
}

/// Whether a line stands in the file of a script's kernel, or among what the kernels of log-odds share.
fn is_in_source(script: &str, text: &str) -> bool {
    [kernel_of(script), "log_odds/mod"]
        .iter()
        .any(|file| source_of(file).lines().any(|line| line.trim() == text))
}

/// What a script proves of the numbers that the rounding test compares: `V`, and `1 - V` where the kernel needs it.
fn goals_of(script: &str) -> &'static [&'static str] {
    match script {
        _ if script.starts_with("lanes_f32") => &[
            "near_lower - (1 - exact) <= 0 /\\ # of near",
            "near_upper - (1 - exact) >= 0 /\\ # of near",
            "complement_lower - (1 - exact) <= 0 /\\ # of near, entropy",
            "complement_upper - (1 - exact) >= 0 /\\ # of near, entropy",
            "lower - exact <= 0 /\\",
            "upper - exact >= 0",
        ],
        _ if script.starts_with("log_odds_f32") => &[
            "complement_lower - (1 - exact) <= 0 /\\ # of information, entropy",
            "complement_upper - (1 - exact) >= 0 /\\ # of information, entropy",
            "lower - exact <= 0 /\\",
            "upper - exact >= 0",
        ],
        _ if script.starts_with("far_") => &["head + below - exact <= 0 /\\", "head + above - exact >= 0"],
        _ if script.starts_with("sum_") => &["(high - high_origin) + (low - low_origin) - x in [0, 0]"],
        _ => &[
            "head + below - exact <= 0 /\\",
            "head + above - exact >= 0 /\\",
            "complement + lower - (1 - exact) <= 0 /\\",
            "complement + upper - (1 - exact) >= 0",
        ],
    }
}

/// The statements of a function of the kernels.
fn statements_of(file: &str, function: &str) -> Vec<String> {
    let code = without_comments(&source_of(file));
    let names = ["<T: Lane", "<const FUSED: bool", "<Q: Quantity>(", "("]
        .map(|after| format!("fn {function}{after}"));
    let (before, text) = names.iter().find_map(|name| code.split_once(name)).expect("a function");
    let line = before.rsplit('\n').next().unwrap_or("");
    let indent = &line[..line.len() - line.trim_start().len()];
    let (_, body) = text.split_once(" {\n").expect("a body");
    statements(body.split_once(&format!("\n{indent}}}")).expect("an end").0)
}

/// Whether a script is of the vector kernels.
pub(crate) fn is_of_lanes(script: &str) -> bool {
    ["lanes_", "sum_", "log_odds_", "far_"].iter().any(|kind| script.starts_with(kind))
}

/// The scripts of the vector kernels.
pub(crate) fn scripts_of_lanes() -> BTreeMap<String, String> {
    scripts().into_iter().filter(|(name, _)| is_of_lanes(name)).collect()
}

/// The text up to the brace that closes it, and what follows.
fn block(text: &str) -> (&str, &str) {
    let mut depth = 1;
    for (i, c) in text.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return (&text[..i], &text[i + 1..]);
        }
    }
    panic!("no end: {text}")
}

/// The text with the branch that a kernel takes in place of `if condition { .. } else { .. }`.
fn branch(text: &str, condition: &str, taken: bool) -> String {
    let Some((before, rest)) = text.split_once(&format!("if {condition} {{")) else {
        return text.to_owned();
    };
    let (first, rest) = block(rest);
    let (second, after) = block(rest.trim_start().strip_prefix("else {").expect("two branches"));
    format!("{before}{}{after}", if taken { format!("{{{first}}}") } else { format!("{{{second}}}") })
}

/// The statement as the kernel of a script runs it.
fn as_run(script: &str, text: &str) -> String {
    branch(text, "FUSED", script.contains("_fused"))
}

/// The translation of an expression of a function, in the roundings of its format: a script of occupancies in `f32` says `rnd` of
/// that, and `wide` of `f64`.
fn in_format(script: &str, function: Option<&str>, translation: &str) -> String {
    let of_single = matches!(function, Some("rest" | "series"));
    if script.starts_with("lanes_f32") && !of_single {
        translation.replace("rnd(", "wide(")
    } else {
        translation.to_owned()
    }
}

#[test]
fn the_scripts_quote_every_statement_of_the_kernels() {
    let scripts = scripts_of_lanes();
    let names: Vec<&str> = scripts.keys().map(String::as_str).collect();
    let series =
        ["", "_fused"].map(|fused| ["f32", "f64"].map(|format| format!("lanes_{format}{fused}.gappa")));
    let of_log_odds = series.clone().map(|names| names.map(|name| name.replace("lanes", "log_odds")));
    let sums = ["f32", "f64"].map(|format| format!("sum_{format}.gappa"));
    let mut all: Vec<String> = [series, of_log_odds].concat().concat();
    all.extend(sums);
    all.push("far_f64_fused.gappa".to_owned());
    all.sort();
    assert_eq!(names, all);
    for (name, script) in &scripts {
        let mut quoted: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for Quotation { function, text, .. } in quotations(script) {
            if let Some(function) = function {
                quoted.entry(function).or_default().push(text);
            } else {
                assert!(is_in_source(name, &text), "{name}: {text}");
            }
        }
        for &(file, function) in quoted_by(name) {
            let expected = Some(statements_of(file, function));
            assert_eq!(quoted.remove(function), expected, "{name}: fn {function}");
        }
        assert!(quoted.is_empty(), "{name}: {quoted:?}");
    }
}

#[test]
fn the_definitions_translate_the_kernels() {
    for (name, script) in scripts_of_lanes() {
        let (fused, double) = (name.contains("_fused"), name.contains("f64"));
        let mut checked = 0;
        for quotation in quotations(&script) {
            let text = as_run(&name, &quotation.text);
            assert!(quotation.explained || !quotation.definitions.is_empty(), "{name}: not defined: {text}");
            let in_format = |x: String| in_format(&name, quotation.function.as_deref(), &x);
            let parts: Vec<_> =
                expressions(&text).iter().flat_map(|x| x.rounded_parts(fused)).map(in_format).collect();
            for (defined, value) in &quotation.definitions {
                // A constant, which other tests compare.
                if !defined.contains(char::is_lowercase) {
                    continue;
                }
                if let Some(polynomial) = defined.strip_prefix("horner_") {
                    let calls =
                        ["rr", "square", "q"].map(|x| (x, format!("horner::<FUSED, _>(&{polynomial}, {x})")));
                    let (x, _) = calls.iter().find(|(_, call)| text.contains(call)).expect("a call");
                    let count = log_odds::polynomials()[polynomial].len();
                    assert_eq!(*value, rounded_horner(polynomial, count, x, fused), "{name}: {defined}");
                    checked += 1;
                    continue;
                }
                // `let name = ...` is all of its right side.
                let whole = text
                    .strip_prefix(&format!("let {defined} = "))
                    .filter(|right| !right.starts_with("if "))
                    .map(|right| in_format(expressions(right)[0].rounded(fused)));
                let found = whole.map_or_else(|| parts.contains(value), |whole| whole == *value);
                assert!(found, "{name}: {defined} = {value}\nis not in {text}\nwhich is {parts:#?}");
                checked += 1;
            }
        }
        let (kind, _) = name.split_once('_').expect("a kind");
        let expected = match (kind, double) {
            ("sum", _) => 4,
            ("lanes", true) => 29,
            ("lanes" | "far", _) => 22,
            (_, false) => 18,
            (_, true) => 17,
        };
        assert_eq!(checked, expected, "{name}: definitions");
        for (defined, value) in script.lines().filter_map(crate::definition) {
            if let Some(unit) = defined.strip_prefix("unit_") {
                let (sign, magnitude) = unit.strip_prefix("minus_").map_or(("", unit), |rest| ("-", rest));
                let (numerator, denominator) = magnitude.split_once('_').expect("two numbers");
                let expected = format!("rnd(wide(wide({sign}{numerator} / {denominator}) / (2 * LN_2)))");
                assert_eq!(value, expected, "{name}: {defined}");
            }
        }
    }
}

/// The format, the constants and the mathematics of each script.
#[test]
fn the_scripts_have_the_formats_of_the_kernels() {
    for (name, script) in scripts_of_lanes()
        .into_iter()
        .filter(|(name, _)| ["lanes_", "sum_"].iter().any(|kind| name.starts_with(kind)))
    {
        let double = name.contains("f64");
        let has = |line: &str| assert!(script.lines().any(|l| l == line), "{name}: {line}");
        has(if double { "@rnd = float<ieee_64, ne>;" } else { "@rnd = float<ieee_32, ne>;" });
        // Of the results' format; kernels of occupancies end in `f64`.
        has(if double || name.starts_with("lanes_") { "EPSILON = 1b-52;" } else { "EPSILON = 1b-23;" });
        if name.starts_with("sum_") {
            continue;
        }
        has("@wide = float<ieee_64, ne>;");
        has("LN_2 = 0x1.62E42FEFA39EFp-1;");
        let error = log_odds::constant(kernel_of(&name), "ERROR");
        if double {
            has(&format!("ERROR = rnd({error});"));
            if !name.contains("_fused") {
                has("@cut = float<9, -1074, zr>;");
            }
        } else {
            has(&format!("ERROR = wide({error});"));
            has("HALF = 0.5;");
            // The same bounds of 1 - V as of V.
            has("near_lower = wide(complement * less);");
            has("near_upper = wide(complement * more);");
        }
    }
    assert_eq!(core::f64::consts::LN_2.to_bits(), 0x3fe6_2e42_fefa_39ef);
}

/// No bound is lost: Gappa would pass all the more easily.
#[test]
fn the_scripts_prove_what_the_rounding_tests_need() {
    for (name, script) in scripts_of_lanes() {
        let (_, goals) = script.split_once("\n->\n").expect("goals");
        let (goals, _) = goals.split_once("\n}").expect("their end");
        let of_results =
            |line: &&str| line.contains("exact <=") || line.contains("exact >=") || line.contains("exact)");
        let goals: Vec<&str> = goals.lines().map(str::trim).collect();
        let found: Vec<&str> = if name.starts_with("sum_") {
            goals.last().copied().into_iter().collect()
        } else {
            goals.into_iter().filter(of_results).collect()
        };
        assert_eq!(found, goals_of(&name), "{name}");
    }
}

/// What a script assumes of the rows of the table, `proofs/rows.sollya` certifies: `|...| <= ...`.
#[test]
fn the_rows_are_certified_as_the_scripts_assume() {
    let rows = fs::read_to_string("proofs/rows.sollya").expect("the certificate is there");
    for (name, script) in scripts_of_lanes().into_iter().filter(|(name, _)| name.starts_with("lanes_")) {
        let assumed: Vec<&str> =
            script.lines().filter_map(|line| line.trim().strip_suffix(" /\\ # rows.sollya")).collect();
        assert_eq!(assumed.len(), if name.contains("f64") { 5 } else { 2 }, "{name}");
        for assumption in assumed {
            let (what, bound) = assumption.split_once("| <= 1b-").expect("a power of two");
            let what = what.trim_start_matches('|').split_once(" -/ ").expect("a relative error").0;
            let certified = format!("certify(\"{what}\", 2^(-{bound}));");
            assert!(rows.lines().any(|line| line == certified), "{name}: not certified: {certified}");
        }
    }
}
