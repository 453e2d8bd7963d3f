//! `meaninfo map` of Cartographer's saved states.

mod common;

use common::*;
use mean_information_test_support::formats::pbstream::{grid, state, submap_of};
use mean_information_test_support::formats::shared_data;
use serde_json::Value;

fn json(arguments: &[&str]) -> Vec<Value> {
    let text = stdout(&[arguments, &["--format", "json"]].concat());
    serde_json::from_str::<Value>(&text).unwrap().as_array().unwrap().clone()
}

/// Two submaps of 3 x 2 cells: unknown, the two ends of the clamp, and a value between.
fn two_submaps(folder: &Folder) -> String {
    let submaps = [(5, [0, 0, 1, 1, 32767, 20000]), (6, [0, 0, 0, 0, 0, 32767])];
    let records = submaps.map(|(index, cells)| submap_of([2, index], &grid(&cells, b"")));
    folder.write("race.pbstream", state(&records)).to_str().unwrap().to_owned()
}

#[test]
fn submaps_together_are_their_counts_merged() {
    let folder = Folder::new();
    let path = two_submaps(&folder);
    let rows = json(&["map", &path]);
    let [row] = &*rows else { panic!("{rows:?}") };
    assert_eq!(
        (&row["width"], &row["height"], &row["resolution_m"]),
        (&Value::Null, &Value::Null, &0.25.into())
    );
    assert_eq!(
        (&row["observed"], &row["unknown"], &row["free"], &row["occupied"]),
        (&5.into(), &7.into(), &3.into(), &2.into())
    );
    // Four cells at the ends of the clamp have 0.531 bits each; the fifth costs 0.588, so its p is 0.412.
    let p = 1.0 - (0.1 + 19999.0 * 0.8 / 32766.0);
    let expected = (4.0 * (1.0 - entropy(0.1)) + 1.0 - entropy(p)) / 5.0;
    assert!((row["mean_information"].as_f64().unwrap() - expected).abs() < 1e-6, "{row} {expected}");
    let together =
        "2 submaps counted together: a place that lies in several counts in each; --submaps gives each a row";
    let clamped = "probabilities are clamped to 0.100 to 0.900 by who made them, so that the mean information is at most 0.531";
    assert_eq!(row["warnings"], Value::from(vec![together, clamped]));
    assert!(stdout(&["map", &path]).contains("submaps"));
}

#[test]
fn submaps_apart_have_a_row_each() {
    let folder = Folder::new();
    let path = two_submaps(&folder);
    let rows = json(&["map", "--submaps", &path]);
    let column = |key: &str| rows.iter().map(|row| row[key].clone()).collect::<Vec<_>>();
    assert_eq!(column("observed"), [4, 1]);
    assert_eq!(column("width"), [3, 3]);
    assert_eq!(column("map"), [format!("{path} submap 2, 5"), format!("{path} submap 2, 6")]);
}

#[test]
fn a_state_is_no_grid_to_draw_or_to_pool() {
    let folder = Folder::new();
    let path = two_submaps(&folder);
    for arguments in [&["sweep", &*path][..], &["map", &path, "--heat-map", "x.png"]] {
        assert!(refusal(arguments).contains("several grids, not one"));
    }
    let map = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/room.yaml");
    // A map beside it has a row as ever.
    assert_eq!(json(&["map", "--submaps", &path, map]).len(), 3);
}

#[test]
fn a_real_state_has_the_figures_of_another_decoder() {
    let Some(data) = shared_data() else { return };
    let path = data.join("cartographer/JFR_racingv5.pbstream");
    let rows = json(&["map", path.to_str().unwrap()]);
    assert_eq!((&rows[0]["observed"], &rows[0]["occupied"]), (&629_074.into(), &27_224.into()));
    assert!((rows[0]["mean_information"].as_f64().unwrap() - 0.346166).abs() < 1e-5, "{}", rows[0]);
}
