//! `meaninfo trajectory`: where the scans of a trajectory contradict one another most, and which of them do.

mod common;

use common::*;
use mean_information::scan::ScanMap;
use mean_information::sensor::SteppedSensor;
use mean_information_files::scans::{NoReturn, ScanOptions};
use mean_information_files::{read_scans, read_trajectory};
use serde_json::Value;
use std::fs;
use std::path::Path;

const LOG: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/room.log");
const TRUE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/room.true.tum");
const ODOMETRY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/room.odometry.tum");

/// Cells so large that a debug build is quick.
const COARSE: [&str; 2] = ["--resolution", "0.2"];

fn number(of: &Value, key: &str) -> f64 {
    of[key].as_f64().unwrap()
}

/// The true trajectory of the sample, moved by 0.4 m in y from this pose on; the time of the pose, in seconds after the first.
fn jump(folder: &Folder, from: usize) -> (String, f64) {
    let text = fs::read_to_string(TRUE).unwrap();
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    let poses: Vec<Vec<f64>> =
        lines.map(|line| line.split(' ').map(|field| field.parse().unwrap()).collect()).collect();
    let moved = poses.iter().enumerate().map(|(k, pose)| {
        let mut pose = pose.clone();
        pose[2] += if k < from { 0.0 } else { 0.4 };
        pose.iter().map(f64::to_string).collect::<Vec<_>>().join(" ") + "\n"
    });
    let path = folder.text_path("jump.tum");
    fs::write(&path, moved.collect::<String>()).unwrap();
    (path, poses[from][0] - poses[0][0])
}

/// There and back: what was seen before a jump contradicts what was seen after it.
#[test]
fn a_jump_is_between_the_two_scans() {
    let folder = Folder::new();
    for from in [60, 90] {
        let (jump, time) = jump(&folder, from);
        let rows = rows(&[&[LOG, &jump], &COARSE[..]].concat());
        let places = rows[0]["contradictions"].as_array().unwrap();
        assert_eq!(places.len(), 3);
        for place in places {
            assert!(number(place, "first_s") < time && time <= number(place, "second_s"), "{time}: {place}");
            assert_twins(place, 5);
        }
        let shares: Vec<_> = places.iter().map(|place| number(place, "share")).collect();
        assert!(shares.is_sorted_by(|a, b| a >= b) && shares[0] < 0.5, "{shares:?}");
    }
}

/// The shares against the layer of contradictions, by the library alone.
#[test]
fn a_place_has_its_share_of_all_contradiction() {
    let log = read_scans(Path::new(LOG), &ScanOptions::default()).unwrap();
    let (trajectory, _) = read_trajectory(Path::new(ODOMETRY)).unwrap();
    let poses = trajectory.at_times(&log.times(), 1.0).unwrap().poses;
    let mut map = ScanMap::<f64>::new(0.2).unwrap().with_agreement().unwrap();
    for (record, pose) in log.scans.iter().zip(poses) {
        let scan = record.scan_from(pose.unwrap(), NoReturn::LeftOut).unwrap().unwrap();
        map.insert(&scan, |range| SteppedSensor::new(range, 0.2, 0.4, 0.7)).unwrap();
    }
    let layer = map.contradictions().unwrap().unwrap();
    let whole: f64 = layer.cells().iter().sum();
    let size = [layer.width(), layer.height()];
    // A place is 2 by 2 tiles; of cells of 0.2 m a tile has 3 by 3.
    let square = |[left, low]: [usize; 2]| -> f64 {
        let columns = left..(left + 6).min(size[0]);
        let rows = low..(low + 6).min(size[1]);
        rows.flat_map(|row| columns.clone().map(move |column| row * size[0] + column))
            .map(|k| layer.cells()[k])
            .sum()
    };
    let corners = (0..layer.width())
        .step_by(3)
        .flat_map(|left| (0..layer.height()).step_by(3).map(move |low| [left, low]));
    let best = corners.max_by(|a, b| square(*a).total_cmp(&square(*b))).unwrap();
    let rows = rows(&[&[LOG, ODOMETRY], &COARSE[..]].concat());
    let place = &rows[0]["contradictions"][0];
    assert!((number(place, "share") - square(best) / whole).abs() < 1e-12, "{place}");
    let origin = layer.geometry().origin();
    for (key, (corner, origin)) in ["x_m", "y_m"].into_iter().zip(best.into_iter().zip(origin)) {
        let from_corner = number(place, key) - origin - 0.2 * corner as f64;
        assert!(from_corner > 0.0 && from_corner < 1.2, "{key} {from_corner}");
    }
}

#[test]
fn of_one_trajectory_they_are_printed() {
    let text = stdout(&[&["trajectory", LOG, ODOMETRY], &COARSE[..]].concat());
    let lines: Vec<_> = text.lines().filter(|line| line.contains("contradict each other at x ")).collect();
    assert_eq!(lines.len(), 3, "{text}");
    assert!(lines[0].contains("room.odometry.tum: scans at ") && lines[0].contains(" s after the first"));
    let has_own = |text: &str| text.contains("a trajectory that is right has its worst places, too");
    assert!(has_own(&text));
    // Of several, where they part is said instead.
    let text = stdout(&[&["trajectory", LOG, TRUE, ODOMETRY], &COARSE[..]].concat());
    assert!(!has_own(&text) && !text.contains("contradict each other") && text.contains("moves differently"));
    let rows = rows(&[&[LOG, TRUE, ODOMETRY], &COARSE[..]].concat());
    assert!(rows.iter().all(|row| row["contradictions"].as_array().unwrap().len() == 3));
    assert_eq!(rows[0]["partings"], Value::Array(Vec::new()));
    let parting = &rows[1]["partings"][0];
    assert_twins(parting, 7);
    assert!(number(parting, "share") < 0.25 && number(parting, "from_s") < number(parting, "to_s"));
    assert_eq!(text.lines().last(), rows[1]["verdict"].as_str());
}
