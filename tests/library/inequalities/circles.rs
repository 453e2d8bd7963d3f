//! Counting, and sums of information, on a beam and in a disc; lengths are in cells.

use super::search::{between, choice, inequalities, scaled};
use core::f64::consts::{LN_2, PI};
use mean_information::cell::{information, log_odds_from_occupancy};
use mean_information::elementary::{exp, ln, sqrt};
use mean_information::limit::{Weight, closed_form};
use mean_information::sensor::GaussianSensor;

/// `√(ln 4)`.
const B: f64 = 1.177_410_022_515_474_7;
/// The bound on `|η'|`, and that on its total variation.
const STEEPEST: f64 = 1.32404;
const BEND: f64 = 6.7619;

/// The centres up to `r` from the sensor, in a grid moved by `(x, y)`: column by column.
fn count(r: f64, [x, y]: [f64; 2]) -> f64 {
    let columns = ((-r - x).ceil() as i64)..=((r - x).floor() as i64);
    let chord = |i: i64| {
        let from = i as f64 + x;
        sqrt((r * r - from * from).max(0.0))
    };
    columns.map(chord).map(|half| (half - y).floor() - (-half - y).ceil() + 1.0).sum()
}

fn columns(r: f64) -> f64 {
    2.0 * r + 1.72 * sqrt(r) + 1.0
}

fn two_thirds(r: f64) -> f64 {
    exp(ln(r) * 2.0 / 3.0)
}

fn fine(r: f64) -> f64 {
    7.14 * two_thirds(r) + 0.5
}

fn offsets(u: &[f64]) -> [f64; 2] {
    [u[0], u[1]].map(|u| between(u, -0.5, 0.5))
}

/// A room: `α` from 1/30 to 3000, up to `x` cells deep.
struct Room {
    z: f64,
    sigma: f64,
    x: f64,
}

impl Room {
    fn new(u: &[f64], most: f64) -> Self {
        let (alpha, x) = (scaled(u[0], 1.0 / 30.0, 3000.0), scaled(u[1], 1.0, most));
        let sigma = x / (alpha + B);
        Self { z: alpha * sigma, sigma, x }
    }

    fn f(&self, rho: f64) -> f64 {
        let t = (rho - self.z) / self.sigma;
        if rho > self.x { 0.0 } else { information(exp(-t * t / 2.0)) }
    }

    fn limit(&self, weight: Weight) -> f64 {
        closed_form(&GaussianSensor::new(self.z, self.sigma).unwrap(), weight)
    }

    fn variation(&self) -> f64 {
        if self.z > self.sigma * B { 2.0 + self.f(0.0) } else { 2.0 - self.f(0.0) }
    }

    fn beam(&self) -> f64 {
        let sum: f64 = (0..=self.x as u32).map(|k| self.f(f64::from(k) + 0.5)).sum();
        (sum - self.x * self.limit(Weight::Radial)).abs()
    }

    fn disc(&self, [x, y]: [f64; 2]) -> f64 {
        let far = self.x as i32 + 2;
        let row = |j: i32| {
            let b = f64::from(j) + y;
            (-far..=far).map(move |i| f64::from(i) + x).map(move |a| sqrt(a * a + b * b))
        };
        let sum: f64 = (-far..=far).flat_map(row).map(|rho| self.f(rho)).sum();
        (sum - PI * self.x * self.x * self.limit(Weight::Area)).abs()
    }
}

/// Points of a grid moved by eighths of a cell that lie within `w = 1 / (1024 r)` of the circle of radius `r` through one
/// of them.
fn points_of_a_circle(u: &[f64]) -> Option<(f64, f64)> {
    let [x, y] = [u[0], u[1]].map(|u| choice(u, 8) as f64 / 8.0);
    let [i, j] = [u[2], u[3]].map(|u| between(u, 0.0, 60.0).floor());
    let r = sqrt((i + x) * (i + x) + (j + y) * (j + y));
    if r == 0.0 {
        return None;
    }
    let w = 1.0 / (1024.0 * r);
    let on_ring = |a: f64, b: f64| (sqrt(a * a + b * b) - r).abs() <= w;
    let mut found = 0;
    for i in (-r - w - x).ceil() as i64..=(r + w - x).floor() as i64 {
        let a = i as f64 + x;
        let height = sqrt((r * r - a * a).max(0.0));
        let mut rows: Vec<i64> = [height, -height]
            .iter()
            .flat_map(|b| (-2..=2).map(move |step| (b - y).round() as i64 + step))
            .collect();
        rows.sort_unstable();
        rows.dedup();
        found += rows.iter().filter(|&&j| on_ring(a, j as f64 + y)).count();
    }
    Some((found as f64, r))
}

inequalities! {
    beam: "convergence", "Lemma (beam)", 1, 0.0, |u| {
        let r = scaled(u[0], 0.1, 1000.0);
        Some(((r + 0.5).floor() - r).abs() / 0.5)
    };
    columns_of_a_disc: "convergence", "Lemma (columns)", 3, 0.0, |u| {
        let r = scaled(u[0], 0.001, 300.0);
        Some((count(r, offsets(&u[1..])) - PI * r * r).abs() / columns(r))
    };
    fine_grids: "convergence", "Lemma (fine grids)", 3, 0.0, |u| {
        let r = scaled(u[0], 5.0, 300.0);
        Some((count(r, offsets(&u[1..])) - PI * r * r).abs() / fine(r))
    };
    // Sums of some thousand numbers below 1, beside bounds above 1e-3.
    first_order_beam: "convergence", "Proposition (first order)", 2, 1e-9, |u| {
        let room = Room::new(u, 200.0);
        Some(room.beam() / (room.variation() / 2.0))
    };
    first_order_disc: "convergence", "Proposition (first order)", 4, 1e-9, |u| {
        let room = Room::new(u, 20.0);
        let bound = if room.x < 5.0 { columns(room.x) } else { columns(room.x).min(fine(room.x)) };
        Some(room.disc(offsets(&u[2..])) / (room.variation() * bound))
    };
    second_order_beam: "convergence", "Proposition (second order, beam)", 2, 1e-9, |u| {
        let room = Room::new(u, 200.0);
        Some(room.beam() / (BEND / (8.0 * room.sigma)))
    };
    second_order_disc: "convergence", "Proposition (second order, disc)", 4, 1e-9, |u| {
        let room = Room::new(u, 20.0);
        let root = sqrt(room.x);
        let bound = 0.8403 * (8.086 * root / room.sigma + 2.0 * room.variation() / root);
        Some(room.disc(offsets(&u[2..])) / bound)
    };
    bend: "convergence", "Lemma (bend)", 1, 1e-12, |u| {
        let t = between(u[0], -8.0, B);
        let p = exp(-t * t / 2.0);
        (p < 1.0).then(|| (t * p * log_odds_from_occupancy(p) / LN_2).abs() / STEEPEST)
    };
    points: "convergence", "Lemma (points of a circle)", 4, 0.0, |u| {
        let (found, r) = points_of_a_circle(u)?;
        Some(found / (2.0 + 6.31 * two_thirds(r)))
    };
}
