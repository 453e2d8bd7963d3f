//! The arguments that say what a beam means, and where the laser is: those of every command that makes maps of a log.

use crate::failure::Failure;
use crate::metres::positive;
use crate::trajectory::{SensorModel, Setup};
use clap::{Args, ValueEnum};
use mean_information::scan::{Pose, ScanMap};
use mean_information_files::scans::NoReturn;

/// What a beam means.
#[derive(Args, Debug)]
#[command(next_help_heading = "Sensor")]
pub(super) struct Sensor {
    /// The inverse sensor model of a beam.
    #[arg(long = "sensor", value_enum, default_value_t)]
    model: SensorName,
    /// Stepped: the occupancy of free space, from 0 to 1/2; 0.4 if absent.
    #[arg(long, value_name = "P")]
    free: Option<f64>,
    /// Stepped: the occupancy of an obstacle, from 1/2 to 1; 0.7 if absent.
    #[arg(long, value_name = "P")]
    occupied: Option<f64>,
    /// Stepped: the thickness of an obstacle; one cell if absent.
    #[arg(long, value_name = "METRES", value_parser = positive::<f64>)]
    thickness: Option<f64>,
    /// Gaussian: the standard deviation of a range.
    #[arg(long, value_name = "METRES", value_parser = positive::<f64>)]
    sigma: Option<f64>,
    /// The greatest log-odds of one reading of a cell, in nats.
    #[arg(long, value_name = "NATS", default_value_t = ScanMap::<f64>::READING_LIMIT)]
    reading_limit: f64,
    /// The range from which on a beam did not return; if absent, that of the log, or 50.
    #[arg(long, value_name = "METRES", value_parser = positive::<f64>)]
    pub(super) max_range: Option<f64>,
    /// What a beam that did not return means: nothing, or free space up to the greatest range.
    #[arg(long, value_enum, default_value_t)]
    no_return: NoReturn,
}

/// The inverse sensor models by their names.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum SensorName {
    /// Steps: free up to an obstacle, occupied over its thickness.
    #[default]
    Stepped,
    /// Eq. 5 of the paper; it saturates, so that trajectories are told apart less well.
    Gaussian,
}

impl Sensor {
    /// Returns how maps are made.
    ///
    /// # Errors
    /// Arguments that do not go together, or are out of range.
    pub(super) fn setup(&self, resolution: f64, max_cells: u64) -> Result<Setup, Failure> {
        let Self { model, free, occupied, thickness, sigma, reading_limit, no_return, .. } = *self;
        let usage = |message: &str| Err(Failure::Usage(message.to_owned()));
        let sensor = match (model, sigma) {
            (SensorName::Stepped, None) => SensorModel::Stepped {
                free: free.unwrap_or(0.4),
                occupied: occupied.unwrap_or(0.7),
                thickness: thickness.unwrap_or(resolution),
            },
            (SensorName::Stepped, Some(_)) => {
                return usage("--sigma needs --sensor gaussian; give both or neither");
            }
            (SensorName::Gaussian, Some(sigma)) if free.or(occupied).or(thickness).is_none() => {
                SensorModel::Gaussian { sigma }
            }
            (SensorName::Gaussian, Some(_)) => {
                return usage("--free, --occupied and --thickness need --sensor stepped; leave them out");
            }
            (SensorName::Gaussian, None) => return usage("--sensor gaussian needs --sigma METRES; give it"),
        };
        let setup = Setup { resolution, sensor, reading_limit, no_return, max_cells };
        setup.map()?;
        Ok(setup)
    }

    /// Tells whether any of the arguments was given, with another value than that of its absence.
    pub(super) fn is_given(&self) -> bool {
        let Self { model, free, occupied, thickness, sigma, reading_limit, max_range, no_return } = *self;
        let numbers = [free, occupied, thickness, sigma, max_range];
        model != SensorName::default()
            || numbers.iter().any(Option::is_some)
            || reading_limit != ScanMap::<f64>::READING_LIMIT
            || no_return != NoReturn::default()
    }
}

/// Reads a pose, `x,y,yaw`, in metres and radians.
pub(super) fn mount(text: &str) -> Result<Pose, String> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x, y, yaw]) => Pose::new(x, y, yaw).map_err(|error| error.to_string()),
        _ => Err("not three numbers, x,y,yaw, in metres and radians".to_owned()),
    }
}
