//! The verdict in all its forms: claims, known failures and what is skipped.

use super::Test;
use super::fixture::Vectors;
use crate::common::schema::assert_every_key;
use crate::common::{Folder, assert_twins, meaninfo, read, text};
use serde_json::Value;
use std::fs;

pub(crate) const TESTS: &[Test] = &[
    ("a_right_port_passes", a_right_port_passes),
    ("claims_are_allowed_and_shown", claims_are_allowed_and_shown),
    ("absolute_errors_are_allowed_and_shown", absolute_errors_are_allowed_and_shown),
    ("nothing_passed_is_no_success", nothing_passed_is_no_success),
    ("what_is_not_declared_is_skipped", what_is_not_declared_is_skipped),
    ("operations_are_chosen", operations_are_chosen),
    ("known_failures_do_not_count", known_failures_do_not_count),
    ("known_failures_cannot_go_stale", known_failures_cannot_go_stale),
    ("what_is_not_run_is_no_known_failure", what_is_not_run_is_no_known_failure),
    ("nothing_that_is_read_is_overwritten", nothing_that_is_read_is_overwritten),
    ("junit_has_every_test", junit_has_every_test),
    ("csv_and_json_have_the_same_rows", csv_and_json_have_the_same_rows),
    ("every_key_of_the_schema_is_seen", every_key_of_the_schema_is_seen),
];

/// A port with a mistake that is known, one with claims, and one that ends with an error.
fn every_key_of_the_schema_is_seen() {
    let vectors = Vectors::new();
    assert_every_key("check", &["nats", "claims", "exits-3-at-stop"].map(|fault| vectors.json(fault, &[])));
}

fn a_right_port_passes() {
    let (status, table) = Vectors::new().check("none", &[]);
    assert_eq!((status, table.lines().last()), (0, Some("44 passed, 0 failed, 0 skipped")), "{table}");
}

fn claims_are_allowed_and_shown() {
    let vectors = Vectors::new();
    let (status, table) = vectors.check("claims", &[]);
    assert_eq!((status, table.lines().last()), (0, Some("44 passed, 0 failed, 0 skipped")), "{table}");
    assert!(table.contains("4 claimed") && table.contains("mop.*, which no operation matches"), "{table}");
    let json = vectors.json("claims", &[]);
    assert_eq!(json["operations"][0]["formats"][0]["claimed_ulp"], 4.0);
    assert_eq!(json["passed_by_claim"], 34);
    assert!(table.contains("34 answers pass only by the port's claims"), "{table}");
    // The same answers without the claim.
    vectors.table("next", &[], "10 passed, 34 failed, 0 skipped");
}

fn absolute_errors_are_allowed_and_shown() {
    let vectors = Vectors::new();
    let (status, table) = vectors.check("claims-bits", &[]);
    assert_eq!((status, table.lines().last()), (0, Some("44 passed, 0 failed, 0 skipped")), "{table}");
    assert!(table.contains("2e-16 bits claimed"), "{table}");
    let json = vectors.json("claims-bits", &[]);
    let row = &json["operations"][0]["formats"][0];
    assert_eq!((&row["claimed_bits"], &row["claimed_ulp"]), (&2e-16.into(), &Value::Null));
    let worst = row["worst_error_absolute"].as_f64().unwrap();
    assert!((1e-16..2e-16).contains(&worst), "{worst}");
    assert_eq!(json["port"]["claims"][0]["bits"], 2e-16);
    // The same answers without the claim.
    let failed = vectors.json("off-by-bits", &[])["failed"].as_u64().unwrap();
    assert!(failed > 0 && json["passed_by_claim"] == failed, "{failed}: {json}");
}

/// A port that is asked nothing it answers has not been checked.
fn nothing_passed_is_no_success() {
    let (status, table) = Vectors::new().check("skips-all", &[]);
    assert_eq!((status, table.lines().last()), (1, Some("0 passed, 0 failed, 44 skipped")), "{table}");
    assert!(table.contains("nothing passed"), "{table}");
}

fn what_is_not_declared_is_skipped() {
    let vectors = Vectors::new();
    let (status, table) = vectors.check("half", &[]);
    assert_eq!((status, table.lines().last()), (0, Some("40 passed, 0 failed, 4 skipped")), "{table}");
    assert!(table.contains("not declared: 1 of 2 operations, 4 cases skipped: map.observed"), "{table}");
    assert!(table.contains("cell.entopy, which has no vectors"), "{table}");
    let (status, table) = vectors.check("double-only", &[]);
    assert_eq!((status, table.lines().last()), (0, Some("24 passed, 0 failed, 20 skipped")), "{table}");
    assert!(
        table.contains("20 cases skipped: the port does not declare f32") && table.contains("f80"),
        "{table}"
    );
    let (status, table) = vectors.check("skips", &[]);
    assert_eq!((status, table.lines().last()), (0, Some("27 passed, 0 failed, 17 skipped")), "{table}");
    assert!(table.contains("17 cases skipped: no \\u{1b}single precision"), "{table}");
}

fn operations_are_chosen() {
    let vectors = Vectors::new();
    for (options, last) in [
        (&["--ops", "map.*"][..], "4 passed, 0 failed, 0 skipped"),
        (&["--ops", "cell.information"], "40 passed, 0 failed, 0 skipped"),
        (&["--ops", "*.observed", "--ops", "c*n"], "44 passed, 0 failed, 0 skipped"),
    ] {
        let (status, table) = vectors.check("none", options);
        assert_eq!((status, table.lines().last()), (0, Some(last)), "{table}");
    }
}

fn known_failures_do_not_count() {
    let vectors = Vectors::new();
    let known = vectors.folder.text_path("known.txt");
    fs::write(&known, "# rounding\ntest-7 # one and a half times\n").unwrap();
    let (status, table) = vectors.check("one-wrong", &["--known-failures", &known]);
    assert_eq!((status, table.lines().last()), (0, Some("43 passed, 0 failed, 1 skipped")), "{table}");
    assert!(
        table.contains("1 known failures, counted as skipped") && table.contains("worst: test-7"),
        "{table}"
    );
}

fn known_failures_cannot_go_stale() {
    let vectors = Vectors::new();
    let known = vectors.folder.text_path("known.txt");
    fs::write(&known, "test-7\ntest-8\nno-such-test\ntest-30\n").unwrap();
    let options = ["--known-failures", &known];
    let table = vectors.table("one-wrong", &options, "43 passed, 3 failed, 1 skipped");
    for line in ["test-8: passes", "no-such-test: no such test", "test-30: passes"] {
        assert!(table.contains(&format!("not a known failure any more: {line}")), "{table}");
    }
    // What is not asked is not known to fail; what is not chosen is not looked at.
    let table = vectors.table("skips", &options, "27 passed, 4 failed, 17 skipped");
    assert!(table.contains("test-30: is skipped: no \\u{1b}single"), "{table}");
    let table =
        vectors.table("none", &[&options[..], &["--ops", "map.*"]].concat(), "4 passed, 1 failed, 0 skipped");
    assert!(table.contains("no-such-test: no such test"), "{table}");
}

/// What was not run has failed, known or not, and its entry is not stale.
fn what_is_not_run_is_no_known_failure() {
    let vectors = Vectors::new();
    let known = vectors.folder.text_path("known.txt");
    let ids: Vec<_> = (1..=40).map(|number| format!("test-{number}\n")).collect();
    fs::write(&known, format!("\u{feff}{}", ids.concat())).unwrap();
    let options = ["--known-failures", &known, "--ops", "cell.*"];
    let table = vectors.table("exits-always", &options, "0 passed, 20 failed, 20 skipped");
    assert!(table.contains("20 known failures, counted as skipped"), "{table}");
    assert!(!table.contains("not a known failure"), "{table}");
}

/// Neither the port nor what is read of it, before anything is run.
fn nothing_that_is_read_is_overwritten() {
    let vectors = Vectors::new();
    let known = vectors.folder.text_path("known.txt");
    fs::write(&known, "").unwrap();
    let vector = vectors.folder.text_path("map.observed.json");
    let home = Folder::new();
    let program = home.text_path("program");
    fs::copy(std::env::current_exe().unwrap(), &program).unwrap();
    let script = home.text_path("script.py");
    fs::write(&script, "print()").unwrap();
    let elsewhere = Folder::new();
    for (name, folder) in [("program", &elsewhere), ("./program", &home)] {
        for output in [&known, &vector, &program, &script] {
            let mut command = meaninfo();
            command.current_dir(folder.path("")).env("PATH", home.path(""));
            command.args(["check", "--known-failures", &known, "--vectors"]).arg(vectors.folder.path(""));
            command.args(["--output", output, "--", name, "as-port", "dies", &script]);
            let refusal = command.output().unwrap();
            let line = text(&refusal.stderr);
            assert!(line.contains(output) && line.contains("is an input of this command"), "{name}: {line}");
            assert_eq!(refusal.status.code(), Some(2));
        }
    }
    #[cfg(unix)]
    assert!(
        vectors.check("none", &["--output", "/dev/stdout"]).1.ends_with("44 passed, 0 failed, 0 skipped\n")
    );
}

fn junit_has_every_test() {
    let vectors = Vectors::new();
    let known = vectors.folder.text_path("known.txt");
    fs::write(&known, "test-8 # passes\n").unwrap();
    for (fault, failures, skipped, others) in
        [("none", 0, 0, 0), ("exits-3", 2, 0, 1), ("nats", 35, 0, 0), ("skips", 1, 17, 1)]
    {
        let options = ["--format", "junit", "--known-failures", &known];
        let options = if fault == "none" { &options[..2] } else { &options };
        let (status, xml) = vectors.check(fault, options);
        assert_eq!(status, i32::from(failures > 0));
        let document = roxmltree::Document::parse(&xml).unwrap();
        let root = document.root_element();
        let number = |node: roxmltree::Node<'_, '_>, name: &str| {
            node.attribute(name).unwrap().parse::<usize>().unwrap()
        };
        // Under nats the known failure fails.
        let failures = failures - usize::from(fault == "nats");
        let (failures, skipped) =
            if fault == "nats" { (failures - 1, skipped + 1) } else { (failures, skipped) };
        assert_eq!(
            (number(root, "tests"), number(root, "failures"), number(root, "skipped")),
            (44 + others, failures, skipped),
            "{fault}"
        );
        let mut cases = 0;
        for suite in root.children().filter(roxmltree::Node::is_element) {
            let children: Vec<_> = suite.children().filter(roxmltree::Node::is_element).collect();
            let with = |tag: &str| {
                children.iter().filter(|case| case.children().any(|c| c.has_tag_name(tag))).count()
            };
            assert_eq!(number(suite, "tests"), children.len());
            assert_eq!(
                (number(suite, "failures"), number(suite, "skipped")),
                (with("failure"), with("skipped"))
            );
            cases += children.len();
        }
        assert_eq!(cases, 44 + others);
    }
}

fn csv_and_json_have_the_same_rows() {
    let vectors = Vectors::new();
    let output = vectors.folder.text_path("result.csv");
    let (status, nothing) = vectors.check("nats", &["--format", "csv", "--output", &output]);
    assert_eq!((status, nothing.as_str()), (1, ""));
    let csv = String::from_utf8(read(&output)).unwrap();
    let json = vectors.json("nats", &[]);
    let rows: Vec<&Value> = json["operations"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|o| o["formats"].as_array().unwrap())
        .collect();
    assert_eq!(csv.lines().count(), rows.len() + 1);
    for (line, row) in csv.lines().skip(1).zip(&rows) {
        assert!(line.starts_with(&format!(
            "{},{},",
            row["operation"].as_str().unwrap(),
            row["format"].as_str().unwrap()
        )));
    }
    assert_twins(rows[0], 2);
    assert_eq!((&rows[0]["failed"], &rows[0]["cause"]), (&17.into(), &"nats".into()));
}
