//! The seeds of bags and of saved states.

use mean_information_test_support::formats::pbstream::{grid, integer, message, state, submap};
use std::fs;

pub(crate) fn bag() -> Vec<(&'static str, Vec<u8>)> {
    let kinds = [
        ("plain_1", "maps_none.bag"),
        ("bz2", "maps_bz2.bag"),
        ("lz4_1", "maps_lz4.bag"),
        ("plain_2", "maps_mcap/maps_mcap.mcap"),
        ("zstd", "maps_mcap_zstd/maps_mcap_zstd.mcap"),
        ("lz4_2", "maps_mcap_lz4.mcap"),
    ];
    let mut seeds = kinds.map(|(name, file)| (name, fs::read(crate::bags::bag(file)).unwrap())).to_vec();
    seeds.push(("scans_1", crate::scan_bag::seed("ros1", true)));
    seeds.push(("scans_2", crate::scan_bag::seed("cdr", false)));
    seeds.push(("octree_bag", crate::bag_trees::seed()));
    seeds
}

pub(crate) fn db3() -> Vec<(&'static str, Vec<u8>)> {
    let whole = fs::read(crate::bags::bag("maps_db3/maps_db3.db3")).unwrap();
    vec![("cut", whole[..3 * 4096].to_vec()), ("whole", whole)]
}

pub(crate) fn bag_folder() -> Vec<(&'static str, Vec<u8>)> {
    let listed = |names: &str| format!("rosbag2_bagfile_information:\n  version: 4\n{names}").into_bytes();
    vec![
        ("listed", listed("  relative_file_paths:\n    - run/run_0.mcap\n    - \"run_0.mcap\"\n")),
        ("packed", listed("  relative_file_paths: [run_0.mcap.zstd]\n")),
        ("elsewhere", listed("  relative_file_paths: [../run_0.mcap, metadata.yaml]\n")),
        ("none", listed("  duration: {nanoseconds: 1}\n")),
        ("bomb", listed("  a: &a [x, x]\n  relative_file_paths: [*a, *a]\n")),
    ]
}

pub(crate) fn pbstream() -> Vec<(&'static str, Vec<u8>)> {
    let whole = state(&[submap(&grid(&[0, 1, 32767, 32769, 32768, 20000], b""))]);
    let many = message(3, &[&integer(1, 1 << 40), &integer(2, 1 << 40)]);
    let claims_more =
        state(&[submap(&message(4, &[&message(1, &[&[0x09], &0.25_f64.to_le_bytes(), &many])]))]);
    vec![
        ("cut", whole[..whole.len() - 9].to_vec()),
        ("plain", whole),
        ("distances", state(&[submap(&grid(&[7; 6], &message(5, &[])))])),
        ("claims_more", claims_more),
        ("nodes", crate::pbstream_scans::seed()),
    ]
}
