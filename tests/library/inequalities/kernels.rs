//! Single numbers: the functions in `f32` beside those in `f64`, whose error is `2^-29` of it, and the lemmas on their series.

use super::search::{IN_F64, between, choice, in_ulps, inequalities, occupancy, scaled};
use crate::common::power;
use core::f64::consts::LN_2;
use mean_information::cell::{
    entropy, entropy_from_log_odds, information, information_from_log_odds, log_odds_from_occupancy,
    occupancy_from_log_odds,
};
use mean_information::elementary::{exp, ln, sqrt};
use mean_information::room::{CartesianRoom, PolarRoom};
use mean_information::scalar::Scalar;
use mean_information::sensor::{GaussianSensor, InverseSensorModel};

/// How far each function in `f32` is from its value, over half an ulp.
fn correctly_rounded(u: &[f64]) -> f64 {
    let p: f32 = occupancy(u[1]);
    let x = (scaled(u[1], 1e-6, 80.0) * if u[2] < 0.5 { -1.0 } else { 1.0 }) as f32;
    let (q, y) = (f64::from(p), f64::from(x));
    let (near, exact) = match choice(u[0], 9) {
        0 => (entropy(p), entropy(q)),
        1 => (information(p), information(q)),
        2 if p > 0.0 && p < 1.0 => (log_odds_from_occupancy(p), log_odds_from_occupancy(q)),
        3 => (occupancy_from_log_odds(x), occupancy_from_log_odds(y)),
        4 => (entropy_from_log_odds(x), entropy_from_log_odds(y)),
        5 => (information_from_log_odds(x), information_from_log_odds(y)),
        6 => (exp(x), exp(y)),
        7 => (ln(x.abs()), ln(y.abs())),
        _ => (sqrt(x.abs()), sqrt(y.abs())),
    };
    in_ulps(near, exact, 0.5)
}

/// `x` between `low` and `high`, as a distance from the middle.
fn within(x: f64, low: f64, high: f64) -> f64 {
    (x - f64::midpoint(low, high)).abs() / ((high - low) / 2.0)
}

fn sensors(u: &[f64]) -> (GaussianSensor<f32>, f64, f64) {
    let z = between(u[0], 0.01, 40.0) as f32;
    let sigma = z / scaled(u[1], 0.01, 10_000.0) as f32;
    (GaussianSensor::new(z, sigma).unwrap(), z.into(), sigma.into())
}

inequalities! {
    correct_rounding: "rounding", "Theorem (correct rounding)", 3, IN_F64, |u| Some(correctly_rounded(u));
    correct_rounding_of_the_model: "rounding", "Theorem (correct rounding)", 3, IN_F64, |u| {
        let (sensor, z, sigma) = sensors(u);
        let rho = (z * between(u[2], 0.0, 1.0) + sigma) as f32;
        let wide = GaussianSensor::new(z, sigma).unwrap();
        Some(in_ulps(sensor.occupancy(rho), wide.occupancy(f64::from(rho)), 0.5))
    };
    // -L'(y) ln 2 = 1/2 - 2 y / 3 + 3 y^2 / 4 - …
    fall: "rounding", "Lemma (fall)", 1, 0.0, |u| {
        let y = between(u[0], -1.0 / 128.0, 1.0 / 128.0);
        let series = (1..12).rev().map(f64::from).fold(0.0, |rest, k| k / (k + 1.0) - y * rest);
        Some(within(series / LN_2, 0.71, 0.73))
    };
    exponential: "rounding", "Lemma (exponential)", 1, 0.0, |u| {
        let y = scaled(u[0], 1e-60, power(-107));
        Some(within(LN_2 - y * LN_2 * LN_2 / 2.0, 0.69, 0.7))
    };
    // For any y; the difference loses the digits of y^2 beside y.
    square: "rounding", "Lemma (square)", 1, 1e-8, |u| {
        let y = scaled(u[0], 0.001, 1.0);
        let next = 1.0 + y;
        // ln(1 + y), with what rounding took from y.
        let log = ln(next) + (y - (next - 1.0)) / next;
        if y < log { Some(f64::INFINITY) } else { Some((y - log) / (y * y / 2.0)) }
    };
    halving: "rounding", "Lemma (halving)", 1, 0.0, |u| {
        let k = (u[0] * 1000.0).floor();
        Some((k + 1.0) * power(-(k as i32)))
    };
    reach: "rounding", "Proposition (reach)", 2, IN_F64, |u| {
        let (sensor, z, sigma) = sensors(u);
        let reach = sensor.reach();
        if sensor.occupancy(reach.next_up()) != 0.5 { return Some(f64::INFINITY); }
        Some(in_ulps(reach, z + sigma * 1.177_410_022_515_474_7, 2.0))
    };
    distances: "rounding", "Proposition (distances)", 5, IN_F64, |u| {
        let sensor = GaussianSensor::new(2.0_f32, 0.2).unwrap();
        let s = scaled(u[0], 0.001, 1.0) as f32;
        let offsets = [u[1], u[2]].map(|u| between(u, -0.5, 0.5) as f32);
        let place = [u[3], u[4]].map(|u| between(u, -999.0, 999.0) as i64);
        let x = [0, 1].map(|k| place[k] as f64 + f64::from(offsets[k]));
        let exact = f64::from(s) * sqrt(x[0] * x[0] + x[1] * x[1]);
        let distance = CartesianRoom::new(sensor, s, offsets).unwrap().distance(place[0], place[1]).unwrap();
        Some(in_ulps(distance, exact, 0.5))
    };
    distances_of_rings: "rounding", "Proposition (distances)", 2, 0.0, |u| {
        let sensor = GaussianSensor::new(2.0_f32, 0.2).unwrap();
        let (s, k) = (scaled(u[0], 0.001, 1.0) as f32, (u[1] * 9999.0) as u64);
        let exact = f64::from(s) * (k as f64 + 0.5);
        Some(in_ulps(PolarRoom::new(sensor, s).unwrap().distance(k), exact, 0.5))
    };
    exp_m1: "quadrature", "Lemma (exp_m1)", 2, IN_F64, |u| {
        let x = (scaled(u[0], 1e-3, 80.0) * if u[1] < 0.5 { -1.0 } else { 1.0 }) as f32;
        Some(in_ulps(Scalar::exp_m1(x), core_math::expm1(x.into()), 2.0))
    };
    // The other side is the nearest float: so many ulp from it are half an ulp less from the value, or more.
    exp_m1_f64: "quadrature", "Lemma (exp_m1)", 2, 0.0, |u| {
        let x = scaled(u[0], 1e-3, 80.0) * if u[1] < 0.5 { -1.0 } else { 1.0 };
        let (ours, nearest) = (Scalar::exp_m1(x), core_math::expm1(x));
        let ulp = nearest.abs().next_up() - nearest.abs();
        Some(((ours - nearest).abs() / ulp - 0.5) / 2.0)
    };
    log_occupancy: "quadrature", "Lemma (entropy from the log-occupancy)", 1, IN_F64, |u| {
        let s = -scaled(u[0], 1e-6, 60.0) as f32;
        let wide = f64::from(s).entropy_from_log_occupancy();
        Some(in_ulps(s.entropy_from_log_occupancy(), wide, 2.0))
    };
}
