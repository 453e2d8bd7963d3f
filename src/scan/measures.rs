//! What a map of scans says: Eqs. 2 to 4 over its cells, and the map itself in log-odds or probabilities.

use super::raster::Area;
use super::scan_map::ScanMap;
use super::sums::Sums;
use crate::cell::Cell;
use crate::error::Error;
use crate::map::encoding::{LogOdds, Probability};
use crate::map::parts;
use crate::map::repeated::Repeated;
use crate::map::{Encoding, Geometry, Grid};
use crate::real::Real;
use crate::rounded::{occupancy_from_fixed_log_odds, round_log_odds};
use crate::tally::Tally;
use alloc::vec::Vec;
use core::ops::Range;
#[cfg(feature = "rayon")]
use rayon::prelude::*;

impl<T: Real> ScanMap<T> {
    /// Measures entropy, information and counts over all cells of the rectangle that was seen (Eqs. 2 to 4): the bits of the
    /// tally of [`Self::log_odds`], without that map.
    ///
    /// Cells are counted by their log-odds first, of which scans leave few: most are computed once for many cells.
    ///
    /// ```
    /// use mean_information::scan::{Beam, Pose, Scan, ScanMap};
    /// use mean_information::sensor::SteppedSensor;
    /// let beams = vec![Beam { bearing: 0.0, range: Some(1.5) }, Beam { bearing: 1.5, range: None }];
    /// let scan = Scan::new(Pose::new(0.13, 0.27, 0.0)?, 2.0, beams)?;
    /// let mut map = ScanMap::<f64>::new(0.25)?;
    /// map.insert(&scan, |range| SteppedSensor::new(range, 0.25, 0.25, 0.875))?;
    /// assert_eq!(map.tally().mean_information(), 0.20656945429150292); // bits per observed cell
    /// assert_eq!(map.tally(), map.log_odds()?.tally());
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn tally(&self) -> Tally<T> {
        self.tally_of(0..self.cells())
    }

    /// Measures as [`Self::tally`] does, by as many threads as rayon has: the same bits for any number of them
    /// (Eqs. 2 to 4).
    ///
    /// ```
    /// use mean_information::scan::{Beam, Pose, Scan, ScanMap};
    /// use mean_information::sensor::GaussianSensor;
    /// let scan = Scan::new(Pose::new(0.1, 0.2, 0.3)?, 2.0, vec![Beam { bearing: 0.0, range: Some(1.5) }])?;
    /// let mut map = ScanMap::<f64>::new(0.01)?;
    /// map.insert(&scan, |range| GaussianSensor::new(range, 0.1))?;
    /// assert_eq!(map.par_tally(), map.tally());
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    #[cfg(feature = "rayon")]
    pub fn par_tally(&self) -> Tally<T> {
        parts::for_threads(self.cells()).map(|cells| self.tally_of(cells)).sum()
    }

    /// Counts the cells of the rectangle that was seen, those of the [`tally`](Self::tally), without measuring them.
    ///
    /// ```
    /// use mean_information::scan::{Beam, Pose, Scan, ScanMap};
    /// use mean_information::sensor::SteppedSensor;
    /// let scan = Scan::new(Pose::new(0.13, 0.12, 0.0)?, 2.0, vec![Beam { bearing: 0.0, range: Some(0.5) }])?;
    /// let mut map = ScanMap::<f64>::new(0.25)?;
    /// map.insert(&scan, |range| SteppedSensor::new(range, 0.25, 0.25, 0.875))?;
    /// assert_eq!((map.cells(), map.tally().cells()), (4, 4));
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn cells(&self) -> u64 {
        self.sums.as_ref().map_or(0, |sums| sums.seen().cells() as u64)
    }

    /// Measures some of these cells, by their numbers.
    fn tally_of(&self, cells: Range<u64>) -> Tally<T> {
        let mut tally = Tally::new();
        let Some(sums) = &self.sums else { return tally };
        let mut counts = Repeated::new(cells.end - cells.start, 0);
        let (low, [width, _]) = (sums.seen().low()[1], sums.seen().size());
        for (row, columns) in parts::rows(cells, width, width) {
            for (sum, length) in sums.runs(low + row as i64, columns) {
                if let Some((sum, count)) = count(&mut counts, sum, length) {
                    tally.add_many(cell(sum), count);
                }
            }
        }
        for (sum, count) in counts.into_counts() {
            tally.add_many(cell(sum), count);
        }
        tally
    }

    /// Returns the map in log-odds (nats), as large as what the beams have crossed.
    ///
    /// The log-odds of `n` scans are within `n 2^-76` nats of their exact sum, and rounded once (proved,
    /// [`scan`](crate::book::scan)).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the corner of the map is not finite.
    ///
    /// ```
    /// use mean_information::scan::{Beam, Pose, Scan, ScanMap};
    /// use mean_information::sensor::SteppedSensor;
    /// let scan = Scan::new(Pose::new(0.13, 0.12, 0.0)?, 2.0, vec![Beam { bearing: 0.0, range: Some(0.5) }])?;
    /// let mut map = ScanMap::<f64>::new(0.25)?;
    /// map.insert(&scan, |range| SteppedSensor::new(range, 0.25, 0.25, 0.875))?;
    /// let [free, occupied] = [-1.0986122886681098, 1.9459101490553132]; // -ln 3, ln 7
    /// assert_eq!(map.log_odds()?.cells(), [free, free, occupied, 0.0]);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn log_odds(&self) -> Result<Grid<LogOdds<T>>, Error> {
        self.grid(round_log_odds)
    }

    /// Returns the map in probabilities, as large as what the beams have crossed: within 0.501 ulp of those of the sums before these are rounded (proved,
    /// [`scan`](crate::book::scan)).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the corner of the map is not finite.
    ///
    /// ```
    /// use mean_information::scan::{Beam, Pose, Scan, ScanMap};
    /// use mean_information::sensor::SteppedSensor;
    /// let scan = Scan::new(Pose::new(0.13, 0.12, 0.0)?, 2.0, vec![Beam { bearing: 0.0, range: Some(0.5) }])?;
    /// let mut map = ScanMap::<f64>::new(0.25)?;
    /// map.insert(&scan, |range| SteppedSensor::new(range, 0.25, 0.25, 0.875))?;
    /// assert_eq!(map.probabilities()?.cells(), [0.25, 0.25, 0.875, 0.5]);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn probabilities(&self) -> Result<Grid<Probability<T>>, Error> {
        self.grid(occupancy_from_fixed_log_odds)
    }

    /// Returns the place in the world of the map that [`Self::log_odds`] and [`Self::probabilities`] return: the side of a cell,
    /// and the lower left corner of the rectangle that was seen, each coordinate rounded once.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the corner of the map is not finite.
    ///
    /// ```
    /// use mean_information::scan::{Beam, Pose, Scan, ScanMap};
    /// use mean_information::sensor::SteppedSensor;
    /// let scan = Scan::new(Pose::new(-0.37, 0.62, 0.0)?, 2.0, vec![Beam { bearing: 0.0, range: Some(0.5) }])?;
    /// let mut map = ScanMap::<f64>::new(0.25)?;
    /// map.insert(&scan, |range| SteppedSensor::new(range, 0.25, 0.25, 0.875))?;
    /// assert_eq!(map.geometry()?.origin(), [-0.5, 0.5]);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn geometry(&self) -> Result<Geometry, Error> {
        self.place().map(|(_, geometry)| geometry)
    }

    /// Encodes the sums of all cells.
    fn grid<E: Encoding>(&self, stored: impl Fn(i128) -> E::Stored) -> Result<Grid<E>, Error> {
        let ([width, height], geometry) = self.place()?;
        let sums = self.sums.iter().flat_map(Sums::log_odds);
        let mut cells = Vec::with_capacity(width * height);
        // Each row in a loop of its own, which `collect` does not make.
        sums.for_each(|sum| cells.push(stored(sum)));
        Grid::new(width, height, geometry, cells)
    }

    /// Returns the size of the rectangle that was seen, and its place in the world.
    pub(super) fn place(&self) -> Result<([usize; 2], Geometry), Error> {
        self.place_of(self.sums.as_ref().map(Sums::seen))
    }

    /// Returns the size of a rectangle of cells of this resolution, and its place in the world.
    pub(super) fn place_of(&self, seen: Option<Area>) -> Result<([usize; 2], Geometry), Error> {
        let (size, low) = seen.map_or(([0, 0], [0, 0]), |seen| (seen.size(), seen.low()));
        // Rounded once: the number of a column is a float.
        let origin = low.map(|k| k as f64 * self.resolution());
        Ok((size, Geometry::new(self.resolution(), origin)?))
    }
}

/// Measures a cell by its sum of log-odds: rounded once to a float, entropy and information of which are correctly rounded.
pub(super) fn cell<T: Real>(sum: i128) -> Cell<T> {
    // A sum of integers is no NaN.
    LogOdds::cell(round_log_odds(sum)).unwrap_or_else(Cell::unknown)
}

/// Counts cells of one sum; returns the sum and the count that lost their slot to it.
#[inline]
pub(super) fn count(counts: &mut Repeated<i128>, sum: i128, count: u64) -> Option<(i128, u64)> {
    // Bits of the fraction and of the sign: both halves.
    counts.add(sum, sum as u64 ^ (sum >> 64) as u64, count)
}
