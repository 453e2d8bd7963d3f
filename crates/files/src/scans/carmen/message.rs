//! The messages that have scans and poses, field by field.

use super::parameters::{Parameters, check_view, without_codes};
use crate::error::Error;
use crate::scans::options::{ScanOptions, TimeField};
use crate::scans::range_scan::{Bearings, RangeScan};
use crate::text::{Fields, Line};
use mean_information::scan::Pose;

/// Reads what follows the word `FLASER`.
pub(super) fn front_laser(
    line: Line<'_>,
    fields: &mut Fields<'_>,
    parameters: &Parameters,
    options: &ScanOptions,
) -> Result<RangeScan, Error> {
    let ranges = numbers(fields, "the number of beams", "the ranges")?;
    let poses = [pose(fields)?, pose(fields)?];
    let time = time(fields, options)?;
    let bearings = match ranges.len() {
        // Refused as a scan.
        0 => Bearings::Even { start: 0.0, increment: 0.0 },
        beams => parameters.bearings(beams).map_err(|error| line.blame(error))?,
    };
    let greatest = options.maximum_range.unwrap_or(parameters.maximum_range());
    scan(line, time, bearings, ranges, greatest, poses)
}

/// Reads what follows the word `ROBOTLASER1`.
pub(super) fn robot_laser(
    line: Line<'_>,
    fields: &mut Fields<'_>,
    options: &ScanOptions,
) -> Result<RangeScan, Error> {
    fields.pass("the type of the laser")?;
    let start = fields.finite("start_angle")?;
    let view = fields.finite("field_of_view")?;
    let increment = fields.finite("angular_resolution")?;
    let greatest = fields.finite("maximum_range")?;
    fields.pass("accuracy")?;
    fields.pass("remission_mode")?;
    let ranges = numbers(fields, "the number of beams", "the ranges")?;
    for _ in 0..fields.count("the number of remissions")? {
        fields.pass("the remissions")?;
    }
    let poses = [pose(fields)?, pose(fields)?];
    for what in ["tv", "rv", "forward_safety_dist", "side_safety_dist", "turn_axis"] {
        fields.pass(what)?;
    }
    let time = time(fields, options)?;
    if ranges.len() > 1 {
        check_view(ranges.len(), view, increment).map_err(|error| line.blame(error))?;
    }
    let bearings = Bearings::Even { start, increment };
    scan(line, time, bearings, ranges, options.maximum_range.unwrap_or(without_codes(greatest)), poses)
}

/// Reads what follows the word `ODOM`: its time and the pose.
pub(super) fn odometry(fields: &mut Fields<'_>, options: &ScanOptions) -> Result<(f64, Pose), Error> {
    let pose = pose(fields)?;
    for what in ["tv", "rv", "accel"] {
        fields.pass(what)?;
    }
    Ok((time(fields, options)?, pose))
}

/// Puts a record together.
fn scan(
    line: Line<'_>,
    time: f64,
    bearings: Bearings,
    ranges: Vec<f64>,
    greatest: f64,
    [laser, odometry]: [Pose; 2],
) -> Result<RangeScan, Error> {
    let record = RangeScan::new(time, bearings, ranges, [0.0, greatest]);
    Ok(record.map_err(|error| line.blame(error))?.with_laser(laser).with_odometry(odometry))
}

/// Reads a count, and as many numbers of any value. Memory follows the numbers, not the count.
fn numbers(fields: &mut Fields<'_>, count: &str, what: &str) -> Result<Vec<f64>, Error> {
    let count = fields.count(count)?;
    let mut numbers = Vec::new();
    for _ in 0..count {
        numbers.push(fields.number(what)?);
    }
    Ok(numbers)
}

fn pose(fields: &mut Fields<'_>) -> Result<Pose, Error> {
    Ok(Pose::new(fields.finite("x")?, fields.finite("y")?, fields.finite("theta")?)?)
}

/// Reads the three fields that end a message; returns the time that is asked for, in seconds.
fn time(fields: &mut Fields<'_>, options: &ScanOptions) -> Result<f64, Error> {
    let sent = fields.finite("ipc_timestamp")?;
    fields.pass("the host")?;
    let logged = fields.finite("logger_timestamp")?;
    Ok(match options.time {
        TimeField::Sent => sent,
        TimeField::Logged => logged,
    })
}
