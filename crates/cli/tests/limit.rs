//! `meaninfo limit`: all methods against figures that Arb and mpmath agree on.

#![allow(clippy::excessive_precision, reason = "the figures as they are known")]

mod common;

use common::schema::assert_order;
use common::*;
use mean_information_report::hex_float;
use serde_json::Value;

/// Range, sigma, and the limits by both weights, to 17 digits or more.
const ROOMS: [(&str, &str, f64, f64); 4] = [
    ("2", "0.2", 0.789336888025651415375532, 0.652510952972735116210078),
    ("0.5", "0.01", 0.9539900909772407662459021, 0.9115022751375474249202863),
    ("1", "0.5", 0.3582504275738119200891748, 0.4032484509422955030736491),
    ("10", "0.01", 0.99764810117009788559, 0.99530540546612908615),
];

fn limit(arguments: &[&str]) -> Value {
    let text = stdout(&[&["limit", "--format", "json"], arguments].concat());
    assert_order(&text, 2, "limit", "");
    serde_json::from_str(&text).unwrap()
}

#[test]
fn every_method_and_float_encloses_the_known_figures() {
    for (range, sigma, radial, area) in ROOMS {
        for (weight, known) in [("radial", radial), ("area", area)] {
            for method in ["closed-form", "adaptive", "rigorous"] {
                for (float, ulp) in [("f64", f64::EPSILON), ("f32", f64::from(f32::EPSILON))] {
                    // 0.2 and 0.01 as f32 are other numbers; the limits follow them by at most their relative change.
                    let arguments = [
                        "--range", range, "--sigma", sigma, "--weight", weight, "--method", method,
                        "--float", float,
                    ];
                    let json = limit(&arguments);
                    let [value, lower, upper] =
                        ["value", "lower", "upper"].map(|key| json[key].as_f64().unwrap());
                    assert!(lower <= value && value <= upper, "{json}");
                    assert!(lower - ulp <= known && known <= upper + ulp, "{json}, not {known}");
                    assert_eq!(json["kind"], if method == "adaptive" { "estimated" } else { "rigorous" });
                    assert_eq!((&json["status"], &json["float"]), (&"converged".into(), &float.into()));
                    assert_eq!(json["evaluations"] == 0, method == "closed-form");
                    let width = if method == "adaptive" { 1e-4 } else { 8.0 * ulp };
                    assert!(upper - lower <= width, "{json}");
                    if float == "f64" {
                        assert_twins(&json, 3);
                    } else {
                        let hex = hex_float::parse::<f32>(json["value_hex"].as_str().unwrap());
                        assert_eq!(hex, Ok(value as f32));
                    }
                }
            }
        }
    }
}

#[test]
fn a_hexadecimal_range_is_that_float() {
    let decimal = limit(&["--range", "0.1", "--sigma", "0.03", "--float", "f32"]);
    let exact = limit(&["--range", "0x1.99999ap-4", "--sigma", "0x1.eb851ep-6", "--float", "f32"]);
    assert_eq!(decimal, exact);
}

#[test]
fn more_scans_tell_more_and_both_integrals_agree() {
    let mut before = 0.0;
    for scans in ["1", "2", "5", "1000"] {
        let arguments = ["--range", "2", "--sigma", "0.2", "--weight", "area", "--scans", scans, "--method"];
        let adaptive = limit(&[&arguments[..], &["adaptive"]].concat());
        let rigorous = limit(&[&arguments[..], &["rigorous"]].concat());
        let number = |json: &Value, key: &str| json[key].as_f64().unwrap();
        assert!(number(&adaptive, "lower") <= number(&rigorous, "upper"), "{adaptive} {rigorous}");
        assert!(number(&rigorous, "lower") <= number(&adaptive, "upper"), "{adaptive} {rigorous}");
        assert!(number(&rigorous, "upper") - number(&rigorous, "lower") < 1e-14, "{rigorous}");
        assert!(number(&rigorous, "lower") > before);
        before = number(&rigorous, "upper");
    }
}

#[test]
fn what_did_not_converge_ends_with_status_1() {
    let arguments = ["limit", "--range", "2", "--sigma", "0.2", "--method", "rigorous", "--evaluations", "5"];
    let output = meaninfo().args(arguments).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stdout).contains("evaluation-limit"), "{}", text(&output.stdout));
}

#[test]
fn the_table_says_which_grids_and_how() {
    let table = stdout(&["limit", "--range", "2", "--sigma", "0.2"]);
    assert!(
        table.contains("0.7893368880256514") && table.contains("polar") && table.contains("closed-form"),
        "{table}"
    );
    let table = stdout(&["limit", "--range", "2", "--sigma", "0.2", "--weight", "area"]);
    assert!(table.contains("0.6525109529727351") && table.contains("Cartesian"), "{table}");
}

#[test]
fn what_cannot_be_is_refused() {
    for (arguments, what) in [
        (&["--sigma", "0.2"][..], "--range"),
        (&["--range", "2", "--sigma", "0"], "positive"),
        (&["--range", "inf", "--sigma", "0.2"], "positive"),
        (&["--range", "2m", "--sigma", "0.2"], "not a number"),
        (&["--range", "0x1.0000001p+0", "--sigma", "0.2", "--float", "f32"], "--range"),
        (&["--range", "1e-60", "--sigma", "0.2", "--float", "f32"], "positive"),
        (&["--range", "2", "--sigma", "0.2", "--weight", "mass"], "radial, area"),
        (&["--range", "2", "--sigma", "0.2", "--scans", "0"], "0"),
        (&["--range", "2", "--sigma", "0.2", "--scans", "3"], "--method adaptive"),
        (&["--range", "2", "--sigma", "0.2", "--tolerance", "1e-9"], "--tolerance"),
        (&["--range", "2", "--sigma", "0.2", "--evaluations", "100000"], "--evaluations"),
        (&["--range", "2", "--sigma", "0.2", "--method", "adaptive", "--tolerance", "1e-30"], "tolerance"),
        (&["--range", "2", "--sigma", "0.2", "--method", "rigorous", "--tolerance", "1e-30"], "tolerance"),
        (
            &["--range", "2", "--sigma", "0.2", "--method", "adaptive", "--evaluations", "0"],
            "evaluation limit",
        ),
        (
            &["--range", "2", "--sigma", "0.2", "--method", "rigorous", "--evaluations", "0"],
            "evaluation limit",
        ),
    ] {
        let line = refusal(&[&["limit"], arguments].concat());
        assert!(line.contains(what), "{arguments:?}: {line}");
    }
}
