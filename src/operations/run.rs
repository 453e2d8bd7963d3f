//! The computation of each operation.

use super::answer::{Answer, Refusal, Value};
use super::operation::{Operation, Which};
use crate::cell::{Cell, occupancy_from_log_odds};
use crate::error::{Error, finite, positive};
use crate::expected::Hypotheses;
use crate::fusion::fuse;
use crate::limit::{Weight, closed_form};
use crate::map::encoding::Probability;
use crate::map::{Geometry, Grid};
use crate::real::Real;
use crate::room::{CartesianRoom, PolarRoom};
use crate::sensor::{GaussianSensor, InverseSensorModel};
use crate::tally::Tally;
use alloc::vec::Vec;

/// The largest number of samples of a grid: some seconds.
const MAX_SAMPLES: u64 = 1 << 26;

impl Operation {
    /// Computes the result for these arguments, in the format `T`.
    ///
    /// **Error**: within [`Operation::tolerance_ulp`], and within the bound of the function, which is smaller
    /// ([`guarantees`](crate::book::guarantees)); for a grid, within what `vectors/README.md` allows (measured on the
    /// vectors).
    ///
    /// # Errors
    /// [`Refusal::Domain`] outside the domain; [`Refusal::TooLarge`] for grids of more than `2^26` samples or beyond
    /// the range of the format; [`Refusal::Arguments`] if number or shapes of the arguments are not those of the
    /// operation.
    ///
    /// ```
    /// use mean_information::operations::{Answer, Refusal, Value, find};
    /// let limit = find("limit.radial").expect("in the list");
    /// assert_eq!(limit.run(&[Value::Float(2.0), Value::Float(0.2)]), Ok(Answer::Float(0.7893368880256514)));
    /// assert!(matches!(limit.run(&[Value::Float(2.0), Value::Float(0.0)]), Err(Refusal::Domain(_))));
    /// ```
    pub fn run<T: Real>(&self, arguments: &[Value<T>]) -> Result<Answer<T>, Refusal> {
        use Value::{Float, List, Rows};
        let float = match (self.which, arguments) {
            (Which::CellEntropy, &[Float(p)]) => Cell::from_occupancy(p)?.entropy(),
            (Which::CellInformation, &[Float(p)]) => Cell::from_occupancy(p)?.information(),
            (Which::CellEntropyFromLogOdds, &[Float(l)]) => Cell::from_log_odds(l)?.entropy(),
            (Which::CellInformationFromLogOdds, &[Float(l)]) => Cell::from_log_odds(l)?.information(),
            (Which::CellOccupancyFromLogOdds, &[Float(l)]) => {
                Cell::from_log_odds(l)?;
                occupancy_from_log_odds(l)
            }
            (Which::SensorOccupancy, &[Float(rho), Float(range), Float(sigma)]) => {
                let sensor = GaussianSensor::new(range, sigma)?;
                if rho.is_nan() {
                    return Err(Error::out_of_range("rho", rho.widen(), "any number, in metres").into());
                }
                sensor.occupancy(rho)
            }
            (Which::MapEntropy, [List(cells)]) => tally(cells)?.entropy(),
            (Which::MapInformation, [List(cells)]) => tally(cells)?.information(),
            (Which::MapMeanInformation, [List(cells)]) => tally(cells)?.mean_information(),
            (Which::MapObserved, [List(cells)]) => return Ok(Answer::Count(tally(cells)?.observed())),
            (Which::FuseLogOdds, [List(cells)]) => fuse(cells)?,
            (Which::ExpectedMeanInformation, [List(weights), Rows(particles)]) => {
                expected(weights, particles)?.mean_information()
            }
            (Which::GridPolar, &[Float(range), Float(sigma), Float(resolution)]) => {
                let (sensor, resolution) = room(range, sigma, resolution)?;
                let tally =
                    PolarRoom::new(sensor, resolution).and_then(|room| room.with_limit(MAX_SAMPLES).tally());
                tally.map_err(Refusal::TooLarge)?.mean_information()
            }
            (
                Which::GridCartesian,
                &[Float(range), Float(sigma), Float(resolution), Float(offset_x), Float(offset_y)],
            ) => {
                let (sensor, resolution) = room(range, sigma, resolution)?;
                for offset in [offset_x, offset_y] {
                    finite("offset", offset, "finite, in cells")?;
                }
                let room = CartesianRoom::new(sensor, resolution, [offset_x, offset_y]);
                let tally = room.and_then(|room| room.with_limit(MAX_SAMPLES).tally());
                tally.map_err(Refusal::TooLarge)?.mean_information()
            }
            (Which::LimitRadial, &[Float(range), Float(sigma)]) => {
                closed_form(&GaussianSensor::new(range, sigma)?, Weight::Radial)
            }
            (Which::LimitArea, &[Float(range), Float(sigma)]) => {
                closed_form(&GaussianSensor::new(range, sigma)?, Weight::Area)
            }
            _ => return Err(Refusal::Arguments),
        };
        Ok(Answer::Float(float))
    }
}

/// Computes the sums over a map of these occupancies.
fn tally<T: Real>(cells: &[T]) -> Result<Tally<T>, Error> {
    row(cells).map(|map| map.tally())
}

/// Creates a map of one row.
fn row<T: Real>(cells: &[T]) -> Result<Grid<Probability<T>>, Error> {
    Grid::new(cells.len(), 1, Geometry::new(1.0, [0.0, 0.0])?, cells.to_vec())
}

/// Computes the sums over the expected map of particles of one row each.
fn expected<T: Real>(weights: &[T], particles: &[Vec<T>]) -> Result<Tally<T>, Error> {
    let maps = particles.iter().map(|cells| row(cells)).collect::<Result<Vec<_>, _>>()?;
    let cells = maps.first().map_or(0, Grid::width);
    if let Some(index) = maps.iter().position(|map| map.width() != cells) {
        let (what, value) = ("number of cells of particle", maps[index].width() as f64);
        return Err(Error::Item { what, index, value, allowed: "that of the first particle" });
    }
    let weights: Vec<f64> = weights.iter().map(|weight| weight.widen()).collect();
    Hypotheses::new(&maps, &weights)?.expected_tally()
}

/// Checks the sensor and the resolution of a room.
fn room<T: Real>(range: T, sigma: T, resolution: T) -> Result<(GaussianSensor<T>, T), Error> {
    Ok((GaussianSensor::new(range, sigma)?, positive("resolution", resolution)?))
}
