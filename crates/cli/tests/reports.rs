//! Cases made from public reports, where the folder with them is present: counts by the field's own libraries, exit statuses
//! and words of refusals.

mod common;

use common::{assert_near, meaninfo, text};
use mean_information_test_support::formats::shared_data;
use serde_json::Value;
use std::fs;
use std::path::Path;

/// The cases of a file of the folder.
fn cases(folder: &Path, file: &str) -> Vec<Value> {
    let all: Value = serde_json::from_slice(&fs::read(folder.join(file)).unwrap()).unwrap();
    all["cases"].as_array().unwrap().clone()
}

/// The texts of a list.
fn texts(list: &Value) -> Vec<&str> {
    list.as_array().into_iter().flatten().map(|text| text.as_str().unwrap()).collect()
}

/// Runs a case in the folder: its exit status, the record it prints if it succeeds, and standard error.
fn run(folder: &Path, arguments: &[&str]) -> (i64, Option<Value>, String) {
    let output = meaninfo().current_dir(folder).args(arguments).output().unwrap();
    let printed: Option<Value> = serde_json::from_slice(&output.stdout).ok();
    let status = output.status.code().unwrap().into();
    (status, printed.map(|records| records[0].clone()), text(&output.stderr).to_owned())
}

/// Compares a record with what is expected of it.
fn assert_counts(found: &Value, expected: &Value, what: &str) {
    for key in ["free", "occupied", "unknown", "observed"].into_iter().filter(|key| !expected[*key].is_null())
    {
        assert_eq!(found[key], expected[key], "{what}: {key}");
    }
    assert_near(&found["mean_information"], expected["mean_information"].as_f64().unwrap());
}

#[test]
fn maps_of_reports_give_their_counts_or_their_refusals() {
    let Some(folder) = shared_data().map(|data| data.join("reports")).filter(|folder| folder.is_dir()) else {
        return println!("skipped: no folder of reports");
    };
    for case in cases(&folder, "expected.json") {
        let arguments = texts(&case["args"]);
        let what = format!("{arguments:?}");
        let (status, record, line) = run(&folder, &arguments);
        assert_eq!(status, case["exit"].as_i64().unwrap(), "{what} {line}");
        if let Some(record) = record {
            assert_counts(&record, &case, &what);
            let warnings = record["warnings"].to_string();
            // The words that stand for each kind.
            let words = match case["should_warn_of"].as_str() {
                Some(said) if said.contains("grey levels") => "grey levels",
                Some(said) => said,
                None => "",
            };
            assert!(warnings.contains(words), "{what}: {warnings}");
        } else {
            for word in texts(&case["refusal_mentions"]) {
                assert!(line.to_lowercase().contains(&word.to_lowercase()), "{what}: {line}");
            }
        }
        let humble = &case["nav2_humble_and_jazzy"];
        if !humble.is_null() {
            let arguments: Vec<&str> =
                arguments.iter().map(|&a| if a == "nav2" { "nav2-humble" } else { a }).collect();
            assert_counts(&run(&folder, &arguments).1.unwrap(), humble, &what);
        }
    }
}

#[test]
fn arrays_of_reports_give_their_counts_or_their_refusals() {
    let Some(folder) = shared_data().map(|data| data.join("reports")).filter(|folder| folder.is_dir()) else {
        return println!("skipped: no folder of reports");
    };
    for case in cases(&folder, "arrays.json") {
        let name = case["name"].as_str().unwrap();
        let mut arguments = texts(&case["args"]);
        arguments.extend(["--format", "json"]);
        let (status, record, line) = run(&folder, &arguments);
        assert_eq!(status, case["exit"].as_i64().unwrap(), "{name} {line}");
        for word in texts(&case["stderr_says"]) {
            assert!(line.contains(word), "{name}: {line}");
        }
        if let Some(due) = case["due_says"].as_str() {
            assert!(due.split(" or ").any(|word| line.contains(word)), "{name}: {line}");
        }
        assert!(line.len() <= case["max_stderr"].as_u64().unwrap_or(400) as usize, "{name}: {line}");
        let Some(record) = record else { continue };
        assert_counts(&record, &case, name);
        let says = |words: &str| record["warnings"].to_string().contains(words);
        match name {
            "ros2_zero_one" => assert!(says("no cell above 1: 0 and 1 are read as 0 % and 1 %"), "{record}"),
            "average_in_floats" => {
                assert!(
                    says("760 cells are an ulp or two from 1/2") && record["meaningful"] == false,
                    "{record}"
                );
            }
            _ => {}
        }
    }
}
