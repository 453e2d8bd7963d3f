//! `meaninfo sweep`: pooled here a second time, and drawn.

mod common;

use approx::abs_diff_eq;
use common::schema::{assert_order, required};
use common::*;
use mean_information::map::encoding::LogOdds;
use mean_information::map::{Geometry, Grid};
use mean_information_test_support::formats::Node;
use serde_json::Value;

/// The keys of a row.
fn row_keys() -> Vec<String> {
    required("sweep", "/properties/rows/items")
}

/// The mean occupancies of the k x k blocks from the lower left corner; what lies beyond the map is unknown.
fn pooled(p: &[f64], width: usize, k: usize) -> Vec<f64> {
    let height = p.len() / width;
    let at = |row: usize, column: usize| p[(height - 1 - row) * width + column];
    let mut means = Vec::new();
    for top in (0..height).step_by(k) {
        for left in (0..width).step_by(k) {
            let rows = top..(top + k).min(height);
            let cells: Vec<f64> =
                rows.flat_map(|y| (left..(left + k).min(width)).map(move |x| at(y, x))).collect();
            let beyond = (k * k - cells.len()) as f64;
            means.push((cells.iter().sum::<f64>() + 0.5 * beyond) / (k * k) as f64);
        }
    }
    means
}

#[test]
fn rows_are_the_measures_of_pooled_maps() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let text = stdout(&["sweep", &map, "--format", "json"]);
    assert_order(&text, 2, "sweep", "");
    assert_order(&text, 6, "sweep", "/properties/rows/items");
    let json: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(json["map"], map.as_str());
    let rows = json["rows"].as_array().unwrap();
    let sizes = [(1, 5, 3), (2, 3, 2), (4, 2, 1), (8, 1, 1)];
    assert_eq!(rows.len(), sizes.len());
    for (row, (k, width, height)) in rows.iter().zip(sizes) {
        let p = pooled(&occupancies(&GREYS), 5, k);
        let known: Vec<f64> = p.iter().copied().filter(|p| (p - 0.5).abs() > 1e-12).collect();
        let information: f64 = known.iter().map(|&p| 1.0 - entropy(p)).sum();
        assert_eq!(
            [&row["k"], &row["width"], &row["height"], &row["observed"]],
            [k, width, height, known.len()].map(Value::from).each_ref()
        );
        assert_near(&row["resolution_m"], 0.2 * k as f64);
        assert_near(&row["mean_information"], information / known.len() as f64);
        assert_near(&row["information_bits"], information);
        assert_near(&row["entropy_bits"], p.iter().map(|&p| entropy(p)).sum());
        assert_twins(row, 3);
    }
}

/// The bits of the grid of log-odds itself, pooled by the library; of unknown cells, and of odds beyond those of floats, too.
#[test]
fn log_odds_are_pooled_as_their_occupancies() {
    let folder = Folder::new();
    let odds: Vec<f64> =
        (0..35).map(|k| [0.0, 0.3, -2.7, 1e-17, 40.0, -800.0][k % 6] * (k as f64 + 0.7)).collect();
    let map = folder.npy_map("odds.npy", 7, &odds);
    let text = stdout(&["sweep", &map, "--encoding", "log-odds", "--format", "json"]);
    let json: Value = serde_json::from_str(&text).unwrap();
    let geometry = Geometry::new(1.0, [0.0, 0.0]).unwrap();
    let grid = Grid::<LogOdds<f64>>::new(7, 5, geometry, odds).unwrap();
    let rows = json["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 4);
    for row in &rows[1..] {
        let tally = grid.pooled(row["k"].as_u64().unwrap() as usize).unwrap().tally();
        for (key, exact) in [("information_bits", tally.information()), ("entropy_bits", tally.entropy())] {
            assert_eq!(row[key].as_f64(), Some(exact), "{row}");
        }
        assert_eq!(row["observed"], tally.observed());
    }
}

/// Averaging loses information (Jensen: that of a block's mean is at most the mean of its cells'), and what lies beyond
/// the map adds none. So the information of the area, `information * k^2`, never grows; and since a block with an
/// observed cell is observed, the mean information never rises. The exception, which this map does not have: a block
/// whose observed cells average to exactly 1/2 becomes unknown and leaves the mean.
#[test]
fn information_only_falls_as_cells_grow() {
    let room = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/room.yaml");
    let json: Value = serde_json::from_str(&stdout(&["sweep", room, "--format", "json"])).unwrap();
    let rows: Vec<[f64; 3]> = json["rows"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| ["k", "information_bits", "mean_information"].map(|key| row[key].as_f64().unwrap()))
        .collect();
    assert_eq!(rows.len(), 9);
    for pair in rows.windows(2) {
        let [[k, information, mean], [coarse_k, coarse_information, coarse_mean]] = pair else {
            unreachable!()
        };
        assert_eq!(*coarse_k, 2.0 * k);
        // Occupancies of blocks are rounded, so equal informations may differ by some ulps; these are not equal.
        assert!(coarse_information * coarse_k * coarse_k < information * k * k, "{pair:?}");
        assert!(coarse_mean < mean, "{pair:?}");
    }
}

#[test]
fn csv_and_table_say_the_same_as_json() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let json: Value = serde_json::from_str(&stdout(&["sweep", &map, "--format", "json"])).unwrap();
    let csv_text = stdout(&["sweep", &map, "--format", "csv"]);
    let mut csv = csv::Reader::from_reader(csv_text.as_bytes());
    let header: Vec<_> = csv.headers().unwrap().iter().map(str::to_owned).collect();
    assert_eq!(header[1..12], row_keys());
    assert_eq!((&*header[0], &*header[12]), ("map", "warnings"));
    let table = stdout(&["sweep", &map]);
    for (row, object) in csv.records().map(Result::unwrap).zip(json["rows"].as_array().unwrap()) {
        for (field, key) in row.iter().zip(&header).skip(1).take(11) {
            match &object[key] {
                Value::Number(number) => assert_eq!(field.parse::<f64>().ok(), number.as_f64(), "{key}"),
                other => assert_eq!(Some(field), other.as_str(), "{key}"),
            }
        }
        let shown = table.split_whitespace().filter_map(|word| word.parse::<f64>().ok());
        assert!(shown.into_iter().any(|x| Some(x) == object["mean_information"].as_f64()), "{table}");
    }
}

#[test]
fn a_map_of_one_cell_and_one_of_unknown_cells() {
    let folder = Folder::new();
    let one = folder.ros_map("one", 1, &[30], "scale");
    let unknown = folder.ros_map("unknown", 3, &[205; 6], "trinary");
    for (map, steps) in [(one, 1), (unknown, 3)] {
        let json: Value = serde_json::from_str(&stdout(&["sweep", &map, "--format", "json"])).unwrap();
        assert_eq!(json["rows"].as_array().unwrap().len(), steps);
        for picture in ["plot.svg", "plot.png"] {
            stdout(&["sweep", &map, "--plot", &folder.text_path(picture)]);
        }
    }
    let warned = stdout(&["sweep", &folder.text_path("unknown.yaml")]);
    assert!(warned.contains("nothing observed") && warned.contains("none"), "{warned}");
}

#[test]
fn the_svg_is_well_formed_and_its_text_is_text() {
    let folder = Folder::new();
    let map = folder.ros_map("a <b> & \"c\"", 5, &GREYS, "scale");
    let plot = folder.text_path("plot.svg");
    let draw = || {
        stdout(&["sweep", &map, "--plot", &plot]);
        read(&plot)
    };
    let svg = draw();
    assert_eq!(svg, draw());
    let document = roxmltree::Document::parse(text(&svg)).unwrap();
    let texts: Vec<_> =
        document.descendants().filter(|n| n.has_tag_name("text")).filter_map(|n| n.text()).collect();
    let texts: Vec<_> = texts.iter().map(|text| text.trim()).collect();
    for expected in [
        "cell size (m)",
        "total entropy (bits)",
        "mean information (bits / cell)",
        "0.2",
        "0.4",
        "0.8",
        "1.6",
    ] {
        assert!(texts.contains(&expected), "{expected} in {texts:?}");
    }
    assert!(texts.iter().any(|text| text.starts_with("a <b> & \"c\".yaml")), "{texts:?}");
}

/// The points of both curves lie where the labels of their axes say.
#[test]
fn points_stand_where_their_axis_says() {
    let room = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/room.yaml");
    let folder = Folder::new();
    let plot = folder.text_path("plot.svg");
    let json = stdout(&["sweep", room, "--plot", &plot, "--format", "json"]);
    let json: Value = serde_json::from_str(&json).unwrap();
    let svg = read(&plot);
    let document = roxmltree::Document::parse(text(&svg)).unwrap();
    let number = |node: roxmltree::Node, name: &str| node.attribute(name).unwrap().parse::<f64>().unwrap();
    let nodes = |tag: &'static str| document.descendants().filter(move |node| node.has_tag_name(tag));
    // Labels of vertical axes end at their tick; those of the upper panel stand above the lower one's.
    let labels: Vec<(f64, f64)> = nodes("text")
        .filter(|node| node.attribute("text-anchor") == Some("end"))
        .map(|node| (number(node, "y"), node.text().unwrap().trim().parse().unwrap()))
        .collect();
    let upper = labels.iter().filter(|(y, _)| *y < 390.0).copied().collect::<Vec<_>>();
    let lower: Vec<_> =
        labels.iter().filter(|(y, _)| *y > 390.0).map(|&(y, bits)| (y, libm::log10(bits))).collect();
    assert!(upper.len() == 6 && lower.len() > 4, "{labels:?}");
    let rows = json["rows"].as_array().unwrap();
    for (ticks, colour, key, logarithmic) in
        [(upper, "#005AAA", "mean_information", false), (lower, "#BE4B00", "entropy_bits", true)]
    {
        // The circle of the legend follows.
        let circles: Vec<_> = nodes("circle").filter(|node| node.attribute("fill") == Some(colour)).collect();
        assert_eq!(circles.len(), rows.len() + 1);
        let ((y0, v0), (y1, v1)) = (ticks[0], ticks[ticks.len() - 1]);
        for (row, circle) in rows.iter().zip(circles) {
            let value = row[key].as_f64().unwrap();
            let value = if logarithmic { libm::log10(value) } else { value };
            let expected = y0 + (value - v0) / (v1 - v0) * (y1 - y0);
            let cy = number(circle, "cy");
            assert!(abs_diff_eq!(cy, expected, epsilon = 1.5), "{key} {value}: {cy}, not {expected}");
        }
    }
}

#[test]
fn the_png_has_both_curves_and_the_same_bytes_on_every_run() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let plot = folder.text_path("plot.png");
    let draw = || {
        stdout(&["sweep", &map, "--plot", &plot]);
        read(&plot)
    };
    let png = draw();
    assert_eq!(png, draw());
    let image = Pixels::of_png(&png);
    let half = image.height / 2;
    let pixels = |colour: [u8; 3], rows: std::ops::Range<u32>| {
        rows.flat_map(|y| (0..image.width).map(move |x| (x, y)))
            .filter(|&(x, y)| image.at(x, y) == colour)
            .count()
    };
    assert!(pixels([0, 90, 170], 0..half) > 500 && pixels([0, 90, 170], half..image.height) == 0);
    assert!(pixels([190, 75, 0], half..image.height) > 500 && pixels([190, 75, 0], 0..half) == 0);
}

/// An octree is averaged depth by depth, children that are missing as unknown.
#[test]
fn an_octree_is_swept_by_depth() {
    let folder = Folder::new();
    let path = folder.write("tree.ot", Node::small().lowered(13).full(false));
    let json: Value =
        serde_json::from_str(&stdout(&["sweep", path.to_str().unwrap(), "--format", "json"])).unwrap();
    let rows = json["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 17);
    let p = |l: f32| 1.0 / (1.0 + libm::exp(-f64::from(l)));
    let fine = (p(-0.4) + p(2.25) + 3.0) / 8.0;
    let middle = (p(0.85) + fine + p(-1.5) + 2.5) / 8.0;
    let information = |p: f64| 1.0 - entropy(p);
    let sums = [
        64.0 * information(p(-0.4))
            + 8.0 * information(p(0.85))
            + information(p(-0.4))
            + information(p(2.25))
            + 8.0 * information(p(-1.5)),
        8.0 * information(p(-0.4)) + information(p(0.85)) + information(fine) + information(p(-1.5)),
        information(p(-0.4)) + information(middle),
    ];
    let observed = [82, 11, 2];
    for (up, row) in rows.iter().enumerate() {
        assert_eq!((&row["depth"], &row["k"]), (&(16 - up).into(), &(1 << up).into()));
        assert!(row["width"].is_null() && row["height"].is_null());
        assert_near(&row["resolution_m"], 0.05 * f64::from(1 << up));
        if let (Some(&sum), Some(&observed)) = (sums.get(up), observed.get(up)) {
            assert_near(&row["information_bits"], sum);
            assert_eq!(row["observed"], observed);
            assert_near(&row["mean_information"], sum / f64::from(observed));
        } else {
            assert_eq!(row["observed"], 1);
        }
        assert_twins(row, 3);
    }
    let plot = folder.path("plot.svg");
    stdout(&["sweep", path.to_str().unwrap(), "--plot", plot.to_str().unwrap()]);
    assert!(std::fs::read_to_string(plot).unwrap().contains("0.05"));
}
