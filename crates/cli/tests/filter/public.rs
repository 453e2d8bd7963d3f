//! GMapping's log of the third floor of MIT CSAIL, where it is there: what docs/expected.md says of it.

use super::{check, rows};
use crate::common::{read, text};
use mean_information_files::particles::FilterLog;
use mean_information_files::read_filter_log;
use mean_information_files::scans::ScanOptions;
use mean_information_test_support::logs::shared;
use serde_json::Value;

/// The log, and its rows by every scan; `None`, and says so, where it is not there or this is a debug build.
fn csail() -> Option<(FilterLog, Vec<Value>)> {
    let path = shared("slam/csail.gfs")?;
    if cfg!(debug_assertions) {
        println!("skipped: takes minutes without optimisation; run with --release");
        return None;
    }
    let log = read_filter_log(&path, &ScanOptions::default()).unwrap();
    Some((log, rows(&[path.to_str().unwrap()])))
}

/// One run for all that is said of it: the first row, one in the middle and the last against maps that share nothing, and the
/// numbers of the page.
#[test]
fn rows_of_a_public_log() {
    let Some((log, rows)) = csail() else { return };
    assert_eq!(rows.len(), 406);
    for step in [0, 203, 405] {
        check(&log, &rows[step], 0.05);
    }
    the_table_of_the_page(&rows);
    what_the_page_counts(&rows);
}

fn number(row: &Value, key: &str) -> f64 {
    row[key].as_f64().unwrap()
}

/// How far the particles' own mean is above that of the expected map.
fn gap(row: &Value) -> f64 {
    number(row, "mean_of_particles") - number(row, "emmi")
}

/// The rows of the table around the closing of the loop, each number as it is printed there.
fn the_table_of_the_page(rows: &[Value]) {
    let page = read(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/expected.md"));
    let page = text(&page);
    let (_, table) = page.split_once("| scan | what |").expect("the table");
    let lines: Vec<_> = table.lines().skip(2).take_while(|line| line.starts_with('|')).collect();
    assert_eq!(lines.len(), 4);
    for line in lines {
        let cells: Vec<_> = line.trim_matches('|').split('|').map(str::trim).collect();
        let row = &rows[cells[0].parse::<usize>().unwrap()];
        let observed = row["observed"].as_u64().unwrap();
        let found = [
            format!("{:.3}", number(row, "emmi")),
            format!("{} {:03}", observed / 1000, observed % 1000),
            format!("{:.1}", number(row, "information_bits") / 1e3),
            format!("{:.3}", number(row, "mean_of_particles")),
            format!("{:.3}", gap(row)),
            format!("{:.1}", number(row, "entropy_bits") / 1e3),
        ];
        assert_eq!(&cells[2..], found, "{line}");
    }
}

/// "After 43 of the 47 resamplings", "of the other 358 scans the gap narrows at 40", and the greatest rises.
fn what_the_page_counts(rows: &[Value]) {
    let is_resampled = |row: &Value| row["resampled"] == true;
    let (after, others): (Vec<_>, Vec<_>) = rows.windows(2).partition(|pair| is_resampled(&pair[0]));
    let rises = |pair: &&[Value]| number(&pair[1], "emmi") > number(&pair[0], "emmi");
    let narrows = |pair: &&[Value]| gap(&pair[1]) < gap(&pair[0]);
    let both = after.iter().filter(|pair| rises(pair) && narrows(pair)).count();
    assert_eq!((after.len(), both), (47, 43));
    assert_eq!((others.len(), others.iter().filter(|pair| narrows(pair)).count()), (358, 40));
    for (scan, rise) in [(13, "0.167"), (73, "0.127"), (111, "0.111")] {
        assert_eq!(
            format!("{:.3}", number(&rows[scan + 1], "emmi") - number(&rows[scan], "emmi")),
            rise,
            "{scan}"
        );
    }
}

/// GMapping spaces an odd number of beams evenly around 0, as CARMEN does: its 361 beams are half a degree apart. An even number it
/// parts by a gap at 0 of two steps, of which this log has none.
#[test]
fn bearings_are_those_that_gmapping_matched_by() {
    let Some(path) = shared("slam/csail.gfs") else { return };
    let log = read_filter_log(&path, &ScanOptions::default()).unwrap();
    for step in &log.steps {
        let scan = &step.scan;
        assert_eq!(scan.ranges().len(), 361);
        let degrees =
            (0..361).map(|beam| (scan.bearings().at(beam).to_degrees(), f64::from(beam as i32 - 180) / 2.0));
        for (found, expected) in degrees {
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
    }
}
