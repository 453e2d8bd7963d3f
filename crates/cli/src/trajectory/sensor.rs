//! The inverse sensor model of the beams of a log, chosen as the command runs.

use mean_information::Error;
use mean_information::sensor::{GaussianSensor, InverseSensorModel, SteppedSensor};
use std::fmt;

/// An inverse sensor model with its parameters, for beams of any range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SensorModel {
    /// Steps: free up to the obstacle, occupied over its thickness ([`SteppedSensor`]).
    Stepped {
        /// The occupancy of free space.
        free: f64,
        /// The occupancy of the obstacle.
        occupied: f64,
        /// The thickness of the obstacle, in metres.
        thickness: f64,
    },
    /// Eq. 5 of the paper ([`GaussianSensor`]).
    Gaussian {
        /// The standard deviation, in metres.
        sigma: f64,
    },
}

impl SensorModel {
    /// Returns the model of a beam of this range, in metres.
    ///
    /// # Errors
    /// Those of [`SteppedSensor::new`] or [`GaussianSensor::new`].
    pub fn of_range(&self, range: f64) -> Result<BeamModel, Error> {
        match *self {
            Self::Stepped { free, occupied, thickness } => {
                SteppedSensor::new(range, thickness, free, occupied).map(BeamModel::Stepped)
            }
            Self::Gaussian { sigma } => GaussianSensor::new(range, sigma).map(BeamModel::Gaussian),
        }
    }
}

impl fmt::Display for SensorModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stepped { free, occupied, thickness } => {
                write!(f, "stepped: free {free}, occupied {occupied}, walls {thickness} m thick")
            }
            Self::Gaussian { sigma } => write!(f, "gaussian: sigma {sigma} m"),
        }
    }
}

/// The inverse sensor model of one beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BeamModel {
    /// Steps.
    Stepped(SteppedSensor<f64>),
    /// Eq. 5 of the paper.
    Gaussian(GaussianSensor<f64>),
}

impl InverseSensorModel for BeamModel {
    type Float = f64;

    fn occupancy(&self, rho: f64) -> f64 {
        match self {
            Self::Stepped(model) => model.occupancy(rho),
            Self::Gaussian(model) => model.occupancy(rho),
        }
    }

    fn reach(&self) -> f64 {
        match self {
            Self::Stepped(model) => model.reach(),
            Self::Gaussian(model) => model.reach(),
        }
    }

    fn plateau(&self) -> f64 {
        match self {
            Self::Stepped(model) => model.plateau(),
            Self::Gaussian(model) => model.plateau(),
        }
    }
}
