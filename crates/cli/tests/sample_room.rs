//! The sample map in `maps` is what `meaninfo simulate` makes, and has what a sample should show.

mod common;

use common::*;
use serde_json::Value;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
const MAPS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps");

/// `cargo run --release -- simulate --out maps/room`; the array is not kept.
#[test]
fn the_sample_map_is_made_again_byte_by_byte() {
    let folder = Folder::new();
    stdout(&["simulate", "--out", &folder.text_path("room")]);
    for file in ["room.yaml", "room.pgm"] {
        let [made, kept] = [folder.text_path(file), format!("{MAPS}/{file}")].map(read);
        assert!(made == kept, "maps/{file} is not what `meaninfo simulate --out maps/room` makes");
    }
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
