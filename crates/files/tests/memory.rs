//! The memory that an image takes while it is decoded, by the most that this process ever had: a test alone in its process.
#![cfg(target_os = "linux")]

use mean_information_files::{Options, read_map, with_grid};
use mean_information_test_support::formats::{Folder, yaml};
use std::fs::{self, File};
use std::io::Write;

/// Returns the most bytes that this process had in memory.
fn peak() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap();
    let most = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap();
    most.trim().strip_suffix(" kB").unwrap().parse::<u64>().unwrap() << 10
}

/// Samples up to 100 become samples of 16 bits: twice the bytes, and nothing beside them.
#[test]
fn an_image_takes_at_most_three_times_its_decoded_pixels() {
    let folder = Folder::new();
    let map = folder.write("map.yaml", yaml("map.ppm", "negate: 0\n"));
    let side = 2048_u64;
    let mut image = File::create(folder.write("map.ppm", "")).unwrap();
    writeln!(image, "P6 {side} {side} 100").unwrap();
    let decoded = 3 * side * side;
    let head = image.metadata().unwrap().len();
    image.set_len(head + decoded).unwrap();
    let before = peak();
    let read = read_map(&map, &Options::default()).unwrap();
    assert!(with_grid!(&read.cells, grid => grid.tally().observed()) == side * side);
    let taken = peak() - before;
    assert!(taken <= 3 * decoded, "{taken} of {decoded}");
    // It is measured: the pixels are there twice.
    assert!(taken >= 2 * decoded, "{taken} of {decoded}");
}
