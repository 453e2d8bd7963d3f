//! Counts against sums of what was told, up to what they can hold, and where there is no memory.

use super::super::codes::{NOTHING, OCCUPIED};
use super::super::readings::Reading;
use super::super::refusal;
use super::*;
use alloc::vec::Vec;
use proptest::collection::vec;
use proptest::prelude::*;

/// The readings of a scan that tells all cells of an area the same, by one level of free cells.
fn free(area: Area, level: i128, code: u8) -> Readings {
    let codes = Raster::new(area, code, 8).unwrap();
    Readings { area, codes, levels: [level, 0], occupied: Vec::new(), others: Vec::new() }
}

/// The readings of a scan that tells the cells of an area these codes, and where there is none of them a reading of its own.
fn told(area: Area, codes: &[Option<u8>]) -> Readings {
    let mut readings = free(area, -7, NOTHING);
    readings.levels[1] = 9;
    for (index, &code) in codes.iter().enumerate() {
        match code {
            None => readings.others.push(Reading { cell: readings.codes.cell_at(index), log_odds: 9 }),
            Some(code) => readings.codes.set(index, code),
        }
        readings.occupied.extend((code == Some(OCCUPIED)).then_some(index));
    }
    readings
}

proptest! {
    /// What was told is taken out, and what was not, or not so often, is refused and changes nothing. A copy has the same sums.
    #[test]
    fn what_was_told_is_taken_out(
        scans in vec(vec(prop_oneof![Just(None), (NOTHING..=OCCUPIED).prop_map(Some)], 6), 3),
        steps in vec((0_usize..3, any::<bool>()), 1..40),
    ) {
        let area = Area::of_cell([3, -2]).union(Area::of_cell([5, -1]));
        let mut counts = Counts::<u16>::new(area, 6).unwrap();
        prop_assert!(counts.learn(&told(area, &scans[0])));
        let mut expected = [[0_i128; 2]; 6];
        for (scan, is_told) in steps {
            let (codes, mut next) = (&scans[scan], expected);
            for (pair, &code) in next.iter_mut().zip(codes).filter(|&(_, &code)| code != Some(NOTHING)) {
                pair[usize::from(code != Some(FREE))] += if is_told { 1 } else { -1 };
            }
            let is_held = next.iter().flatten().all(|&count| count >= 0);
            if is_told {
                prop_assert!(counts.learn(&told(area, codes)));
                counts.add(&told(area, codes));
            } else {
                prop_assert_eq!(counts.take(&told(area, codes)), is_held);
            }
            expected = if is_held { next } else { expected };
            let pairs: Vec<_> = expected.map(|[free, above]| (9 * above - 7 * free, 9 * above + 7 * free)).into();
            prop_assert_eq!(counts.pairs(area).collect::<Vec<_>>(), &pairs[..]);
            let copy: Counts<u32> = counts.copied(area, 6).unwrap();
            prop_assert_eq!(copy.pairs(area).collect::<Vec<_>>(), pairs);
        }
    }
}

/// Where one of the three rasters gets no memory, the others do not grow either, and counts that go over to the wide ones stay
/// with their cells.
#[test]
fn no_memory_for_one_raster_changes_none() {
    let area = Area::of_cell([3, -2]).union(Area::of_cell([4, 1]));
    let whole = area.union(Area::of_cell([-9, 7]));
    let of_cell = |cell| {
        let mut readings = free(area, -7, NOTHING);
        *readings.codes.cell_mut(cell) = FREE;
        readings
    };
    let told = [([3, -2], 2), ([4, 0], 300), ([3, 1], 5)];
    for refused in 0..3 {
        let mut counts = Counts::<u16>::new(area, 999).unwrap();
        let tell = |counts: &mut Counts<_>| {
            for (cell, times) in told {
                for _ in 0..times {
                    assert!(counts.learn(&of_cell(cell)));
                    counts.add(&of_cell(cell));
                }
            }
        };
        tell(&mut counts);
        refusal::after(refused);
        let error = counts.make_room(area, whole, 999).unwrap_err();
        assert!(matches!(error, Error::NoMemory { .. }), "{error}");
        tell(&mut counts);
        counts.make_room(area, whole, 999).unwrap();
        tell(&mut counts);
        let mut sums: Vec<_> = counts.pairs(whole).map(|(sum, _)| sum).filter(|&sum| sum != 0).collect();
        for (cell, times) in told {
            assert_eq!(counts.sum_of(cell), -21 * times);
        }
        sums.sort_unstable();
        assert_eq!(sums, [-21 * 300, -21 * 5, -21 * 2]);
    }
}

/// No count is lost where there are as many scans as the counts can hold, and one more.
#[test]
fn counts_are_full_before_they_overflow() {
    let area = Area::of_cell([3, -2]);
    let readings = free(area, -7, FREE);
    let mut counts = Counts::<u16>::new(area, 1).unwrap();
    while !counts.are_full() {
        assert!(counts.learn(&readings));
        counts.add(&readings);
    }
    assert_eq!(counts.sum_of([3, -2]), -7 * i128::from(u16::MAX));
    assert!(counts.copied::<u16>(area, 1).unwrap().are_full());
    let mut wider: Counts<u32> = counts.copied(area, 1).unwrap();
    assert!(!wider.are_full() && wider.learn(&readings));
    wider.add(&readings);
    assert_eq!(wider.sum_of([3, -2]), -7 << 16);
    assert!(wider.take(&readings) && counts.take(&readings));
    assert_eq!(wider.sum_of([3, -2]), counts.sum_of([3, -2]) - 7);
    // More than it was told, and of a level that it was not told.
    let mut empty = Counts::<u16>::new(area, 1).unwrap();
    assert!(!empty.take(&readings) && empty.learn(&readings) && !empty.take(&readings));
    assert!(!wider.take(&free(area, -8, FREE)));
}

/// What more scans told than a byte counts is taken out again, of both parts, and no more than that.
#[test]
fn both_parts_of_a_count_are_taken_out() {
    let area = Area::of_cell([3, -2]);
    let readings = free(area, -7, FREE);
    let mut counts = Counts::<u16>::new(area, 1).unwrap();
    for told in 1..=300 {
        assert!(counts.learn(&readings));
        counts.add(&readings);
        assert_eq!(counts.sum_of([3, -2]), -7 * told);
        assert_eq!(i128::from(counts.late), (told - 1) % 255 + 1, "all cells are settled once in 255 scans");
        assert_eq!(counts.runs(area, -2, 0..1).collect::<Vec<_>>(), [(-7 * told, 1)]);
    }
    for left in (0..300).rev() {
        assert!(counts.take(&readings));
        assert_eq!(counts.pairs(area).collect::<Vec<_>>(), [(-7 * left, 7 * left)]);
        assert_eq!(counts.are_within(area, None), left == 0);
    }
    assert!(!counts.take(&readings));
}
