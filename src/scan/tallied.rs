//! A map of scans with its tally, which is kept as scans come and go: Eqs. 2 to 4 after each of them, for the price of the cells
//! that it touched.

use super::beams::Scan;
use super::measures::{cell, count};
use super::readings::{Reading, Readings};
use super::scan_map::ScanMap;
use crate::cell::Cell;
use crate::error::Error;
use crate::map::repeated::Repeated;
use crate::real::Real;
use crate::sensor::InverseSensorModel;
use crate::tally::Tally;
use alloc::vec::Vec;

/// A map of scans and its tally, which has the bits of [`ScanMap::tally`] after each scan, but only cells that the scan touched
/// are measured again ([`evidence`](crate::book::evidence)): sums over cells are exact, so that a cell is taken out and put back
/// without any error.
///
/// ```
/// use mean_information::scan::{Beam, Pose, Scan, ScanMap, TalliedMap};
/// use mean_information::sensor::SteppedSensor;
/// let scan = |range| Scan::new(Pose::new(0.13, 0.12, 0.0)?, 4.0, vec![Beam { bearing: 0.0, range: Some(range) }]);
/// let model = |range| SteppedSensor::new(range, 0.25, 0.25, 0.875);
/// let mut map = TalliedMap::new(ScanMap::<f64>::new(0.25)?);
/// let mut series = Vec::new();
/// for range in [1.0, 1.0, 1.5] {
///     series.push(map.insert(&scan(range)?, model)?.mean_information()); // bits per observed cell
/// }
/// assert_eq!(series, [0.24226461179277445, 0.5965154166202109, 0.6339718302736123]);
/// assert_eq!(map.remove(&scan(1.5)?, model)?.mean_information(), series[1]);
/// assert_eq!(*map.tally(), map.map().tally());
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TalliedMap<T> {
    map: ScanMap<T>,
    tally: Tally<T>,
}

impl<T: Real> TalliedMap<T> {
    /// Measures a map, once as a whole.
    pub fn new(map: ScanMap<T>) -> Self {
        let tally = map.tally();
        Self { map, tally }
    }

    /// Returns the map.
    pub fn map(&self) -> &ScanMap<T> {
        &self.map
    }

    /// Returns the tally of the map: the bits of [`ScanMap::tally`].
    pub fn tally(&self) -> &Tally<T> {
        &self.tally
    }

    /// Gives the map back.
    pub fn into_map(self) -> ScanMap<T> {
        self.map
    }

    /// Inserts a scan, as [`ScanMap::insert`] does, and returns the tally of the map with it: the bits of [`ScanMap::tally`].
    ///
    /// # Errors
    /// Those of [`ScanMap::insert`]; then nothing has changed.
    pub fn insert<M, F>(&mut self, scan: &Scan<T>, model: F) -> Result<&Tally<T>, Error>
    where
        M: InverseSensorModel<Float = T>,
        F: Fn(T) -> Result<M, Error>,
    {
        let before = self.map.cells();
        let readings = self.map.insert_readings(scan, model)?;
        // The rectangle grows by cells of which nothing is known.
        self.tally.add_many(Cell::unknown(), self.map.cells() - before);
        self.renew(&readings, false)?;
        Ok(&self.tally)
    }

    /// Removes a scan, as [`ScanMap::remove`] does, and returns the tally of the map without it: the bits of
    /// [`ScanMap::tally`].
    ///
    /// # Errors
    /// Those of [`ScanMap::remove`]; then nothing has changed.
    pub fn remove<M, F>(&mut self, scan: &Scan<T>, model: F) -> Result<&Tally<T>, Error>
    where
        M: InverseSensorModel<Float = T>,
        F: Fn(T) -> Result<M, Error>,
    {
        let before = self.map.cells();
        let readings = self.map.remove_readings(scan, model)?;
        self.renew(&readings, true)?;
        // It shrinks by cells that are unknown again.
        self.tally.remove_many(Cell::unknown(), before - self.map.cells())?;
        Ok(&self.tally)
    }

    /// Measures the map without some of its scans: the bits of the tally of a map that never had them. With
    /// one block of scans after another this gives the leave-one-out tallies of a [jackknife](super::Difference) for the price of
    /// one more pass over the scans, and a copy of the map for each block; blocks can be taken by several threads.
    ///
    /// # Errors
    /// Those of [`ScanMap::remove`].
    ///
    /// ```
    /// use mean_information::scan::{Beam, Pose, Scan, ScanMap, TalliedMap};
    /// use mean_information::sensor::SteppedSensor;
    /// let scan = |range| Scan::new(Pose::new(0.13, 0.12, 0.0)?, 4.0, vec![Beam { bearing: 0.0, range: Some(range) }]);
    /// let model = |range| SteppedSensor::new(range, 0.25, 0.25, 0.875);
    /// let scans = [scan(1.0)?, scan(2.0)?, scan(1.0)?];
    /// let mut map = TalliedMap::new(ScanMap::<f64>::new(0.25)?);
    /// let alone = map.insert(&scans[0], model)?.clone();
    /// map.insert(&scans[1], model)?;
    /// map.insert(&scans[2], model)?;
    /// assert_eq!(map.without(&scans[1..], model)?, alone);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn without<'a, M, F>(
        &self,
        scans: impl IntoIterator<Item = &'a Scan<T>>,
        model: F,
    ) -> Result<Tally<T>, Error>
    where
        M: InverseSensorModel<Float = T>,
        F: Fn(T) -> Result<M, Error>,
    {
        let mut rest = self.clone();
        for scan in scans {
            rest.remove(scan, &model)?;
        }
        Ok(rest.tally)
    }

    /// Measures the cells of these readings again: out with what they were, in with what they are.
    ///
    /// # Errors
    /// Never: the tally holds all cells of the map.
    fn renew(&mut self, readings: &Readings, is_removal: bool) -> Result<(), Error> {
        // Cells of one sum are measured once, as in a whole map.
        let mut touched = 0;
        readings.for_each(|_| touched += 1);
        let counts = || Repeated::new(touched, 0);
        let (mut old, mut new) = (counts(), counts());
        let mut lost = Vec::new();
        readings.for_each(|Reading { cell: place, log_odds }| {
            let now = self.map.sum_of(place);
            let before = if is_removal { now + log_odds } else { now - log_odds };
            if let Some((sum, count)) = count(&mut new, now, 1) {
                self.tally.add_many(cell(sum), count);
            }
            lost.extend(count(&mut old, before, 1));
        });
        for (sum, count) in new.into_counts() {
            self.tally.add_many(cell(sum), count);
        }
        for (sum, count) in lost.into_iter().chain(old.into_counts()) {
            self.tally.remove_many(cell(sum), count)?;
        }
        Ok(())
    }
}
