//! The polar map of the circular room.

use super::axis::first_false;
use super::sampling::{Samples, Sampling};
use crate::cell::Cell;
use crate::error::Error;
use crate::map::PolarMap;
use crate::map::encoding::Probability;
use crate::real::Real;
use crate::rounded::multiple;
use crate::sensor::InverseSensorModel;
use crate::tally::Tally;
use alloc::vec::Vec;

/// The polar map `m_ρ` of a circular room with the sensor at its centre: rings of equal width from `ρ = 0`, as many as have a
/// sample within the sensor's reach.
///
/// All sectors are equal, so one represents the map. Ring `k` has its centre at `(k + 1/2) h`. A sample's distance is the
/// exact one rounded once to nearest, and its occupancy what the model gives for that float
/// ([`grids`](crate::book::grids)).
///
/// ```
/// use mean_information::room::PolarRoom;
/// use mean_information::sensor::GaussianSensor;
/// let room = PolarRoom::new(GaussianSensor::new(2.0_f64, 0.2)?, 0.01)?;
/// assert_eq!(room.rings()?, 224); // the last centre is at 2.235, within the reach of 2.2355
/// assert_eq!(room.tally()?.mean_information(), 0.7877440140577476); // the limit is 0.7893
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct PolarRoom<M: InverseSensorModel> {
    samples: Samples<M>,
}

impl<M: InverseSensorModel> PolarRoom<M> {
    /// Creates the room that `model` sees, in rings of width `resolution` (metres), sampled at their centres.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the resolution or the reach of the model is not positive and finite.
    pub fn new(model: M, resolution: M::Float) -> Result<Self, Error> {
        Ok(Self { samples: Samples::new(model, resolution)? })
    }

    /// Sets how cells are sampled. Each has as many samples as the number of [`Sampling::Averaged`] says.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if that number is not a power of two up to 1024.
    pub fn with_sampling(mut self, sampling: Sampling) -> Result<Self, Error> {
        self.samples.set_sampling(sampling)?;
        Ok(self)
    }

    /// Sets the largest number of samples; the default is `2^34`.
    #[must_use]
    pub fn with_limit(mut self, limit: u64) -> Self {
        self.samples.limit = limit;
        self
    }

    /// Computes the distance (metres) of the centre of ring `k`, `(k + 1/2) h`, correctly rounded.
    ///
    /// ```
    /// use mean_information::room::PolarRoom;
    /// use mean_information::sensor::GaussianSensor;
    /// let room = PolarRoom::new(GaussianSensor::new(2.0_f64, 0.2)?, 0.01)?;
    /// assert_eq!(room.distance(41), 0.41500000000000004);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn distance(&self, k: u64) -> M::Float {
        multiple(self.samples.resolution, -1, 2 * u128::from(k) + 1)
    }

    /// Returns the number of rings.
    ///
    /// # Errors
    /// [`Error::TooManySamples`] if they have more samples than the limit.
    pub fn rings(&self) -> Result<u64, Error> {
        let samples = &self.samples;
        let along = samples.along_a_beam();
        let refused = |count| samples.refused("the polar map of a room", count);
        if along / 2.0 > samples.limit as f64 {
            return Err(refused(along));
        }
        // The estimate is good to three roundings, and a sample at either end.
        let end = along / f64::from(samples.per_side) * (1.0 + 4.0 * f64::EPSILON) + 2.0;
        let rings = first_false(end as u64, |k| self.sample(k, 0) <= samples.reach);
        let count = u128::from(rings) * u128::from(samples.per_side);
        if count > u128::from(samples.limit) { Err(refused(count as f64)) } else { Ok(rings) }
    }

    /// Computes entropy, information and counts of one sector, each within 1.5 ulp of that of the occupancies of
    /// [`map`](Self::map).
    ///
    /// Cells of the model's [plateau](InverseSensorModel::plateau) are counted at once, to the same bits.
    ///
    /// # Errors
    /// [`Error::TooManySamples`] if the rings have more samples than the limit; [`Error::OutOfRange`] if the model gives an
    /// occupancy outside `[0, 1]`.
    pub fn tally(&self) -> Result<Tally<M::Float>, Error> {
        let samples = &self.samples;
        let rings = self.rings()?;
        let last = samples.per_side - 1;
        let plateau = first_false(rings, |k| self.sample(k, last) <= samples.plateau);
        let mut tally = Tally::new();
        tally.add_many(samples.plateau_cell()?, plateau);
        for k in plateau..rings {
            tally.add(Cell::from_occupancy(self.occupancy(k)?)?);
        }
        Ok(tally)
    }

    /// Creates the map of `sectors` equal sectors. Each cell has the model's occupancy at its
    /// [`distance`](Self::distance), or the exact mean over its samples, rounded once.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] if it has more than `max_cells` cells, [`Error::TooManySamples`] if its rings have more samples
    /// than the limit; [`Error::OutOfRange`] if the model gives an occupancy outside `[0, 1]`.
    ///
    /// ```
    /// use mean_information::room::PolarRoom;
    /// use mean_information::sensor::GaussianSensor;
    /// let map = PolarRoom::new(GaussianSensor::new(2.0_f64, 0.2)?, 0.25)?.map(3, 100)?;
    /// assert_eq!((map.sectors(), map.rings()), (3, 9));
    /// assert_eq!(map.occupancy(2, 6), Some(0.17242162389375285)); // at 1.625 metres
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn map(&self, sectors: usize, max_cells: usize) -> Result<PolarMap<Probability<M::Float>>, Error> {
        let rings = self.rings()?;
        let count = u128::from(rings) * sectors as u128;
        if count > max_cells as u128 {
            let what = "the polar map of a room";
            return Err(Error::TooManyCells { what, count: count as f64, limit: max_cells as u64 });
        }
        let beam: Vec<M::Float> = (0..rings).map(|k| self.occupancy(k)).collect::<Result<_, _>>()?;
        PolarMap::new(sectors, beam.len(), self.samples.resolution.widen(), beam.repeat(sectors))
    }

    /// Computes the distance of a sample of ring `k`.
    fn sample(&self, k: u64, sample: u32) -> M::Float {
        let half_steps = 2 * (u128::from(k) * u128::from(self.samples.per_side) + u128::from(sample)) + 1;
        multiple(self.samples.resolution, self.samples.scale(), half_steps)
    }

    /// Computes the occupancy of ring `k` by its sampling.
    fn occupancy(&self, k: u64) -> Result<M::Float, Error> {
        let samples = &self.samples;
        if samples.per_side == 1 {
            samples.at(self.distance(k))
        } else {
            samples.mean((0..samples.per_side).map(|sample| self.sample(k, sample)))
        }
    }
}
