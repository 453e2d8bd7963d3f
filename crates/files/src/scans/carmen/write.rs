//! Scans as a CARMEN log of `ROBOTLASER1` messages, which have their bearings and greatest range with them.

use crate::error::{Error, ErrorKind, Place};
use crate::scans::range_scan::{Bearings, RangeScan};
use mean_information::scan::Pose;
use std::io::{self, Write};

/// What a log begins with.
const HEADER: &str = "message_name [message contents] ipc_timestamp ipc_hostname logger_timestamp
ROBOTLASER1 laser_type start_angle field_of_view angular_resolution maximum_range accuracy remission_mode \
num_readings [ranges] num_remissions [remissions] laser_x laser_y laser_theta robot_x robot_y robot_theta tv rv \
forward_safety_dist side_safety_dist turn_axis";

/// Writes scans as a log, with the lines of `comment` before them. What is read back is the same, except that a least range
/// is lost, and that a greatest one from 81.83 to 82 m becomes 81.83.
///
/// # Errors
/// An [`Error`] with the index of a scan whose bearings are not even or that lacks the pose of the laser or of the robot,
/// which the format cannot say; or where `output` fails.
///
/// ```
/// use mean_information::scan::Pose;
/// use mean_information_files::scans::{Bearings, RangeScan, ScanLog, ScanOptions, carmen};
///
/// let bearings = Bearings::Even { start: -1.5, increment: 0.75 };
/// let scan = RangeScan::new(0.5, bearings, vec![1.25, 8.0, 2.5], [0.0, 8.0])?
///     .with_laser(Pose::new(1.0, 2.0, 0.25)?)
///     .with_odometry(Pose::new(1.5, 2.0, 0.125)?);
/// let mut log = Vec::new();
/// carmen::write(&[scan.clone()], "of a robot", &mut log)?;
/// assert_eq!(ScanLog::read_carmen(&log[..], &ScanOptions::default())?.scans, [scan]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write(scans: &[RangeScan], comment: &str, mut output: impl Write) -> Result<(), Error> {
    for line in comment.lines().chain(HEADER.lines()) {
        writeln!(output, "# {line}").map_err(Error::of_writer)?;
    }
    let first = scans.first().map_or(0.0, RangeScan::time);
    for (index, scan) in scans.iter().enumerate() {
        let refused = |what: &str| {
            let message = format!("a CARMEN log cannot have a scan {what}");
            Error::new(ErrorKind::Unsupported, message).at(Place::Item(index))
        };
        let &Bearings::Even { start, increment } = scan.bearings() else {
            return Err(refused("of uneven bearings"));
        };
        let (Some(laser), Some(robot)) = (scan.laser(), scan.odometry()) else {
            return Err(refused("without the poses of laser and robot"));
        };
        message(scan, [start, increment], [laser, robot], first, &mut output).map_err(Error::of_writer)?;
    }
    Ok(())
}

/// Writes a message.
fn message(
    scan: &RangeScan,
    [start, increment]: [f64; 2],
    poses: [&Pose; 2],
    first: f64,
    output: &mut impl Write,
) -> io::Result<()> {
    let beams = scan.ranges().len();
    let (view, [_, greatest]) = (beams as f64 * increment, scan.limits());
    // Type 0 (a SICK scanner), an accuracy of a centimetre, no remissions.
    write!(output, "ROBOTLASER1 0 {start} {view} {increment} {greatest} 0.01 0 {beams}")?;
    for range in scan.ranges() {
        write!(output, " {range}")?;
    }
    write!(output, " 0")?;
    for pose in poses {
        let [x, y] = pose.position();
        write!(output, " {x} {y} {}", pose.theta())?;
    }
    let time = scan.time();
    writeln!(output, " 0 0 0 0 0 {time} nohost {}", time - first)
}
