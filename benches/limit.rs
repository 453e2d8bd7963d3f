//! The limit of the mean information: the time of a call.
//!
//! `cargo bench --bench limit`. Each group times 1024 rooms; the time of a call is printed as its throughput's inverse.

// What the library is compared with.
#![allow(clippy::disallowed_methods)]
#![allow(missing_docs)]

use core::f64::consts::{LN_2, PI};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use mean_information::cell::entropy;
use mean_information::elementary::exp;
use mean_information::limit::{Weight, adaptive, closed_form, rigorous};
use mean_information::quadrature::adaptive::{GaussKronrod, Rule};
use mean_information::quadrature::rigorous::Rigorous;
use mean_information::sensor::GaussianSensor;
use std::hint::black_box;

const COUNT: usize = 1024;

/// Rooms with `z / σ` from `2^low` to `2^high`, evenly over the exponents, from a multiplicative generator.
fn rooms(low: f64, high: f64) -> Vec<GaussianSensor<f64>> {
    let mut state = 20261124_u64;
    (0..COUNT)
        .map(|_| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let unit = (state >> 11) as f64 / (1_u64 << 53) as f64;
            GaussianSensor::new(0.37 * (low + (high - low) * unit).exp2(), 0.37).expect("positive and finite")
        })
        .collect()
}

/// The radial limit as the chapter has it for `α >= 1`, in series, with an `erfc` as short as the range allows.
fn in_series(sensor: &GaussianSensor<f64>) -> f64 {
    let erfc = |x: f64| {
        if x > 6.0 {
            return 0.0;
        }
        let (mut sum, mut term, mut n) = (0.0, x, 1.0);
        while term > 1e-18 * sum {
            sum += term;
            n += 2.0;
            term *= 2.0 * x * x / n;
        }
        1.0 - 2.0 / PI.sqrt() * (-x * x).exp() * sum
    };
    let (b, alpha) = ((2.0 * LN_2).sqrt(), sensor.range() / sensor.sigma());
    let tails = |k: f64| erfc(b * (k / 2.0).sqrt()) + erfc(alpha * (k / 2.0).sqrt());
    let first = (PI / 2.0).sqrt() * (2.0 - tails(1.0));
    let sum: f64 = (2..80).map(f64::from).map(|k| tails(k) / (k * k.sqrt() * (k - 1.0))).sum();
    let edges = b / 4.0 + alpha / 2.0 * (-alpha * alpha / 2.0).exp();
    let all = (2.0 * PI).sqrt() * 0.571_634_121_582_363_6;
    1.0 - (1.5 * first - edges - all + (PI / 2.0).sqrt() * sum) / LN_2 / (alpha + b)
}

fn closed_forms(criterion: &mut Criterion) {
    // Of one octave or more each: rooms, blind readings, and readings beyond the panels.
    for (name, low, high) in
        [("z/σ from 1 to 1000", 0.0, 10.0), ("z/σ < 1", -40.0, 0.0), ("z/σ > 1000", 10.0, 60.0)]
    {
        let rooms = rooms(low, high);
        let mut group = criterion.benchmark_group(format!("closed form, {name}"));
        group.throughput(Throughput::Elements(COUNT as u64));
        for weight in [Weight::Radial, Weight::Area] {
            assert!(rooms.iter().all(|room| (0.2308..=1.0).contains(&closed_form(room, weight))));
            for room in rooms.iter().step_by(64) {
                let limit = rigorous(room, weight, &Rigorous::default()).expect("a room");
                let value = closed_form(room, weight);
                assert!(limit.lower - f64::EPSILON <= value && value <= limit.upper + f64::EPSILON);
            }
            let sum = || rooms.iter().map(|room| closed_form(black_box(room), weight)).sum::<f64>();
            group.bench_function(format!("{weight:?}"), |bencher| bencher.iter(sum));
        }
        if low >= 0.0 {
            let right = |room| (in_series(room) - closed_form(room, Weight::Radial)).abs() < 1e-12;
            assert!(rooms.iter().all(right));
            let sum = || rooms.iter().map(|room| in_series(black_box(room))).sum::<f64>();
            group.bench_function("Radial, in series", |bencher| bencher.iter(sum));
        }
    }
}

/// The room of the report's Fig. 4, by both integrals; and the deficit by the crate `quadrature`, without a bound.
fn integrals(criterion: &mut Criterion) {
    let room = GaussianSensor::new(2.0_f64, 0.2).expect("positive and finite");
    let mut group = criterion.benchmark_group("integrals, z/σ = 10");
    for weight in [Weight::Radial, Weight::Area] {
        let known = closed_form(&room, weight);
        let enclose = || rigorous(black_box(&room), weight, &Rigorous::default()).expect("a room");
        let enclosure = enclose();
        assert!(enclosure.contains(known) && enclosure.width() <= 2.3e-16);
        group.bench_function(format!("rigorous, {weight:?}"), |bencher| bencher.iter(enclose));
        let rule = GaussKronrod::new().relative(1e-12).rule(Rule::K31);
        let estimate = || adaptive(black_box(&room), weight, &rule).expect("a room");
        assert!((estimate().value - known).abs() <= estimate().error && estimate().evaluations <= 550);
        group.bench_function(format!("adaptive, {weight:?}"), |bencher| bencher.iter(estimate));
    }
    let deficit = |t: f64| entropy(exp(-0.5 * t * t));
    let edge = (2.0 * LN_2).sqrt();
    let peer = || {
        quadrature::integrate(deficit, -10.0, 0.0, 1e-12).integral
            + quadrature::integrate(deficit, 0.0, black_box(edge), 1e-12).integral
    };
    assert!((1.0 - peer() / (10.0 + edge) - closed_form(&room, Weight::Radial)).abs() < 1e-12);
    group.bench_function("crate quadrature, Radial", |bencher| bencher.iter(peer));
}

criterion_group!(benches, closed_forms, integrals);
criterion_main!(benches);
