//! The cells of segments against a traversal, and their rows against quotients.

use super::super::traversal::Traversal;
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
    let track = Track::new(from, to, length);
    track.draw([0; 2], &mut canvas);
    let rest: Vec<_> = track.rest().flat_map(|column| track.cells(column)).map(|(cell, _)| cell).collect();
    let raster = canvas.settled();
    check_few(&track, &raster, from, &rest)?;
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

/// The few cells that are not marked are the same as places and squares, and no more than these.
fn check_few(track: &Track, codes: &Raster<u8>, from: Point, rest: &[[i64; 2]]) -> Result<(), TestCaseError> {
    let (mut places, mut squares) = ([0; 6], [0.0; 6]);
    let are_few = track.few(codes, &mut places, &mut squares);
    prop_assert_eq!(are_few, track.rest().count() <= 3);
    if are_few {
        let found: BTreeSet<_> = places.iter().map(|&place| codes.cell_at(place)).collect();
        prop_assert_eq!(&found, &rest.iter().copied().collect());
        for (place, square) in places.into_iter().zip(squares) {
            let offset = |k: usize| ((2 * codes.cell_at(place)[k] + 1) * (CELL / 2) - from[k]) as f64;
            prop_assert_eq!(square, offset(0) * offset(0) + offset(1) * offset(1));
        }
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
    let track = Track::new([5, 0], [9, -8 * CELL], 0);
    track.draw([0; 2], &mut canvas);
    assert_eq!(track.rest().flat_map(|column| track.cells(column)).count(), 9);
    assert_eq!(*canvas.settled().cell([0, 0]), NOTHING);
}

/// Coordinates of any magnitude up to the end of the lattice, of which many lie on lines.
fn far() -> impl Strategy<Value = i64> {
    let any_magnitude = (any::<i64>(), 2_u32..64, any::<bool>())
        .prop_map(|(x, shift, is_on_line)| (x >> shift) & if is_on_line { -CELL } else { -1 });
    prop_oneof![14 => any_magnitude, 1 => Just(1 << 61), 1 => Just(-1 << 61)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(30_000))]

    /// Rows by 32 bits after the point are those of the quotients, and off by less than the bound: at the first line, the last one, and
    /// some between.
    #[test]
    fn rows_are_those_of_the_quotients(from in [far(), far()], to in [far(), far()], along in 0_usize..8, lines in any::<[u64; 6]>()) {
        // Two of eight go along an axis.
        let to = [0, 1].map(|k| if k == along { from[k] } else { to[k] });
        let track = Track::new(from, to, 0);
        let last = track.long.lines + 1;
        for line in lines.into_iter().map(|line| line % last + 1).chain([1, last]) {
            prop_assert_eq!(track.rows_at(line), track.rows_exactly_at(line), "line {}", line);
            // Theorem (columns); else the error decides nothing.
            if track.error < 1 << 31 {
                let length = u128::from(track.long.length);
                let row = track.first + (line - 1) * track.rise;
                let off = (u128::from(row) * length).abs_diff(16 * track.height(line));
                prop_assert!(off < u128::from(line.min(track.error)) * length, "line {}", line);
            }
        }
    }
}
