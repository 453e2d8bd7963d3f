//! The sampling of the model and the limit on samples, which both rooms share.

use crate::cell::{Cell, in_unit_interval};
use crate::error::{Error, positive};
use crate::real::Real;
use crate::sensor::InverseSensorModel;
use crate::tally::ExactSum;
use num_traits::Zero;

/// The way in which a cell of a room gets its occupancy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Sampling {
    /// The model at the cell's centre.
    #[default]
    Centre,
    /// The mean of the model over the cell: the exact mean over the centres of equal parts, with this number of parts along
    /// a side, rounded once.
    ///
    /// The number is a power of two up to 1024. So the samples lie at exact places, and nested grids share them. The
    /// distance of this mean from the mean over the whole cell is bounded in [`grids`](crate::book::grids#averages).
    Averaged(u32),
}

/// The largest number of samples along a side of a cell.
const MAX_PER_SIDE: u32 = 1 << 10;

/// The default limit on samples: some minutes.
const DEFAULT_LIMIT: u64 = 1 << 34;

/// The model of a room, where it is sampled, and the limit.
#[derive(Clone, Debug)]
pub(super) struct Samples<M: InverseSensorModel> {
    model: M,
    pub(super) resolution: M::Float,
    pub(super) reach: M::Float,
    pub(super) plateau: M::Float,
    pub(super) per_side: u32,
    pub(super) limit: u64,
}

impl<M: InverseSensorModel> Samples<M> {
    /// Creates the samples at the centres of cells.
    pub(super) fn new(model: M, resolution: M::Float) -> Result<Self, Error> {
        let resolution = positive("resolution", resolution)?;
        let (reach, plateau) = (positive("reach of the sensor", model.reach())?, model.plateau());
        Ok(Self { model, resolution, reach, plateau, per_side: 1, limit: DEFAULT_LIMIT })
    }

    /// Sets how cells are sampled.
    pub(super) fn set_sampling(&mut self, sampling: Sampling) -> Result<(), Error> {
        self.per_side = match sampling {
            Sampling::Centre => 1,
            Sampling::Averaged(n) if n.is_power_of_two() && n <= MAX_PER_SIDE => n,
            Sampling::Averaged(n) => {
                return Err(Error::out_of_range("samples per side", n.into(), "a power of two up to 1024"));
            }
        };
        Ok(())
    }

    /// Returns the exponent of the unit of places, half the distance of two samples: `resolution 2^scale`.
    pub(super) fn scale(&self) -> i32 {
        -1 - self.per_side.trailing_zeros() as i32
    }

    /// Estimates the number of samples from the sensor to its reach.
    pub(super) fn along_a_beam(&self) -> f64 {
        self.reach.widen() / self.resolution.widen() * f64::from(self.per_side)
    }

    /// Creates the error of too many samples.
    pub(super) fn refused(&self, what: &'static str, count: f64) -> Error {
        Error::TooManySamples { what, count, limit: self.limit }
    }

    /// Evaluates the model at one distance.
    pub(super) fn at(&self, rho: M::Float) -> Result<M::Float, Error> {
        let p = self.model.occupancy(rho);
        if in_unit_interval(p) {
            Ok(p)
        } else {
            Err(Error::out_of_range("occupancy by the sensor model", p.widen(), "0 to 1"))
        }
    }

    /// Computes the exact mean of the model over these distances, rounded once to nearest.
    pub(super) fn mean(&self, distances: impl Iterator<Item = M::Float>) -> Result<M::Float, Error> {
        let (mut sum, mut count) = (ExactSum::new(), 0);
        for rho in distances {
            sum.add(self.at(rho)?);
            count += 1;
        }
        Ok(sum.mean(count))
    }

    /// Returns the cell that all cells of the plateau equal.
    pub(super) fn plateau_cell(&self) -> Result<Cell<M::Float>, Error> {
        Cell::from_occupancy(self.at(M::Float::zero())?)
    }
}
