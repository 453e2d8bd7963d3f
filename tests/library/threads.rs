//! Any number of threads: the same bits.

use mean_information::build::CartesianRoom;
use mean_information::map::encoding::{Encoding, MrptLogOdds, Probability};
use mean_information::map::{Geometry, Grid};
use mean_information::sensor::GaussianSensor;
use rayon::ThreadPoolBuilder;

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
