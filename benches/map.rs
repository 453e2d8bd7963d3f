//! A map's cells: the time of a cell in each encoding, beside the least that reading them takes.
//!
//! `cargo bench --bench map`.

#![allow(missing_docs)]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use mean_information::map::Histogram;
use mean_information::map::encoding::{Encoding, LogOdds, MrptLogOdds, Percent, Probability};
use mean_information::{Real, Tally};
use std::hint::black_box;

/// Four times the second-level cache of today's machines would hold in `f64`.
const COUNT: usize = 1 << 20;

/// Occupancies spread over (0, 1) by the golden ratio.
fn occupancies<T: Real>() -> Vec<T> {
    (1..=COUNT).map(|k| T::nearest((k as f64 * 0.618_033_988_749_894_9).fract())).collect()
}

/// Every value about as often, in no order.
fn bytes(allowed: impl Fn(i8) -> bool) -> Vec<i8> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 56) as i8
    };
    std::iter::repeat_with(&mut next).filter(|&b| allowed(b)).take(COUNT).collect()
}

/// A map as ROS saves it: long runs of free, occupied and unknown.
fn trinary() -> Vec<i8> {
    (0..COUNT).map(|k| [0, -1, 0, -1, -1, 100][k / 97 % 6]).collect()
}

fn one_by_one<E: Encoding>(cells: &[E::Stored]) -> Tally<E::Float> {
    cells.iter().filter_map(|&stored| E::cell(stored)).collect()
}

/// Eq. 4 as it is usually written: two logarithms a cell, a sum in the order of the cells.
#[expect(clippy::disallowed_methods, reason = "what others use")]
fn two_logarithms<T: Real + Into<f64>>(cells: &[T]) -> f64 {
    let information = |p: f64| 1.0 + p * p.log2() + (1.0 - p) * (1.0 - p).log2();
    let observed = cells.iter().map(|&p| p.into()).filter(|&p: &f64| p != 0.5);
    let (sum, count) = observed.fold((0.0, 0_u32), |(sum, count), p| (sum + information(p), count + 1));
    sum / f64::from(count)
}

fn encoding<E: Encoding>(criterion: &mut Criterion, name: &str, cells: &[E::Stored]) {
    assert_eq!(E::tally(cells), one_by_one::<E>(cells));
    let mut group = criterion.benchmark_group(name);
    group.throughput(Throughput::Elements(COUNT as u64));
    assert_eq!(E::information_sum(cells), (&E::tally(cells)).into());
    group.bench_function("tally", |bencher| bencher.iter(|| E::tally(black_box(cells))));
    group.bench_function("information", |bencher| bencher.iter(|| E::information_sum(black_box(cells))));
    group.finish();
}

fn floats(criterion: &mut Criterion) {
    encoding::<Probability<f64>>(criterion, "f64", &occupancies());
    encoding::<Probability<f32>>(criterion, "f32", &occupancies());
    // Every other cell unknown as NaN, in no order.
    let half = occupancies::<f64>().into_iter().zip(bytes(|_| true));
    let half: Vec<f64> = half.map(|(p, byte)| if byte < 0 { f64::NAN } else { p }).collect();
    encoding::<Probability<f64>>(criterion, "f64, half NaN", &half);
    let half: Vec<f32> = half.into_iter().map(|p| p as f32).collect();
    encoding::<Probability<f32>>(criterion, "f32, half NaN", &half);
    let cells = occupancies::<f64>();
    let mut group = criterion.benchmark_group("f64");
    group.throughput(Throughput::Elements(COUNT as u64));
    group.sample_size(20);
    group.bench_function(BenchmarkId::from_parameter("two logarithms"), |bencher| {
        bencher.iter(|| two_logarithms(black_box(&cells)));
    });
    group.bench_function(BenchmarkId::from_parameter("one by one"), |bencher| {
        bencher.iter(|| one_by_one::<Probability<f64>>(black_box(&cells)));
    });
    group.finish();
}

fn stored_bytes(criterion: &mut Criterion) {
    let any = bytes(|_| true);
    encoding::<MrptLogOdds>(criterion, "bytes, mixed", &any);
    encoding::<Percent>(criterion, "percent, mixed", &bytes(|b| (-1..=100).contains(&b)));
    encoding::<Percent>(criterion, "percent, trinary", &trinary());
    let mut group = criterion.benchmark_group("bytes");
    group.throughput(Throughput::Elements(COUNT as u64));
    group.bench_function("sum", |bencher| {
        bencher.iter(|| black_box(&any).iter().map(|&b| u64::from(b as u8)).sum::<u64>());
    });
    group.finish();
}

/// Pieces of a map as they are read: rows of a narrow one are short.
fn pieces(criterion: &mut Criterion) {
    let maps = [("mixed", bytes(|_| true)), ("trinary", trinary())];
    for (name, cells) in maps {
        let mut group = criterion.benchmark_group(format!("bytes in pieces, {name}"));
        group.throughput(Throughput::Elements(COUNT as u64));
        for piece in [8, 64, 200, 1000, 4000, 65536] {
            let count = || {
                let mut histogram = Histogram::new();
                black_box(&cells).chunks(piece).for_each(|piece| histogram.add_cells(piece));
                histogram
            };
            assert_eq!(count(), Histogram::from_cells(&cells));
            group.bench_function(BenchmarkId::from_parameter(piece), |bencher| bencher.iter(count));
        }
        group.finish();
    }
}

/// Of a sensor of three steps, where scans add up to few values; of more than there are slots for; and of Eq. 5, where
/// hardly one occurs again.
fn log_odds(criterion: &mut Criterion) {
    let counts = bytes(|_| true).into_iter().map(|byte| (f64::from(byte & 3), f64::from(byte >> 4 & 7)));
    let steps: Vec<f64> = counts.map(|(hits, misses)| 0.85 * hits - 0.4 * misses).collect();
    encoding::<LogOdds<f64>>(criterion, "log-odds, few values", &steps);
    let cells = occupancies::<f64>().into_iter();
    let many: Vec<f64> = cells.map(|p| 12.0 * (p * 8000.0).floor() / 8000.0 - 6.0).collect();
    encoding::<LogOdds<f64>>(criterion, "log-odds, 8000 values", &many);
    let all: Vec<f64> = occupancies::<f64>().into_iter().map(|p| 12.0 * p - 6.0).collect();
    encoding::<LogOdds<f64>>(criterion, "log-odds, all different", &all);
    let all: Vec<f32> = all.into_iter().map(|l| l as f32).collect();
    encoding::<LogOdds<f32>>(criterion, "log-odds in f32, all different", &all);
}

criterion_group!(benches, floats, stored_bytes, pieces, log_odds);
criterion_main!(benches);
