//! Parts of a grid's cells, which are numbered row by row: parts for threads, and pieces of single rows.

use core::ops::Range;
#[cfg(feature = "rayon")]
use rayon::prelude::*;

/// Splits the cells into parts of nearly equal size: 16 for each thread, because cells differ in the time they take.
#[cfg(feature = "rayon")]
pub(crate) fn for_threads(cells: u64) -> impl ParallelIterator<Item = Range<u64>> {
    let parts = 16 * rayon::current_num_threads();
    let start = move |part: usize| (u128::from(cells) * part as u128 / parts as u128) as u64;
    (0..parts).into_par_iter().map(move |part| start(part)..start(part + 1))
}

/// Splits a range of cells of a grid of `width` columns into pieces of single rows: the row and its columns, at most
/// `most` of them.
pub(crate) fn rows(
    cells: Range<u64>,
    width: usize,
    most: usize,
) -> impl Iterator<Item = (usize, Range<usize>)> {
    let (width, mut at) = (width as u64, cells.start);
    core::iter::from_fn(move || {
        (at < cells.end).then(|| {
            let (row, column) = (at / width, at % width);
            let length = (width - column).min(cells.end - at).min(most as u64);
            at += length;
            (row as usize, column as usize..(column + length) as usize)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;
    use proptest::prelude::*;

    proptest! {
        /// Each cell once and in its order.
        #[test]
        fn rows_hold_each_cell_once(width in 1_usize..20, start in 0_u64..100, count in 0_u64..100, most in 1_usize..30) {
            let pieces = rows(start..start + count, width, most);
            let mut cells = Vec::new();
            for (row, columns) in pieces {
                prop_assert!(columns.end <= width && (1..=most).contains(&columns.len()));
                cells.extend(columns.map(|column| (row * width + column) as u64));
            }
            prop_assert_eq!(cells, (start..start + count).collect::<Vec<_>>());
        }

        #[cfg(feature = "rayon")]
        #[test]
        fn parts_hold_each_cell_once(cells in prop_oneof![0_u64..1000, (u64::MAX - 9)..=u64::MAX]) {
            let parts: Vec<_> = for_threads(cells).collect();
            prop_assert_eq!((parts[0].start, parts[parts.len() - 1].end), (0, cells));
            for pair in parts.windows(2) {
                prop_assert_eq!(pair[0].end, pair[1].start);
            }
            let sizes = parts.iter().map(|part| part.end - part.start);
            prop_assert!(sizes.clone().max().unwrap() - sizes.min().unwrap() <= 1);
        }
    }
}
