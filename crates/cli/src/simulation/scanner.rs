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
        let ranges = self.ranges(room, pose, random)?;
        let beams = ranges.into_iter().zip(0..).filter(|&(range, _)| range > 0.0).map(|(range, k)| Beam {
            bearing: self.bearing(k),
            range: (range <= self.maximum_range).then_some(range),
        });
        Ok(Readings { maximum_range: self.maximum_range, beams: beams.collect() })
    }

    /// Returns what its beams measure from `pose`: the distance to the wall with noise, of any sign, or infinity where none
    /// is within the maximum range.
    ///
    /// # Errors
    /// Never for the bearings of a scanner.
    pub fn ranges(&self, room: &Room, pose: &Pose, random: &mut Random) -> Result<Vec<f64>, Error> {
        let mut measure = |k| {
            let exact = room.range(pose.position(), Direction::new(&[pose.theta(), self.bearing(k)])?);
            let range = exact.filter(|&range| range <= self.maximum_range);
            Ok(range.map_or(f64::INFINITY, |range| range + self.noise * random.normal()))
        };
        (0..self.beams).map(&mut measure).collect()
    }

    /// Returns the bearing of a beam, in radians.
    fn bearing(&self, beam: u32) -> f64 {
        TAU * f64::from(beam) / f64::from(self.beams)
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
