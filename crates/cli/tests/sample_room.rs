//! The sample in `maps`, a map, a log and two trajectories, is what `meaninfo simulate` makes, and has what a sample should
//! show.

mod common;

use common::*;
use mean_information::scan::ScanMap;
use mean_information::sensor::SteppedSensor;
use mean_information_files::scans::{NoReturn, ScanOptions};
use mean_information_files::{read_scans, read_trajectory};
use serde_json::Value;
use std::path::Path;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
const MAPS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps");

/// `cargo run --release -- simulate --out maps/room`; the array is not kept.
#[test]
fn the_sample_is_made_again_byte_by_byte() {
    let folder = Folder::new();
    stdout(&["simulate", "--out", &folder.text_path("room")]);
    for file in ["room.yaml", "room.pgm", "room.log", "room.true.tum", "room.odometry.tum"] {
        let [made, kept] = [folder.text_path(file), format!("{MAPS}/{file}")].map(read);
        assert!(made == kept, "maps/{file} is not what `meaninfo simulate --out maps/room` makes");
    }
}

/// Returns the mean information of the map of the sample's scans at the poses of a trajectory.
fn mean_information_by(trajectory: &str) -> f64 {
    let path = |file: &str| Path::new(MAPS).join(file);
    let log = read_scans(&path("room.log"), &ScanOptions::default()).unwrap();
    let (trajectory, _) = read_trajectory(&path(trajectory)).unwrap();
    let found = trajectory.at_times(&log.times(), 0.0).unwrap();
    assert_eq!(found.without_pose, 0);
    let mut map = ScanMap::<f64>::new(0.05).unwrap();
    for (record, pose) in log.scans.iter().zip(found.poses.into_iter().flatten()) {
        let scan = record.scan_from(pose, NoReturn::LeftOut).unwrap().unwrap();
        map.insert(&scan, |range| SteppedSensor::new(range, 0.05, 0.4, 0.7)).unwrap();
    }
    map.tally().mean_information()
}

/// A drift of a few centimetres costs more of the mean information than the noise of the sensor leaves in doubt.
#[test]
fn the_log_tells_the_true_trajectory_from_that_of_the_odometry() {
    let [truth, odometry] = ["room.true.tum", "room.odometry.tum"].map(mean_information_by);
    println!("{truth} {odometry}");
    assert!(truth - odometry > 0.02, "{truth} {odometry}");
    let size: u64 = ["room.log", "room.true.tum", "room.odometry.tum"]
        .map(|file| read(format!("{MAPS}/{file}")).len() as u64)
        .iter()
        .sum();
    assert!(size < 300_000, "{size} bytes");
}

#[test]
fn it_is_a_map_with_free_occupied_and_unknown_cells_under_both_loaders() {
    let yaml = format!("{MAPS}/room.yaml");
    for semantics in ["nav2", "ros1"] {
        let json = stdout(&["map", &yaml, "--format", "json", "--semantics", semantics]);
        let json: Value = serde_json::from_str(&json).unwrap();
        let count = |key: &str| json[0][key].as_u64().unwrap();
        assert!(count("free") > 10_000 && count("occupied") > 1000 && count("unknown") > 5000, "{json}");
        assert_eq!(json[0]["meaningful"], true);
    }
}

/// `cargo run --release -- map maps/room.yaml`, run where the README says.
#[test]
fn the_readme_shows_what_is_printed() {
    let output = meaninfo().current_dir(ROOT).args(["map", "maps/room.yaml"]).output().unwrap();
    let shown = format!("```text\n{}```\n", text(&output.stdout));
    assert!(text(&read(format!("{ROOT}/README.md"))).contains(&shown), "README.md lacks\n{shown}");
}

/// `meaninfo trajectory maps/room.log maps/room.true.tum maps/room.odometry.tum --maps docs/figures/trajectories.svg`, run in
/// the root, draws the picture on top of the README again, byte by byte.
#[test]
fn the_picture_on_top_of_the_readme_is_drawn_again() {
    let folder = Folder::new();
    let picture = folder.text_path("trajectories.svg");
    let files = ["maps/room.log", "maps/room.true.tum", "maps/room.odometry.tum"];
    let run = meaninfo().current_dir(ROOT).arg("trajectory").args(files).args(["--maps", &picture]).output();
    let printed = run.unwrap().stdout;
    let [drawn, shown] = [picture, format!("{ROOT}/docs/figures/trajectories.svg")].map(read);
    assert!(drawn == shown, "docs/figures/trajectories.svg is not what --maps draws");
    let document = roxmltree::Document::parse(text(&shown)).unwrap();
    let texts: Vec<_> = document.descendants().filter_map(|node| node.text()).collect();
    for words in ["room.true.tum", "0.9605 bits per cell", "0.9340 bits per cell: -0.0265 ± 0.0071"] {
        assert!(texts.contains(&words), "{words}: {texts:?}");
    }
    // Its last line is that of the README's beginning.
    let readme = read(format!("{ROOT}/README.md"));
    let last = text(&printed).lines().last().unwrap();
    assert!(text(&readme).contains(&format!("```text\n{last}\n```")), "README.md lacks {last}");
}

/// `cargo run --release -- map maps/room.yaml --heat-map docs/room.png` makes the picture again.
#[test]
fn the_picture_of_the_readme_is_the_heat_map() {
    let folder = Folder::new();
    let picture = folder.text_path("room.png");
    stdout(&["map", &format!("{MAPS}/room.yaml"), "--heat-map", &picture]);
    let [drawn, shown] = [picture, format!("{ROOT}/docs/room.png")].map(|path| Pixels::of_png(&read(path)));
    assert!(drawn == shown, "docs/room.png is not the heat map of maps/room.yaml");
}
