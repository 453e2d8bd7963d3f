//! The cells of a grid along one axis, in the order of their distance from the sensor.

use crate::real::Real;
use crate::rounded::Coordinate;
use core::ops::Range;

/// Cells with their centres at `i + offset`, `i` an integer, each with equally many samples. Lengths are in cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis<T> {
    /// In `[-1/2, 1/2]`: whole cells do not matter.
    offset: T,
    per_side: u32,
}

impl<T: Real> Axis<T> {
    /// The axis of a finite offset.
    pub(super) fn new(offset: T, per_side: u32) -> Self {
        // Both steps are exact.
        let rest = offset % T::one();
        let whole = if rest.abs() > T::HALF { rest.signum() } else { T::zero() };
        Self { offset: rest - whole, per_side }
    }

    /// Whether each cell has a mirror image, the one on the sensor itself apart.
    fn is_symmetric(&self) -> bool {
        self.offset.is_zero() || self.is_half()
    }

    fn is_half(&self) -> bool {
        self.offset.abs() == T::HALF
    }

    /// Whether the distances of the cells of both axes are the same.
    pub(super) fn has_the_distances_of(&self, other: &Self) -> bool {
        self.offset.abs() == other.offset.abs()
    }

    /// How many cells lie at the `count` nearest distances.
    pub(super) fn cells(&self, count: u64) -> u64 {
        match (self.is_symmetric(), self.is_half()) {
            (false, _) => count,
            (true, true) => 2 * count,
            (true, false) => (2 * count).saturating_sub(1),
        }
    }

    /// The indices `i` of these cells.
    pub(super) fn indices(&self, count: u64) -> Range<i64> {
        let (cells, before) = (self.cells(count) as i64, self.cells(count) as i64 / 2);
        let start = if self.offset < T::zero() { before + 1 - cells } else { -before };
        start..start + cells
    }

    /// A cell at the distance that `order` others are nearer than, on whichever side.
    pub(super) fn nearest(&self, order: u64) -> AxisCell<T> {
        let offset = self.offset.abs();
        if self.is_symmetric() {
            self.cell(order as i64, offset)
        } else {
            let side = if order.is_multiple_of(2) { offset } else { -offset };
            self.cell(order.div_ceil(2) as i64, side)
        }
    }

    /// The cell of index `i`.
    pub(super) fn at(&self, i: i64) -> AxisCell<T> {
        self.cell(i, self.offset)
    }

    /// The place of the centre of cell `i` in cells, rounded.
    pub(super) fn centre(&self, i: i64) -> f64 {
        i as f64 + self.offset.widen()
    }

    fn cell(&self, i: i64, offset: T) -> AxisCell<T> {
        let n = i64::from(self.per_side);
        let two_n = T::from_parts(2 * u64::from(self.per_side), 0);
        AxisCell { first: 2 * n * i + 1 - n, samples: self.per_side, offset: offset * two_n }
    }
}

/// The extent of a cell along an axis. Lengths are in half distances of two samples, which are thus two apart.
#[derive(Clone, Copy, Debug)]
pub(super) struct AxisCell<T> {
    /// The first sample is at `first + offset`.
    first: i64,
    samples: u32,
    offset: T,
}

impl<T: Real> AxisCell<T> {
    fn sample(&self, k: u32) -> Coordinate {
        Coordinate::new(self.first + 2 * i64::from(k), self.offset)
    }

    /// How far its samples are from the axis.
    pub(super) fn samples(&self) -> impl Iterator<Item = Coordinate> {
        (0..self.samples).map(|k| self.sample(k))
    }

    /// How far the nearest sample is, for a cell from [`Axis::nearest`].
    pub(super) fn near(&self) -> Coordinate {
        if self.first > 0 {
            return self.sample(0);
        }
        // The cell on the axis: the index of its samples' parity that is within 1 of it.
        let below = -self.offset.to_i64().unwrap_or(0);
        let even = (below - self.first) % 2 == 0;
        Coordinate::new(if even { below } else { below - 1 }, self.offset)
    }

    /// How far the farthest sample is, for a cell from [`Axis::nearest`].
    pub(super) fn far(&self) -> Coordinate {
        self.sample(self.samples - 1)
    }
}

/// The first index below `end` at which the predicate fails, `end` if none; it must not hold again beyond.
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
