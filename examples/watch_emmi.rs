//! The expected map's mean information (EMMI) over the run of a particle filter, which closes a loop:
//! `cargo run --release --example watch_emmi`.

use mean_information::Error;
use mean_information::elementary::{exp, ln};
use mean_information::expected::Hypotheses;
use mean_information::map::{Grid, encoding::Probability};
use mean_information::scan::{Beam, Direction, Pose, Scan, ScanMap};
use mean_information::sensor::GaussianSensor;
use std::f64::consts::TAU;

/// Four corridors about a block: the walls are these squares, from a corner to a corner (metres).
const WALLS: [[f64; 2]; 2] = [[0.0, 10.0], [2.5, 7.5]];
/// The range sensor: its longest range (metres), number of beams, and standard deviation of the noise (metres).
const SEES: f64 = 4.0;
const BEAMS: u32 = 120;
const SIGMA: f64 = 0.05;
/// The length (metres) and the steps of one corridor.
const CORRIDOR: f64 = 7.5;
const STEPS: u32 = 10;

/// The difference of the turns of neighbouring particles' odometry at each step (radians).
const TURN: f64 = 0.003;

/// A particle: one hypothesis about the path. Its odometry turns a little at each step, by another angle for each particle.
#[derive(Clone)]
struct Particle {
    pose: Pose,
    turn: f64,
    map: ScanMap<f64>,
    log_weight: f64,
}

/// Moves a pose by `distance` and then turns it; angles in radians.
fn moved(pose: &Pose, distance: f64, turn: f64) -> Result<Pose, Error> {
    let ([x, y], heading) = (pose.position(), Direction::new(&[pose.theta()])?);
    Pose::new(x + distance * heading.cos(), y + distance * heading.sin(), pose.theta() + turn)
}

/// Computes the range that each beam returns: that of the nearest wall.
fn look(pose: &Pose) -> Result<Vec<Beam<f64>>, Error> {
    let bearings = (0..BEAMS).map(|k| f64::from(k) * TAU / f64::from(BEAMS));
    let beam = |bearing| {
        let direction = Direction::new(&[pose.theta(), bearing])?;
        let way = [direction.cos(), direction.sin()];
        let mut nearest = f64::INFINITY;
        for [low, high] in WALLS {
            for (axis, wall) in [(0, low), (0, high), (1, low), (1, high)] {
                let range = (wall - pose.position()[axis]) / way[axis];
                let across = pose.position()[1 - axis] + range * way[1 - axis];
                if range > 0.0 && (low..=high).contains(&across) {
                    nearest = nearest.min(range);
                }
            }
        }
        Ok(Beam { bearing, range: (nearest <= SEES).then_some(nearest) })
    };
    bearings.map(beam).collect()
}

/// Scores how well the returns end on walls of the map: the mean logarithm of the occupancy there or in a cell beside.
fn fit(map: &Grid<Probability<f64>>, scan: &Scan<f64>) -> Result<f64, Error> {
    let (geometry, [x, y]) = (map.geometry(), scan.pose().position());
    let occupancy = |place: [f64; 2]| {
        let [column, row] =
            [0, 1].map(|k| ((place[k] - geometry.origin()[k]) / geometry.resolution()).floor());
        let inside = column >= 0.0 && row >= 0.0;
        inside.then(|| map.occupancy(row as usize, column as usize)).flatten().unwrap_or(0.5)
    };
    let (mut sum, mut count) = (0.0, 0.0);
    for beam in scan.beams() {
        let Some(range) = beam.range else { continue };
        let direction = Direction::new(&[scan.pose().theta(), beam.bearing])?;
        let end = [x + range * direction.cos(), y + range * direction.sin()];
        let beside = [-1.0, 0.0, 1.0].map(|k| k * geometry.resolution());
        let near = beside.into_iter().flat_map(|dx| beside.map(|dy| occupancy([end[0] + dx, end[1] + dy])));
        sum += ln(0.05 + 0.95 * near.fold(0.0, f64::max));
        count += 1.0;
    }
    Ok(sum / count)
}

/// Computes the particles' weights, the largest of which is 1.
fn weights(particles: &[Particle]) -> Vec<f64> {
    let largest = particles.iter().map(|particle| particle.log_weight).fold(f64::NEG_INFINITY, f64::max);
    particles.iter().map(|particle| exp(particle.log_weight - largest)).collect()
}

/// Resamples the particles by their weights when fewer than half are effective. This matters for the measure: a cell that
/// only a particle of negligible weight has seen counts as observed.
fn resample(particles: &mut Vec<Particle>) {
    let weights = weights(particles);
    let (sum, squares) = (weights.iter().sum::<f64>(), weights.iter().map(|w| w * w).sum::<f64>());
    let step = sum / weights.len() as f64;
    if sum * sum / squares >= 0.5 * weights.len() as f64 {
        return;
    }
    let (mut drawn, mut passed) = (Vec::new(), 0.0);
    for (particle, weight) in particles.iter().zip(&weights) {
        passed += weight;
        while (drawn.len() as f64 + 0.5) * step < passed {
            drawn.push(Particle { log_weight: 0.0, ..particle.clone() });
        }
    }
    *particles = drawn;
}

/// Computes the EMMI after each step, and the weighted mean of the particles' own mean information.
fn watch(steps: u32) -> Result<Vec<[f64; 2]>, Error> {
    let start = Pose::new(1.25, 1.25, 0.0)?;
    let mut robot = start;
    let particle = |k: i32| {
        let map = ScanMap::new(0.1)?;
        Ok(Particle { pose: start, turn: f64::from(k) * TURN, map, log_weight: 0.0 })
    };
    let mut particles = (-3..=3).map(particle).collect::<Result<Vec<_>, Error>>()?;
    let mut run = Vec::new();
    for step in 1..=steps {
        let returns = look(&robot)?;
        let scan = |particle: &Particle| Scan::new(particle.pose, SEES, returns.clone());
        for particle in &mut particles {
            particle.log_weight += 25.0 * fit(&particle.map.probabilities()?, &scan(particle)?)?;
        }
        resample(&mut particles);
        for particle in &mut particles {
            particle.map.insert(&scan(particle)?, |range| GaussianSensor::new(range, SIGMA))?;
        }

        // The measure: of the particles' maps, and their weights, which need not be normalized.
        let maps =
            particles.iter().map(|particle| particle.map.probabilities()).collect::<Result<Vec<_>, _>>()?;
        let hypotheses = Hypotheses::new(&maps, &weights(&particles))?;
        let emmi = hypotheses.expected_tally()?.mean_information();
        run.push([emmi, hypotheses.mean_of_mean_information()]);

        let corner = if step % STEPS == 0 { TAU / 4.0 } else { 0.0 };
        robot = moved(&robot, CORRIDOR / f64::from(STEPS), corner)?;
        for particle in &mut particles {
            particle.pose = moved(&particle.pose, CORRIDOR / f64::from(STEPS), corner + particle.turn)?;
        }
    }
    Ok(run)
}

fn main() -> Result<(), Error> {
    println!("step    EMMI  of the particles (bits per observed cell)");
    for (step, [emmi, particles]) in (1..).zip(watch(4 * STEPS + 6)?) {
        println!("{step:4}  {emmi:.4}  {particles:.4}  {}", "#".repeat((emmi * 60.0) as usize));
    }
    Ok(())
}

#[test]
fn particles_that_disagree_lower_it() {
    let run = watch(4).unwrap();
    assert!(run[1..].iter().all(|[emmi, particles]| emmi < particles), "{run:?}");
}
