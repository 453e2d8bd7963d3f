//! MRPT grid maps written here: every version, and the ways to break one.

use crate::support::{Measured, measure, probabilities, read_twice, refusal, warnings};
use mean_information_files::{Cells, Options, Warning};
use mean_information_test_support::formats::{Folder, GridMap, gzip};

#[test]
fn every_version_plain_and_zipped() {
    let folder = Folder::new();
    for version in 3..=7 {
        for name in [&b"COccupancyGridMap2D"[..], b"mrpt::maps::COccupancyGridMap2D"] {
            let bytes = GridMap { name, version, ..GridMap::small() }.bytes();
            for (file, bytes) in [
                ("map.gridmap", bytes.clone()),
                ("map.gridmap.gz", gzip(&bytes)),
                ("zipped.gridmap", gzip(&bytes)),
                ("two.gridmap.gz", [gzip(&bytes[..60]), gzip(&bytes[60..])].concat()),
            ] {
                let map = read_twice(&folder.write(file, bytes), &Options::default()).unwrap();
                assert_eq!(map.resolution, Some(0.25));
                let Cells::Mrpt(grid) = &map.cells else { panic!("{map:?}") };
                assert_eq!((grid.width(), grid.height(), grid.geometry().origin()), (3, 2, [-0.5, 2.0]));
                assert_eq!(grid.cells(), [-128, -127, -1, 0, 1, 127]);
                // Positive is free.
                let Measured { free, occupied, unknown, .. } = measure(&map);
                assert_eq!((free, occupied, unknown), (2, 3, 1));
            }
        }
    }
}

#[test]
fn version_2_holds_probabilities_of_free() {
    let folder = Folder::new();
    let old = GridMap { version: 2, cells: vec![0, 51, 127, 128, 129, 255], ..GridMap::small() };
    let map = read_twice(&folder.write("map.gridmap", old.bytes()), &Options::default()).unwrap();
    assert_eq!(probabilities(&map), [1.0, 0.8, 0.5, 0.5, 126.0 / 255.0, 0.0]);
    assert_eq!(map.warnings, [Warning::HalvesReadAsUnknown { count: 2, version: 2 }]);
    assert!(warnings(&map)[0].starts_with("2 cells of 127 or 128"), "{:?}", map.warnings);
    let old = GridMap { cells: vec![0, 51, 127, 5, 129, 255], ..old };
    let map = read_twice(&folder.write("map.gridmap", old.bytes()), &Options::default()).unwrap();
    assert!(warnings(&map)[0].starts_with("1 cell of 127 or 128"), "{:?}", map.warnings);
}

/// The extent may differ from the cells' by half a cell, as MRPT allows, and by no more.
#[test]
fn an_extent_is_that_of_its_cells_to_half_a_cell() {
    let folder = Folder::new();
    for (excess, allowed) in [(0.45_f32, true), (-0.45, true), (0.55, false), (-0.55, false), (0.95, false)] {
        for axis in [1, 3] {
            let mut map = GridMap::small();
            map.place[axis] += 0.25 * excess;
            let read = read_twice(&folder.write("map.gridmap", map.bytes()), &Options::default());
            assert_eq!(read.is_ok(), allowed, "{excess} cells along axis {axis}");
        }
    }
}

#[test]
fn what_is_no_map_is_refused() {
    let small = GridMap::small;
    let good = small().bytes();
    let nan = f32::NAN;
    let cases: Vec<(Vec<u8>, &str)> = vec![
        (Vec::new(), "the file is empty"),
        (b"P5 2 2 255 1234".to_vec(), "is no MRPT grid map"),
        (b"\x93COccupancyGridMap3D\x03".to_vec(), "is no MRPT grid map"),
        (GridMap { version: 1, ..small() }.bytes(), "version 1, allowed is 2 to 7"),
        (GridMap { version: 8, ..small() }.bytes(), "version 8, allowed is 2 to 7"),
        (GridMap { bits: 16, ..small() }.bytes(), "cells of 16 bits"),
        (GridMap { size: [4, 2], ..small() }.bytes(), "claims 4 cells along x"),
        (GridMap { size: [3, 5], ..small() }.bytes(), "claims 5 cells along y"),
        (GridMap { place: [-0.5, 0.25, 2.0, 2.5, 0.0], ..small() }.bytes(), "resolution is 0"),
        (GridMap { place: [-0.5, 0.25, 2.0, 2.5, -0.25], ..small() }.bytes(), "resolution is -0.25"),
        (GridMap { place: [-0.5, 0.25, 2.0, 2.5, nan], ..small() }.bytes(), "resolution is NaN"),
        (GridMap { place: [nan, 0.25, 2.0, 2.5, 0.25], ..small() }.bytes(), "origin is NaN"),
        (GridMap { place: [-0.5, nan, 2.0, 2.5, 0.25], ..small() }.bytes(), "claims 3 cells along x"),
        (GridMap { size: [u32::MAX, u32::MAX], ..small() }.bytes(), "more than the limit of 268435456"),
        (good[..20].to_vec(), "cut short"),
        (good[..58].to_vec(), "cut short"),
        (good[..good.len() - 1].to_vec(), "end mark"),
        ([good.as_slice(), b"more"].concat(), "end mark"),
        (GridMap { tail: vec![0x88; 70_000], ..small() }.bytes(), "goes on for more than 65536 bytes"),
        (gzip(&good)[..60].to_vec(), "cut short"),
        ([gzip(&good).as_slice(), b"more"].concat(), "cut short"),
        ([gzip(&good).as_slice(), b"a longer text"].concat(), "cannot be read: invalid gzip header"),
        (gzip(b""), "cut short"),
    ];
    for (bytes, words) in cases {
        let refused = refusal("map.gridmap.gz", bytes, &Options::default());
        assert!(refused.contains(words), "{refused}: {words}");
    }
}

/// What decompresses to four gigabytes is refused by its claim, or where the map ends, without being decompressed.
#[test]
fn a_gzip_bomb_is_refused_early() {
    let gigabytes = gzip(&vec![0; 1 << 24]).repeat(256);
    let size = [1 << 16, 1 << 16];
    let place = [0.0, 16384.0, 0.0, 16384.0, 0.25];
    let honest = gzip(&GridMap { size, place, ..GridMap::small() }.header());
    let refused =
        refusal("map.gridmap.gz", [&honest, &gigabytes].map(Vec::as_slice).concat(), &Options::default());
    assert!(refused.contains("4294967296 cells, more than the limit of 268435456"), "{refused}");

    let ended = gzip(&GridMap::small().bytes());
    let refused =
        refusal("map.gridmap.gz", [&ended, &gigabytes].map(Vec::as_slice).concat(), &Options::default());
    assert!(refused.contains("goes on for more than"), "{refused}");
}
