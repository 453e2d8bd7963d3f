//! The beams of one scan on the lattice, and what they say of the cells that they cross: Eq. 5, or another inverse sensor model,
//! at the distance of each cell's centre, once for each cell.

use super::beams::{Beam, Scan};
use super::inserted::Print;
use super::lattice::{Lattice, Point};
use super::raster::{Area, Raster};
use super::traversal::{Traversal, cell_of};
use crate::cell;
use crate::error::Error;
use crate::real::Real;
use crate::rounded::fixed_log_odds;
use crate::sensor::InverseSensorModel;
use alloc::vec::Vec;

/// The beams of one scan as segments from one point.
pub(super) struct Rays<M: InverseSensorModel> {
    lattice: Lattice,
    start: Point,
    /// The rectangle that holds the cells of the start and of all ends.
    area: Area,
    segments: Vec<Segment<M>>,
}

/// A beam on the lattice.
struct Segment<M: InverseSensorModel> {
    end: Point,
    model: M,
    is_return: bool,
    /// The occupancy of cells whose centre is at most `plateau` units of the lattice from the sensor.
    nearest: M::Float,
    plateau: u64,
}

/// The reading of one cell by one scan: log-odds in units of `2^-80` nats, not 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reading {
    pub(super) cell: [i64; 2],
    pub(super) log_odds: i128,
}

/// The reading of a cell by the beams so far.
#[derive(Clone, Copy)]
struct Draft<T> {
    /// The distance of its centre from the sensor, once a beam asks for it: beams are many where cells are near. NaN
    /// before.
    rho: T,
    p: T,
}

impl<T: Real, M: InverseSensorModel<Float = T>> Rays<M> {
    /// Places the beams of a scan on the lattice, each with the model of its range.
    ///
    /// # Errors
    /// What `model` refuses; a place beyond the lattice.
    pub(super) fn new(
        lattice: Lattice,
        scan: &Scan<T>,
        model: impl Fn(T) -> Result<M, Error>,
    ) -> Result<Self, Error> {
        let start = start(lattice, scan)?;
        let mut segments = Vec::with_capacity(scan.beams().len());
        let mut area = Area::of_cell(cell_of(start));
        for (index, beam) in scan.beams().iter().enumerate() {
            let segment = segment(lattice, scan, beam, start, &model, index)?;
            area = area.union(Area::of_cell(cell_of(segment.end)));
            segments.push(segment);
        }
        Ok(Self { lattice, start, area, segments })
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

    /// Finds what the scan says of each cell, the log-odds limited to `-limit..=limit` units: each cell once, those at 1/2 left
    /// out.
    ///
    /// # Errors
    /// [`Error::Item`] naming a beam whose model gives no occupancy; [`Error::TooManyCells`] if there is no memory.
    pub(super) fn readings(&self, limit: i128, max_cells: u64) -> Result<Vec<Reading>, Error> {
        let mut drafts = Raster::new(self.area, Draft { rho: T::nan(), p: T::HALF }, max_cells)?;
        // The cells that are not at 1/2: a hundredth of the rectangle where beams are few.
        let mut touched = Vec::new();
        for (index, segment) in self.segments.iter().enumerate() {
            for cell in Traversal::new(self.start, segment.end) {
                let draft = drafts.cell_mut(cell);
                // Where the model is level, nobody needs the distance; `scan.md`, "What a beam says of a cell".
                let p = if Lattice::is_within(self.start, cell, segment.plateau) {
                    segment.nearest
                } else {
                    if draft.rho.is_nan() {
                        // The nearest float on the lattice, in f32 rounded once more.
                        draft.rho = T::nearest(self.lattice.distance_to_centre(self.start, cell));
                    }
                    segment.model.occupancy(draft.rho)
                };
                if !cell::in_unit_interval(p) {
                    let what = "occupancy by the model of beam";
                    return Err(Error::Item { what, index, value: p.widen(), allowed: "0 to 1" });
                }
                // A beam without return says where it is free, and nothing else.
                if p != T::HALF && (segment.is_return || p < T::HALF) {
                    if draft.p == T::HALF {
                        touched.push(cell);
                    }
                    draft.p = stronger(draft.p, p);
                }
            }
        }
        // Neighbours often have the same.
        let mut last = (T::HALF, 0);
        let reading = |cell| {
            let p = drafts.cell(cell).p;
            if p != last.0 {
                // From floats to units of 2^-80 nats, within 2^4 of them: `scan.md`, "The sum".
                last = (p, fixed_log_odds(p).clamp(-limit, limit));
            }
            Reading { cell, log_odds: last.1 }
        };
        Ok(touched.into_iter().map(reading).collect())
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

/// Places one beam, with the model of its range.
fn segment<T: Real, M: InverseSensorModel<Float = T>>(
    lattice: Lattice,
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
    let end = lattice.along(start, scan.direction(beam)?, length).ok_or_else(far)?;
    // The plateau takes some time to find: not for one that ends within a cell.
    let nearest = model.occupancy(T::zero());
    let is_flat = model.occupancy(T::nearest(lattice.resolution())) == nearest;
    let plateau = if is_flat { lattice.units_within(model.plateau().widen()) } else { 0 };
    Ok(Segment { end, model, is_return: beam.range.is_some(), nearest, plateau })
}

/// Chooses between two readings of a cell in one scan: an occupied one before a free one, the surer of two alike. In any order
/// the same, and never 1/2 if one of them is not.
fn stronger<T: Real>(a: T, b: T) -> T {
    if a > T::HALF || b > T::HALF { a.max(b) } else { a.min(b) }
}
