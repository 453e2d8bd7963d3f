//! `meaninfo emmi --filter`: rows against maps built particle by particle, the keys, the plot, and what is refused.

mod public;

use crate::common::schema::assert_order;
use crate::common::*;
use mean_information::Error;
use mean_information::expected::Hypotheses;
use mean_information::scan::ScanMap;
use mean_information::sensor::SteppedSensor;
use mean_information_files::particles::FilterLog;
use mean_information_files::read_filter_log;
use mean_information_files::scans::{NoReturn, ScanOptions};
use serde_json::Value;
use std::fmt::Write;

/// Three particles in a round room over six scans, drawn anew after the second and the fourth.
fn log() -> String {
    let mut log = "PARAM ogain 2\nPARAM maxrange 40\n".to_owned();
    for step in 0..6 {
        let range = |k: i32| 2.0 + 0.01 * f64::from((7 * k + 13 * step) % 17);
        let ranges: Vec<_> = (0..180).map(|k| format!(" {:.2}", range(k))).collect();
        let ranges = ranges.concat();
        writeln!(log, "LASER_READING 180{ranges} 0 0 0 {}", 10.5 + 1.25 * f64::from(step)).unwrap();
        let particle = |k: i32| {
            let [x, y, theta] = [0.11, 0.03, 0.02].map(|drift| drift * f64::from(step * (1 + k)));
            format!(" {x} {y} {theta} {}", -3.0 - f64::from(step) - f64::from((k + step) % 3))
        };
        writeln!(log, "SM_UPDATE 3{}", (0..3).map(particle).collect::<String>()).unwrap();
        log += match step {
            1 => "RESAMPLE 3 2 0 2\n",
            3 => "RESAMPLE 3 1 1 1\n",
            _ => "",
        };
    }
    log
}

fn rows(arguments: &[&str]) -> Vec<Value> {
    let text = stdout(&[&["emmi", "--filter"], arguments, &["--format", "json"]].concat());
    assert_order(&text, 4, "emmi-filter", "/items");
    serde_json::from_str(&text).unwrap()
}

/// Compares a row with the particles' maps, each made of the scans on its own way and nothing shared.
fn check(log: &FilterLog, row: &Value, resolution: f64) {
    let step = row["step"].as_u64().unwrap() as usize;
    let model = |range| SteppedSensor::new(range, resolution, 0.4, 0.7);
    let built = |particle| -> Result<_, Error> {
        let mut map = ScanMap::<f64>::new(resolution)?;
        for (step, pose) in log.steps.iter().zip(log.trajectory(step, particle)) {
            if let Some(scan) = step.scan.scan_from(pose, NoReturn::LeftOut)? {
                map.insert(&scan, model)?;
            }
        }
        map.log_odds()
    };
    let maps: Vec<_> = (0..log.particles()).map(|particle| built(particle).unwrap()).collect();
    let hypotheses = Hypotheses::new(&maps, &log.weights(step)).unwrap();
    let expected = hypotheses.expected_tally().unwrap();
    let numbers = ["emmi", "information_bits", "entropy_bits", "mean_of_particles", "effective_particles"];
    let found = numbers.map(|key| row[key].as_f64().unwrap());
    let effective = log.steps[step].effective(log.gain);
    let mean = hypotheses.mean_of_mean_information();
    let own = [expected.mean_information(), expected.information(), expected.entropy(), mean, effective];
    assert_eq!(found, own, "step {step}");
    assert_eq!(row["observed"], expected.observed());
    assert_eq!(row["time_s"], log.steps[step].scan.time());
}

#[test]
fn rows_are_those_of_maps_that_share_nothing() {
    let folder = Folder::new();
    let path = folder.write("log.gfs", log());
    let name = path.to_str().unwrap();
    let read = read_filter_log(&path, &ScanOptions::default()).unwrap();
    let rows = rows(&[name, "--resolution", "0.3"]);
    assert_eq!(rows.len(), 6);
    for row in &rows {
        assert_twins(row, 5);
        check(&read, row, 0.3);
    }
    let left = |row: &Value| (row["resampled"].as_bool().unwrap(), row["particles_left"].as_u64());
    let none = (false, None);
    assert_eq!(
        rows.iter().map(left).collect::<Vec<_>>(),
        [none, (true, Some(2)), none, (true, Some(1)), none, none]
    );
    assert_eq!(rows[0]["sensor"], "stepped: free 0.4, occupied 0.7, walls 0.3 m thick");

    assert_eq!((rows[0]["gain"].as_f64(), rows[0]["reading_limit_nats"].as_f64()), (Some(2.0), Some(3.5)));
    assert!(rows[0]["mount"].as_str().unwrap().starts_with("poses are taken for those of the laser"));
    let more = ["--sensor", "gaussian", "--sigma", "0.1", "--no-return", "free", "--max-range", "9"];
    let arguments = [&[name, "--resolution", "0.3", "--mount", "0.25,-0.5,0.125", "--every", "6"][..], &more];
    let rows_of_others = self::rows(&arguments.concat());
    let keys = ["mount_x_m", "mount_y_m", "mount_yaw_rad", "sigma_m", "max_range_m"];
    let numbers = keys.map(|key| rows_of_others[0][key].as_f64().unwrap());
    assert_eq!(numbers, [0.25, -0.5, 0.125, 0.1, 9.0]);
    assert_eq!(
        (&rows_of_others[0]["sensor_free"], &rows_of_others[0]["no_return"]),
        (&Value::Null, &"free".into())
    );

    // Every second, and the last: a resampling after a step without a row stands in the row after it.
    let some = self::rows(&[name, "--resolution", "0.3", "--every", "2"]);
    assert_eq!(some.iter().map(|row| row["step"].as_u64().unwrap()).collect::<Vec<_>>(), [0, 2, 4, 5]);
    assert_eq!(some.iter().map(left).collect::<Vec<_>>(), [none, (true, Some(2)), (true, Some(1)), none]);
    // Every third, and the last: the same rows, with what was drawn anew in between.
    let some = self::rows(&[name, "--resolution", "0.3", "--every", "3"]);
    assert_eq!(some.iter().map(|row| row["step"].as_u64().unwrap()).collect::<Vec<_>>(), [0, 3, 5]);
    assert_eq!(some.iter().map(left).collect::<Vec<_>>(), [none, (true, Some(1)), none]);
    for row in &some {
        let all = &rows[row["step"].as_u64().unwrap() as usize];
        assert!(
            ["emmi", "observed", "entropy_bits", "mean_of_particles"].iter().all(|&key| row[key] == all[key])
        );
    }
}

#[test]
fn a_laser_that_is_mounted_elsewhere_makes_other_maps() {
    let folder = Folder::new();
    let name = folder.write("log.gfs", log());
    let name = name.to_str().unwrap();
    let last = |arguments: &[&str]| {
        let fixed = ["--resolution", "0.3", "--every", "99"];
        rows(&[&[name], &fixed[..], arguments].concat()).pop().unwrap()["emmi"].clone()
    };
    assert_eq!(last(&["--mount", "0,0,0"]), last(&[]));
    assert_ne!(last(&["--mount", "0.2,0.1,0.5"]), last(&[]));
    assert_ne!(last(&["--sensor", "gaussian", "--sigma", "0.1"]), last(&[]));
}

#[test]
fn the_plot_has_its_curves_units_and_marks() {
    let folder = Folder::new();
    let name = folder.write("log.gfs", log());
    let plot = folder.path("plot.svg");
    let fixed =
        ["emmi", "--filter", name.to_str().unwrap(), "--resolution", "0.3", "--plot", plot.to_str().unwrap()];
    let table = stdout(&fixed);
    assert!(table.contains("6 scans, 3 particles, 2 resamplings; weights by a gain of 2"), "{table}");
    assert!(table.contains("cells of 0.3 m; sensor stepped: free 0.4, occupied 0.7"), "{table}");
    let svg = std::fs::read_to_string(plot).unwrap();
    let svg = roxmltree::Document::parse(&svg).unwrap();
    let texts: Vec<_> = svg.descendants().filter_map(|node| node.text()).map(str::trim).collect();
    for words in [
        "log.gfs: 3 particles",
        "mean information (bits / cell)",
        "EMMI",
        "mean of the particles' own",
        "entropy (kbit)",
        "entropy of the expected map",
        "effective particles",
        "particles left by a resampling",
        "time since the first scan (s)",
        "1 left",
        "2 left",
    ] {
        assert!(texts.contains(&words), "{words}: {texts:?}");
    }
}

#[test]
fn what_is_wrong_is_said_in_a_line() {
    let folder = Folder::new();
    let write = |text: String| folder.write("log.gfs", text).to_str().unwrap().to_owned();
    let refused =
        |text: String, more: &[&str]| refusal(&[&["emmi", "--filter", &write(text)], more].concat());
    let cases = [
        (
            log().replace("RESAMPLE 3 1 1 1", "RESAMPLE 3 1 3 1"),
            "a resampled particle in line 12 is 3, allowed is a particle, from 0 to 2",
        ),
        (log().replace("RESAMPLE 3 1 1 1", "RESAMPLE 2 1 1"), "the number of particles in line 12 is 2"),
        ("RESAMPLE 1 0\n".to_owned() + &log(), "line 1 comes before the SM_UPDATE of its scan"),
        ("PARAM ogain 2\n".to_owned(), "holds no scan with its particles"),
        (
            log().replace("SM_UPDATE 3 0 0 0 -3", "SM_UPDATE 3 0 0 0 inf"),
            "the logarithm of a weight in line 4 is inf",
        ),
    ];
    for (text, words) in cases {
        let line = refused(text, &[]);
        assert!(line.contains(words) && line.contains("log.gfs"), "{line}");
    }
    let far = log().replace("SM_UPDATE 3 0 0 0 -3", "SM_UPDATE 3 0 9000 0 -3");
    let line = refused(far, &["--max-cells", "100000"]);
    assert!(line.contains("at 10.5 s, 0 9000, is 9000 m from the middle of the others"), "{line}");
    for (more, words) in [
        (&["--every", "0"][..], "every"),
        (&["--plot", "a.pdf"], "a picture's name ends in .svg or .png"),
        (&["--sigma", "0.1"], "--sigma needs --sensor gaussian"),
        (&["--particles", "a.npy", "--weights", "b.npy"], "cannot be used with"),
        (&["--mount", "1,2"], "not three numbers"),
        (&["--encoding", "mrpt"], "--encoding and --unknown need --particles"),
    ] {
        let line = refused(log(), more);
        assert!(line.contains(words), "{line}");
    }
    let line = refusal(&["emmi", "--particles", "a.npy", "--weights", "b.npy", "--free", "0.3"]);
    assert!(line.contains("need --filter"), "{line}");
    assert!(refusal(&["emmi"]).contains("--particles"));
}
