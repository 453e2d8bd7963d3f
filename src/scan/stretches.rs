//! Stretches of cells along columns and rows, by their ends: a bit where one begins, and a bit behind its last cell.

use super::codes::FREE;
use super::raster::Area;
use alloc::collections::TryReserveError;
use alloc::vec::Vec;

/// The number of cells of a word.
const WORD: usize = u64::BITS as usize;

/// The ends of stretches in an area whose rows are whole words, row by row from the lowest.
pub(super) struct Stretches {
    /// The number of words of a row.
    width: usize,
    /// The ends of stretches along rows, to the right, and of those along columns, upwards, of 64 cells beside each other.
    ends: Vec<[u64; 2]>,
    /// The columns that stretches along columns cover, 64 a word: none before cells are marked.
    columns: Vec<u64>,
}

impl Stretches {
    /// Creates the stretches of a [`whole`] area, of which there are none.
    ///
    /// # Errors
    /// That of the allocation, if there is no memory.
    pub(super) fn new(area: Area) -> Result<Self, TryReserveError> {
        let [columns, rows] = area.size();
        let width = columns / WORD;
        let (mut ends, mut columns) = (Vec::new(), Vec::new());
        ends.try_reserve_exact(width * rows)?;
        ends.resize(width * rows, [0; 2]);
        columns.try_reserve_exact(width)?;
        columns.resize(width, 0);
        Ok(Self { width, ends, columns })
    }

    /// Tells whether rows are too short for stretches.
    pub(super) fn are_none(&self) -> bool {
        self.width == 0
    }

    /// Begins a stretch along an axis at a place of the raster, or ends one before it; what is done twice is not done.
    #[inline]
    pub(super) fn turn(&mut self, index: usize, axis: usize) {
        self.ends[index / WORD][axis] ^= 1 << (index % WORD);
    }

    /// Marks the cells of all stretches as [`FREE`].
    pub(super) fn mark(mut self, codes: &mut [u8]) {
        let width = self.width.max(1);
        for (codes, ends) in codes.chunks_exact_mut(WORD * width).zip(self.ends.chunks_exact(width)) {
            let mut carried = 0;
            let (codes, _) = codes.as_chunks_mut();
            for ((codes, column), &[along, across]) in codes.iter_mut().zip(&mut self.columns).zip(ends) {
                *column ^= across;
                let along = if along == 0 { carried } else { between(along) ^ carried };
                // All ones while a stretch goes on in the next word.
                carried = ((along as i64) >> (u64::BITS - 1)) as u64;
                free(codes, *column | along);
            }
        }
    }
}

/// Extends an area to the right to rows of whole words, less than twice as long; rows that are shorter than a word stay.
pub(super) fn whole(area: Area) -> Area {
    let [columns, _] = area.size();
    if columns < WORD { area } else { area.with_columns(columns.next_multiple_of(WORD)) }
}

/// Sets the bits from each first of two bits on to before the second.
#[inline]
fn between(ends: u64) -> u64 {
    [1, 2, 4, 8, 16, 32].into_iter().fold(ends, |bits, by| bits ^ bits << by)
}

/// Marks the cells whose bits are set as [`FREE`].
#[inline]
fn free(codes: &mut [u8; WORD], bits: u64) {
    if bits == 0 {
        return;
    }
    let (pieces, _) = codes.as_chunks_mut::<8>();
    for (piece, bits) in pieces.iter_mut().zip(bits.to_le_bytes()) {
        let all = u64::from_le_bytes(*piece) | BYTES[usize::from(bits)];
        *piece = all.to_le_bytes();
    }
}

/// For each eight bits the bytes that are [`FREE`] where they are set, the lowest first.
static BYTES: [u64; 256] = {
    let mut bytes = [0; 256];
    let mut bits = 0;
    while bits < 256 {
        let mut k = 0;
        while k < 8 {
            bytes[bits] |= ((bits as u64 >> k & 1) * FREE as u64) << (8 * k);
            k += 1;
        }
        bits += 1;
    }
    bytes
};

#[cfg(test)]
mod tests {
    use super::super::codes::NOTHING;
    use super::super::raster::Raster;
    use super::*;
    use proptest::collection::vec;
    use proptest::prelude::*;

    /// A map of one column has no room for 64.
    #[test]
    fn short_rows_stay_short() {
        for columns in 1..WORD {
            let area = Area::of_cell([-5, 3]).with_columns(columns);
            assert_eq!(whole(area), area);
            assert!(Stretches::new(area).unwrap().are_none());
        }
    }

    proptest! {
        /// Stretches along both axes, some across words and some empty, none of two of one axis in one line.
        #[test]
        fn they_are_the_cells_between_their_ends(
            low in [-9_i64..9, -9_i64..9], size in [64_usize..200, 1_usize..9], rows in vec((0.0_f64..1.0, 0.0_f64..1.0), 9), columns in vec((0.0_f64..1.0, 0.0_f64..1.0), 200),
        ) {
            let area = Area::of_cell(low).union(Area::of_cell([low[0] + size[0] as i64 - 1, low[1] + size[1] as i64 - 1]));
            let whole = whole(area);
            prop_assert!(whole.size()[0] < 2 * size[0] && whole.size()[0].is_multiple_of(WORD));
            let mut codes = Raster::new(whole, NOTHING, u64::MAX).unwrap();
            let mut stretches = Stretches::new(whole).unwrap();
            // Before the last cell: an end is a cell of the area.
            let ends = |(a, b): (f64, f64), length: usize| {
                let [a, b] = [a, b].map(|part: f64| (part * length as f64) as usize);
                [a.min(b), a.max(b)]
            };
            let index = |column: usize, row: usize| row * whole.size()[0] + column;
            for (row, &pair) in rows.iter().enumerate().take(size[1]) {
                for column in ends(pair, size[0]) {
                    stretches.turn(index(column, row), 0);
                }
            }
            for (column, &pair) in columns.iter().enumerate().take(size[0]) {
                for row in ends(pair, size[1]) {
                    stretches.turn(index(column, row), 1);
                }
            }
            stretches.mark(codes.all_mut());
            let is_between = |[from, to]: [usize; 2], k| from <= k && k < to;
            for (row, &along) in rows.iter().enumerate().take(size[1]) {
                for (column, &across) in columns.iter().enumerate().take(size[0]) {
                    let expected = is_between(ends(along, size[0]), column) || is_between(ends(across, size[1]), row);
                    prop_assert_eq!(codes.at(index(column, row)) == FREE, expected, "{} {}", column, row);
                }
            }
        }
    }
}
