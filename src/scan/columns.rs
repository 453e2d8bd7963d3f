//! The cells of a segment, column by column: those of which the scan says the same, and the rest.
//!
//! "Columns" are those of the axis along which the segment is longer, rows for a steep one: it crosses at most one line of the
//! other axis on its way from column to column.

use super::codes::{FREE, NOTHING};
use super::lattice::{FRACTION, Point};
use super::raster::{Area, Raster};
use super::stretches::{self, Stretches};
use super::traversal::{Steps, Traversal};
use crate::error::Error;
use core::ops::{Add, Sub};

/// A segment by its columns, the first of which holds its start and has number 0.
///
/// Its cells are those of the traversal by Amanatides and Woo (`scan.md`, Theorem (columns)).
#[derive(Clone, Copy, Debug)]
pub(super) struct Track {
    steps: Steps,
    /// The number of the first columns whose cells are marked; the last column is never one of them.
    sure: u64,
    /// How far it goes along the shorter axis for each unit along the longer, within `2^-51`.
    pub(super) slope: f64,
}

/// What beams are drawn on: the codes of cells, and stretches of free cells.
pub(super) struct Canvas {
    pub(super) codes: Raster<u8>,
    stretches: Stretches,
}

impl Canvas {
    /// Creates the canvas of an area, of which nothing is told: up to two and a half bytes a cell.
    ///
    /// # Errors
    /// [`Error::TooManyCells`] if there are more cells than the limit, or no memory for them.
    pub(super) fn new(area: Area, limit: u64) -> Result<Self, Error> {
        area.within(limit)?;
        let whole = stretches::whole(area);
        let refused = Error::too_many_cells(area.cells(), limit);
        let codes = Raster::new(whole, NOTHING, u64::MAX);
        match (codes, Stretches::new(whole)) {
            (Ok(codes), Ok(stretches)) => Ok(Self { codes, stretches }),
            _ => Err(refused),
        }
    }

    /// Tells whether neighbouring beams can share cells: rows that are shorter than a word hold no stretches.
    pub(super) fn is_shared(&self) -> bool {
        !self.stretches.are_none()
    }

    /// Frees the cells of all stretches; returns the codes.
    pub(super) fn settled(mut self) -> Raster<u8> {
        self.stretches.mark(self.codes.all_mut());
        self.codes
    }
}

/// What a beam shares with its neighbours: in the columns from 1 up to the first number both of them mark its cells, in those up to
/// the second one of them.
pub(super) type Shared = [u64; 2];

impl Track {
    /// Measures the segment between two points, whose columns are marked that it leaves before it has gone `length` units along its
    /// longer axis.
    #[inline]
    pub(super) fn new(from: Point, to: Point, length: u64) -> Self {
        let steps = Steps::new(from, to);
        // The lines of the longer axis at less than the length, but for the last one.
        let sure = length.checked_sub(steps.to_line + 1).map_or(0, |beyond| (beyond >> FRACTION) + 1);
        let Steps { sides, lines, long, forward, .. } = steps;
        let slope = sides[1 - long] as i64 as f64 / sides[long] as i64 as f64;
        let slope = if forward[1 - long] { slope } else { -slope };
        Self { steps, sure: sure.min(lines[long].saturating_sub(1)), slope }
    }

    /// Returns the number of the last column after column 0 whose cells are marked.
    #[inline]
    pub(super) fn sure_columns(&self) -> u64 {
        self.sure.saturating_sub(1)
    }

    /// Returns in which of the two directions of which axis it is longer, as a number below 4.
    #[inline]
    pub(super) fn quarter(&self) -> usize {
        2 * self.steps.long + usize::from(self.steps.forward[self.steps.long])
    }

    /// Marks the cells of its sure columns as [`FREE`], but for columns that it shares with both neighbours; where it shares them with
    /// one, a stretch of free cells begins or ends at it. Returns the traversal of the cells in other columns.
    #[inline]
    pub(super) fn draw(&self, shared: Shared, canvas: &mut Canvas) -> Traversal {
        let Self { steps, sure, .. } = *self;
        let Steps { long, step, side, forward, .. } = steps;
        if sure == 0 {
            return steps.beyond([0; 2], steps.next);
        }
        let codes = &mut canvas.codes;
        let [along, across] = [long, 1 - long].map(|axis| codes.stride(axis, forward[axis]));
        let at = codes.index(steps.cell);
        codes.set(at, FREE);
        let (mut offset, mut rows) = (steps.next, 0);
        if offset > side {
            codes.set(at.wrapping_add_signed(across), FREE);
            (offset, rows) = (offset - side, 1);
        }
        // Through a corner, into the cell diagonally opposite.
        if offset == side {
            (offset, rows) = (0, rows + 1);
        }
        let column = shared[0] + 1;
        if column > 1 {
            offset += u128::from(column - 1) * step;
            // The side is the longer one in units of a cell.
            let (units, side) = (offset >> FRACTION, steps.sides[long]);
            let crossed = match u64::try_from(units) {
                Ok(units) => units / side,
                Err(_) => (units / u128::from(side)) as u64,
            };
            (offset, rows) = (offset - u128::from(crossed) * steps.side, rows + crossed);
        }
        let at = at.wrapping_add_signed(along * column as isize + across * rows as isize);
        let short = [offset, step, side].map(u64::try_from);
        let (rows, offset) = if let [Ok(offset), Ok(step), Ok(side)] = short {
            let walk = Walk { rows, at, along, across, offset, step, gap: side - step };
            let (rows, offset) = self.columns(column, walk, shared[1], canvas);
            (rows, offset.into())
        } else {
            let walk = Walk { rows, at, along, across, offset, step, gap: side - step };
            self.columns(column, walk, shared[1], canvas)
        };
        steps.beyond([sure, rows], offset + step)
    }

    /// Draws the sure columns from one that is entered on, with the ends of stretches in those up to `shared`; returns how many lines
    /// of the other axis were crossed then, and the offset.
    #[inline]
    fn columns<I>(&self, first: u64, mut walk: Walk<I>, shared: u64, canvas: &mut Canvas) -> (u64, I)
    where
        I: Copy + Ord + Add<Output = I> + Sub<Output = I>,
    {
        let Canvas { codes, stretches } = canvas;
        let wide = 1 - self.steps.long;
        let is_upward = self.steps.forward[wide];
        for _ in first..=shared {
            let [at, last] = walk.next();
            codes.set(at, FREE);
            codes.set(last, FREE);
            stretches.turn(if is_upward { at } else { last }, wide);
        }
        for _ in first.max(shared + 1)..self.sure {
            let [at, last] = walk.next();
            codes.set(at, FREE);
            codes.set(last, FREE);
        }
        (walk.rows, walk.offset)
    }
}

/// A walk from column to column: how many lines of the other axis were crossed, the place of the cell, and how far it is to the next
/// ones.
struct Walk<I> {
    rows: u64,
    at: usize,
    along: isize,
    across: isize,
    offset: I,
    step: I,
    /// The offset from which on a step crosses a line.
    gap: I,
}

impl<I: Copy + Ord + Add<Output = I> + Sub<Output = I>> Walk<I> {
    /// Goes on to the next column; returns the places of the first and the last cell of the one that is left.
    #[inline]
    fn next(&mut self) -> [usize; 2] {
        let is_across = self.offset >= self.gap;
        let (at, beside) = (self.at, self.at.wrapping_add_signed(self.across));
        // At the line itself it goes through a corner, and not through the cell beside.
        let last = if self.offset > self.gap { beside } else { at };
        self.offset = if is_across { self.offset - self.gap } else { self.offset + self.step };
        self.at = if is_across { beside } else { at }.wrapping_add_signed(self.along);
        self.rows += u64::from(is_across);
        [at, last]
    }
}

#[cfg(test)]
mod tests {
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
        let mut canvas = Canvas::new(area, 1 << 22).unwrap();
        let rest: Vec<_> = Track::new(from, to, length).draw([0; 2], &mut canvas).collect();
        let raster = canvas.settled();
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
        let mut canvas = Canvas::new(Area::of_cell([0, 0]).union(Area::of_cell([1, -9])), 99).unwrap();
        let rest = Track::new([5, 0], [9, -8 * CELL], 0).draw([0; 2], &mut canvas);
        assert_eq!(rest.count(), 9);
        assert_eq!(*canvas.settled().cell([0, 0]), NOTHING);
    }
}
