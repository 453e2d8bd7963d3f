//! Where the laser of a bag is, and which way up: by TF that does not move, by TF that does, and by what is given.

use crate::scan_bag::{AHEAD, HALF, LEFT, ODOM, PLAIN, POSE, STATIC, TF, assert_pose, log, log_with, named};
use mean_information::scan::Pose;
use mean_information_files::scans::{Frame, ScanLog, Selection};
use mean_information_files::{ErrorKind, Warning};

/// Half a turn about x.
const OVER: [f64; 4] = [1.0, 0.0, 0.0, 0.0];
/// The bearings of a scan whose laser is upright, and upside down.
const UP: [f64; 3] = [-0.5, -0.25, 0.0];
const DOWN: [f64; 3] = [0.5, 0.25, 0.0];

fn bearings(log: &ScanLog) -> [f64; 3] {
    [0, 1, 2].map(|beam| log.scans[0].bearings().at(beam))
}

/// The laser on the robot by `/tf`, at 5 and at 6 s.
fn moving_laser(turns: [[f64; 4]; 2]) -> (u16, Vec<u8>) {
    let [first, last] = turns;
    PLAIN.tf(
        TF,
        &[(20, "base", "laser", [0.5, 0.0, 0.0], first), (24, "base", "laser", [0.5, 0.0, 0.0], last)],
    )
}

fn mounted(mount: Pose) -> Selection {
    Selection { mount: Some(mount), ..Selection::default() }
}

#[test]
fn a_laser_upside_down_has_its_bearings_turned() {
    // Half round about x; then, on the robot, a quarter to the left.
    let down = PLAIN.tf(STATIC, &[(0, "base", "laser", [0.5, 0.25, 0.0], [HALF, HALF, 0.0, 0.0])]);
    let found = log(&[down, PLAIN.scan(22), PLAIN.moving()]).unwrap();
    assert_pose(&found.mount.unwrap(), [0.5, 0.25, std::f64::consts::FRAC_PI_2]);
    assert_eq!([0, 2].map(|beam| found.scans[0].bearings().at(beam)), [0.5, 0.0]);
    assert_eq!(found.warnings, []);
    // 2 atan(0.1) = 11.42 degrees of pitch.
    let pitched = PLAIN.tf(STATIC, &[(0, "base", "laser", [0.5, 0.25, 0.0], [0.0, 0.0995, 0.0, 0.995])]);
    let found = log(&[pitched, PLAIN.scan(22), PLAIN.moving()]).unwrap();
    let [Warning::LaserTilted { degrees }] = *found.warnings else { panic!("{:?}", found.warnings) };
    assert!((degrees - 11.42).abs() < 0.01, "{degrees}");
    assert_eq!(found.scans[0].bearings().at(0), -0.5);
}

#[test]
fn a_laser_upside_down_is_turned_where_its_mount_is_given() {
    let mount = Pose::new(0.125, 0.0, 0.25).unwrap();
    let fixed = |turn| PLAIN.tf(STATIC, &[(0, "base", "laser", [0.5, 0.25, 0.0], turn)]);
    for (turn, expected) in [(OVER, DOWN), (AHEAD, UP)] {
        let messages = [fixed(turn), PLAIN.scan(22), PLAIN.moving()];
        let found = log_with("cdr", &messages, &mounted(mount)).unwrap();
        assert_eq!((found.mount, bearings(&found)), (Some(mount), expected));
        // The frame of the robot is named, and TF moves the laser in it.
        let messages = [moving_laser([turn; 2]), PLAIN.scan(22), PLAIN.moving()];
        let base = Selection { base: Some("base".to_owned()), ..mounted(mount) };
        let found = log_with("cdr", &messages, &base).unwrap();
        assert_eq!((found.mount, bearings(&found)), (Some(mount), expected));
        assert_pose(&found.trajectories[1].trajectory.poses()[0], [2.0, 2.0, 0.0]);
    }
    // Without TF it is to be said; with it, it turns once.
    let messages = [PLAIN.scan(22), PLAIN.pose(POSE, 22, "", [7.0, 8.0], LEFT)];
    for (upside_down, expected) in [(false, UP), (true, DOWN)] {
        let selection = Selection { upside_down, ..named(&[], &["/pose"]) };
        assert_eq!(bearings(&log_with("cdr", &messages, &selection).unwrap()), expected);
    }
    let told = Selection { upside_down: true, ..Selection::default() };
    let found = log_with("cdr", &[fixed(OVER), PLAIN.scan(22), PLAIN.moving()], &told).unwrap();
    assert_eq!(bearings(&found), DOWN);
}

#[test]
fn a_laser_that_tf_moves_has_its_own_poses() {
    for (turn, expected) in [(OVER, DOWN), (AHEAD, UP)] {
        let messages = [moving_laser([turn; 2]), PLAIN.scan(22), PLAIN.moving()];
        let found = log(&messages).unwrap();
        assert_eq!((found.mount, bearings(&found)), (None, expected));
        let [map, odom] = &*found.trajectories else { panic!("{found:?}") };
        assert_eq!((map.frame, odom.frame), (Frame::Laser, Frame::Laser));
        assert_pose(&odom.trajectory.poses()[0], [2.5, 2.0, 0.0]);
        // A laser that is upside down lies in the plane.
        assert_eq!((&*map.warnings, &*odom.warnings), (&[][..], &[][..]));
    }
    let turning = [moving_laser([AHEAD, OVER]), PLAIN.scan(20), PLAIN.scan(24), PLAIN.moving()];
    let error = log(&turning).unwrap_err();
    let line =
        "TF has the laser upright at 5 s and upside down at 6 s; allowed is a laser that does not turn over";
    assert_eq!((error.kind(), &*error.to_string()), (ErrorKind::Unsupported, line));
}

/// The mount that is given is on a robot, and not once more on the laser itself.
#[test]
fn a_mount_is_not_applied_to_poses_of_the_laser() {
    let mount = Pose::new(3.0, 0.0, 0.5).unwrap();
    let messages = [
        moving_laser([AHEAD; 2]),
        PLAIN.scan(22),
        PLAIN.moving(),
        PLAIN.pose(ODOM, 22, "base", [4.0, 3.0], AHEAD),
        PLAIN.pose(POSE, 22, "", [7.0, 8.0], LEFT),
    ];
    let selection = Selection { mount: Some(mount), ..named(&["map", "odom"], &["/odom", "/pose"]) };
    let found = log_with("cdr", &messages, &selection).unwrap();
    assert_eq!(found.mount, Some(mount));
    let frames: Vec<_> = found.trajectories.iter().map(|held| held.frame).collect();
    assert_eq!(frames, [Frame::Laser, Frame::Laser, Frame::Robot, Frame::Robot]);
    let noticed: Vec<_> = found.trajectories.iter().map(|held| held.warnings.clone()).collect();
    assert_eq!(noticed, [vec![Warning::PosesOfLaser], vec![Warning::PosesOfLaser], vec![], vec![]]);
    assert_pose(&found.trajectories[1].trajectory.poses()[0], [2.5, 2.0, 0.0]);
    assert_pose(&found.trajectories[2].trajectory.poses()[0], [4.0, 3.0, 0.0]);
    // Where the laser is carried, it is on the robot.
    let carried = [PLAIN.mount(), PLAIN.scan(22), PLAIN.moving()];
    let found = log_with("cdr", &carried, &mounted(mount)).unwrap();
    assert!(found.trajectories.iter().all(|held| held.frame == Frame::Robot && held.warnings.is_empty()));
}

/// tf2 has a frame move from the first message of `/tf` that has it.
#[test]
fn a_frame_that_is_static_and_moving_moves() {
    let (fixed, moving) = (PLAIN.mount(), moving_laser([LEFT; 2]));
    let rest = [PLAIN.scan(22), PLAIN.moving()];
    for messages in [[fixed.clone(), moving.clone()], [moving, fixed]] {
        let found = log(&[&messages[..], &rest].concat()).unwrap();
        assert_eq!(found.warnings, [Warning::FrameStaticAndMoving { frame: "laser".to_owned() }]);
        assert_eq!((found.mount, found.trajectories[1].frame), (None, Frame::Laser));
        let quarter = std::f64::consts::FRAC_PI_2;
        assert_pose(&found.trajectories[1].trajectory.poses()[0], [2.5, 2.0, quarter]);
    }
}
