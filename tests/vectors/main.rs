//! The vectors against this crate: every operation in both formats, each answer as near as its function promises.

mod judge;
mod lint;

use mean_information::Real;
use mean_information::operations::{OPERATIONS, Operation, Outcome, Shape, Value};
use mean_information_test_support::exact::float;
use serde_json::Value as Json;
use std::collections::HashSet;
use std::fs;

/// Thousandths of an ulp by which this crate may be off where the vectors let a port be further off:
/// `docs/guarantees.md`.
const PROMISED: [(&str, u64); 2] = [
    ("limit::closed_form", 501),
    // Each cell is off by half an ulp, relative to it `2^-53`; so is the sum, which is at most an ulp. Then it is
    // rounded. (Not so of sums below the normal numbers, if they have more than two terms: docs/guarantees.md.)
    ("Tally::", 1500),
];

/// The file of an operation.
fn vectors(operation: &Operation) -> Json {
    let path = format!("{}/vectors/v1/{}.json", env!("CARGO_MANIFEST_DIR"), operation.name);
    serde_json::from_str(&fs::read_to_string(&path).expect(&path)).expect(&path)
}

/// The arguments of a test, in the order of the operation.
fn arguments<T: Real>(operation: &Operation, test: &Json) -> Vec<Value<T>> {
    let scalar = |x: &Json| x.as_str().and_then(float::<T>).expect("a hexadecimal float");
    let list = |x: &Json| x.as_array().expect("a list").iter().map(scalar).collect::<Vec<_>>();
    let named = test["args"].as_object().expect("arguments");
    assert_eq!(named.len(), operation.arguments.len(), "{}", test["id"]);
    let value = |shape: Shape, x: &Json| match shape {
        Shape::Float => Value::Float(scalar(x)),
        Shape::List => Value::List(list(x)),
        Shape::Rows => Value::Rows(x.as_array().expect("rows").iter().map(list).collect()),
        other => panic!("{}: no {} is read", test["id"], other.name()),
    };
    operation.arguments.iter().map(|argument| value(argument.shape, &named[argument.name])).collect()
}

/// Whether this crate answers a test as it promises.
fn is_right<T: Real>(operation: &Operation, tolerance: f64, test: &Json) -> bool {
    let allowed = test["tolerance_ulp"].as_f64().unwrap_or(tolerance);
    let promised = PROMISED.iter().find(|(function, _)| operation.function.starts_with(function));
    let milliulps = ((allowed * 1e3) as u64).min(promised.map_or(u64::MAX, |&(_, promised)| promised));
    judge::is_right(&operation.run(&arguments::<T>(operation, test)), test, milliulps)
}

#[test]
fn this_crate_answers_every_test_as_it_promises() {
    let (mut ids, mut count) = (HashSet::new(), 0);
    for operation in OPERATIONS {
        let file = vectors(operation);
        assert_eq!(file["op"], operation.name);
        assert_eq!(file["formula"], operation.equation, "{}", operation.name);
        assert_eq!(file["tolerance_ulp"].as_f64(), Some(operation.tolerance_ulp), "{}", operation.name);
        let tests = file["tests"].as_array().expect("tests");
        let wrong: Vec<_> = tests
            .iter()
            .filter(|test| match test["format"].as_str() {
                Some("f32") => !is_right::<f32>(operation, operation.tolerance_ulp, test),
                Some("f64") => !is_right::<f64>(operation, operation.tolerance_ulp, test),
                other => panic!("{}: no such format: {other:?}", test["id"]),
            })
            .map(|test| &test["id"])
            .collect();
        assert!(wrong.is_empty(), "{} of {}: {wrong:#?}", wrong.len(), tests.len());
        for test in tests {
            let id = test["id"].as_str().expect("an id").to_owned();
            assert!(ids.insert((operation.name, id)), "{}: an id means one test", test["id"]);
        }
        count += tests.len();
    }
    println!("{count} tests");
}

/// An empty file would pass: every operation has tests inside and outside its domain, in both formats.
#[test]
fn every_operation_is_tested_inside_and_outside_its_domain() {
    for operation in OPERATIONS {
        let file = vectors(operation);
        let count = |format: &str, refused: bool| {
            let tests = file["tests"].as_array().expect("tests").iter();
            tests
                .filter(|test| test["format"] == format && test["want"]["error"].is_string() == refused)
                .count()
        };
        for format in ["f32", "f64"] {
            let least = if operation.result == Outcome::Count { 20 } else { 40 };
            assert!(count(format, false) >= least, "{}, {format}", operation.name);
            assert!(count(format, true) >= 1, "{}, {format}", operation.name);
        }
    }
}
