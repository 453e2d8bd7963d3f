//! Trajectories: TUM text, the pose at a time, and the real ones of a public log.

use approx::{abs_diff_eq, assert_abs_diff_eq};
use mean_information::scan::Pose;
use mean_information_files::scans::ScanOptions;
use mean_information_files::{
    Error, ErrorKind, Place, Trajectory, Warning, read_scans, read_trajectory, tum,
};
use mean_information_test_support::formats::{Folder, shared_data};
use std::f64::consts::{FRAC_PI_2, PI};

fn read(text: &str) -> Result<(Trajectory, Vec<Warning>), Error> {
    tum::read(text.as_bytes())
}

fn pose(x: f64, y: f64, theta: f64) -> Pose {
    Pose::new(x, y, theta).unwrap()
}

#[test]
fn comments_and_any_spacing_are_read() {
    let text =
        "\u{feff}# time x y z qx qy qz qw\r\n\r\n 1.5\t2.5  -3.5 0.25 0 0 0 1 \r\n#\n2.5 1 2 0 0 0 1 0";
    let (trajectory, warnings) = read(text).unwrap();
    assert_eq!((trajectory.times(), trajectory.len(), warnings), (&[1.5, 2.5][..], 2, vec![]));
    assert_eq!(trajectory.poses(), [pose(2.5, -3.5, 0.0), pose(1.0, 2.0, PI)]);
}

/// The yaw of a quaternion of any length and sign, against its angle; pitch and roll leave it.
#[test]
fn a_quaternion_becomes_its_yaw() {
    for n in -31..=31 {
        let yaw = 0.1 * f64::from(n);
        for length in [0.99, -1.01] {
            let (z, w) = (length * libm::sin(yaw / 2.0), length * libm::cos(yaw / 2.0));
            let (trajectory, warnings) = read(&format!("0.5 1 2 3 0 0 {z} {w}\n")).unwrap();
            let theta = trajectory.poses()[0].theta();
            assert_abs_diff_eq!(theta, yaw, epsilon = 1e-15);
            assert_eq!(warnings, []);
        }
    }
    // Yaw 0.75, then a pitch of 2 degrees: the product of (0, 0, s, c) and (0, t, 0, u).
    let (s, c) = (libm::sin(0.375), libm::cos(0.375));
    let (t, u) = (libm::sin(PI / 180.0), libm::cos(PI / 180.0));
    let text = format!("0.5 1 2 3 {} {} {} {}\n0.75 1 2 3 0 0 0 1\n", -s * t, c * t, s * u, c * u);
    let (trajectory, warnings) = read(&text).unwrap();
    assert_abs_diff_eq!(trajectory.poses()[0].theta(), 0.75, epsilon = 1e-15);
    let [Warning::TiltDropped { count: 1, greatest_degrees }] = warnings[..] else { panic!("{warnings:?}") };
    assert_abs_diff_eq!(greatest_degrees, 2.0, epsilon = 1e-12);
    assert!(warnings[0].to_string().contains("up to 2.0"), "{}", warnings[0]);
}

/// A robot that turns round and round, and a camera that looks along its heading.
#[test]
fn the_order_of_quaternions_is_asked_for() {
    let text = |quaternion: fn([f64; 2]) -> [f64; 4]| {
        let line = |k: i32| {
            let yaw = 0.11 * f64::from(k);
            let [a, b, c, d] = quaternion([libm::sin(yaw / 2.0), libm::cos(yaw / 2.0)]);
            format!("{k} 1 2 3 {a} {b} {c} {d}\n")
        };
        (0..200).map(line).collect::<String>()
    };
    let asked = |quaternion| {
        let (_, warnings) = read(&text(quaternion)).unwrap();
        warnings.into_iter().find(|warning| matches!(warning, Warning::MostTiltedFar { .. }))
    };
    let found = asked(|[sin, cos]| [cos, 0.0, 0.0, sin]).unwrap();
    let Warning::MostTiltedFar { count, poses: 200, w_first: true } = found else { panic!("{found:?}") };
    // Three quarters of all headings.
    assert!((140..160).contains(&count), "{count}");
    let words = "poses are tilted by more than 45 degrees, but not if w comes first: the quaternions seem to be qw qx qy qz";
    assert!(found.to_string().contains(words), "{found}");
    // z along the heading, x to the right.
    let camera = asked(|[s, c]| [-0.5 * (c + s), 0.5 * (c - s), 0.5 * (s - c), 0.5 * (c + s)]).unwrap();
    assert!(matches!(camera, Warning::MostTiltedFar { count: 200, w_first: false, .. }), "{camera:?}");
    assert!(camera.to_string().contains("as in the frame of a camera"), "{camera}");
    // The right order, and a pitch of 20 degrees.
    assert_eq!(asked(|[sin, cos]| [0.0, 0.0, sin, cos]), None);
    assert_eq!(asked(|[s, c]| [-0.17365 * s, 0.17365 * c, 0.98481 * s, 0.98481 * c]), None);
}

#[test]
fn what_is_no_trajectory_is_refused_by_its_line() {
    let good = "1.5 2 3 0 0 0 0 1\n";
    for (line, kind, words) in [
        (
            "1.5 2 3 0 0 0 0 1\n",
            ErrorKind::OutOfRange,
            "line 2: time is 1.5, allowed is a time above the one before, 1.5 s: times ascend",
        ),
        (
            "2.5 2 3 0 0 0 0 0.5\n",
            ErrorKind::OutOfRange,
            "the length of the quaternion in line 2 is 0.5, allowed is 1, within 0.02",
        ),
        ("2.5 2 nan 0 0 0 0 1\n", ErrorKind::OutOfRange, "y in line 2 is NaN, allowed is a finite number"),
        ("2.5 2 3 0 0 0 1\n", ErrorKind::Format, "line 2 ends before qw"),
        (
            "2.5 2 3 0 0 0 0 1 7\n",
            ErrorKind::Format,
            "line 2 has more than eight fields; allowed is `time x y z qx qy qz qw`",
        ),
        (
            "2.5,2,3,0,0,0,0,1\n",
            ErrorKind::Format,
            "time in line 2 is `2.5,2,3,0,0,0,0,1`, allowed is a number",
        ),
    ] {
        let refused = read(&[good, line].concat()).unwrap_err();
        let found = (refused.kind(), refused.place(), refused.to_string());
        assert_eq!(found, (kind, Some(&Place::Line(2)), words.to_owned()));
    }
    let refused = read("# nothing\n").unwrap_err();
    assert_eq!(refused.to_string(), "holds no pose; allowed are lines of `time x y z qx qy qz qw`");
    assert!(Trajectory::new(vec![], vec![]).is_err());
    assert!(Trajectory::new(vec![0.5], vec![]).is_err());
    assert!(Trajectory::new(vec![f64::NAN], vec![pose(1.0, 2.0, 3.0)]).is_err());
}

#[test]
fn a_text_cut_in_mid_line_is_read_to_its_last_whole_line() {
    let (trajectory, warnings) = read("1.5 2 3 0 0 0 0 1\n2.5 2 3 0 0 0 ").unwrap();
    assert_eq!((trajectory.len(), warnings), (1, vec![Warning::CutInLine { line: 2 }]));
}

#[test]
fn poses_are_interpolated_within_the_gap_and_never_beyond() {
    let poses = vec![pose(1.0, -2.0, 3.0), pose(2.0, 2.0, -3.0), pose(2.0, 2.0, 7.0)];
    let trajectory = Trajectory::new(vec![10.0, 10.5, 12.5], poses.clone()).unwrap();
    let at = |time, gap| trajectory.pose_at(time, gap);
    // The pose of its own time, exactly, whatever the gap.
    for (time, own) in [10.0, 10.5, 12.5].into_iter().zip(&poses) {
        assert_eq!(at(time, 0.0), Some(*own));
    }
    let quarter = at(10.125, 0.5).unwrap();
    assert_eq!(quarter.position(), [1.25, -1.0]);
    // From 3 over π to -3, which is 2π - 6 away.
    assert_abs_diff_eq!(quarter.theta(), 3.0 + 0.25 * (2.0 * PI - 6.0), epsilon = 4e-15);
    assert_eq!((at(10.125, 0.499), at(11.5, 1.999)), (None, None));
    // From -3 to 7, whole turns taken off: 10 - 4π.
    let middle = at(11.5, 2.0).unwrap().theta();
    assert_abs_diff_eq!(middle, -3.0 + 0.5 * (10.0 - 4.0 * PI), epsilon = 4e-15);
    assert_eq!((at(9.999, f64::INFINITY), at(12.501, f64::INFINITY)), (None, None));
    assert_eq!((at(f64::NAN, 2.0), at(11.0, f64::NAN)), (None, None));

    let found = trajectory.at_times(&[9.0, 10.0, 10.25, 11.0, 12.5, 13.0], 0.5).unwrap();
    let have: Vec<_> = found.poses.iter().map(Option::is_some).collect();
    assert_eq!((have, found.without_pose), (vec![false, true, true, false, true, false], 3));
    let refused = trajectory.at_times(&[976_052_890.25, 976_052_891.5], 0.5).unwrap_err();
    let words = "the trajectory spans 10 to 12.5 s, the scans span 976052890.25 to 976052891.5 s; allowed are times in \
                 common, on one clock";
    assert_eq!((refused.kind(), refused.to_string().as_str()), (ErrorKind::OutOfRange, words));
}

#[test]
fn numbers_near_the_largest_are_interpolated_too() {
    let far = f64::MAX;
    let poses = vec![pose(-far, far, far), pose(far, far, -far)];
    let trajectory = Trajectory::new(vec![-far, far], poses).unwrap();
    let middle = trajectory.pose_at(0.0, f64::INFINITY).unwrap();
    assert_eq!(middle.position(), [0.0, far]);
}

#[test]
fn a_mount_turns_with_the_robot() {
    let robot = Trajectory::new(vec![0.5], vec![pose(1.0, 2.0, FRAC_PI_2)]).unwrap();
    let laser = robot.mounted(&pose(0.25, -0.5, 0.125)).unwrap().poses()[0];
    let [x, y] = laser.position();
    assert!(abs_diff_eq!(x, 1.5, epsilon = 1e-15) && abs_diff_eq!(y, 2.25, epsilon = 1e-15), "{laser:?}");
    assert_eq!(laser.theta(), FRAC_PI_2 + 0.125);
    let far = Trajectory::new(vec![0.5, 0.75], vec![pose(1.0, 2.0, 0.0), pose(f64::MAX, 0.0, 0.0)]).unwrap();
    let refused = far.mounted(&pose(f64::MAX, 0.0, 0.0)).unwrap_err();
    assert_eq!(refused.place(), Some(&Place::Item(1)));
}

/// Times and positions come back as they are, yaws within the stated `2^-49`.
#[test]
fn what_is_written_is_read() {
    let count = 500;
    let times: Vec<f64> = (0..count).map(|k| 976_052_890.25 + 0.3 * f64::from(k)).collect();
    let poses: Vec<_> = (0..count)
        .map(|k| {
            let k = f64::from(k);
            pose(0.1 * k - 3.7, 1e-7 * k, libm::remainder(0.7 * k, 2.0 * PI))
        })
        .collect();
    let trajectory = Trajectory::new(times, poses).unwrap();
    let mut text = Vec::new();
    tum::write(&trajectory, "two\nlines", &mut text).unwrap();
    assert!(text.starts_with(b"# two\n# lines\n# time x"));
    let (read, warnings) = tum::read(&text[..]).unwrap();
    assert_eq!((read.times(), warnings), (trajectory.times(), vec![]));
    for (own, read) in trajectory.poses().iter().zip(read.poses()) {
        assert_eq!(own.position(), read.position());
        assert_abs_diff_eq!(own.theta(), read.theta(), epsilon = libm::ldexp(1.0, -49));
    }
}

/// The Intel log: 910 scans of 180 beams; the poses in it are those of the TUM files to 6 digits, yaw through a quaternion.
#[test]
fn a_public_log_and_its_trajectories() {
    let Some(data) = shared_data().map(|data| data.join("slam")) else { return };
    if !data.is_dir() {
        println!("skipped: {} is absent", data.display());
        return;
    }
    let log = read_scans(&data.join("intel.log"), &ScanOptions::default()).unwrap();
    assert_eq!((log.scans.len(), &log.warnings, log.mount), (910, &vec![], None));
    assert!(log.scans.iter().all(|scan| scan.ranges().len() == 180 && scan.limits() == [0.0, 50.0]));
    for (held, file) in log.trajectories.iter().zip(["intel.slam.tum", "intel.odometry.tum"]) {
        let (trajectory, warnings) = read_trajectory(&data.join(file)).unwrap();
        assert_eq!(warnings, []);
        assert_eq!(trajectory.times(), held.trajectory.times(), "{file}");
        for (own, other) in held.trajectory.poses().iter().zip(trajectory.poses()) {
            let ([x, y], [u, v]) = (own.position(), other.position());
            let turn = libm::remainder(own.theta() - other.theta(), 2.0 * PI);
            for (difference, size) in [(x - u, x), (y - v, y), (turn, 1.0)] {
                assert!(difference.abs() <= 1e-6 * size.abs().max(1.0), "{file} {own:?} {other:?}");
            }
        }
        let found = trajectory.at_times(&log.times(), 0.0).unwrap();
        assert_eq!(found.without_pose, 0);
        assert_eq!(found.poses.into_iter().flatten().collect::<Vec<_>>(), trajectory.poses());
    }
    // Half of the file, cut in mid-line.
    let bytes = std::fs::read(data.join("intel.log")).unwrap();
    let folder = Folder::new();
    let half = folder.write("half.log", &bytes[..bytes.len() / 2]);
    let half = read_scans(&half, &ScanOptions::default()).unwrap();
    assert_eq!(half.scans[..], log.scans[..half.scans.len()]);
    assert_eq!(half.warnings, [Warning::CutInLine { line: half.scans.len() as u64 + 2 }]);
}
