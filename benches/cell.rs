//! One cell: the time of a call, beside what is usually written, and how wrong that is on the same arguments.
//!
//! `cargo bench --bench cell`. Each group times 1024 arguments; the time of a call is printed as its throughput's inverse.

// What the library is compared with.
#![allow(clippy::disallowed_methods)]
#![allow(missing_docs)]

use core::f64::consts::LN_2;
use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use mean_information::cell::{
    Cell, entropy, entropy_from_log_odds, information, information_from_log_odds, occupancy_from_log_odds,
};
use mean_information::elementwise as many;
use std::hint::black_box;

const COUNT: usize = 1024;

/// Eq. 1 as it stands.
fn two_logarithms(p: f64) -> f64 {
    -p * p.log2() - (1.0 - p) * (1.0 - p).log2()
}

/// SciPy's `entr`, `-x ln x` and 0 at 0, of both terms.
fn entr_of_both(p: f64) -> f64 {
    let entr = |x: f64| if x > 0.0 { -x * x.ln() } else { 0.0 };
    (entr(p) + entr(1.0 - p)) / LN_2
}

/// `1 / (1 + e^-l)` and Eqs. 1 and 3.
fn information_through_occupancy(l: f64) -> f64 {
    1.0 - two_logarithms(1.0 / (1.0 + (-l).exp()))
}

/// Arguments from a multiplicative generator, uniform in `(0, 1)`, given a shape.
fn arguments(shape: fn(f64) -> f64) -> Vec<f64> {
    let mut state = 20261121_u64;
    (0..COUNT)
        .map(|_| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            shape(((state >> 11) as f64 + 0.5) / (1_u64 << 53) as f64)
        })
        .collect()
}

/// A group of functions timed on the same arguments and compared with the library.
struct Comparison<'a> {
    group: BenchmarkGroup<'a, WallTime>,
    arguments: &'a [f64],
    exact: fn(f64) -> f64,
}

impl<'a> Comparison<'a> {
    fn new(criterion: &'a mut Criterion, name: &str, arguments: &'a [f64], exact: fn(f64) -> f64) -> Self {
        let mut group = criterion.benchmark_group(name);
        group.throughput(Throughput::Elements(COUNT as u64));
        Self { group, arguments, exact }
    }

    /// Times a function that must be within `error` of the exact value, relative to it.
    fn time(&mut self, name: &str, function: impl Fn(f64) -> f64, error: f64) -> &mut Self {
        let worst =
            self.arguments.iter().map(|&x| (function(x) / (self.exact)(x) - 1.0).abs()).fold(0.0, f64::max);
        assert!(worst <= error, "{name} is off by {worst:e} of the value");
        let sum = || self.arguments.iter().map(|&x| function(black_box(x))).sum::<f64>();
        self.group.bench_function(name, |bencher| bencher.iter(sum));
        self
    }
}

fn cells(criterion: &mut Criterion) {
    let uniform = arguments(|u| u);
    let tiny = arguments(|u| u * 1e-12);
    let near_half = arguments(|u| 0.5 + (u - 0.5) * 1e-3);
    let odds = arguments(|u| 16.0 * (u - 0.5));
    for (name, arguments, error) in
        [("uniform p", &uniform, 1e-14), ("tiny p", &tiny, 0.1), ("p near 1/2", &near_half, 1e-15)]
    {
        Comparison::new(criterion, &format!("H, {name}"), arguments, entropy)
            .time("library", entropy, 0.0)
            .time("two logarithms", two_logarithms, error)
            .time("entr", entr_of_both, error);
    }
    for (name, arguments, error) in [("uniform p", &uniform, 1e-9), ("p near 1/2", &near_half, 1e-2)] {
        Comparison::new(criterion, &format!("I, {name}"), arguments, information)
            .time("library", information, 0.0)
            .time("1 - two logarithms", |p| 1.0 - two_logarithms(p), error);
    }
    Comparison::new(criterion, "I, log-odds", &odds, information_from_log_odds)
        .time("library", information_from_log_odds, 0.0)
        .time("1 - two logarithms", information_through_occupancy, 1e-7);
    Comparison::new(criterion, "p, log-odds", &odds, occupancy_from_log_odds)
        .time("library", occupancy_from_log_odds, 0.0)
        .time("1 / (1 + exp)", |l| 1.0 / (1.0 + (-l).exp()), 1e-14);
    // Both at once, as a map does it.
    let both = |p| Cell::from_occupancy(p).map_or(0.0, |cell| cell.entropy() + cell.information());
    Comparison::new(criterion, "H + I, uniform p", &uniform, |_| 1.0).time("Cell", both, f64::EPSILON);
}

/// Many cells at once, from a slice into a slice.
fn elementwise(criterion: &mut Criterion) {
    let (uniform, odds) = (arguments(|u| u), arguments(|u| 16.0 * (u - 0.5)));
    let mut group = criterion.benchmark_group("elementwise");
    group.throughput(Throughput::Elements(COUNT as u64));
    let mut results = vec![0.0; COUNT];
    let functions: [(_, _, fn(&[f64], &mut [f64]), fn(f64) -> f64); 5] = [
        ("H", &uniform, many::entropy, entropy),
        ("I", &uniform, many::information, information),
        ("H, log-odds", &odds, many::entropy_from_log_odds, entropy_from_log_odds),
        ("I, log-odds", &odds, many::information_from_log_odds, information_from_log_odds),
        ("p, log-odds", &odds, many::occupancy_from_log_odds, occupancy_from_log_odds),
    ];
    for (name, arguments, many, one) in functions {
        many(arguments, &mut results);
        assert!(arguments.iter().zip(&results).all(|(&x, &result)| result == one(x)));
        group.bench_function(name, |bencher| bencher.iter(|| many(black_box(arguments), &mut results)));
    }
}

criterion_group!(benches, cells, elementwise);
criterion_main!(benches);
