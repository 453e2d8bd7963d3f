//! `meaninfo map`: the numbers, and the contract of its three forms of output.

mod common;

use common::schema::{assert_order, required};
use common::*;
use mean_information_test_support::formats::{Node, shared_data};
use serde_json::Value;

/// The keys of the row of a map.
fn row_keys() -> Vec<String> {
    required("map", "/items")
}

fn json(arguments: &[&str]) -> Value {
    serde_json::from_str(&stdout(&[arguments, &["--format", "json"]].concat())).unwrap()
}

#[test]
fn json_holds_the_contract() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let text = stdout(&["map", &map, "--format", "json"]);
    assert_order(&text, 4, "map", "/items");
    let json: Value = serde_json::from_str(&text).unwrap();
    let [found] = json.as_array().unwrap().as_slice() else { panic!("{text}") };
    assert_twins(found, 4);

    let p = occupancies(&GREYS);
    let known: Vec<f64> = p.iter().copied().filter(|&p| p != 0.5).collect();
    let information: f64 = known.iter().map(|&p| 1.0 - entropy(p)).sum();
    assert_eq!(found["map"], map.as_str());
    assert_eq!((&found["width"], &found["height"]), (&5.into(), &3.into()));
    assert_eq!(found["resolution_m"], 0.2);
    assert_near(&found["mean_information"], information / known.len() as f64);
    assert_near(&found["information_bits"], information);
    assert_near(&found["entropy_bits"], p.iter().map(|&p| entropy(p)).sum());
    assert_eq!((&found["observed"], &found["unknown"]), (&11.into(), &4.into()));
    assert_eq!((&found["free"], &found["occupied"]), (&6.into(), &5.into()));
    assert_near(&found["observed_area_m2"], 11.0 * 0.04);
    assert_eq!((&found["meaningful"], &found["warnings"]), (&true.into(), &Value::Array(vec![])));
}

#[test]
fn csv_says_the_same_as_json() {
    let folder = Folder::new();
    let maps = [folder.ros_map("a, b", 5, &GREYS, "scale"), folder.ros_map("black", 3, &[0; 6], "trinary")];
    let arguments = ["map", &maps[0], &maps[1]];
    let csv_text = stdout(&[&arguments[..], &["--format", "csv"]].concat());
    let mut csv = csv::Reader::from_reader(csv_text.as_bytes());
    assert_eq!(csv.headers().unwrap().iter().collect::<Vec<_>>(), row_keys());
    let rows: Vec<_> = csv.records().map(Result::unwrap).collect();
    let json = json(&arguments);
    assert_eq!((rows.len(), json.as_array().unwrap().len()), (2, 2));
    for (row, object) in rows.iter().zip(json.as_array().unwrap()) {
        for (field, key) in row.iter().zip(row_keys()) {
            match &object[&key] {
                Value::Number(number) => assert_eq!(field.parse::<f64>().ok(), number.as_f64(), "{key}"),
                Value::Array(texts) => {
                    assert_eq!(field, texts.iter().filter_map(Value::as_str).collect::<Vec<_>>().join("; "));
                }
                Value::String(text) => assert_eq!(field, text),
                other => assert_eq!(field, other.to_string(), "{key}"),
            }
        }
    }
}

#[test]
fn one_table_for_several_maps() {
    let folder = Folder::new();
    let maps = [folder.ros_map("grey", 5, &GREYS, "scale"), folder.ros_map("black", 3, &[0; 6], "trinary")];
    let table = stdout(&["map", &maps[0], &maps[1]]);
    assert!(table.contains("mean information"), "{table}");
    let json = json(&["map", &maps[0], &maps[1]]);
    for object in json.as_array().unwrap() {
        for key in ["mean_information", "observed", "free", "occupied", "unknown"] {
            assert!(table.contains(&object[key].to_string()), "{key} of {object} in\n{table}");
        }
    }
    assert!(table.contains("not meaningful") && table.contains("thresholded"), "{table}");
    let note = format!("{}: {}\n", maps[1], json[1]["warnings"][0].as_str().unwrap());
    assert!(table.ends_with(&note), "{table}");
    let rules = table.lines().filter(|line| line.starts_with('─'));
    assert!(rules.clone().count() > 0 && rules.map(|line| line.chars().count()).all(|width| width <= 120));
}

/// Every number, and every part of a name, stands whole in a cell, however many maps and however long their names.
#[test]
fn a_table_of_seven_maps_breaks_no_number() {
    let folder = Folder::new();
    let maps: Vec<String> = (1..8)
        .map(|k| {
            let greys: Vec<u8> = (0..600).map(|i| (i * i * k % 251) as u8).collect();
            let long = "a_map_of_the_ground_floor_".repeat(k / 2);
            folder.ros_map(&format!("{long}{k}"), 20, &greys, "scale")
        })
        .collect();
    let arguments: Vec<&str> = ["map"].into_iter().chain(maps.iter().map(String::as_str)).collect();
    let table = stdout(&arguments);
    let words: Vec<&str> = table.split_whitespace().collect();
    for object in json(&arguments).as_array().unwrap() {
        for key in ["mean_information", "observed", "unknown"] {
            assert!(words.contains(&&*object[key].to_string()), "{key} of {object} in\n{table}");
        }
        let name = object["map"].as_str().unwrap().rsplit('/').next().unwrap();
        assert!(words.iter().any(|word| word.ends_with(name)), "{name} in\n{table}");
    }
    for title in ["mean information", "(bits / cell)", "information", "entropy", "free / occupied"] {
        assert!(table.lines().take(3).any(|line| line.contains(title)), "{title} in\n{table}");
    }
}

#[test]
fn a_resolution_in_single_precision_is_shown_as_it_was_meant() {
    let folder = Folder::new();
    let npy = folder.npy_map("map.npy", 3, &[0.25, 0.5, 0.75]);
    let side = f64::from(0.04_f32).to_string();
    let table = stdout(&["map", &npy, "--resolution", &side]);
    assert!(table.contains(" of 0.04 m "), "{table}");
    let table = stdout(&["sweep", &npy, "--resolution", &side]);
    assert!([" 0.04 ", " 0.08 ", " 0.16 "].iter().all(|size| table.contains(size)), "{table}");
}

#[test]
fn a_thresholded_map_is_not_meaningful() {
    let folder = Folder::new();
    let json = json(&["map", &folder.ros_map("plan", 3, &[254, 205, 0, 254, 254, 0], "trinary")]);
    assert_eq!(json[0]["mean_information"], 1.0);
    assert_eq!((&json[0]["observed"], &json[0]["unknown"]), (&5.into(), &1.into()));
    assert_eq!(json[0]["meaningful"], false);
    assert!(json[0]["warnings"][0].as_str().unwrap().starts_with("thresholded: "), "{json}");
}

#[test]
fn one_cell_in_doubt_makes_a_map_meaningful() {
    let folder = Folder::new();
    let json = json(&["map", &folder.ros_map("plan", 3, &[255, 127, 0, 255, 250, 0], "scale")]);
    assert_eq!((&json[0]["meaningful"], &json[0]["warnings"]), (&true.into(), &Value::Array(vec![])));
}

#[test]
fn nothing_observed_has_no_mean_information() {
    let folder = Folder::new();
    let json = json(&["map", &folder.ros_map("fog", 3, &[205; 6], "trinary")]);
    assert_eq!(
        (&json[0]["mean_information"], &json[0]["mean_information_hex"]),
        (&Value::Null, &Value::Null)
    );
    assert_eq!((&json[0]["entropy_bits"], &json[0]["information_bits"]), (&6.0.into(), &0.0.into()));
    assert_eq!((&json[0]["unknown"], &json[0]["meaningful"]), (&6.into(), &false.into()));
    assert!(json[0]["warnings"].to_string().contains("every cell is unknown"), "{json}");
}

#[test]
fn a_map_of_fifty_percent_is_told_from_one_marked_unknown() {
    let folder = Folder::new();
    let map = folder.ros_map("grey", 3, &[127; 6], "scale");
    for semantics in ["nav2", "ros1"] {
        let json = json(&["map", &map, "--semantics", semantics]);
        assert_eq!((&json[0]["mean_information"], &json[0]["meaningful"]), (&Value::Null, &false.into()));
        assert!(json[0]["warnings"].to_string().contains("exactly 50 percent"), "{json}");
    }
    assert!(stdout(&["map", &map]).contains("all 50 percent"));
}

#[test]
fn a_map_without_cells_says_so() {
    let folder = Folder::new();
    let map = folder.npy_map("empty.npy", 0, &[]);
    let json = json(&["map", &map]);
    assert_eq!((&json[0]["mean_information"], &json[0]["meaningful"]), (&Value::Null, &false.into()));
    assert!(json[0]["warnings"][0].as_str().unwrap().starts_with("the map has no cells"), "{json}");
    let line = refusal(&["map", &map, "--heat-map", &folder.text_path("picture.png")]);
    assert!(line.starts_with(&format!("meaninfo: {map}: the map has no cells")), "{line}");
    assert_eq!(folder.names(), ["empty.npy"]);
}

#[cfg(unix)]
#[test]
fn control_characters_in_names_do_not_reach_the_terminal() {
    let folder = Folder::new();
    let map = folder.ros_map("a\u{1b}[2Jb\u{9b}31m\nc", 3, &[0; 6], "trinary");
    for command in ["map", "sweep"] {
        let table = stdout(&[command, &map]);
        assert!(!table.chars().any(|c| c.is_control() && c != '\n'), "{table:?}");
        assert!(table.contains("a\\u{1b}[2Jb\\u{9b}31m\\nc.yaml: thresholded"), "{table}");
    }
}

/// An octree has no rectangle, and its rows have two more keys; so have those of a map beside it.
#[test]
fn an_octree_is_measured_by_its_finest_cells() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let path = folder.write("tree.ot", Node::small().lowered(13).full(false));
    let tree = path.to_str().unwrap();
    let rows = json(&["map", tree, &map]);
    let counts = [(-0.4_f64, 64.0), (0.85, 8.0), (-0.4, 1.0), (2.25, 1.0), (-1.5, 8.0)];
    let information = |l: f64| 1.0 - entropy(1.0 / (1.0 + libm::exp(-l)));
    let sum: f64 = counts.iter().map(|&(l, n)| n * information(f64::from(l as f32))).sum();
    assert_near(&rows[0]["mean_information"], sum / 82.0);
    assert_near(&rows[0]["entropy_bits"], 82.0 - sum);
    assert_near(&rows[0]["observed_volume_m3"], 82.0 * 0.05 * 0.05 * 0.05);
    assert_eq!(
        (&rows[0]["leaves"], &rows[0]["observed"], &rows[0]["resolution_m"]),
        (&5.into(), &82.into(), &0.05.into())
    );
    assert_eq!(
        (&rows[0]["free"], &rows[0]["occupied"], &rows[0]["meaningful"]),
        (&73.into(), &9.into(), &true.into())
    );
    for key in ["width", "height", "unknown", "observed_area_m2", "observed_area_m2_hex"] {
        assert!(rows[0][key].is_null(), "{key}");
    }
    assert_eq!(
        (&rows[1]["leaves"], &rows[1]["observed_volume_m3"], &rows[1]["width"]),
        (&Value::Null, &Value::Null, &5.into())
    );
    let csv = stdout(&["map", tree, &map, "--format", "csv"]);
    assert!(csv.lines().next().unwrap().contains("observed_area_m2_hex,leaves,observed_volume_m3,"), "{csv}");
    assert!(stdout(&["map", tree]).contains("5 leaves"));
    assert!(refusal(&["map", tree, "--heat-map", "a.png"]).contains("tree.ot: is an octree"));
}

/// A `.bt` file says free and occupied only; `--clamp` gives these a number, but no meaning.
#[test]
fn a_binary_octree_means_nothing() {
    let folder = Folder::new();
    let path = folder.write("tree.bt", Node::small().lowered(13).binary());
    let tree = path.to_str().unwrap();
    let row = &json(&["map", tree])[0];
    assert_eq!((&row["mean_information"], &row["meaningful"]), (&1.0.into(), &false.into()));
    assert!(row["warnings"][0].as_str().unwrap().starts_with("thresholded"), "{row}");
    let row = &json(&["map", tree, "--clamp", "0.1192,0.971"])[0];
    let mean = (73.0 * (1.0 - entropy(0.1192)) + 9.0 * (1.0 - entropy(0.971))) / 82.0;
    assert_near(&row["mean_information"], mean);
    assert_eq!(row["meaningful"], false);
    assert!(row["warnings"][0].as_str().unwrap().starts_with("two-valued"), "{row}");
    assert!(refusal(&["map", tree, "--clamp", "0.6,0.9"]).contains("MIN,MAX with 0 <= MIN < 1/2 < MAX <= 1"));
}

/// The figures of docs/octrees.md.
#[test]
fn octomap_s_own_trees_are_measured() {
    let Some(data) = shared_data().map(|data| data.join("octomap")).filter(|data| data.exists()) else {
        return println!("skipped: no octrees");
    };
    let of = |name: &str| data.join(name).to_str().unwrap().to_owned();
    let rows = json(&["map", &of("geb079.bt"), &of("spherical_scan.ot"), "--clamp", "0.1192,0.971"]);
    for (row, mean, volume) in [(&rows[0], "0.528118", "581.85"), (&rows[1], "0.036430", "18.48")] {
        assert_eq!(format!("{:.6}", row["mean_information"].as_f64().unwrap()), mean);
        assert_eq!(format!("{:.2}", row["observed_volume_m3"].as_f64().unwrap()), volume);
    }
}

/// Of cells of several sizes the table says so; of one size, and where none has a size, it says nothing.
#[test]
fn maps_of_several_resolutions_are_not_to_be_compared() {
    let folder = Folder::new();
    let fine = folder.ros_map("fine", 5, &GREYS, "scale");
    let coarse = folder.ros_map("coarse", 5, &GREYS, "scale");
    let array = folder.npy_map("cells.npy", 2, &[0.25, 0.75]);
    let note = "these maps: cells of 0.2 to 0.4 m: compare maps at one resolution";
    assert!(!stdout(&["map", &fine, &coarse, &array]).contains("these maps"));
    let text = std::fs::read_to_string(&coarse).unwrap().replace("resolution: 0.2", "resolution: 0.4");
    std::fs::write(&coarse, text).unwrap();
    assert!(stdout(&["map", &fine, &array, &coarse]).contains(note));
    assert!(!stdout(&["map", &coarse, &array]).contains("these maps"));
}
