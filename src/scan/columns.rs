//! The first cells of a segment, marked column by column: those of which the scan says the same.
//!
//! "Columns" are those of the axis along which the segment is longer, rows for a steep one: it crosses at most one line of the
//! other axis on its way from column to column.

use super::lattice::{FRACTION, Point};
use super::raster::Raster;
use super::readings::FREE;
use super::traversal::{Steps, Traversal};
use core::ops::{Add, Sub};

/// Marks the cells of all columns that the segment leaves before it has gone `length` units along its longer axis as [`FREE`]; the
/// last column is never one of them. Returns the traversal of the others.
///
/// The cells are those of [`Traversal`] (`scan.md`, Theorem (columns)): so many columns take as many comparisons of integers,
/// which are below `2^64` for segments of less than `2^8` cells.
#[inline]
pub(super) fn mark(from: Point, to: Point, length: u64, raster: &mut Raster<u8>) -> Traversal {
    let steps = Steps::new(from, to);
    let Steps { sides, to_line, .. } = steps;
    let (long, wide) = if sides[0] >= sides[1] { (0, 1) } else { (1, 0) };
    // The lines of the longer axis at less than the length, but for the last one.
    let lines = length.checked_sub(to_line[long] + 1).map_or(0, |beyond| (beyond >> FRACTION) + 1);
    let lines = lines.min(steps.lines[long].saturating_sub(1));
    if lines == 0 {
        return steps.beyond([0; 2]);
    }
    let [along, across] = [long, wide].map(|axis| raster.stride(axis, steps.forward[axis]));
    let mut at = raster.index(steps.cell);
    raster.set(at, FREE);
    // How far the segment is from the last line of the other axis where it crosses the first one of the longer: units of
    // 2^-28 of a cell over `long`; a cell is `side` of them.
    let [long_side, wide_side] = [long, wide].map(|axis| u128::from(sides[axis]));
    let side = long_side << FRACTION;
    let mut offset = side - u128::from(to_line[wide]) * long_side + u128::from(to_line[long]) * wide_side;
    let mut rows = 0;
    if offset > side {
        at = at.wrapping_add_signed(across);
        raster.set(at, FREE);
        (offset, rows) = (offset - side, rows + 1);
    }
    // Through a corner, into the cell diagonally opposite.
    if offset == side {
        at = at.wrapping_add_signed(across);
        (offset, rows) = (0, rows + 1);
    }
    at = at.wrapping_add_signed(along);
    let step = wide_side << FRACTION;
    let columns = Columns { count: lines - 1, at, along, across };
    rows += match u64::try_from(side) {
        Ok(side) => columns.mark(offset as u64, step as u64, side, raster),
        Err(_) => columns.mark(offset, step, side, raster),
    };
    let mut skipped = [0; 2];
    (skipped[long], skipped[wide]) = (lines, rows);
    steps.beyond(skipped)
}

/// Columns whose cells are marked: how many, where in the raster the first cell is, and how far the next along and across.
struct Columns {
    count: u64,
    at: usize,
    along: isize,
    across: isize,
}

impl Columns {
    /// Marks the cells of each column from the one in which the segment enters to the one in which it leaves; `offset < side`
    /// of it where it enters the first, and `step <= side` more in each column. Returns how many lines it crosses.
    fn mark<I>(self, mut offset: I, step: I, side: I, raster: &mut Raster<u8>) -> u64
    where
        I: Copy + Ord + Add<Output = I> + Sub<Output = I>,
    {
        // From here on a step crosses a line.
        let gap = side - step;
        let (mut at, mut rows) = (self.at, 0);
        for _ in 0..self.count {
            raster.set(at, FREE);
            let is_across = offset >= gap;
            let beside = at.wrapping_add_signed(self.across);
            // At the line itself it goes through a corner, and not through the cell beside.
            raster.set(if offset > gap { beside } else { at }, FREE);
            at = if is_across { beside } else { at }.wrapping_add_signed(self.along);
            offset = if is_across { offset - gap } else { offset + step };
            rows += u64::from(is_across);
        }
        rows
    }
}
