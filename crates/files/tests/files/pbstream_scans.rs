//! The scans of Cartographer's saved states: a real one by the figures of another decoder, and such as tests put together.

use crate::scan_bag::{AHEAD, HALF, LEFT, assert_pose};
use mean_information::scan::Pose;
use mean_information_files::pbstream::read_scans;
use mean_information_files::scans::{RangeScan, Reading, ScanLog, ScanOptions, Selection};
use mean_information_files::{Error, ErrorKind, Place, Warning, read_scans as read_file};
use mean_information_test_support::formats::pbstream::{
    cloud, double, first_record, graph, integer, message, node, rigid, state,
};
use mean_information_test_support::formats::shared_data;

/// 7.5 s after the beginning of 1970.
const TIME: u64 = 621_355_968_075_000_000;
/// (0.003, 0.004), and (-1.024, 0.001): two blocks.
const POINTS: [i32; 10] = [1, 0, 0, 0, 3 + (4 << 10), 1, -1, 0, 0, 1 << 10];

fn log(bytes: &[u8], selection: &Selection) -> Result<ScanLog, Error> {
    read_scans(bytes, bytes.len() as u64, &ScanOptions::default(), selection)
}

fn refused(records: &[Vec<u8>]) -> (Error, String) {
    let error = log(&state(records), &Selection::default()).unwrap_err();
    let line = error.to_string();
    (error, line)
}

/// A state of two nodes of two trajectories.
pub(crate) fn seed() -> Vec<u8> {
    let parts =
        [rigid(7, [1.0, 2.0, 0.5], LEFT), cloud(3, 2, &POINTS), message(2, &[&double(4, 1.0)])].concat();
    let graph = graph(2, &[(6, [5.0, 2.0, 0.5], AHEAD)]);
    state(&[graph, node([2, 6], TIME, &[&parts]), node([3, 0], TIME + 9, &[&parts])])
}

#[test]
fn a_real_state_has_the_scans_of_another_decoder() {
    let Some(data) = shared_data() else { return };
    let path = data.join("cartographer/JFR_racingv5.pbstream");
    let log = read_file(&path, &ScanOptions::default()).unwrap();
    let points: usize = log.scans.iter().map(|scan| scan.ranges().len()).sum();
    assert_eq!((log.scans.len(), points), (860, 178_462));
    let farthest = log.scans.iter().flat_map(RangeScan::ranges).fold(0.0, |a: f64, &b| a.max(b));
    // The far point lies on the grid; its coordinates are in single precision.
    assert!((farthest - 24.832_387_742_623_545).abs() < 2e-6, "{farthest}");
    // -1.034, -1.559
    let first = (log.scans[0].ranges()[0], log.scans[0].bearings().at(0));
    assert!((first.0 - 1.870_732).abs() < 1e-6 && (first.1 + 2.156_427).abs() < 1e-6, "{first:?}");
    assert_eq!(
        [0, 859].map(|scan: usize| log.scans[scan].time()),
        [1_705_573_668.914_947, 1_705_573_766.716_700_5]
    );
    let names: Vec<_> = log.trajectories.iter().map(|held| (&*held.name, held.trajectory.len())).collect();
    assert_eq!(names, [("local", 860), ("global", 860)]);
    // The orientation of node 500, turned back by that of gravity: 2 atan2(0.8302, -0.5574) - 2 atan2(0.7648, -0.6443).
    let expected = [[-5.877_026_43, 0.165_202_01, -0.217_655], [-5.894_369_09, 0.162_406_50, -0.219_239]];
    for (held, [x, y, yaw]) in log.trajectories.iter().zip(expected) {
        let pose = held.trajectory.poses()[500];
        let apart = [pose.position()[0] - x, pose.position()[1] - y, pose.theta() - yaw];
        assert!(apart.iter().all(|apart| apart.abs() < 1e-6), "{pose:?}");
        assert_eq!(held.warnings, []);
    }
    assert_eq!(log.warnings, [Warning::CloudsThinned]);
}

#[test]
fn a_node_is_a_scan_with_two_poses() {
    let parts = [rigid(7, [1.0, 2.0, 0.5], LEFT), cloud(3, 2, &POINTS), message(2, &[&double(4, 1.0)])];
    let parts: Vec<&[u8]> = parts.iter().map(|part| &**part).collect();
    // Of the second the tracking frame is turned to the left when it is upright.
    let upright = message(2, &[&double(3, HALF), &double(4, HALF)]);
    let left = [rigid(7, [3.0, 2.0, 0.5], LEFT), cloud(3, 2, &POINTS), upright];
    let left: Vec<&[u8]> = left.iter().map(|part| &**part).collect();
    let bytes = state(&[
        graph(4, &[(6, [5.0, 2.0, 0.5], AHEAD)]),
        node([4, 6], TIME, &parts),
        node([4, 7], TIME + 5_000_000, &left),
    ]);
    let found = log(&bytes, &Selection::default()).unwrap();
    assert_eq!(found.times(), [7.5, 8.0]);
    let scan = &found.scans[0];
    let [near, far] = [(0.003_f32, 0.004_f32), (-1.024, 0.001)].map(|(x, y)| (f64::from(x), f64::from(y)));
    assert_eq!(scan.ranges(), [libm::hypot(near.0, near.1), libm::hypot(far.0, far.1)]);
    assert_eq!([0, 1].map(|beam| scan.bearings().at(beam)), [near, far].map(|(x, y)| libm::atan2(y, x)));
    assert!(scan.readings().all(|reading| matches!(reading, Reading::Return(_))));
    let [local, global] = &*found.trajectories else { panic!("{:?}", found.trajectories) };
    assert_eq!((&*local.name, &*global.name, global.trajectory.len()), ("local", "global", 1));
    assert_pose(&local.trajectory.poses()[0], [1.0, 2.0, std::f64::consts::FRAC_PI_2]);
    assert_pose(&local.trajectory.poses()[1], [3.0, 2.0, 0.0]);
    assert_pose(&global.trajectory.poses()[0], [5.0, 2.0, 0.0]);
    // From a laser one metre behind, turned to the left.
    let mount = Pose::new(-1.0, 0.0, std::f64::consts::FRAC_PI_2).unwrap();
    let found = log(&bytes, &Selection { mount: Some(mount), ..Selection::default() }).unwrap();
    assert_eq!(found.mount, Some(mount));
    let (range, bearing) = (found.scans[0].ranges()[0], found.scans[0].bearings().at(0));
    assert!((range - 1.003_008).abs() < 1e-6 && (bearing + 1.566_808).abs() < 1e-6, "{range} {bearing}");
}

#[test]
fn several_trajectories_and_nodes_without_points() {
    let full = cloud(3, 2, &POINTS);
    let records = [
        node([0, 0], TIME, &[&full]),
        node([1, 0], TIME, &[&full]),
        node([1, 1], TIME, &[&full]),
        node([1, 2], TIME, &[]),
    ];
    let (error, line) = refused(&records);
    assert_eq!(error.kind(), ErrorKind::Choice);
    assert_eq!(line, "has scans of several trajectories; its trajectories are: 0 (1 scans), 1 (3 scans)");
    let of = |trajectory| Selection { trajectory: Some(trajectory), ..Selection::default() };
    let found = log(&state(&records), &of(1)).unwrap();
    let counts = [Warning::ScansAtOneTime { count: 1 }, Warning::ScansWithoutBeams { count: 1 }];
    assert_eq!((found.scans.len(), &found.warnings[1..]), (1, &counts[..]));
    assert_eq!(found.trajectories.len(), 1);
    assert!(
        log(&state(&records), &of(2)).unwrap_err().to_string().starts_with("has no scan of a trajectory 2; ")
    );
    let (_, line) = refused(&[]);
    assert_eq!(line, "has no scans: it was saved without nodes; its trajectories are: none");
}

#[test]
fn nodes_that_are_none() {
    let bad = rigid(7, [f64::NAN, 0.0, 0.0], AHEAD);
    let dim = rigid(7, [0.0; 3], [0.5, 0.0, 0.0, 0.5]);
    for (parts, kind, words) in [
        (cloud(3, 2, &POINTS[..9]), ErrorKind::Format, "node 0, 3: has a block of 1 points, but 0 are left"),
        (cloud(3, 3, &POINTS), ErrorKind::Format, "node 0, 3: has a cloud of 2 points that claims 3"),
        (
            cloud(3, 1, &[1, 1 << 13, 0, 0, 1]),
            ErrorKind::OutOfRange,
            "node 0, 3: a coordinate of a cloud, in millimetres, is 8388609",
        ),
        (
            cloud(3, 1, &[-1, 0, 0, 0, 1]),
            ErrorKind::Format,
            "node 0, 3: has a block of -1 points, but 1 are left",
        ),
        (
            cloud(4, 2, &POINTS),
            ErrorKind::Unsupported,
            "node 0, 3: is a scan in three dimensions; allowed are scans in the plane",
        ),
        (
            message(3, &[&integer(3, 1 << 32)]),
            ErrorKind::OutOfRange,
            "an integer of a cloud is 4294967296, allowed is",
        ),
        (bad, ErrorKind::OutOfRange, "a position is NaN, 0, 0, allowed is finite"),
        (dim, ErrorKind::OutOfRange, "the length of a quaternion is 0.70710678"),
    ] {
        let (error, line) = refused(&[node([0, 3], TIME, &[&parts])]);
        let first = first_record();
        assert_eq!((error.kind(), error.place()), (kind, Some(&Place::Byte(first))), "{line}");
        assert!(line.starts_with(&format!("record at byte {first}: {words}")), "{line}");
    }
    let full = cloud(3, 2, &POINTS);
    let (_, line) = refused(&[node([0, 3], TIME, &[&full]), node([0, 3], TIME + 1, &[&full])]);
    assert!(line.ends_with("node 0, 3: is there twice"), "{line}");
    let (_, line) = refused(&[node([0, 3], TIME, &[&full]), node([0, 4], TIME - 1, &[&full])]);
    assert!(
        line.starts_with("node 0, 4: time is 7.4999999, allowed is a time above the one before, 7.5 s"),
        "{line}"
    );
}
