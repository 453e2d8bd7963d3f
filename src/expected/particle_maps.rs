//! The expected map of particles' maps that share cells: each pattern of what the particles say is measured once.

use super::marginals::{agreed, summand};
use super::weights::{Weights, weighted_mean};
use crate::cell::State;
use crate::error::Error;
#[cfg(feature = "rayon")]
use crate::map::parts;
use crate::real::Real;
use crate::rounded::beyond_float;
use crate::scan::ParticleMaps;
use crate::tally::Tally;
use alloc::{vec, vec::Vec};
use core::ops::Range;
#[cfg(feature = "rayon")]
use rayon::prelude::*;

impl<T: Real> ParticleMaps<T> {
    /// Computes the sums over the expected map of the particles by these weights, which need not add up to 1: the bits of
    /// [`Hypotheses::expected_tally`](super::Hypotheses::expected_tally) of the particles' maps in log-odds (proved,
    /// [`expected`](crate::book::expected)). Its mean information is the EMMI.
    ///
    /// # Errors
    /// Those of [`Hypotheses::new`](super::Hypotheses::new) on the weights.
    ///
    /// ```
    /// use mean_information::expected::Hypotheses;
    /// use mean_information::scan::{Beam, ParticleMaps, Pose, Scan, ScanMap};
    /// use mean_information::sensor::GaussianSensor;
    ///
    /// let scan = |x| Scan::new(Pose::new(x, 0.12, 0.0)?, 4.0, vec![Beam { bearing: 0.3, range: Some(1.0) }]);
    /// let mut maps = ParticleMaps::new(ScanMap::<f64>::new(0.25)?, 2)?;
    /// maps.insert(&[scan(0.13)?, scan(0.43)?], |range| GaussianSensor::new(range, 0.125))?;
    /// let expected = maps.expected_tally(&[0.75, 0.25])?;
    /// let built = [maps.log_odds(0)?, maps.log_odds(1)?];
    /// assert_eq!(expected, Hypotheses::new(&built, &[0.75, 0.25])?.expected_tally()?);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn expected_tally(&self, weights: &[f64]) -> Result<Tally<T>, Error> {
        let weights = Weights::new(weights, self.particles())?;
        Ok(self.with_unknown(self.sums(&weights, 0..self.patterns())))
    }

    /// Computes [`Self::expected_tally`] on rayon's threads: the same bits for any number of them.
    ///
    /// (Proved, [`expected`](crate::book::expected).)
    ///
    /// # Errors
    /// Those of [`Self::expected_tally`].
    ///
    /// ```
    /// use mean_information::scan::{Beam, ParticleMaps, Pose, Scan, ScanMap};
    /// use mean_information::sensor::GaussianSensor;
    /// let scan = |x| Scan::new(Pose::new(x, 0.12, 0.0)?, 4.0, vec![Beam { bearing: 0.3, range: Some(1.0) }]);
    /// let mut maps = ParticleMaps::new(ScanMap::<f64>::new(0.25)?, 2)?;
    /// maps.insert(&[scan(0.13)?, scan(0.43)?], |range| GaussianSensor::new(range, 0.125))?;
    /// assert_eq!(maps.par_expected_tally(&[0.75, 0.25])?, maps.expected_tally(&[0.75, 0.25])?);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    #[cfg(feature = "rayon")]
    pub fn par_expected_tally(&self, weights: &[f64]) -> Result<Tally<T>, Error> {
        let weights = Weights::new(weights, self.particles())?;
        let parts = parts::for_threads(self.patterns());
        Ok(self.with_unknown(parts.map(|numbers| self.sums(&weights, numbers)).sum()))
    }

    /// Computes the weighted mean of the particles' own mean information (Eq. 4, bits per observed cell), rounded once: the bits
    /// of [`Hypotheses::mean_of_mean_information`](super::Hypotheses::mean_of_mean_information).
    ///
    /// # Errors
    /// Those of [`Self::expected_tally`].
    ///
    /// ```
    /// use mean_information::scan::{Beam, ParticleMaps, Pose, Scan, ScanMap};
    /// use mean_information::sensor::SteppedSensor;
    /// let scan = |range| Scan::new(Pose::new(0.13, 0.12, 0.0)?, 4.0, vec![Beam { bearing: 0.0, range: Some(range) }]);
    /// let mut maps = ParticleMaps::new(ScanMap::<f64>::new(0.25)?, 2)?;
    /// maps.insert(&[scan(1.0)?, scan(2.5)?], |range| SteppedSensor::new(range, 0.25, 0.25, 0.875))?;
    /// let mean = maps.mean_of_mean_information(&[0.75, 0.25])?;
    /// assert_eq!(format!("{mean:.12}"), "0.234963329577"); // bits per observed cell
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn mean_of_mean_information(&self, weights: &[f64]) -> Result<T, Error> {
        let tallies = (0..self.particles()).filter_map(|particle| self.tally(particle));
        let values: Vec<_> = tallies.map(Tally::mean_information).collect();
        weighted_mean(weights, &values)
    }

    /// Computes the sums over the cells of some patterns.
    fn sums(&self, weights: &Weights, numbers: Range<u64>) -> Tally<T> {
        let mut tally = Tally::new();
        let integers = weights.integers();
        let mut groups = Groups { sums: vec![0; self.values()], present: Vec::new(), list: Vec::new() };
        let mut occupancies = Vec::with_capacity(self.particles());
        for (values, cells) in self.patterns_in(numbers) {
            let (state, both) = if values.iter().all(|&value| value == values[0]) {
                agreed(self.occupancy(values[0]))
            } else {
                let short = integers.as_ref().and_then(|integers| {
                    weights.mean_of_groups(groups.of(values, integers, |value| self.occupancy(value)))
                });
                let mean = short.unwrap_or_else(|| {
                    occupancies.clear();
                    occupancies.extend(values.iter().map(|&value| self.occupancy(value)));
                    weights.mean(&occupancies)
                });
                summand(&mean, || mean.leading())
            };
            tally.add_fixed(state, both, cells);
        }
        tally
    }

    /// Adds the cells of which no particle knows anything.
    fn with_unknown(&self, mut known: Tally<T>) -> Tally<T> {
        let unknown = self.cells() - known.cells();
        known.add_fixed(State::Unknown, beyond_float::UNKNOWN, unknown);
        known
    }
}

/// The particles of a pattern by what they say: fewer products than particles.
struct Groups<T> {
    /// The sum of the weights of each value, 0 between patterns.
    sums: Vec<u128>,
    /// The values of weight above 0.
    present: Vec<u32>,
    list: Vec<(u128, T)>,
}

impl<T: Real> Groups<T> {
    /// Returns the sum of the weights of each value with its occupancy.
    fn of(&mut self, values: &[u32], weights: &[u128], occupancy: impl Fn(u32) -> T) -> &[(u128, T)] {
        for (&value, &weight) in values.iter().zip(weights).filter(|&(_, &weight)| weight > 0) {
            let sum = &mut self.sums[value as usize];
            if *sum == 0 {
                self.present.push(value);
            }
            *sum += weight;
        }
        self.list.clear();
        let sums = &mut self.sums;
        let group = |value: u32| (core::mem::take(&mut sums[value as usize]), occupancy(value));
        self.list.extend(self.present.drain(..).map(group));
        &self.list
    }
}
