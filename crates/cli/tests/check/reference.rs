//! The library as a port: right in both formats, and an error in words for whatever is no request.

use super::Test;
use crate::common::{Folder, meaninfo, read, refusal, stdout, text};
use mean_information::operations::OPERATIONS;
use serde_json::{Value, json};

pub(crate) const TESTS: &[Test] = &[
    ("the_reference_passes", the_reference_passes),
    ("the_list_is_the_registry", the_list_is_the_registry),
    ("the_port_answers_whatever_it_is_asked", the_port_answers_whatever_it_is_asked),
    ("usage", usage),
];

fn the_reference_passes() {
    let program = assert_cmd::cargo::cargo_bin!("meaninfo");
    let program = program.to_str().unwrap();
    let json = stdout(&["check", "--format", "json", "--", program, "port"]);
    let json: Value = serde_json::from_str(&json).unwrap();
    assert_eq!((&json["failed"], &json["skipped"]), (&json!(0), &json!(0)));
    assert!(json["passed"].as_u64().unwrap() > 12_000);
    assert_eq!(json["operations"].as_array().unwrap().len(), OPERATIONS.len());
    for operation in json["operations"].as_array().unwrap() {
        let formats = operation["formats"].as_array().unwrap();
        assert_eq!(formats.len(), 2, "{}", operation["operation"]);
        assert!(formats.iter().all(|row| row["passed"] == row["cases"] && row["cases"].as_u64() > Some(0)));
    }
}

fn the_list_is_the_registry() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../vectors/v1/operations.json");
    let file: Value = serde_json::from_slice(&read(file)).unwrap();
    let list: Value = serde_json::from_str(&stdout(&["check", "--list", "--format", "json"])).unwrap();
    assert_eq!(list, file);
    let (table, csv) = (stdout(&["check", "--list"]), stdout(&["check", "--list", "--format", "csv"]));
    assert_eq!(csv.lines().count(), OPERATIONS.len() + 1);
    for operation in OPERATIONS {
        assert!(table.contains(operation.name) && csv.contains(operation.equation), "{}", operation.name);
    }
}

/// What the port answers to these lines.
fn answers(lines: &[u8]) -> Vec<Value> {
    let output = meaninfo().arg("port").write_stdin(lines).output().unwrap();
    assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), ""));
    text(&output.stdout).lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn the_port_answers_whatever_it_is_asked() {
    let start = answers(b"{\"cmd\":\"start\",\"protocol\":1}\n");
    assert_eq!((&start[0]["protocol"], &start[0]["formats"]), (&json!(1), &json!(["f32", "f64"])));
    assert_eq!(start[0]["ops"].as_array().unwrap().len(), OPERATIONS.len());

    let run = |op: &str, format: &str, args: &str| {
        format!("{{\"cmd\":\"run\",\"seq\":9,\"op\":\"{op}\",\"format\":\"{format}\",\"args\":{args}}}")
    };
    let error = |word: &str| json!({"seq": 9, "error": word});
    let p = r#"{"p":"0x1p-1"}"#;
    for (line, answer) in [
        (run("cell.entropy", "f64", p), json!({"seq": 9, "result": "0x1p+0"})),
        (run("cell.entropy", "f32", p), json!({"seq": 9, "result": "0x1p+0"})),
        (run("cell.entropy", "f64", r#"{"p":"nan"}"#), error("domain")),
        (run("map.observed", "f64", r#"{"cells":["0x1p-1","0x1p-2"]}"#), json!({"seq": 9, "result": 1})),
        (run("map.observed", "f64", r#"{"cells":[]}"#), json!({"seq": 9, "result": 0})),
        (
            run("expected.mean_information", "f64", r#"{"weights":["0x1p+1"],"particles":[["0x0p+0"]]}"#),
            json!({"seq": 9, "result": "0x1p+0"}),
        ),
        (run("cell.entopy", "f64", p), error("unknown-operation")),
        (run("cell.entropy", "f16", p), error("unknown-format")),
        (run("cell.entropy", "f64", "{}"), error("arguments")),
        (run("cell.entropy", "f64", r#"{"q":"0x1p-1"}"#), error("arguments")),
        (run("cell.entropy", "f64", r#"{"p":"0x1p-1","q":"0x1p-1"}"#), error("arguments")),
        (run("cell.entropy", "f64", r#"{"p":["0x1p-1"]}"#), error("arguments")),
        (run("cell.entropy", "f64", r#"{"p":"0.5"}"#), error("arguments")),
        (run("cell.entropy", "f32", r#"{"p":"0x1.000000000001p-1"}"#), error("arguments")),
        (run("map.observed", "f64", r#"{"cells":[["0x1p-1"]]}"#), error("arguments")),
        (run("cell.entropy", "f64", "[]"), error("malformed")),
        (run("cell.entropy", "f64", r#"{"p":0.5}"#), error("malformed")),
        (r#"{"cmd":"jump","seq":9}"#.to_owned(), error("malformed")),
        (r#"{"seq":9}"#.to_owned(), error("malformed")),
        (r#"{"cmd":"start","protocol":2}"#.to_owned(), json!({"seq": null, "error": "protocol"})),
        (r#"{"cmd":"start"}"#.to_owned(), json!({"seq": null, "error": "malformed"})),
        ("[".repeat(100_000), json!({"seq": null, "error": "malformed"})),
        (String::new(), json!({"seq": null, "error": "malformed"})),
        ("3".to_owned(), json!({"seq": null, "error": "malformed"})),
    ] {
        let found = answers(format!("{line}\n{{\"cmd\":\"stop\"}}\nnever read\n").as_bytes());
        assert_eq!(found, [answer], "{line}");
    }
    assert_eq!(answers(b"\xff\n").len(), 1);
    assert_eq!(answers(b""), [] as [Value; 0]);

    // A grid of more cells than this crate computes.
    let args = r#"{"range":"0x1p+20","sigma":"0x1p-3","resolution":"0x1p-30"}"#;
    let too_large = answers((run("grid.polar.mean_information", "f64", args) + "\n").as_bytes());
    assert!(too_large[0]["skipped"].is_string(), "{too_large:?}");
}

fn usage() {
    let folder = Folder::new();
    let missing = folder.text_path("missing");
    for (arguments, what) in [
        (&["check"][..], "<CMD>"),
        (&["check", "--list", "--", "port"], "--list"),
        (&["check", "--list", "--format", "junit"], "JUnit"),
        (&["check", "--timeout", "0", "--", "port"], "86400"),
        (&["check", "--timeout", "nan", "--", "port"], "86400"),
        (&["check", "--timeout", "1e300", "--", "port"], "86400"),
        (&["check", "--ops", "cell.entopy", "--", "port"], "cell.entropy"),
        (&["check", "--known-failures", &missing, "--", "port"], "missing"),
        (&["check", "--vectors", &missing, "--", "port"], "missing"),
        (&["check", "--vectors", folder.path("").to_str().unwrap(), "--", "port"], "no vectors"),
        (&["check", "--", "/no/such/program"], "/no/such/program"),
        (&["port", "extra"], "extra"),
    ] {
        let line = refusal(arguments);
        assert!(line.contains(what), "{arguments:?}: {line}");
    }
}
