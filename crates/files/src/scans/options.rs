//! How logs of scans are read.

use mean_information::scan::Pose;

/// The greatest range, in metres, of a sensor that has none: no laser sees as far.
pub(crate) const FARTHEST: f64 = 20_000.0;

/// The options of the readers of scans. The default is everything as the file says. A release may add fields, as to
/// [`Options`](crate::Options).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ScanOptions {
    /// The greatest range, in metres: from there on a number means no return. The file's own if absent.
    pub maximum_range: Option<f64>,
    /// The field of a CARMEN message that has its time.
    pub time: TimeField,
}

/// A choice among the logs that a file holds, a bag or a saved state. The default is what there is only one of, and
/// the trajectories of the frames `map` and `odom`. A release may add fields, as to [`Options`](crate::Options).
#[derive(Clone, Debug, PartialEq)]
pub struct Selection {
    /// The topic of a bag's scans; the only one of type `sensor_msgs/LaserScan` if absent.
    pub topic: Option<String>,
    /// The frames of a bag's TF each of which gives a trajectory; `map` and `odom`, where TF has them, if absent. Of a saved
    /// state "local" and "global"; both if absent.
    pub frames: Option<Vec<String>>,
    /// The topics of a bag each of which has a trajectory.
    pub pose_topics: Vec<String>,
    /// The frame of a bag's robot; if absent, the last that carries the laser by `/tf_static`.
    pub base: Option<String>,
    /// The pose of the laser on the robot, in place of TF's; of a saved state in the tracking frame.
    pub mount: Option<Pose>,
    /// True if the laser is mounted upside down, so that its bearings turn clockwise; of a bag, also where TF says so. The points
    /// of a saved state are not turned.
    pub upside_down: bool,
    /// The trajectory of a saved state, by its number; the only one if absent.
    pub trajectory: Option<u64>,
    /// The longest time, in seconds, between two poses of TF that are interpolated.
    pub max_gap: f64,
}

impl Default for Selection {
    fn default() -> Self {
        Self {
            topic: None,
            frames: None,
            pose_topics: Vec::new(),
            base: None,
            mount: None,
            upside_down: false,
            trajectory: None,
            max_gap: 1.0,
        }
    }
}

/// The field of a CARMEN message that has its time. A message ends with `ipc_timestamp host logger_timestamp`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[non_exhaustive]
pub enum TimeField {
    /// The first one, `ipc_timestamp`: when the message was made, since 1970.
    #[default]
    Sent,
    /// The last one, `logger_timestamp`: when it was written, since the logger began.
    Logged,
}
