//! Logs of range scans and trajectories: each is read or refused, and what is read keeps its promises.

use mean_information::scan::Pose;
use mean_information_files::scans::{NoReturn, RangeScan, Reading, ScanLog, ScanOptions, TimeField, carmen};
use mean_information_files::{Error, Trajectory, Warning, tum};

/// Reads a CARMEN log under both clocks: times ascend, every record gives a scan of the beams that say something, and what
/// is written of it is read again.
pub fn carmen_log(bytes: &[u8]) {
    for time in [TimeField::Sent, TimeField::Logged] {
        for maximum_range in [None, Some(7.5)] {
            let options = ScanOptions { maximum_range, time };
            if let Some(log) = kept(ScanLog::read_carmen(bytes, &options)) {
                check_log(&log, bytes.len(), &options);
            }
        }
    }
}

fn check_log(log: &ScanLog, bytes: usize, options: &ScanOptions) {
    let numbers: usize = log.scans.iter().map(|scan| scan.ranges().len()).sum();
    assert!(!log.scans.is_empty() && 2 * numbers <= bytes);
    check_warnings(&log.warnings);
    let times = log.times();
    for held in &log.trajectories {
        check_trajectory(&held.trajectory);
        let found = held.trajectory.at_times(&times, 0.0).unwrap();
        assert_eq!(found.without_pose, times.len() - held.trajectory.len());
    }
    for scan in &log.scans {
        check_scan(scan);
    }
    let mut written = Vec::new();
    carmen::write(&log.scans, "", &mut written).unwrap();
    let mut again =
        carmen::Records::new(&written[..], &ScanOptions { time: TimeField::Sent, ..options.clone() });
    for scan in &log.scans {
        let Some(Ok(carmen::Record::Scan(read))) = again.next() else { panic!("{scan:?}") };
        // Bit by bit, as not a number is among them.
        let bits = |scan: &RangeScan| scan.ranges().iter().map(|&x| x.to_bits() | nan(x)).collect::<Vec<_>>();
        assert_eq!(bits(scan), bits(&read));
        let rest = |scan: &RangeScan| {
            (
                scan.time(),
                scan.bearings().clone(),
                scan.limits(),
                scan.laser().copied(),
                scan.odometry().copied(),
            )
        };
        assert_eq!(rest(scan), rest(&read));
    }
    assert!(again.next().is_none());
}

/// All bits, for what is no number: its own are not written.
fn nan(x: f64) -> u64 {
    if x.is_nan() { u64::MAX } else { 0 }
}

pub(super) fn check_scan(record: &RangeScan) {
    let [least, greatest] = record.limits();
    let (mut returned, mut without) = (0, 0);
    for reading in record.readings() {
        match reading {
            Reading::Return(range) => {
                assert!(range > 0.0 && range >= least && range < greatest);
                returned += 1;
            }
            Reading::NoReturn => without += 1,
            Reading::Invalid => {}
        }
    }
    let pose = Pose::new(2.5, -0.5, 0.75).unwrap();
    for (no_return, beams) in [(NoReturn::LeftOut, returned), (NoReturn::Free, returned + without)] {
        let scan = record.scan_from(pose, no_return).unwrap();
        assert_eq!(scan.map_or(0, |scan| scan.beams().len()), beams);
    }
}

/// Reads a trajectory: times ascend, a pose is found at each, between two, and never beyond, and what is written of it is
/// read again.
pub fn trajectory(bytes: &[u8]) {
    let Some((trajectory, warnings)) = kept(tum::read(bytes)) else {
        return;
    };
    check_warnings(&warnings);
    assert!(16 * trajectory.len() <= bytes.len() + 1);
    check_trajectory(&trajectory);
    let mut written = Vec::new();
    tum::write(&trajectory, "", &mut written).unwrap();
    let (again, warnings) = tum::read(&written[..]).unwrap();
    assert_eq!((again.times(), warnings), (trajectory.times(), Vec::new()));
    for (own, read) in trajectory.poses().iter().zip(again.poses()) {
        assert_eq!(own.position(), read.position());
        // From -pi to pi is a whole turn.
        let apart = (own.theta() - read.theta()).abs();
        assert!(
            apart.min((apart - std::f64::consts::TAU).abs()) <= 1.0 / f64::from(1 << 30) / f64::from(1 << 19)
        );
    }
}

pub(super) fn check_trajectory(trajectory: &Trajectory) {
    let [start, end] = trajectory.span();
    assert!(trajectory.times().is_sorted_by(|before, after| before < after));
    assert_eq!(trajectory.pose_at(start.next_down(), f64::INFINITY), None);
    assert_eq!(trajectory.pose_at(end.next_up(), f64::INFINITY), None);
    for (&time, pose) in trajectory.times().iter().zip(trajectory.poses()) {
        assert_eq!(trajectory.pose_at(time, 0.0).as_ref(), Some(pose));
    }
    for (times, poses) in trajectory.times().windows(2).zip(trajectory.poses().windows(2)) {
        let middle = 0.5 * times[0] + 0.5 * times[1];
        let Some(between) = trajectory.pose_at(middle, f64::INFINITY) else { panic!("{middle}") };
        for k in 0..2 {
            let [from, to] = [0, 1].map(|end: usize| poses[end].position()[k]);
            // Three roundings to nearest, and one of each product where it is subnormal.
            let slack = 4.0 * f64::EPSILON * from.abs().max(to.abs()) + f64::from_bits(2);
            assert!((from.min(to) - slack..=from.max(to) + slack).contains(&between.position()[k]));
        }
    }
}

fn check_warnings(warnings: &[Warning]) {
    assert!(warnings.iter().all(|warning| !warning.to_string().is_empty()));
}

/// Returns what was read, or nothing if it was refused, in words.
fn kept<T>(read: Result<T, Error>) -> Option<T> {
    read.inspect_err(|fault| assert!(!fault.to_string().is_empty())).ok()
}
