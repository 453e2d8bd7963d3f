//! `meaninfo trajectory` on bags and saved states: the numbers of the logs that they were made of.

mod common;

use common::*;
use mean_information::scan::Pose;
use mean_information_files::scans::{Bearings, RangeScan, ScanOptions, carmen};
use mean_information_files::{read_scans, tum};
use mean_information_test_support::formats::pbstream::{cloud, double, graph, message, node, rigid, state};
use mean_information_test_support::formats::shared_data;
use serde_json::Value;
use std::path::Path;

const MAPS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps");
/// The mount of the laser in the bags, as `make_scans.py` has it.
const MOUNT: &str = "0.25,0.125,0.5";

fn bag(name: &str) -> String {
    format!("{}/../files/tests/bags/{name}", env!("CARGO_MANIFEST_DIR"))
}

fn rows(arguments: &[&str]) -> Vec<Value> {
    let text = stdout(&[&["trajectory"], arguments, &["--resolution", "0.1", "--format", "json"]].concat());
    serde_json::from_str(&text).unwrap()
}

fn written(folder: &Folder, name: &str, bytes: &[u8]) -> String {
    folder.write(name, bytes).to_str().unwrap().to_owned()
}

/// Writes every second scan of the sample's log, as the bags have them: each number in `single` precision, or as it is.
fn log(folder: &Folder, single: bool) -> String {
    log_of(folder, &Path::new(MAPS).join("room.log"), 2, single)
}

/// Writes every scan of so many of a log: each number in `single` precision, or as it is.
fn log_of(folder: &Folder, path: &Path, every: usize, single: bool) -> String {
    let log = read_scans(path, &ScanOptions::default()).unwrap();
    let in_single = |scan: &RangeScan| {
        let rounded = |x: f64| if single { f64::from(x as f32) } else { x };
        let &Bearings::Even { start, increment } = scan.bearings() else { panic!("{scan:?}") };
        let bearings = Bearings::Even { start: rounded(start), increment: rounded(increment) };
        let ranges = scan.ranges().iter().map(|&range| rounded(range)).collect();
        let scan_in_single =
            RangeScan::new(scan.time(), bearings, ranges, scan.limits().map(rounded)).unwrap();
        scan_in_single.with_laser(*scan.laser().unwrap()).with_odometry(*scan.odometry().unwrap())
    };
    let scans: Vec<_> = log.scans.iter().step_by(every).map(in_single).collect();
    let mut text = Vec::new();
    carmen::write(&scans, "", &mut text).unwrap();
    written(folder, "half.log", &text)
}

/// The numbers of a row that do not depend on its name.
fn numbers(row: &Value) -> Value {
    let mut row = row.clone();
    let entries = row.as_object_mut().unwrap();
    for key in ["poses", "scans_without_pose", "warnings"] {
        entries.remove(key);
    }
    row
}

/// Asserts that two rows are of the same cells, and their numbers alike to rounding.
fn assert_alike(found: &Value, expected: &Value) {
    for key in
        ["scans", "scans_used", "beams", "width", "height", "observed", "free", "occupied", "revisited"]
    {
        assert_eq!(found[key], expected[key], "{key}: {found} {expected}");
    }
    for key in ["mean_information", "agreement", "entropy_bits"] {
        let [a, b] = [found, expected].map(|row| row[key].as_f64().unwrap());
        assert!((a - b).abs() <= 1e-12 * a.abs(), "{key}: {a} {b}");
    }
}

/// The log says where the laser was, the bag where the robot was and the laser on it: poses differ by roundings, and the
/// ranges are those in single precision.
#[test]
fn a_bag_of_the_sample_has_the_numbers_of_its_log() {
    let folder = Folder::new();
    let expected = rows(&[&log(&folder, true)]);
    let exact = rows(&[&log(&folder, false)]);
    for name in ["room.mcap", "room.bag"] {
        let found = rows(&[&bag(name)]);
        let names: Vec<_> = found.iter().map(|row| row["poses"].as_str().unwrap()).collect();
        assert_eq!(names, ["map", "odom"], "{name}");
        for index in 0..2 {
            assert_eq!(found[index]["scans"], 75);
            assert_alike(&found[index], &expected[index]);
            // Not of the log itself: 3.776 m is no number of single precision, and a beam may end in the next cell.
            let [a, b] = [&found[index], &exact[index]].map(|row| row["mean_information"].as_f64().unwrap());
            assert!((a - b).abs() < 1e-4, "{name}: {a} {b}");
        }
        let warnings = found[0]["warnings"].to_string();
        assert!(!warnings.contains("time_increment"), "{warnings}");
    }
}

/// The poses of topics and of frames on one mount give the same bits; those of a file beside them are rounded once more.
#[test]
fn topics_frames_and_files_go_together() {
    let path = bag("room.mcap");
    let log = read_scans(&Path::new(MAPS).join("room.log"), &ScanOptions::default()).unwrap();
    let odometry = log.trajectories.into_iter().find(|held| held.name == "odometry").unwrap().trajectory;
    // The robot in the frame of its laser.
    let (sin, cos) = (libm::sin(0.5), libm::cos(0.5));
    let back = Pose::new(-0.25 * cos - 0.125 * sin, 0.25 * sin - 0.125 * cos, -0.5).unwrap();
    let folder = Folder::new();
    let mut text = Vec::new();
    tum::write(&odometry.mounted(&back).unwrap(), "", &mut text).unwrap();
    let file = written(&folder, "odometry.tum", &text);
    let topics = "/odom,/slam_pose,/amcl_pose";
    let found = rows(&[&path, &file, "--frames", "odom,map", "--pose-topics", topics]);
    let names: Vec<_> = found.iter().map(|row| row["poses"].as_str().unwrap()).collect();
    assert_eq!(names, ["odom", "map", "/odom", "/slam_pose", "/amcl_pose", &*file]);
    let bits = |row: &Value| row["mean_information_hex"].clone();
    assert_eq!(bits(&found[2]), bits(&found[0]));
    assert_eq!(bits(&found[4]), bits(&found[3]));
    assert_alike(&found[3], &found[1]);
    assert_alike(&found[5], &found[0]);
    assert!(found[2]["warnings"].to_string().contains("has the very poses of odom"));
    // What is given takes the place of what the bag says.
    assert_alike(&rows(&[&path, "--frames", "odom", "--mount", MOUNT])[0], &found[0]);
    assert_ne!(bits(&rows(&[&path, "--frames", "odom", "--mount", "0,0,0"])[0]), bits(&found[0]));
}

#[test]
fn options_that_a_file_has_no_use_for_and_choices() {
    let path = bag("room.bag");
    let log = format!("{MAPS}/room.log");
    for (arguments, words) in [
        (&[&*log, "--frames", "map"][..], "is no bag or saved state by its name; --frames needs one"),
        (&[&*log, "--topic", "/scan"], "is no bag by its name; --topic needs one"),
        (&[&path, "--time", "logged"], "is no CARMEN log; --time needs one, leave it out"),
        (&[&path, "--trajectory", "0"], "is no saved state by its name; --trajectory needs one"),
        (
            &[&path, "--topic", "/lidar"],
            "has no topic /lidar of type sensor_msgs/LaserScan; topics of its scans are: /scan; --topic names one",
        ),
        (
            &[&path, "--frames", "earth"],
            "TF does not connect base_footprint with earth; the frames over base_footprint are: odom, map; --frames names one",
        ),
        (&[&path, "--base", "laser", "--pose-topics", "/odom,/gps"], "has no topic /gps"),
        (
            &[&path, "--base", "plate"],
            "TF does not connect laser with plate; the frames over laser are: base_link, ",
        ),
        (&[&path, "--base", "plate"], "; --base names one"),
        (
            &[&bag("maps_none.bag")],
            "has no topic of type sensor_msgs/LaserScan; topics of its scans are: none",
        ),
    ] {
        let line = refusal(&[&["trajectory"], arguments].concat());
        assert!(line.contains(words), "{line}");
    }
    let mounted = stdout(&["trajectory", &path]);
    assert!(mounted.contains("0.25, 0.125 m and 0.5 rad on the robot"), "{mounted}");
}

/// Says whether the log of the Intel Research Lab, as a bag that `make_scans.py LOG BAG` made beside it, gives the numbers of
/// the log: to be made where the log is, as public logs are not kept here.
#[test]
fn a_bag_of_a_public_log_has_its_numbers() {
    let Some(data) = shared_data() else { return };
    let Some(made) = std::env::var_os("MEANINFO_INTEL_BAG") else {
        return println!(
            "skipped: MEANINFO_INTEL_BAG names no bag; crates/files/tests/bags/make_scans.py makes it"
        );
    };
    let folder = Folder::new();
    let path = data.join("slam/intel.log");
    let expected = rows(&[&log_of(&folder, &path, 1, true)]);
    let exact = rows(&[path.to_str().unwrap()]);
    let found = rows(&[Path::new(&made).to_str().unwrap(), "--frames", "map,odom"]);
    for ((found, expected), exact) in found.iter().zip(&expected).zip(&exact) {
        println!("{} {} {}", found["poses"], numbers(found), numbers(exact));
        assert_alike(found, expected);
        // Of the log itself: a range that is no number of single precision may end in the next cell.
        let [a, b] = [found, exact].map(|row| row["mean_information"].as_f64().unwrap());
        assert!((a - b).abs() < 1e-5, "{a} {b}");
    }
}

/// A state of two trajectories of three scans each; the second stands a metre to the left in the pose graph.
fn state_of_two(folder: &Folder) -> String {
    let ahead = [0.0, 0.0, 0.0, 1.0];
    // Points on a wall two metres ahead, in blocks of 1.024 m.
    let points = cloud(3, 3, &[3, 1, 0, 0, 976, 976 + (100 << 10), 976 + (200 << 10)]);
    let records = [0, 1].into_iter().flat_map(|trajectory| {
        let aside = trajectory as f64;
        let scans = (0..3).map(move |index| {
            let pose = rigid(7, [0.25 * index as f64, 0.0, 0.0], ahead);
            let upright = message(2, &[&double(4, 1.0)]);
            (index, [pose, upright].concat())
        });
        let poses: Vec<_> = (0..3).map(|index| (index, [0.25 * index as f64, aside, 0.0], ahead)).collect();
        let points = points.clone();
        let nodes = scans.map(move |(index, parts)| {
            node([trajectory, index], 621_355_968_000_000_000 + 10_000_000 * index, &[&parts, &points])
        });
        nodes.chain([graph(trajectory, &poses)]).collect::<Vec<_>>()
    });
    written(folder, "two.pbstream", &state(&records.collect::<Vec<_>>()))
}

#[test]
fn a_state_of_several_trajectories_and_poses_beside_it() {
    let folder = Folder::new();
    let path = state_of_two(&folder);
    let line = refusal(&["trajectory", &path]);
    let words = "has scans of several trajectories; its trajectories are: 0 (3 scans), 1 (3 scans); --trajectory names one";
    assert!(line.contains(words), "{line}");
    let names =
        |rows: &[Value]| rows.iter().map(|row| row["poses"].as_str().unwrap().to_owned()).collect::<Vec<_>>();
    let own = rows(&[&path, "--trajectory", "1"]);
    assert_eq!((names(&own), &own[0]["scans"]), (vec!["local".into(), "global".into()], &3.into()));
    // Poses of a file, alone and beside those of the state that are asked for.
    let file = written(&folder, "poses.tum", b"0 0 0 0 0 0 0 1\n2 0.5 0 0 0 0 0 1\n");
    let alone = rows(&[&path, &file, "--trajectory", "1", "--max-gap", "2"]);
    assert_eq!(names(&alone), [&*file]);
    let beside = rows(&[&path, &file, "--trajectory", "1", "--max-gap", "2", "--frames", "local"]);
    assert_eq!(names(&beside), ["local", &*file]);
    assert_eq!(numbers(&beside[1])["mean_information_hex"], numbers(&beside[0])["mean_information_hex"]);
    for (arguments, words) in [
        (
            &["--frames", "map"][..],
            "whose poses have no frame map; its frames are: local, global; --frames names one",
        ),
        (
            &["--upside-down"],
            "is a saved state, whose points were turned when it was made; leave --upside-down out",
        ),
        (&["--topic", "/scan"], "is no bag by its name; --topic needs one, leave it out"),
    ] {
        let line = refusal(&[&["trajectory", &*path, "--trajectory", "1"], arguments].concat());
        assert!(line.contains(words), "{line}");
    }
}

/// Bearings of a log that turn the wrong way make another map; turned twice they make the same.
#[test]
fn a_laser_that_is_said_to_be_upside_down() {
    let folder = Folder::new();
    let log = read_scans(&Path::new(MAPS).join("room.log"), &ScanOptions::default()).unwrap();
    let turned: Vec<_> = log
        .scans
        .iter()
        .step_by(4)
        .map(|scan| {
            let &Bearings::Even { start, increment } = scan.bearings() else { panic!("{scan:?}") };
            let bearings = Bearings::Even { start: -start, increment: -increment };
            let turned =
                RangeScan::new(scan.time(), bearings, scan.ranges().to_vec(), scan.limits()).unwrap();
            (scan.clone(), turned.with_laser(*scan.laser().unwrap()).with_odometry(*scan.odometry().unwrap()))
        })
        .collect();
    let write = |name: &str, scans: Vec<RangeScan>| {
        let mut text = Vec::new();
        carmen::write(&scans, "", &mut text).unwrap();
        written(&folder, name, &text)
    };
    let (upright, down): (Vec<_>, Vec<_>) = turned.into_iter().unzip();
    let (upright, down) = (write("up.log", upright), write("down.log", down));
    let bits = |arguments: &[&str]| rows(arguments)[0]["mean_information_hex"].clone();
    assert_eq!(bits(&[&down, "--upside-down"]), bits(&[&upright]));
    assert_ne!(bits(&[&down]), bits(&[&upright]));
}

#[test]
fn a_real_state_compares_its_local_poses_with_its_global_ones() {
    let Some(data) = shared_data() else { return };
    let path = data.join("cartographer/JFR_racingv5.pbstream");
    let found = rows(&[path.to_str().unwrap()]);
    let names: Vec<_> = found.iter().map(|row| row["poses"].as_str().unwrap()).collect();
    assert_eq!(names, ["local", "global"]);
    for (row, mean) in found.iter().zip([0.9630, 0.9634]) {
        let found = row["mean_information"].as_f64().unwrap();
        assert_eq!((found * 1e4).round() / 1e4, mean, "{row}");
        assert_eq!((&row["scans_used"], &row["beams"]), (&860.into(), &178_462.into()));
        assert!(row["warnings"][0].as_str().unwrap().contains("thinned out"), "{row}");
    }
}
