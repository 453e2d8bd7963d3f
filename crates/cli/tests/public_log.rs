//! `meaninfo trajectory` on a public log, where it is there.

mod common;

use common::*;
use mean_information_files::scans::ScanOptions;
use mean_information_files::{read_scans, read_trajectory};
use mean_information_test_support::logs::shared;

/// The Intel Research Lab's log, where it is there: the rows of the chapter on evidence.
#[test]
fn the_rows_of_a_public_log() {
    let [Some(log), Some(slam), Some(odometry)] =
        ["intel.log", "intel.slam.tum", "intel.odometry.tum"].map(|file| shared(&format!("slam/{file}")))
    else {
        return;
    };
    let files = [&log, &slam, &odometry].map(|path| path.to_str().unwrap());
    if cfg!(debug_assertions) {
        return println!("skipped: takes a minute without optimization");
    }
    for (resolution, means) in [("0.1", [0.8490, 0.4799]), ("0.05", [0.8249, 0.4785])] {
        let rows = rows(&[&files[..], &["--resolution", resolution]].concat());
        let found: Vec<_> = rows.iter().map(|row| row["mean_information"].as_f64().unwrap()).collect();
        assert_eq!(found.iter().map(|x| (x * 1e4).round() / 1e4).collect::<Vec<_>>(), means);
        assert!(
            rows.iter()
                .all(|row| (row["scans"].as_u64(), row["scans_used"].as_u64()) == (Some(910), Some(910)))
        );
    }
}

/// The poses inside that log are those of the TUM files, to six digits: the yaw goes through a quaternion.
#[test]
fn the_poses_of_a_public_log_are_those_beside_it() {
    let Some(log) = shared("slam/intel.log") else { return };
    let log = read_scans(&log, &ScanOptions::default()).unwrap();
    for (held, file) in log.trajectories.iter().zip(["slam/intel.slam.tum", "slam/intel.odometry.tum"]) {
        let Some(file) = shared(file) else { return };
        let (beside, _) = read_trajectory(&file).unwrap();
        let found = beside.at_times(&log.times(), 0.0).unwrap();
        assert_eq!(found.without_pose, 0, "{}", held.name);
        for (own, other) in held.trajectory.poses().iter().zip(found.poses.into_iter().flatten()) {
            let ([x, y], [u, v]) = (own.position(), other.position());
            let turn = libm::remainder(own.theta() - other.theta(), std::f64::consts::TAU);
            assert!([x - u, y - v, turn].iter().all(|apart| apart.abs() < 1e-6), "{own:?} {other:?}");
        }
    }
}
