//! Files appear whole or not at all, and never in the place of an input.

mod common;

use common::*;
use mean_information_cli::output::Files;
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

/// The place is refused although the command would not get that far: its input is missing, or makes no sense.
#[test]
fn what_cannot_be_written_is_refused_before_the_work() {
    let folder = Folder::new();
    let [gone, made, bad] = ["gone", "made", "no/such/folder/file"].map(|name| folder.text_path(name));
    let [svg, png] = [".svg", ".png"].map(|ending| bad.clone() + ending);
    let [map, bag, log] = [".yaml", ".mcap", ".log"].map(|ending| gone.clone() + ending);
    let trajectory = ["trajectory", &log, &gone];
    let filter = ["emmi", "--filter", &gone];
    let converge = ["converge", "--range", "2", "--sigma", "0.2", "--resolutions", "1e-300"];
    let simulate = ["simulate", "--scans", "65536", "--scan-beams", "65536"];
    for (command, option, file) in [
        (&["map", &map][..], "--heat-map", &png),
        (&["bag", &bag], "--plot", &svg),
        (&["sweep", &map], "--plot", &svg),
        (&trajectory, "--series", &svg),
        (&trajectory, "--maps", &svg),
        (&trajectory, "--heat-map", &png),
        (&trajectory, "--conflicts", &png),
        (&trajectory, "--out", &bad),
        (&filter, "--plot", &svg),
        (&converge, "--plot", &svg),
        (&simulate, "--out", &bad),
        (&["map", &map], "--output", &bad),
        (&["bag", &bag], "--output", &bad),
        (&["sweep", &map], "--output", &bad),
        (&trajectory, "--output", &bad),
        (&filter, "--output", &bad),
        (&["emmi", "--particles", &gone, "--weights", &gone], "--output", &bad),
        (&converge, "--output", &bad),
        (&["limit", "--range", "2", "--sigma", "0.2", "--scans", "2"], "--output", &bad),
        (&[&simulate[..], &["--out", &made]].concat(), "--output", &bad),
        (&["page", &gone], "--output", &bad),
        // Takes minutes, in a debug build.
        (&["paper"], "--output", &bad),
    ] {
        let line = refusal(&[command, &[option, file]].concat());
        assert!(line.starts_with(&format!("meaninfo: {file}")), "{command:?} {option}: {line}");
    }
    // A page in a folder that is to be made, and what is there already.
    fs::create_dir_all(folder.path("out/index.html")).unwrap();
    let line = refusal(&[&trajectory[..], &["--out", &folder.text_path("out")]].concat());
    assert!(line.contains("out/index.html: is not a regular file"), "{line}");
    let new = folder.text_path("new");
    let line =
        refusal(&[&trajectory[..], &["--out", &new, "--output", &(new.clone() + "/index.html")]].concat());
    assert!(line.contains("is to be written twice"), "{line}");
    assert!(refusal(&[&trajectory[..], &["--out", &new]].concat()).contains("gone"));
    if cfg!(target_os = "linux") {
        let line = refusal(&["map", &map, "--output", "/proc/rows.json"]);
        assert!(line.starts_with("meaninfo: /proc/rows.json: cannot be written"), "{line}");
    }
    assert_eq!(folder.names(), ["out"]);
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

#[cfg(target_os = "linux")]
#[test]
fn standard_output_by_a_name_is_standard_output() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let expected = stdout(&["map", &map]);
    let redirected = folder.text_path("redirected");
    for name in ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1", &redirected] {
        fs::write(&redirected, "before\n").unwrap();
        let file = fs::OpenOptions::new().append(true).open(&redirected).unwrap();
        let status = Command::new(env!("CARGO_BIN_EXE_meaninfo"))
            .args(["map", &map, "--output", name])
            .stdout(file)
            .status()
            .unwrap();
        assert_eq!(status.code(), Some(0), "{name}");
        assert_eq!(text(&read(&redirected)), format!("before\n{expected}"), "{name}");
    }
    // Into a pipe.
    assert_eq!(stdout(&["map", &map, "--output", "/dev/stdout"]), expected);
    assert_eq!(folder.names(), ["redirected", "room.pgm", "room.yaml"]);
}

/// No other stream of the process is written to, by whatever name, nor is a picture mixed into standard output.
#[cfg(target_os = "linux")]
#[test]
fn files_that_others_hold_open_are_kept() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let (held, link) = (folder.text_path("held"), folder.text_path("link"));
    fs::write(&held, "before").unwrap();
    std::os::unix::fs::symlink("/dev/stdin", &link).unwrap();
    for name in ["/dev/stdin", "/dev/fd/0", "/proc/self/fd/0", &link] {
        let output = Command::new(env!("CARGO_BIN_EXE_meaninfo"))
            .args(["map", &map, "--output", name])
            .stdin(fs::File::open(&held).unwrap())
            .output()
            .unwrap();
        assert_eq!((output.status.code(), text(&output.stdout)), (Some(2), ""), "{name}");
        assert!(text(&output.stderr).contains(name), "{}", text(&output.stderr));
        assert_eq!(text(&read(&held)), "before", "{name}");
    }
    let picture = folder.text_path("picture.png");
    std::os::unix::fs::symlink("/dev/stdout", &picture).unwrap();
    assert!(refusal(&["map", &map, "--heat-map", &picture]).contains("stream"));
}

#[test]
fn a_name_that_ends_as_a_folder_is_no_file() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    for name in ["x.json/", "x.json/.", "x.json//", "room.yaml/", ".", ".."] {
        refusal(&["map", &map, "--output", &folder.text_path(name)]);
    }
    assert_eq!(folder.names(), ["room.pgm", "room.yaml"]);
}

#[cfg(unix)]
#[test]
fn a_link_to_nothing_is_refused() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let link = folder.text_path("link");
    std::os::unix::fs::symlink(folder.path("nothing"), &link).unwrap();
    assert!(refusal(&["map", &map, "--output", &link]).contains("does not exist"));
    assert_eq!(folder.names(), ["link", "room.pgm", "room.yaml"]);
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
}

#[cfg(unix)]
#[test]
fn permissions_are_kept_and_respected() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let output = folder.text_path("result");
    let mode = || fs::metadata(&output).unwrap().permissions().mode() & 0o7777;
    for kept in [0o600, 0o640, 0o666] {
        fs::write(&output, "before").unwrap();
        fs::set_permissions(&output, fs::Permissions::from_mode(kept)).unwrap();
        stdout(&["map", &map, "--output", &output]);
        assert!(text(&read(&output)).contains("mean information"));
        assert_eq!(mode(), kept);
    }
    fs::write(&output, "before").unwrap();
    fs::set_permissions(&output, fs::Permissions::from_mode(0o444)).unwrap();
    assert!(refusal(&["map", &map, "--output", &output]).contains("write-protected"));
    assert_eq!((text(&read(&output)), mode()), ("before", 0o444));
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

/// A folder is made with the files in it, or not at all.
#[test]
fn a_folder_comes_and_goes_with_its_files() {
    let folder = Folder::new();
    let files = |names: &[&str]| {
        let mut files = Files::new();
        files.make_folder(&folder.path("new")).unwrap();
        for name in names {
            files.add(&folder.path("new").join(name), b"contents".to_vec());
        }
        files
    };
    files(&["a", "no/b"]).write().unwrap_err();
    files(&["a", "a"]).write().unwrap_err();
    assert_eq!(folder.names(), [""; 0]);
    for names in [["a", "b"], ["b", "c"]] {
        files(&names).write().unwrap();
    }
    let mut names: Vec<_> =
        fs::read_dir(folder.path("new")).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["a", "b", "c"]);
    for bad in ["new/a", "no/such"] {
        assert!(Files::new().make_folder(&folder.path(bad)).is_err(), "{bad}");
    }
}
