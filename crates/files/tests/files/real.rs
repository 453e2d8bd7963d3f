//! Real maps and their independently computed numbers, where the folder with them is present.

use crate::support::{measure, percents, read_twice, warnings};
use approx::{abs_diff_eq, assert_abs_diff_eq};
use mean_information::cell::{self, Cell, State};
use mean_information::map::Encoding;
use mean_information::map::encoding::MrptLogOdds;
use mean_information_files::{ArrayEncoding, Mode, Options, Semantics, Warning};
use mean_information_test_support::formats::shared_data as data;
use serde_json::Value;
use std::fs;

/// Mean information of the UWB map, and its observed cells.
const UWB: (f64, u64) = (0.778_862_803_578_935, 100_684);
const UWB_TOLERANCE: f64 = 1e-15;

/// The information of a cell of `percent`, straight from Eqs. 1 and 3.
fn information(percent: usize) -> f64 {
    let term = |p: f64| if p == 0.0 { 0.0 } else { p * libm::log2(p) };
    let p = percent as f64 / 100.0;
    1.0 + term(p) + term(1.0 - p)
}

#[test]
fn ros_maps_give_the_counts_and_the_mean_information_of_both_loaders() {
    let Some(data) = data() else { return };
    let expected: Value =
        serde_json::from_str(&fs::read_to_string(data.join("ros_expected.json")).unwrap()).unwrap();
    let mut compared = 0;
    for (name, map) in expected.as_object().unwrap() {
        for (key, semantics, mode) in [
            ("ros1", Semantics::Ros1, None),
            ("ros1_scale", Semantics::Ros1, Some(Mode::Scale)),
            ("ros1_raw", Semantics::Ros1, Some(Mode::Raw)),
            ("nav2", Semantics::Nav2, None),
            ("nav2_scale", Semantics::Nav2, Some(Mode::Scale)),
            ("nav2_raw", Semantics::Nav2, Some(Mode::Raw)),
        ] {
            let read =
                read_twice(&data.join(name), &Options { semantics, mode, ..Options::default() }).unwrap();
            let numbers = &map[key];
            let count = |key: &str| numbers[key].as_u64().unwrap();
            let measured = measure(&read);
            let what = format!("{name} {key}");
            assert_eq!([measured.width, measured.height].map(|n| n as u64), size(map), "{what}");

            let mut counts = [0_u64; 101];
            percents(&read).iter().filter(|&&p| p >= 0).for_each(|&p| counts[p as usize] += 1);
            assert_eq!(
                (counts[0], counts[100], counts[50]),
                (count("free"), count("occ"), count("at50")),
                "{what}"
            );
            // What ROS 1 lets through outside -1..100 is read as unknown, with a warning.
            let unknown = percents(&read).iter().filter(|&&p| p == -1).count() as u64;
            assert_eq!(unknown, count("unk") + count("out_of_range"), "{what}");
            if count("out_of_range") > 0 {
                let warning = Warning::OutOfRangeReadAsUnknown { count: count("out_of_range") };
                assert!(read.warnings.contains(&warning), "{what} {:?}", read.warnings);
            }
            assert_eq!(measured.free + measured.occupied, count("N_obs"), "{what}");
            let stated = numbers["MI"].as_f64().unwrap();
            assert!(
                abs_diff_eq!(measured.mean_information, stated, epsilon = 1e-12),
                "{what} {}",
                measured.mean_information
            );
            let sum: f64 =
                counts.iter().enumerate().map(|(percent, &n)| n as f64 * information(percent)).sum();
            assert!(
                abs_diff_eq!(measured.mean_information, sum / count("N_obs") as f64, epsilon = 1e-12),
                "{what}"
            );
            compared += 1;
        }
    }
    assert_eq!(compared, 48);
}

fn size(map: &Value) -> [u64; 2] {
    [0, 1].map(|k| map["size"][k].as_u64().unwrap())
}

#[test]
fn grey_205_read_as_free_is_said_with_its_count() {
    let Some(data) = data() else { return };
    for semantics in [Semantics::Nav2, Semantics::Ros1] {
        let options = Options { semantics, ..Options::default() };
        let depot = read_twice(&data.join("nav2/depot.yaml"), &options).unwrap();
        assert_eq!(depot.warnings.len(), 1);
        assert!(warnings(&depot)[0].starts_with("8894 cells of grey 205"), "{:?}", depot.warnings);
        let sandbox = read_twice(&data.join("nav2/tb3_sandbox.yaml"), &options).unwrap();
        assert_eq!(sandbox.warnings, []);
    }
}

#[test]
fn a_yaml_whose_image_is_absent_is_refused_by_the_image_s_name() {
    let Some(data) = data() else { return };
    let refused =
        read_twice(&data.join("nav2/invalid_image.yaml"), &Options::default()).unwrap_err().to_string();
    assert!(
        refused.contains("invalid_image.yaml: image is \"invalid.png\", and there is no file "),
        "{refused}"
    );
}

#[test]
fn the_uwb_grid_map() {
    let Some(data) = data() else { return };
    let map =
        read_twice(&data.join("mrpt/uwb_ro-localization_demo_map.gridmap.gz"), &Options::default()).unwrap();
    let measured = measure(&map);
    assert_eq!((measured.width, measured.height), (700, 650));
    assert_eq!(map.resolution, Some(f64::from(0.04_f32)));
    assert_eq!(measured.free + measured.occupied, UWB.1);
    assert_abs_diff_eq!(measured.mean_information, UWB.0, epsilon = UWB_TOLERANCE);
    assert_eq!(map.warnings, []);
}

#[test]
fn all_256_cells_of_mrpt() {
    let Some(data) = data() else { return };
    let rows = fs::read_to_string(data.join("mrpt/cells_exact.csv")).unwrap();
    let mut compared = 0;
    for row in rows.lines().skip(1) {
        let fields: Vec<&str> = row.split(',').collect();
        let stored: i8 = fields[0].parse().unwrap();
        // The column is the probability that MRPT means: of free.
        let [free, information] = [1, 2].map(|k| fields[k].parse::<f64>().unwrap());
        let cell: Cell<f64> = MrptLogOdds::cell(stored).unwrap();
        let occupancy = MrptLogOdds::occupancy(stored).unwrap();
        assert!(abs_diff_eq!(occupancy, 1.0 - free, epsilon = 1e-15), "{stored}: {occupancy}");
        assert!(
            abs_diff_eq!(cell.information(), information, epsilon = 1e-15),
            "{stored}: {}",
            cell.information()
        );
        assert_eq!(cell.state() == State::Unknown, stored == 0);
        assert_eq!(cell.state() == State::Free, stored > 0);
        assert!(abs_diff_eq!(cell::information(occupancy), information, epsilon = 1e-14), "{stored}");
        compared += 1;
    }
    assert_eq!(compared, 256);
}

#[test]
fn a_log_odds_array_that_mrpt_averaged() {
    let Some(data) = data() else { return };
    for step in ["step0020", "step0100"] {
        let expected: Value = serde_json::from_str(
            &fs::read_to_string(data.join(format!("emmi/{step}_expected.json"))).unwrap(),
        )
        .unwrap();
        let options = Options { encoding: Some(ArrayEncoding::Mrpt), ..Options::default() };
        let map = read_twice(&data.join(format!("emmi/{step}_mrpt_average.npy")), &options).unwrap();
        let average = &expected["mrpt_logodds_average"];
        let measured = measure(&map);
        assert_eq!(measured.free + measured.occupied, average["N"].as_u64().unwrap());
        let exact: f64 = average["exact_MI"].as_str().unwrap().parse().unwrap();
        assert!(
            abs_diff_eq!(measured.mean_information, exact, epsilon = 1e-13),
            "{step} {}",
            measured.mean_information
        );
        assert_eq!(map.resolution, None);
    }
}
