//! CARMEN logs: what each message says, and logs that must be refused.

use approx::abs_diff_eq;
use mean_information::scan::Pose;
use mean_information_files::scans::carmen::{MAXIMUM_RANGE, Record, Records, write};
use mean_information_files::scans::{
    Bearings, Frame, NoReturn, RangeScan, Reading, ScanLog, ScanOptions, TimeField,
};
use mean_information_files::{Error, ErrorKind, Memory, Place, Warning, read_scans_from};
use std::fmt::Write;
use std::path::Path;

/// An `FLASER` of beams of 2.5 m at a time.
fn front_laser(beams: usize, time: f64) -> String {
    let ranges = " 2.5".repeat(beams);
    format!("FLASER {beams}{ranges} 1.5 2.25 0.5 1.25 2 0.25 {time} host 0.125\n")
}

/// A `ROBOTLASER1` of three beams at a time, its laser 0.25 m ahead of the robot.
fn robot_laser(time: f64) -> String {
    format!(
        "ROBOTLASER1 0 -0.5 1 0.5 20 0.01 0 3 2.25 20 1.75 2 7 8 3.25 2 0 3 2 0 0 0 0 0 0 {time} host 0.75\n"
    )
}

fn read(text: &str) -> Result<ScanLog, Error> {
    ScanLog::read_carmen(text.as_bytes(), &ScanOptions::default())
}

/// The line of a refusal, and its words.
fn refusal(text: &str) -> (ErrorKind, Option<Place>, String) {
    let refused = read(text).expect_err(text);
    (refused.kind(), refused.place().cloned(), refused.to_string())
}

#[test]
fn a_front_laser_has_ranges_two_poses_and_a_time() {
    let log = read(&front_laser(180, 976_052_890.244_111)).unwrap();
    let scan = &log.scans[0];
    assert_eq!(scan.time(), 976_052_890.244_111);
    assert_eq!(scan.ranges(), [2.5; 180]);
    assert_eq!(scan.limits(), [0.0, MAXIMUM_RANGE]);
    assert_eq!(scan.laser(), Some(&Pose::new(1.5, 2.25, 0.5).unwrap()));
    assert_eq!(scan.odometry(), Some(&Pose::new(1.25, 2.0, 0.25).unwrap()));
    let held: Vec<_> = log.trajectories.iter().map(|held| (held.name.as_str(), held.frame)).collect();
    assert_eq!(held, [("laser", Frame::Laser), ("odometry", Frame::Robot)]);
    assert_eq!((log.mount, log.warnings), (None, vec![]));
}

/// The first and the last beam, in degrees.
#[test]
fn the_number_of_beams_says_their_angles() {
    for (beams, parameters, first, last) in [
        (180, "", -90.0, 89.0),
        (181, "", -90.0, 90.0),
        (360, "", -90.0, 89.5),
        (361, "", -90.0, 90.0),
        (400, "", -50.0, 49.75),
        (401, "", -50.0, 50.0),
        (5, "PARAM laser_front_laser_resolution 30\n", -60.0, 60.0),
        (360, "PARAM laser_front_laser_resolution 1.0 host 0.5\n", -180.0, 179.0),
        (180, "PARAM laser_front_laser_resolution 1.0\nPARAM laser_front_laser_fov 180\n", -90.0, 89.0),
    ] {
        let log = read(&format!("{parameters}{}", front_laser(beams, 2.5))).unwrap();
        let bearings = log.scans[0].bearings();
        for (beam, degrees) in [(0, first), (beams - 1, last)] {
            let bearing: f64 = bearings.at(beam);
            assert!(abs_diff_eq!(bearing.to_degrees(), degrees, epsilon = 1e-12), "{beams} {bearing}");
        }
    }
}

#[test]
fn a_robot_laser_has_its_own_angles_and_range_and_tells_the_mount() {
    let log = read(&[robot_laser(7.5), robot_laser(7.75)].concat()).unwrap();
    let scan = &log.scans[0];
    assert_eq!(scan.bearings(), &Bearings::Even { start: -0.5, increment: 0.5 });
    assert_eq!((scan.limits(), scan.ranges()), ([0.0, 20.0], &[2.25, 20.0, 1.75][..]));
    assert_eq!(log.mount, Some(Pose::new(0.25, 0.0, 0.0).unwrap()));
    // Corrected poses of the laser say nothing about the mount.
    let moved = robot_laser(8.0).replace("3.25 2 0 3 2 0", "3.5 2 0 3 2 0");
    assert_eq!(read(&[robot_laser(7.5), moved].concat()).unwrap().mount, None);
    // A parameter does.
    let with = format!("PARAM robot_frontlaser_offset 0.125\n{}", robot_laser(7.5));
    assert_eq!(read(&with).unwrap().mount, Some(Pose::new(0.125, 0.0, 0.0).unwrap()));
}

#[test]
fn parameters_hold_for_the_scans_after_them() {
    let parameters = "PARAM robot_front_laser_max 40\nPARAM robot_frontlaser_side_offset -0.5\n\
                      PARAM robot_frontlaser_angular_offset 0.25\nPARAM robot_use_laser on\n";
    let log = read(&[&front_laser(180, 1.5), parameters, &front_laser(180, 2.5)].concat()).unwrap();
    assert_eq!(limits(&log), [[0.0, 50.0], [0.0, 40.0]]);
    assert_eq!(log.mount, Some(Pose::new(0.0, -0.5, 0.25).unwrap()));
    let options = ScanOptions { maximum_range: Some(30.0), ..ScanOptions::default() };
    let log = ScanLog::read_carmen(robot_laser(7.5).as_bytes(), &options).unwrap();
    assert_eq!(limits(&log), [[0.0, 30.0]]);
}

fn limits(log: &ScanLog) -> Vec<[f64; 2]> {
    log.scans.iter().map(RangeScan::limits).collect()
}

/// From 81.83 m on SICK's scanners send codes, whatever greatest range a log states.
#[test]
fn codes_of_the_scanner_are_no_ranges() {
    for (stated, meant) in [(81.82, 81.82), (81.83, 81.83), (81.92, 81.83), (82.0, 81.83), (82.5, 82.5)] {
        let log = read(&robot_laser(7.5).replace("0.5 20 0.01", &format!("0.5 {stated} 0.01"))).unwrap();
        assert_eq!(limits(&log), [[0.0, meant]]);
        let log = read(&format!("PARAM robot_front_laser_max {stated}\n{}", front_laser(180, 2.5))).unwrap();
        assert_eq!(limits(&log), [[0.0, meant]]);
    }
    let options = ScanOptions { maximum_range: Some(81.92), ..ScanOptions::default() };
    let log = ScanLog::read_carmen(robot_laser(7.5).as_bytes(), &options).unwrap();
    assert_eq!(limits(&log), [[0.0, 81.92]]);
}

#[test]
fn times_are_those_of_the_message_or_of_the_logger() {
    let options = ScanOptions { time: TimeField::Logged, ..ScanOptions::default() };
    let log = ScanLog::read_carmen(front_laser(180, 976_052_890.25).as_bytes(), &options).unwrap();
    assert_eq!(log.times(), [0.125]);
}

#[test]
fn numbers_in_a_range_s_place_mean_what_the_table_says() {
    let ranges = vec![2.5, 0.0, -1.0, f64::NAN, f64::NEG_INFINITY, 8.0, 81.83, f64::INFINITY, 0.05, 7.99];
    let bearings = Bearings::Even { start: -1.0, increment: 0.25 };
    let scan = RangeScan::new(0.5, bearings, ranges, [0.1, 8.0]).unwrap();
    assert_eq!(
        scan.readings().collect::<Vec<_>>(),
        [
            Reading::Return(2.5),
            Reading::Invalid,
            Reading::Invalid,
            Reading::Invalid,
            Reading::Invalid,
            Reading::NoReturn,
            Reading::NoReturn,
            Reading::NoReturn,
            Reading::Invalid,
            Reading::Return(7.99)
        ]
    );
    let pose = Pose::new(1.5, -0.5, 2.5).unwrap();
    let beams = |no_return| {
        let scan = scan.scan_from(pose, no_return).unwrap().unwrap();
        assert_eq!((scan.pose(), scan.maximum_range()), (&pose, 8.0));
        scan.beams().iter().map(|beam| (beam.bearing, beam.range)).collect::<Vec<_>>()
    };
    assert_eq!(beams(NoReturn::LeftOut), [(-1.0, Some(2.5)), (1.25, Some(7.99))]);
    assert_eq!(
        beams(NoReturn::Free),
        [(-1.0, Some(2.5)), (0.25, None), (0.5, None), (0.75, None), (1.25, Some(7.99))]
    );
    let bearings = Bearings::Even { start: -1.0, increment: 0.25 };
    let nothing = RangeScan::new(0.5, bearings, vec![0.0, 9.0], [0.0, 8.0]).unwrap();
    assert_eq!(nothing.scan_from(pose, NoReturn::LeftOut).unwrap(), None);
    // Words that C prints for numbers are read.
    let log = read(&front_laser(180, 2.5).replacen("2.5 2.5 2.5", "-nan inf NaN", 1)).unwrap();
    let begin: Vec<_> = log.scans[0].readings().take(3).collect();
    assert_eq!(begin, [Reading::Invalid, Reading::NoReturn, Reading::Invalid]);
}

#[test]
fn lines_that_are_not_understood_are_counted_by_their_first_word() {
    let mut text = String::from("# a robot\n\nRLASER 1\nSYNC x\nRAWLASER2 1 2\nTRUEPOS\n");
    text.push_str(&front_laser(180, 2.5));
    for n in 0..12 {
        writeln!(text, "WORD{n} 1 2\nWORD1 3").unwrap();
    }
    let log = read(&text).unwrap();
    let [Warning::LinesNotUnderstood { lines: 24, ref words }] = log.warnings[..] else {
        panic!("{:?}", log.warnings)
    };
    assert_eq!((words.len(), &words[1]), (8, &("WORD1".to_owned(), 13)));
    let words = log.warnings[0].to_string();
    assert!(words.starts_with("24 lines are not understood"), "{words}");
    assert!(words.ends_with("WORD7 (1) and others (4)"), "{words}");
}

#[test]
fn a_log_cut_in_mid_line_is_read_to_its_last_whole_line() {
    let (first, second) = (front_laser(180, 2.5), front_laser(180, 3.5));
    // Up to the last field of all; a number that is cut but there cannot be told from a whole one.
    let whole = second.rfind(' ').unwrap() + 1;
    for cut in 1..=whole {
        let log = read(&format!("{first}{}", &second[..cut])).unwrap();
        assert_eq!((log.scans.len(), &log.warnings), (1, &vec![Warning::CutInLine { line: 2 }]), "{cut}");
    }
    let log = read(&format!("{first}{}", second.trim_end())).unwrap();
    assert_eq!((log.scans.len(), log.warnings), (2, vec![]));
    // A last number that is cut to one that cannot be meant: a time before that of the scan before.
    let at = |time: &str| front_laser(180, 2.5).replace("host 0.125", &format!("host {time}"));
    let (first, second) = (at("25.5"), at("35.5"));
    let options = ScanOptions { time: TimeField::Logged, ..ScanOptions::default() };
    let cut = format!("{first}{}", second.trim_end().trim_end_matches("5.5"));
    let log = ScanLog::read_carmen(cut.as_bytes(), &options).unwrap();
    assert_eq!((log.scans.len(), &log.warnings), (1, &vec![Warning::CutInLine { line: 2 }]), "{cut}");
}

#[test]
fn a_time_that_repeats_is_counted_and_one_that_goes_back_is_refused() {
    let at = |time| front_laser(180, time);
    let log = read(&[at(2.5), at(2.5), at(3.5), robot_laser(3.5)].concat()).unwrap();
    assert_eq!((log.times(), log.warnings), (vec![2.5, 3.5], vec![Warning::ScansAtOneTime { count: 2 }]));
    let back = [at(2.5), "# here\n".to_owned(), at(2.25)].concat();
    let words = "line 3: time is 2.25, allowed is a time above the one before, 2.5 s: times ascend";
    assert_eq!(refusal(&back), (ErrorKind::OutOfRange, Some(Place::Line(3)), words.to_owned()));
}

#[test]
fn what_cannot_be_meant_is_refused_by_its_line() {
    let line = Some(Place::Line(2));
    let fine = robot_laser(7.5);
    for (text, kind, words) in [
        (
            "FLASER 0 1 2 3 4 5 6 7 host 8\n".to_owned(),
            ErrorKind::OutOfRange,
            "line 2: the number of beams is 0, allowed is 1 or more",
        ),
        (
            front_laser(90, 2.5),
            ErrorKind::OutOfRange,
            "line 2: the number of beams is 90, allowed is 180, 181, 360, 361, 400, 401, or `PARAM \
             laser_front_laser_resolution DEGREES` before it",
        ),
        ("FLASER 2 1.5\n".to_owned(), ErrorKind::Format, "line 2 ends before the ranges"),
        (
            "FLASER x 1.5\n".to_owned(),
            ErrorKind::Format,
            "the number of beams in line 2 is `x`, allowed is a whole number from 0",
        ),
        (
            fine.replace("2.25", "2,25"),
            ErrorKind::Format,
            "the ranges in line 2 is `2,25`, allowed is a number",
        ),
        (
            fine.replace("3.25 2 0", "3.25 nan 0"),
            ErrorKind::OutOfRange,
            "y in line 2 is NaN, allowed is a finite number",
        ),
        (
            fine.replace("7.5", "inf"),
            ErrorKind::OutOfRange,
            "ipc_timestamp in line 2 is inf, allowed is a finite number",
        ),
        (
            fine.replace("-0.5 1 0.5", "-0.5 2 0.5"),
            ErrorKind::OutOfRange,
            "line 2: the number of beams is 3, allowed is 2 / 0.5 = 4.0, field of view by angle between beams, or 1 more",
        ),
        (
            fine.replace("-0.5 1 0.5", "-0.5 1 0"),
            ErrorKind::OutOfRange,
            "line 2: the number of beams is 3, allowed is 1 / 0 = inf, field of view by angle between beams, or 1 more",
        ),
        (
            fine.replace("-0.5 1 0.5 20", "-0.5 10 5 20"),
            ErrorKind::OutOfRange,
            "line 2: the angle between 3 beams is 5, allowed is not 0, and at most one turn in all, in radians",
        ),
        (
            fine.replace("0.5 20 0.01", "0.5 0 0.01"),
            ErrorKind::OutOfRange,
            "line 2: the greatest range is 0, allowed is a finite number of metres above 0 and above the least range",
        ),
        (
            "PARAM laser_front_laser_resolution 0\n".to_owned(),
            ErrorKind::OutOfRange,
            "laser_front_laser_resolution in line 2 is 0, allowed is an angle above 0, up to 360 degrees",
        ),
        ("ODOM 1 2 3 4\n".to_owned(), ErrorKind::Format, "line 2 ends before rv"),
    ] {
        let refused = refusal(&format!("# a robot\n{text}{fine}"));
        assert_eq!(refused, (kind, line.clone(), words.to_owned()));
    }
    let contradicting = "PARAM laser_front_laser_resolution 0.5\nPARAM laser_front_laser_fov 180\n";
    let (_, place, words) = refusal(&[contradicting, &front_laser(180, 2.5)].concat());
    assert_eq!(place, Some(Place::Line(3)));
    assert!(words.contains("180 / 0.5 = 360.0"), "{words}");
}

#[test]
fn a_log_without_scans_says_what_it_holds() {
    let (kind, _, words) = refusal("# GMapping\nLASER_READING 3 1 2 3\nFRAME 1\nFRAME 2\n");
    assert_eq!(kind, ErrorKind::Format);
    assert_eq!(
        words,
        "holds no scan: 3 lines are not understood and passed over, by the first word: LASER_READING (1), FRAME (2); \
         allowed are CARMEN logs with FLASER or ROBOTLASER1"
    );
    assert!(refusal("").2.starts_with("holds no scan; "));
    let mut files = Memory::new();
    files.add("room.log", robot_laser(7.5));
    files.add("room.bag", robot_laser(7.5));
    let open = |name: &str| read_scans_from(&files, Path::new(name), &ScanOptions::default());
    assert_eq!(open("room.log").unwrap().files, [Path::new("room.log")]);
    let refused = open("room.bag").unwrap_err();
    let words = "room.bag: is a bag, which is read from a disk only";
    assert_eq!((refused.kind(), refused.to_string().as_str()), (ErrorKind::Unsupported, words));
    assert_eq!(open("hall.clf").unwrap_err().kind(), ErrorKind::NotFound);
}

#[test]
fn records_come_in_the_order_of_the_file_and_end_at_an_error() {
    let text = ["ODOM 1 2 0.5 0 0 0 2.25 host 0.5\n", &robot_laser(7.5), "ODOM 1\n", &robot_laser(8.5)];
    let text = text.concat();
    let mut records = Records::new(text.as_bytes(), &ScanOptions::default());
    let pose = Pose::new(1.0, 2.0, 0.5).unwrap();
    assert_eq!(records.next().unwrap().unwrap(), Record::Odometry { time: 2.25, pose });
    assert!(matches!(records.next(), Some(Ok(Record::Scan(_)))));
    assert!(records.next().unwrap().is_err());
    assert!(records.next().is_none());
}

#[test]
fn scans_that_a_log_cannot_have_are_not_written() {
    let scan = |bearings| RangeScan::new(0.5, bearings, vec![2.5, 3.5], [0.0, 8.0]).unwrap();
    let pose = Pose::new(1.5, 2.5, 0.5).unwrap();
    let even = scan(Bearings::Even { start: 0.0, increment: 0.5 });
    let uneven = scan(Bearings::Each([0.0, 0.25].into())).with_laser(pose).with_odometry(pose);
    for refused in [even.clone().with_laser(pose), even.with_odometry(pose), uneven] {
        let refused = write(&[refused], "", Vec::new()).unwrap_err();
        assert_eq!((refused.kind(), refused.place()), (ErrorKind::Unsupported, Some(&Place::Item(0))));
    }
    for bearings in [vec![0.0], vec![0.0, f64::NAN]] {
        assert!(RangeScan::new(0.5, Bearings::Each(bearings.into()), vec![2.5, 3.5], [0.0, 8.0]).is_err());
    }
    for limits in [[8.0, 8.0], [-1.0, 8.0], [0.0, f64::INFINITY], [f64::NAN, 8.0], [0.0, f64::NAN]] {
        let bearings = Bearings::Even { start: 0.0, increment: 0.5 };
        assert!(RangeScan::new(0.5, bearings, vec![2.5, 3.5], limits).is_err(), "{limits:?}");
    }
}
