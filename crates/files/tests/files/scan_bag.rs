//! The messages of a bag with a robot and its laser.

use mean_information::scan::Pose;
use mean_information_files::bags::{read_stream, scans_of};
use mean_information_files::scans::{ScanLog, ScanOptions, Selection};
use mean_information_files::{Error, Options};
use mean_information_test_support::formats::bag::{Writer, mcap_of};

pub(crate) const SCAN: u16 = 1;
pub(crate) const TF: u16 = 2;
pub(crate) const STATIC: u16 = 3;
pub(crate) const ODOM: u16 = 4;
pub(crate) const POSE: u16 = 5;
pub(crate) const AMCL: u16 = 6;
pub(crate) const TOPICS: [(u16, &str, &str); 6] = [
    (SCAN, "/scan", "sensor_msgs/msg/LaserScan"),
    (TF, "/tf", "tf2_msgs/msg/TFMessage"),
    (STATIC, "/tf_static", "tf2_msgs/msg/TFMessage"),
    (ODOM, "/odom", "nav_msgs/msg/Odometry"),
    (POSE, "/pose", "geometry_msgs/msg/PoseStamped"),
    (AMCL, "/amcl_pose", "geometry_msgs/msg/PoseWithCovarianceStamped"),
];
pub(crate) const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;
pub(crate) const AHEAD: [f64; 4] = [0.0, 0.0, 0.0, 1.0];
/// A quarter turn to the left.
pub(crate) const LEFT: [f64; 4] = [0.0, 0.0, HALF, HALF];

pub(crate) fn log_with(
    encoding: &str,
    messages: &[(u16, Vec<u8>)],
    selection: &Selection,
) -> Result<ScanLog, Error> {
    let bytes = mcap_of(encoding, &TOPICS, messages);
    log_of(&bytes, selection)
}

pub(crate) fn log_of(bytes: &[u8], selection: &Selection) -> Result<ScanLog, Error> {
    let options = Options::default();
    scans_of(
        |visitor| read_stream(bytes, bytes.len() as u64, &options, visitor),
        &ScanOptions::default(),
        selection,
    )
}

pub(crate) fn log(messages: &[(u16, Vec<u8>)]) -> Result<ScanLog, Error> {
    log_with("cdr", messages, &Selection::default())
}

pub(crate) fn named(frames: &[&str], pose_topics: &[&str]) -> Selection {
    let owned = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect();
    Selection { frames: Some(owned(frames)), pose_topics: owned(pose_topics), ..Selection::default() }
}

/// Asserts a pose within a dozen roundings.
pub(crate) fn assert_pose(pose: &Pose, expected: [f64; 3]) {
    let [x, y] = pose.position();
    let apart = [x - expected[0], y - expected[1], pose.theta() - expected[2]];
    assert!(apart.iter().all(|x| x.abs() < 1e-14), "{pose:?} {expected:?}");
}

/// Seconds and nanoseconds of quarters of a second.
fn stamp(quarters: u32) -> [u32; 2] {
    [quarters / 4, quarters % 4 * 250_000_000]
}

/// A transform: its time in quarters of a second, the two frames, the position, the orientation.
pub(crate) type Transform<'a> = (u32, &'a str, &'a str, [f64; 3], [f64; 4]);

/// Writes messages in one serialisation.
#[derive(Clone, Copy)]
pub(crate) struct Bag {
    pub(crate) big_endian: bool,
    pub(crate) ros1: bool,
}

pub(crate) const PLAIN: Bag = Bag { big_endian: false, ros1: false };

impl Bag {
    pub(crate) fn scan_of(
        self,
        quarters: u32,
        frame: &str,
        [start, step, between]: [f32; 3],
        ranges: &[f32],
    ) -> (u16, Vec<u8>) {
        let mut writer = Writer::new(self.big_endian, self.ros1);
        writer.header(stamp(quarters), frame);
        writer.floats(&[start, 77.0, step, between, 0.125, 0.0625, 8.0]);
        writer.number((ranges.len() as u32).to_le_bytes());
        writer.floats(ranges);
        writer.number(0_u32.to_le_bytes());
        (SCAN, writer.bytes)
    }

    pub(crate) fn scan(self, quarters: u32) -> (u16, Vec<u8>) {
        self.scan_of(quarters, "laser", [-0.5, 0.25, 0.0], &[1.5, 2.5, 3.5])
    }

    pub(crate) fn tf(self, topic: u16, transforms: &[Transform<'_>]) -> (u16, Vec<u8>) {
        let mut writer = Writer::new(self.big_endian, self.ros1);
        writer.number((transforms.len() as u32).to_le_bytes());
        for (quarters, frame, child, position, turn) in transforms {
            writer.header(stamp(*quarters), frame);
            writer.name(child);
            writer.doubles(position);
            writer.doubles(turn);
        }
        (topic, writer.bytes)
    }

    pub(crate) fn pose(
        self,
        topic: u16,
        quarters: u32,
        child: &str,
        [x, y]: [f64; 2],
        turn: [f64; 4],
    ) -> (u16, Vec<u8>) {
        let mut writer = Writer::new(self.big_endian, self.ros1);
        writer.header(stamp(quarters), "odom");
        if topic == ODOM {
            writer.name(child);
        }
        writer.doubles(&[x, y, 0.5]);
        writer.doubles(&turn);
        if topic != POSE {
            writer.doubles(&[0.25; 36]);
        }
        (topic, writer.bytes)
    }

    /// The laser on the robot, half a metre ahead.
    pub(crate) fn mount(self) -> (u16, Vec<u8>) {
        self.tf(STATIC, &[(0, "base", "laser", [0.5, 0.0, 0.25], AHEAD)])
    }

    /// The robot in two frames, at 5 and at 6 s.
    pub(crate) fn moving(self) -> (u16, Vec<u8>) {
        let map = |quarters| (quarters, "map", "odom", [10.0, 20.0, 0.0], LEFT);
        let odom = |quarters, x| (quarters, "odom", "base", [x, 2.0, 0.0], AHEAD);
        self.tf(TF, &[map(20), odom(20, 1.0), map(24), odom(24, 3.0)])
    }
}

/// A bag of all messages.
pub(crate) fn seed(encoding: &str, ros1: bool) -> Vec<u8> {
    let bag = Bag { big_endian: !ros1, ros1 };
    let messages = [
        bag.scan(22),
        bag.scan_of(23, "laser", [1.0, -0.25, 0.015625], &[1.5, f32::INFINITY, f32::NAN]),
        bag.moving(),
        bag.pose(ODOM, 20, "base", [1.0, 2.0], AHEAD),
        bag.pose(ODOM, 24, "base", [3.0, 2.0], LEFT),
        bag.pose(POSE, 22, "", [7.0, 8.0], LEFT),
        bag.pose(AMCL, 22, "", [9.0, 8.0], LEFT),
        bag.mount(),
    ];
    mcap_of(encoding, &TOPICS, &messages)
}
