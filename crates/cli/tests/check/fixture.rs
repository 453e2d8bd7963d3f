//! What the tests share: a few vectors, and runs of `meaninfo check`.

use crate::common::schema::assert_schema;
use crate::common::{Folder, meaninfo, read, text};
use mean_information::Real;
use mean_information::cell::information;
use mean_information_report::hex_float;
use serde_json::{Value, json};
use std::fs;
use std::time::Duration;

/// The first argument that makes this program a port.
pub(crate) const AS_PORT: &str = "as-port";

/// Nothing here takes so long unless it hangs.
const HANGS: Duration = Duration::from_secs(120);

/// Tests of each format.
pub(crate) const TESTS: usize = 20;

/// A folder with a few vectors of `cell.information` and of `map.observed`, with traps.
pub(crate) struct Vectors {
    pub(crate) folder: Folder,
}

impl Vectors {
    pub(crate) fn new() -> Self {
        let folder = Folder::new();
        let original = concat!(env!("CARGO_MANIFEST_DIR"), "/../../vectors/v1/cell.information.json");
        let original: Value = serde_json::from_slice(&read(original)).unwrap();
        let mut tests = chosen::<f64>(&original);
        tests.extend(chosen::<f32>(&original));
        for (index, test) in tests.iter_mut().enumerate() {
            // Answered or not, a test is found again by its place.
            test["id"] = format!("test-{}", index + 1).into();
            test["flags"] = json!([test["flags"][0]]);
        }
        let file = json!({
            "op": "cell.information", "version": 1, "tolerance_ulp": 0.5,
            "flags": {"Random": "All magnitudes.", "Domain": "Outside the domain.", "Limit": "The result is exact."},
            "traps": {"nats": "computes nats: natural logarithms in place of log2"},
            "tests": tests,
        });
        fs::write(folder.path("cell.information.json"), file.to_string()).unwrap();
        let observed = |index: u32| {
            let cells = ["0x1p-1", "0x1p-2", "0x1p+0", "nan"];
            let (cells, want) = match index {
                3 => (&cells[..], json!({"error": "domain"})),
                _ => (&cells[..index as usize], json!({"count": index.saturating_sub(1)})),
            };
            let (id, traps) = (format!("observed-{index}"), json!({"all": index}));
            json!({"id": id, "format": "f64", "args": {"cells": cells}, "want": want, "flags": [], "traps": traps})
        };
        let tests = [0, 1, 2, 3].map(observed);
        let file = json!({
            "op": "map.observed", "version": 1, "tolerance_ulp": 0, "flags": {},
            "traps": {"all": "counts unknown cells"},
            "tests": tests,
        });
        fs::write(folder.path("map.observed.json"), file.to_string()).unwrap();
        Self { folder }
    }

    /// Status and standard output of a check of the port with this fault.
    pub(crate) fn check(&self, fault: &str, options: &[&str]) -> (i32, String) {
        let output = self.run(fault, options);
        assert_eq!(text(&output.stderr), "");
        let Some(status @ (0 | 1)) = output.status.code() else { panic!("{:?}", output.status) };
        (status, text(&output.stdout).to_owned())
    }

    /// The verdict of a port that fails, as a table, which ends with these numbers.
    pub(crate) fn table(&self, fault: &str, options: &[&str], last: &str) -> String {
        let (status, table) = self.check(fault, options);
        assert_eq!((status, table.lines().last()), (1, Some(last)), "{table}");
        table
    }

    /// The verdict as JSON, which is as its schema says.
    pub(crate) fn json(&self, fault: &str, options: &[&str]) -> Value {
        let (_, json) = self.check(fault, &[&["--format", "json"], options].concat());
        assert_schema("check", &json);
        serde_json::from_str(&json).unwrap()
    }

    /// The one line that says why a port is not checked at all.
    pub(crate) fn refusal(&self, fault: &str, options: &[&str]) -> String {
        let output = self.run(fault, options);
        let line = text(&output.stderr);
        assert_eq!((output.status.code(), text(&output.stdout)), (Some(2), ""), "{line}");
        assert!(line.starts_with("meaninfo: ") && line.lines().count() == 1, "{line}");
        line.to_owned()
    }

    fn run(&self, fault: &str, options: &[&str]) -> std::process::Output {
        let mut command = meaninfo();
        command.args(["check", "--vectors"]).arg(self.folder.path("")).args(options).arg("--");
        command.arg(std::env::current_exe().unwrap()).args([AS_PORT, fault]);
        command.timeout(HANGS).output().unwrap()
    }
}

/// The first tests of a format with a number that is not 0 or 1, and some outside the domain; what nats give is added.
fn chosen<T: Real>(original: &Value) -> Vec<Value> {
    let tests = original["tests"].as_array().unwrap().iter().filter(|test| test["format"] == T::FORMAT);
    let (numbers, refused): (Vec<_>, Vec<_>) =
        tests.cloned().partition(|test| test["want"]["error"].is_null());
    let random = numbers.into_iter().filter(|test| test["flags"][0] == "Random").step_by(7);
    let mut chosen: Vec<Value> = random.take(TESTS - 3).collect();
    for test in &mut chosen {
        let p: T = hex_float::parse(test["args"]["p"].as_str().unwrap()).unwrap();
        let nats = information(p).widen() * std::f64::consts::LN_2;
        test["traps"] = json!({"nats": hex_float::format(nats)});
    }
    chosen.extend(refused.into_iter().take(3).map(|mut test| {
        test["traps"] = json!({});
        test
    }));
    assert_eq!(chosen.len(), TESTS);
    chosen
}
