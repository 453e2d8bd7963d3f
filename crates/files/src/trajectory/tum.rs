//! Trajectories as TUM text: `time x y z qx qy qz qw`, as evo reads and writes.

use super::poses::{Trajectory, check_time};
use super::quaternion::Quaternion;
use super::tilts::Tilts;
use crate::error::{Error, ErrorKind};
use crate::text::{Line, Lines};
use crate::warning::Warning;
use mean_information::scan::Pose;
use std::io::{self, BufRead, Write};

/// The names of the fields, for messages.
const FIELDS: [&str; 8] = ["time", "x", "y", "z", "qx", "qy", "qz", "qw"];

/// Reads a trajectory. Empty lines and lines that begin with `#` are passed over; fields are parted by any white space;
/// quaternions whose length is within 0.02 of 1 are normalised.
///
/// Pitch, roll and z are dropped: poses tilted by more than a degree are counted in [`Warning::TiltDropped`], and where most
/// are tilted far, as with quaternions that have w first, [`Warning::MostTiltedFar`] says so. A last line
/// without an end that has no eight fields, or others than can be meant, is dropped with [`Warning::CutInLine`].
///
/// ```
/// use mean_information_files::tum;
///
/// let (trajectory, warnings) = tum::read(&b"# time x y z qx qy qz qw\n7.5 1.25 -2 0 0 0 0.6 0.8\n"[..])?;
/// assert_eq!((trajectory.times(), trajectory.poses()[0].position()), (&[7.5][..], [1.25, -2.0]));
/// assert_eq!(format!("{:.4}", trajectory.poses()[0].theta()), "1.2870");
/// assert!(warnings.is_empty());
///
/// let refused = tum::read(&b"7.5 1 2 0 0 0 0 1\n7.25 1 2 0 0 0 0 1\n"[..]).unwrap_err();
/// let words = "line 2: time is 7.25, allowed is a time above the one before, 7.5 s: times ascend";
/// assert_eq!(refused.to_string(), words);
/// # Ok::<(), mean_information_files::Error>(())
/// ```
///
/// # Errors
/// An [`Error`] with the line if a field is missing or no finite number, there are more than eight, the time is not above
/// the one before, or the quaternion is not of length 1; if there is no pose; or where the input fails.
pub fn read(input: impl BufRead) -> Result<(Trajectory, Vec<Warning>), Error> {
    let mut lines = Lines::new(input);
    let (mut times, mut poses) = (Vec::new(), Vec::new());
    let mut warnings = Vec::new();
    let mut tilts = Tilts::default();
    while let Some(line) = lines.next()? {
        let mut fields = line.fields();
        if fields.word().is_none_or(|word| word.starts_with(b"#")) {
            continue;
        }
        let in_order = |read: (f64, Pose, Quaternion)| {
            check_time(read.0, times.last().copied()).map_err(|error| line.blame(error))?;
            Ok(read)
        };
        let (time, pose, turn) = match stamped(line).and_then(in_order) {
            Ok(read) => read,
            Err(error) if line.may_be_cut() || !line.ended && error.kind() == ErrorKind::Format => {
                warnings.push(Warning::CutInLine { line: line.number });
                break;
            }
            Err(error) => return Err(error),
        };
        tilts.see(turn);
        times.push(time);
        poses.push(pose);
    }
    if times.is_empty() {
        let refused = Error::new(ErrorKind::Format, "holds no pose");
        return Err(refused.allowing("; allowed are ", "lines of `time x y z qx qy qz qw`"));
    }
    warnings.extend(tilts.warning_of_order());
    warnings.extend(tilts.warning());
    Ok((Trajectory::new(times, poses)?, warnings))
}

/// Reads the time of a line, its pose, and its orientation, of which the plane drops the tilt.
fn stamped(line: Line<'_>) -> Result<(f64, Pose, Quaternion), Error> {
    let mut fields = line.fields();
    let mut values = [0.0; 8];
    for (value, name) in values.iter_mut().zip(FIELDS) {
        *value = fields.finite(name)?;
    }
    if fields.word().is_some() {
        let refused = line.refuse(ErrorKind::Format, "has more than eight fields");
        return Err(refused.allowing("; allowed is ", "`time x y z qx qy qz qw`"));
    }
    let [time, x, y, _, turn @ ..] = values;
    let turn = Quaternion(turn);
    if !turn.is_normal() {
        return Err(fields.out_of_range("the length of the quaternion", turn.norm(), "1, within 0.02"));
    }
    Ok((time, Pose::new(x, y, turn.yaw())?, turn))
}

/// Writes a trajectory, with the lines of `comment` before it. Times and positions are read back as they are; the yaw goes
/// through a quaternion and comes back within `2^-49` of it, up to whole turns.
///
/// # Errors
/// An [`Error`] where `output` fails.
///
/// ```
/// use mean_information::scan::Pose;
/// use mean_information_files::{Trajectory, tum};
/// let trajectory = Trajectory::new(vec![7.5], vec![Pose::new(1.25, -2.0, 0.0)?])?;
/// let mut text = Vec::new();
/// tum::write(&trajectory, "of a robot", &mut text)?;
/// assert_eq!(text, b"# of a robot\n# time x y z qx qy qz qw\n7.5 1.25 -2 0 0 0 0 1\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write(trajectory: &Trajectory, comment: &str, mut output: impl Write) -> Result<(), Error> {
    let mut text = || -> io::Result<()> {
        for line in comment.lines().chain([FIELDS.join(" ").as_str()]) {
            writeln!(output, "# {line}")?;
        }
        for (time, pose) in trajectory.times().iter().zip(trajectory.poses()) {
            let [x, y] = pose.position();
            let Quaternion([qx, qy, qz, qw]) = Quaternion::turn(pose.theta()).map_err(io::Error::other)?;
            writeln!(output, "{time} {x} {y} 0 {qx} {qy} {qz} {qw}")?;
        }
        Ok(())
    };
    text().map_err(Error::of_writer)
}
