//! Where a room samples its model, and when it refuses to: what both rooms share.

use crate::cell::{Cell, in_unit_interval};
use crate::error::{Error, positive};
use crate::real::Real;
use crate::sensor::InverseSensorModel;
use crate::tally::ExactSum;
use num_traits::Zero;

/// How a cell of a room gets its occupancy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sampling {
    /// The model at the cell's centre.
    #[default]
    Centre,
    /// The mean of the model over the cell: exact over the centres of equal parts, so many to a side, rounded once.
    ///
    /// The number is a power of two up to 1024: so the samples lie at exact places, and the cells of grids nested in one
    /// another share them. How far this mean is from that over the whole cell is proved in
    /// [`grids`](crate::book::grids#averages).
    Averaged(u32),
}

/// Samples per side of a cell, at most.
const MAX_PER_SIDE: u32 = 1 << 10;

/// The samples that a grid may take unless told otherwise: some minutes.
const DEFAULT_LIMIT: u64 = 1 << 34;

/// What the two rooms share: the model, where it is sampled, and when to refuse.
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
    pub(super) fn new(model: M, resolution: M::Float) -> Result<Self, Error> {
        let resolution = positive("resolution", resolution)?;
        let (reach, plateau) = (positive("reach of the sensor", model.reach())?, model.plateau());
        Ok(Self { model, resolution, reach, plateau, per_side: 1, limit: DEFAULT_LIMIT })
    }

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

    /// Places are in units of half the distance of two samples: `resolution 2^scale`.
    pub(super) fn scale(&self) -> i32 {
        -1 - self.per_side.trailing_zeros() as i32
    }

    /// Samples from the sensor to its reach, about.
    pub(super) fn along_a_beam(&self) -> f64 {
        self.reach.widen() / self.resolution.widen() * f64::from(self.per_side)
    }

    pub(super) fn refused(&self, what: &'static str, count: f64) -> Error {
        Error::TooManyCells { what, count, limit: self.limit }
    }

    /// The model at one distance.
    pub(super) fn at(&self, rho: M::Float) -> Result<M::Float, Error> {
        let p = self.model.occupancy(rho);
        if in_unit_interval(p) {
            Ok(p)
        } else {
            Err(Error::out_of_range("occupancy by the sensor model", p.widen(), "0 to 1"))
        }
    }

    /// The exact mean of the model over these distances, rounded once to nearest.
    pub(super) fn mean(&self, distances: impl Iterator<Item = M::Float>) -> Result<M::Float, Error> {
        let (mut sum, mut count) = (ExactSum::new(), 0);
        for rho in distances {
            sum.add(self.at(rho)?);
            count += 1;
        }
        Ok(sum.mean(count))
    }

    /// The cells of the plateau.
    pub(super) fn plateau_cell(&self) -> Result<Cell<M::Float>, Error> {
        Cell::from_occupancy(self.at(M::Float::zero())?)
    }
}
