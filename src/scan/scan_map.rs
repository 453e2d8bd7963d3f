//! Scans inserted into a map: log-odds of an inverse sensor model along each beam, added up exactly.

use super::beams::{Beam, Scan};
use super::lattice::{Lattice, Point};
use super::raster::{Area, Raster};
use super::traversal::{Traversal, cell_of};
use crate::cell;
use crate::error::Error;
use crate::map::encoding::{LogOdds, Probability};
use crate::map::parts;
use crate::map::repeated::Repeated;
use crate::map::{Encoding, Geometry, Grid};
use crate::real::Real;
use crate::rounded::{LOG_ODDS_SCALE, fixed_log_odds, occupancy_from_fixed_log_odds, round_log_odds};
use crate::sensor::InverseSensorModel;
use crate::tally::Tally;
use alloc::vec::Vec;
use core::marker::PhantomData;
use core::ops::Range;
#[cfg(feature = "rayon")]
use rayon::prelude::*;

/// A map that range scans are inserted into.
///
/// Cells are squares of one side, `[i r, (i + 1) r) x [j r, (j + 1) r)` for integers `i` and `j`, so that all maps of
/// one resolution share their cells. The map grows with the scans; each cell holds the sum of log-odds of the scans
/// that touched it, in integers, so any order of scans gives the same bits. Nothing known is 0: prior 1/2
/// ([`scan`](crate::book::scan)).
///
/// Memory: 16 bytes for each cell of the rectangle that was seen, and to spare half as much again on each side that
/// grew; while a scan is inserted, two floats for each cell of the rectangle of that scan, and while the map grows the
/// old and the new one.
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
#[derive(Clone, Debug)]
pub struct ScanMap<T> {
    lattice: Lattice,
    limit: i128,
    max_cells: u64,
    scans: u64,
    /// What the beams have crossed, and the sums of log-odds of an area that holds it.
    seen: Option<(Area, Raster<i128>)>,
    format: PhantomData<T>,
}

impl<T: Real> ScanMap<T> {
    /// The most cells a map may have unless the caller says otherwise: `8192 x 8192`, which take 1 GiB at 16 bytes
    /// each.
    pub const MAX_CELLS: u64 = 1 << 26;

    /// The log-odds (nats) to which a reading is limited unless the caller says otherwise: those of `p = 0.971`.
    pub const READING_LIMIT: f64 = 3.5;

    /// An empty map of cells of side `resolution` (metres).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if it is not positive and finite.
    pub fn new(resolution: f64) -> Result<Self, Error> {
        Geometry::new(resolution, [0.0; 2])?;
        let map = Self {
            lattice: Lattice::new(resolution),
            limit: 0,
            max_cells: Self::MAX_CELLS,
            scans: 0,
            seen: None,
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
        let (m, e) = limit.parts();
        let shift = e + LOG_ODDS_SCALE;
        let m = i128::from(m);
        self.limit =
            (if shift >= 0 { m << shift } else { m.checked_shr(shift.unsigned_abs()).unwrap_or(0) }).max(1);
        Ok(self)
    }

    /// Refuses scans that would make the map larger than this; [`Self::MAX_CELLS`] otherwise.
    #[must_use]
    pub fn with_max_cells(self, max_cells: u64) -> Self {
        Self { max_cells, ..self }
    }

    /// The side of a cell, in metres, exactly as it was given.
    pub fn resolution(&self) -> f64 {
        self.lattice.resolution()
    }

    /// How many scans were inserted.
    pub fn scans(&self) -> u64 {
        self.scans
    }

    /// Inserts a scan: along each beam, as far as the model of its range reaches, the cells it crosses.
    ///
    /// A cell is told the log-odds of the model's occupancy at the distance of its centre from the sensor, limited to
    /// those of a reading; the distance is the nearest `f64`, rounded again in `f32`. A beam without return tells
    /// what the model of the maximum range calls free. A cell that several beams of the scan cross is told one thing:
    /// an occupied reading before a free one, of two alike the surer. Which cells are crossed is decided without
    /// rounding between points of a lattice of `2^-28` of a cell; the chapter [`scan`](crate::book::scan) has these
    /// rules and their reasons.
    ///
    /// # Errors
    /// What `model` refuses; [`Error::Item`] naming a beam whose model gives no occupancy, or a place that is not
    /// within `2^33` cells of the origin; [`Error::TooManyCells`] if the map would exceed its limit. Then the map has
    /// not changed.
    pub fn insert<M, F>(&mut self, scan: &Scan<T>, model: F) -> Result<(), Error>
    where
        M: InverseSensorModel<Float = T>,
        F: Fn(T) -> Result<M, Error>,
    {
        let start = self.start(scan)?;
        let mut segments = Vec::with_capacity(scan.beams().len());
        let mut area = Area::of_cell(cell_of(start));
        for (index, beam) in scan.beams().iter().enumerate() {
            let segment = self.segment(scan, beam, start, &model, index)?;
            area = area.union(Area::of_cell(cell_of(segment.end)));
            segments.push(segment);
        }
        let whole = self.seen.as_ref().map_or(area, |(seen, _)| seen.union(area));
        // Before the work, which is at most what a map within the limit takes.
        whole.within(self.max_cells)?;

        let mut readings = Raster::new(area, Reading::<T>::none(), self.max_cells)?;
        for (index, segment) in segments.iter().enumerate() {
            for cell in Traversal::new(start, segment.end) {
                let reading = readings.cell_mut(cell);
                let p = if Lattice::is_within(start, cell, segment.plateau) {
                    segment.nearest
                } else {
                    if reading.rho.is_nan() {
                        reading.rho = T::nearest(self.lattice.distance_to_centre(start, cell));
                    }
                    segment.model.occupancy(reading.rho)
                };
                if !cell::in_unit_interval(p) {
                    let what = "occupancy by the model of beam";
                    return Err(Error::Item { what, index, value: p.widen(), allowed: "0 to 1" });
                }
                if segment.is_return || p < T::HALF {
                    reading.p = stronger(reading.p, p);
                }
            }
        }
        self.add(whole, &readings)
    }

    fn start(&self, scan: &Scan<T>) -> Result<Point, Error> {
        let [x, y] = scan.pose().position();
        let place = |what, x| {
            self.lattice
                .nearest(x)
                .ok_or_else(|| Error::out_of_range(what, x, "within 2^33 cells of the origin"))
        };
        Ok([place("x of the pose", x)?, place("y of the pose", y)?])
    }

    fn segment<M: InverseSensorModel<Float = T>>(
        &self,
        scan: &Scan<T>,
        beam: &Beam<T>,
        start: Point,
        model: impl Fn(T) -> Result<M, Error>,
        index: usize,
    ) -> Result<Segment<M>, Error> {
        let model = model(beam.range.unwrap_or(scan.maximum_range()))?;
        let length = if beam.range.is_some() { model.reach() } else { scan.maximum_range() }.widen();
        let far = || Error::Item {
            what: "reach of beam",
            index,
            value: length,
            allowed: "finite, ending within 2^33 cells of the origin",
        };
        if !(length >= 0.0 && length.is_finite()) {
            return Err(far());
        }
        let end = self.lattice.along(start, scan.direction(beam)?, length).ok_or_else(far)?;
        // The plateau takes some time to find: not for one that ends within a cell.
        let nearest = model.occupancy(T::zero());
        let is_flat = model.occupancy(T::nearest(self.resolution())) == nearest;
        let plateau = if is_flat { self.lattice.units_within(model.plateau().widen()) } else { 0 };
        Ok(Segment { end, model, is_return: beam.range.is_some(), nearest, plateau })
    }

    /// Adds the log-odds of the readings of one scan.
    fn add(&mut self, whole: Area, readings: &Raster<Reading<T>>) -> Result<(), Error> {
        let area = readings.area();
        match &mut self.seen {
            Some((seen, sums)) => {
                sums.make_room(*seen, whole, 0, self.max_cells)?;
                *seen = whole;
            }
            None => self.seen = Some((whole, Raster::new(area, 0, self.max_cells)?)),
        }
        if let Some((_, sums)) = &mut self.seen {
            // Neighbours often have the same.
            let mut last = (T::HALF, 0);
            for (row, readings) in (area.low()[1]..).zip(readings.rows(area)) {
                for (sum, &Reading { p, .. }) in sums.row_mut(area, row).iter_mut().zip(readings) {
                    if p == T::HALF {
                        continue;
                    }
                    if p != last.0 {
                        last = (p, fixed_log_odds(p).clamp(-self.limit, self.limit));
                    }
                    // 2^41 scans would not fill the integer.
                    *sum += last.1;
                }
            }
        }
        self.scans += 1;
        Ok(())
    }

    /// Entropy, information and counts over all cells (Eqs. 2 to 4): the bits of the tally of [`Self::log_odds`], without
    /// that map.
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

    /// [`Self::tally`] by as many threads as rayon has: the same bits for any number of them.
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

    /// How many cells the rectangle has that was seen.
    fn cells(&self) -> u64 {
        self.seen.as_ref().map_or(0, |(seen, _)| seen.cells() as u64)
    }

    /// Of some of these cells, by their numbers.
    fn tally_of(&self, cells: Range<u64>) -> Tally<T> {
        let mut tally = Tally::new();
        let Some((seen, sums)) = &self.seen else { return tally };
        let mut add = |(sum, count): (i128, u64)| {
            if let Some(cell) = LogOdds::cell(round_log_odds(sum)) {
                tally.add_many(cell, count);
            }
        };
        let mut counts = Repeated::new(cells.end - cells.start, 0);
        let (low, [width, _]) = (seen.low()[1], seen.size());
        for (row, columns) in parts::rows(cells, width, width) {
            for run in sums.row(*seen, low + row as i64)[columns].chunk_by(|a, b| a == b) {
                let sum = run[0];
                // Of the fraction and of the sign: both halves.
                let bits = sum as u64 ^ (sum >> 64) as u64;
                if let Some(lost) = counts.add(sum, bits, run.len() as u64) {
                    add(lost);
                }
            }
        }
        counts.into_counts().for_each(add);
        tally
    }

    /// The map in log-odds (nats), as large as what the beams have crossed.
    ///
    /// The log-odds of `n` scans are within `n 2^-76` nats of their exact sum, and rounded once (proved,
    /// [`scan`](crate::book::scan)).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the corner of the map is not finite.
    pub fn log_odds(&self) -> Result<Grid<LogOdds<T>>, Error> {
        self.grid(round_log_odds)
    }

    /// The same map in probabilities: within 0.501 ulp of those of the sums before these are rounded (proved,
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

    fn grid<E: Encoding>(&self, stored: impl Fn(i128) -> E::Stored) -> Result<Grid<E>, Error> {
        let Some((seen, sums)) = &self.seen else {
            return Grid::new(0, 0, Geometry::new(self.resolution(), [0.0; 2])?, Vec::new());
        };
        let origin = seen.low().map(|k| k as f64 * self.resolution());
        let [width, height] = seen.size();
        let cells = sums.rows(*seen).flatten().map(|&sum| stored(sum)).collect();
        Grid::new(width, height, Geometry::new(self.resolution(), origin)?, cells)
    }
}

/// A beam on the lattice.
struct Segment<M: InverseSensorModel> {
    end: Point,
    model: M,
    is_return: bool,
    /// What the model says of cells whose centre is at most `plateau` units of the lattice away.
    nearest: M::Float,
    plateau: u64,
}

/// What one scan says of a cell.
#[derive(Clone, Copy)]
struct Reading<T> {
    /// The distance of its centre from the sensor, once a beam asks for it: beams are many where cells are near. NaN
    /// before.
    rho: T,
    p: T,
}

impl<T: Real> Reading<T> {
    fn none() -> Self {
        Self { rho: T::nan(), p: T::HALF }
    }
}

/// Of two readings of a cell in one scan: an occupied one before a free one, the surer of two alike. In any order the
/// same.
fn stronger<T: Real>(a: T, b: T) -> T {
    if a > T::HALF || b > T::HALF { a.max(b) } else { a.min(b) }
}
