//! The beams of one scan on the lattice, and what they say of the cells that they cross: Eq. 5, or another inverse sensor model,
//! at the distance of each cell's centre, once for each cell.

use super::beams::{Beam, Scan};
use super::columns::{Canvas, Shared, Track};
use super::distances::Distances;
use super::ends::Ends;
use super::fans::{is_clockwise, shares};
use super::inserted::Print;
use super::lattice::{FRACTION, Lattice, Point, cell_of};
use super::levels::Levels;
use super::raster::Area;
use super::readings::{Drafts, Limit, Readings};
use crate::cell;
use crate::error::Error;
use crate::real::Real;
use crate::sensor::InverseSensorModel;
use alloc::collections::TryReserveError;
use alloc::vec::Vec;

/// The beams of one scan as segments from one point.
pub(super) struct Rays<M: InverseSensorModel> {
    lattice: Lattice,
    limit: Limit<M::Float>,
    start: Point,
    /// The rectangle that holds the cells of the start and of all ends.
    area: Area,
    print: Print,
    /// The occupancy with which free cells are drawn: that of the first beam that has such cells; NaN if none has.
    free: M::Float,
    /// For each beam its cells, of which those at the occupancy `free` are marked, and what it says.
    tracks: Vec<Track>,
    segments: Vec<Segment<M>>,
    /// True if bearings mostly fall from beam to beam.
    is_clockwise: bool,
}

/// What a beam says.
struct Segment<M: InverseSensorModel> {
    levels: Levels<M::Float>,
    model: M,
    is_return: bool,
}

/// The part of a cell, in units, within which the centres of cells are that a segment crosses: above `√(1/2)`.
const TO_CENTRE: u64 = 3 << (FRACTION - 2);

impl<T: Real, M: InverseSensorModel<Float = T>> Rays<M> {
    /// Places the beams of a scan on the lattice, each with the model of its range.
    ///
    /// # Errors
    /// What `model` refuses; a place beyond the lattice.
    pub(super) fn new(
        lattice: Lattice,
        limit: Limit<T>,
        scan: &Scan<T>,
        model: impl Fn(T) -> Result<M, Error>,
    ) -> Result<Self, Error> {
        let start = start(lattice, scan)?;
        let area = Area::of_cell(cell_of(start));
        let beams = scan.beams();
        let is_clockwise = is_clockwise(beams);
        let print = Print::of(&start.map(|x| x as u64));
        let (tracks, segments) = (Vec::with_capacity(beams.len()), Vec::with_capacity(beams.len()));
        let free = T::nan();
        let mut rays = Self { lattice, limit, start, area, print, free, tracks, segments, is_clockwise };
        // That of the exact sum of heading and bearing.
        let ends = Ends::new(lattice, start, scan.pose().theta());
        for (index, beam) in beams.iter().enumerate() {
            rays.add(&ends, scan.maximum_range(), beam, &model, index)?;
        }
        Ok(rays)
    }

    /// Adds one beam, with the model of its range.
    #[inline]
    fn add(
        &mut self,
        ends: &Ends,
        maximum_range: T,
        beam: &Beam<T>,
        model: impl Fn(T) -> Result<M, Error>,
        index: usize,
    ) -> Result<(), Error> {
        let Self { lattice, limit, .. } = *self;
        let range = beam.range;
        let model = model(range.unwrap_or(maximum_range))?;
        let is_return = range.is_some();
        let reach = model.reach();
        let length = if is_return { reach } else { maximum_range }.widen();
        let far = || Error::Item {
            what: "reach of beam",
            index,
            value: length,
            allowed: "finite, ending within 2^33 cells of the origin",
        };
        if !(length >= 0.0 && length.is_finite()) {
            return Err(far());
        }
        let (end, part) = ends.end(beam.bearing, length).ok_or_else(far)?;
        let nearest = model.occupancy(T::zero());
        let (nearest, plateau) = if nearest >= T::zero() && nearest <= limit.surely_free() {
            // The same reading, whatever the occupancy.
            (T::zero(), lattice.units_within(model.free_until(limit.surely_free()).widen()))
        } else if model.occupancy(T::nearest(lattice.resolution())) == nearest {
            // The plateau takes some time to find: not for one that ends within a cell.
            (nearest, lattice.units_within(model.plateau().widen()))
        } else {
            (nearest, 0)
        };
        let [x, y] = end.map(|x| x as u64);
        let levels = Levels::new(lattice, &model, reach, nearest, plateau);
        let [free, wall] = [nearest, levels.wall].map(|p| p.widen().to_bits());
        let words = [x, y, free, plateau, wall, u64::from(is_return)];
        self.print = self.print.together(Print::of(&words));
        self.area = self.area.union(Area::of_cell(cell_of(end)));
        // Cells that the segment leaves within so many units along its longer axis; the margin has room for what the part lacks.
        let sure = (plateau.saturating_sub(TO_CENTRE) as f64 * part) as i64 as u64;
        if self.free.is_nan() && sure > 0 && nearest < T::HALF && cell::in_unit_interval(nearest) {
            self.free = nearest;
        }
        self.tracks.push(Track::new(self.start, end, if nearest == self.free { sure } else { 0 }));
        self.segments.push(Segment { levels, model, is_return });
        Ok(())
    }

    /// Returns the rectangle of cells that the beams cross.
    pub(super) fn area(&self) -> Area {
        self.area
    }

    /// Returns the print of the scan: of its place, and of each beam's end, free space, obstacle and return, in any order of
    /// beams.
    pub(super) fn print(&self) -> Print {
        self.print
    }

    /// Finds what the scan says of each cell, the log-odds limited: each cell once, those at 1/2 left out.
    ///
    /// # Errors
    /// [`Error::Item`] naming a beam whose model gives no occupancy; [`Error::NoMemory`].
    pub(super) fn readings(&self, max_cells: u64) -> Result<Readings, Error> {
        let mut drafts = Drafts::new(self.area, self.free, max_cells)?;
        let mut distances = None;
        let shared = self.shared(&drafts.canvas).map_err(|_| Error::no_memory(self.area.cells()))?;
        // One after another, as what a processor guesses wrongly of one beam holds up the others.
        for (track, &shared) in self.tracks.iter().zip(&shared) {
            track.draw(shared, &mut drafts.canvas);
        }
        for (index, (track, segment)) in self.tracks.iter().zip(&self.segments).enumerate() {
            if !segment.say_levels(track, &mut drafts) {
                self.say_rest(index, &mut distances, &mut drafts)?;
            }
        }
        Ok(drafts.readings(&self.limit))
    }

    /// Says what a beam says of the cells that are not marked, one by one.
    fn say_rest(
        &self,
        index: usize,
        distances: &mut Option<Distances<T>>,
        drafts: &mut Drafts<T>,
    ) -> Result<(), Error> {
        let (track, Segment { levels, model, is_return }) = (&self.tracks[index], &self.segments[index]);
        let distances = distances.get_or_insert_with(|| Distances::new(self.lattice, self.start));
        for column in track.rest() {
            for (cell, square) in track.cells(column) {
                // At the distance of the centre (`scan.md`, "What a beam says of a cell").
                let p = levels.at(square).unwrap_or_else(|| model.occupancy(distances.of_centre(cell)));
                if !cell::in_unit_interval(p) {
                    let what = "occupancy by the model of beam";
                    return Err(Error::Item { what, index, value: p.widen(), allowed: "0 to 1" });
                }
                // A beam without return says where it is free, and nothing else.
                if p != T::HALF && (*is_return || p < T::HALF) {
                    drafts.say(cell, self.limit.canonical(p));
                }
            }
        }
        Ok(())
    }

    /// Finds what each beam shares with its neighbours on a canvas.
    fn shared(&self, canvas: &Canvas) -> Result<Vec<Shared>, TryReserveError> {
        let mut shared = Vec::new();
        shared.try_reserve_exact(self.tracks.len())?;
        if canvas.is_shared() {
            shared.extend(shares(&self.tracks, self.is_clockwise));
        }
        shared.resize(self.tracks.len(), [0; 2]);
        Ok(shared)
    }

    /// Counts the columns that beams share with both of their neighbours, in which they mark nothing.
    #[cfg(test)]
    pub(super) fn shared_columns(&self) -> u64 {
        let canvas = Canvas::new(self.area, u64::MAX).expect("a small map");
        self.shared(&canvas).expect("few beams").iter().map(|[both, _]| both).sum()
    }
}

impl<T: Real, M: InverseSensorModel<Float = T>> Segment<M> {
    /// Says what the beam says of the cells that are not marked, if these are few and all of the two levels of the drafts, or beyond;
    /// returns whether they are. No branch depends on where the wall is.
    #[inline]
    fn say_levels(&self, track: &Track, drafts: &mut Drafts<T>) -> bool {
        let Self { levels, is_return, .. } = self;
        if !*is_return || !drafts.are([levels.nearest, levels.wall]) {
            return false;
        }
        let (mut places, mut squares) = ([0; 2 * COLUMNS], [0.0; 2 * COLUMNS]);
        if !track.few(&drafts.canvas.codes, &mut places, &mut squares) {
            return false;
        }
        let (mut are_free, mut are_wall, mut are_known) = ([false; 2 * COLUMNS], [false; 2 * COLUMNS], true);
        for (k, &square) in squares.iter().enumerate() {
            are_free[k] = levels.is_near(square);
            are_wall[k] = levels.is_wall(square) && !are_free[k];
            are_known &= are_free[k] | are_wall[k] | levels.is_beyond(square);
        }
        if are_known {
            drafts.say_levels(&places, &are_free, &are_wall);
        }
        are_known
    }
}

/// So many columns are looked at together: all that end a beam whose wall is a cell thick.
const COLUMNS: usize = 3;

/// Finds the place of the sensor.
fn start<T: Real>(lattice: Lattice, scan: &Scan<T>) -> Result<Point, Error> {
    let [x, y] = scan.pose().position();
    let place = |what, x| {
        lattice.nearest(x).ok_or_else(|| Error::out_of_range(what, x, "within 2^33 cells of the origin"))
    };
    Ok([place("x of the pose", x)?, place("y of the pose", y)?])
}

#[cfg(test)]
mod tests {
    use super::super::pose::Pose;
    use super::super::scan_map::ScanMap;
    use super::*;
    use crate::sensor::SteppedSensor;
    use core::cell::Cell;

    /// Steps that count how often they are asked.
    struct Asked<'a>(SteppedSensor<f64>, &'a Cell<u64>);

    impl InverseSensorModel for Asked<'_> {
        type Float = f64;

        fn occupancy(&self, rho: f64) -> f64 {
            self.1.set(self.1.get() + 1);
            self.0.occupancy(rho)
        }

        fn reach(&self) -> f64 {
            self.0.reach()
        }

        fn plateau(&self) -> f64 {
            self.0.plateau()
        }

        fn obstacle(&self) -> Option<([f64; 2], f64)> {
            self.0.obstacle()
        }
    }

    /// The beams of a scan in a room, 5 cm to a cell, whose walls are as thick; the first is given, and free space by its range.
    fn rays<M: InverseSensorModel<Float = f64>>(
        first: Beam<f64>,
        model: impl Fn(SteppedSensor<f64>) -> M,
    ) -> Rays<M> {
        let beam = |k: u32| {
            let bearing = f64::from(k) * 0.02;
            Beam { bearing, range: Some(2.0 + 0.25 * bearing) }
        };
        let pose = Pose::new(0.61, -0.37, 0.1).unwrap();
        let scan = Scan::new(pose, 9.0, core::iter::once(first).chain((1..300).map(beam)).collect()).unwrap();
        let map = ScanMap::<f64>::new(0.05).unwrap();
        let steps = |range| SteppedSensor::new(range, 0.05, if range < 0.1 { 0.375 } else { 0.25 }, 0.875);
        Rays::new(map.lattice, map.limit, &scan, |range| Ok(model(steps(range)?))).unwrap()
    }

    /// A model with its levels is asked at 0 and at the side of a cell, and no more; and all beams but the first wall, which is
    /// the level of the others, are said at once.
    #[test]
    fn levels_are_said_at_once_and_of_no_cell_is_the_model_asked() {
        let asked = Cell::new(0);
        let rays = rays(Beam { bearing: 0.0, range: Some(2.0) }, |steps| Asked(steps, &asked));
        assert_eq!(asked.get(), 600);
        let mut drafts = Drafts::new(rays.area, rays.free, u64::MAX).unwrap();
        for (index, (track, segment)) in rays.tracks.iter().zip(&rays.segments).enumerate() {
            let is_said = segment.say_levels(track, &mut drafts);
            assert_eq!(is_said, index > 0, "{index}");
            if !is_said {
                rays.say_rest(index, &mut None, &mut drafts).unwrap();
            }
        }
        assert_eq!(asked.get(), 600);
    }

    /// A first beam that ends in the cell of the sensor, where free space is another to it, does not keep the others from being drawn.
    #[test]
    fn a_beam_without_free_cells_does_not_tell_what_is_drawn() {
        let rays = rays(Beam { bearing: 0.0, range: Some(0.03) }, |steps| steps);
        assert_eq!(rays.free, 0.25);
        assert!(rays.shared_columns() > 1000);
    }
}
