//! `meaninfo simulate`: the files it writes, read back; relations between runs; bad input.

mod common;

use approx::assert_abs_diff_eq;
use common::schema::assert_order;
use common::*;
use mean_information::room::CartesianRoom;
use mean_information::sensor::GaussianSensor;
use mean_information_files::scans::{RangeScan, Reading, ScanOptions};
use mean_information_files::{read_scans, read_trajectory};
use serde_json::Value;
use std::fs;

/// A small map, quickly made.
const SMALL: [&str; 9] =
    ["simulate", "--poses", "3", "--beams", "240", "--resolution", "0.1", "--format", "json"];

fn simulate(prefix: &str, more: &[&str]) -> Value {
    let arguments: Vec<_> = SMALL.iter().chain(&["--out", prefix]).chain(more).copied().collect();
    serde_json::from_str(&stdout(&arguments)).unwrap()
}

fn measured(arguments: &[&str]) -> Value {
    let arguments: Vec<_> = ["map", "--format", "json"].iter().chain(arguments).copied().collect();
    serde_json::from_str::<Value>(&stdout(&arguments)).unwrap()[0].clone()
}

/// The cells of an array of this project's own making, row 0 the lowest.
fn cells(file: &str) -> Vec<f64> {
    read(file)[128..].as_chunks().0.iter().map(|&bytes| f64::from_le_bytes(bytes)).collect()
}

#[test]
fn the_result_says_what_was_made() {
    let folder = Folder::new();
    let prefix = folder.text_path("map");
    let arguments: Vec<_> = SMALL.iter().chain(&["--out", &*prefix, "--seed", "5"]).copied().collect();
    let text = stdout(&arguments);
    assert_order(&text, 2, "simulate", "");
    let json: Value = serde_json::from_str(&text).unwrap();
    assert_twins(&json, 5);
    assert_eq!((&json["room"], &json["seed"], &json["noise_m"]), (&"study".into(), &5.into(), &0.05.into()));
    assert_eq!(json["poses"].as_array().unwrap().len(), 3);
    let written =
        ["log", "npy", "odometry.tum", "pgm", "true.tum", "yaml"].map(|ending| format!("map.{ending}"));
    assert_eq!(folder.names(), written);
    let csv = stdout(&[&arguments[..8], &["csv", "--out", &prefix]].concat());
    assert_eq!(csv.lines().count(), 2);
    let table = stdout(&["simulate", "--poses", "1", "--out", &prefix]);
    assert!(table.contains("mean information") && table.contains("from the image"), "{table}");
}

/// The array to the last bit; the image as the report says, which is what an independent quantisation of the array gives.
#[test]
fn what_is_written_is_read_back() {
    let folder = Folder::new();
    for (room, seed) in [("study", "3"), ("corridors", "8"), ("circle", "21")] {
        let prefix = folder.text_path(room);
        let made = simulate(&prefix, &["--room", room, "--seed", seed]);
        let of_array = measured(&[&format!("{prefix}.npy"), "--resolution", "0.1"]);
        let of_image = measured(&[&format!("{prefix}.yaml")]);
        for key in [
            "width",
            "height",
            "resolution_m",
            "observed",
            "unknown",
            "free",
            "occupied",
            "observed_area_m2_hex",
        ] {
            assert_eq!((&made[key], &made[key]), (&of_array[key], &of_image[key]), "{room} {key}");
        }
        for key in ["mean_information_hex", "information_bits_hex", "entropy_bits_hex"] {
            assert_eq!(made[key], of_array[key], "{room} {key}");
        }
        assert_eq!(made["mean_information_of_image_hex"], of_image["mean_information_hex"]);

        // The nearest grey, one that keeps the state of the cell, and nav2's percent.
        let occupancies = cells(&format!("{prefix}.npy"));
        let observed: Vec<f64> = occupancies.into_iter().filter(|&p| p != 0.5).collect();
        let grey = |p: f64| {
            let level = (255.0 - 255.0 * p).round();
            if p < 0.5 { level.max(129.0) } else { level.min(124.0) }
        };
        let percent = |p: f64| (100.0 * (1.0 - grey(p) / 255.0)).round() / 100.0;
        let count = observed.len() as f64;
        let mean = observed.iter().map(|&p| 1.0 - entropy(percent(p))).sum::<f64>() / count;
        assert_near(&of_image["mean_information"], mean);

        // Entropies differ by at most the entropy of the difference: 7/510 here, and half a percent more by nav2.
        let quantisation = made["quantisation"].as_f64().unwrap();
        assert_near(&made["quantisation"], 7.0 / 510.0);
        let exact = made["mean_information"].as_f64().unwrap();
        assert!((mean - exact).abs() <= entropy(quantisation + 0.005), "{mean} {exact}");
        let grey_levels = measured(&[&format!("{prefix}.yaml"), "--mode", "probability", "--unknown", "127"]);
        let of_greys = grey_levels["mean_information"].as_f64().unwrap();
        assert!((of_greys - exact).abs() <= entropy(quantisation), "{of_greys} {exact}");
        assert_eq!(grey_levels["observed"], made["observed"]);
    }
}

#[test]
fn a_seed_makes_the_same_bytes_and_another_one_others() {
    let folder = Folder::new();
    let make = |name: &str, more: &[&str]| {
        let prefix = folder.text_path(name);
        let json = simulate(&prefix, more);
        let endings = [".pgm", ".npy", ".log", ".true.tum", ".odometry.tum"];
        (json, endings.map(|ending| read(prefix.clone() + ending)))
    };
    let (json, files) = make("a", &["--seed", "6", "--drift", "0.02"]);
    let (again, same) = make("a", &["--seed", "6", "--drift", "0.02"]);
    assert!(json == again && files == same);
    let (_, others) = make("b", &["--seed", "7", "--drift", "0.02"]);
    // Where the robot was is the same, below the comment.
    let poses = |file: &[u8]| text(file).lines().skip(1).map(str::to_owned).collect::<Vec<_>>();
    assert!((0..5).all(|k| files[k] != others[k]) && poses(&files[3]) == poses(&others[3]));
    // Without noise nothing is random but the drift.
    let [seventh, sixth] = ["7", "6"].map(|seed| make("b", &["--seed", seed, "--noise", "0"]).1);
    assert!(seventh[..2] == sixth[..2] && seventh[4] != sixth[4]);
}

/// The log, read by the readers that everyone's logs are read by: as many scans and beams as were asked for, the poses of
/// the two files, and what was lost or did not return.
#[test]
fn what_was_recorded_is_read_back() {
    let folder = Folder::new();
    let prefix = folder.text_path("map");
    let json =
        simulate(&prefix, &["--scans", "23", "--scan-beams", "45", "--seed", "4", "--range-max", "3.5"]);
    let log = read_scans(&folder.path("map.log"), &ScanOptions::default()).unwrap();
    assert_eq!((log.scans.len(), &log.warnings, log.mount), (23, &vec![], None));
    for (name, held) in ["true", "odometry"].iter().zip(&log.trajectories) {
        let file = folder.text_path(&format!("map.{name}.tum"));
        assert_eq!(json[format!("{name}_trajectory")], file);
        let (trajectory, warnings) = read_trajectory(file.as_ref()).unwrap();
        assert_eq!((trajectory.times(), warnings), (held.trajectory.times(), vec![]));
        for (own, other) in held.trajectory.poses().iter().zip(trajectory.poses()) {
            assert_eq!(own.position(), other.position());
            assert_abs_diff_eq!(own.theta(), other.theta(), epsilon = 1e-14);
        }
    }
    let readings: Vec<_> = log.scans.iter().flat_map(RangeScan::readings).collect();
    assert_eq!(readings.len(), 23 * 45);
    assert!(!readings.contains(&Reading::Invalid) && readings.contains(&Reading::NoReturn));
}

/// The robot goes where it goes, whatever it believes, and begins where it believes to be.
#[test]
fn drift_moves_the_believed_poses_only() {
    let folder = Folder::new();
    let poses = |drift: &str| simulate(&folder.text_path("map"), &["--drift", drift])["poses"].clone();
    let (known, believed) = (poses("0"), poses("0.05"));
    for (k, (a, b)) in known.as_array().unwrap().iter().zip(believed.as_array().unwrap()).enumerate() {
        for key in ["x_m", "y_m", "theta_rad"] {
            let guess = format!("believed_{key}");
            assert_eq!((&a[key], &a[key]), (&b[key], &a[&guess]));
            assert_eq!(a[&guess] == b[&guess], k == 0, "{k} {key}");
        }
    }
}

/// A loop that does not close: more cells, less information each.
#[test]
fn drift_lowers_the_mean_information() {
    let folder = Folder::new();
    let corridors = |seed: &str, drift: &str| {
        let more = ["--room", "corridors", "--poses", "30", "--seed", seed, "--drift", drift];
        // The last one counts.
        let arguments: Vec<_> = ["simulate", "--beams", "240", "--resolution", "0.1", "--format", "json"]
            .iter()
            .chain(&["--out", &folder.text_path("map")])
            .chain(&more)
            .map(|&argument| argument.to_owned())
            .collect();
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let json: Value = serde_json::from_str(&stdout(&arguments)).unwrap();
        (json["mean_information"].as_f64().unwrap(), json["observed"].as_u64().unwrap())
    };
    for seed in ["11", "12", "13"] {
        let (known, drifted) = (corridors(seed, "0"), corridors(seed, "0.03"));
        assert!(drifted.0 < known.0 && drifted.1 > known.1, "{seed}: {drifted:?} {known:?}");
    }
}

/// Without noise, and with so many beams that each cell is crossed near its centre, the scan of the circle observes the
/// cells of the report's Cartesian grid: with the robot in the corner of four cells, offsets of half a cell.
#[test]
fn the_circle_is_the_room_of_the_report() {
    let folder = Folder::new();
    for (resolution, sigma) in [("0.05", "0.2"), ("0.08", "0.1")] {
        let json = stdout(&[
            "simulate",
            "--room",
            "circle",
            "--noise",
            "0",
            "--beams",
            "4000",
            "--sigma",
            sigma,
            "--resolution",
            resolution,
            "--out",
            &folder.text_path("circle"),
            "--format",
            "json",
        ]);
        let json: Value = serde_json::from_str(&json).unwrap();
        let sensor = GaussianSensor::new(2.0, sigma.parse().unwrap()).unwrap();
        let room = CartesianRoom::new(sensor, resolution.parse().unwrap(), [0.5, 0.5]).unwrap();
        let tally = room.tally().unwrap();
        let count = |key: &str| json[key].as_u64().unwrap();
        assert_eq!((count("free"), count("occupied")), (tally.free(), tally.occupied()), "{resolution}");
    }
}

#[test]
fn bad_requests_are_refused_and_nothing_is_written() {
    let folder = Folder::new();
    let prefix = folder.text_path("map");
    for (more, what) in [
        (&["--resolution", "0"][..], "positive"),
        (&["--resolution", "nan"], "positive"),
        (&["--range-max", "inf"], "positive"),
        (&["--range-max", "-2"], "-2"),
        (&["--sigma", "0"], "positive"),
        (&["--noise=-0.1"], "0 or a positive"),
        (&["--drift", "nan"], "0 or a positive"),
        (&["--drift", "inf"], "0 or a positive"),
        (&["--drift", "1e300"], "within 2^33 cells"),
        (&["--beams", "0"], "1..=65536"),
        (&["--poses", "0"], "1..=65536"),
        (&["--poses", "65537"], "1..=65536"),
        (&["--scans", "0"], "1..=65536"),
        (&["--scan-beams", "65537"], "1..=65536"),
        (&["--scans", "60000", "--scan-beams", "60000"], "fewer --scans"),
        (&["--odometry-drift", "nan"], "0 or a positive"),
        (&["--odometry-drift", "1e308"], "a smaller --odometry-drift"),
        (&["--seed", "-1"], "-1"),
        (&["--seed", "1.5"], "1.5"),
        (&["--room", "cellar"], "study, corridors, circle"),
        (&["--max-cells", "100"], "allowed are 100"),
        (&["--resolution", "1e-5"], "readings of cells"),
        (&["--resolution", "0.0001", "--beams", "100"], "raise --max-cells"),
        (&["--resolution", "1e-200"], "readings of cells"),
        (&["--range-max", "1e300"], "readings of cells"),
        (&["--poses", "60000", "--beams", "60000"], "fewer beams or poses"),
        (&["--noise", "1e300", "--range-max", "20", "--beams", "1", "--seed", "2"], "number of beams is 0"),
    ] {
        let arguments: Vec<_> = ["simulate", "--out", &prefix].iter().chain(more).copied().collect();
        let line = refusal(&arguments);
        assert!(line.contains(what), "{more:?}: {line}");
    }
    assert!(refusal(&["simulate"]).contains("--out"));
    assert_eq!(folder.names(), [""; 0]);
}

#[test]
fn all_files_or_none() {
    let folder = Folder::new();
    let refused = |more: &[&str]| {
        refusal(&["simulate", "--poses", "1"].iter().chain(more).copied().collect::<Vec<_>>())
    };
    let prefix = folder.text_path("map");
    let line = refused(&["--out", &folder.text_path("no/such/map")]);
    assert!(line.contains("map.yaml: its folder cannot be written to"), "{line}");
    for place in ["folder/", "folder/.", "..", "/", ""] {
        let line = refused(&["--out", &(folder.text_path("") + place)]);
        assert!(line.contains("names a folder"), "{place} {line}");
    }
    let line = refused(&["--out", &prefix, "--output", &(prefix.clone() + ".pgm")]);
    assert!(line.contains("written twice"), "{line}");
    let line = refused(&["--out", &folder.text_path("a\nb")]);
    assert!(line.contains("control characters"), "{line}");
    assert_eq!(folder.names(), [""; 0]);

    fs::create_dir(folder.path("map.npy")).unwrap();
    let line = refused(&["--out", &prefix]);
    assert!(line.contains("map.npy: is not a regular file"), "{line}");
    assert_eq!(folder.names(), ["map.npy"]);
    fs::remove_dir(folder.path("map.npy")).unwrap();

    // With all of it right, a name that yaml must quote.
    let prefix = folder.text_path("it's # a map: 2");
    stdout(&["simulate", "--poses", "1", "--out", &prefix, "--output", &folder.text_path("result")]);
    assert_eq!(folder.names().len(), 7);
    assert_eq!(measured(&[&(prefix + ".yaml")])["meaningful"], true);
}
