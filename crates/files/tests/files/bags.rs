//! Bags: those that `tests/bags/make.py` wrote by another writer, and such as must be refused.

use mean_information_files::bags::{
    Change, MapSeries, MapTopic, Snapshot, Visitor, bag_files, last_map, read_bag, read_stream,
};
use mean_information_files::{
    Cells, Error, ErrorKind, Memory, Options, Place, Warning, read_map, read_map_from,
};
use mean_information_test_support::formats::Folder;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The same maps in every container and compression.
pub(crate) const BAGS: [&str; 9] = [
    "maps_none.bag",
    "maps_bz2.bag",
    "maps_lz4.bag",
    "maps_mcap",
    "maps_mcap/maps_mcap.mcap",
    "maps_mcap_zstd",
    "maps_mcap_lz4.mcap",
    "maps_db3",
    "maps_db3/maps_db3.db3",
];

/// The bags that are one file, and no database.
const STREAMS: [&str; 5] =
    ["maps_none.bag", "maps_bz2.bag", "maps_lz4.bag", "maps_mcap/maps_mcap.mcap", "maps_mcap_lz4.mcap"];

/// Returns the bags that are read: a `.db3` needs a feature.
fn bags() -> impl Iterator<Item = &'static str> {
    BAGS.into_iter().filter(|name| cfg!(feature = "sqlite") || !name.contains("db3"))
}

pub(crate) fn bag(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bags").join(name)
}

/// A map of a series: time, size, the number of each value, and the difference to the map before.
type Row = (u64, [usize; 2], BTreeMap<i8, u64>, Change);

/// Reads the maps of a topic.
fn series(
    read: impl FnOnce(&mut dyn Visitor) -> Result<Vec<Warning>, Error>,
) -> (Vec<Row>, Result<Vec<Warning>, Error>) {
    let mut rows = Vec::new();
    let each = |map: Snapshot<'_>| {
        assert_eq!(map.cells.len(), map.width * map.height);
        assert_eq!(map.geometry.resolution(), f64::from(0.05_f32));
        assert_eq!(map.geometry.origin(), [-1.5, 2.25]);
        // 2 atan2(0.6, 0.8)
        assert!((map.geometry.yaw() - 1.287_002_217_586_569).abs() < 1e-12, "{}", map.geometry.yaw());
        let mut counts = BTreeMap::new();
        map.cells.iter().for_each(|&cell| *counts.entry(cell).or_default() += 1);
        rows.push((map.time_ns, [map.width, map.height], counts, map.change));
    };
    // The only topic that is no costmap.
    let warnings = read(&mut MapSeries::new(&MapTopic::default(), &Options::default(), each));
    (rows, warnings)
}

fn rows_of(path: &Path) -> Vec<Row> {
    let (rows, warnings) = series(|series| read_bag(path, &Options::default(), series));
    assert_eq!(warnings.unwrap(), [], "{}", path.display());
    rows
}

fn rows_in(bytes: &[u8]) -> (Vec<Row>, Result<Vec<Warning>, Error>) {
    series(|series| read_stream(bytes, bytes.len() as u64, &Options::default(), series))
}

/// Refuses a bag; returns the error and its line.
fn refused(bytes: &[u8]) -> (Error, String) {
    let error = rows_in(bytes).1.expect_err("must be refused");
    let line = error.to_string();
    (error, line)
}

#[test]
fn every_container_gives_the_counts_of_numpy() {
    let expected = fs::read_to_string(bag("expected.json")).unwrap();
    let expected: serde_json::Value = serde_json::from_str(&expected).unwrap();
    let expected: Vec<_> = expected
        .as_array()
        .unwrap()
        .iter()
        .map(|map| {
            let number = |key: &str| map[key].as_u64().unwrap();
            let pair =
                |pair: &serde_json::Value| (pair[0].as_i64().unwrap() as i8, pair[1].as_u64().unwrap());
            let values: BTreeMap<i8, u64> = map["values"].as_array().unwrap().iter().map(pair).collect();
            (number("time_ns"), [number("width") as usize, number("height") as usize], values)
        })
        .collect();
    assert_eq!(expected.len(), 50);
    for name in bags() {
        let rows = rows_of(&bag(name));
        let found: Vec<_> = rows.iter().map(|row| (row.0, row.1, row.2.clone())).collect();
        assert_eq!(found, expected, "{name}");
        let changes: Vec<_> = rows.iter().map(|row| row.3).collect();
        assert_eq!(
            [changes[0], changes[3], changes[6]],
            [Change::First, Change::Cells(0), Change::Frame],
            "{name}"
        );
        assert!(matches!(changes[2], Change::Cells(1..=6)), "{name}: {changes:?}");
        assert!(matches!(changes[4], Change::Cells(7..)), "{name}: {changes:?}");
    }
}

#[test]
fn the_last_map_of_the_only_topic_that_is_no_costmap() {
    for name in bags() {
        let path = bag(name);
        let map = read_map(&path, &Options::default()).unwrap();
        let Cells::Percent(grid) = &map.cells else { panic!("{name}") };
        assert_eq!((grid.width(), grid.height()), (5, 9), "{name}");
        assert_eq!((map.warnings, &map.files), (vec![], &bag_files(&path).unwrap()));
        assert!(map.files.iter().all(|file| file.is_file()) && map.files[0].starts_with(&path));

        let mut named = MapTopic { costmaps: true, ..MapTopic::named("/global_costmap/costmap") };
        let costmap = last_map(&path, &named, &Options::default()).unwrap();
        let Cells::Percent(grid) = &costmap.cells else { panic!("{name}") };
        assert_eq!(grid.cells(), [99, 0]);
        named.costmaps = false;
        let error = last_map(&path, &named, &Options::default()).unwrap_err();
        assert_eq!((error.kind(), error.file()), (ErrorKind::Choice, Some(&*path)));
    }
}

#[test]
fn a_cut_bag_is_read_to_its_last_whole_message() {
    for name in STREAMS {
        let bytes = fs::read(bag(name)).unwrap();
        let whole = rows_in(&bytes).0;
        let mut most = 0;
        for length in (13..bytes.len()).step_by(bytes.len() / 701) {
            let (rows, warnings) = rows_in(&bytes[..length]);
            assert!(rows.len() >= most && rows == whole[..rows.len()], "{name} to byte {length}");
            most = rows.len();
            match warnings.unwrap().as_slice() {
                [] => assert_eq!(rows.len(), whole.len(), "{name} to byte {length}"),
                [Warning::BagCutShort { byte, .. }] => assert!(*byte <= length as u64),
                other => panic!("{name} to byte {length}: {other:?}"),
            }
        }
        assert_eq!(most, whole.len());
    }
}

#[cfg(feature = "sqlite")]
#[test]
fn a_cut_database_is_read_to_its_last_whole_message() {
    let bytes = fs::read(bag("maps_db3/maps_db3.db3")).unwrap();
    let whole = rows_of(&bag("maps_db3"));
    let folder = Folder::new();
    for pages in 1..bytes.len() / 4096 {
        let path = folder.write("cut.db3", &bytes[..pages * 4096]);
        let (rows, warnings) = series(|series| read_bag(&path, &Options::default(), series));
        assert_eq!(rows, whole[..rows.len()], "{pages} pages");
        match warnings {
            Ok(warnings) if rows.len() < whole.len() => {
                assert!(matches!(*warnings, [Warning::BagCutShort { .. }]), "{pages} pages: {warnings:?}");
            }
            Ok(_) => {}
            Err(error) => {
                assert_eq!((error.kind(), rows.len()), (ErrorKind::Format, 0), "{pages} pages: {error}");
            }
        }
    }
}

#[cfg(feature = "sqlite")]
#[test]
fn a_database_that_was_not_closed_is_refused() {
    let folder = Folder::new();
    let path = folder.write("run.db3", fs::read(bag("maps_db3/maps_db3.db3")).unwrap());
    folder.write("run.db3-wal", b"messages");
    let error = read_map(&path, &Options::default()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert!(error.to_string().contains("run.db3-wal beside it holds messages"), "{error}");
}

#[test]
fn other_files_are_no_bags() {
    let (error, line) = refused(b"P5 3 2 255\n012345");
    assert_eq!((error.kind(), error.place()), (ErrorKind::Format, Some(&Place::Byte(0))));
    assert_eq!(line, "is no bag by its first bytes; allowed are MCAP and bags of ROS 1, version 2.0");
    let (error, line) = refused(b"#ROSBAG V1.2\n\x00\x00\x00\x00");
    assert_eq!((error.kind(), error.place()), (ErrorKind::Unsupported, Some(&Place::Byte(8))));
    assert_eq!(line, "is a bag of ROS 1 of another version, allowed is 2.0");
    let nothing = Folder::new().write("x", b"").with_file_name("nothing.bag");
    let error = read_map(&nothing, &Options::default()).unwrap_err();
    assert_eq!((error.kind(), error.file()), (ErrorKind::NotFound, Some(&*nothing)));
}

#[cfg(feature = "sqlite")]
#[test]
fn other_files_are_no_databases() {
    let folder = Folder::new();
    let path = folder.write("run.db3", b"SQLite format 3\0 but no more");
    assert_eq!(read_map(&path, &Options::default()).unwrap_err().kind(), ErrorKind::Format);
}

#[test]
fn a_bag_is_read_from_a_disk_only() {
    let mut files = Memory::new();
    files.add("run.mcap", fs::read(bag("maps_mcap_lz4.mcap")).unwrap());
    let error = read_map_from(&files, Path::new("run.mcap"), &Options::default()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert_eq!(error.to_string(), "run.mcap: is a bag, whose last map is read from a disk only");
}
