//! Bad requests: one line on stderr, nothing on stdout, exit status 2. Help and the version are no errors.

mod common;

use common::*;
use mean_information_files::{MAX_CELLS, MAX_COUNTED};
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
        (&["check", "node", "port.mjs"], "put -- before the command"),
        (&["sweep", map, "--plot", "a.pdf"], ".svg or .png"),
        (&["sweep", map, "--plot", "svg"], ".svg or .png"),
        (&["map", map, "--format", "two\nlines"], "two"),
    ] {
        let line = refusal(arguments);
        assert!(line.contains(what) && !line.contains("Usage:"), "{arguments:?}: {line}");
    }
    assert_eq!(folder.names(), ["room.pgm", "room.yaml"]);
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
