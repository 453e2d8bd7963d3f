//! Distances of cells from the sensor, which neighbouring beams ask for one after another.

use super::lattice::{Lattice, Point};
use crate::real::Real;

/// The number of columns, and of rows, whose cells are kept apart, as a mask.
const MASK: i64 = 15;

/// The last distance asked for of the cells at each column and row modulo 16.
pub(super) struct Distances<T> {
    lattice: Lattice,
    start: Point,
    last: [([i64; 2], T); 256],
}

impl<T: Real> Distances<T> {
    /// Creates those from a point, none of which is known.
    pub(super) fn new(lattice: Lattice, start: Point) -> Self {
        // No cell: those within the lattice are below 2^33.
        Self { lattice, start, last: [([i64::MIN; 2], T::zero()); 256] }
    }

    /// Returns the distance in metres to the centre of a cell: the nearest float, in `f32` rounded once more.
    #[inline]
    pub(super) fn of_centre(&mut self, cell: [i64; 2]) -> T {
        let last = &mut self.last[((cell[1] & MASK) << 4 | cell[0] & MASK) as usize];
        if last.0 != cell {
            *last = (cell, T::nearest(self.lattice.distance_to_centre(self.start, cell)));
        }
        last.1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cells that share a place, on both sides of the origin, each twice and in turn.
    #[test]
    fn each_cell_has_its_own() {
        let (lattice, start) = (Lattice::new(0.05), [1 << 27, 3 << 40]);
        let mut distances = Distances::<f32>::new(lattice, start);
        for k in 0..2000_i64 {
            let cell = [k * 7 % 33 - 16, k / 2 * 5 % 35 - 17];
            for cell in [cell, cell, [cell[0] + 16, cell[1]], [cell[0], cell[1] - 16], cell] {
                let expected = f32::nearest(lattice.distance_to_centre(start, cell));
                assert_eq!(distances.of_centre(cell), expected, "{cell:?}");
            }
        }
    }
}
