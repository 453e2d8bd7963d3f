//! Bad requests: one line on stderr, nothing on stdout, exit status 2. Help and the version are no errors.

mod common;

use common::*;
use mean_information_files::{ARRAY_NUMBERS, MAX_CELLS, MAX_COUNTED};
use mean_information_test_support::formats::Node;
use std::fs;
use std::io;
use std::process::{Command, Stdio};

#[test]
fn help_and_version_are_done() {
    assert!(stdout(&["--help"]).contains("sweep"));
    assert!(stdout(&["--version"]).starts_with("meaninfo "));
    let help = stdout(&["map", "--help"]);
    for option in [
        "--format",
        "--output",
        "--semantics",
        "--mode",
        "--unknown",
        "--encoding",
        "--heat-map",
        "--resolution",
        "--max-cells",
        "268435456",
    ] {
        assert!(help.contains(option), "{option}");
    }
    // The limits as they are, each said once.
    for limit in [MAX_CELLS, MAX_COUNTED].map(|limit| limit.to_string()) {
        assert_eq!((help.matches(&limit).count(), help.contains("2^")), (1, false), "{limit}");
    }
    let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
    for words in
        ["1 byte a cell, 8 in --mode probability", "17179869184 for PNG and .npz, and none for PGM and .npy"]
    {
        assert!(help.contains(words), "{help}");
    }
    assert!(stdout(&["sweep", "--help"]).contains("--plot"));
}

#[test]
fn usage_errors_are_one_line() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let map = map.as_str();
    for (arguments, what) in [
        (&[][..], "subcommand"),
        (&["paint"], "'paint'"),
        (&["map"], "<FILE>"),
        (&["map", map, "--fromat", "json"], "'--format'"),
        (&["map", map, "--format", "xml"], "table, json, csv"),
        (&["map", map, "--semantics", "ros3"], "nav2, nav2-humble, ros1"),
        (&["map", map, "--unknown", "65536"], "--mode probability"),
        (&["map", map, "--unknown", "127"], "--mode probability"),
        (&["map", map, "--resolution", "0"], "positive"),
        (&["map", map, "--resolution", "nan"], "positive"),
        (&["map", map, "--resolution", "inf"], "positive"),
        (&["map", map, "--max-cells", "-3"], "-3"),
        (&["map", map, "--heat-map", "a.svg"], ".png"),
        (&["map", map, map, "--heat-map", "a.png"], "one map"),
        (&["trajectory", map, "--maps", "a.png"], ".svg"),
        (&["sweep", map, map], "unexpected"),
        (&["bag", map, "--costmaps"], "--topic <TOPIC>"),
        (&["check", "node", "port.mjs"], "put -- before the command"),
        (&["sweep", map, "--plot", "a.pdf"], ".svg or .png"),
        (&["sweep", map, "--plot", "svg"], ".svg or .png"),
        (&["map", map, "--format", "two\nlines"], "two"),
    ] {
        let line = refusal(arguments);
        assert!(line.contains(what) && !line.contains("Usage:"), "{arguments:?}: {line}");
        if !line.contains(map) && !["a.svg", "a.png", "a.pdf"].iter().any(|file| line.contains(file)) {
            let command = arguments.first().filter(|&&command| command != "paint");
            let help = command.map_or_else(String::new, |command| format!("{command} "));
            assert!(line.ends_with(&format!("; try 'meaninfo {help}--help'\n")), "{line}");
        }
    }
    assert_eq!(folder.names(), ["room.pgm", "room.yaml"]);
}

/// The text in one line, without what marks code and roff's hyphens.
fn flat(text: &str) -> String {
    text.replace(['`', '\\'], "").split_whitespace().collect::<Vec<_>>().join(" ")
}

fn file(path: &str) -> String {
    fs::read_to_string(format!("{}/{path}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

/// The same words in the help, the manual pages and the README; of the commands that end with 1 they name all.
#[test]
fn exit_statuses_are_those_that_are_documented() {
    let help = stdout(&["--help"]);
    let (_, words) = help.split_once("\nExit status: ").unwrap();
    let words = flat(words);
    assert!(flat(&file("../../README.md")).contains(&words), "{words}");
    let folder = Folder::new();
    stdout(&["man", "--out", &folder.text_path("")]);
    for page in folder.names() {
        let page = flat(&fs::read_to_string(folder.path(&page)).unwrap());
        assert_eq!((page.contains(&words), page.matches("0 is done").count()), (true, 1), "{page}");
    }
    let (_, list) = words.split_once('(').unwrap();
    let (list, _) = list.split_once(')').unwrap();
    let mut named: Vec<_> = list.split("; ").map(|of| of.split_once(": ").unwrap().0.to_owned()).collect();
    named.sort();
    let ends_with_1 = |name: &String| file(&format!("src/commands/{name}")).contains("Status::CheckFailed");
    let commands = fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/src/commands")).unwrap();
    let commands = commands.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut commands: Vec<_> = commands.filter(|name| name != "mod.rs").filter(ends_with_1).collect();
    commands.sort();
    assert_eq!(named.iter().map(|name| format!("{name}.rs")).collect::<Vec<_>>(), commands);
    // What stands after --keep-going is `many.rs`'s.
    let limit = ["limit", "--range", "2", "--sigma", "0.2", "--method", "rigorous", "--evaluations", "5"];
    let output = meaninfo().args(limit).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(!output.stdout.is_empty());
}

/// What an array's numbers are is said once, and is everywhere the same.
#[test]
fn what_numbers_are_is_said_in_the_same_words() {
    for text in [stdout(&["map", "--help"]), stdout(&["emmi", "--help"]), file("../../README.md")] {
        assert!(flat(&text).contains(&flat(ARRAY_NUMBERS)), "{text}");
    }
}

/// A file is written by --output, a folder or several files by --out.
#[test]
fn one_file_goes_to_output() {
    let help = stdout(&["--help"]);
    let (_, commands) = help.split_once("Commands:\n").unwrap();
    let commands = commands.lines().map_while(|line| line.strip_prefix("  ")?.split_whitespace().next());
    for command in commands.filter(|&command| command != "help") {
        let help = stdout(&[command, "--help"]);
        let out = help.split_once("--out <").map(|(_, rest)| rest.split_once('>').unwrap().0);
        assert!(out.is_none_or(|what| ["DIR", "PREFIX"].contains(&what)), "{command}: {out:?}");
    }
    assert!(stdout(&["page", "--help"]).contains("--output <FILE.html>"));
}

/// An option that no file has a use for is refused; beside a file that has, the others do without.
#[test]
fn options_without_use_are_refused() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let array = folder.npy_map("room.npy", 1, &[0.25]);
    let tree = folder.write("tree.ot", Node::small().full(false)).to_str().unwrap().to_owned();
    let bag = concat!(env!("CARGO_MANIFEST_DIR"), "/../files/tests/bags/maps_lz4.bag");
    let [map, array, tree] = [&map, &array, &tree].map(String::as_str);
    let arrays = "arrays, .npy and .npz; other files say it themselves";
    let octrees = "octrees that only tell free from occupied, .bt or in bags";
    for (option, value, without, its_files) in [
        ("--semantics", "nav2", [array, tree, bag], "ROS maps"),
        ("--mode", "scale", [array, tree, bag], "ROS maps"),
        ("--unknown", "-1", [tree, bag, bag], "ROS maps and arrays of floats"),
        ("--encoding", "percent", [map, tree, bag], arrays),
        ("--resolution", "0.1", [map, tree, bag], arrays),
        ("--clamp", "0.1,0.9", [map, array, tree], octrees),
        ("--topic", "/map", [map, array, tree], "bags"),
    ] {
        for command in ["map", "sweep"] {
            for file in without {
                let line = refusal(&[command, file, option, value]);
                assert_eq!(line, format!("meaninfo: {file}: {option} is for {its_files}; leave it out\n"));
            }
        }
        let [first, second, _] = without;
        let line = refusal(&["map", first, second, option, value]);
        assert!(line.starts_with(&format!("meaninfo: {first}: {option} is for ")), "{line}");
    }
    let line = refusal(&["map", map, "--submaps"]);
    assert!(line.ends_with("--submaps is for saved states, .pbstream; leave it out\n"), "{line}");
    for arguments in [
        &["map", map, array, "--mode", "scale", "--resolution", "0.1"][..],
        &["map", tree, bag, "--topic", "/map", "--clamp", "0.1,0.9"],
        &["sweep", map, "--semantics", "ros1"],
    ] {
        stdout(arguments);
    }
}

#[test]
fn a_file_that_cannot_be_read_is_named() {
    let folder = Folder::new();
    let good = folder.ros_map("room", 5, &GREYS, "scale");
    let missing = folder.text_path("missing.yaml");
    for arguments in [&["map", &missing][..], &["map", &good, &missing], &["sweep", &missing]] {
        let line = refusal(arguments);
        assert!(line.starts_with(&format!("meaninfo: {missing}: ")), "{line}");
    }
}

#[test]
fn a_map_with_too_many_cells_is_refused() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let line = refusal(&["map", &map, "--max-cells", "14"]);
    assert!(line.contains("5 x 3 = 15 cells, more than the limit of 14"), "{line}");
    stdout(&["map", &map, "--max-cells", "15"]);
}

/// Of an image only the pixels are counted, unless a picture or a sweep needs them: then there is a limit.
#[test]
fn a_large_image_is_counted_and_not_kept() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    fs::write(folder.path("room.pgm"), "P5 32768 8193 255\nmore").unwrap();
    assert!(refusal(&["map", &map]).contains("cut short"));
    let picture = folder.text_path("picture.png");
    // No limit helps with what the file does not hold.
    let commands = [&["map", &map, "--heat-map", &picture][..], &["sweep", &map]];
    for arguments in commands {
        let line = refusal(arguments);
        assert!(line.ends_with(&format!("it is cut short (the image that {map} names)\n")), "{line}");
    }
    fs::File::options().write(true).open(folder.path("room.pgm")).unwrap().set_len(300_000_000).unwrap();
    for arguments in commands {
        let line = refusal(arguments);
        assert!(line.contains("32768 x 8193 = 268468224 cells, more than the limit of 268435456"), "{line}");
    }
}

/// The message is lost, but not the exit status.
#[test]
fn a_refusal_without_stderr_is_still_a_refusal() {
    let status = |stderr: Stdio| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_meaninfo"));
        command.args(["map", "no such map.yaml"]).stderr(stderr).status().unwrap().code()
    };
    let (reader, writer) = io::pipe().unwrap();
    drop(reader);
    assert_eq!(status(writer.into()), Some(2));
    if cfg!(target_os = "linux") {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        assert_eq!(status(full.into()), Some(2));
    }
}
