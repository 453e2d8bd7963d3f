//! A range sensor that looks all round, with Gaussian noise.

use super::{Random, Room};
use mean_information::Error;
use mean_information::scan::{Beam, Direction, Pose, Scan};
use std::f64::consts::TAU;

/// A range sensor.
#[derive(Clone, Debug)]
pub struct Scanner {
    /// The number of beams, at equal angles all round, the first straight ahead.
    pub beams: u32,
    /// The maximum range, in metres.
    pub maximum_range: f64,
    /// The standard deviation of its ranges, in metres.
    pub noise: f64,
}

/// The readings of a scanner at one place, wherever that was.
#[derive(Clone, Debug, PartialEq)]
pub struct Readings {
    maximum_range: f64,
    beams: Vec<Beam<f64>>,
}

impl Scanner {
    /// Looks round from `pose`.
    ///
    /// A range that noise carries beyond the maximum is no return. One that it carries to 0 or below is lost, with its
    /// beam: it says neither where the wall is nor that there is none.
    ///
    /// # Errors
    /// Never for the bearings of a scanner.
    pub fn look(&self, room: &Room, pose: &Pose, random: &mut Random) -> Result<Readings, Error> {
        let mut beams = Vec::with_capacity(self.beams as usize);
        for k in 0..self.beams {
            let bearing = TAU * f64::from(k) / f64::from(self.beams);
            let exact = room.range(pose.position(), Direction::new(&[pose.theta(), bearing])?);
            let range = exact.filter(|&range| range <= self.maximum_range);
            let range = range.map(|range| range + self.noise * random.normal());
            if range.is_none_or(|range| range > 0.0) {
                beams.push(Beam { bearing, range: range.filter(|&range| range <= self.maximum_range) });
            }
        }
        Ok(Readings { maximum_range: self.maximum_range, beams })
    }
}

impl Readings {
    /// Returns the readings as a scan from `pose`, which need not be where they were taken.
    ///
    /// # Errors
    /// [`Scan::new`]: a maximum range that is not positive and finite, or no beam left.
    pub fn at(&self, pose: Pose) -> Result<Scan<f64>, Error> {
        Scan::new(pose, self.maximum_range, self.beams.clone())
    }

    /// Returns the beams.
    pub fn beams(&self) -> &[Beam<f64>] {
        &self.beams
    }
}
