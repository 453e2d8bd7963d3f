//! `meaninfo emmi`: real particle sets against their expected values, MRPT's own average explained, and bad input.

mod refused;

use crate::common::schema::{assert_order, required};
use crate::common::*;
use approx::{abs_diff_eq, assert_abs_diff_eq};
use mean_information::expected::Hypotheses;
use mean_information::map::encoding::MrptLogOdds;
use mean_information::map::{Encoding, Grid};
use mean_information_files::npy::MapsVisitor;
use mean_information_files::{
    ArrayEncoding, Cells, Options, Readable, read_map, read_particles, read_weights,
};
use mean_information_test_support::formats::shared_data;
use serde_json::Value;
use std::fs;
use std::path::PathBuf;

fn data() -> Option<PathBuf> {
    shared_data().map(|folder| folder.join("emmi"))
}

/// An array file of version 1.
fn npy(descr: &str, fortran_order: bool, shape: &[usize], bytes: &[u8]) -> Vec<u8> {
    let shape = shape.iter().map(usize::to_string).collect::<Vec<_>>().join(", ") + ",";
    let order = if fortran_order { "True" } else { "False" };
    let header = format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': ({shape})}}\n");
    let mut npy = b"\x93NUMPY\x01\x00".to_vec();
    npy.extend((header.len() as u16).to_le_bytes());
    npy.extend(header.into_bytes());
    npy.extend(bytes);
    npy
}

fn doubles(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|x| x.to_le_bytes()).collect()
}

/// Three particles of 2 x 4 cells: seven that each know something of, one that none knows.
const PARTICLES: [[f64; 8]; 3] = [
    [0.1, 0.2, 0.5, 0.9, 0.5, 0.25, 0.75, 0.0],
    [0.2, 0.1, 0.75, 0.8, 0.5, 0.75, 0.75, 0.5],
    [0.3, 0.2, 0.5, 0.3, 0.5, 0.5, 0.75, 1.0],
];
const WEIGHTS: [f64; 3] = [0.5, 0.75, 0.5];

/// Writes them; the arguments of the command.
fn small(folder: &Folder, weights: &[f64]) -> Vec<String> {
    fs::write(folder.path("p.npy"), npy("<f8", false, &[3, 2, 4], &doubles(&PARTICLES.concat()))).unwrap();
    fs::write(folder.path("w.npy"), npy("<f8", false, &[weights.len()], &doubles(weights))).unwrap();
    let [p, w] = ["p.npy", "w.npy"].map(|name| folder.text_path(name));
    ["emmi", "--particles", &p, "--weights", &w].map(str::to_owned).to_vec()
}

fn with<'a>(arguments: &'a [String], more: &[&'a str]) -> Vec<&'a str> {
    arguments.iter().map(String::as_str).chain(more.iter().copied()).collect()
}

fn json(arguments: &[&str]) -> Value {
    serde_json::from_str(&stdout(arguments)).unwrap()
}

#[test]
fn real_particles_have_the_expected_values_to_the_last_bit() {
    let Some(data) = data() else { return };
    for step in ["step0020", "step0100"] {
        let expected: Value =
            serde_json::from_str(&fs::read_to_string(data.join(format!("{step}_expected.json"))).unwrap())
                .unwrap();
        let [p, w] = ["particles", "weights"]
            .map(|what| data.join(format!("{step}_{what}.npy")).display().to_string());
        let found = json(&[
            "emmi",
            "--particles",
            &p,
            "--weights",
            &w,
            "--encoding",
            "mrpt",
            "--resolution",
            "0.25",
            "--format",
            "json",
        ]);
        // The nearest f64 to 40 digits.
        let digits = |key: &str| expected[key].as_str().unwrap().parse::<f64>().unwrap();
        assert_eq!(found["emmi"].as_f64().unwrap(), digits("EMMI"), "{step}");
        assert_eq!(found["information_bits"].as_f64().unwrap(), digits("sum_I_bits"), "{step}");
        assert_eq!(found["observed"], expected["N_obs"]);
        let cells: f64 =
            expected["shape"].as_array().unwrap()[1..].iter().map(|n| n.as_f64().unwrap()).product();
        let unknown = cells - expected["N_obs"].as_f64().unwrap();
        // Two roundings to 16 digits of 3e4 bits.
        assert_abs_diff_eq!(
            found["entropy_bits"].as_f64().unwrap() - unknown,
            digits("sum_H_bits_observed"),
            epsilon = 2e-11
        );
        let own = found["particles"].as_array().unwrap();
        let expected_own = expected["per_particle_MI"].as_array().unwrap();
        assert_eq!(own.len(), expected_own.len());
        let mut furthest = 0.0_f64;
        for (own, expected) in own.iter().zip(expected_own) {
            let expected: f64 = expected.as_str().unwrap().parse().unwrap();
            // Each cell is rounded by at most 2^-54, and the mean by 2^-54.
            assert_abs_diff_eq!(own.as_f64().unwrap(), expected, epsilon = f64::EPSILON / 2.0);
            furthest = furthest.max(expected);
        }
        // A mean is not above what it is a mean of.
        assert!(found["mean_of_particles"].as_f64().unwrap() <= furthest + 1e-15);
        assert_eq!(found["observed_area_m2"].as_f64().unwrap(), expected["N_obs"].as_f64().unwrap() * 0.0625);
    }
}

/// A stack of MRPT bytes, with the stored bytes and the log-linear pool, in units of MRPT's bytes.
struct Pooled(Vec<f64>);

impl MapsVisitor for Pooled {
    type Output = (Vec<Vec<f64>>, Vec<f64>);

    fn visit<E: Readable>(self, maps: Vec<Grid<E>>) -> Self::Output {
        let pool = Hypotheses::new(&maps, &self.0).unwrap().log_linear_pool().unwrap();
        let in_bytes = |l: f64| -16.0 * l;
        let stored = |map: &Grid<E>| map.cells().iter().map(|&x| E::value(x).max(-127.0)).collect();
        let pool = pool.cells().iter().map(|&l| in_bytes(mean_information::Real::widen(l)));
        (maps.iter().map(stored).collect(), pool.collect())
    }
}

/// What MRPT calls the expected map is the log-linear pool: cell for cell, once its `f32` sum and its truncation are
/// done, and without them where these can make no difference.
#[test]
fn mrpt_s_average_is_the_log_linear_pool_cut_to_a_byte() {
    let Some(data) = data() else { return };
    for (step, observed) in [("step0020", 5735), ("step0100", 26_902)] {
        let options = Options { encoding: Some(ArrayEncoding::Mrpt), ..Options::default() };
        let weights = read_weights(&data.join(format!("{step}_weights.npy")), &options).unwrap();
        let stack = data.join(format!("{step}_particles.npy"));
        let (particles, pool) = read_particles(&stack, &options, Pooled(weights.clone())).unwrap();
        let average = read_map(&data.join(format!("{step}_mrpt_average.npy")), &options).unwrap();
        let Cells::Mrpt(average) = average.cells else { panic!("MRPT bytes") };
        assert_eq!(average.cells().iter().filter(|&&byte| byte != 0).count(), observed);
        let mut near_an_integer = 0;
        for (k, (&byte, &exact)) in average.cells().iter().zip(&pool).enumerate() {
            let sum = particles
                .iter()
                .zip(&weights)
                .fold(0.0_f32, |sum, (particle, &weight)| sum + weight as f32 * particle[k] as f32);
            assert_eq!(f64::from(byte), f64::from(sum.trunc()), "{step} cell {k}");
            // The sum of 20 terms below 127, in f32: weights, products and sums are off by at most 2^-24 of 127 each.
            let error = 41.0 * 127.0 * f64::from(f32::EPSILON) / 2.0;
            assert!(abs_diff_eq!(f64::from(sum), exact, epsilon = error), "{step} cell {k}");
            if (exact - exact.round()).abs() > error {
                assert_eq!(f64::from(byte), exact.trunc(), "{step} cell {k}");
            } else if exact.trunc() != f64::from(byte) {
                near_an_integer += 1;
            }
        }
        // Where all particles agree the sum falls short of their value by an ulp, and the truncation takes a whole
        // step.
        assert!(near_an_integer > 0, "{step}");
        let exactly = MrptLogOdds::tally(average.cells()).mean_information();
        println!("{step}: MRPT's average has mean information {exactly}");
    }
}

#[test]
fn the_command_agrees_with_the_formula() {
    let folder = Folder::new();
    let arguments = small(&folder, &WEIGHTS);
    let text = stdout(&with(&arguments, &["--resolution", "0.5", "--format", "json"]));
    assert_order(&text, 2, "emmi", "");
    let found: Value = serde_json::from_str(&text).unwrap();
    let total: f64 = WEIGHTS.iter().sum();
    let mean = |k: usize| PARTICLES.iter().zip(WEIGHTS).map(|(p, w)| w * p[k]).sum::<f64>() / total;
    let expected: Vec<f64> = (0..8).map(mean).collect();
    // Two cells: unknown to all, and a half between 0 and 1 of equal weights and an unknown one.
    let known: Vec<f64> = expected.iter().copied().filter(|p| (p - 0.5).abs() > 1e-12).collect();
    assert_eq!(known.len(), 6);
    let information: f64 = known.iter().map(|&p| 1.0 - entropy(p)).sum();
    assert_near(&found["emmi"], information / 6.0);
    assert_near(&found["information_bits"], information);
    assert_near(&found["entropy_bits"], 8.0 - information);
    assert_eq!((&found["observed"], &found["meaningful"]), (&Value::from(6), &Value::from(true)));
    assert_near(&found["observed_area_m2"], 1.5);
    let own = PARTICLES.map(|cells| {
        let known: Vec<f64> = cells.into_iter().filter(|&p| p != 0.5).collect();
        known.iter().map(|&p| 1.0 - entropy(p)).sum::<f64>() / known.len() as f64
    });
    for (found, own) in found["particles"].as_array().unwrap().iter().zip(own) {
        assert_near(found, own);
    }
    assert_near(
        &found["mean_of_particles"],
        own.iter().zip(WEIGHTS).map(|(x, w)| x * w).sum::<f64>() / total,
    );
    assert_eq!(
        found["particles"].as_array().unwrap().len(),
        found["particles_hex"].as_array().unwrap().len()
    );
}

#[test]
fn the_readme_shows_what_is_printed() {
    let folder = Folder::new();
    let particles = doubles(&[0.1, 0.9, 0.5, 0.1, 0.1, 0.9]);
    fs::write(folder.path("particles.npy"), npy("<f8", false, &[2, 1, 3], &particles)).unwrap();
    fs::write(folder.path("weights.npy"), npy("<f8", false, &[2], &doubles(&[0.75, 0.25]))).unwrap();
    let arguments = ["emmi", "--particles", "particles.npy", "--weights", "weights.npy"];
    let output = meaninfo().current_dir(folder.path("")).args(arguments).output().unwrap();
    let shown = format!("`meaninfo {}` averages", arguments.join(" "));
    let printed = format!("```text\n{}```\n", text(&output.stdout));
    let readme = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../README.md")).unwrap();
    assert!(readme.contains(&shown) && readme.contains(&printed), "README.md lacks\n{printed}");
}

#[test]
fn csv_and_table_say_the_same_as_json() {
    let folder = Folder::new();
    let arguments = small(&folder, &WEIGHTS);
    let found = json(&with(&arguments, &["--format", "json"]));
    let csv_text = stdout(&with(&arguments, &["--format", "csv"]));
    let mut csv = csv::Reader::from_reader(csv_text.as_bytes());
    assert_eq!(csv.headers().unwrap().iter().collect::<Vec<_>>(), required("emmi", ""));
    let row = csv.records().next().unwrap().unwrap();
    assert_eq!(row[0].parse::<f64>().ok(), found["emmi"].as_f64());
    assert_eq!(row[9].split("; ").count(), 3);
    assert_eq!(&row[11], "", "no resolution, no area");
    let table = stdout(&with(&arguments, &[]));
    for value in [&found["emmi"], &found["mean_of_particles"], &found["particles"][2]] {
        assert!(table.contains(&value.to_string()), "{value} in {table}");
    }
}

/// Order and scale of the weights, the order of memory, and precision where floats hold the same values.
#[test]
fn the_same_particles_in_other_words() {
    let folder = Folder::new();
    let first = json(&with(&small(&folder, &WEIGHTS), &["--format", "json"]));
    let again = |particles: Vec<u8>, weights: &[f64]| {
        fs::write(folder.path("p.npy"), particles).unwrap();
        fs::write(folder.path("w.npy"), npy("<f8", false, &[3], &doubles(weights))).unwrap();
        let [p, w] = ["p.npy", "w.npy"].map(|name| folder.text_path(name));
        json(&["emmi", "--particles", &p, "--weights", &w, "--format", "json"])
    };
    let reversed: Vec<f64> = PARTICLES.iter().rev().flatten().copied().collect();
    let found = again(npy("<f8", false, &[3, 2, 4], &doubles(&reversed)), &[4.0, 6.0, 4.0]);
    assert_eq!(
        (&found["emmi_hex"], &found["mean_of_particles_hex"]),
        (&first["emmi_hex"], &first["mean_of_particles_hex"])
    );
    let mut columns = Vec::new();
    for column in 0..4 {
        for row in 0..2 {
            columns.extend(PARTICLES.iter().map(|cells| cells[4 * row + column]));
        }
    }
    assert_eq!(again(npy("<f8", true, &[3, 2, 4], &doubles(&columns)), &WEIGHTS), first);
    let narrow: Vec<u8> = PARTICLES.concat().iter().flat_map(|&p| (p as f32).to_le_bytes()).collect();
    let narrow = again(npy("<f4", false, &[3, 2, 4], &narrow), &WEIGHTS);
    assert_abs_diff_eq!(narrow["emmi"].as_f64().unwrap(), first["emmi"].as_f64().unwrap(), epsilon = 1e-6);
    assert_eq!(narrow["observed"], first["observed"]);
}

#[test]
fn nothing_observed_and_nothing_but_certainties() {
    let folder = Folder::new();
    let arguments = small(&folder, &WEIGHTS);
    fs::write(folder.path("p.npy"), npy("|i1", false, &[3, 1, 2], &[255, 50, 255, 50, 255, 50])).unwrap();
    let found = json(&with(&arguments, &["--format", "json"]));
    assert_eq!(
        (&found["emmi"], &found["particles"][0], &found["observed"]),
        (&Value::Null, &Value::Null, &Value::from(0))
    );
    assert_eq!((&found["meaningful"], &found["mean_of_particles"]), (&Value::from(false), &Value::Null));
    let reason = "nothing observed: every cell is unknown, so there is no mean information";
    assert_eq!(found["warnings"], Value::from(vec![reason]));
    let table = stdout(&with(&arguments, &[]));
    assert!(table.contains("not meaningful:") && table.ends_with(&format!("p.npy: {reason}\n")), "{table}");
    assert_eq!((table.matches("none").count(), table.contains(" 0.0 ")), (5, false), "{table}");
    fs::write(folder.path("p.npy"), npy("|i1", false, &[3, 1, 2], &[0, 100, 0, 100, 0, 100])).unwrap();
    let found = json(&with(&arguments, &["--format", "json"]));
    assert_eq!((&found["emmi"], &found["meaningful"]), (&Value::from(1.0), &Value::from(false)));
}

/// It counts as 0 in the mean of those that have something, which is said; without weight it does not count.
#[test]
fn a_particle_in_which_nothing_is_observed() {
    let folder = Folder::new();
    let of = |particles: &[f64], weights: &[f64]| {
        let arguments = small(&folder, weights);
        let shape = [weights.len(), 1, 2];
        fs::write(folder.path("p.npy"), npy("<f8", false, &shape, &doubles(particles))).unwrap();
        let found = json(&with(&arguments, &["--format", "json"]));
        (found["mean_of_particles"].as_f64(), found["warnings"].as_array().unwrap().clone())
    };
    let mean = (1.0 - entropy(0.25)) / 2.0;
    let warning = "1 particle with nothing observed, 0 in the mean of particles";
    let (found, warnings) = of(&[0.25, 0.5, 0.5, 0.5], &[0.75, 0.75]);
    assert_abs_diff_eq!(found.unwrap(), mean, epsilon = 1e-15);
    assert_eq!(warnings, [warning]);
    let (found, warnings) = of(&[0.25, 0.5, 0.5, 0.5, 0.5, 0.5], &[1.5, 0.75, 0.75]);
    assert_abs_diff_eq!(found.unwrap(), mean, epsilon = 1e-15);
    assert_eq!(warnings, [warning.replace("1 particle", "2 particles")]);
    assert_eq!(of(&[0.25, 0.5, 0.5, 0.5], &[0.75, 0.0]).1, [""; 0]);
    let (found, warnings) = of(&[0.25, 0.5, 0.5, 0.5], &[0.0, 0.75]);
    assert_eq!((found, warnings.len()), (None, 1));
    // Their mean is unknown, they are not.
    let (found, warnings) = of(&[0.25, 0.5, 0.75, 0.5], &[0.75, 0.75]);
    assert_abs_diff_eq!(found.unwrap(), 2.0 * mean, epsilon = 1e-15);
    assert!(warnings.len() == 1 && warnings[0].as_str().unwrap().starts_with("nothing observed"));
}

#[test]
fn weights_may_be_integers() {
    let folder = Folder::new();
    let expected = json(&with(&small(&folder, &[3.0, 1.0, 2.0]), &["--format", "json"]));
    let read = |descr: &str, bytes: &[Vec<u8>]| {
        let arguments = small(&folder, &WEIGHTS);
        fs::write(folder.path("w.npy"), npy(descr, false, &[bytes.len()], &bytes.concat())).unwrap();
        json(&with(&arguments, &["--format", "json"]))
    };
    for (descr, bytes, scale) in [
        ("|i1", 1, 41),
        ("<i1", 1, 41),
        ("|u1", 1, 81),
        ("<i2", 2, 10_000),
        ("<u2", 2, 20_000),
        ("<i4", 4, 700_000_000),
        ("<u4", 4, 1_400_000_000),
        ("<i8", 8, 3_000_000_000_000_000),
        ("<u8", 8, 3_000_000_000_000_000),
    ] {
        let weights = [3, 1, 2].map(|weight: u64| (weight * scale).to_le_bytes()[..bytes].to_vec());
        assert_eq!(read(descr, &weights)["emmi"], expected["emmi"], "{descr}");
        let reversed = weights.map(|weight| weight.into_iter().rev().collect::<Vec<u8>>());
        if bytes > 1 {
            assert_eq!(read(&descr.replace('<', ">"), &reversed)["emmi"], expected["emmi"], "{descr}");
        }
    }
}
