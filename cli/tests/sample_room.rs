//! The sample map in `maps` is what its code makes, and has what a sample should show.

mod common;
#[path = "../examples/sample_room/map.rs"]
mod map;
#[path = "../examples/sample_room/room.rs"]
mod room;

use common::*;
use serde_json::Value;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
const MAPS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../maps");

#[test]
fn the_sample_map_is_made_again_byte_by_byte() {
    assert_eq!(text(&read(format!("{MAPS}/room.yaml"))), map::YAML);
    assert!(read(format!("{MAPS}/room.pgm")) == map::pgm(), "run `cargo run --example sample_room`");
}

#[test]
fn the_walls_are_where_the_rays_meet_them() {
    for (from, direction, distance) in [
        ([1.3, 1.1], [-1.0, 0.0], 1.3),
        ([4.0, 1.5], [1.0, 0.0], 5.4),
        ([4.6, 3.6], [0.0, -1.0], 3.6),
        ([4.6, 2.4], [1.0, 0.0], 0.6),
        ([3.0, 5.0], [0.0, 1.0], 1.9),
        ([7.4, 1.5], [0.6, 0.8], 1.0),
    ] {
        let found = room::range(from, direction);
        assert!((found - distance).abs() < 1e-12, "from {from:?}: {found}, not {distance}");
    }
    assert_eq!(room::range([9.0, 3.0], [0.0, 1.0]), f64::INFINITY);
}

#[test]
fn it_is_a_map_with_free_occupied_and_unknown_cells_under_both_loaders() {
    let yaml = format!("{MAPS}/room.yaml");
    for semantics in ["nav2", "ros1"] {
        let json = stdout(&["map", &yaml, "--format", "json", "--semantics", semantics]);
        let json: Value = serde_json::from_str(&json).unwrap();
        let count = |key: &str| json[0][key].as_u64().unwrap();
        assert!(count("free") > 10_000 && count("occupied") > 1000 && count("unknown") > 5000, "{json}");
        assert_eq!(json[0]["meaningful"], true);
    }
}

/// `cargo run --release -- map maps/room.yaml`, run where the README says.
#[test]
fn the_readme_shows_what_is_printed() {
    let output = meaninfo().current_dir(ROOT).args(["map", "maps/room.yaml"]).output().unwrap();
    let shown = format!("```text\n{}```\n", text(&output.stdout));
    assert!(text(&read(format!("{ROOT}/README.md"))).contains(&shown), "README.md lacks\n{shown}");
}

/// `cargo run --release -- map maps/room.yaml --heat-map docs/room.png` makes the picture again.
#[test]
fn the_picture_of_the_readme_is_the_heat_map() {
    let folder = Folder::new();
    let picture = folder.text_path("room.png");
    stdout(&["map", &format!("{MAPS}/room.yaml"), "--heat-map", &picture]);
    let [drawn, shown] = [picture, format!("{ROOT}/docs/room.png")].map(|path| Pixels::of_png(&read(path)));
    assert!(drawn == shown, "docs/room.png is not the heat map of maps/room.yaml");
}
