//! The circular room with its two limits, and one cell.

use mean_information::cell;
use mean_information::limit::{Weight, closed_form};
use mean_information::map::Grid;
use mean_information::map::encoding::Probability;
use mean_information::room::{CartesianRoom, PolarRoom};
use mean_information::sensor::{GaussianSensor, InverseSensorModel};
use mean_information::{Error, Real};
use mean_information_report::{Number, Record, Value, hex_float};
use std::str::FromStr;

/// The most cells of a grid that is drawn.
const MAX_CELLS: usize = 1 << 24;
/// The name of the range in the library's refusals.
const RANGE: &str = "range";
/// The points of the curve of the sensor.
const POINTS: u32 = 240;

/// A room as it is drawn: its record, and its grid.
pub(crate) struct Room {
    pub(crate) record: Record,
    pub(crate) grid: Grid<Probability<f64>>,
}

/// Why there is no such room.
#[derive(Debug)]
pub(crate) struct NoRoom {
    /// The text that is to be changed: `range`, `sigma` or `side`.
    pub(crate) field: &'static str,
    pub(crate) message: String,
}

impl Room {
    /// Computes the room that these texts say, all in metres.
    ///
    /// # Errors
    /// What is no length, and grids of too many cells, in words.
    pub(crate) fn new(range: &str, sigma: &str, resolution: &str) -> Result<Self, NoRoom> {
        let length = |field, name: &str, text| {
            number::<f64>(text).map_err(|why| NoRoom { field, message: format!("{name}: {why}") })
        };
        let range = length("range", "range", range)?;
        let sigma = length("sigma", "sigma", sigma)?;
        let resolution = length("side", "cell size", resolution)?;
        let sensor = GaussianSensor::new(range, sigma).map_err(|error| {
            let is_range = matches!(error, Error::OutOfRange { what: RANGE, .. });
            NoRoom { field: if is_range { "range" } else { "sigma" }, message: error.to_string() }
        })?;
        // Of too many cells, too, the size is the cause.
        let refused = |error: Error| NoRoom { field: "side", message: error.to_string() };
        let cartesian = CartesianRoom::new(sensor, resolution, [0.5, 0.5]).map_err(refused)?;
        let grid = cartesian.map(MAX_CELLS).map_err(refused)?;
        let polar = PolarRoom::new(sensor, resolution).and_then(|room| room.tally()).map_err(refused)?;
        let squares = grid.tally();
        let computed = |x: f64| Value::Computed(Some(Number::new(x)));
        let reach = sensor.reach();
        let distances: Vec<f64> =
            (0..=POINTS).map(|k| reach * 1.1 * f64::from(k) / f64::from(POINTS)).collect();
        let along = |of: &dyn Fn(f64) -> f64| {
            Value::Numbers(distances.iter().map(|&rho| Some(Number::new(of(rho)))).collect())
        };
        let record = Record(vec![
            ("range_m", Value::Given(Some(range))),
            ("sigma_m", Value::Given(Some(sigma))),
            ("reach_m", computed(reach)),
            ("limit_polar", computed(closed_form(&sensor, Weight::Radial))),
            ("limit_cartesian", computed(closed_form(&sensor, Weight::Area))),
            ("polar", computed(polar.mean_information())),
            ("polar_observed", Value::Count(polar.observed())),
            ("cartesian", computed(squares.mean_information())),
            ("cartesian_observed", Value::Count(squares.observed())),
            ("width", Value::Count(grid.width() as u64)),
            ("height", Value::Count(grid.height() as u64)),
            ("distances_m", along(&|rho| rho)),
            ("occupancy", along(&|rho| sensor.occupancy(rho))),
            ("information", along(&|rho| cell::information(sensor.occupancy(rho)))),
        ]);
        Ok(Self { record, grid })
    }
}

/// Returns the record of a cell of occupancy `p`.
pub(crate) fn of_occupancy<T: Real>(p: T) -> Record {
    let computed = |x: T| Value::Computed(Some(Number::new(x)));
    Record(vec![
        ("p", computed(p)),
        ("entropy", computed(cell::entropy(p))),
        ("information", computed(cell::information(p))),
    ])
}

/// Returns what a text says of one cell: in both formats, with the bits of each float.
///
/// # Errors
/// What is no number, or lies outside `[0, 1]`, in words.
pub(crate) fn one_cell(text: &str) -> Result<Record, String> {
    let double: f64 = number(text)?;
    if !(0.0..=1.0).contains(&double) {
        return Err(format!("p is {double:?}, allowed are 0 to 1"));
    }
    // A decimal is rounded once to each format; a hexadecimal float that only doubles hold, from there.
    let single: f32 = number(text).unwrap_or_else(|_| f32::nearest(double));
    let with_bits = |record: Record, bits: String| {
        let Record(mut entries) = record;
        entries.push(("bits", Value::Text(bits)));
        Record(entries)
    };
    let of_single = with_bits(of_occupancy(single), format!("{:032b}", single.to_bits()));
    let of_double = with_bits(of_occupancy(double), format!("{:064b}", double.to_bits()));
    Ok(Record(vec![("f32", Value::Record(of_single)), ("f64", Value::Record(of_double))]))
}

/// Reads a number, decimal or as a hexadecimal float.
pub(crate) fn number<T: Real + FromStr>(text: &str) -> Result<T, String> {
    let text = text.trim();
    if text.to_ascii_lowercase().contains("0x") {
        return hex_float::parse(text).map_err(|error| error.to_string());
    }
    if text.is_empty() {
        return Err("no number is given".to_owned());
    }
    text.parse().map_err(|_| {
        let point = text.replace(',', ".");
        let hint = point.parse::<f64>().map(|_| format!("; its mark is the point: {point}"));
        format!("{text:?} is not a number{}", hint.unwrap_or_default())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_room_of_the_documentation() {
        let room = Room::new("2", "0x1.999999999999ap-3", "0.01").unwrap();
        let Record(entries) = &room.record;
        let value = |name| entries.iter().find(|(key, _)| *key == name).map(|(_, value)| value.clone());
        assert_eq!(value("cartesian"), Some(Value::Computed(Some(Number::Double(0.6524332571256078)))));
        assert_eq!(value("polar"), Some(Value::Computed(Some(Number::Double(0.7877440140577476)))));
        assert_eq!((room.grid.width(), room.grid.height()), (448, 448));
        for ([range, sigma, side], field) in [
            (["0", "0.2", "0.01"], "range"),
            (["", "1", "1"], "range"),
            (["2", "x", "0.01"], "sigma"),
            (["2", "-1", "0.01"], "sigma"),
            (["2", "0.2", "0"], "side"),
            (["100", "0.2", "0.04"], "side"),
            (["2", "0.2", "1e-9"], "side"),
        ] {
            let refused = Room::new(range, sigma, side).err().map(|why| why.field);
            assert_eq!(refused, Some(field), "{range} {sigma} {side}");
        }
    }

    #[test]
    fn a_cell_in_both_formats() {
        let Record(entries) = one_cell("0.1").unwrap();
        assert_eq!(entries.iter().map(|(key, _)| *key).collect::<Vec<_>>(), ["f32", "f64"]);
        let Value::Record(Record(double)) = &entries[1].1 else { panic!("no record") };
        assert_eq!(double[0].1, Value::Computed(Some(Number::Double(0.1))));
        assert_eq!(double[3].1, Value::Text(format!("{:064b}", 0.1_f64.to_bits())));
        for text in ["", "nan", "1.5", "-0.1", "0x1p+1", "one"] {
            assert!(one_cell(text).is_err(), "{text}");
        }
        assert_eq!(one_cell("0,3").unwrap_err(), "\"0,3\" is not a number; its mark is the point: 0.3");
    }
}
