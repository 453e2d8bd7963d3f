//! How often the intervals of the block jackknife hold the true difference of two trajectories' mean information: a simulation with
//! known truth. `docs/evidence.md`, "Coverage", has the figures.
//!
//! A robot goes round a floor with pillars, and its laser is noisy. Two programs correct its trajectory: their errors drift, now
//! here, now there, one's by twice as much as the other's. Every run has noise and errors of its own. The truth is the mean
//! difference of five times as many other runs.
//!
//! `cargo run --release --example jackknife_coverage` (200 runs of 200 scans), or `-- RUNS SCANS BLOCKS...`

use mean_information::Error;
use mean_information::scan::{Beam, Difference, Direction, Pose, Scan, ScanMap, TalliedMap, blocks};
use mean_information::sensor::SteppedSensor;
use std::ops::Range;

/// Side of a cell, in metres.
const RESOLUTION: f64 = 0.1;
/// Beams of a scan, all round.
const BEAMS: u32 = 60;
/// Standard deviation of a range, in metres.
const RANGE_NOISE: f64 = 0.02;
/// How much of its error a trajectory keeps from one scan to the next.
const MEMORY: f64 = 0.9;

/// Random numbers: SplitMix64.
struct Random(u64);

impl Random {
    /// Draws a number in `[0, 1)`.
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ z >> 31) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Draws a number of mean 0 and variance 1, nearly normal: a sum of twelve.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}

/// Finds the distance to the nearest wall of a floor of 12 m by 8 m or of its six pillars.
fn range([x, y]: [f64; 2], direction: Direction) -> f64 {
    let [u, v] = [direction.cos(), direction.sin()];
    let to_wall = |from: f64, part: f64, end: f64| {
        if part == 0.0 { f64::MAX } else { (end.copysign(part) - from) / part }
    };
    let walls = to_wall(x, u, 6.0).min(to_wall(y, v, 4.0));
    let pillars = [-3.0, 0.0, 3.0].into_iter().flat_map(|px| [[px, -1.0], [px, 1.0]]);
    let to_pillar = |[px, py]: [f64; 2]| {
        let (dx, dy) = (px - x, py - y);
        let (along, across) = (dx * u + dy * v, dx * v - dy * u);
        let inside = 0.3 * 0.3 - across * across;
        if along > 0.0 && inside > 0.0 {
            along - mean_information::elementary::sqrt(inside)
        } else {
            f64::MAX
        }
    };
    pillars.map(to_pillar).fold(walls, f64::min)
}

/// Returns the true pose of a scan: on a round of 40 scans about the pillars, each round a little different.
fn true_pose(scan: usize, random: &mut Random) -> [f64; 3] {
    let turn = std::f64::consts::TAU * scan as f64 / 40.0;
    let round = Direction::new(&[turn]).expect("finite");
    [
        4.5 * round.cos() + 0.2 * random.normal(),
        2.6 * round.sin() + 0.1 * random.normal(),
        turn + 0.3 * random.normal(),
    ]
}

fn model(range: f64) -> Result<SteppedSensor<f64>, Error> {
    SteppedSensor::new(range, RESOLUTION, 0.4, 0.7)
}

/// The same scans by two trajectories.
fn scans(count: usize, random: &mut Random) -> Result<[Vec<Scan<f64>>; 2], Error> {
    let mut trajectories = [Vec::with_capacity(count), Vec::with_capacity(count)];
    let mut errors = [[0.0; 3]; 2];
    for k in 0..count {
        let [x, y, theta] = true_pose(k, random);
        let beam = |bearing: f64, noise: f64| {
            let range = range([x, y], Direction::new(&[theta, bearing])?) + noise;
            Ok(Beam { bearing, range: Some(range.max(0.01)) })
        };
        let beams = (0..BEAMS).map(|k| {
            beam(f64::from(k) * std::f64::consts::TAU / f64::from(BEAMS), RANGE_NOISE * random.normal())
        });
        let beams: Vec<_> = beams.collect::<Result<_, Error>>()?;
        for ((scans, error), size) in trajectories.iter_mut().zip(&mut errors).zip([0.02, 0.04]) {
            for (part, unit) in error.iter_mut().zip([1.0, 1.0, 0.5]) {
                // Of variance (size unit)² in the long run.
                let step = size * unit * mean_information::elementary::sqrt(1.0 - MEMORY * MEMORY);
                *part = MEMORY * *part + step * random.normal();
            }
            let pose = Pose::new(x + error[0], y + error[1], theta + error[2])?;
            scans.push(Scan::new(pose, 20.0, beams.clone())?);
        }
    }
    Ok(trajectories)
}

/// The maps of one run by both trajectories, with their scans.
struct Run {
    trajectories: [Vec<Scan<f64>>; 2],
    maps: [TalliedMap<f64>; 2],
}

impl Run {
    fn new(seed: u64, count: usize) -> Result<Self, Error> {
        let trajectories = scans(count, &mut Random(seed))?;
        let built = |scans: &[Scan<f64>]| {
            let mut map = ScanMap::new(RESOLUTION)?;
            scans.iter().try_for_each(|scan| map.insert(scan, model))?;
            Ok::<_, Error>(TalliedMap::new(map))
        };
        let maps = [built(&trajectories[0])?, built(&trajectories[1])?];
        Ok(Self { trajectories, maps })
    }

    /// The difference of mean information.
    fn value(&self) -> f64 {
        let [first, second] = [&self.maps[0], &self.maps[1]].map(|map| map.tally().mean_information());
        second - first
    }

    /// The difference with its standard error by so many blocks.
    fn difference(&self, block_count: usize) -> Result<Difference, Error> {
        let without = |trajectory: usize, block: Range<usize>| {
            self.maps[trajectory].without(&self.trajectories[trajectory][block], model)
        };
        let blocks = blocks(self.trajectories[0].len(), block_count);
        let without = blocks.map(|block| Ok([without(0, block.clone())?, without(1, block)?]));
        let without = without.collect::<Result<Vec<_>, Error>>()?;
        Difference::by_jackknife([self.maps[0].tally(), self.maps[1].tally()], &without)
    }
}

/// The mean of numbers, and their standard deviation.
fn moments(numbers: impl Iterator<Item = f64> + Clone) -> [f64; 2] {
    let count = numbers.clone().count() as f64;
    let mean = numbers.clone().sum::<f64>() / count;
    let squares = numbers.map(|x| (x - mean) * (x - mean)).sum::<f64>();
    [mean, mean_information::elementary::sqrt(squares / (count - 1.0))]
}

/// The 97.5 % quantile of Student's distribution: from a table, between whose lines it is linear in one over the degrees of freedom.
fn quantile(blocks: usize) -> f64 {
    let table = [
        (4.0, 2.776),
        (5.0, 2.571),
        (7.0, 2.365),
        (9.0, 2.262),
        (14.0, 2.145),
        (19.0, 2.093),
        (29.0, 2.045),
        (49.0, 2.010),
        (f64::INFINITY, 1.960),
    ];
    let inverse = 1.0 / (blocks - 1) as f64;
    let after = table.partition_point(|(freedom, _)| 1.0 / freedom > inverse).clamp(1, table.len() - 1);
    let [(a, from), (b, to)] = [table[after - 1], table[after]];
    to + (inverse - 1.0 / b) / (1.0 / a - 1.0 / b) * (from - to)
}

fn main() -> Result<(), Error> {
    let words = std::env::args().skip(1);
    let numbers: Vec<usize> = words.map(|word| word.parse().expect("a whole number")).collect();
    let (runs, count) = match numbers[..] {
        [runs, count, ..] => (runs, count),
        _ => (200, 200),
    };
    let block_counts = if numbers.len() > 2 { &numbers[2..] } else { &[10, 20, 40, 200] };

    let others = (0..5 * runs as u64).map(|seed| Ok(Run::new(1 << 32 | seed, count)?.value()));
    let others = others.collect::<Result<Vec<_>, Error>>()?;
    let [truth, spread] = moments(others.into_iter());
    println!("{runs} runs of {count} scans; true difference {truth:.5}, standard deviation {spread:.5} bits");
    let runs: Vec<_> = (0..runs as u64).map(|seed| Run::new(seed, count)).collect::<Result<_, Error>>()?;
    for &block_count in block_counts {
        let differences = runs.iter().map(|run| run.difference(block_count));
        let differences = differences.collect::<Result<Vec<_>, Error>>()?;
        let [mean, _] = moments(differences.iter().map(Difference::standard_error));
        let holds = |found: &&Difference| {
            (found.value() - truth).abs() <= quantile(block_count) * found.standard_error()
        };
        let held = 100.0 * differences.iter().filter(holds).count() as f64 / runs.len() as f64;
        println!(
            "{block_count} blocks: mean standard error {mean:.5} bits; {held:.1} % of the intervals hold the truth"
        );
    }
    Ok(())
}
