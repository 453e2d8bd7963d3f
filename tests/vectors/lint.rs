//! The files of vectors themselves: what `vectors/generate/lint.py` checks, as far as no arithmetic is needed.

use super::vectors;
use mean_information::Real;
use mean_information::operations::OPERATIONS;
use mean_information_test_support::exact::{Exact, float};
use serde_json::Value as Json;
use std::collections::BTreeSet;
use std::fs;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/vectors/v1");

fn tests(file: &Json) -> &[Json] {
    file["tests"].as_array().expect("tests")
}

/// The names under a key: those of an object, or the texts of an array.
fn names(value: &Json) -> BTreeSet<&str> {
    match value {
        Json::Object(notes) => notes.keys().map(String::as_str).collect(),
        Json::Array(items) => items.iter().map(|item| item.as_str().expect("a name")).collect(),
        _ => BTreeSet::new(),
    }
}

/// Every float of a value, which may be lists of lists.
fn floats(value: &Json) -> Vec<&str> {
    match value {
        Json::String(text) => vec![text],
        Json::Array(items) => items.iter().flat_map(floats).collect(),
        Json::Object(fields) => fields.values().flat_map(floats).collect(),
        _ => Vec::new(),
    }
}

/// Whether a text is the one spelling of a float of the format: `0x1.8p-2`, no zeros at the end, subnormal ones with
/// `0x0.`.
fn is_canonical<T: Real>(text: &str) -> bool {
    let magnitude = text.strip_prefix('-').unwrap_or(text);
    if text == "nan" || magnitude == "inf" {
        return true;
    }
    let Some((significand, exponent)) = magnitude.strip_prefix("0x").and_then(|rest| rest.split_once('p'))
    else {
        return false;
    };
    let (whole, fraction) = significand.split_once('.').unwrap_or((significand, ""));
    let exponent_is_spelled = exponent.starts_with(['+', '-'])
        && exponent.parse::<i32>().is_ok_and(|number| format!("{number:+}") == exponent);
    // What the format does not hold would have been rounded.
    let exact = || {
        let m = u64::from_str_radix(&format!("{whole}{fraction}"), 16).ok()?;
        let e = exponent.parse::<i32>().ok()? - 4 * fraction.len() as i32;
        let (n, f) = float::<T>(text)?.parts();
        let [sent, held] = [(m, e), (n, f)].map(|(m, binary)| Exact { m: m.into(), binary, decimal: 0 });
        Some(sent.compare(&held).is_eq())
    };
    let (has_point, ends_in_zero) = (significand.contains('.'), fraction.ends_with('0'));
    let leading = if whole == "1" { "1" } else { "0" };
    whole == leading
        && has_point != fraction.is_empty()
        && !ends_in_zero
        && exponent_is_spelled
        && exact() == Some(true)
}

#[test]
fn every_flag_and_trap_has_a_note_and_every_note_is_used() {
    for operation in OPERATIONS {
        let file = vectors(operation);
        for kind in ["flags", "traps"] {
            let used: BTreeSet<_> = tests(&file).iter().flat_map(|test| names(&test[kind])).collect();
            assert_eq!(used, names(&file[kind]), "{}: {kind}", operation.name);
        }
    }
}

#[test]
fn every_float_is_spelled_in_the_one_way_and_of_its_format() {
    for operation in OPERATIONS {
        for test in tests(&vectors(operation)) {
            for text in floats(&test["args"]).into_iter().chain(floats(&test["traps"])) {
                let canonical = if test["format"] == "f32" {
                    is_canonical::<f32>(text)
                } else {
                    is_canonical::<f64>(text)
                };
                assert!(canonical, "{}: {}: {text}", operation.name, test["id"]);
            }
        }
    }
    for text in ["0x1.80p-2", "0x1.p-2", "0x2p-2", "0x1p1", "0x1.0000001p+0", "1.5", "0x1p-150"] {
        assert!(!is_canonical::<f32>(text), "{text}");
    }
}

#[test]
fn every_enclosure_is_ordered_and_other_answers_are_flagged() {
    for operation in OPERATIONS {
        for test in tests(&vectors(operation)) {
            let also = test["also"].as_array().into_iter().flatten();
            assert!(test["also"].is_null() || names(&test["flags"]).contains("Boundary"), "{}", test["id"]);
            for want in std::iter::once(&test["want"]).chain(also) {
                let end = |name: &str| Exact::decimal(want[name].as_str()?);
                match (end("lo"), end("hi")) {
                    (Some(lo), Some(hi)) => assert!(lo.compare(&hi).is_le(), "{}", test["id"]),
                    _ => assert!(want["error"] == "domain" || want["count"].is_u64(), "{}", test["id"]),
                }
            }
        }
    }
}

#[test]
fn the_folder_holds_a_file_of_each_operation_and_nothing_else() {
    let of_operations = OPERATIONS.iter().map(|operation| format!("{}.json", operation.name));
    let expected: BTreeSet<_> = of_operations.chain(["operations.json".to_owned()]).collect();
    let sums = fs::read_to_string(format!("{FOLDER}/SHA256SUMS")).expect("the checksums");
    let summed: BTreeSet<_> =
        sums.lines().filter_map(|line| Some(line.split_once("  ")?.1.to_owned())).collect();
    assert_eq!(summed, expected);
    let found = fs::read_dir(FOLDER).expect("the folder").map(|entry| entry.expect("an entry").file_name());
    let found: BTreeSet<_> = found.map(|name| name.into_string().expect("a name")).collect();
    assert_eq!(found, expected.into_iter().chain(["SHA256SUMS".to_owned()]).collect());
}
