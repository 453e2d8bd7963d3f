//! Counting by any of the ways, against counting one by one.

use super::*;
use alloc::vec::Vec;
use proptest::prelude::*;

fn naive(cells: &[i8]) -> [u64; 256] {
    let mut counts = [0; 256];
    for &cell in cells {
        counts[usize::from(cell as u8)] += 1;
    }
    counts
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    /// Stretches of few values, of the same or of others, with a stranger here and there, and of all values; at
    /// once, in pieces of one histogram, and as the merged ones of the pieces.
    #[test]
    fn counts_are_those_of_counting(
        parts in prop::collection::vec(
            (prop::collection::vec(any::<i8>(), 1..7), 0..2 * STRETCH, prop::option::of(any::<i8>())),
            0..6,
        ),
        piece in 1..2 * STRETCH,
    ) {
        let mut cells = Vec::new();
        for (values, length, stranger) in parts {
            cells.extend(values.iter().cycle().take(length));
            cells.extend(stranger);
        }
        let all = Histogram::from_cells(&cells);
        prop_assert_eq!(all.counts(), &naive(&cells));
        prop_assert_eq!(all.cells(), cells.len() as u64);
        let (mut pieces, mut merged) = (Histogram::new(), Histogram::new());
        for piece in cells.chunks(piece) {
            let bytes: Vec<u8> = piece.iter().map(|&cell| cell as u8).collect();
            pieces.add_cells(&bytes);
            merged.merge(&Histogram::from_cells(piece));
        }
        prop_assert_eq!(&pieces, &all);
        prop_assert_eq!(pieces.cells(), all.cells());
        prop_assert_eq!(&merged, &all);
        prop_assert_eq!(merged.cells(), all.cells());
    }
}

/// Lanes hold 255 of one value, and no more come in a stretch.
#[test]
fn one_value_only() {
    let cells = alloc::vec![-7_i8; 3 * STRETCH + 5];
    assert_eq!(Histogram::from_cells(&cells).counts(), &naive(&cells));
    assert_eq!(few_values(&count_all(&cells)), Some([-7_i8 as u8; FEW]));
}

/// Where short pieces hold few values, that is noticed, and that others come.
#[test]
fn short_pieces_of_few_values() {
    let mut histogram = Histogram::new();
    let piece: Vec<i8> = [0, -1, 100].into_iter().cycle().take(TABLES_FROM / 4).collect();
    for _ in 0..40 {
        histogram.add_cells(&piece);
    }
    assert_eq!(histogram.recent, Some([0, 100, 255, 0]));
    let cells = [&piece.repeat(40)[..], &[3, 5], &piece].concat();
    histogram.add_cells(&[3_i8, 5]);
    histogram.add_cells(&piece);
    assert_eq!((histogram.counts(), histogram.recent), (&naive(&cells), None));
}

#[test]
#[should_panic(expected = "at most 2^64 - 1 cells")]
fn a_count_does_not_wrap_around() {
    let mut histogram = Histogram::from_cells(&[3_u8]);
    for _ in 0..64 {
        let same = histogram.clone();
        histogram.merge(&same);
    }
}
