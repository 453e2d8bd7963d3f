//! The cells of a segment, column by column: those of which the scan says the same, and the rest.
//!
//! "Columns" are those of the axis along which the segment is longer, rows for a steep one: it crosses at most one line of the
//! other axis on its way from column to column. Both are counted from the cell that holds its start, in the direction of the segment.

use super::codes::{FREE, NOTHING};
use super::lattice::{FRACTION, Point, cell_of};
use super::raster::{Area, Raster};
use super::stretches::{self, Stretches};
use crate::error::Error;

/// A segment by its columns, the first of which holds its start and has number 0; line `k` is where it enters column `k`.
///
/// Its cells are those of the traversal by Amanatides and Woo (`scan.md`, Theorem (columns)).
#[derive(Clone, Copy, Debug)]
pub(super) struct Track {
    /// The cell that holds its start.
    cell: [i64; 2],
    /// The shorter axis: 0 for a steep segment.
    across: usize,
    long: Side,
    wide: Side,
    /// The number of the first columns whose cells are marked; the last two columns never are.
    sure: u64,
    /// How far it goes along the shorter axis for each unit along the longer, within `2^-51`.
    pub(super) slope: f64,
    /// The row where it crosses line 1, and how many it goes on from line to line, both in units of `2^-32` and rounded; the row of any
    /// line is within so many units.
    first: u64,
    rise: u64,
    error: u64,
}

/// A segment along one axis.
#[derive(Clone, Copy, Debug)]
struct Side {
    /// 1 forward, -1 backward.
    sign: i64,
    /// How far it goes: at most `2^62`.
    length: u64,
    /// How many lines of the grid it crosses, and how far it is to the first one, if there is any.
    lines: u64,
    to_line: u64,
}

impl Side {
    /// Measures a segment along an axis.
    #[inline]
    fn new(from: i64, to: i64) -> Self {
        let (is_forward, cell) = (i64::from(to >= from), from >> FRACTION);
        let line = (cell + is_forward) << FRACTION;
        let lines = cell.abs_diff(to >> FRACTION);
        Self { sign: 2 * is_forward - 1, length: to.abs_diff(from), lines, to_line: line.abs_diff(from) }
    }

    /// Returns how far its start is from the centre of the cell after so many lines, towards its end: exactly, below `2^63`.
    #[inline]
    fn to_centre(self, lines: u64) -> i64 {
        (self.to_line + (lines << FRACTION)) as i64 - (1 << (FRACTION - 1))
    }
}

/// Rounds a number from 0 to `2^34` to an integer.
#[inline]
fn rounded(x: f64) -> u64 {
    // Floats from here on are integers, and a sum is rounded to one.
    const INTEGERS: f64 = (1_u64 << 52) as f64;
    (x + INTEGERS).to_bits().wrapping_sub(INTEGERS.to_bits())
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
    /// [`Error::TooManyCells`] if there are more cells than the limit; [`Error::NoMemory`].
    pub(super) fn new(area: Area, limit: u64) -> Result<Self, Error> {
        area.within(limit)?;
        let whole = stretches::whole(area);
        let codes = Raster::new(whole, NOTHING, u64::MAX);
        match (codes, Stretches::new(whole)) {
            (Ok(codes), Ok(stretches)) => Ok(Self { codes, stretches }),
            _ => Err(Error::no_memory(area.cells())),
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
        let [x, y] = [0, 1].map(|k| Side::new(from[k], to[k]));
        let (across, [long, wide]) = if x.length < y.length { (0, [y, x]) } else { (1, [x, y]) };
        // The lines of the longer axis at less than the length, but for the last one.
        let sure = length.checked_sub(long.to_line + 1).map_or(0, |beyond| (beyond >> FRACTION) + 1);
        // A point has a side of one unit, which is not drawn.
        let long = Side { length: long.length.max(1), ..long };
        let slope = wide.length as i64 as f64 / long.length as i64 as f64;
        // In units of 2^-32, of which 16 are one of the lattice.
        let behind = ((1 << FRACTION) - wide.to_line) as i64 as f64;
        let first = rounded(16.0 * (behind + long.to_line as i64 as f64 * slope));
        let rise = rounded(slope * (1_u64 << 32) as f64);
        Self {
            cell: cell_of(from),
            across,
            long,
            wide,
            sure: sure.min(long.lines.saturating_sub(1)),
            slope: slope * wide.sign as f64,
            first,
            rise,
            error: 2 * (long.lines + 1),
        }
    }

    /// Returns the number of the last column after column 0 whose cells are marked.
    #[inline]
    pub(super) fn sure_columns(&self) -> u64 {
        self.sure.saturating_sub(1)
    }

    /// Returns in which of the two directions of which axis it is longer, as a number below 4.
    #[inline]
    pub(super) fn quarter(&self) -> usize {
        2 * self.across + usize::from(self.long.sign > 0)
    }

    /// Finds the row in which it comes to a line from 1 on, and the one in which it goes on: the same, or the next through a corner.
    #[inline]
    fn rows_at(&self, line: u64) -> [u64; 2] {
        let row = self.first.wrapping_add((line - 1).wrapping_mul(self.rise));
        // An error of 2^31 or more decides nothing.
        let part = u64::from((row as u32).wrapping_add(self.error as u32));
        if part <= 2 * self.error { self.rows_exactly_at(line) } else { [row >> 32; 2] }
    }

    /// Finds what [`rows_at`](Self::rows_at) does in integers below `2^125`.
    #[cold]
    fn rows_exactly_at(&self, line: u64) -> [u64; 2] {
        let (height, row) = (self.height(line), u128::from(self.long.length) << FRACTION);
        let next = (height / row) as u64;
        let is_corner = height % row == 0;
        // Along a line it stays above, in row 0.
        [next - u64::from(is_corner && next > 0), next]
    }

    /// Computes how far it is above row 0 where it comes to a line from 1 on, times its longer side.
    #[inline]
    fn height(&self, line: u64) -> u128 {
        let Self { long, wide, .. } = self;
        let [length, rise] = [long.length, wide.length].map(u128::from);
        let behind = u128::from((1 << FRACTION) - wide.to_line);
        let gone = u128::from(long.to_line) + (u128::from(line - 1) << FRACTION);
        behind * length + gone * rise
    }

    /// Returns the row in which a column begins.
    #[inline]
    fn row(&self, column: u64) -> u64 {
        // An end on a line that is met from above does not go below it.
        if column == 0 { 0 } else { self.rows_at(column)[1].min(self.wide.lines) }
    }

    /// Finds the first row and the last one of a column: the same, or the next; of those after the last column the last cell.
    #[inline]
    fn rows(&self, column: u64) -> [u64; 2] {
        let lines = self.wide.lines;
        if column < self.long.lines {
            [self.row(column), self.rows_at(column + 1)[0]]
        } else {
            [self.row(self.long.lines), lines]
        }
    }

    /// Returns the numbers of the columns whose cells are not marked.
    #[inline]
    pub(super) fn rest(&self) -> core::ops::RangeInclusive<u64> {
        self.sure..=self.long.lines
    }

    /// Finds the first cell and the last one of each column that is not marked, as places in a raster and as squares of the distances of
    /// their centres from the start; where there are fewer columns the last cell, again. Returns false if there are more.
    #[inline]
    pub(super) fn few<const N: usize>(
        &self,
        codes: &Raster<u8>,
        places: &mut [usize; N],
        squares: &mut [f64; N],
    ) -> bool {
        let Self { sure, long, wide, .. } = *self;
        if long.lines - sure >= N as u64 / 2 {
            return false;
        }
        let (start, [along, across]) = self.strides(codes);
        let mut row = self.row(sure);
        for k in 0..N / 2 {
            let column = (sure + k as u64).min(long.lines);
            let [last, next] = self.rows_at(column + 1);
            let last = if column == long.lines { wide.lines } else { last };
            let place = start.wrapping_add_signed(along * column as isize);
            for (j, row) in [row, last].into_iter().enumerate() {
                places[2 * k + j] = place.wrapping_add_signed(across * row as isize);
                squares[2 * k + j] = self.square(column, row);
            }
            row = next.min(wide.lines);
        }
        true
    }

    /// Returns the place in a raster of the cell that holds the start, and how far it is from column to column and from row to row.
    #[inline]
    fn strides<C: Copy>(&self, raster: &Raster<C>) -> (usize, [isize; 2]) {
        let stride = |axis: usize, side: &Side| raster.stride(axis) * side.sign as isize;
        (raster.index(self.cell), [stride(1 - self.across, &self.long), stride(self.across, &self.wide)])
    }

    /// Returns the cells of a column in their order, each with the square of the distance of its centre from the start.
    #[inline]
    pub(super) fn cells(&self, column: u64) -> impl Iterator<Item = ([i64; 2], f64)> {
        let [first, last] = self.rows(column);
        (first..=last).map(move |row| (self.cell(column, row), self.square(column, row)))
    }

    /// Returns the cell of a row and a column.
    #[inline]
    fn cell(&self, column: u64, row: u64) -> [i64; 2] {
        let (along, across) = (self.long.sign * column as i64, self.wide.sign * row as i64);
        let [x, y] = if self.across == 0 { [across, along] } else { [along, across] };
        [self.cell[0] + x, self.cell[1] + y]
    }

    /// Computes the square of the distance of its start from the centre of a cell, in units, within `2^-51` of it.
    #[inline]
    fn square(&self, column: u64, row: u64) -> f64 {
        let [x, y] = [self.long.to_centre(column) as f64, self.wide.to_centre(row) as f64];
        x * x + y * y
    }

    /// Marks the cells of its sure columns as [`FREE`], but for columns that it shares with both neighbours; where it shares them with
    /// one, a stretch of free cells begins or ends at it.
    #[inline]
    pub(super) fn draw(&self, [both, one]: Shared, canvas: &mut Canvas) {
        if self.sure == 0 {
            return;
        }
        let Canvas { codes, stretches } = canvas;
        let (start, [along, across]) = self.strides(codes);
        let place = |column: u64, row: u64| {
            start.wrapping_add_signed(along * column as isize + across * row as isize)
        };
        codes.set(start, FREE);
        codes.set(place(0, self.rows_at(1)[0]), FREE);
        let mut row = self.rows_at(both + 1)[1];
        let mut mark = |column: u64| {
            let [last, next] = self.rows_at(column + 1);
            let ends = [place(column, row), place(column, last)];
            for end in ends {
                codes.set(end, FREE);
            }
            row = next;
            ends
        };
        for column in both + 1..=one {
            let [first, last] = mark(column);
            stretches.turn(if self.wide.sign > 0 { first } else { last }, self.across);
        }
        for column in both.max(one) + 1..self.sure {
            mark(column);
        }
    }
}

#[cfg(test)]
mod tests;
