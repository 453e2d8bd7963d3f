//! Files appear whole or not at all, and never in the place of an input.

mod common;

use common::*;
use std::fs;
use std::io;
use std::process::{Command, Stdio};

#[test]
fn output_holds_what_would_be_printed() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let output = folder.text_path("result");
    for format in ["table", "json", "csv"] {
        for command in ["map", "sweep"] {
            assert_eq!(stdout(&[command, &map, "--format", format, "--output", &output]), "");
            assert_eq!(text(&read(&output)), stdout(&[command, &map, "--format", format]));
        }
    }
    assert_eq!(folder.names(), ["result", "room.pgm", "room.yaml"]);
}

#[test]
fn a_refused_map_touches_no_file() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let (output, missing) = (folder.text_path("result"), folder.text_path("missing.yaml"));
    fs::write(&output, "before").unwrap();
    refusal(&["map", &map, &missing, "--output", &output]);
    refusal(&["sweep", &missing, "--output", &output, "--plot", &folder.text_path("plot.svg")]);
    assert_eq!(text(&read(&output)), "before");
    assert_eq!(folder.names(), ["result", "room.pgm", "room.yaml"]);
}

#[test]
fn two_files_are_written_both_or_neither() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let (good, bad) = (folder.text_path("picture.png"), folder.text_path("no/such/folder/result"));
    let line = refusal(&["map", &map, "--heat-map", &good, "--output", &bad]);
    assert!(line.starts_with(&format!("meaninfo: {bad}: ")), "{line}");
    refusal(&["sweep", &map, "--plot", &good, "--output", &bad]);
    refusal(&["map", &map, "--heat-map", &good, "--output", &good]);
    assert_eq!(folder.names(), ["room.pgm", "room.yaml"]);
    stdout(&["map", &map, "--heat-map", &good, "--output", &folder.text_path("result")]);
    assert_eq!(folder.names(), ["picture.png", "result", "room.pgm", "room.yaml"]);
}

#[test]
fn no_input_is_overwritten() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let other = folder.ros_map("other", 3, &[0, 255, 90], "scale");
    let image = folder.text_path("room.pgm");
    let before = (read(&map), read(&image));
    let roundabout =
        folder.text_path("../") + folder.path("").file_name().unwrap().to_str().unwrap() + "/room.yaml";
    for target in [&map, &image, &roundabout] {
        let line = refusal(&["map", &map, &other, "--output", target]);
        assert!(line.contains("input"), "{line}");
        refusal(&["sweep", &map, "--output", target]);
    }
    #[cfg(unix)]
    {
        let link = folder.text_path("link");
        std::os::unix::fs::symlink(&image, &link).unwrap();
        refusal(&["map", &map, "--output", &link]);
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    }
    assert_eq!((read(&map), read(&image)), before);
}

#[test]
fn only_regular_files_are_replaced() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    refusal(&["map", &map, "--output", folder.path("").to_str().unwrap()]);
    refusal(&["map", &map, "--output", ""]);
    #[cfg(unix)]
    assert!(refusal(&["map", &map, "--output", "/dev/null"]).contains("regular"));
}

#[cfg(unix)]
#[test]
fn a_link_keeps_pointing_and_permissions_are_ordinary() {
    use std::os::unix::fs::MetadataExt;
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let (target, link) = (folder.text_path("target"), folder.text_path("link"));
    fs::write(&target, "before").unwrap();
    let ordinary = fs::metadata(&target).unwrap().mode();
    std::os::unix::fs::symlink(&target, &link).unwrap();
    stdout(&["map", &map, "--output", &link]);
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert!(text(&read(&target)).contains("mean information"));
    assert_eq!(fs::metadata(&target).unwrap().mode(), ordinary);
}

#[test]
fn a_closed_pipe_is_no_error() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    for arguments in [&["map", &map][..], &["sweep", &map, "--format", "csv"], &["map", "--help"]] {
        let (reader, writer) = io::pipe().unwrap();
        drop(reader);
        let output = Command::new(env!("CARGO_BIN_EXE_meaninfo"))
            .args(arguments)
            .stdout(writer)
            .stderr(Stdio::piped())
            .output()
            .unwrap();
        assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), ""), "{arguments:?}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let output =
        Command::new(env!("CARGO_BIN_EXE_meaninfo")).args(["map", &map]).stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).starts_with("meaninfo: standard output: "));
}
