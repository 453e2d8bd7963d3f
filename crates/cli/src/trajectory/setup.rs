//! How the map of a trajectory is made of its scans.

use super::sensor::SensorModel;
use crate::output::Value;
use clap::ValueEnum;
use mean_information::Error;
use mean_information::scan::{Pose, Scan, ScanMap};
use mean_information_files::scans::{NoReturn, RangeScan};

/// The way a map is made of scans: the same for all trajectories that are compared.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    /// The side of a cell, in metres.
    pub resolution: f64,
    /// The inverse sensor model.
    pub sensor: SensorModel,
    /// The greatest log-odds of one reading of a cell, in nats.
    pub reading_limit: f64,
    /// The meaning of a beam that did not return.
    pub no_return: NoReturn,
    /// The most cells of a map.
    pub max_cells: u64,
}

/// Why a scan was not inserted, or not removed.
#[derive(Clone, Debug, PartialEq)]
pub struct Refused {
    /// The scan, counted from 0 among those of the map.
    pub scan: usize,
    /// The reason.
    pub error: Error,
}

impl Setup {
    /// Returns the entries of a record: the sensor in words, and its numbers, of which each model has its own.
    pub fn entries(&self) -> [(&'static str, Value); 7] {
        let [free, occupied, thickness, sigma] = match self.sensor {
            SensorModel::Stepped { free, occupied, thickness } => {
                [Some(free), Some(occupied), Some(thickness), None]
            }
            SensorModel::Gaussian { sigma } => [None, None, None, Some(sigma)],
        };
        let no_return = self.no_return.to_possible_value().map(|word| word.get_name().to_owned());
        [
            ("sensor", Value::Text(self.sensor.to_string())),
            ("sensor_free", Value::Given(free)),
            ("sensor_occupied", Value::Given(occupied)),
            ("thickness_m", Value::Given(thickness)),
            ("sigma_m", Value::Given(sigma)),
            ("reading_limit_nats", Value::Given(Some(self.reading_limit))),
            ("no_return", Value::Text(no_return.unwrap_or_default())),
        ]
    }

    /// Creates an empty map that keeps agreement.
    ///
    /// # Errors
    /// An [`Error`] if resolution, limit or sensor are out of range.
    pub fn map(&self) -> Result<ScanMap<f64>, Error> {
        self.sensor.of_range(1.0)?;
        let map = ScanMap::new(self.resolution)?.with_reading_limit(self.reading_limit)?;
        map.with_max_cells(self.max_cells).with_agreement()
    }

    /// Returns the scan of a record from a pose of the laser; `None` if no beam says anything.
    ///
    /// # Errors
    /// Never for a record that was read.
    pub fn scan(&self, record: &RangeScan, pose: Pose) -> Result<Option<Scan<f64>>, Error> {
        record.scan_from(pose, self.no_return)
    }

    /// Inserts a record into a map.
    ///
    /// # Errors
    /// Those of [`ScanMap::insert`].
    pub fn insert(&self, map: &mut ScanMap<f64>, record: &RangeScan, pose: Pose) -> Result<(), Error> {
        let model = |range| self.sensor.of_range(range);
        self.scan(record, pose)?.map_or(Ok(()), |scan| map.insert(&scan, model))
    }

    /// Removes a record from a map.
    ///
    /// # Errors
    /// Those of [`ScanMap::remove`].
    pub fn remove(&self, map: &mut ScanMap<f64>, record: &RangeScan, pose: Pose) -> Result<(), Error> {
        let model = |range| self.sensor.of_range(range);
        self.scan(record, pose)?.map_or(Ok(()), |scan| map.remove(&scan, model))
    }

    /// Makes the map of records, each from its pose of the laser.
    ///
    /// # Errors
    /// The first scan that [`ScanMap::insert`] refuses.
    pub fn built(&self, records: &[&RangeScan], poses: &[Pose]) -> Result<ScanMap<f64>, Refused> {
        let mut map = self.map().map_err(|error| Refused { scan: 0, error })?;
        for (scan, (record, &pose)) in records.iter().zip(poses).enumerate() {
            self.insert(&mut map, record, pose).map_err(|error| Refused { scan, error })?;
        }
        Ok(map)
    }
}
