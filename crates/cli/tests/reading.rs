//! How files are read, as the command line says it: its words for options, in refusals and warnings.

mod common;

use common::*;
use mean_information_test_support::formats::{pgm, yaml};
use serde_json::Value;
use std::fs;

/// The warnings of a map.
fn warnings(map: &str, more: &[&str]) -> Vec<String> {
    let json = stdout(&[&["map", map, "--format", "json"], more].concat());
    let json: Value = serde_json::from_str(&json).unwrap();
    let warnings = json[0]["warnings"].as_array().unwrap();
    warnings.iter().map(|warning| warning.as_str().unwrap().to_owned()).collect()
}

#[test]
fn warnings_name_the_options_that_mend_them() {
    let folder = Folder::new();
    let samples: Vec<u16> = [[205; 17].as_slice(), &[0, 100, 101, 254, 255]].concat();
    folder.write("image.pgm", pgm(11, 2, 255, &samples));
    let text = yaml("image.pgm", "negate: 0\n").replace("0.196", "0.25");
    let map = folder.write("map.yaml", text);
    let map = map.to_str().unwrap();
    for semantics in ["nav2", "ros1"] {
        // What a reader notices comes first.
        let of = |more: &[&str]| warnings(map, &[&["--semantics", semantics], more].concat()).swap_remove(0);
        assert_eq!(
            of(&[]),
            "17 cells of grey 205, which map savers write for unknown, read as free under free_thresh 0.25; \
              a free_thresh of 0.196 keeps that grey unknown"
        );
        assert_eq!(
            of(&["--mode", "scale"]),
            "17 cells of grey 205, which map savers write for unknown, read as free; mode scale has no grey for \
              unknown; if that grey means unknown, give --mode probability --unknown 205"
        );
        assert_eq!(
            of(&["--mode", "raw"]),
            "19 cells outside 0 to 100 and other than unknown (-1 or 255), read as unknown"
        );
        assert_eq!(
            of(&["--mode", "probability"]),
            "17 cells of grey 205 counted as observed; give --unknown 205 if that grey means unknown"
        );
        let more = ["--semantics", semantics, "--mode", "probability", "--unknown", "205"];
        assert_eq!(warnings(map, &more), [""; 0]);
    }
    // A sweep says the same.
    let json: Value =
        serde_json::from_str(&stdout(&["sweep", map, "--mode", "scale", "--format", "json"])).unwrap();
    assert_eq!(json["warnings"].as_array().unwrap()[0], warnings(map, &["--mode", "scale"])[0]);
}

/// The grey of `--unknown` is of the image's own depth; white is occupied here.
#[test]
fn the_grey_that_means_unknown_is_said_as_the_option_takes_it() {
    let folder = Folder::new();
    folder.write("image.pgm", pgm(4, 1, 65535, &[205 * 257, 0, 9000, 60000]));
    let map = folder.write("map.yaml", yaml("image.pgm", "negate: 1\n"));
    let map = map.to_str().unwrap();
    assert_eq!(
        warnings(map, &[])[0],
        "1 cell of grey 205, which map savers write for unknown, read as occupied; if that grey means unknown, \
         give --mode probability --unknown 52685"
    );
    assert_eq!(warnings(map, &["--mode", "probability", "--unknown", "52685"]), [""; 0]);
}

#[test]
fn what_another_command_takes_is_named_with_it() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let log = folder.text_path("run.log");
    fs::write(&log, "ODOM 0 0 0 0 0 0 1 robot 1\n").unwrap();
    let maps = "is a map by its name, and a log of scans is wanted here; `meaninfo map` measures maps, one or several";
    assert_eq!(refusal(&["trajectory", &map, &map]), format!("meaninfo: {map}: {maps}\n"));
    let maps = maps.replace("a log of scans", "a trajectory");
    let scans = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/room.log");
    assert_eq!(refusal(&["trajectory", scans, &map]), format!("meaninfo: {map}: {maps}\n"));
    let scans = "is a log of scans by its name, and a map is wanted here; `meaninfo trajectory` takes scans, and trajectories \
                 after them";
    for command in ["map", "sweep"] {
        assert_eq!(refusal(&[command, &log]), format!("meaninfo: {log}: {scans}\n"));
    }
    let line = refusal(&["map", &folder.text_path(".")]);
    let words = "is a folder that holds no bag, no .mcap, .db3 or .bag file; allowed are files, and folders of bags\n";
    assert!(line.ends_with(words), "{line}");
}

#[test]
fn refusals_name_the_options_that_mend_them() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let line = refusal(&["map", &map, "--max-cells", "14"]);
    let image = folder.text_path("room.pgm");
    assert_eq!(
        line,
        format!(
            "meaninfo: {image}: claims 5 x 3 = 15 cells, more than the limit of 14 (the image that {map} names); raise it with \
             --max-cells if the file is meant\n"
        )
    );
    let line = refusal(&["map", &map, "--unknown", "127"]);
    assert_eq!(line, format!("meaninfo: {map}: --unknown needs --mode probability; give both or neither\n"));
    // No option raises what memory cannot number.
    folder.write("endless.pgm", b"P5 4294967295 4294967295 255\n1");
    let map = folder.write("map.yaml", yaml("endless.pgm", "negate: 0\n"));
    let map = map.to_str().unwrap();
    let line = refusal(&["map", map]);
    let words = format!("cells, more than the limit of 9223372036854775807 (the image that {map} names)\n");
    assert!(line.ends_with(&words), "{line}");
}

/// The arguments as slices.
fn borrowed(arguments: &[String]) -> Vec<&str> {
    arguments.iter().map(String::as_str).collect()
}

/// Lengths are written alike wherever they are asked for, and refused in the same words.
#[test]
fn range_and_resolution_take_the_same_numbers() {
    let folder = Folder::new();
    let map = folder.npy_map("map.npy", 2, &[0.25, 0.5, 1.0, 0.0]);
    let resolution = |text: &str| vec!["map".to_owned(), map.clone(), "--resolution".into(), text.into()];
    let range = |text: &str| ["limit", "--sigma", "0.25", "--range", text].map(str::to_owned).to_vec();
    let range_of_grids = |text: &str| {
        ["converge", "--sigma", "0.25", "--resolutions", "0.5", "--range", text].map(str::to_owned).to_vec()
    };
    for text in ["0.75", "75e-2", "0x1.8p-1", "0X3P-2"] {
        for arguments in [resolution(text), range(text), range_of_grids(text)] {
            let json = stdout(&[&borrowed(&arguments)[..], &["--format", "json"]].concat());
            let same = arguments.iter().map(|part| if part == text { "0.75" } else { part });
            let same: Vec<&str> = same.chain(["--format", "json"]).collect();
            assert_eq!(json, stdout(&same), "{arguments:?}");
        }
    }
    for text in ["0", "-0.75", "inf", "nan", "2m", "0x1.8p-2000", "0x"] {
        let last = |arguments: &[String]| {
            let line = refusal(&borrowed(arguments));
            line.rsplit_once("; try").unwrap().0.rsplit(": ").next().unwrap().to_owned()
        };
        let expected = last(&resolution(text));
        assert!(expected.len() > 10, "{expected}");
        for arguments in [range(text), range_of_grids(text)] {
            assert_eq!(last(&arguments), expected, "{text}");
        }
    }
}
