//! Neighbouring beams of a scan, which share cells near the sensor: between the first and the last of a fan all cells are free, as
//! far as each is less than a cell from the next.

use super::beams::Beam;
use super::columns::{Shared, Track};

/// Tells whether bearings fall from beam to beam in more than half of all steps: a scan that is stored across `±π` goes back once.
pub(super) fn is_clockwise<T>(beams: &[Beam<T>]) -> bool {
    let falls = beams.windows(2).filter(|pair| pair[0].bearing > pair[1].bearing).count();
    // A step less than beams.
    2 * falls >= beams.len()
}

/// Finds what each beam of a scan shares with its neighbours. Bearings rise from beam to beam, or fall, or are in any order: what is
/// found is right, and less.
pub(super) fn shares(tracks: &[Track], is_clockwise: bool) -> impl Iterator<Item = Shared> {
    let (mut fans, mut before) = (Fans::new(is_clockwise), 0);
    tracks.iter().enumerate().map(move |(k, track)| {
        let after = tracks.get(k + 1).map_or(0, |next| fans.shared(track, next));
        let shared = [before.min(after), before.max(after)];
        before = after;
        shared
    })
}

/// The fans of a scan, one for each quarter of a turn, which is swept once: beams of a second sweep share nothing.
struct Fans {
    /// The sign of slopes that rise as beams come, for each quarter.
    signs: [f64; 4],
    /// How far each quarter has been swept: the slope of the last beam that shares cells with the one before.
    swept: [f64; 4],
    /// True if the last two beams share cells.
    is_chain: bool,
}

/// Slopes and their differences are known within so much.
const SLOPE_ERROR: f64 = 1.0 / (1_u64 << 50) as f64;

impl Fans {
    /// Begins a scan whose bearings rise from beam to beam, or fall.
    fn new(is_clockwise: bool) -> Self {
        // Counter-clockwise, slopes rise where x does, and fall where it falls; across, the other way round.
        let signs = [1.0, -1.0, -1.0, 1.0];
        let signs = if is_clockwise { signs.map(|sign: f64| -sign) } else { signs };
        Self { signs, swept: [f64::NEG_INFINITY; 4], is_chain: false }
    }

    /// Finds up to which column from 1 on a beam and the next one share cells: both mark these columns, and no cell lies between
    /// them (`scan.md`, Theorem (fans)). 0 if they share none.
    #[inline]
    fn shared(&mut self, beam: &Track, next: &Track) -> u64 {
        let quarter = beam.quarter();
        let was_chain = core::mem::replace(&mut self.is_chain, false);
        if next.quarter() != quarter {
            return 0;
        }
        let slopes = [beam.slope, next.slope];
        let [from, to] = slopes.map(|slope| self.signs[quarter] * slope);
        let is_new = was_chain || from > self.swept[quarter] + SLOPE_ERROR;
        if !(is_new && to > from + SLOPE_ERROR) {
            return 0;
        }
        (self.swept[quarter], self.is_chain) = (to, true);
        let [lower, upper] = if slopes[0] < slopes[1] { slopes } else { [slopes[1], slopes[0]] };
        // As many columns as cells of distance from the sensor, and a steep beam goes across a part of a cell within a column.
        let apart = 1.0 + lower.max(-upper).max(0.0) - SLOPE_ERROR;
        let columns = apart / (upper - lower + SLOPE_ERROR);
        beam.sure_columns().min(next.sure_columns()).min(columns as i64 as u64)
    }
}

#[cfg(test)]
mod tests {
    use super::super::codes::FREE;
    use super::super::columns::Canvas;
    use super::super::direction::Direction;
    use super::super::lattice::{FRACTION, Point, cell_of};
    use super::super::raster::Area;
    use super::super::traversal::Traversal;
    use super::*;
    use alloc::vec::Vec;
    use proptest::collection::vec;
    use proptest::prelude::*;
    use std::collections::BTreeSet;

    const CELL: i64 = 1 << FRACTION;

    /// Beams as fractions of a turn from the first, with their lengths and the parts that are sure: a sweep, either way, of up to
    /// two turns, or in any order.
    fn beams() -> impl Strategy<Value = Vec<(f64, f64, f64)>> {
        let lengths = (1.0_f64..90.0, 0.0_f64..0.5).prop_flat_map(|(length, rough)| {
            vec((Just(length), 0.0..=rough, prop_oneof![3 => Just(1.0), 1 => 0.0_f64..1.0]), 2..60)
        });
        let step = prop_oneof![-0.01_f64..0.01, -0.04_f64..0.04, Just(1.0 / 64.0), Just(0.0)];
        (lengths, step, 0.0_f64..0.01, prop_oneof![4 => Just(false), 1 => Just(true)]).prop_map(
            |(lengths, step, jitter, is_mixed)| {
                let beam = |(k, (length, rough, sure)): (usize, (f64, f64, f64))| {
                    let part = (k as f64 * 0.618_033_988_749_894_9).fract();
                    let turn = if is_mixed { part } else { k as f64 * step + jitter * part };
                    (turn, length * (1.0 - rough), sure)
                };
                lengths.into_iter().enumerate().map(beam).collect()
            },
        )
    }

    /// Starts inside of cells, on lines and on corners.
    fn start() -> impl Strategy<Value = Point> {
        let place = || prop_oneof![-CELL..CELL, Just(0), Just(CELL / 2), Just(CELL - 1)];
        [place(), place()]
    }

    /// Compares what is drawn with the cells of all sure columns: whatever is shared, these and no others.
    fn check(start: Point, beams: &[(Point, u64)], is_clockwise: bool) -> Result<(), TestCaseError> {
        let mut area = Area::of_cell(cell_of(start)).with_columns(64);
        let mut tracks = Vec::new();
        for &(end, length) in beams {
            area = area.union(Area::of_cell(cell_of(end)));
            tracks.push(Track::new(start, end, length));
        }
        let mut canvas = Canvas::new(area, u64::MAX).unwrap();
        let mut expected = BTreeSet::new();
        for ((track, shared), &(end, _)) in tracks.iter().zip(shares(&tracks, is_clockwise)).zip(beams) {
            track.draw(shared, &mut canvas);
            let rest: Vec<_> =
                track.rest().flat_map(|column| track.cells(column)).map(|(cell, _)| cell).collect();
            let all: Vec<_> = Traversal::new(start, end).collect();
            prop_assert_eq!(&rest[..], &all[all.len() - rest.len()..]);
            expected.extend(all[..all.len() - rest.len()].iter().copied());
        }
        let codes = canvas.settled();
        for row in area.rows() {
            for (column, &code) in (area.low()[0]..).zip(codes.row(area, row)) {
                prop_assert_eq!(code == FREE, expected.contains(&[column, row]), "{:?}", [column, row]);
            }
        }
        Ok(())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]

        #[test]
        fn fans_are_the_cells_of_their_beams(start in start(), first in prop_oneof![0.0_f64..1.0, (0_u32..8).prop_map(|k| f64::from(k) / 8.0)], beams in beams(), is_clockwise in any::<bool>()) {
            let beam = |&(turn, length, sure): &(f64, f64, f64)| {
                let direction = Direction::new(&[(first + turn) * std::f64::consts::TAU]).unwrap();
                let end = [direction.cos(), direction.sin()].map(|part| (length * part * CELL as f64).round() as i64);
                ([start[0] + end[0], start[1] + end[1]], (length * sure * CELL as f64) as u64)
            };
            check(start, &beams.iter().map(beam).collect::<Vec<_>>(), is_clockwise)?;
        }

        /// Slopes of few cells, from corners and the middles of sides: many columns in which beams are a cell apart, and no less.
        #[test]
        fn so_are_fans_of_simple_slopes(start in [-2_i64..3, -2_i64..3], mut ends in vec([1_i64..40, -40_i64..40], 2..9), quarter in 0..4, is_clockwise in any::<bool>()) {
            ends.sort_unstable_by_key(|[x, y]| (i128::from(*y) << 64) / i128::from(*x));
            let turned = |end| (0..quarter).fold(end, |[x, y]: Point, _| [-y, x]);
            let place = |end: Point| [0, 1].map(|k| (start[k] + end[k]) * (CELL / 2));
            let beams: Vec<_> = ends.into_iter().map(|end| (place(turned(end)), u64::MAX >> 2)).collect();
            check(place([0, 0]), &beams, is_clockwise)?;
        }
    }

    /// A beam down through a corner and one up through the next, between which there is a cell; and beams that pass a corner below,
    /// above and below it, which floats of their slopes do not tell apart.
    #[test]
    fn beams_that_are_a_cell_apart_or_none_share_nothing() {
        let beam = |x: i64, y: i64| ([x, y], u64::MAX >> 2);
        let half = CELL / 2;
        check([0, half], &[beam(20 * half, -9 * half), beam(20 * half, 11 * half)], false).unwrap();
        // With the corner at [2 w + 1, w] from the start a place at twice that and [2, 1] is above the line through it, by a unit of area.
        let (start, corner) = ([1, 1], [16 * CELL, 8 * CELL]);
        let past = |more: i64| beam(2 * corner[0] - 1 + 2 * more, 2 * corner[1] - 1 + more);
        check(start, &[past(-1), past(1), past(-1)], false).unwrap();
    }

    /// Those of a scan that begins behind the sensor, in `[-π, π)`, turn as the others do.
    #[test]
    fn bearings_that_go_on_at_the_other_end_keep_their_sense() {
        let turned =
            |k: i32| Beam { bearing: f64::from((k + 540) % 720 - 360).to_radians() / 2.0, range: Some(1.0) };
        let mut beams: Vec<_> = (0..720).map(turned).collect();
        assert!(beams[0].bearing > beams[719].bearing, "by the first and the last alone");
        assert!(!is_clockwise(&beams) && !is_clockwise(&beams[..1]));
        assert!(!is_clockwise(&[beams[0]; 9]), "they go nowhere");
        beams.reverse();
        assert!(is_clockwise(&beams) && is_clockwise(&beams[..2]));
    }

    /// A scanner of half a turn at a quarter of a degree: near the sensor a beam has nothing to mark.
    #[test]
    fn dense_beams_share_nearly_all_columns() {
        let track = |k: u32| {
            let direction = Direction::new(&[(f64::from(k) * 0.25_f64).to_radians()]).unwrap();
            let end =
                [direction.cos(), direction.sin()].map(|part| (60.0 * part * CELL as f64).round() as i64);
            Track::new([CELL / 2, CELL / 2], end, u64::MAX >> 2)
        };
        for is_clockwise in [false, true] {
            let mut tracks: Vec<_> = (0..720).map(track).collect();
            if is_clockwise {
                tracks.reverse();
            }
            let (mut shared, mut all) = (0, 0);
            for (track, [both, _]) in tracks.iter().zip(shares(&tracks, is_clockwise)) {
                (shared, all) = (shared + both, all + track.sure_columns());
            }
            assert!(shared * 100 > all * 98, "{shared} of {all}");
            assert!(shares(&tracks, !is_clockwise).all(|shared| shared == [0, 0]));
        }
    }
}
