//! The Intel Research Lab's log (Radish, recorded by D. Hähnel), where it is there: mean information of its two trajectories.

use mean_information::scan::{Beam, Pose, Scan, ScanMap, TalliedMap, blocks};
use mean_information::sensor::SteppedSensor;
use mean_information::{Error, Tally};
use mean_information_test_support::logs::{LaserScan, flaser, shared};

/// Beams of 50 m and more are left out.
fn scans(log: &[LaserScan], pose: impl Fn(&LaserScan) -> [f64; 3]) -> Vec<Scan<f64>> {
    let scan = |scan: &LaserScan| {
        let [x, y, theta] = pose(scan);
        let beams = scan.beams().map(|(bearing, range)| Beam { bearing, range: Some(range) });
        Scan::new(Pose::new(x, y, theta)?, 50.0, beams.collect())
    };
    log.iter().map(scan).collect::<Result<_, Error>>().unwrap()
}

/// A wall as thick as a cell.
fn model(resolution: f64) -> impl Fn(f64) -> Result<SteppedSensor<f64>, Error> {
    move |range| SteppedSensor::new(range, resolution, 0.4, 0.7)
}

fn built(resolution: f64, scans: &[Scan<f64>]) -> ScanMap<f64> {
    let mut map = ScanMap::new(resolution).unwrap().with_agreement().unwrap();
    for scan in scans {
        map.insert(scan, model(resolution)).unwrap();
    }
    map
}

/// To four digits, as a plain computation had them before; in debug builds cells of 10 cm alone.
#[test]
fn corrected_poses_have_more_information_than_odometry() {
    let Some(path) = shared("slam/intel.log") else { return };
    let log = flaser(&std::fs::read_to_string(path).unwrap());
    assert_eq!(log.len(), 910);
    let (odometry, corrected) = (scans(&log, |scan| scan.odometry), scans(&log, |scan| scan.corrected));
    let digits = |x: f64| (x * 1e4).round() / 1e4;
    let rows = [(0.1, [0.4799, 0.8490], None), (0.05, [0.4785, 0.8249], Some([2_426_909.0, 370_961.0]))];
    for (resolution, expected, entropy) in rows.into_iter().take(if cfg!(debug_assertions) { 1 } else { 2 }) {
        let maps = [&odometry, &corrected].map(|scans| built(resolution, scans));
        let tallies = [&maps[0], &maps[1]].map(ScanMap::tally);
        assert_eq!([&tallies[0], &tallies[1]].map(|tally| digits(tally.mean_information())), expected);
        if let Some(entropy) = entropy {
            assert_eq!([&tallies[0], &tallies[1]].map(|tally| tally.entropy().round()), entropy);
        }
        let [first, second] = [&maps[0], &maps[1]].map(|map| map.agreement().unwrap());
        println!("{resolution} m: agreement {first} by odometry, {second} corrected");
        assert!(second > first);
    }
}

/// Blocks removed from the map of the whole log, and the series of a part of it.
#[test]
fn removed_blocks_and_series_are_whole_measurements() {
    let Some(path) = shared("slam/intel.log") else { return };
    let log = flaser(&std::fs::read_to_string(path).unwrap());
    let log = &log[..if cfg!(debug_assertions) { 90 } else { 910 }];
    let scans = scans(log, |scan| scan.corrected);
    let model = model(0.1);
    let mut map = TalliedMap::new(ScanMap::<f64>::new(0.1).unwrap());
    for (k, scan) in scans.iter().enumerate() {
        map.insert(scan, &model).unwrap();
        if k % 30 == 17 {
            assert_eq!(*map.tally(), map.map().tally());
        }
    }
    for block in blocks(scans.len(), 7).step_by(3) {
        let others: Vec<_> = [&scans[..block.start], &scans[block.end..]].concat();
        let expected: Tally<f64> = built(0.1, &others).tally();
        assert_eq!(map.without(&scans[block], &model).unwrap(), expected);
    }
}
