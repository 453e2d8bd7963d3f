//! Adaptive quadrature of the room in the variable `t`: ours beside double exponential quadrature by another hand.
//!
//! `cargo bench --bench quadrature`. Every result is checked against its exact value before it is timed.

#![allow(missing_docs)]

use criterion::{Criterion, criterion_group, criterion_main};
use mean_information::cell::entropy;
use mean_information::elementary::exp;
use mean_information::quadrature::adaptive::{GaussKronrod, Rule, graded};
use std::cell::Cell;
use std::hint::black_box;

/// `√(ln 4)`.
const EDGE: f64 = 1.1774100225154747;
/// `K(10)` of the chapter on the limit, which is `K(∞)` in double precision.
const K: f64 = 2.354667979156384;
/// Relative to the value.
const TOLERANCE: f64 = 1e-12;

fn deficit(t: f64) -> f64 {
    entropy(exp(-0.5 * t * t))
}

fn ours(points: &[f64], rule: Rule) -> f64 {
    let settings = GaussKronrod::new().relative(TOLERANCE).rule(rule);
    settings.integrate_between(deficit, points).map_or(f64::NAN, |estimate| estimate.value)
}

fn double_exponential(alpha: f64) -> f64 {
    let target = TOLERANCE * K / 2.0;
    let piece = |from, to| quadrature::integrate(deficit, from, to, target).integral;
    piece(-alpha, 0.0) + piece(0.0, EDGE)
}

fn room(criterion: &mut Criterion) {
    let graded =
        [graded(-10.0, 0.0, 0.125, 4), graded(EDGE, 0.0, 0.125, 3)].map(Result::unwrap_or_default).concat();
    let mut group = criterion.benchmark_group("K(10)");
    let mut time = |name: &str, integral: &dyn Fn() -> f64| {
        let error = (integral() / K - 1.0).abs();
        assert!(error <= TOLERANCE, "{name} is off by {error:e}");
        group.bench_function(name, |bencher| bencher.iter(|| black_box(integral())));
    };
    time("K31, graded", &|| ours(black_box(&graded), Rule::K31));
    time("K21, split at 0", &|| ours(black_box(&[-10.0, 0.0, EDGE]), Rule::K21));
    time("quadrature 0.1.2", &|| double_exponential(black_box(10.0)));
    group.finish();

    let count = Cell::new(0);
    let counted = |t: f64| {
        count.set(count.get() + 1);
        deficit(t)
    };
    let integral =
        GaussKronrod::new().relative(TOLERANCE).rule(Rule::K31).integrate_between(counted, &graded);
    assert!(integral.is_ok_and(|estimate| estimate.evaluations == count.get() && count.get() <= 550));
    // What the evaluations alone take, to compare the methods without them.
    criterion.bench_function("one evaluation", |bencher| bencher.iter(|| deficit(black_box(-0.75))));
}

criterion_group!(benches, room);
criterion_main!(benches);
