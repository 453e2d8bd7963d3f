//! `meaninfo trajectory`: its keys, its numbers against the library called directly, its pictures and page, its refusals.

mod common;

use common::schema::assert_order;
use common::*;
use mean_information::scan::{Difference, Pose, ScanMap, TalliedMap, blocks};
use mean_information::sensor::SteppedSensor;
use mean_information::{Error, Tally};
use mean_information_cli::trajectory::{SensorModel, Setup, Wanted, measure, measure_all};
use mean_information_files::scans::{NoReturn, RangeScan, ScanLog, ScanOptions};
use mean_information_files::{read_scans, read_trajectory};
use mean_information_report::hex_float;
use serde_json::Value;
use std::fs;
use std::path::Path;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
const LOG: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/room.log");
const TRUE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/room.true.tum");
const ODOMETRY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/room.odometry.tum");

/// Cells so large that a debug build is quick.
const COARSE: [&str; 2] = ["--resolution", "0.2"];

/// The sample's scans, and their poses by a trajectory.
fn sample(poses: &str) -> (ScanLog, Vec<Pose>) {
    let log = read_scans(Path::new(LOG), &ScanOptions::default()).unwrap();
    let (trajectory, _) = read_trajectory(Path::new(poses)).unwrap();
    let found = trajectory.at_times(&log.times(), 1.0).unwrap();
    (log, found.poses.into_iter().flatten().collect())
}

/// A wall as thick as a cell.
fn model(range: f64) -> Result<SteppedSensor<f64>, Error> {
    SteppedSensor::new(range, 0.2, 0.4, 0.7)
}

/// The map of the sample by a trajectory, and its tallies without each of 20 blocks of scans, by the library alone.
fn built(poses: &str) -> (ScanMap<f64>, Vec<Tally<f64>>) {
    let (log, poses) = sample(poses);
    let scan =
        |(record, pose): (&RangeScan, Pose)| record.scan_from(pose, NoReturn::LeftOut).unwrap().unwrap();
    let scans: Vec<_> = log.scans.iter().zip(poses).map(scan).collect();
    let mut map = ScanMap::new(0.2).unwrap().with_agreement().unwrap();
    scans.iter().try_for_each(|scan| map.insert(scan, model)).unwrap();
    let tallied = TalliedMap::new(map);
    let without = blocks(150, 20).map(|block| tallied.without(&scans[block], model).unwrap()).collect();
    (tallied.into_map(), without)
}

#[test]
fn rows_are_those_of_the_library_called_directly() {
    let text = stdout(&[&["trajectory", LOG, TRUE, ODOMETRY, "--format", "json"], &COARSE[..]].concat());
    assert_order(&text, 4, "trajectory", "/items");
    let rows: Vec<Value> = serde_json::from_str(&text).unwrap();
    let [(truth, without_truth), (odometry, without_odometry)] = [TRUE, ODOMETRY].map(built);
    let maps = [truth, odometry];
    for ((row, map), name) in rows.iter().zip(&maps).zip([TRUE, ODOMETRY]) {
        let tally = map.tally();
        assert_twins(row, 7);
        let hex = |key: &str| hex_float::parse::<f64>(row[key].as_str().unwrap()).unwrap();
        assert_eq!(hex("mean_information_hex"), tally.mean_information());
        assert_eq!(
            (hex("entropy_bits_hex"), hex("information_bits_hex")),
            (tally.entropy(), tally.information())
        );
        assert_eq!(Some(hex("agreement_hex")), map.agreement());
        assert_eq!(
            (row["free"].as_u64(), row["unknown"].as_u64()),
            (Some(tally.free()), Some(tally.unknown()))
        );
        assert_eq!(row["width"].as_u64().unwrap() * row["height"].as_u64().unwrap(), tally.cells());
        assert_eq!(
            (&row["poses"], &row["scans"], &row["scans_used"]),
            (&name.into(), &150.into(), &150.into())
        );
        assert!(row["verdict"].as_str().unwrap().starts_with("room.true.tum makes the most consistent map"));
        assert_eq!(row["sensor"], "stepped: free 0.4, occupied 0.7, walls 0.2 m thick");
        let numbers = ["sensor_free", "sensor_occupied", "thickness_m", "reading_limit_nats", "max_range_m"];
        assert_eq!(numbers.map(|key| row[key].as_f64().unwrap()), [0.4, 0.7, 0.2, 3.5, 4.5]);
        assert_eq!((&row["sigma_m"], &row["no_return"]), (&Value::Null, &"left-out".into()));
        assert_eq!((&row["mount_x_m"], &row["meaningful"]), (&0.0.into(), &true.into()));
    }
    assert_eq!(rows[0]["difference"], Value::Null);
    let without: Vec<_> = without_truth.into_iter().zip(without_odometry).map(<[_; 2]>::from).collect();
    let whole = [maps[0].tally(), maps[1].tally()];
    let difference = Difference::by_jackknife([&whole[0], &whole[1]], &without).unwrap();
    assert_eq!(rows[1]["difference"].as_f64(), Some(difference.value()));
    assert_eq!(rows[1]["standard_error"].as_f64(), Some(difference.standard_error()));
    assert!(difference.value() < 0.0, "{difference:?}");
    let once: u64 = without.iter().map(|[_, odometry]| whole[1].observed() - odometry.observed()).sum();
    assert_eq!(rows[1]["revisited"].as_u64(), Some(whole[1].observed() - once));
}

#[test]
fn the_series_ends_at_the_row_and_threads_change_no_bit() {
    let (log, by_odometry) = sample(ODOMETRY);
    let (_, truth) = sample(TRUE);
    let records: Vec<&RangeScan> = log.scans.iter().collect();
    let sensor = SensorModel::Stepped { free: 0.4, occupied: 0.7, thickness: 0.2 };
    let no_return = NoReturn::LeftOut;
    let setup = Setup { resolution: 0.2, sensor, reading_limit: 3.5, no_return, max_cells: 1 << 20 };
    let wanted = Wanted { series: true, pictures: false };
    let measured = measure(&setup, &records, &truth, wanted, &|| ()).unwrap();
    assert_eq!(measured.series.len(), 150);
    assert_eq!(measured.series[149], measured.tally.mean_information());
    // In between it is the measure of the map so far.
    let so_far = setup.built(&records[..40], &truth[..40]).unwrap();
    assert_eq!(measured.series[39], TalliedMap::new(so_far).tally().mean_information());

    let trajectories = [truth.clone(), by_odometry.clone(), truth];
    let by = |threads| {
        let all = measure_all(&setup, &records, &trajectories, Wanted::default(), threads, &|| ()).unwrap();
        all.into_iter().map(|own| (own.tally, own.agreement, own.without, own.size)).collect::<Vec<_>>()
    };
    let alone = by(1);
    assert_eq!((alone[0].0.clone(), alone[0].2.clone()), (measured.tally, measured.without));
    assert!(alone == by(2) && alone == by(5));
    assert_eq!(alone[0], alone[2]);
    let print = |threads: &str| {
        stdout(
            &[&["trajectory", LOG, TRUE, ODOMETRY, "--threads", threads, "--format", "csv"], &COARSE[..]]
                .concat(),
        )
    };
    assert_eq!(print("1"), print("3"));
}

/// Every picture and the page, twice.
#[test]
fn the_page_needs_no_other_file_and_the_pictures_are_the_same_again() {
    let folder = Folder::new();
    let run = |k: usize| {
        let names =
            ["series.svg", "heat.png", "conflicts.png"].map(|name| folder.text_path(&format!("{k}{name}")));
        let out = folder.text_path(&format!("{k}page"));
        let drawn = ["--series", &names[0], "--heat-map", &names[1], "--conflicts", &names[2], "--out", &out];
        stdout(&[&["trajectory", LOG, TRUE, ODOMETRY], &COARSE[..], &drawn].concat());
        names.into_iter().chain([format!("{out}/index.html")]).map(read).collect::<Vec<_>>()
    };
    let files = run(0);
    assert!(files == run(1));
    let series = folder.text_path("series.png");
    stdout(&["trajectory", LOG, TRUE, "--resolution", "0.5", "--series", &series]);
    // Of one trajectory there is nothing to compare with: one panel.
    let series = Pixels::of_png(&read(&series));
    assert_eq!((series.width, series.height), (640, 386));
    let alone = folder.text_path("alone");
    stdout(&["trajectory", LOG, TRUE, "--resolution", "0.5", "--out", &alone]);
    let alone = read(format!("{alone}/index.html"));
    for words in ["Which trajectory is right?", "where a curve leaves the first", "Trajectories compared"] {
        assert_eq!((text(&files[3]).contains(words), text(&alone).contains(words)), (true, false), "{words}");
    }
    let svg = roxmltree::Document::parse(text(&files[0])).unwrap();
    for label in ["room.true.tum", "room.odometry.tum", "time since the first scan (s)"] {
        assert!(
            svg.descendants().any(|node| node.text().is_some_and(|text| text.trim() == label)),
            "{label}"
        );
    }
    let page = text(&files[3]);
    let document = roxmltree::Document::parse(page.trim_start_matches("<!DOCTYPE html>\n")).unwrap();
    for attribute in document.descendants().flat_map(|node| node.attributes()) {
        let local = ["data:", "https://docs.rs/mean-information/"]
            .iter()
            .any(|start| attribute.value().starts_with(start));
        assert!(!["href", "src"].contains(&attribute.name()) || local, "{attribute:?}");
    }
    let nodes = |tag: &'static str| document.descendants().filter(move |node| node.has_tag_name(tag));
    assert_eq!((nodes("script").count(), nodes("link").count()), (0, 0));
    // A link to the chapter, and nothing that a browser would load.
    assert_eq!((page.matches("http").count(), nodes("a").count(), nodes("math").count()), (1, 1, 2));
    assert!(!page.contains("url("));
    assert!(page.contains("prefers-color-scheme: dark") && page.contains("width=device-width"));
    assert_eq!((nodes("tr").count(), nodes("image").count(), nodes("polyline").count() >= 2), (3, 4, true));
    assert!(page.contains("room.true.tum makes the most consistent map"), "{page}");
    // All maps on one scale: bars of one length.
    let bars = nodes("path").filter_map(|node| node.attribute("d")?.split_once('h')?.1.split_once('m'));
    let bars: Vec<_> = bars.map(|(length, _)| length).collect();
    assert!(bars.len() == 4 && bars.iter().all(|bar| *bar == bars[0]), "{bars:?}");
}

/// A copy of the sample's log of which each line goes through `change`.
fn changed(folder: &Folder, name: &str, change: impl Fn(usize, &str) -> Option<String>) -> String {
    let log = fs::read_to_string(LOG).unwrap();
    let lines: Vec<_> = log.lines().enumerate().filter_map(|(k, line)| change(k, line)).collect();
    fs::write(folder.path(name), lines.join("\n") + "\n").unwrap();
    folder.text_path(name)
}

fn written(folder: &Folder, name: &str, text: &str) -> String {
    fs::write(folder.path(name), text).unwrap();
    folder.text_path(name)
}

/// Each in one line that says what to do; nothing is written.
#[test]
fn bad_input_is_refused() {
    let folder = Folder::new();
    let message = |beams: &str, time: &str| {
        format!("ROBOTLASER1 0 -0.5 1.0 0.5 20 0.01 0 {beams} 0 0 0 0 0 0 0 0 0 0 0 0 {time} robot {time}\n")
    };
    let refused = |log: &str, poses: &[&str], what: &[&str]| {
        let out = folder.text_path("page");
        let line = refusal(&[&["trajectory", log], poses, &["--out", &out]].concat());
        for what in what {
            assert!(line.contains(what), "{what}: {line}");
        }
        assert!(!folder.path("page").exists());
    };
    let log = |name: &str, lines: &[String]| written(&folder, name, &lines.concat());
    // Logs.
    let none = log("none.log", &["ODOM 0 0 0 0 0 0 1 robot 1\n".to_owned()]);
    refused(&none, &[], &["holds no scan", "FLASER"]);
    refused(&log("empty.log", &[]), &[], &["holds no scan"]);
    refused(&log("beams.log", &[message("0", "1")]), &[TRUE], &["beams"]);
    refused(
        &log(
            "angles.log",
            &["ROBOTLASER1 0 -0.5 1.0 5 20 0.01 0 4 1 2 3 4 0 0 0 0 0 0 0 0 0 0 0 0 1 r 1\n".to_owned()],
        ),
        &[],
        &["angle"],
    );
    let back = [message("3 1 1 1", "2"), message("3 1 1 1", "1")];
    refused(&log("back.log", &back), &[], &["line 2", "time", "ascend"]);
    // NaN, infinity, negative, 0 and the greatest range: no beam says anything.
    let of_five = |readings: &str, time: &str| {
        message(&format!("5 {readings}"), time).replace(" 1.0 0.5 ", " 1.0 0.25 ")
    };
    let silent = log("silent.log", &[of_five("NaN inf -1 0 20", "1"), of_five("nan 0 0 -inf 25", "2")]);
    refused(&silent, &[], &["no scan that tells anything", "--max-range"]);
    refused(&folder.text_path("absent.log"), &[], &["absent.log", "cannot be read"]);
    refused(
        &written(&folder, "log.txt", ""),
        &[],
        &["is no log of scans by its name", "CARMEN logs, .log and .clf"],
    );
    for (name, what) in [
        ("a.mcap", "no bag by its first bytes"),
        ("a.db3", "no bag of rosbag2"),
        ("a.bag", "no bag by its first bytes"),
        ("a.pbstream", "no saved state of Cartographer"),
    ] {
        refused(&written(&folder, name, ""), &[], &[name, what]);
    }
    refused(ROOT, &[], &["is a folder that holds no bag", "allowed are files, and folders of bags"]);
    // Trajectories.
    let poses = |name: &str, lines: &str| written(&folder, name, lines);
    refused(
        LOG,
        &[&poses("late.tum", "100 0 0 0 0 0 0 1\n200 0 0 0 0 0 0 1\n")],
        &["late.tum", "spans 100 to 200 s", "span 0 to 74.5 s"],
    );
    let (early, later) = (poses("early.tum", "0 0 0 0 0 0 0 1\n"), poses("later.tum", "74 0 0 0 0 0 0 1\n"));
    refused(LOG, &[&early, &later], &["no scan", "early.tum spans 0 to 0 s", "later.tum spans 74 to 74 s"]);
    refused(
        LOG,
        &[&poses("unsorted.tum", "2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n")],
        &["unsorted.tum", "line 2", "ascend"],
    );
    refused(LOG, &[&poses("turn.tum", "1 0 0 0 0 0 0 2\n")], &["quaternion", "within 0.02"]);
    refused(LOG, &[&poses("nothing.tum", "# time\n")], &["holds no pose"]);
    refused(LOG, &[ROOT], &["is a folder", "TUM"]);
    // A map beyond the limit: which pose is far away.
    let far = fs::read_to_string(TRUE).unwrap();
    let far: Vec<_> = far
        .lines()
        .map(|line| if line.starts_with("10 ") { "10 900000 -7 0 0 0 0 1" } else { line })
        .collect();
    refused(
        LOG,
        &[&poses("far.tum", &(far.join("\n") + "\n"))],
        &["the pose at 10 s, 900000 -7", "--resolution", "--max-cells"],
    );
    let without =
        changed(&folder, "bare.log", |_, line| (!line.starts_with("ROBOT")).then(|| line.to_owned()));
    refused(&without, &[TRUE], &["holds no scan"]);
}

#[test]
fn bad_arguments_are_refused() {
    for (arguments, what) in [
        (&["--sigma", "0.1"][..], "--sensor gaussian"),
        (&["--sensor", "gaussian"], "--sigma METRES"),
        (&["--sensor", "gaussian", "--sigma", "0.1", "--free", "0.3"], "--sensor stepped"),
        (&["--free", "0.7"], "occupancy of free space is 0.7, allowed is 0 to 1/2"),
        (&["--occupied", "0.3"], "occupancy of the obstacle is 0.3, allowed is 1/2 to 1"),
        (&["--reading-limit", "0"], "limit on the log-odds"),
        (&["--resolution", "0"], "not positive and finite"),
        (&["--mount", "1,2"], "x,y,yaw"),
        (&["--mount", "1,2,inf"], "theta"),
        (&["--max-gap", "-1"], "0 or more"),
        (&["--threads", "0"], "threads"),
        (&["--series", "a.pdf"], ".svg or .png"),
        (&["--heat-map", "a.svg"], ".png"),
        (&["--conflicts", "a.svg"], ".png"),
        (&["--conflicts", LOG], "ends in .png"),
        (&["--output", TRUE, "--resolution", "0.2"], "is an input"),
    ] {
        let line = refusal(&[&["trajectory", LOG, TRUE], arguments].concat());
        assert!(line.contains(what), "{arguments:?}: {line}");
    }
}

#[test]
fn the_trajectories_of_the_log_are_taken_if_none_is_given() {
    let own = rows(&[&[LOG], &COARSE[..]].concat());
    let given = rows(&[&[LOG, TRUE, ODOMETRY], &COARSE[..]].concat());
    let names: Vec<_> = own.iter().map(|row| row["poses"].as_str().unwrap()).collect();
    assert_eq!(names, ["laser", "odometry"]);
    for (own, given) in own.iter().zip(&given) {
        assert_eq!(own["observed"], given["observed"]);
        // The yaw goes through a quaternion.
        let [own, given] = [own, given].map(|row| row["mean_information"].as_f64().unwrap());
        assert!((own - given).abs() < 1e-6, "{own} {given}");
    }
    // Mounted elsewhere, the map is worse.
    let mounted = rows(&[&[LOG, TRUE, "--mount", "0.3,0,0.2"], &COARSE[..]].concat());
    let [right, wrong] = [&given[0], &mounted[0]].map(|row| row["mean_information"].as_f64().unwrap());
    assert!(wrong < right, "{wrong} {right}");
}

/// Whether one of the warnings of a row has these words.
fn warns(row: &Value, words: &str) -> bool {
    row["warnings"].as_array().unwrap().iter().any(|warning| warning.as_str().unwrap().contains(words))
}

#[test]
fn what_means_little_is_said() {
    let folder = Folder::new();
    let clean = rows(&[&[LOG, TRUE, ODOMETRY], &COARSE[..]].concat());
    assert!(clean.iter().all(|row| row["warnings"].as_array().unwrap().is_empty()), "{clean:?}");
    let same = rows(&[&[LOG, TRUE, TRUE], &COARSE[..]].concat());
    assert!(warns(&same[1], "has the very poses of") && warns(&same[1], "within its standard error"));
    assert_eq!((same[1]["difference"].as_f64(), same[1]["standard_error"].as_f64()), (Some(0.0), Some(0.0)));
    assert!(stdout(&[&["trajectory", LOG, TRUE, TRUE], &COARSE[..]].concat()).contains("not told apart"));
    let lines = fs::read_to_string(TRUE).unwrap();
    let poses = |name: &str, change: &dyn Fn(usize, Vec<&str>) -> Option<String>| {
        let lines = lines.lines().filter(|line| !line.starts_with('#')).enumerate();
        let lines: Vec<_> = lines.filter_map(|(k, line)| change(k, line.split(' ').collect())).collect();
        written(&folder, name, &(lines.join("\n") + "\n"))
    };
    // Twenty scans of 150; the others have no pose.
    let few = poses("few.tum", &|k, fields| (k < 20).then(|| fields.join(" ")));
    let few = rows(&[&[LOG, TRUE, &few], &COARSE[..]].concat());
    assert!(warns(&few[1], "20 scans are few") && warns(&few[0], "--max-gap"));
    assert_eq!(
        (few[1]["scans_without_pose"].as_u64(), few[0]["scans_without_pose"].as_u64()),
        (Some(130), Some(0))
    );
    assert_eq!(few[0]["scans_used"].as_u64(), Some(20));
    // All on one heap.
    let heap = poses("heap.tum", &|_, fields| Some(format!("{} 1 1 0 0 0 0 1", fields[0])));
    assert!(warns(
        &rows(&[&[LOG, ODOMETRY, &heap, "--max-range", "1.5"], &COARSE[..]].concat())[1],
        "fewer cells"
    ));
    // Each part of the log far from all others.
    let block = |scan: usize| blocks(150, 20).position(|block| block.contains(&scan)).unwrap();
    let apart = poses("apart.tum", &|k, fields| {
        Some(format!("{} {} {}", fields[0], 20 * block(k), fields[2..].join(" ")))
    });
    let apart = rows(&[&[LOG, TRUE, &apart], &COARSE[..]].concat());
    assert!(
        warns(&apart[1], "nothing can contradict") && warns(&apart[1], "were seen again in another part")
    );
    // A log cut in mid-line is read to its last whole line, one with scans that say nothing passes them over.
    let log = fs::read(LOG).unwrap();
    fs::write(folder.path("cut.log"), &log[..log.len() - 200]).unwrap();
    let cut = rows(&[&[folder.text_path("cut.log").as_str(), TRUE], &COARSE[..]].concat());
    assert!(warns(&cut[0], "is cut short"));
    assert_eq!(cut[0]["scans"].as_u64(), Some(149));
    let rows = rows(&[&[LOG, TRUE, "--max-range", "0.5"], &COARSE[..]].concat());
    assert!(warns(&rows[0], "have no beam that returned") && rows[0]["scans_used"].as_u64() < Some(150));
}

/// `cargo run --release -- trajectory ...`, run where the README says.
#[test]
fn the_readme_shows_what_is_printed() {
    let arguments = ["trajectory", "maps/room.log", "maps/room.true.tum", "maps/room.odometry.tum"];
    let output = meaninfo().current_dir(ROOT).args(arguments).output().unwrap();
    let shown = format!("```text\n{}```\n", text(&output.stdout));
    assert!(text(&read(format!("{ROOT}/README.md"))).contains(&shown), "README.md lacks\n{shown}");
}
