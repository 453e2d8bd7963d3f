//! Scans of bags with the transforms and poses beside them, put together byte by byte.

use crate::scan_bag::{
    AHEAD, AMCL, Bag, LEFT, ODOM, PLAIN, POSE, SCAN, STATIC, TF, TOPICS, assert_pose, log, log_of, log_with,
    named,
};
use mean_information::scan::Pose;
use mean_information_files::bags::{Visitor, read_stream, scans_of};
use mean_information_files::scans::{Reading, ScanLog, ScanOptions, Selection};
use mean_information_files::{Error, ErrorKind, Options, Place, Warning};
use mean_information_test_support::formats::bag::mcap_of;

fn refused(messages: &[(u16, Vec<u8>)], selection: &Selection) -> (Error, String) {
    let error = log_with("cdr", messages, selection).unwrap_err();
    let line = error.to_string();
    (error, line)
}

#[test]
fn both_orders_of_bytes_and_both_serialisations_of_all_messages() {
    for (encoding, big_endian, ros1) in [("cdr", false, false), ("cdr", true, false), ("ros1", false, true)] {
        let bag = Bag { big_endian, ros1 };
        let ranges = [1.5, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, 0.05, 9.0, 8.0, 0.0625];
        let messages = [
            bag.scan_of(22, "laser", [1.0, -0.25, 0.015625], &ranges),
            bag.moving(),
            bag.pose(ODOM, 20, "base", [1.0, 2.0], AHEAD),
            bag.pose(ODOM, 24, "base", [3.0, 2.0], LEFT),
            bag.pose(POSE, 22, "", [7.0, 8.0], LEFT),
            bag.pose(AMCL, 22, "", [9.0, 8.0], LEFT),
            bag.mount(),
        ];
        let selection = named(&["map", "odom"], &["/odom", "/pose", "/amcl_pose"]);
        let log = log_with(encoding, &messages, &selection).unwrap();
        let [scan] = &*log.scans else { panic!("{:?}", log.scans) };
        assert_eq!((scan.time(), scan.limits()), (5.5, [0.0625, 8.0]));
        assert_eq!([0, 1, 7].map(|beam| scan.bearings().at(beam)), [1.0, 0.75, -0.75]);
        // The table of `scans`: REP 117, by which 9 beyond 8 is an error, but the greatest range as no return.
        let [none, wrong] = [Reading::NoReturn, Reading::Invalid];
        let expected =
            [Reading::Return(1.5), none, wrong, wrong, wrong, wrong, none, Reading::Return(0.0625)];
        assert_eq!(scan.readings().collect::<Vec<_>>(), expected);
        assert_eq!(log.warnings, [Warning::BeamsApart { seconds: 7.0 / 64.0 }]);
        assert_pose(&log.mount.unwrap(), [0.5, 0.0, 0.0]);

        let names: Vec<_> = log.trajectories.iter().map(|held| &*held.name).collect();
        assert_eq!(names, ["map", "odom", "/odom", "/pose", "/amcl_pose"]);
        let half = std::f64::consts::FRAC_PI_2;
        let expected =
            [[8.0, 22.0, half], [2.0, 2.0, 0.0], [2.0, 2.0, half / 2.0], [7.0, 8.0, half], [9.0, 8.0, half]];
        for (held, expected) in log.trajectories.iter().zip(expected) {
            assert_pose(&held.trajectory.pose_at(5.5, 1.0).unwrap(), expected);
            assert_eq!(held.warnings, []);
        }
    }
}

#[test]
fn transforms_of_another_run_are_passed_over() {
    const OLD: u16 = 7;
    let topics = [&TOPICS[..], &[(OLD, "/tf_old", TOPICS[1].2)]].concat();
    let old = PLAIN.tf(
        OLD,
        &[(20, "odom", "base", [70.0, 2.0, 0.0], AHEAD), (22, "odom", "base", [80.0, 2.0, 0.0], LEFT)],
    );
    let messages = [PLAIN.scan(22), PLAIN.moving(), PLAIN.mount()];
    let poses = |messages: &[(u16, Vec<u8>)]| {
        let log = log_of(&mcap_of("cdr", &topics, messages), &Selection::default()).unwrap();
        log.trajectories.iter().flat_map(|held| held.trajectory.poses().to_vec()).collect::<Vec<_>>()
    };
    assert_eq!(poses(&[&messages[..], &[old]].concat()), poses(&messages));
}

#[test]
fn frames_that_are_not_named_are_map_and_odom() {
    let found = log(&[PLAIN.scan(22), PLAIN.moving(), PLAIN.mount()]).unwrap();
    assert_eq!(found.trajectories.iter().map(|held| &*held.name).collect::<Vec<_>>(), ["map", "odom"]);
    let world = PLAIN.tf(TF, &[(22, "world", "base", [1.0; 3], AHEAD)]);
    let (error, line) = refused(&[PLAIN.scan(22), world.clone(), PLAIN.mount()], &Selection::default());
    assert_eq!(error.kind(), ErrorKind::Choice);
    assert_eq!(line, "TF has neither map nor odom over base; the frames over it are: world");
    let selection = named(&["/world"], &[]);
    let found = log_with("cdr", &[PLAIN.scan(22), world, PLAIN.mount()], &selection).unwrap();
    assert_pose(&found.trajectories[0].trajectory.poses()[0], [1.0, 1.0, 0.0]);
    let (_, line) = refused(&[PLAIN.scan(22)], &Selection::default());
    assert_eq!(line, "TF has neither map nor odom over laser; the frames over it are: none");
}

#[test]
fn a_step_of_transforms_is_never_extrapolated() {
    let messages = [19, 20, 21, 24, 25].map(|quarters| PLAIN.scan(quarters));
    let messages = [&messages[..], &[PLAIN.moving(), PLAIN.mount()]].concat();
    for (max_gap, times) in [(1.0, &[5.0, 5.25, 6.0][..]), (0.75, &[5.0, 6.0])] {
        let found = log_with("cdr", &messages, &Selection { max_gap, ..Selection::default() }).unwrap();
        assert_eq!(found.trajectories[0].trajectory.times(), times);
        assert_eq!(found.scans.len(), 5);
    }
    let (error, line) = refused(&[PLAIN.scan(25), PLAIN.moving(), PLAIN.mount()], &Selection::default());
    assert_eq!(error.kind(), ErrorKind::OutOfRange);
    let expected = "TF has no pose of base in map at the time of a scan: the scans span 6.25 to 6.25 s, TF spans 5 to 6 s";
    assert_eq!(line, expected);
}

#[test]
fn the_robot_is_what_carries_the_laser_or_what_is_named() {
    // base carries plate, plate the laser; the poses are of base, unless plate is named.
    let fixed = PLAIN.tf(
        STATIC,
        &[(0, "base", "plate", [0.5, 0.0, 0.0], LEFT), (0, "plate", "laser", [0.25, 0.0, 0.0], AHEAD)],
    );
    let odometry = PLAIN.pose(ODOM, 22, "plate", [4.0, 3.0], AHEAD);
    let messages = [fixed, PLAIN.scan(22), PLAIN.moving(), odometry];
    let found = log_with("cdr", &messages, &named(&["odom"], &["/odom"])).unwrap();
    let quarter = std::f64::consts::FRAC_PI_2;
    assert_pose(&found.mount.unwrap(), [0.5, 0.25, quarter]);
    // In plate, base is half a metre to the left and turned to the right.
    assert_pose(&found.trajectories[1].trajectory.poses()[0], [4.0, 3.5, -quarter]);
    let plate = Selection { base: Some("/plate".to_owned()), ..named(&["odom"], &["/odom"]) };
    let found = log_with("cdr", &messages, &plate).unwrap();
    assert_pose(&found.mount.unwrap(), [0.25, 0.0, 0.0]);
    assert_pose(&found.trajectories[0].trajectory.poses()[0], [2.5, 2.0, quarter]);
    assert_pose(&found.trajectories[1].trajectory.poses()[0], [4.0, 3.0, 0.0]);
    // Without /tf_static the mount must be given, and the poses are what they are.
    let (_, line) = refused(&messages[1..], &plate);
    assert_eq!(line, "TF does not connect laser with plate; the frames over laser are: none");
    let mount = Pose::new(0.125, 0.0, 0.0).unwrap();
    let given = Selection { mount: Some(mount), frames: Some(Vec::new()), ..plate };
    let found = log_with("cdr", &messages[1..], &given).unwrap();
    assert_eq!(found.mount, Some(mount));
    assert_pose(&found.trajectories[0].trajectory.poses()[0], [4.0, 3.0, 0.0]);
}

#[test]
fn frames_that_transforms_do_not_connect() {
    let messages = [PLAIN.scan(22), PLAIN.moving(), PLAIN.mount()];
    let (error, line) = refused(&messages, &named(&["earth"], &[]));
    assert_eq!(error.kind(), ErrorKind::Choice);
    assert_eq!(line, "TF does not connect base with earth; the frames over base are: odom, map");
    let twice = PLAIN.tf(TF, &[(22, "earth", "base", [0.0; 3], AHEAD)]);
    let (error, line) = refused(&[&messages[..], &[twice]].concat(), &Selection::default());
    assert_eq!(
        (error.kind(), &*line),
        (ErrorKind::Format, "TF has frame base in two frames, odom and earth")
    );
    let round = PLAIN.tf(TF, &[(22, "base", "map", [0.0; 3], AHEAD)]);
    let (_, line) = refused(&[&messages[..], &[round]].concat(), &Selection::default());
    assert!(line.ends_with(" in itself"), "{line}");
    let (_, line) = refused(&[PLAIN.scan(22), PLAIN.mount()], &named(&[], &["/gps"]));
    assert!(line.starts_with("has no topic /gps of type nav_msgs/Odometry, "), "{line}");
    assert!(line.ends_with("; topics of its poses are: /amcl_pose, /odom, /pose"), "{line}");
}

#[test]
fn transforms_that_are_none_are_passed_over() {
    let unsound = PLAIN.tf(
        TF,
        &[
            (20, "odom", "base", [f64::NAN, 0.0, 0.0], AHEAD),
            (20, "odom", "base", [0.0; 3], [0.0; 4]),
            (20, "odom", "odom", [0.0; 3], AHEAD),
            (20, "odom", "", [0.0; 3], AHEAD),
        ],
    );
    let found = log(&[unsound, PLAIN.moving(), PLAIN.scan(22), PLAIN.mount()]).unwrap();
    assert_eq!(found.warnings, [Warning::TransformsUnsound { count: 4 }]);
    assert_pose(&found.trajectories[1].trajectory.poses()[0], [2.0, 2.0, 0.0]);
}

#[test]
fn clocks_and_repeated_stamps() {
    let rest = [PLAIN.moving(), PLAIN.mount()];
    let empty = PLAIN.scan_of(22, "laser", [0.0; 3], &[]);
    let found = log(&[&[PLAIN.scan(21), PLAIN.scan(21), empty, PLAIN.scan(23)][..], &rest].concat()).unwrap();
    assert_eq!(found.times(), [5.25, 5.75]);
    let [same, beamless] = [Warning::ScansAtOneTime { count: 1 }, Warning::ScansWithoutBeams { count: 1 }];
    assert_eq!(found.warnings, [same, beamless]);
    let (error, line) =
        refused(&[&[PLAIN.scan(23), PLAIN.scan(21)][..], &rest].concat(), &Selection::default());
    let place = Place::Message { topic: "/scan".to_owned(), number: 2, byte: Some(4) };
    assert_eq!((error.kind(), error.place()), (ErrorKind::OutOfRange, Some(&place)));
    assert!(
        line.starts_with("message 2 of /scan, byte 4 of it: time is 5.25, allowed is a time above"),
        "{line}"
    );
    assert!(line.ends_with("; the clock jumps back there: part the bag"), "{line}");
    let poses = [24, 24, 20].map(|quarters| PLAIN.pose(POSE, quarters, "", [0.0; 2], AHEAD));
    let found =
        log_with("cdr", &[&[PLAIN.scan(24), PLAIN.mount()], &poses[..2]].concat(), &named(&[], &["/pose"]))
            .unwrap();
    assert_eq!(found.trajectories[0].warnings, [Warning::PosesAtOneTime { count: 1 }]);
    let (_, line) = refused(&poses, &named(&[], &["/pose"]));
    assert!(line.starts_with("message 3 of /pose, byte 4 of it: time is 5, "), "{line}");
}

#[test]
fn messages_that_are_none() {
    let all = named(&[], &["/odom"]);
    for (message, line) in [
        (
            PLAIN.scan_of(20, "laser", [f32::NAN, 0.25, 0.0], &[1.0]),
            "message 1 of /scan, byte 24 of it: the first bearing is NaN, allowed is within two turns, in radians",
        ),
        (
            PLAIN.scan_of(20, "laser", [0.0, 0.0, 0.0], &[1.0, 2.0]),
            "message 1 of /scan, byte 24 of it: the angle between 2 beams is 0, allowed is not 0, and at most one turn in \
             all, in radians",
        ),
        (
            (SCAN, PLAIN.scan(20).1[..58].to_vec()),
            "message 1 of /scan, byte 56 of it: has a field of 4 bytes, but 2 are left",
        ),
        (
            (TF, PLAIN.moving().1[..60].to_vec()),
            "message 1 of /tf, byte 60 of it: has a field of 8 bytes, but 0 are left",
        ),
        (
            PLAIN.pose(ODOM, 20, "base", [1.0, f64::INFINITY], AHEAD),
            "message 1 of /odom, byte 36 of it: the pose, of which the quaternion has the length is 1, allowed is a finite \
             position, and a quaternion whose squared length is 1, within 0.01, as in tf2",
        ),
    ] {
        assert_eq!(refused(&[message], &all).1, line);
    }
    let (_, line) = refused(&[PLAIN.scan(20), PLAIN.scan_of(21, "other", [0.0; 3], &[])], &all);
    let expected = "message 2 of /scan, byte 4 of it: is a scan in frame other, after those in frame laser; allowed is one \
                    laser a topic";
    assert_eq!(line, expected);
    let (_, line) = refused(&[PLAIN.mount()], &all);
    assert_eq!(line, "has no scan on topic /scan");
    let (_, line) = refused(&[PLAIN.scan(20), PLAIN.mount()], &all);
    assert_eq!(line, "has no pose on topic /odom");
}

#[test]
fn the_only_topic_of_scans_and_transforms_of_its_namespace() {
    let kind = "sensor_msgs/msg/LaserScan";
    let topics = [
        (SCAN, "/a/scan", kind),
        (9, "/b/scan", kind),
        (TF, "/tf", TOPICS[1].2),
        (10, "/b/tf", TOPICS[1].2),
        (STATIC, "/b/tf_static", TOPICS[1].2),
    ];
    let other = PLAIN.tf(10, &[(22, "odom", "base", [7.0; 3], AHEAD)]);
    let messages = [PLAIN.scan(21), (9, PLAIN.scan(22).1), PLAIN.moving(), other, PLAIN.mount()];
    let bytes = mcap_of("cdr", &topics, &messages);
    let error = log_of(&bytes, &Selection::default()).unwrap_err();
    let line = "has several topics of scans; topics of its scans are: /a/scan, /b/scan";
    assert_eq!((error.kind(), &*error.to_string()), (ErrorKind::Choice, line));
    let named = |topic: &str| Selection { topic: Some(topic.to_owned()), ..Selection::default() };
    let found = log_of(&bytes, &named("/b/scan")).unwrap();
    assert_eq!((found.times(), found.trajectories.len()), (vec![5.5], 1));
    assert_pose(&found.trajectories[0].trajectory.poses()[0], [7.0, 7.0, 0.0]);
    let line = log_of(&bytes, &named("/c/scan")).unwrap_err().to_string();
    assert!(line.starts_with("has no topic /c/scan of type sensor_msgs/LaserScan; topics of its"), "{line}");
}

/// A bag whose header stamps are all 0 was recorded by a driver that sets none.
#[test]
fn messages_that_nobody_stamped() {
    let scans = [PLAIN.scan(0), PLAIN.scan(0), PLAIN.scan(0)];
    let (error, line) =
        refused(&[&scans[..], &[PLAIN.moving(), PLAIN.mount()]].concat(), &Selection::default());
    let expected = "has scans on /scan that all have the time 0: nothing stamped their headers; allowed are stamps by \
                    the clock of the poses";
    assert_eq!((error.kind(), &*line), (ErrorKind::OutOfRange, expected));
    let poses = [0, 0].map(|quarters| PLAIN.pose(POSE, quarters, "", [0.0; 2], AHEAD));
    let (_, line) =
        refused(&[&[PLAIN.scan(24), PLAIN.mount()], &poses[..]].concat(), &named(&[], &["/pose"]));
    assert!(line.starts_with("has poses on /pose that all have the time 0: nothing stamped"), "{line}");
    // One scan at 0, as a simulation begins, is a scan.
    assert_eq!(log(&[PLAIN.scan(0), PLAIN.scan(22), PLAIN.moving(), PLAIN.mount()]).unwrap().scans.len(), 2);
}

/// REP 117: `range_max` may be infinite. Then no finite range is beyond it, and an infinite one says nothing of free space.
#[test]
fn a_laser_without_a_greatest_range() {
    let (id, mut bytes) = PLAIN.scan_of(22, "laser", [0.0, 0.25, 0.0], &[1.5, f32::INFINITY, 90.0, -1.0]);
    let at = bytes.windows(4).position(|four| four == 8_f32.to_le_bytes()).unwrap();
    bytes[at..at + 4].copy_from_slice(&f32::INFINITY.to_le_bytes());
    let messages = [(id, bytes), PLAIN.moving(), PLAIN.mount()];
    let found = log(&messages).unwrap();
    let [near, far] = [Reading::Return(1.5), Reading::Return(90.0)];
    let readings = |log: &ScanLog| log.scans[0].readings().collect::<Vec<_>>();
    assert_eq!(readings(&found), [near, Reading::Invalid, far, Reading::Invalid]);
    assert_eq!(found.warnings, [Warning::NoGreatestRange { count: 1 }]);
    // The caller's own makes it no return from within.
    let bytes = mcap_of("cdr", &TOPICS, &messages);
    let options = ScanOptions { maximum_range: Some(30.0), ..ScanOptions::default() };
    let read =
        |visitor: &mut dyn Visitor| read_stream(&*bytes, bytes.len() as u64, &Options::default(), visitor);
    let found = scans_of(read, &options, &Selection::default()).unwrap();
    let [none, wrong] = [Reading::NoReturn, Reading::Invalid];
    assert_eq!((readings(&found), found.scans[0].limits()[1]), (vec![near, none, none, wrong], 30.0));
    assert_eq!(found.warnings, []);
}

/// tf2 takes quaternions whose squared length is 1 within 0.01: 0.996 and 1.004 long, not 0.994 and 1.006.
#[test]
fn quaternions_that_tf2_takes() {
    for (length, is_taken) in [(0.994, false), (0.9955, true), (1.0045, true), (1.006, false)] {
        let mount = PLAIN.tf(STATIC, &[(0, "base", "laser", [0.5, 0.0, 0.0], [0.0, 0.0, 0.0, length])]);
        let found = log_with("cdr", &[PLAIN.scan(22), PLAIN.moving(), mount], &named(&[], &[])).unwrap();
        assert_eq!((found.mount.is_some(), found.warnings.is_empty()), (is_taken, is_taken), "{length}");
        let pose = PLAIN.pose(ODOM, 22, "base", [1.0, 2.0], [0.0, 0.0, 0.0, length]);
        let found = log_with("cdr", &[PLAIN.scan(22), PLAIN.mount(), pose], &named(&[], &["/odom"]));
        assert_eq!(found.is_ok(), is_taken, "{length}");
    }
}
