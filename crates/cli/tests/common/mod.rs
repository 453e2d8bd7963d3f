//! What the tests of the command line share: maps made on the spot, and runs of `meaninfo`.
#![allow(dead_code, reason = "each test file uses a part")]

pub(crate) mod schema;

use assert_cmd::Command;
use assert_cmd::cargo::cargo_bin_cmd;
use mean_information_report::hex_float;
pub(crate) use mean_information_test_support::formats::Folder;
use serde_json::Value;
use std::fs;
use std::path::Path;

/// The binary under test: of this build, or whichever `MEANINFO` names, such as one with optimization.
pub(crate) fn meaninfo() -> Command {
    std::env::var_os("MEANINFO").map_or_else(|| cargo_bin_cmd!("meaninfo"), Command::new)
}

/// What a run that must succeed prints; JSON is as its schema says.
pub(crate) fn stdout(arguments: &[&str]) -> String {
    let output = meaninfo().args(arguments).output().unwrap();
    assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), ""));
    let printed = text(&output.stdout);
    if let Some(name) = schema::schema_of(arguments).filter(|_| !printed.is_empty()) {
        schema::assert_schema(name, printed);
    }
    printed.to_owned()
}

/// What a run that must be refused says: one line on stderr, nothing on stdout, exit status 2.
pub(crate) fn refusal(arguments: &[&str]) -> String {
    let output = meaninfo().args(arguments).output().unwrap();
    let line = text(&output.stderr);
    assert_eq!((output.status.code(), text(&output.stdout)), (Some(2), ""), "{line}");
    assert!(line.starts_with("meaninfo: ") && line.ends_with('\n') && line.lines().count() == 1, "{line:?}");
    line.to_owned()
}

pub(crate) fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

/// Maps written into a folder.
pub(crate) trait Maps {
    /// Writes a ROS map of the grey levels given, the upper row first, in `mode`; returns the path of its yaml.
    fn ros_map(&self, name: &str, width: usize, greys: &[u8], mode: &str) -> String;

    /// Writes an `.npy` map of probabilities, the lowest row first; returns its path.
    fn npy_map(&self, name: &str, width: usize, cells: &[f64]) -> String;
}

impl Maps for Folder {
    fn ros_map(&self, name: &str, width: usize, greys: &[u8], mode: &str) -> String {
        let image = format!("{}.pgm", name.replace(char::is_control, "_"));
        let mut pgm = format!("P5\n{width} {}\n255\n", greys.len() / width).into_bytes();
        pgm.extend(greys);
        fs::write(self.path(&image), pgm).unwrap();
        let thresholds = if mode == "scale" { (0.0, 1.0) } else { (0.196, 0.65) };
        let yaml = format!(
            "image: '{image}'\nmode: {mode}\nresolution: 0.2\norigin: [0.0, 0.0, 0.0]\nnegate: 0\n\
             free_thresh: {:?}\noccupied_thresh: {:?}\n",
            thresholds.0, thresholds.1
        );
        let yaml_name = format!("{name}.yaml");
        fs::write(self.path(&yaml_name), yaml).unwrap();
        self.text_path(&yaml_name)
    }

    fn npy_map(&self, name: &str, width: usize, cells: &[f64]) -> String {
        let shape = format!("({}, {width})", cells.len().checked_div(width).unwrap_or(0));
        let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}}}\n");
        let mut npy = b"\x93NUMPY\x01\x00".to_vec();
        npy.extend((header.len() as u16).to_le_bytes());
        npy.extend(header.into_bytes());
        npy.extend(cells.iter().flat_map(|p| p.to_le_bytes()));
        fs::write(self.path(name), npy).unwrap();
        self.text_path(name)
    }
}

/// A map of 5 x 3 cells, the upper row first, with free, occupied and unknown ones.
pub(crate) const GREYS: [u8; 15] = [254, 200, 127, 10, 64, 127, 127, 230, 90, 0, 255, 180, 140, 127, 33];

/// The occupancies of [`GREYS`] as nav2 reads them in mode scale with thresholds 0 and 1.
pub(crate) fn occupancies(greys: &[u8]) -> Vec<f64> {
    greys.iter().map(|&grey| ((255.0 - f64::from(grey)) / 255.0 * 100.0).round() / 100.0).collect()
}

/// The textbook formula; near 1/2 only good to a few 1e-16.
pub(crate) fn entropy(p: f64) -> f64 {
    let term = |q: f64| if q == 0.0 { 0.0 } else { -q * libm::log2(q) };
    term(p) + term(1.0 - p)
}

pub(crate) fn assert_near(found: &Value, expected: f64) {
    let found = found.as_f64().unwrap();
    approx::assert_relative_eq!(found, expected, epsilon = 1e-12, max_relative = 1e-12);
}

/// Checks that every key with a twin holds the number of the twin, and that there are as many twins as expected.
pub(crate) fn assert_twins(object: &Value, expected: usize) {
    let object = object.as_object().unwrap();
    let twins: Vec<_> = object.keys().filter(|key| key.ends_with("_hex")).collect();
    assert_eq!(twins.len(), expected, "{twins:?}");
    for twin in twins {
        let number = &object[twin.trim_end_matches("_hex")];
        let hex = object[twin].as_str().map(|hex| hex_float::parse::<f64>(hex).unwrap());
        assert_eq!(number.as_f64(), hex, "{twin}");
    }
}

/// The rows that `meaninfo trajectory` prints as JSON.
pub(crate) fn rows(arguments: &[&str]) -> Vec<Value> {
    let text = stdout(&[&["trajectory"], arguments, &["--format", "json"]].concat());
    serde_json::from_str(&text).unwrap()
}

/// The keys of indented JSON whose lines are indented by `depth` spaces, in order.
pub(crate) fn keys(json: &str, depth: usize) -> Vec<&str> {
    let indent = " ".repeat(depth) + "\"";
    json.lines()
        .filter_map(|line| line.strip_prefix(&*indent)?.split_once("\":"))
        .map(|(key, _)| key)
        .collect()
}

/// The bytes of a file.
pub(crate) fn read(path: impl AsRef<Path>) -> Vec<u8> {
    fs::read(path).unwrap()
}

/// The pixels of a PNG picture.
#[derive(PartialEq)]
pub(crate) struct Pixels {
    pub(crate) width: u32,
    pub(crate) height: u32,
    bytes: Vec<u8>,
}

impl Pixels {
    pub(crate) fn of_png(file: &[u8]) -> Self {
        let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut bytes).unwrap();
        assert_eq!((info.color_type, info.bit_depth), (png::ColorType::Rgb, png::BitDepth::Eight));
        Self { width: info.width, height: info.height, bytes }
    }

    pub(crate) fn at(&self, x: u32, y: u32) -> [u8; 3] {
        assert!(x < self.width && y < self.height, "({x}, {y}) lies in the picture");
        let start = 3 * (y * self.width + x) as usize;
        [self.bytes[start], self.bytes[start + 1], self.bytes[start + 2]]
    }
}
