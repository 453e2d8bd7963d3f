//! The cells of a grid along one axis, in the order of their distance from the sensor.

use crate::real::Real;
use crate::rounded::Coordinate;
use core::ops::Range;

/// The cells along an axis, with their centres at `i + offset`, `i` an integer, and equally many samples in each. Lengths
/// are in cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis<T> {
    /// The offset in `[-1/2, 1/2]`: whole cells do not matter.
    offset: T,
    per_side: u32,
}

impl<T: Real> Axis<T> {
    /// Creates the axis of a finite offset, with `per_side` samples in a cell.
    pub(super) fn new(offset: T, per_side: u32) -> Self {
        // Both steps are exact.
        let rest = offset % T::one();
        let whole = if rest.abs() > T::HALF { rest.signum() } else { T::zero() };
        Self { offset: rest - whole, per_side }
    }

    /// Returns whether each cell has a mirror image, except a cell centred on the sensor.
    fn is_symmetric(&self) -> bool {
        self.offset.is_zero() || self.is_half()
    }

    /// Returns whether the sensor is on a side of a cell.
    fn is_half(&self) -> bool {
        self.offset.abs() == T::HALF
    }

    /// Returns whether both axes have the same distances of cells.
    pub(super) fn has_the_distances_of(&self, other: &Self) -> bool {
        self.offset.abs() == other.offset.abs()
    }

    /// Returns the number of cells at the `count` nearest distances.
    pub(super) fn cells(&self, count: u64) -> u64 {
        match (self.is_symmetric(), self.is_half()) {
            (false, _) => count,
            (true, true) => 2 * count,
            (true, false) => (2 * count).saturating_sub(1),
        }
    }

    /// Returns the indices `i` of the cells at the `count` nearest distances.
    pub(super) fn indices(&self, count: u64) -> Range<i64> {
        let (cells, before) = (self.cells(count) as i64, self.cells(count) as i64 / 2);
        let start = if self.offset < T::zero() { before + 1 - cells } else { -before };
        start..start + cells
    }

    /// Returns a cell at the distance of rank `order`, from 0 for the nearest, on either side.
    pub(super) fn nearest(&self, order: u64) -> AxisCell<T> {
        let offset = self.offset.abs();
        if self.is_symmetric() {
            self.cell(order as i64, offset)
        } else {
            let side = if order.is_multiple_of(2) { offset } else { -offset };
            self.cell(order.div_ceil(2) as i64, side)
        }
    }

    /// Returns the cell of index `i`.
    pub(super) fn at(&self, i: i64) -> AxisCell<T> {
        self.cell(i, self.offset)
    }

    /// Returns the coordinate of the centre of cell `i` in cells, rounded.
    pub(super) fn centre(&self, i: i64) -> f64 {
        i as f64 + self.offset.widen()
    }

    /// Returns cell `i` of the axis with this offset.
    fn cell(&self, i: i64, offset: T) -> AxisCell<T> {
        let n = i64::from(self.per_side);
        let two_n = T::from_parts(2 * u64::from(self.per_side), 0);
        AxisCell { first: 2 * n * i + 1 - n, samples: self.per_side, offset: offset * two_n }
    }
}

/// The extent of a cell along an axis. The unit of length is half the distance of neighbouring samples.
#[derive(Clone, Copy, Debug)]
pub(super) struct AxisCell<T> {
    /// The place of the first sample, less `offset`.
    first: i64,
    samples: u32,
    offset: T,
}

impl<T: Real> AxisCell<T> {
    /// Returns the coordinate of sample `k`.
    fn sample(&self, k: u32) -> Coordinate {
        Coordinate::new(self.first + 2 * i64::from(k), self.offset)
    }

    /// Returns the coordinates of all samples.
    pub(super) fn samples(&self) -> impl Iterator<Item = Coordinate> {
        (0..self.samples).map(|k| self.sample(k))
    }

    /// Returns the coordinate of the sample nearest to the sensor, for a cell from [`Axis::nearest`].
    pub(super) fn near(&self) -> Coordinate {
        if self.first > 0 {
            return self.sample(0);
        }
        // The cell on the axis: the index of its samples' parity that is within 1 of it.
        let below = -self.offset.to_i64().unwrap_or(0);
        let even = (below - self.first) % 2 == 0;
        Coordinate::new(if even { below } else { below - 1 }, self.offset)
    }

    /// Returns the coordinate of the sample farthest from the sensor, for a cell from [`Axis::nearest`].
    pub(super) fn far(&self) -> Coordinate {
        self.sample(self.samples - 1)
    }
}

/// Returns the first index below `end` at which the predicate fails, or `end`; beyond it the predicate must not hold again.
pub(super) fn first_false(end: u64, mut holds: impl FnMut(u64) -> bool) -> u64 {
    let (mut low, mut high) = (0, end);
    while low < high {
        let middle = low + (high - low) / 2;
        if holds(middle) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    low
}
