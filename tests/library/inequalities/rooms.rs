//! Grids of the circular room beside their limits, and averages beside each other.

use super::search::{IN_F64, between, choice, inequalities, scaled};
use crate::bounds::{self as bounds_of, Outcome};
use crate::common::power;
use mean_information::cell::entropy;
use mean_information::limit::{Weight, bounds, closed_form};
use mean_information::room::{CartesianRoom, PolarRoom, Sampling};
use mean_information::sensor::GaussianSensor;

/// `√(ln 4)`.
const B: f64 = 1.177_410_022_515_474_7;
/// More cells than these rooms have.
const CELLS: usize = 1 << 16;
/// What two maps can differ by in mean information where exact numbers do not: `2 ε`.
const ROUNDING: f64 = 58.0 / (1_u64 << 53) as f64;

/// A sensor and a cell size: `α` from 1/100 to 10 000, up to `most` cells in a room.
pub(super) fn room(u: &[f64], most: f64) -> (GaussianSensor<f64>, f64) {
    let (z, alpha) = (between(u[0], 0.3, 9.0), scaled(u[1], 0.01, 10_000.0));
    let sensor = GaussianSensor::new(z, z / alpha).unwrap();
    (sensor, z * (1.0 + B / alpha) / scaled(u[2], 0.3, most))
}

fn polar(u: &[f64]) -> Outcome {
    let (sensor, h) = room(u, 200.0);
    bounds_of::polar(sensor.range(), sensor.sigma(), h).unwrap()
}

fn cartesian(u: &[f64]) -> Outcome {
    let (sensor, h) = room(u, 30.0);
    let offsets = [u[3], u[4]].map(|u| between(u, -0.5, 0.5));
    bounds_of::cartesian(sensor.range(), sensor.sigma(), h, offsets).unwrap()
}

/// Averages over `n` samples to a side of rings or cells of `h`, as occupancies with the place of the first and the mean.
struct Averaged {
    cells: Vec<f64>,
    width: usize,
    /// The first corner, in cells.
    from: [f64; 2],
    mean: f64,
}

impl Averaged {
    fn polar(sensor: GaussianSensor<f64>, h: f64, n: u32) -> Self {
        let room = PolarRoom::new(sensor, h).unwrap().with_sampling(Sampling::Averaged(n)).unwrap();
        let map = room.map(1, CELLS).unwrap();
        let cells = map.cells().to_vec();
        Self { width: cells.len(), cells, from: [0.0, 0.0], mean: map.tally().mean_information() }
    }

    /// A corner of four cells on the sensor.
    fn cartesian(sensor: GaussianSensor<f64>, h: f64, n: u32) -> Self {
        let room = CartesianRoom::new(sensor, h, [0.5, 0.5]).unwrap();
        let map = room.with_sampling(Sampling::Averaged(n)).unwrap().map(CELLS).unwrap();
        let from = map.geometry().origin().map(|x| (x / h).round());
        Self { cells: map.cells().to_vec(), width: map.width(), from, mean: map.tally().mean_information() }
    }

    /// Whether every observed cell of the finer map, in blocks of `k`, lies in an observed one of this.
    fn observes(&self, fine: &Self, k: f64) -> bool {
        let place = |at: usize, axis: usize| {
            let inside = if axis == 0 { at % fine.width } else { at / fine.width };
            ((fine.from[axis] + inside as f64 + 0.5) / k - self.from[axis]).floor()
        };
        let seen = fine.cells.iter().enumerate().filter(|(_, p)| **p != 0.5).map(|(at, _)| at);
        let (width, height) = (self.width, self.cells.len() / self.width.max(1));
        seen.into_iter().all(|at| {
            let column = place(at, 0);
            // A beam has no rows.
            let row = if fine.cells.len() == fine.width { 0.0 } else { place(at, 1) };
            let inside = 0.0 <= column && column < width as f64 && 0.0 <= row && row < height as f64;
            inside && self.cells[row as usize * width + column as usize] != 0.5
        })
    }
}

/// The mean information of averages over `2 n` samples in cells of `2 h` and of `n` in cells of `h`, or over `n` samples and
/// of the grid of the samples.
fn nested(make: fn(GaussianSensor<f64>, f64, u32) -> Averaged, u: &[f64], samples: bool) -> Option<f64> {
    let (sensor, h) = room(u, 20.0);
    let n = 1 << choice(u[3], 3);
    let k = if samples { 2 * n } else { 2 };
    let (coarse, fine) = if samples {
        (make(sensor, h, k), make(sensor, h / f64::from(k), 1))
    } else {
        (make(sensor, 2.0 * h, 2 * n), make(sensor, h, n))
    };
    coarse.observes(&fine, f64::from(k)).then(|| coarse.mean / (fine.mean + ROUNDING))
}

/// By how much averages exceed the limit, over what the grid of their samples can.
fn above_the_limit(coarse: &Averaged, limit: f64, bound: f64) -> f64 {
    (coarse.mean - limit) / (bound + ROUNDING)
}

inequalities! {
    grids_polar: "convergence", "Theorem (grids)", 3, 0.0, |u| { let o = polar(u); Some(o.error / o.bound) };
    grids_polar_counted: "convergence", "Theorem (grids)", 3, 0.0, |u| {
        let o = polar(u);
        Some(o.error / o.with_count)
    };
    grids_polar_f32: "convergence", "Theorem (grids)", 3, 0.0, |u| {
        let (sensor, h) = room(u, 200.0);
        let o = bounds_of::polar(sensor.range() as f32, sensor.sigma() as f32, h as f32).unwrap();
        Some(o.error / o.bound)
    };
    // Where the bound is 1 it says nothing.
    grids_cartesian: "convergence", "Theorem (grids)", 5, 0.0, |u| {
        let o = cartesian(u);
        (o.bound < 1.0).then_some(o.error / o.bound)
    };
    grids_cartesian_counted: "convergence", "Theorem (grids)", 5, 0.0, |u| {
        let o = cartesian(u);
        Some(o.error / o.with_count)
    };
    grids_cartesian_f32: "convergence", "Theorem (grids)", 3, 0.0, |u| {
        let (sensor, h) = room(u, 30.0);
        let (z, sigma) = (sensor.range() as f32, sensor.sigma() as f32);
        let o = bounds_of::cartesian(z, sigma, h as f32, [0.5; 2]).unwrap();
        (o.bound < 1.0).then_some(o.error / o.bound)
    };
    nested_averages_polar: "convergence", "Theorem (nested averages)", 4, 0.0, |u| nested(Averaged::polar, u, false);
    nested_averages_cartesian: "convergence", "Theorem (nested averages)", 4, 0.0, |u| {
        nested(Averaged::cartesian, u, false)
    };
    averages_of_samples_polar: "convergence", "Theorem (nested averages)", 4, 0.0, |u| nested(Averaged::polar, u, true);
    averages_and_limit_polar: "convergence", "Theorem (nested averages)", 4, 0.0, |u| {
        let ((sensor, h), n) = (room(u, 60.0), 2 << choice(u[3], 3));
        let coarse = Averaged::polar(sensor, h, n);
        let fine = h / f64::from(n);
        if !coarse.observes(&Averaged::polar(sensor, fine, 1), f64::from(n)) { return None; }
        let limit = closed_form(&sensor, Weight::Radial);
        Some(above_the_limit(&coarse, limit, bounds::polar(&sensor, fine).unwrap()))
    };
    averages_and_limit_cartesian: "convergence", "Theorem (nested averages)", 4, 0.0, |u| {
        let ((sensor, h), n) = (room(u, 10.0), 2 << choice(u[3], 2));
        let coarse = Averaged::cartesian(sensor, h, n);
        let fine = h / f64::from(n);
        if !coarse.observes(&Averaged::cartesian(sensor, fine, 1), f64::from(n)) { return None; }
        let limit = closed_form(&sensor, Weight::Area);
        Some(above_the_limit(&coarse, limit, bounds::cartesian(&sensor, fine).unwrap()))
    };
    // Beside averages over 64 or 8 times as many samples, whose own error the bound has too.
    averages_polar: "grids", "Proposition (averages)", 4, 0.0, |u| {
        let ((sensor, h), n) = (room(u, 30.0), 1 << choice(u[3], 3));
        let cells = h / sensor.sigma();
        let bound = 0.1517 * cells / f64::from(n) * (1.0 + 1.0 / 64.0) + rounding(&sensor);
        Some(difference(&Averaged::polar(sensor, h, n), &Averaged::polar(sensor, h, 64 * n)) / bound)
    };
    averages_cartesian: "grids", "Proposition (averages)", 4, 0.0, |u| {
        let ((sensor, h), n) = (room(u, 5.0), 1 << choice(u[3], 2));
        let cells = h / sensor.sigma();
        let bound = 0.2321 * cells / f64::from(n) * (1.0 + 1.0 / 8.0) + rounding(&sensor);
        Some(difference(&Averaged::cartesian(sensor, h, n), &Averaged::cartesian(sensor, h, 8 * n)) / bound)
    };
    // A room in f32 and the same in f64, which adds 2^-29 of the bound.
    averages_rounded: "grids", "Proposition (averages)", 3, IN_F64, |u| {
        let (sensor, h) = room(u, 60.0);
        let (z, sigma, h) = (sensor.range() as f32, sensor.sigma() as f32, h as f32);
        let wide = GaussianSensor::new(f64::from(z), f64::from(sigma)).unwrap();
        let narrow = PolarRoom::new(GaussianSensor::new(z, sigma).unwrap(), h).unwrap();
        let narrow = narrow.with_sampling(Sampling::Averaged(2)).unwrap().map(1, CELLS).unwrap();
        let wide_map = Averaged::polar(wide, h.into(), 2);
        let bound = power(-24) * (0.61 * (wide.range() / wide.sigma() + 2.0) + 2.0);
        let differences = narrow.cells().iter().zip(&wide_map.cells).map(|(a, b)| (f64::from(*a) - b).abs());
        Some(differences.fold(0.0, f64::max) / bound)
    };
    // The most that rounding moves I(p).
    rounded_occupancies: "convergence", "Lemma (differences)", 1, 0.0, |u| {
        let bits = 2.0 + (u[0] * 60.0).floor();
        let half_a_unit = power(-(bits as i32) - 1);
        Some(entropy(half_a_unit) / ((bits + 2.5) * half_a_unit))
    };
}

fn rounding(sensor: &GaussianSensor<f64>) -> f64 {
    2.0 * power(-53) * (0.61 * (sensor.range() / sensor.sigma() + 2.0) + 2.0)
}

/// The largest difference of cells at the same places.
fn difference(a: &Averaged, b: &Averaged) -> f64 {
    let mut largest = 0.0_f64;
    for (at, p) in a.cells.iter().enumerate() {
        let [column, row] = [at % a.width, at / a.width];
        let place = [column as f64 + a.from[0] - b.from[0], row as f64 + a.from[1] - b.from[1]];
        // Beyond the extent of the other all is unknown.
        let inside = place[0] >= 0.0 && place[0] < b.width as f64 && place[1] >= 0.0;
        let other = if inside { b.cells.get(place[1] as usize * b.width + place[0] as usize) } else { None };
        largest = largest.max((p - other.unwrap_or(&0.5)).abs());
    }
    largest
}
