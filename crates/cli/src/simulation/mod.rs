//! A robot with a range sensor in a room, and the map that it makes.
//!
//! The robot stops at places along its [route](Room::route), and its [`Scanner`] looks round: rays to the walls, with
//! Gaussian noise from a seeded generator. The scans are inserted into a map at the poses where the robot believes it
//! is, which [drift](trajectory::drifted) from the true ones. A [`Recording`] is a longer drive, as a log has it. The same numbers give the same bits on every platform.

mod filter;
mod random;
mod recording;
mod rooms;
mod scanner;
mod shapes;
pub mod trajectory;

pub use filter::{Filter, Settings};
pub use random::Random;
pub use recording::Recording;
pub use rooms::{Room, RoomName};
pub use scanner::{Readings, Scanner};
pub use shapes::{Point, Shape};

use mean_information::Error;
use mean_information::scan::{Pose, Scan, ScanMap};
use mean_information::sensor::GaussianSensor;

/// The readings of a robot, and the poses they were made from.
#[derive(Clone, Debug)]
pub struct Journey {
    /// The true poses.
    pub poses: Vec<Pose>,
    /// The poses in which it believed to be.
    pub believed: Vec<Pose>,
    /// The readings from each pose.
    pub readings: Vec<Readings>,
}

impl Journey {
    /// Stops at `poses` poses along the route of a room. The noise of the ranges does not depend on the drift.
    ///
    /// # Errors
    /// A drift that is negative or not finite.
    pub fn through(
        room: &Room,
        scanner: &Scanner,
        poses: usize,
        drift: f64,
        seed: u64,
    ) -> Result<Self, Error> {
        let mut seeds = Random::new(seed);
        let [mut noise, mut odometry] = [seeds.fork(), seeds.fork()];
        let poses = trajectory::along(&room.route, poses)?;
        let believed = trajectory::drifted(&poses, drift, &mut odometry)?;
        let look = |pose| scanner.look(room, pose, &mut noise);
        let readings = poses.iter().map(look).collect::<Result<_, _>>()?;
        Ok(Self { poses, believed, readings })
    }

    /// Returns the scans at the believed poses.
    ///
    /// # Errors
    /// [`Readings::at`].
    pub fn scans(&self) -> impl Iterator<Item = Result<Scan<f64>, Error>> {
        self.readings.iter().zip(&self.believed).map(|(readings, &pose)| readings.at(pose))
    }
}

/// Inserts a scan by the paper's inverse sensor model, Eq. 5.
///
/// # Errors
/// [`ScanMap::insert`].
pub fn insert(map: &mut ScanMap<f64>, scan: &Scan<f64>, sigma: f64) -> Result<(), Error> {
    map.insert(scan, |range| GaussianSensor::new(range, sigma))
}
