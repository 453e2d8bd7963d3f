//! `meaninfo trajectory`: where a trajectory parts from the best one, and that it does not where it moves as that does.

mod common;

use common::*;
use serde_json::Value;
use std::fs;

const LOG: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/room.log");
const TRUE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/room.true.tum");
const ODOMETRY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/room.odometry.tum");

/// Cells so large that a debug build is quick.
const COARSE: [&str; 2] = ["--resolution", "0.2"];

/// The true poses of the sample: time, x, y, yaw.
fn true_poses() -> Vec<[f64; 4]> {
    let text = fs::read_to_string(TRUE).unwrap();
    let pose = |line: &str| {
        let fields: Vec<f64> = line.split(' ').map(|field| field.parse().unwrap()).collect();
        [fields[0], fields[1], fields[2], 2.0 * libm::atan2(fields[6], fields[7])]
    };
    text.lines().filter(|line| !line.starts_with('#')).map(pose).collect()
}

/// Writes the true poses, changed, as TUM text of so many decimals.
fn changed(
    folder: &Folder,
    name: &str,
    decimals: usize,
    change: impl Fn(usize, [f64; 4]) -> [f64; 4],
) -> String {
    let line = |(k, pose): (usize, [f64; 4])| {
        let [time, x, y, yaw] = change(k, pose);
        let (sin, cos) = libm::sincos(yaw / 2.0);
        format!("{time} {x:.decimals$} {y:.decimals$} 0 0 0 {sin:.decimals$} {cos:.decimals$}\n")
    };
    let path = folder.text_path(name);
    fs::write(&path, true_poses().into_iter().enumerate().map(line).collect::<String>()).unwrap();
    path
}

/// A trajectory turned about the origin by so many degrees, and shifted in x.
fn turned(degrees: f64, shift: f64) -> impl Fn(usize, [f64; 4]) -> [f64; 4] {
    let angle = degrees.to_radians();
    let (sin, cos) = libm::sincos(angle);
    move |_, [time, x, y, yaw]| [time, cos * x - sin * y + shift, sin * x + cos * y, yaw + angle]
}

/// What is printed of trajectories beside the true one.
fn printed(others: &[&str]) -> String {
    stdout(&[&["trajectory", LOG, TRUE], others, &COARSE[..]].concat())
}

/// The line on how the other trajectory moves.
fn said(other: &str) -> String {
    let text = printed(&[other]);
    text.lines().find(|line| line.contains("moves ")).unwrap().to_owned()
}

fn number(of: &Value, key: &str) -> f64 {
    of[key].as_f64().unwrap()
}

/// Writes the true poses, from each of some on by 0.3 m more off than before.
fn jumping(folder: &Folder, at: &[usize]) -> String {
    changed(folder, "jump.tum", 12, |k, [time, x, y, yaw]| {
        [time, x + 0.3 * at.iter().filter(|&&jump| jump <= k).count() as f64, y, yaw]
    })
}

#[test]
fn a_jump_is_found_where_it_is() {
    let folder = Folder::new();
    let line = said(&jumping(&folder, &[100]));
    let after = |words: &str| {
        let (_, rest) = line.rsplit_once(words).unwrap();
        rest.split(' ').next().unwrap().parse::<f64>().unwrap()
    };
    let poses = true_poses();
    let since = |k: usize| poses[k][0] - poses[0][0];
    // Printed with one decimal.
    assert!(after("most from ") - 0.05 <= since(99) && since(100) <= after(" to ") + 0.05, "{line}");
    let by = "by 0.30 m, seen from its heading at the start, and 0.0 degrees, 100 % of all that the 20 parts of the log differ by";
    assert!(line.ends_with(by), "{line}");
}

/// In words three, in JSON all; where there are more than one in four parts the two part all along.
#[test]
fn all_jumps_are_found() {
    let folder = Folder::new();
    let poses = true_poses();
    let since = |k: usize| poses[k][0] - poses[0][0];
    for (jumps, end) in [(&[31, 100][..], "0.0 degrees"), (&[12, 31, 70, 85, 100], "; and in 2 more")] {
        let path = jumping(&folder, jumps);
        let line = said(&path);
        let words = format!(
            "moves differently from room.true.tum most in {} of the 20 parts of the log, which have 100 % of all that these differ \
             by: from ",
            jumps.len()
        );
        assert!(line.contains(&words) && line.ends_with(end), "{line}");
        assert_eq!(line.matches("by 0.30 m").count(), jumps.len().min(3), "{line}");
        let rows = rows(&[LOG, TRUE, &path, "--resolution", "0.2"]);
        let mut found: Vec<_> = rows[1]["partings"].as_array().unwrap().iter().collect();
        found.sort_by(|a, b| number(a, "from_s").total_cmp(&number(b, "from_s")));
        assert_eq!(found.len(), jumps.len());
        for (part, &jump) in found.iter().zip(jumps) {
            assert!(
                number(part, "from_s") <= since(jump - 1) && since(jump) <= number(part, "to_s"),
                "{part}"
            );
        }
    }
    let line = said(&jumping(&folder, &[12, 31, 50, 70, 85, 100]));
    assert!(line.contains(" all along the log: by 1.80 m and 0.0 degrees, "), "{line}");
}

/// The sums over the parts, by the poses alone.
#[test]
fn a_drift_is_everywhere() {
    let line = said(ODOMETRY);
    let (_, words) = line.split_once("from room.true.tum all along the log: by ").unwrap();
    let (amounts, rest) =
        words.split_once(", added up over its 20 parts, none of which has more than ").unwrap();
    assert!(rest.ends_with("look at the clock and at --mount"), "{line}");
    let text = fs::read_to_string(ODOMETRY).unwrap();
    let yaw = |line: &str| {
        let fields: Vec<f64> = line.split(' ').map(|field| field.parse().unwrap()).collect();
        2.0 * libm::atan2(fields[6], fields[7])
    };
    let yaws: Vec<_> = text.lines().filter(|line| !line.starts_with('#')).map(yaw).collect();
    let off: Vec<_> = yaws.iter().zip(true_poses()).map(|(yaw, [.., other])| yaw - other).collect();
    let ends = |block: std::ops::Range<usize>| {
        libm::asin(libm::sin(off[block.end.min(149)] - off[block.start])).abs()
    };
    let turn: f64 = mean_information::scan::blocks(150, 20).map(ends).sum();
    assert!(amounts.ends_with(&format!(" m and {:.1} degrees", turn.to_degrees())), "{amounts} {turn}");
}

#[test]
fn of_what_moves_alike_no_parting_is_said() {
    let folder = Folder::new();
    let six = changed(&folder, "six.tum", 6, |_, pose| pose);
    let far = changed(&folder, "far.tum", 12, turned(20.0, 0.3));
    for (other, how) in [
        (&six, "moves as room.true.tum does: no beam ends a tenth of a cell elsewhere"),
        (
            &far,
            "moves as room.true.tum does, in a frame turned by 20.0 degrees and shifted by 0.30 m: the difference is that of \
             where the cells lie, not of the trajectory",
        ),
    ] {
        let text = printed(&[other, ODOMETRY]);
        assert!(text.contains(&format!("{other}: {how}\n")), "{text}");
        assert_eq!(text.matches("moves differently").count(), 1, "{text}");
        let verdict = text.lines().last().unwrap();
        assert!(verdict.contains(" are not told apart by these scans: "), "{verdict}");
        assert!(
            verdict.contains("; room.odometry.tum is worse by ") && verdict.ends_with(" standard errors")
        );
        let rows = rows(&[&[LOG, TRUE, other], &COARSE[..]].concat());
        assert_eq!(rows[1]["partings"], Value::Array(Vec::new()));
    }
    // A fifth of a cell is told, a twentieth is not.
    for (shift, is_alike) in [(0.04, false), (0.005, true)] {
        let bent = changed(&folder, "bent.tum", 12, |k, [time, x, y, yaw]| {
            [time, x + if k % 2 == 0 { 2.0 * shift } else { 0.0 }, y, yaw]
        });
        assert_eq!(said(&bent).contains("moves as room.true.tum does"), is_alike, "{shift}");
    }
}

#[test]
fn what_is_constant_is_named() {
    let folder = Folder::new();
    let late = changed(&folder, "late.tum", 12, |_, [time, x, y, yaw]| [time + 0.5, x, y, yaw]);
    let mounted = changed(&folder, "mounted.tum", 12, |_, [time, x, y, yaw]| {
        [time, x + 0.3 * libm::cos(yaw), y + 0.3 * libm::sin(yaw), yaw + 0.1]
    });
    let line = said(&mounted);
    let mount = "; a laser that is mounted 0.30 m and 5.7 degrees elsewhere would do nearly all of it: look at --mount";
    assert!(line.ends_with(mount), "{line}");
    let line = said(&late);
    let clock = "; poses that are stamped 0.50 s too late would do nearly all of it: look at the clock";
    assert!(line.ends_with(clock), "{line}");
}

/// Every fourth pose, right, and what lies between them.
#[test]
fn far_interpolation_is_warned_of() {
    let folder = Folder::new();
    let text = fs::read_to_string(TRUE).unwrap();
    let lines = text.lines().filter(|line| !line.starts_with('#')).step_by(4);
    let path = folder.text_path("key4.tum");
    fs::write(&path, lines.collect::<Vec<_>>().join("\n")).unwrap();
    let warned = |more: &[&str]| {
        let rows = rows(&[&[LOG, TRUE, &path], more, &COARSE[..]].concat());
        rows.iter().map(|row| row["warnings"].to_string()).collect::<Vec<_>>()
    };
    let [truth, key] = <[String; 2]>::try_from(warned(&["--max-gap", "10"])).unwrap();
    // Of 149 scans up to the last of these poses every fourth has its own.
    assert!(key.contains("111 of its 149 poses are interpolated between two more than 1 s apart"), "{key}");
    assert!(!truth.contains("interpolated"), "{truth}");
    let [all, _] = <[String; 2]>::try_from(warned(&[])).unwrap();
    assert!(all.contains(
        "key4.tum lacks 112 of 150; a larger --max-gap interpolates more, and interpolated poses are worse"
    ));
    assert!(!all.contains("room.true.tum lacks"), "{all}");
}
