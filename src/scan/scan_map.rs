//! Scans inserted into a map and removed from it: log-odds of an inverse sensor model along each beam, added up exactly.

use super::beams::Scan;
use super::inserted::Inserted;
use super::lattice::Lattice;
use super::rays::Rays;
use super::readings::{Limit, Readings};
use super::sums::Sums;
use crate::error::Error;
use crate::map::Geometry;
use crate::real::Real;
use crate::rounded::LOG_ODDS_SCALE;
use crate::sensor::InverseSensorModel;
use core::marker::PhantomData;

/// A map that range scans are inserted into, and removed from again.
///
/// Cells are squares of one side, `[i r, (i + 1) r) x [j r, (j + 1) r)` for integers `i` and `j`, so that all maps of
/// one resolution share their cells. The map grows with the scans; each cell holds the sum of log-odds of the scans
/// that touched it, in integers, so any order of scans gives the same bits, and a scan that is removed leaves the bits of a map
/// that never had it. A cell of which nothing is known is 0: prior 1/2 ([`scan`](crate::book::scan)).
///
/// Two maps are equal if they have the same resolution and limits, hold the same scans, and have the same sums in the same
/// rectangle of cells.
///
/// Memory:
/// * 5 bytes for each cell of the rectangle that was seen, while all readings together have at most two values, one of free
///   cells and one of occupied, as those of a [`SteppedSensor`](crate::sensor::SteppedSensor) have; 9 from 65 536 scans on;
///   with more values 16, [with agreement](Self::with_agreement) 32;
/// * room to spare, half as much again on each side that grew, and while the map grows the old and the new one;
/// * while a scan is inserted or removed, up to two and a half bytes for each cell of the rectangle of that scan, some 500 for each
///   beam, and some 60 for each reading of a third value;
/// * some 60 bytes for each scan.
///
/// ```
/// use mean_information::scan::{Beam, Pose, Scan, ScanMap};
/// use mean_information::sensor::GaussianSensor;
///
/// // Two beams: a wall at 1.5 m ahead, nothing within 2 m to the left.
/// let beams = vec![Beam { bearing: 0.0, range: Some(1.5) }, Beam { bearing: 1.5, range: None }];
/// let scan = Scan::new(Pose::new(0.13, 0.27, 0.0)?, 2.0, beams)?;
/// let mut map = ScanMap::<f64>::new(0.25)?;
/// map.insert(&scan, |range| GaussianSensor::new(range, 0.1))?;
/// let tally = map.log_odds()?.tally();
/// assert_eq!((tally.free(), tally.occupied(), map.resolution()), (14, 1, 0.25));
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ScanMap<T> {
    pub(super) lattice: Lattice,
    pub(super) limit: Limit<T>,
    pub(super) max_cells: u64,
    has_agreement: bool,
    inserted: Inserted,
    /// The sums of the readings of each cell; `None` while no scan is held.
    pub(super) sums: Option<Sums>,
    format: PhantomData<T>,
}

impl<T: Real> ScanMap<T> {
    /// The most cells a map may have unless the caller says otherwise: `8192 x 8192`, which take 1 GiB at 16 bytes
    /// each, 320 MiB at 5.
    pub const MAX_CELLS: u64 = 1 << 26;

    /// The log-odds (nats) to which a reading is limited unless the caller says otherwise: those of `p = 0.971`.
    pub const READING_LIMIT: f64 = 3.5;

    /// Creates an empty map of cells of side `resolution` (metres).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if it is not positive and finite.
    pub fn new(resolution: f64) -> Result<Self, Error> {
        Geometry::new(resolution, [0.0; 2])?;
        let map = Self {
            lattice: Lattice::new(resolution),
            limit: Limit::new(1),
            max_cells: Self::MAX_CELLS,
            has_agreement: false,
            inserted: Inserted::default(),
            sums: None,
            format: PhantomData,
        };
        map.with_reading_limit(Self::READING_LIMIT)
    }

    /// Limits the log-odds of one reading of a cell to `-limit..=limit` (nats); [`Self::READING_LIMIT`] otherwise.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if it is not in `(0, 40]`.
    pub fn with_reading_limit(mut self, limit: f64) -> Result<Self, Error> {
        if !(limit > 0.0 && limit <= 40.0) {
            return Err(Error::out_of_range(
                "limit on the log-odds of a reading",
                limit,
                "above 0, up to 40 nats",
            ));
        }
        // To units of 2^-80 nats, cut; at least one.
        let (m, e) = limit.parts();
        let shift = e + LOG_ODDS_SCALE;
        let m = i128::from(m);
        let units = if shift >= 0 { m << shift } else { m.checked_shr(shift.unsigned_abs()).unwrap_or(0) };
        self.limit = Limit::new(units.max(1));
        Ok(self)
    }

    /// Refuses scans that would make the map larger than this; [`Self::MAX_CELLS`] otherwise.
    #[must_use]
    pub fn with_max_cells(self, max_cells: u64) -> Self {
        Self { max_cells, ..self }
    }

    /// Keeps the magnitudes of the readings of each cell, for [`agreement`](Self::agreement) and
    /// [`contradictions`](Self::contradictions): up to 16 bytes more for each cell. No other result changes.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the map holds scans, whose readings are not known any more.
    pub fn with_agreement(self) -> Result<Self, Error> {
        if self.scans() > 0 && !self.has_agreement {
            let (what, scans) = ("number of scans of a map that is to keep agreement", self.scans() as f64);
            return Err(Error::out_of_range(what, scans, "0: before the first scan"));
        }
        Ok(Self { has_agreement: true, ..self })
    }

    /// Returns the side of a cell, in metres, exactly as it was given.
    pub fn resolution(&self) -> f64 {
        self.lattice.resolution()
    }

    /// Returns how many scans the map holds: those inserted and not removed.
    pub fn scans(&self) -> u64 {
        self.inserted.count()
    }

    /// Tells whether the map keeps the magnitudes of readings.
    pub(super) fn has_agreement(&self) -> bool {
        self.has_agreement
    }

    /// Returns the sum of log-odds of a cell that scans have touched, in units of `2^-80` nats.
    pub(super) fn sum_of(&self, cell: [i64; 2]) -> i128 {
        self.sums.as_ref().map_or(0, |sums| sums.sum_of(cell))
    }

    /// Inserts a scan: along each beam, as far as the model of its range reaches, the cells it crosses.
    ///
    /// Each cell gets one reading per scan: the log-odds of the model's occupancy at the distance of its centre from the
    /// sensor, clamped to the limit of a reading; the distance is the nearest `f64`, rounded again in `f32`. A beam without
    /// return says what the model of the maximum range calls free, and nothing else. If beams of the scan disagree on a cell,
    /// occupied wins over free; otherwise the reading further from 1/2 wins. Which cells are crossed is decided without
    /// rounding between points of a lattice of `2^-28` of a cell; the chapter [`scan`](crate::book::scan) has these
    /// rules and their reasons.
    ///
    /// # Errors
    /// What `model` refuses; [`Error::Item`] naming a beam whose model gives no occupancy, or a place that is not
    /// within `2^33` cells of the origin; [`Error::TooManyCells`] if the map would exceed its limit; [`Error::NoMemory`].
    /// Then the map has not changed.
    pub fn insert<M, F>(&mut self, scan: &Scan<T>, model: F) -> Result<(), Error>
    where
        M: InverseSensorModel<Float = T>,
        F: Fn(T) -> Result<M, Error>,
    {
        self.insert_readings(scan, model).map(drop)
    }

    /// Removes a scan: the exact inverse of [`Self::insert`] with the same scan and model. The map is then, bit for bit, one
    /// that never had the scan, its rectangle of cells included ([`evidence`](crate::book::evidence)).
    ///
    /// The map knows a scan again by 64 bits of what it took from it: the place of the sensor, and the end, the free space, the
    /// return and the occupancy of the [obstacle](InverseSensorModel::obstacle) of each beam, in any order of the beams. A model
    /// of one's own that is the same in those and differs elsewhere is refused only where that shows: in cells that no other
    /// scan crossed, or by magnitudes below their sums. Else it leaves the sums of the readings inserted, less those removed.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the map does not hold the scan by this model: it was not inserted, was removed already, or had
    /// another model; [`Error::NoMemory`] if there is none for its readings; what `model` refuses. Then the map has
    /// not changed.
    ///
    /// ```
    /// use mean_information::scan::{Beam, Pose, Scan, ScanMap};
    /// use mean_information::sensor::GaussianSensor;
    /// let scan = |x, range| Scan::new(Pose::new(x, 0.27, 0.7)?, 4.0, vec![Beam { bearing: 0.3, range: Some(range) }]);
    /// let model = |range| GaussianSensor::new(range, 0.0625);
    /// let (mut map, mut alone) = (ScanMap::<f64>::new(0.25)?, ScanMap::<f64>::new(0.25)?);
    /// alone.insert(&scan(0.5, 2.0)?, model)?;
    /// map.insert(&scan(0.5, 2.0)?, model)?;
    /// map.insert(&scan(0.7, 3.5)?, model)?;
    /// map.remove(&scan(0.7, 3.5)?, model)?;
    /// assert_eq!(map, alone);
    /// let refused = map.remove(&scan(0.7, 3.5)?, model).unwrap_err();
    /// assert_eq!(refused.to_string(), "number of times that the map holds the scan by this model is 0, allowed is 1 or more");
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn remove<M, F>(&mut self, scan: &Scan<T>, model: F) -> Result<(), Error>
    where
        M: InverseSensorModel<Float = T>,
        F: Fn(T) -> Result<M, Error>,
    {
        self.remove_readings(scan, model).map(drop)
    }

    /// Inserts a scan; returns what it said of each cell.
    pub(super) fn insert_readings<M: InverseSensorModel<Float = T>>(
        &mut self,
        scan: &Scan<T>,
        model: impl Fn(T) -> Result<M, Error>,
    ) -> Result<Readings, Error> {
        let rays = Rays::new(self.lattice, self.limit, scan, model)?;
        let whole = self.sums.as_ref().map_or(rays.area(), |sums| sums.seen().union(rays.area()));
        // Before the work, which is at most what a map within the limit takes.
        whole.within(self.max_cells)?;
        let readings = rays.readings(self.max_cells)?;
        if let Some(sums) = &mut self.sums {
            sums.learn(&readings, self.max_cells)?;
            sums.grow(whole, self.max_cells)?;
            sums.add(&readings);
        } else {
            let mut sums = Sums::new(whole, self.has_agreement, self.max_cells)?;
            sums.learn(&readings, self.max_cells)?;
            sums.add(&readings);
            self.sums = Some(sums);
        }
        self.inserted.add(rays.print(), rays.area());
        Ok(readings)
    }

    /// Removes a scan; returns what it had said of each cell.
    pub(super) fn remove_readings<M: InverseSensorModel<Float = T>>(
        &mut self,
        scan: &Scan<T>,
        model: impl Fn(T) -> Result<M, Error>,
    ) -> Result<Readings, Error> {
        let refused = || {
            let what = "number of times that the map holds the scan by this model";
            Error::out_of_range(what, 0.0, "1 or more")
        };
        let rays = Rays::new(self.lattice, self.limit, scan, model)?;
        let print = rays.print();
        let Some(sums) = self.sums.as_mut().filter(|_| self.inserted.holds(print)) else {
            return Err(refused());
        };
        let readings = rays.readings(self.max_cells)?;
        let seen = sums.seen();
        let left = self.inserted.area_without(print, seen);
        // Where no other scan was, nothing is left of this one, or it was another.
        if !sums.take(&readings, left, self.max_cells)? {
            return Err(refused());
        }
        match left {
            Some(area) => sums.shrink(area),
            None => self.sums = None,
        }
        self.inserted.remove(print);
        Ok(readings)
    }
}
