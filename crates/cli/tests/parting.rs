//! `meaninfo trajectory`: where a trajectory parts from the best one.

mod common;

use common::*;
use std::fs;

const LOG: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/room.log");
const TRUE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/room.true.tum");
const ODOMETRY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/room.odometry.tum");

/// What is said of the other trajectory beside the true one, in cells so large that a debug build is quick.
fn said(other: &str) -> String {
    let text = stdout(&["trajectory", LOG, TRUE, other, "--resolution", "0.2"]);
    text.lines().find(|line| line.contains("moves differently")).unwrap().to_owned()
}

#[test]
fn a_jump_is_found_where_it_is() {
    let text = fs::read_to_string(TRUE).unwrap();
    let lines: Vec<_> = text.lines().filter(|line| !line.starts_with('#')).collect();
    let numbers = |line: &str| line.split(' ').map(|field| field.parse().unwrap()).collect::<Vec<f64>>();
    let moved = (0..).zip(&lines).map(|(k, line)| {
        let mut numbers = numbers(line);
        // From the hundredth pose on.
        numbers[1] += if k < 100 { 0.0 } else { 0.3 };
        numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ") + "\n"
    });
    let folder = Folder::new();
    let jump = folder.text_path("jump.tum");
    fs::write(&jump, moved.collect::<Vec<_>>().concat()).unwrap();
    let line = said(&jump);
    let after = |words: &str| {
        let (_, rest) = line.rsplit_once(words).unwrap();
        rest.split(' ').next().unwrap().parse::<f64>().unwrap()
    };
    let since = |k: usize| numbers(lines[k])[0] - numbers(lines[0])[0];
    // Printed with one decimal.
    assert!(after("most from ") - 0.05 <= since(99) && since(100) <= after(" to ") + 0.05, "{line}");
    assert!(line.ends_with("by 0.30 m and 0.0 degrees, 100 % of all"), "{line}");
}

#[test]
fn a_drift_is_everywhere() {
    assert!(
        said(ODOMETRY).contains("from room.true.tum all along the log: of its 20 parts none has more than ")
    );
}
