//! Many maps in one run: refusals together, rows in order, whatever the threads.

mod common;

use common::*;
use mean_information_test_support::formats::npy;
use serde_json::Value;

/// The lines of standard error, and standard output, of a run that must end with status 2.
fn failed(arguments: &[&str]) -> (Vec<String>, String) {
    let output = meaninfo().args(arguments).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    (text(&output.stderr).lines().map(str::to_owned).collect(), text(&output.stdout).to_owned())
}

#[test]
fn all_files_that_cannot_be_read_are_named_in_one_run() {
    let folder = Folder::new();
    let good = folder.npy_map("good.npy", 2, &[0.25, 0.5, 1.0, 0.0]);
    let bad = folder.npy_map("bad.npy", 2, &[0.25, 7.0, 1.0, 0.0]);
    let gone = folder.text_path("gone.npy");
    let (lines, printed) = failed(&["map", &bad, &good, &gone]);
    assert_eq!((lines.len(), &*printed), (2, ""));
    assert!(lines[0].starts_with(&format!("meaninfo: {bad}: cell at row 0, column 1 is 7")), "{lines:?}");
    assert!(lines[1].starts_with(&format!("meaninfo: {gone}: ")), "{lines:?}");

    let (lines, printed) = failed(&["map", &bad, &good, &gone, "--keep-going", "--format", "json"]);
    assert_eq!(lines.len(), 2);
    let rows: Value = serde_json::from_str(&printed).unwrap();
    assert_eq!((rows.as_array().unwrap().len(), rows[0]["map"].as_str()), (1, Some(&*good)));
    // Where nothing can be read there is nothing to print.
    assert_eq!(failed(&["map", &bad, &gone, "--keep-going"]).1, "");
    assert_eq!(stdout(&["map", &good, "--keep-going"]), stdout(&["map", &good]));
}

#[test]
fn threads_change_neither_order_nor_bytes() {
    let folder = Folder::new();
    let maps: Vec<String> = (0..40)
        .map(|k| {
            let cells: Vec<f64> = (0..600 / (k + 1)).map(|c| ((c * 7 + k) % 11) as f64 / 11.0).collect();
            folder.npy_map(&format!("{k}.npy"), 1, &cells)
        })
        .collect();
    // So large that threads share its cells.
    let cells: Vec<f64> = (0..90_011).map(|c| f64::from(c * 7 % 90_012) / 90_011.0).collect();
    let large = folder.npy_map("large.npy", 1, &cells);
    let mut arguments = vec!["map", "--format", "csv", &large];
    arguments.extend(maps.iter().map(String::as_str));
    let of = |threads: &str| {
        let output = meaninfo().env("RAYON_NUM_THREADS", threads).args(&arguments).output().unwrap();
        text(&output.stdout).to_owned()
    };
    let one = of("1");
    assert_eq!(one.lines().count(), 42);
    for threads in ["2", "7"] {
        assert_eq!(of(threads), one);
    }
}

#[test]
fn the_options_that_mend_arrays_are_named() {
    let folder = Folder::new();
    let with = |value: f64| folder.npy_map("map.npy", 2, &[0.25, value]);
    let line = refusal(&["map", &with(f64::NAN)]);
    assert!(line.ends_with("makes NaN unknown, as does --unknown NaN\n"), "{line}");
    assert!(refusal(&["map", &with(-1.0)]).ends_with("makes -1 unknown, as does --unknown -1\n"));
    for (value, unknown) in [(f64::NAN, "nan"), (-1.0, "-1"), (3.5, "3.5")] {
        let json: Value =
            serde_json::from_str(&stdout(&["map", &with(value), "--unknown", unknown, "--format", "json"]))
                .unwrap();
        assert_eq!((json[0]["unknown"].as_u64(), json[0]["observed"].as_u64()), (Some(1), Some(1)));
    }
    let wide = folder.write("wide.npy", npy("'<i2'", false, "(1, 2)", &[7, 0, 100, 0]));
    let wide = wide.to_str().unwrap();
    assert!(refusal(&["map", wide]).ends_with("; --encoding percent reads them as they are\n"));
    assert!(stdout(&["map", wide, "--encoding", "percent"]).contains("observed"));
}

/// The particles of a filter may mark unknown cells so, too.
#[test]
fn a_value_of_particles_may_mean_unknown() {
    let folder = Folder::new();
    let doubles = |numbers: &[f64]| numbers.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    let write = |name: &str, shape: &str, numbers: &[f64]| {
        folder.write(name, npy("'<f8'", false, shape, &doubles(numbers))).to_str().unwrap().to_owned()
    };
    let weights = write("w.npy", "(2,)", &[0.5, 0.25]);
    let [marked, plain] = [("m.npy", f64::NAN), ("p.npy", 0.5)]
        .map(|(name, unknown)| write(name, "(2, 1, 2)", &[0.25, unknown, 0.75, unknown]));
    let run = |particles: &str, more: &[&str]| {
        let arguments = ["emmi", "--particles", particles, "--weights", &weights, "--format", "json"];
        stdout(&[&arguments[..], more].concat())
    };
    assert_eq!(run(&marked, &["--unknown", "nan"]), run(&plain, &[]));
    let line = refusal(&["emmi", "--particles", &marked, "--weights", &weights]);
    assert!(
        line.contains("m.npy: particle 0: cell at row 0, column 1 is NaN") && line.contains("--unknown NaN"),
        "{line}"
    );
}

/// An average in floats leaves unknown cells beside 1/2, and its mean information means nothing.
#[test]
fn averages_in_floats_are_not_meaningful() {
    let folder = Folder::new();
    for (cells, meaningful) in [([0.25, 0.5_f64.next_down()], false), ([0.25, 0.5], true)] {
        let map = folder.npy_map("map.npy", 2, &cells);
        for command in ["map", "sweep"] {
            let json: Value = serde_json::from_str(&stdout(&[command, &map, "--format", "json"])).unwrap();
            let json = if command == "map" { &json[0] } else { &json };
            assert_eq!(
                json["warnings"].to_string().contains("an ulp or two from 1/2"),
                !meaningful,
                "{json}"
            );
            if command == "map" {
                assert_eq!(json["meaningful"], meaningful);
            }
        }
    }
}

/// Both files are named where they disagree.
#[test]
fn weights_that_do_not_go_with_the_particles() {
    let folder = Folder::new();
    let doubles = |numbers: &[f64]| numbers.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    let particles = folder.write("p.npy", npy("'<f8'", false, "(2, 1, 1)", &doubles(&[0.25, 0.75])));
    let of = |numbers: &[f64]| {
        let shape = format!("({},)", numbers.len());
        let weights = folder.write("w.npy", npy("'<f8'", false, &shape, &doubles(numbers)));
        let particles = particles.to_str().unwrap();
        refusal(&["emmi", "--particles", particles, "--weights", weights.to_str().unwrap()])
    };
    let line = of(&[0.5, 0.25, 0.25]);
    assert!(line.contains("w.npy: has 3 weights, but ") && line.contains("p.npy has 2 particles"), "{line}");
    assert!(of(&[-1000.0, -1001.0]).contains("np.exp(w - w.max())"));
    assert!(of(&[-5e-324, 1.0]).len() < 250);
}
