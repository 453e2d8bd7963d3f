//! The beams of one scan on the lattice, and what they say of the cells that they cross: Eq. 5, or another inverse sensor model,
//! at the distance of each cell's centre, once for each cell.

use super::beams::{Beam, Scan};
use super::columns::{Canvas, Shared, Track};
use super::distances::Distances;
use super::ends::Ends;
use super::fans::{is_clockwise, shares};
use super::inserted::Print;
use super::lattice::{FRACTION, Lattice, Point};
use super::raster::Area;
use super::readings::{Drafts, Limit, Readings};
use super::traversal::cell_of;
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
    segments: Vec<Segment<M>>,
    /// True if bearings mostly fall from beam to beam.
    is_clockwise: bool,
}

/// A beam on the lattice.
struct Segment<M: InverseSensorModel> {
    end: Point,
    model: M,
    is_return: bool,
    /// The occupancy of cells whose centre is at most `plateau` units of the lattice from the sensor.
    nearest: M::Float,
    plateau: u64,
    /// Cells that the segment leaves within so many units along its longer axis are among them.
    sure: u64,
    /// The squares of the distances from and to which cells have the occupancy `wall`, in units; 1 to 0 if there are none.
    obstacle: [u128; 2],
    wall: M::Float,
    /// The square of a distance beyond which nothing is observed.
    reach: u128,
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
        let segments = Vec::with_capacity(beams.len());
        let mut rays = Self { lattice, limit, start, area, segments, is_clockwise };
        // That of the exact sum of heading and bearing.
        let ends = Ends::new(lattice, start, scan.pose().theta());
        for (index, beam) in beams.iter().enumerate() {
            let segment = rays.segment(&ends, scan.maximum_range(), beam, &model, index)?;
            rays.area = rays.area.union(Area::of_cell(cell_of(segment.end)));
            rays.segments.push(segment);
        }
        Ok(rays)
    }

    /// Places one beam, with the model of its range.
    #[inline]
    fn segment(
        &self,
        ends: &Ends,
        maximum_range: T,
        beam: &Beam<T>,
        model: impl Fn(T) -> Result<M, Error>,
        index: usize,
    ) -> Result<Segment<M>, Error> {
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
        // The margin has room for what the part lacks.
        let sure = (plateau.saturating_sub(TO_CENTRE) as f64 * part) as u64;
        let (obstacle, wall) = match model.obstacle() {
            Some(([from, to], p)) => {
                let to = u128::from(lattice.units_within(to.widen()));
                ([lattice.square_beyond(from.widen()), to * to], p)
            }
            None => ([1, 0], T::HALF),
        };
        // A distance beyond the next float is beyond this one when it is rounded.
        let (m, e) = reach.parts();
        let reach = lattice.square_beyond(T::from_parts(m + 1, e).widen());
        Ok(Segment { end, model, is_return, nearest, plateau, sure, obstacle, wall, reach })
    }

    /// Returns the rectangle of cells that the beams cross.
    pub(super) fn area(&self) -> Area {
        self.area
    }

    /// Returns the print of the scan: of its place, and of each beam's end, free space and return, in any order of beams.
    pub(super) fn print(&self) -> Print {
        let place = Print::of(&self.start.map(|x| x as u64));
        self.segments.iter().fold(place, |print, segment| {
            let [x, y] = segment.end.map(|x| x as u64);
            let nearest = segment.nearest.widen().to_bits();
            print.together(Print::of(&[x, y, nearest, segment.plateau, u64::from(segment.is_return)]))
        })
    }

    /// Finds what the scan says of each cell, the log-odds limited: each cell once, those at 1/2 left out.
    ///
    /// # Errors
    /// [`Error::Item`] naming a beam whose model gives no occupancy; [`Error::TooManyCells`] if there is no memory.
    pub(super) fn readings(&self, max_cells: u64) -> Result<Readings, Error> {
        let free = self.free();
        let mut drafts = Drafts::new(self.area, free, max_cells)?;
        let refused = |_| Error::too_many_cells(self.area.cells(), max_cells);
        let tracks = self.tracks(free).map_err(refused)?;
        let shared = self.shared(&tracks, &drafts.canvas).map_err(refused)?;
        let mut distances = Distances::new(self.lattice, self.start);
        for (index, ((segment, track), shared)) in self.segments.iter().zip(&tracks).zip(shared).enumerate() {
            for cell in track.draw(shared, &mut drafts.canvas) {
                let p = self.occupancy(segment, cell, &mut distances);
                if !cell::in_unit_interval(p) {
                    let what = "occupancy by the model of beam";
                    return Err(Error::Item { what, index, value: p.widen(), allowed: "0 to 1" });
                }
                // A beam without return says where it is free, and nothing else.
                if p != T::HALF && (segment.is_return || p < T::HALF) {
                    drafts.say(cell, self.limit.canonical(p));
                }
            }
        }
        Ok(drafts.readings(&self.limit))
    }

    /// Returns the occupancy with which free cells are drawn: that of the first beam that has such cells; NaN if none has.
    fn free(&self) -> T {
        let is_free = |segment: &&Segment<M>| {
            segment.sure > 0 && segment.nearest < T::HALF && cell::in_unit_interval(segment.nearest)
        };
        self.segments.iter().find(is_free).map_or(T::nan(), |segment| segment.nearest)
    }

    /// Measures the beams, whose sure cells are those at the occupancy `free`.
    fn tracks(&self, free: T) -> Result<Vec<Track>, TryReserveError> {
        let track = |segment: &Segment<M>| {
            let sure = if segment.nearest == free { segment.sure } else { 0 };
            Track::new(self.start, segment.end, sure)
        };
        let mut tracks = Vec::new();
        tracks.try_reserve_exact(self.segments.len())?;
        tracks.extend(self.segments.iter().map(track));
        Ok(tracks)
    }

    /// Finds what each beam shares with its neighbours on a canvas.
    fn shared(&self, tracks: &[Track], canvas: &Canvas) -> Result<Vec<Shared>, TryReserveError> {
        let mut shared = Vec::new();
        shared.try_reserve_exact(tracks.len())?;
        if canvas.is_shared() {
            shared.extend(shares(tracks, self.is_clockwise));
        }
        shared.resize(tracks.len(), [0; 2]);
        Ok(shared)
    }

    /// Counts the columns that beams share with both of their neighbours, in which they mark nothing.
    #[cfg(test)]
    pub(super) fn shared_columns(&self) -> u64 {
        let free = self.free();
        let canvas = Canvas::new(self.area, u64::MAX).expect("a small map");
        let shared = self.tracks(free).and_then(|tracks| self.shared(&tracks, &canvas)).expect("few beams");
        shared.iter().map(|[both, _]| both).sum()
    }

    /// Returns what a beam says of a cell that it crosses: what its model says at the distance of the centre. Where the model is
    /// level, nobody needs the distance (`scan.md`, "What a beam says of a cell").
    #[inline]
    fn occupancy(&self, segment: &Segment<M>, cell: [i64; 2], distances: &mut Distances<T>) -> T {
        let square = Lattice::square_to_centre(self.start, cell);
        let [near, far] = segment.obstacle;
        if square <= u128::from(segment.plateau) * u128::from(segment.plateau) {
            segment.nearest
        } else if near <= square && square <= far {
            segment.wall
        } else if square > segment.reach {
            T::HALF
        } else {
            segment.model.occupancy(distances.of_centre(cell))
        }
    }
}

/// Finds the place of the sensor.
fn start<T: Real>(lattice: Lattice, scan: &Scan<T>) -> Result<Point, Error> {
    let [x, y] = scan.pose().position();
    let place = |what, x| {
        lattice.nearest(x).ok_or_else(|| Error::out_of_range(what, x, "within 2^33 cells of the origin"))
    };
    Ok([place("x of the pose", x)?, place("y of the pose", y)?])
}
