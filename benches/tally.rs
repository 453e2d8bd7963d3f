//! The sum of a map's information: the time of an added value, beside sums that are not exact.
//!
//! `cargo bench --bench tally`.

#![allow(missing_docs)]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use mean_information::ExactSum;
use mean_information::cell::information;
use std::hint::black_box;

const COUNT: usize = 4096;

fn exact(terms: &[f64]) -> f64 {
    let mut sum = ExactSum::new();
    for &x in terms {
        sum.add(x);
    }
    sum.value()
}

/// In the order of the terms.
fn plain(terms: &[f64]) -> f64 {
    terms.iter().sum()
}

/// Neumaier 1974: the sum with the roundings of each addition added up apart.
fn neumaier(terms: &[f64]) -> f64 {
    let (mut sum, mut rest) = (0.0_f64, 0.0);
    for &x in terms {
        let next = sum + x;
        rest += if sum >= x { (sum - next) + x } else { (x - next) + sum };
        sum = next;
    }
    sum + rest
}

/// In units of `2^-60`: independent of the order, but what lies below is lost.
fn fixed_point(terms: &[f64]) -> f64 {
    let scale = (1_u64 << 60) as f64;
    terms.iter().map(|&x| (x * scale) as i128).sum::<i128>() as f64 / scale
}

fn sums(criterion: &mut Criterion) {
    // Occupancies spread over (0, 1) by the golden ratio.
    let terms: Vec<f64> =
        (1..=COUNT).map(|k| information((k as f64 * 0.618_033_988_749_894_9).fract())).collect();
    let right = exact(&terms);
    let mut reversed = terms.clone();
    reversed.reverse();
    assert_eq!(right.to_bits(), exact(&reversed).to_bits());
    let mut group = criterion.benchmark_group("sum");
    group.throughput(Throughput::Elements(COUNT as u64));
    for (name, sum, error) in [
        ("ExactSum", exact as fn(&[f64]) -> f64, 0.0),
        ("plain", plain, 1e-13),
        ("Neumaier", neumaier, 1e-15),
        ("i128, 2^-60", fixed_point, 1e-14),
    ] {
        assert!((sum(&terms) / right - 1.0).abs() <= error, "{name}: {:e}", sum(&terms) / right - 1.0);
        group.bench_function(name, |bencher| bencher.iter(|| sum(black_box(&terms))));
    }
}

criterion_group!(benches, sums);
criterion_main!(benches);
