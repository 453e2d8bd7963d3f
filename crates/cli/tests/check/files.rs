//! Files of vectors that make no sense: they are refused with the file, the test, the value and what is allowed, before
//! any port is started.

use super::Test;
use super::fixture::Vectors;
use mean_information_cli::check::Vectors as File;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::fs;

pub(crate) const TESTS: &[Test] = &[
    ("what_makes_no_sense_alone_is_refused", what_makes_no_sense_alone_is_refused),
    ("what_makes_no_sense_together_is_refused", what_makes_no_sense_together_is_refused),
    ("text_that_is_no_json_is_refused", text_that_is_no_json_is_refused),
    ("the_keys_are_those_of_the_schema", the_keys_are_those_of_the_schema),
];

/// A file of one test that is all right.
fn file() -> Value {
    json!({
        "op": "cell.entropy", "version": 1, "tolerance_ulp": 0.5,
        "flags": {"Edge": "An end."}, "traps": {"Nats": "computes nats"},
        "tests": [{
            "id": "a", "format": "f64", "args": {"p": "0x1p-2"}, "want": {"lo": "0.81", "hi": "0.82"},
            "flags": ["Edge"], "traps": {"Nats": "0x1.1fe6fep-1"},
        }],
    })
}

/// Why the file is refused, after its name.
fn refusal(text: &str) -> String {
    let vectors = Vectors::new();
    fs::write(vectors.folder.path("cell.entropy.json"), text).unwrap();
    // A port that was started would leave this.
    let line = vectors.refusal("dies", &[]);
    let (_, what) = line.split_once("cell.entropy.json: ").unwrap_or_else(|| panic!("{line}"));
    what.trim_end().to_owned()
}

/// The file with this in place of the value at a pointer; null stands for none.
fn with(pointer: &str, value: &Value) -> String {
    let mut file = file();
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    let parent = file.pointer_mut(parent).unwrap().as_object_mut().unwrap();
    match value {
        Value::Null => parent.remove(key).map(drop),
        value => parent.insert(key.to_owned(), value.clone()).map(drop),
    };
    file.to_string()
}

fn what_makes_no_sense_alone_is_refused() {
    for (pointer, value, parts) in [
        ("/version", json!(2), &["version 2", "version 1"][..]),
        ("/version", Value::Null, &["missing field `version`"]),
        ("/tolerance_ulp", json!(-1), &["a tolerance of -1 ulp", "0, or 0.5 to 67108864"]),
        ("/tolerance_ulp", json!(1e300), &["0, or 0.5 to 67108864"]),
        ("/tolerance_ulp", json!(0.25), &["a tolerance of 0.25 ulp"]),
        ("/tolerance_ulp", json!("nan"), &["\"nan\"", "expected f64"]),
        ("/tolerance_ulps", json!(1), &["unknown field `tolerance_ulps`", "`tolerance_ulp`"]),
        ("/tests", json!([]), &["has no tests"]),
        (
            "/tests/0/want",
            json!({"lo": "1", "hi": "0.5"}),
            &["a: an enclosure that holds nothing: from 1 down to 0.5"],
        ),
        ("/tests/0/want", json!({"lo": "0x1p-1", "hi": "1"}), &["a: \"0x1p-1\" is no decimal such as"]),
        ("/tests/0/want", json!({"lo": "0", "hi": "1e999999"}), &["a: \"1e999999\" is no decimal"]),
        ("/tests/0/want", json!({"lo": "0"}), &["a: ", "either lo and hi, or error, or count"]),
        (
            "/tests/0/want",
            json!({"lo": "0", "hi": "1", "count": 3}),
            &["a: ", "either lo and hi, or error, or count"],
        ),
        ("/tests/0/want", json!({"low": "0", "hi": "1"}), &["a: unknown field `low`", "`lo`"]),
        ("/tests/0/want", json!({"error": "range"}), &["a: the error \"range\"", "only \"domain\""]),
        ("/tests/0/want", Value::Null, &["a: missing field `want`"]),
        ("/tests/0/also", json!([{"count": -3}]), &["a: ", "-3"]),
        ("/tests/0/trap", json!({}), &["a: unknown field `trap`", "`traps`"]),
        ("/tests/0/format", json!("f16"), &["a: unknown variant `f16`", "`f32` or `f64`"]),
        ("/tests/0/tolerance_ulp", json!(-3), &["a: a tolerance of -3 ulp", "0, or 0.5 to 67108864"]),
        ("/tests/0/flags", json!(3), &["a: ", "3", "expected a sequence"]),
        ("/tests/0/traps", json!({"Nats": "half"}), &["a: the trap \"half\" is neither a hexadecimal float"]),
        ("/tests/0/traps", json!({"Nats": 0.25}), &["a: the trap 0.25 is neither"]),
        ("/tests/0/args", json!({"p": 0.25}), &["a: an argument is a hexadecimal float in a string"]),
        ("/tests/0/id", json!(7), &["test 1 of \"tests\": ", "7", "expected a string"]),
        ("/tests/0/id", Value::Null, &["test 1 of \"tests\": missing field `id`"]),
    ] {
        let what = refusal(&with(pointer, &value));
        assert!(parts.iter().all(|part| what.contains(part)), "{pointer} = {value}: {what}");
    }
}

fn what_makes_no_sense_together_is_refused() {
    for (pointer, value, wanted) in [
        ("/op", json!("cell.entopy"), "cell.entopy is no operation of `meaninfo check --list`"),
        (
            "/tolerance_ulp",
            json!(0),
            "a tolerance of 0 ulp for cell.entropy: counts have 0, floats 0.5 or more",
        ),
        (
            "/tests/0/want",
            json!({"count": 3}),
            "a: what is wanted is not the result of cell.entropy: a float",
        ),
        ("/tests/0/tolerance_ulp", json!(0.5), "a: a tolerance of 0.5 ulp, not above that of the file, 0.5"),
        ("/tests/0/flags", json!(["Edges"]), "a: nothing says what the flag Edges means"),
        ("/tests/0/traps", json!({"Gini": "0x1p-1"}), "a: nothing says what the trap Gini means"),
        (
            "/tests/0/traps",
            json!({"Nats": 3}),
            "a: the trap Nats is not what cell.entropy can answer: a float",
        ),
        ("/tests/0/args", json!({}), "a: the argument p is missing"),
        ("/tests/0/args", json!({"p": "0x1p-2", "q": "0x1p-2"}), "a: cell.entropy has no argument q"),
        ("/tests/0/args", json!({"p": ["0x1p-2"]}), "a: p must be of the shape float, not list"),
        ("/tests/0/args", json!({"p": "0.25"}), "a: p: \"0.25\" is no hexadecimal float of f64"),
        ("/tests/0/id", json!(""), ": a test whose id is empty"),
    ] {
        assert_eq!(refusal(&with(pointer, &value)), wanted, "{pointer} = {value}");
    }
    let what = refusal(&file().to_string().replace("f64", "f32").replace("0x1p-2", "0x1.0000001p-2"));
    assert_eq!(what, "a: p: \"0x1.0000001p-2\" is no hexadecimal float of f32");
    // The same names in two files, or in one.
    let vectors = Vectors::new();
    fs::write(vectors.folder.path("copy.json"), file().to_string().replace("\"a\"", "\"test-7\"")).unwrap();
    assert!(vectors.refusal("dies", &[]).contains("test-7 is there twice"));
}

fn text_that_is_no_json_is_refused() {
    for (text, wanted) in
        [("", "EOF"), ("{", "EOF"), ("[]", "invalid length 0"), ("null", "invalid type: null")]
    {
        let what = refusal(text);
        assert!(what.starts_with("is not a file of vectors: ") && what.contains(wanted), "{text}: {what}");
    }
    let huge = file().to_string().replace("0.5", "1e999");
    assert!(refusal(&huge).contains("number out of range at line 1"));
}

/// What is read and what `vectors/schema.json` describes cannot come to differ: the reader refuses a key that it does
/// not know, and says which it does.
fn the_keys_are_those_of_the_schema() {
    let schema = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../vectors/schema.json"));
    let schema: Value = serde_json::from_str(schema).unwrap();
    let described = |pointers: &[&str]| -> BTreeSet<String> {
        let properties = pointers.iter().map(|pointer| schema.pointer(pointer).unwrap().as_object().unwrap());
        properties.flat_map(serde_json::Map::keys).cloned().collect()
    };
    let wants = [0, 1, 2].map(|kind| format!("/$defs/want/oneOf/{kind}/properties"));
    for (place, pointers) in [
        ("/x", &["/properties"][..]),
        ("/tests/0/x", &["/$defs/test/properties"]),
        ("/tests/0/want/x", &wants.each_ref().map(String::as_str)),
    ] {
        let error = serde_json::from_str::<File>(&with(place, &json!(1))).unwrap_err().to_string();
        let (_, expected) = error.split_once("expected one of ").unwrap_or_else(|| panic!("{error}"));
        let read: BTreeSet<_> = expected.split('`').skip(1).step_by(2).map(str::to_owned).collect();
        assert_eq!(read, described(pointers), "{place}");
    }
}
