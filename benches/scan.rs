//! Scans inserted into a map: the time of a beam and of a cell it crosses; the tally of a cell after many scans; and
//! expected maps: the time of a cell of a particle, and of a cell on which they agree.
//!
//! `cargo bench --bench scan`.

#![allow(missing_docs)]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use mean_information::Error;
use mean_information::expected::Hypotheses;
use mean_information::map::encoding::{MrptLogOdds, Probability};
use mean_information::map::{Encoding, Geometry, Grid};
use mean_information::scan::{Beam, Pose, Scan, ScanMap};
use mean_information::sensor::{GaussianSensor, InverseSensorModel, SteppedSensor};
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

/// The tally of a map that `scans` scans of 720 beams were added to, 13 cm and 0.1 rad apart.
fn map_of_scans(criterion: &mut Criterion) {
    fn run<M: InverseSensorModel<Float = f64>>(
        criterion: &mut Criterion,
        name: &str,
        model: impl Fn(f64) -> Result<M, Error>,
    ) {
        let mut group = criterion.benchmark_group(format!("tally of a map of scans, {name}"));
        let (mut map, mut scans) = (ScanMap::<f64>::new(0.05).unwrap(), 0);
        for wanted in [1, 30, 100] {
            while scans < wanted {
                let step = f64::from(scans);
                let beam = |k: u32| {
                    let k = f64::from(k);
                    Beam {
                        bearing: 0.008_72 * k,
                        range: Some(6.0 + 3.0 * (1.0 - (0.016 * k).fract() * 2.0).abs()),
                    }
                };
                let pose = Pose::new(0.13 * step, 0.0, 0.1 * step).unwrap();
                map.insert(&Scan::new(pose, 12.0, (0..720).map(beam).collect()).unwrap(), &model).unwrap();
                scans += 1;
            }
            let tally = map.tally();
            assert_eq!(tally, map.log_odds().unwrap().tally());
            group.throughput(Throughput::Elements(tally.cells()));
            group.bench_function(BenchmarkId::new("alone", wanted), |bencher| {
                bencher.iter(|| black_box(&map).tally());
            });
            group.bench_function(BenchmarkId::new("with the log-odds", wanted), |bencher| {
                bencher.iter(|| black_box(&map).log_odds().unwrap().tally());
            });
        }
    }
    run(criterion, "steps", |range| SteppedSensor::new(range, 0.1, 0.3, 0.9));
    run(criterion, "Eq. 5", |range| GaussianSensor::new(range, 0.05));
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

/// What a particle stores of a cell.
type Stored<'a> = &'a dyn Fn(usize, usize) -> i8;

/// Twenty particles of 1000 x 1000 cells in MRPT's bytes.
fn agreement(criterion: &mut Criterion) {
    const SIDE: usize = 1000;
    let common = |k: usize| [0, 0, 0, 40, 40, 40, -60][k / 50 % 7];
    // Whether a particle has its own opinion of a cell: one of twenty in one of a hundred cells.
    let own = |particle: usize, k: usize| {
        let hash = (k as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40;
        hash.is_multiple_of(100) && hash / 100 % 20 == particle as u64
    };
    let cases: [(&str, Stored); 5] = [
        ("all unknown", &|_, _| 0),
        ("all agree, in runs", &|_, k| common(k)),
        ("all agree, each cell for itself", &|_, k| (k * 89 % 251) as i8),
        ("1 % differ", &|particle, k| if own(particle, k) { 7 } else { common(k) }),
        ("all differ", &|particle, k| ((k * 89 + particle * 31) % 251) as i8),
    ];
    let mut group = criterion.benchmark_group("expected tally of 20 particles of 1000 x 1000");
    group.sample_size(10).throughput(Throughput::Elements((SIDE * SIDE) as u64));
    let weights: Vec<f64> = (1..=20).map(|k| 0.3 / f64::from(k)).collect();
    let geometry = Geometry::new(0.05, [0.0; 2]).unwrap();
    for (name, stored) in cases {
        let map = |particle| {
            let cells = (0..SIDE * SIDE).map(|k| stored(particle, k)).collect();
            Grid::<MrptLogOdds>::new(SIDE, SIDE, geometry, cells).unwrap()
        };
        let maps: Vec<_> = (0..20).map(map).collect();
        let hypotheses = Hypotheses::new(&maps, &weights).unwrap();
        assert_eq!(&hypotheses.expected_tally().unwrap(), hypotheses.expected_map().unwrap().tally());
        group.bench_function(name, |bencher| bencher.iter(|| black_box(&hypotheses).expected_tally()));
    }
}

criterion_group!(benches, insertion, map_of_scans, expected, agreement);
criterion_main!(benches);
