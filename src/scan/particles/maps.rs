//! The maps of a filter's particles: for each cell the pattern of what they say.

use super::draft::{Draft, Drafts};
use super::index::no_number;
use super::patterns::Patterns;
use super::values::{Value, Values};
use crate::cell::Cell;
use crate::error::Error;
use crate::map::Grid;
use crate::map::encoding::LogOdds;
use crate::real::Real;
use crate::rounded::round_log_odds;
use crate::scan::beams::Scan;
use crate::scan::raster::{Area, Raster};
use crate::scan::scan_map::ScanMap;
use crate::sensor::InverseSensorModel;
use crate::tally::Tally;
use alloc::{vec, vec::Vec};
use core::ops::Range;

/// The maps of the particles of a filter, which share all that they have in common.
///
/// Each particle has the map that a [`ScanMap`] would be, bit for bit: the sums of log-odds of the scans on its way. Kept is for
/// each cell the number of a *pattern*, the list of what the particles say of it, and each pattern once. Particles that are
/// [resampled](Self::resample) take their maps along by that alone; a scan is inserted once for each particle that matched it,
/// however many continue that one. The expected map is
/// measured pattern by pattern ([`Self::expected_tally`]); the chapter [`expected`](crate::book::expected) says what it costs.
///
/// Memory, for `n` particles:
/// * 4 bytes for each cell of the rectangle that any of them has seen, and half as much again on each side that grew;
/// * `4 n` bytes, and 40 to 80 beside them, for each pattern; one in four or more has a cell, or there are few;
/// * some 120 bytes for each sum of log-odds that occurs;
/// * while scans are inserted, up to two bytes for each cell of each scan's rectangle, `4 n` for each that any of them touches,
///   and 4 for each cell of the rectangle of them all.
///
/// ```
/// use mean_information::scan::{Beam, ParticleMaps, Pose, Scan, ScanMap};
/// use mean_information::sensor::SteppedSensor;
///
/// let scan = |x| Scan::new(Pose::new(x, 0.12, 0.0)?, 4.0, vec![Beam { bearing: 0.0, range: Some(1.0) }]);
/// let model = |range| SteppedSensor::new(range, 0.25, 0.25, 0.875);
/// // Two particles, the second one a cell further on.
/// let mut maps = ParticleMaps::new(ScanMap::<f64>::new(0.25)?, 2)?;
/// maps.insert(&[scan(0.13)?, scan(0.38)?], model)?;
/// let emmi = maps.expected_tally(&[0.75, 0.25])?.mean_information();
/// assert_eq!(format!("{emmi:.12}"), "0.139748258877"); // bits per observed cell
/// // Both continue the second: they agree.
/// maps.resample(&[1, 1])?;
/// let own = maps.tally(0).map(|tally| tally.mean_information());
/// assert_eq!(own, Some(0.24226461179277445));
/// let emmi = maps.expected_tally(&[0.75, 0.25])?.mean_information();
/// assert_eq!(format!("{emmi:.12}"), "0.242264611793");
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct ParticleMaps<T> {
    /// An empty map, which has the resolution and the limits.
    empty: ScanMap<T>,
    particles: Vec<Particle<T>>,
    /// The rectangle that particles have seen, those too that no one continues, and the pattern of each of its cells.
    cells: Option<(Area, Raster<u32>)>,
    values: Values<T>,
    patterns: Patterns,
}

/// The rectangle of a particle's map, `None` before the first scan, and its tally.
#[derive(Clone, Debug)]
struct Particle<T> {
    seen: Option<Area>,
    tally: Tally<T>,
}

impl<T: Real> ParticleMaps<T> {
    /// Creates the empty maps of `particles` particles, with the resolution and the limits of `empty`; the limit on cells is one
    /// on those that any particle has seen. Agreement is not kept.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if there is no particle, or `empty` holds scans.
    pub fn new(empty: ScanMap<T>, particles: usize) -> Result<Self, Error> {
        if empty.scans() > 0 {
            let (what, scans) = ("number of scans of the map of all particles", empty.scans() as f64);
            return Err(Error::out_of_range(what, scans, "0"));
        }
        if particles == 0 {
            return Err(no_particle());
        }
        Ok(Self {
            empty,
            particles: vec![Particle { seen: None, tally: Tally::new() }; particles],
            cells: None,
            values: Values::new(),
            patterns: Patterns::new(particles),
        })
    }

    /// Returns the number of particles.
    pub fn particles(&self) -> usize {
        self.particles.len()
    }

    /// Inserts a scan into the map of each particle, from its own pose: the bits of [`ScanMap::insert`] (proved,
    /// [`scan`](crate::book::scan)).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if there is not one scan for each particle; those of [`ScanMap::insert`]; [`Error::TooManyCells`]
    /// if the cells that any particle has seen would exceed the limit; [`Error::NoMemory`]. Then no map has changed.
    pub fn insert<M, F>(&mut self, scans: &[Scan<T>], model: F) -> Result<(), Error>
    where
        M: InverseSensorModel<Float = T>,
        F: Fn(T) -> Result<M, Error>,
    {
        let of = |scan| Draft::of(&self.empty, scan, &model);
        let drafts = scans.iter().map(of).collect::<Result<Vec<_>, _>>()?;
        self.insert_drafts(&drafts)
    }

    /// Inserts as [`Self::insert`] does, by as many threads as rayon has: the same bits for any number of them.
    ///
    /// # Errors
    /// Those of [`Self::insert`].
    ///
    /// ```
    /// use mean_information::scan::{Beam, ParticleMaps, Pose, Scan, ScanMap};
    /// use mean_information::sensor::SteppedSensor;
    /// let beam = Beam { bearing: 0.0, range: Some(1.0) };
    /// let scans = [Scan::new(Pose::new(0.13, 0.12, 0.0)?, 4.0, vec![beam])?, Scan::new(Pose::new(0.38, 0.12, 0.0)?, 4.0, vec![beam])?];
    /// let mut maps = ParticleMaps::new(ScanMap::<f64>::new(0.25)?, 2)?;
    /// maps.par_insert(&scans, |range| SteppedSensor::new(range, 0.25, 0.25, 0.875))?;
    /// let emmi = maps.par_expected_tally(&[0.75, 0.25])?.mean_information();
    /// assert_eq!(format!("{emmi:.12}"), "0.139748258877");
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    #[cfg(feature = "rayon")]
    pub fn par_insert<M, F>(&mut self, scans: &[Scan<T>], model: F) -> Result<(), Error>
    where
        M: InverseSensorModel<Float = T>,
        F: Fn(T) -> Result<M, Error> + Sync,
    {
        use rayon::prelude::*;
        let of = |scan| Draft::of(&self.empty, scan, &model);
        let drafts: Vec<_> = scans.par_iter().map(of).collect();
        // Of several refusals the first, whichever came first.
        self.insert_drafts(&drafts.into_iter().collect::<Result<Vec<_>, _>>()?)
    }

    /// Inserts what each particle's scan says.
    fn insert_drafts(&mut self, drafts: &[Draft]) -> Result<(), Error> {
        if drafts.len() != self.particles.len() {
            let (what, allowed) = ("number of scans", "one for each particle");
            return Err(Error::out_of_range(what, drafts.len() as f64, allowed));
        }
        let limit = self.empty.max_cells;
        let Some(area) = drafts.iter().map(|draft| draft.area).reduce(Area::union) else { return Ok(()) };
        let (used, raster) = match &mut self.cells {
            Some(cells) => cells,
            none => none.insert((area, Raster::new(area, 0, limit)?)),
        };
        // Room that is not used is nothing to a map: what is used grows when all is known to go in.
        let whole = used.union(area);
        raster.make_room(*used, whole, 0, limit)?;
        let mut touched = Drafts::new(drafts.len(), area, limit)?;
        let mut changes = Vec::with_capacity(drafts.len());
        for (particle, draft) in drafts.iter().enumerate() {
            changes.push(touched.apply(particle, draft, raster, &self.patterns, &mut self.values)?);
        }
        let new = touched.numbers(&mut self.patterns)?;
        // From here on nothing is refused.
        *used = whole;
        for (&(cell, old), new) in touched.cells().iter().zip(new) {
            *raster.cell_mut(cell) = new;
            self.patterns.remove(old);
            self.patterns.add(new, 1);
        }
        for ((particle, draft), changes) in self.particles.iter_mut().zip(drafts).zip(changes) {
            particle.grow(draft.area);
            let changed = |&(value, change): &(u32, i64)| (self.values.get(value).cell, change);
            // In before out: a tally never lacks what is taken out.
            for (cell, change) in changes.iter().map(changed).filter(|&(_, change)| change > 0) {
                particle.tally.add_many(cell, change.unsigned_abs());
            }
            for (cell, change) in changes.iter().map(changed).filter(|&(_, change)| change < 0) {
                particle.tally.remove_many(cell, change.unsigned_abs())?;
            }
        }
        if self.patterns.are_stale() {
            self.continue_as(&(0..self.particles.len()).collect::<Vec<_>>())?;
        }
        Ok(())
    }

    /// Continues particles, each as often as it stands in `continued`, with their maps; the others are dropped. The number of
    /// particles is that of the list.
    ///
    /// # Errors
    /// [`Error::Item`] naming the first that is no particle; [`Error::OutOfRange`] if there is none. Then nothing has changed.
    pub fn resample(&mut self, continued: &[usize]) -> Result<(), Error> {
        if continued.is_empty() {
            return Err(no_particle());
        }
        if let Some(index) = continued.iter().position(|&particle| particle >= self.particles.len()) {
            let (what, value) = ("resampled particle", continued[index] as f64);
            return Err(Error::Item { what, index, value, allowed: "a particle, counted from 0" });
        }
        self.continue_as(continued)
    }

    /// Continues particles that there are; patterns and values of no cell are dropped.
    fn continue_as(&mut self, continued: &[usize]) -> Result<(), Error> {
        let (mut patterns, mut values) = (Patterns::new(continued.len()), Values::new());
        let mut new_values = vec![None; self.values.len()];
        let mut new_numbers = vec![0; self.patterns.len()];
        let mut list = Vec::with_capacity(continued.len());
        for (number, new) in (0..).zip(&mut new_numbers) {
            let cells = self.patterns.count(number);
            if cells == 0 {
                continue;
            }
            list.clear();
            for &particle in continued {
                let value = self.patterns.values(number)[particle];
                let known = new_values[value as usize];
                let same = known.or_else(|| values.number(self.values.get(value).sum));
                new_values[value as usize] = same;
                list.push(same.ok_or_else(no_number)?);
            }
            *new = patterns.number(&list).ok_or_else(no_number)?;
            patterns.add(*new, cells);
        }
        if let Some((used, raster)) = &mut self.cells {
            raster.map_in(*used, |number| new_numbers[number as usize]);
        }
        (self.patterns, self.values) = (patterns, values);
        self.particles = continued.iter().map(|&particle| self.particles[particle].clone()).collect();
        Ok(())
    }

    /// Returns the tally of a particle's map, the bits of [`ScanMap::tally`]; `None` if there is no such particle.
    pub fn tally(&self, particle: usize) -> Option<&Tally<T>> {
        self.particles.get(particle).map(|particle| &particle.tally)
    }

    /// Returns the map of a particle in log-odds (nats): the bits and the place of [`ScanMap::log_odds`] (proved,
    /// [`scan`](crate::book::scan)).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if there is no such particle, or the corner of the map is not finite.
    ///
    /// ```
    /// use mean_information::scan::{ParticleMaps, ScanMap};
    /// let maps = ParticleMaps::new(ScanMap::<f64>::new(0.25)?, 2)?;
    /// assert_eq!(maps.log_odds(1)?, ScanMap::<f64>::new(0.25)?.log_odds()?);
    /// assert!(maps.log_odds(2).is_err());
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn log_odds(&self, particle: usize) -> Result<Grid<LogOdds<T>>, Error> {
        let Some(of) = self.particles.get(particle) else {
            return Err(Error::out_of_range("particle", particle as f64, "one that there is"));
        };
        let ([width, height], geometry) = self.empty.place_of(of.seen)?;
        let mut cells = Vec::with_capacity(width * height);
        if let (Some(seen), Some((_, raster))) = (of.seen, &self.cells) {
            let value = |&number: &u32| self.values.get(self.patterns.values(number)[particle]);
            let stored = |number| round_log_odds::<T>(value(number).sum);
            cells.extend(raster.rows(seen).flatten().map(stored));
        }
        Grid::new(width, height, geometry, cells)
    }

    /// Counts the cells of the least rectangle that holds the maps of all particles.
    pub(crate) fn cells(&self) -> u64 {
        let seen = self.particles.iter().filter_map(|particle| particle.seen);
        seen.reduce(Area::union).map_or(0, |area| area.cells() as u64)
    }

    /// Returns how many patterns there are, by their numbers.
    pub(crate) fn patterns(&self) -> u64 {
        self.patterns.len() as u64
    }

    /// Returns some patterns, those with cells: the value of each particle, and the number of cells.
    pub(crate) fn patterns_in(&self, numbers: Range<u64>) -> impl Iterator<Item = (&[u32], u64)> {
        let numbers = numbers.start as u32..numbers.end as u32;
        let all = numbers.map(|number| (self.patterns.values(number), self.patterns.count(number)));
        all.filter(|&(_, cells)| cells > 0)
    }

    /// Returns how many values there are, by their numbers.
    pub(crate) fn values(&self) -> usize {
        self.values.len()
    }

    /// Returns the occupancy of a value: that of the float nearest to the sum of log-odds.
    pub(crate) fn occupancy(&self, value: u32) -> T {
        let Value { occupancy, .. } = self.values.get(value);
        *occupancy
    }
}

impl<T: Real> Particle<T> {
    /// Grows by what a scan has crossed: by cells of which nothing is known.
    fn grow(&mut self, area: Area) {
        let before = self.seen.map_or(0, Area::cells);
        let seen = self.seen.map_or(area, |seen| seen.union(area));
        self.seen = Some(seen);
        self.tally.add_many(Cell::unknown(), (seen.cells() - before) as u64);
    }
}

/// Creates the error of particles of which there is none.
fn no_particle() -> Error {
    Error::out_of_range("number of particles", 0.0, "1 or more")
}
