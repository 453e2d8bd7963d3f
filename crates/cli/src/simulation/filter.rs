//! A Rao-Blackwellized particle filter: hypotheses of where the robot went, each with the map that follows.
//!
//! Plain FastSLAM on grids: each particle moves by the odometry with an error of its own, is weighted by how well the
//! scan fits its own map, and inserts the scan there. When the weights have become unequal, particles are drawn anew by
//! them. No scan matching: what closes a loop is the choice among the particles, which is what the measure is to show.

use super::{Random, Readings, insert, trajectory::Motion};
use mean_information::Error;
use mean_information::elementary::{exp, ln};
use mean_information::map::Grid;
use mean_information::map::encoding::Probability;
use mean_information::scan::{Direction, Pose, ScanMap};

/// The number of independent beams as which a scan counts: its own are not independent.
const INDEPENDENT_BEAMS: f64 = 25.0;
/// The part of returns that have nothing to do with the map: the least likelihood of one.
const OUTLIERS: f64 = 0.05;

/// The settings of a filter.
#[derive(Clone, Debug)]
pub struct Settings {
    /// The number of particles.
    pub particles: usize,
    /// The drift of the odometry, as the filter knows it.
    pub drift: f64,
    /// The standard deviation of the sensor, in metres.
    pub sigma: f64,
    /// The side of a cell, in metres.
    pub resolution: f64,
}

/// A hypothesis.
#[derive(Clone, Debug)]
struct Particle {
    pose: Pose,
    map: ScanMap<f64>,
    /// The probabilities of the map.
    grid: Grid<Probability<f64>>,
    log_weight: f64,
}

/// The particles.
#[derive(Clone, Debug)]
pub struct Filter {
    settings: Settings,
    particles: Vec<Particle>,
    random: Random,
}

impl Filter {
    /// Creates a filter with all particles at one pose and what is seen from there.
    ///
    /// # Errors
    /// What [`ScanMap`] refuses.
    pub fn new(settings: Settings, pose: Pose, readings: &Readings, random: Random) -> Result<Self, Error> {
        let map = ScanMap::new(settings.resolution)?;
        let grid = map.probabilities()?;
        let mut particle = Particle { pose, map, grid, log_weight: 0.0 };
        particle.insert(readings, settings.sigma)?;
        let particles = vec![particle; settings.particles];
        Ok(Self { settings, particles, random })
    }

    /// Moves the particles by the robot's odometry, and weighs them by its scan.
    ///
    /// # Errors
    /// What [`ScanMap`] refuses.
    pub fn step(&mut self, odometry: &Motion, readings: &Readings) -> Result<(), Error> {
        for particle in &mut self.particles {
            particle.pose = odometry.measured(self.settings.drift, &mut self.random).from(&particle.pose)?;
            particle.log_weight += particle.log_likelihood(readings)?;
        }
        self.resample();
        for particle in &mut self.particles {
            particle.insert(readings, self.settings.sigma)?;
        }
        Ok(())
    }

    /// Returns the particles' maps.
    pub fn maps(&self) -> Vec<Grid<Probability<f64>>> {
        self.particles.iter().map(|particle| particle.grid.clone()).collect()
    }

    /// Returns the weights, the largest being 1.
    pub fn weights(&self) -> Vec<f64> {
        let largest = self.particles.iter().map(|p| p.log_weight).fold(f64::NEG_INFINITY, f64::max);
        self.particles.iter().map(|particle| exp(particle.log_weight - largest)).collect()
    }

    /// Returns the poses of the particles.
    pub fn poses(&self) -> impl Iterator<Item = Pose> {
        self.particles.iter().map(|particle| particle.pose)
    }

    /// Draws the particles anew by their weights where these make fewer than half as many effective ones: systematic
    /// resampling, with one random number for all.
    fn resample(&mut self) {
        let weights = self.weights();
        let sum: f64 = weights.iter().sum();
        let effective = sum * sum / weights.iter().map(|w| w * w).sum::<f64>();
        let count = weights.len();
        if effective >= count as f64 / 2.0 {
            return;
        }
        let step = sum / count as f64;
        let mut mark = self.random.between(0.0, step);
        let mut passed = 0.0;
        let mut drawn = Vec::with_capacity(count);
        for (particle, weight) in self.particles.iter().zip(weights) {
            passed += weight;
            while mark < passed && drawn.len() < count {
                drawn.push(Particle { log_weight: 0.0, ..particle.clone() });
                mark += step;
            }
        }
        // Rounding may leave the last mark just beyond the sum.
        while let (Some(last), true) = (drawn.last().cloned(), drawn.len() < count) {
            drawn.push(last);
        }
        self.particles = drawn;
    }
}

impl Particle {
    fn insert(&mut self, readings: &Readings, sigma: f64) -> Result<(), Error> {
        insert(&mut self.map, &readings.at(self.pose)?, sigma)?;
        self.grid = self.map.probabilities()?;
        Ok(())
    }

    /// Returns how well the returns fit the map: each is as likely as the cell it ends in is occupied.
    fn log_likelihood(&self, readings: &Readings) -> Result<f64, Error> {
        let (mut sum, mut count) = (0.0, 0.0);
        for beam in readings.beams() {
            let Some(range) = beam.range else { continue };
            let direction = Direction::new(&[self.pose.theta(), beam.bearing])?;
            let [x, y] = self.pose.position();
            let p = self.occupancy([x + range * direction.cos(), y + range * direction.sin()]);
            sum += ln(OUTLIERS + (1.0 - OUTLIERS) * p);
            count += 1.0;
        }
        Ok(if count > 0.0 { INDEPENDENT_BEAMS * sum / count } else { 0.0 })
    }

    /// The occupancy at a place; 1/2 beyond the map.
    fn occupancy(&self, place: [f64; 2]) -> f64 {
        let geometry = self.grid.geometry();
        let [column, row] = [0, 1].map(|k| (place[k] - geometry.origin()[k]) / geometry.resolution());
        if column < 0.0 || row < 0.0 {
            return 0.5;
        }
        self.grid.occupancy(row as usize, column as usize).unwrap_or(0.5)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::{Journey, RoomName, Scanner};

    fn settings() -> Settings {
        Settings { particles: 6, drift: 0.01, sigma: 0.1, resolution: 0.2 }
    }

    fn journey() -> Journey {
        let scanner = Scanner { beams: 60, maximum_range: 4.5, noise: 0.02 };
        Journey::through(&RoomName::Study.room(), &scanner, 4, 0.0, 9).unwrap()
    }

    fn run() -> Filter {
        let journey = journey();
        let mut filter =
            Filter::new(settings(), journey.poses[0], &journey.readings[0], Random::new(4)).unwrap();
        for (ends, readings) in journey.poses.windows(2).zip(&journey.readings[1..]) {
            let motion = Motion::between(&ends[0], &ends[1]).unwrap();
            filter.step(&motion, readings).unwrap();
        }
        filter
    }

    #[test]
    fn the_same_numbers_give_the_same_particles() {
        let (a, b) = (run(), run());
        assert_eq!(a.maps(), b.maps());
        assert_eq!(a.weights(), b.weights());
        assert_eq!(a.weights().len(), 6);
        // They know where they are within ten deviations of 12 m of way.
        for (pose, [x, y]) in a.poses().map(|pose| (pose, journey().poses[3].position())) {
            let [dx, dy] = [pose.position()[0] - x, pose.position()[1] - y];
            assert!(dx.abs().max(dy.abs()) < 10.0 * 0.01 * 12.0_f64.sqrt() * 12.0, "{pose:?}");
        }
    }

    /// The particle that has all the weight is drawn alone; equal ones stay as they are.
    #[test]
    fn particles_are_drawn_by_their_weights() {
        let journey = journey();
        let mut filter =
            Filter::new(settings(), journey.poses[0], &journey.readings[0], Random::new(4)).unwrap();
        for (k, particle) in (0_u32..).zip(&mut filter.particles) {
            particle.pose = Pose::new(f64::from(k), 0.0, 0.0).unwrap();
        }
        let xs = |filter: &Filter| filter.poses().map(|pose| pose.position()[0]).collect::<Vec<_>>();
        filter.resample();
        assert_eq!(xs(&filter), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
        filter.particles[3].log_weight = 60.0;
        filter.resample();
        assert_eq!(xs(&filter), [3.0; 6]);
        assert_eq!(filter.weights(), [1.0; 6]);
    }
}
