//! `meaninfo bag`: the maps of bags that another writer wrote, and the contract of the output.

mod common;

use common::schema::assert_order;
use common::*;
use mean_information_test_support::formats::bag::{Writer, mcap_at, mcap_of};
use serde_json::Value;

fn bag(name: &str) -> String {
    format!("{}/../files/tests/bags/{name}", env!("CARGO_MANIFEST_DIR"))
}

fn json(arguments: &[&str]) -> Vec<Value> {
    let text = stdout(&[arguments, &["--format", "json"]].concat());
    serde_json::from_str::<Value>(&text).unwrap().as_array().unwrap().clone()
}

/// The values of the maps by NumPy, each with its number.
fn expected() -> Vec<Vec<(i64, u64)>> {
    let text = std::fs::read_to_string(bag("expected.json")).unwrap();
    let maps: Value = serde_json::from_str(&text).unwrap();
    let pair = |pair: &Value| (pair[0].as_i64().unwrap(), pair[1].as_u64().unwrap());
    maps.as_array()
        .unwrap()
        .iter()
        .map(|map| map["values"].as_array().unwrap().iter().map(pair).collect())
        .collect()
}

#[test]
fn json_holds_the_contract() {
    let text = stdout(&["bag", &bag("maps_mcap_zstd"), "--format", "json"]);
    assert_order(&text, 4, "bag", "/items");
    let rows = json(&["bag", &bag("maps_mcap_zstd")]);
    // The third map undoes the update after the second, so all differ; but for the fourth, which says the same.
    let mut of = expected();
    of.remove(3);
    assert_eq!(rows.len(), of.len());
    for (row, values) in rows.iter().zip(of) {
        assert_twins(row, 4);
        let sum = |value: fn(f64) -> f64, wanted: fn(i64) -> bool| {
            let terms = values.iter().filter(|(v, _)| wanted(*v));
            terms.map(|&(v, n)| n as f64 * value(if v == -1 { 0.5 } else { v as f64 / 100.0 })).sum::<f64>()
        };
        let known = |v: i64| v != -1 && v != 50;
        let (information, observed) = (sum(|p| 1.0 - entropy(p), known), sum(|_| 1.0, known));
        assert_near(&row["information_bits"], information);
        assert_near(&row["mean_information"], information / observed);
        assert_near(&row["entropy_bits"], sum(entropy, |_| true));
        assert_eq!(row["observed"], observed as u64);
        assert_eq!(row["resolution_m"], f64::from(0.05_f32));
    }
    let column = |key: &str| rows.iter().map(|row| row[key].clone()).collect::<Vec<_>>();
    assert_eq!(column("repeats")[..6], [0, 0, 1, 0, 0, 0]);
    assert_eq!(column("time_s")[0], 1_700_000_000.25);
    assert_eq!(column("time_s")[2], 1_700_000_003.25);
    assert_eq!(column("time_ns")[2], 1_700_000_003_250_000_000_u64);
    // The topic that was not named is told.
    assert_eq!((&rows[0]["bag"], &rows[0]["topic"]), (&bag("maps_mcap_zstd").into(), &"/map".into()));
    let changed = column("changed_cells");
    assert_eq!([&changed[0], &changed[5]], [&Value::Null; 2]);
    assert!(changed[2].as_u64().is_some_and(|count| (1..=6).contains(&count)), "{changed:?}");
    assert_eq!(rows[5]["warnings"][0], "size, resolution or place differ from the map before");
}

#[test]
fn every_container_gives_the_same_rows() {
    // But for the name of the bag, which is in the first column.
    let rows = |name: &str| {
        let csv = stdout(&["bag", &bag(name), "--format", "csv"]);
        csv.lines().map(|line| line.split_once(',').unwrap().1.to_owned()).collect::<Vec<_>>()
    };
    let first = rows("maps_none.bag");
    for name in
        ["maps_bz2.bag", "maps_lz4.bag", "maps_mcap", "maps_mcap_zstd", "maps_mcap_lz4.mcap", "maps_db3"]
    {
        assert_eq!(rows(name), first, "{name}");
    }
}

#[test]
fn the_table_counts_from_the_first_map() {
    let table = stdout(&["bag", &bag("maps_db3"), "--topic", "/map"]);
    for words in ["13 × 7", "5 × 9", "repeats", "after 10 s: size, resolution or place differ"] {
        assert!(table.contains(words), "{words}: {table}");
    }
}

#[test]
fn maps_that_come_too_soon_are_left_out() {
    let times = |every: &str| {
        let rows = json(&["bag", &bag("maps_mcap"), "--every", every]);
        rows.iter().map(|row| row["time_s"].as_f64().unwrap() - 1_700_000_000.25).collect::<Vec<_>>()
    };
    assert_eq!(times("2"), (0..49).map(|index| 2.0 * f64::from(index)).collect::<Vec<_>>());
    assert_eq!(times("30"), [0.0, 30.0, 60.0, 90.0]);
    assert_eq!(times("1e300"), [0.0]);
}

#[test]
fn costmaps_are_refused_by_name() {
    let path = bag("maps_lz4.bag");
    let topic = "/global_costmap/costmap";
    let line = refusal(&["bag", &path, "--topic", topic]);
    let advice = "--topic names one, and --costmaps of `meaninfo bag` admits costmaps\n";
    assert!(line.contains("costs and not probabilities") && line.ends_with(advice), "{line}");
    for command in ["map", "sweep"] {
        assert!(refusal(&[command, &path, "--topic", topic]).ends_with(advice));
    }
    let rows = json(&["bag", &path, "--topic", topic, "--costmaps"]);
    assert_eq!((rows.len(), &rows[0]["repeats"], &rows[0]["observed"]), (1, &5.into(), &2.into()));
    let line = refusal(&["bag", &path, "--topic", "/other"]);
    assert!(line.contains("has no topic /other") && line.ends_with("/map; --topic names one\n"), "{line}");
}

#[test]
fn a_cut_bag_says_so_in_its_first_row() {
    let folder = Folder::new();
    let bytes = std::fs::read(bag("maps_mcap/maps_mcap.mcap")).unwrap();
    let path = folder.write("cut.mcap", &bytes[..bytes.len() / 3]);
    let rows = json(&["bag", path.to_str().unwrap()]);
    let warning = rows[0]["warnings"][0].as_str().unwrap();
    assert!(warning.starts_with("the bag is cut short at byte "), "{warning}");
}

#[test]
fn a_plot_has_both_curves() {
    let folder = Folder::new();
    let plot = folder.write("plot.svg", "").with_file_name("maps.svg");
    stdout(&["bag", &bag("maps_bz2.bag"), "--plot", plot.to_str().unwrap()]);
    let text = std::fs::read_to_string(plot).unwrap();
    roxmltree::Document::parse(&text).unwrap();
    for words in [
        "mean information of the observed cells",
        "area of the observed cells",
        "time after the first map (s)",
    ] {
        assert!(text.contains(words), "{words}");
    }
}

#[test]
fn meaninfo_map_measures_the_last_map() {
    let path = bag("maps_mcap_lz4.mcap");
    let last = json(&["bag", &path]).pop().unwrap();
    let map = &json(&["map", &path])[0];
    for key in [
        "width",
        "height",
        "mean_information_hex",
        "information_bits_hex",
        "observed",
        "unknown",
        "resolution_m",
    ] {
        assert_eq!(map[key], last[key], "{key}");
    }
}

/// The same tree as a file and as the message of a topic that is named, or the only one.
#[test]
fn meaninfo_map_measures_the_last_octree() {
    let mut nodes = Vec::new();
    for (log_odds, children) in [(0.85_f32, 0b0010_0001), (-0.4, 0), (0.75, 0)] {
        nodes.extend(log_odds.to_le_bytes());
        nodes.push(children);
    }
    let folder = Folder::new();
    let file = [b"# Octomap OcTree file\nid OcTree\nsize 3\nres 0.25\ndata\n", &*nodes].concat();
    let file = folder.write("tree.ot", file);
    let mut message = Writer::new(true, false);
    message.header([5, 6], "map");
    message.bytes.push(0);
    message.name("OcTree");
    message.doubles(&[0.25]);
    message.number((nodes.len() as u32).to_le_bytes());
    message.bytes.extend(nodes);
    let topics = [(7, "/octomap", "octomap_msgs/msg/Octomap"), (8, "/map", "nav_msgs/msg/OccupancyGrid")];
    let one = folder.write("one.mcap", mcap_of("cdr", &topics[..1], &[(7, message.bytes.clone())]));
    let two = folder.write("two.mcap", mcap_of("cdr", &topics, &[(7, message.bytes)]));
    let [file, one, two] = [&file, &one, &two].map(|path| path.to_str().unwrap());
    let rows = json(&["map", file]);
    for arguments in [&["map", one][..], &["map", two, "--topic", "/octomap"]] {
        let found = json(arguments);
        assert_eq!(found[0]["map"], arguments[1]);
        for key in
            ["leaves", "observed", "mean_information_hex", "observed_volume_m3", "resolution_m", "warnings"]
        {
            assert_eq!(found[0][key], rows[0][key], "{key}");
        }
    }
    assert!(refusal(&["map", two]).contains("has no message of topic /map"));
    let line = refusal(&["map", two, "--topic", "/other"]);
    assert!(line.contains("has no topic /other of type nav_msgs/OccupancyGrid; topics of its maps are: /map; of octrees: /octomap"), "{line}");
    assert!(refusal(&["map", one, "--heat-map", "x.png"]).contains("of octrees, which have no picture"));
    // And so does a sweep.
    let sweep = |arguments: &[&str]| {
        let text = stdout(&[&["sweep"], arguments, &["--format", "json"]].concat());
        serde_json::from_str::<Value>(&text).unwrap()["rows"].clone()
    };
    assert_eq!(sweep(&[two, "--topic", "/octomap"]), sweep(&[file]));
    assert_eq!(sweep(&[one]), sweep(&[file]));
    assert!(refusal(&["sweep", two]).contains("has no message of topic /map"));
    for command in ["map", "sweep"] {
        assert!(refusal(&[command, one, "--output", one]).contains("is an input"));
    }
}

/// Sim time begins again: the maps are measured, and the row says so.
#[test]
fn a_clock_that_jumps_back_is_told() {
    let grid = |cell: u8| {
        let mut message = Writer::new(false, false);
        message.header([5, 6], "map");
        for x in [1_u32, 2] {
            message.number(x.to_le_bytes());
        }
        message.floats(&[0.25]);
        for x in [2_u32, 1] {
            message.number(x.to_le_bytes());
        }
        message.doubles(&[0.5, -2.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
        message.number(2_u32.to_le_bytes());
        message.bytes.extend([cell, 100]);
        message.bytes
    };
    let topics = [(7, "/map", "nav_msgs/msg/OccupancyGrid")];
    let messages = [(7, 9_000_000_000, grid(3)), (7, 2_500_000_000, grid(4))];
    let folder = Folder::new();
    let path = folder.write("jump.mcap", mcap_at("cdr", &topics, &messages));
    let rows = json(&["bag", path.to_str().unwrap()]);
    assert_eq!(rows.iter().map(|row| row["time_s"].as_f64().unwrap()).collect::<Vec<_>>(), [9.0, 2.5]);
    assert_eq!(rows[1]["warnings"][0], "the clock jumps back by 6.5 s");
    let table = stdout(&["bag", path.to_str().unwrap()]);
    assert!(table.contains("after -6.5 s: the clock jumps back by 6.5 s"), "{table}");
}
