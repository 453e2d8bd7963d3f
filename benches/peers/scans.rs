//! Range scans of a public log inserted into a map. C++ reads the same scans from a file.

use crate::program::{Timed, beside, compiled, rows_of, with_mrpt};
use mean_information::Error;
use mean_information::scan::{Beam, Pose, Scan, ScanMap};
use mean_information::sensor::{GaussianSensor, InverseSensorModel, SteppedSensor};
use mean_information_test_support::logs::{LaserScan, flaser, shared};
use mean_information_test_support::timing::least_time;
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::Command;

/// A side of the cells, in metres.
const RESOLUTION: f64 = 0.05;

/// All is measured so many times in turn, and the least counts: what else runs, runs beside all.
const ROUNDS: usize = 5;

/// Inserts all scans into a new map.
fn built<M: InverseSensorModel<Float = f64>>(
    scans: &[Scan<f64>],
    model: impl Fn(f64) -> Result<M, Error>,
) -> ScanMap<f64> {
    let mut map = ScanMap::new(RESOLUTION).expect("a resolution");
    for scan in scans {
        map.insert(scan, &model).expect("a scan");
    }
    map
}

/// Ours, with the cells observed.
fn ours<M: InverseSensorModel<Float = f64>>(
    method: &str,
    scans: &[Scan<f64>],
    model: impl Fn(f64) -> Result<M, Error>,
) -> Timed<f64> {
    let seconds = least_time(1.0, || built(scans, &model));
    Timed { method: method.to_owned(), seconds, result: built(scans, &model).tally().observed() as f64 }
}

/// The scans as C++ reads them.
fn lines(log: &[LaserScan]) -> String {
    let mut text = String::new();
    for scan in log {
        let [x, y, theta] = scan.corrected;
        write!(text, "{x} {y} {theta} {}", scan.ranges.len()).expect("a string");
        for range in &scan.ranges {
            write!(text, " {range}").expect("a string");
        }
        text.push('\n');
    }
    text
}

pub(crate) fn compare() {
    let Some(path) = shared("slam/intel.log") else { return };
    let log = flaser(&fs::read_to_string(path).expect("the log"));
    let scan = |scan: &LaserScan| {
        let [x, y, theta] = scan.corrected;
        let beams = scan.beams().map(|(bearing, range)| Beam { bearing, range: Some(range) });
        Scan::new(Pose::new(x, y, theta)?, 50.0, beams.collect())
    };
    let scans: Vec<_> = log.iter().map(scan).collect::<Result<_, Error>>().expect("scans");
    let beams: usize = scans.iter().map(|scan| scan.beams().len()).sum();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("peers");
    fs::create_dir_all(&folder).expect("a folder to write to");
    let file = folder.join("scans");
    fs::write(&file, lines(&log)).expect("a folder to write to");
    let mut compiler = Command::new("c++");
    let plain = folder.join("plain");
    compiler.args(["-std=c++17", "-O3"]).arg(beside("scans.cpp")).arg("-o").arg(&plain);
    let plain = compiled(&mut compiler, plain);
    let mrpt = with_mrpt("scans.cpp", folder.join("mrpt-scans"));
    let peers = [("mrpt", &mrpt), ("plain", &plain)];
    let measure = || {
        let mut rows = vec![
            ours("ours, steps", &scans, |range| SteppedSensor::new(range, RESOLUTION, 0.4, 0.7)),
            ours("ours, Eq. 5", &scans, |range| GaussianSensor::new(range, RESOLUTION)),
        ];
        for (what, program) in peers.iter().filter_map(|(what, program)| Some((what, program.as_ref()?))) {
            let mut command = Command::new(program);
            rows.extend(rows_of(command.arg(&file).arg(RESOLUTION.to_string()).arg(what)));
        }
        rows
    };
    let mut rows: Vec<Timed<f64>> = measure();
    for _ in 1..ROUNDS {
        for (row, again) in rows.iter_mut().zip(measure()) {
            assert_eq!((&row.method, row.result), (&again.method, again.result));
            row.seconds = row.seconds.min(again.seconds);
        }
    }
    println!("| {beams} beams | us a beam | by MRPT's | cells observed |");
    println!("|---|---|---|---|");
    let unit = rows.iter().find(|row| row.method.contains("MRPT")).map_or(f64::NAN, |row| row.seconds);
    for Timed { method, seconds, result } in &rows {
        println!("| {method} | {:.3} | {:.2} | {result} |", seconds / beams as f64 * 1e6, seconds / unit);
    }
    fs::remove_dir_all(&folder).expect("the folder");
}
