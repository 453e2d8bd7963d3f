//! Scans inserted into a map: the time of a beam and of a cell it crosses; and expected maps: of a cell of a particle.
//!
//! `cargo bench --bench scan`.

#![allow(missing_docs)]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use mean_information::Error;
use mean_information::build::{Beam, Hypotheses, Pose, Scan, ScanMap};
use mean_information::map::encoding::{MrptLogOdds, Probability};
use mean_information::map::{Encoding, Geometry, Grid};
use mean_information::sensor::{GaussianSensor, SteppedSensor};
use std::hint::black_box;

/// A laser scanner of 360 beams, whose ranges are spread from 1 m to 9 m by the golden ratio.
fn scan() -> Scan<f64> {
    let beam = |k: u32| Beam {
        bearing: f64::from(k) * 0.017_45,
        range: Some(1.0 + 8.0 * (f64::from(k) * 0.618_033_988_749_894_9).fract()),
    };
    Scan::new(Pose::new(0.31, -0.22, 0.4).unwrap(), 10.0, (0..360).map(beam).collect()).unwrap()
}

fn insertion(criterion: &mut Criterion) {
    let scan = scan();
    let mut group = criterion.benchmark_group("scan of 360 beams");
    group.throughput(Throughput::Elements(360));
    for (resolution, by_gaussian, by_steps) in
        [(0.2, 0.7727716989617477, 0.14215909118578385), (0.05, 0.7879646539077404, 0.13085603712953106)]
    {
        let empty = ScanMap::<f64>::new(resolution).unwrap();
        let gaussian = |range| GaussianSensor::new(range, 0.05);
        let stepped = |range| SteppedSensor::new(range, 0.1, 0.3, 0.9);
        let check = |inserted: Result<ScanMap<f64>, Error>, expected: f64| {
            let tally = inserted.and_then(|map| map.log_odds()).unwrap().tally();
            println!("{} cells observed at {resolution} m", tally.observed());
            assert_eq!(tally.mean_information(), expected);
        };
        let mut map = empty.clone();
        check(map.insert(&scan, gaussian).map(|()| map), by_gaussian);
        let mut map = empty.clone();
        check(map.insert(&scan, stepped).map(|()| map), by_steps);
        group.bench_function(BenchmarkId::new("Eq. 5", resolution), |bencher| {
            bencher.iter_batched_ref(
                || empty.clone(),
                |map| map.insert(black_box(&scan), gaussian),
                criterion::BatchSize::LargeInput,
            );
        });
        group.bench_function(BenchmarkId::new("steps", resolution), |bencher| {
            bencher.iter_batched_ref(
                || empty.clone(),
                |map| map.insert(black_box(&scan), stepped),
                criterion::BatchSize::LargeInput,
            );
        });
    }
}

/// Twenty particles of 64 x 64 cells, a third of them unknown, and unequal weights.
fn particles<E: Encoding>(stored: impl Fn(usize) -> E::Stored) -> (Vec<Grid<E>>, Vec<f64>) {
    let geometry = Geometry::new(0.05, [0.0; 2]).unwrap();
    let cell = |particle: usize, k: usize| {
        if k.is_multiple_of(3) { E::unknown() } else { stored(97 * k + particle) }
    };
    let map = |particle| Grid::new(64, 64, geometry, (0..4096).map(|k| cell(particle, k)).collect()).unwrap();
    ((0..20).map(map).collect(), (1..=20).map(|k| 0.3 / f64::from(k)).collect())
}

fn expected(criterion: &mut Criterion) {
    fn run<E: Encoding<Float = f64>>(
        criterion: &mut Criterion,
        name: &str,
        emmi: f64,
        (maps, weights): (Vec<Grid<E>>, Vec<f64>),
    ) {
        let hypotheses = Hypotheses::new(&maps, &weights).unwrap();
        assert_eq!(hypotheses.expected_map().unwrap().tally().mean_information(), emmi);
        let mut group = criterion.benchmark_group("expected map of 20 particles");
        group.throughput(Throughput::Elements(20 * 4096));
        group.bench_function(name, |bencher| bencher.iter(|| black_box(&hypotheses).expected_map()));
    }
    let probability = |k: usize| (k as f64 * 0.618_033_988_749_894_9).fract();
    let probabilities = particles::<Probability<f64>>(probability);
    run(criterion, "probabilities", 0.013694185744208233, probabilities);
    let bytes = particles::<MrptLogOdds>(|k| (k % 101) as i8 - 120);
    run(criterion, "MRPT's bytes", 0.7907388516355743, bytes);
}

criterion_group!(benches, insertion, expected);
criterion_main!(benches);
