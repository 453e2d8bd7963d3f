//! The parameters of a log that say how its `FLASER` messages are meant.

use crate::error::Error;
use crate::scans::range_scan::Bearings;
use crate::text::Fields;
use mean_information::scan::Pose;
use std::ops::RangeInclusive;

/// The greatest range of an `FLASER` in metres where the log states none: SICK's scanners return 50 m and more, up to
/// 81.91, where nothing came back.
pub const MAXIMUM_RANGE: f64 = 50.0;

/// The ranges, in metres, that SICK's scanners send for errors and for no return: the last numbers of 13 bits, in
/// centimetres. Logs state their end as the greatest range.
const SICK_CODES: RangeInclusive<f64> = 81.83..=82.0;

/// Returns the greatest range that a log means by the one that it states: codes are no ranges.
pub(super) fn without_codes(stated: f64) -> f64 {
    if SICK_CODES.contains(&stated) { *SICK_CODES.start() } else { stated }
}

/// The parameters seen so far.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Parameters {
    /// The angle between two beams in degrees.
    resolution: Option<f64>,
    /// The field of view in degrees.
    view: Option<f64>,
    /// The greatest range in metres.
    maximum_range: Option<f64>,
    /// The mount of the laser: ahead and aside in metres, radians.
    mount: [Option<f64>; 3],
}

/// The numbers of beams that decide alone, each with the degrees between two.
const CUSTOMARY: [(usize, f64); 6] =
    [(180, 1.0), (181, 1.0), (360, 0.5), (361, 0.5), (400, 0.25), (401, 0.25)];

impl Parameters {
    /// Reads the name and the value of a parameter; one of another name is passed over.
    ///
    /// # Errors
    /// An [`Error`] with the line if its value is no number, or none that can be meant.
    pub(super) fn read(&mut self, fields: &mut Fields<'_>) -> Result<(), Error> {
        const ANGLE: &str = "an angle above 0, up to 360 degrees";
        let finite = |_: f64| true;
        let angle = |degrees: f64| degrees > 0.0 && degrees <= 360.0;
        let name = fields.word().unwrap_or_default();
        let (place, what, meant, allowed): (_, _, fn(f64) -> bool, _) = match name {
            b"laser_front_laser_resolution" => {
                (&mut self.resolution, "laser_front_laser_resolution", angle, ANGLE)
            }
            b"laser_front_laser_fov" => (&mut self.view, "laser_front_laser_fov", angle, ANGLE),
            b"robot_front_laser_max" => {
                let positive = |metres: f64| metres > 0.0;
                (&mut self.maximum_range, "robot_front_laser_max", positive, "a positive number of metres")
            }
            b"robot_frontlaser_offset" => {
                (&mut self.mount[0], "robot_frontlaser_offset", finite, "a finite number")
            }
            b"robot_frontlaser_side_offset" => {
                (&mut self.mount[1], "robot_frontlaser_side_offset", finite, "a finite number")
            }
            b"robot_frontlaser_angular_offset" => {
                (&mut self.mount[2], "robot_frontlaser_angular_offset", finite, "a finite number")
            }
            _ => return Ok(()),
        };
        let value = fields.finite(what)?;
        if !meant(value) {
            return Err(fields.out_of_range(what, value, allowed));
        }
        *place = Some(value);
        Ok(())
    }

    /// Returns the greatest range, in metres.
    pub(super) fn maximum_range(&self) -> f64 {
        stated_maximum_range(self.maximum_range)
    }

    /// Returns the mount of the laser, if a parameter has a part of it; the others are 0.
    pub(super) fn mount(&self) -> Option<Pose> {
        let [x, y, yaw] = self.mount.map(|part| part.unwrap_or(0.0));
        self.mount.iter().any(Option::is_some).then(|| Pose::new(x, y, yaw).ok())?
    }

    /// Returns the bearings of `beams` beams.
    ///
    /// # Errors
    /// An [`Error`] if nothing says them, or the field of view says others than the resolution.
    pub(super) fn bearings(&self, beams: usize) -> Result<Bearings, Error> {
        let customary = CUSTOMARY.iter().find(|(number, _)| *number == beams).map(|&(_, degrees)| degrees);
        let Some(degrees) = self.resolution.or(customary) else {
            let allowed =
                "180, 181, 360, 361, 400, 401, or `PARAM laser_front_laser_resolution DEGREES` before it";
            return Err(Error::out_of_range("the number of beams", beams, allowed));
        };
        if let Some(view) = self.view.filter(|_| self.resolution.is_some()) {
            check_view(beams, view, degrees)?;
        }
        // An odd number has one straight ahead; an even one begins where the odd one does that has one more.
        let start = -degrees * (beams / 2) as f64;
        Ok(Bearings::Even { start: start.to_radians(), increment: degrees.to_radians() })
    }
}

/// Returns the bearings of so many beams by their number alone.
///
/// # Errors
/// An [`Error`] if it is none of the customary ones.
pub(crate) fn customary_bearings(beams: usize) -> Result<Bearings, Error> {
    Parameters::default().bearings(beams)
}

/// Returns the greatest range that a log means by the one that it states, if it does; [`MAXIMUM_RANGE`] else.
pub(crate) fn stated_maximum_range(stated: Option<f64>) -> f64 {
    stated.map_or(MAXIMUM_RANGE, without_codes)
}

/// Refuses a number of beams that is neither that of a field of view nor, both ends counted, one more: within half a beam.
///
/// # Errors
/// An [`Error`] with the number, and what the angles allow.
pub(super) fn check_view(beams: usize, view: f64, step: f64) -> Result<(), Error> {
    let fitting = view / step;
    if (beams as f64 - fitting - 0.5).abs() < 1.0 {
        return Ok(());
    }
    let allowed = format!("{view} / {step} = {fitting:.1}, field of view by angle between beams, or 1 more");
    Err(Error::out_of_range("the number of beams", beams, allowed))
}
