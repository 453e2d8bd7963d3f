//! `meaninfo converge`: grids counted here a second time, in plain floating point.

mod common;

use approx::assert_abs_diff_eq;
use common::schema::assert_order;
use common::*;
use serde_json::Value;

/// Mean information and observed cells of the distances given.
fn measure(distances: impl Iterator<Item = f64>, range: f64, sigma: f64) -> (f64, u64) {
    let edge = range + sigma * libm::log(4.0).sqrt();
    let bits = distances.filter(|rho| *rho < edge).map(|rho| {
        let t = (rho - range) / sigma;
        1.0 - entropy(libm::exp(-0.5 * t * t))
    });
    let (sum, observed) = bits.fold((0.0, 0_u64), |(sum, n), bits| (sum + bits, n + 1));
    (sum / observed as f64, observed)
}

#[test]
fn rows_are_the_grids_of_the_room() {
    let (range, sigma) = (3.0, 0.4);
    let arguments = ["converge", "--range", "3", "--sigma", "0.4", "--resolutions", "0.8,0.17,0.06"];
    for grid in ["polar", "cartesian"] {
        let text = stdout(&[&arguments[..], &["--grid", grid, "--format", "json"]].concat());
        assert_order(&text, 2, "converge", "");
        assert_order(&text, 6, "converge", "/properties/rows/items");
        let json: Value = serde_json::from_str(&text).unwrap();
        // Eq. 6 by the midpoint rule; the error is at most the variation (3) over twice the number of steps.
        let step = (range + sigma * libm::log(4.0).sqrt()) / 1e5;
        let (sum, weights) =
            (0..100_000).map(|k| (f64::from(k) + 0.5) * step).fold((0.0, 0.0), |(sum, all), rho| {
                let weight = if grid == "polar" { 1.0 } else { rho };
                (sum + weight * measure([rho].into_iter(), range, sigma).0, all + weight)
            });
        assert_abs_diff_eq!(json["limit"].as_f64().unwrap(), sum / weights, epsilon = 3e-5);
        let rows = json["rows"].as_array().unwrap();
        for (row, h) in rows.iter().zip([0.8, 0.17, 0.06]) {
            let (mean, observed) = if grid == "polar" {
                measure((0..200).map(|k| (f64::from(k) + 0.5) * h), range, sigma)
            } else {
                let centre = |i: i32| (f64::from(i) + 0.5) * h;
                let square = (-60..60).flat_map(|i| (-60..60).map(move |j| (i, j)));
                measure(square.map(|(i, j)| libm::hypot(centre(i), centre(j))), range, sigma)
            };
            assert_near(&row["resolution_m"], h);
            assert_near(&row["mean_information"], mean);
            assert_eq!(row["observed"], observed);
            let error = row["error"].as_f64().unwrap();
            assert_abs_diff_eq!(error, mean - json["limit"].as_f64().unwrap(), epsilon = 1e-9);
            for bound in ["bound", "bound_of_count"] {
                assert!(error.abs() <= row[bound].as_f64().unwrap(), "{row}");
            }
            assert_twins(row, 4);
        }
        assert_eq!(rows.len(), 3);
    }
}

#[test]
fn cell_sizes_are_chosen_if_none_are_given() {
    for (range, first) in [("2", 0.5), ("0.03", 0.005), ("700", 100.0)] {
        let text = stdout(&["converge", "--range", range, "--sigma", "0.007", "--format", "json"]);
        let json: Value = serde_json::from_str(&text).unwrap();
        let rows = json["rows"].as_array().unwrap();
        assert_eq!(rows.len(), 8);
        assert_near(&rows[0]["resolution_m"], first);
        let side = |row: &Value| row["resolution_m"].as_f64().unwrap();
        assert!(rows.windows(2).all(|pair| side(&pair[1]) < 0.51 * side(&pair[0])));
    }
}

#[test]
fn csv_and_table_say_the_same_as_json() {
    let arguments =
        ["converge", "--range", "2", "--sigma", "0.2", "--resolutions", "0.08,0.0025", "--grid", "cartesian"];
    let json: Value =
        serde_json::from_str(&stdout(&[&arguments[..], &["--format", "json"]].concat())).unwrap();
    let csv_text = stdout(&[&arguments[..], &["--format", "csv"]].concat());
    let table = stdout(&arguments);
    let mut csv = csv::Reader::from_reader(csv_text.as_bytes());
    let header: Vec<_> = csv.headers().unwrap().iter().map(str::to_owned).collect();
    for (row, object) in csv.records().map(Result::unwrap).zip(json["rows"].as_array().unwrap()) {
        for (field, key) in row.iter().zip(&header) {
            let value = if key.starts_with("limit") { &json[key] } else { &object[key] };
            match value {
                Value::Number(number) => assert_eq!(field.parse::<f64>().ok(), number.as_f64(), "{key}"),
                other => assert_eq!(Some(field), other.as_str(), "{key}"),
            }
        }
        assert!(table.contains(&object["mean_information"].to_string()), "{table}");
    }
    // The figures of the erratum.
    assert!(table.contains("0.6516488322393775") && table.contains("0.6525109529727351"), "{table}");
}

#[test]
fn the_plot_shows_both_grids_and_both_limits() {
    let folder = Folder::new();
    let arguments = ["converge", "--range", "2", "--sigma", "0.2", "--resolutions", "0.5,0.1,0.02", "--plot"];
    let draw = |name: &str| {
        let path = folder.text_path(name);
        stdout(&[&arguments[..], &[&path]].concat());
        read(&path)
    };
    let svg = draw("a.svg");
    assert_eq!(svg, draw("b.svg"));
    let document = roxmltree::Document::parse(text(&svg)).unwrap();
    let texts: Vec<_> = document
        .descendants()
        .filter(|n| n.has_tag_name("text"))
        .filter_map(|n| n.text())
        .map(str::trim)
        .collect();
    for expected in ["cell size (m)", "mean information (bits / cell)", "polar grid", "Cartesian grid", "0.1"]
    {
        assert!(texts.contains(&expected), "{expected} in {texts:?}");
    }
    assert!(texts.iter().any(|text| text.contains(" grids: 0.789337,")), "{texts:?}");
    assert!(texts.iter().any(|text| text.contains(" grids: 0.652511,")), "{texts:?}");
    let png = draw("a.png");
    assert_eq!(png, draw("b.png"));
    let image = Pixels::of_png(&png);
    let pixels = |colour: [u8; 3]| {
        (0..image.height)
            .flat_map(|y| (0..image.width).map(move |x| (x, y)))
            .filter(|&(x, y)| image.at(x, y) == colour)
            .count()
    };
    assert!(pixels([0, 90, 170]) > 500 && pixels([190, 75, 0]) > 500);
}

#[test]
fn what_cannot_be_is_refused() {
    let folder = Folder::new();
    let good = ["converge", "--range", "2", "--sigma", "0.2"];
    for (arguments, what) in [
        (&["converge", "--sigma", "0.2"][..], "--range"),
        (&["converge", "--range", "0", "--sigma", "0.2"], "positive"),
        (&["converge", "--range", "2", "--sigma", "nan"], "positive"),
        (&["converge", "--range", "two", "--sigma", "0.2"], "not a number"),
        (&["converge", "--range", "2", "--sigma", "0.2", "--resolutions", "0.1,-1"], "-1"),
        (&["converge", "--range", "2", "--sigma", "0.2", "--resolutions", "1e-300"], "samples"),
        (
            &["converge", "--range", "2", "--sigma", "0.2", "--resolutions", "1e-12", "--grid", "cartesian"],
            "samples",
        ),
        (&["converge", "--range", "2", "--sigma", "0.2", "--grid", "round"], "polar, cartesian"),
    ] {
        let line = refusal(arguments);
        assert!(line.contains(what), "{arguments:?}: {line}");
    }
    let plot = folder.text_path("a.pdf");
    assert!(refusal(&[&good[..], &["--plot", &plot]].concat()).contains(".svg or .png"));
    let plot = folder.text_path("a.svg");
    refusal(&[&good[..], &["--plot", &plot, "--resolutions", "1e-200"]].concat());
    assert!(folder.names().is_empty());
}

/// The picture of `docs/erratum.md`.
#[test]
fn the_picture_of_the_erratum_is_this_plot() {
    let folder = Folder::new();
    let plot = folder.text_path("plot.svg");
    stdout(&["converge", "--range", "2", "--sigma", "0.2", "--grid", "cartesian", "--plot", &plot]);
    let kept = read(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/figures/convergence.svg"));
    assert!(read(&plot) == kept, "meaninfo converge draws docs/figures/convergence.svg otherwise");
}
