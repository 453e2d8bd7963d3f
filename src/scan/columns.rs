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

#[cfg(test)]
mod tests {
    use super::super::raster::Area;
    use super::super::traversal::cell_of;
    use super::*;
    use proptest::prelude::*;
    use std::collections::BTreeSet;

    const CELL: i64 = 1 << FRACTION;

    /// Places of which many lie on lines and corners.
    fn place(cells: i64) -> impl Strategy<Value = i64> {
        prop_oneof![
            -cells * CELL..cells * CELL,
            (-cells..cells).prop_map(|k| k * CELL),
            (-2 * cells..2 * cells).prop_map(|k| k * CELL / 2),
            (-cells..cells, -2_i64..3).prop_map(|(k, more)| k * CELL + more),
        ]
    }

    /// Columns marked and the rest make up the traversal, and columns are those that are left at less than the length.
    fn check(from: Point, to: Point, length: u64) -> Result<(), TestCaseError> {
        let area = Area::of_cell(cell_of(from)).union(Area::of_cell(cell_of(to)));
        let mut raster = Raster::new(area, 0, 1 << 22).unwrap();
        let rest: Vec<_> = mark(from, to, length, &mut raster).collect();
        let all: Vec<_> = Traversal::new(from, to).collect();
        prop_assert_eq!(&rest[..], &all[all.len() - rest.len()..]);
        let marked: BTreeSet<_> = all[..all.len() - rest.len()].iter().copied().collect();
        let count = area.rows().flat_map(|row| raster.row(area, row)).filter(|&&code| code == FREE).count();
        prop_assert_eq!(count, marked.len());
        prop_assert!(marked.iter().all(|&cell| *raster.cell(cell) == FREE));
        // Along the longer axis, of the cells where it goes backwards the lower line.
        let sides = [0, 1].map(|k| to[k].abs_diff(from[k]));
        let long = usize::from(sides[0] < sides[1]);
        let last = cell_of(to)[long];
        for cell in all {
            let line = if to[long] >= from[long] { cell[long] + 1 } else { cell[long] } << FRACTION;
            let is_sure = line.abs_diff(from[long]) < length && (last - cell[long]).abs() > 1;
            prop_assert!(!is_sure || marked.contains(&cell), "{:?}", cell);
            prop_assert!(line.abs_diff(from[long]) < length || !marked.contains(&cell), "{:?}", cell);
        }
        Ok(())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        #[test]
        fn they_are_the_cells_of_the_traversal(
            from in [place(9), place(9)], to in [place(9), place(9)], length in prop_oneof![Just(0_i64), 0..19 * CELL, (0_i64..19).prop_map(|k| k * CELL)],
        ) {
            check(from, to, length as u64)?;
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]

        /// Shorter and longer than what 64 bits hold.
        #[test]
        fn so_are_those_of_long_segments(from in [place(9), place(9)], to in [place(700), place(40)], swapped in any::<bool>(), length in 0..800 * CELL) {
            let turned = |[x, y]: Point| if swapped { [y, x] } else { [x, y] };
            check(turned(from), turned(to), length as u64)?;
        }
    }

    /// A start on a line that the segment leaves at once is in a column that is left at 0.
    #[test]
    fn no_length_has_no_columns() {
        let mut raster = Raster::new(Area::of_cell([0, 0]).union(Area::of_cell([1, -9])), 0, 99).unwrap();
        let rest = mark([5, 0], [9, -8 * CELL], 0, &mut raster);
        assert_eq!(rest.count(), 9);
        assert_eq!(*raster.cell([0, 0]), 0);
    }
}
