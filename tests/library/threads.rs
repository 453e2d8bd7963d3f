//! Any number of threads: the same bits.

use mean_information::expected::Hypotheses;
use mean_information::map::encoding::{Encoding, MrptLogOdds, Probability};
use mean_information::map::{Geometry, Grid, Histogram};
use mean_information::room::CartesianRoom;
use mean_information::scan::{Beam, Pose, Scan, ScanMap};
use mean_information::sensor::GaussianSensor;
use rayon::ThreadPoolBuilder;
use rayon::prelude::*;

/// What `work` gives by one, two, three and seven threads.
fn by_threads<R: Send>(work: impl Fn() -> R + Sync) -> Vec<R> {
    let pool = |threads| ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    [1, 2, 3, 7].into_iter().map(|threads| pool(threads).install(&work)).collect()
}

fn check<E: Encoding<Stored: Send + Sync> + Sync>(width: usize, cells: Vec<E::Stored>) {
    let height = cells.len() / width;
    let map = Grid::<E>::new(width, height, Geometry::new(0.05, [0.0, 0.0]).unwrap(), cells).unwrap();
    let tally = map.tally();
    assert!(by_threads(|| map.par_tally()).iter().all(|by_threads| *by_threads == tally));
    let mean = tally.mean_information();
    assert!(by_threads(|| map.par_mean_information()).iter().all(|&by_threads| by_threads == mean));
    assert_eq!(map.mean_information(), mean);
}

#[test]
fn maps_of_floats_and_of_bytes() {
    let cells = |count: i32| (0..count).map(|k| (f64::from(k) * 0.618_033_988_7).fract());
    check::<Probability<f64>>(700, cells(700 * 500).collect());
    check::<Probability<f32>>(900, cells(900 * 700).map(|p| p as f32).collect());
    let bytes: Vec<i8> = cells(70_000).map(|p| (p * 255.0 - 127.0) as i8).collect();
    let by_threads = by_threads(|| bytes.par_chunks(900).map(Histogram::from_cells).sum::<Histogram>());
    assert!(by_threads.into_iter().all(|by_threads| by_threads == Histogram::from_cells(&bytes)));
    check::<MrptLogOdds>(1300, cells(1300 * 1900).map(|p| (p * 255.0 - 127.0) as i8).collect());
}

#[test]
fn rooms() {
    let sensor = GaussianSensor::new(2.0_f64, 0.2).unwrap();
    let room = CartesianRoom::new(sensor, 0.01, [0.25, 0.5]).unwrap();
    let tally = room.tally().unwrap();
    assert!(by_threads(|| room.par_tally()).into_iter().all(|by_threads| by_threads.unwrap() == tally));
    let endless = room.with_limit(10);
    assert!(by_threads(|| endless.par_tally()).iter().all(Result::is_err));
}

#[test]
fn expected_maps() {
    let map = |particle: i32| {
        let cells = (0..300 * 40).map(|k| ((k / 7 * (1 + particle / 2)) % 256 - 128) as i8).collect();
        let geometry = Geometry::new(0.05, [0.05 * f64::from(particle), 0.0]).unwrap();
        Grid::<MrptLogOdds>::new(40, 300, geometry, cells).unwrap()
    };
    let maps: Vec<_> = (0..5).map(map).collect();
    let hypotheses = Hypotheses::new(&maps, &[0.3, 0.1, 0.7, 0.2, 0.05]).unwrap();
    let tally = hypotheses.expected_tally().unwrap();
    assert_eq!(tally.cells(), 300 * 44);
    let by_threads = by_threads(|| hypotheses.par_expected_tally());
    assert!(by_threads.into_iter().all(|by_threads| by_threads.unwrap() == tally));
    assert!(hypotheses.with_max_cells(10).par_expected_tally().is_err());
}

/// In one row, in one column, and without a cell.
#[test]
fn expected_maps_of_any_shape() {
    for [width, height] in [[5000, 1], [1, 5000], [0, 0], [1, 1]] {
        let map = |particle: usize| {
            let cells = (0..width * height).map(|k| ((k / 9 * 7 + k % 50 / 49 * particle) % 256) as u8 as i8);
            let geometry = Geometry::new(0.05, [0.0; 2]).unwrap();
            Grid::<MrptLogOdds>::new(width, height, geometry, cells.collect()).unwrap()
        };
        let maps: Vec<_> = (0..5).map(map).collect();
        let hypotheses = Hypotheses::new(&maps, &[0.3, 0.1, 0.7, 0.2, 0.05]).unwrap();
        let tally = hypotheses.expected_tally().unwrap();
        assert_eq!(
            (tally.cells(), &tally),
            ((width * height) as u64, hypotheses.expected_map().unwrap().tally())
        );
        let by_threads = by_threads(|| hypotheses.par_expected_tally());
        assert!(by_threads.into_iter().all(|by_threads| by_threads.unwrap() == tally));
    }
}

#[test]
fn maps_of_scans() {
    let mut map = ScanMap::<f64>::new(0.02).unwrap();
    assert_eq!(map.par_tally(), map.tally());
    let beam = |k: i32| Beam { bearing: 0.3 * f64::from(k), range: Some(1.5 + 0.1 * f64::from(k)) };
    let scan = Scan::new(Pose::new(0.3, -0.2, 0.7).unwrap(), 9.0, (0..20).map(beam).collect()).unwrap();
    map.insert(&scan, |range| GaussianSensor::new(range, 0.3)).unwrap();
    let tally = map.tally();
    assert!(tally.observed() > 100);
    assert!(by_threads(|| map.par_tally()).iter().all(|by_threads| *by_threads == tally));
}
