//! The laser of a log: where it is on the robot, and how far it sees.

use crate::output::Value;
use mean_information::scan::Pose;
use mean_information_files::scans::RangeScan;

/// The laser whose scans a log has.
#[derive(Clone, Debug)]
pub struct Laser {
    /// The pose on the robot whose poses are given.
    pub mount: Pose,
    /// The same in words, with where it is from.
    pub in_words: String,
    /// The range from which on a beam did not return, the greatest of all scans, in metres.
    pub max_range: f64,
}

impl Laser {
    /// Creates the laser of some scans.
    pub fn new<'a>(
        (mount, in_words): (Pose, String),
        scans: impl IntoIterator<Item = &'a RangeScan>,
    ) -> Self {
        let max_range = scans.into_iter().map(|scan| scan.limits()[1]).fold(0.0, f64::max);
        Self { mount, in_words, max_range }
    }

    /// Returns the entries of a record: the greatest range, and the pose on the robot.
    pub fn entries(&self) -> [(&'static str, Value); 4] {
        let ([x, y], yaw) = (self.mount.position(), self.mount.theta());
        [("max_range_m", self.max_range), ("mount_x_m", x), ("mount_y_m", y), ("mount_yaw_rad", yaw)]
            .map(|(key, number)| (key, Value::Given(Some(number))))
    }
}
