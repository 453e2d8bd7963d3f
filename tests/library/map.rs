//! Grids, encodings and pooling.

use super::common::occupancy;
use approx::abs_diff_eq;
use mean_information::cell::{Cell, information};
use mean_information::map::encoding::{LogOdds, MrptLogOdds, Percent, Probability};
use mean_information::map::{Encoding, Geometry, Grid, Histogram, PolarMap};
use mean_information::{Error, InformationSum, Real, Tally};
use proptest::collection::vec;
use proptest::prelude::*;

fn geometry() -> Geometry {
    Geometry::new(0.05, [-3.0, 7.0]).unwrap()
}

/// A map of up to 24 x 24 cells.
fn map() -> impl Strategy<Value = Grid<Probability<f64>>> {
    (2_usize..24, 2_usize..24).prop_flat_map(|(width, height)| {
        vec(occupancy(), width * height)
            .prop_map(move |cells| Grid::new(width, height, geometry(), cells).expect("a valid map"))
    })
}

proptest! {
    /// Jensen: a pooled cell informs at most as much as the mean of what it pools, unknown cells outside the map included.
    /// The bound allows for one rounding of the mean (`|dI| <= p |log2 p| 2^-53 <= 2^-53`) and one of each `I`.
    #[test]
    fn pooling_never_raises_information_per_area(map in map(), k in 2_usize..9) {
        let pooled = map.pooled(k)?;
        let area = (k * k) as f64;
        for row in 0..pooled.height() {
            for column in 0..pooled.width() {
                let rows = row * k..((row + 1) * k).min(map.height());
                let columns = column * k..((column + 1) * k).min(map.width());
                let mut block: Vec<f64> =
                    rows.flat_map(|r| map.row(r).unwrap()[columns.clone()].iter().copied()).collect();
                block.resize(k * k, 0.5);
                let p = pooled.occupancy(row, column).unwrap();
                let mean_of_information = block.iter().map(|&p| information(p)).sum::<f64>() / area;
                prop_assert!(information(p) <= mean_of_information * (1.0 + 1e-13) + 2.0 * f64::EPSILON);
                if block.iter().all(|&p| p == 0.5) {
                    prop_assert_eq!(p, 0.5);
                }
                prop_assert!(abs_diff_eq!(p, block.iter().sum::<f64>() / area, epsilon = 1e-13));
            }
        }
        let (fine, coarse) = (map.tally(), pooled.tally());
        prop_assert!(area * coarse.information() <= fine.information() * (1.0 + 1e-13) + area * coarse.cells() as f64 * 4.0 * f64::EPSILON);
    }

    #[test]
    fn padding_with_unknown_cells_changes_no_pooled_measure(map in map(), k in 2_usize..9, right in 1_usize..9, above in 1_usize..9) {
        let mut cells = Vec::new();
        for row in 0..map.height() + above {
            cells.extend_from_slice(map.row(row).unwrap_or(&[]));
            cells.resize((row + 1) * (map.width() + right), 0.5);
        }
        let padded = Grid::<Probability<f64>>::new(map.width() + right, map.height() + above, geometry(), cells)?;
        let (bare, padded) = (map.pooled(k)?.tally(), padded.pooled(k)?.tally());
        prop_assert_eq!(bare.information().to_bits(), padded.information().to_bits());
        prop_assert_eq!((bare.free(), bare.occupied()), (padded.free(), padded.occupied()));
    }

    #[test]
    fn pooling_by_one_keeps_the_map(map in map()) {
        prop_assert_eq!(map.pooled(1)?, map);
    }

    #[test]
    fn pooling_commutes_with_mirroring_where_blocks_are_full(
        (k, columns, cells) in (2_usize..5, 2_usize..6)
            .prop_flat_map(|(k, columns)| (Just(k), Just(columns), vec(occupancy(), k * columns * k * 3))),
    ) {
        let width = k * columns;
        let mirrored: Vec<f64> = cells.chunks(width).flat_map(|row| row.iter().rev().copied()).collect();
        let pool = |cells| Grid::<Probability<f64>>::new(width, 3 * k, geometry(), cells)?.pooled(k);
        let (straight, mirrored) = (pool(cells)?, pool(mirrored)?);
        for row in 0..3 {
            let reversed: Vec<f64> = mirrored.row(row).unwrap().iter().rev().copied().collect();
            prop_assert_eq!(straight.row(row).unwrap(), &reversed[..]);
        }
        prop_assert_eq!(straight.tally(), mirrored.tally());
    }

    #[test]
    fn bytes_tallied_by_value_and_one_by_one_agree(cells in vec(-1_i8..=100, 1..300)) {
        let one_by_one = cells.iter().filter_map(|&stored| Percent::cell(stored)).collect();
        prop_assert_eq!(Percent::tally(&cells), one_by_one);
    }

    #[test]
    fn every_byte_of_mrpt_agrees_with_its_log_odds(stored in any::<i8>()) {
        let l = -f64::from(stored.max(-127)) / 16.0;
        prop_assert_eq!(MrptLogOdds::cell(stored), LogOdds::<f64>::cell(l));
        prop_assert_eq!(MrptLogOdds::occupancy(stored), LogOdds::<f64>::occupancy(l));
        prop_assert_eq!(MrptLogOdds::occupancy(stored).unwrap() < 0.5, stored > 0, "positive is free");
    }
}

#[test]
fn the_first_bad_cell_is_named() {
    let refused = Grid::<Percent>::new(3, 2, geometry(), vec![0, 50, 100, -1, 101, -2]).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "cell at row 1, column 1 is 101, allowed is a percentage from 0 to 100, or -1 for unknown"
    );
    let refused = Grid::<Probability<f32>>::new(2, 2, geometry(), vec![0.5, 0.5, 0.5, f32::NAN]).unwrap_err();
    assert!(matches!(refused, Error::Cell { row: 1, column: 1, value, .. } if value.is_nan()));
    assert!(Grid::<LogOdds<f64>>::new(1, 2, geometry(), vec![f64::NEG_INFINITY, f64::NAN]).is_err());
}

#[test]
fn the_number_of_cells_must_be_width_times_height() {
    let refused = Grid::<Percent>::new(3, 2, geometry(), vec![0; 7]).unwrap_err();
    assert_eq!(refused.to_string(), "7 cells were given for a map of 3 columns and 2 rows");
    assert!(Grid::<Percent>::new(usize::MAX, 2, geometry(), vec![0; 7]).is_err(), "no overflow");
    let empty = Grid::<Percent>::new(0, 5, geometry(), vec![]).unwrap();
    assert_eq!((empty.tally().cells(), empty.row(0), empty.row(5)), (0, Some(&[][..]), None));
    assert!(empty.pooled(2).unwrap().cells().is_empty());
}

#[test]
fn a_geometry_is_refused_with_its_reason() {
    let refused = |resolution, origin| Geometry::new(resolution, origin).unwrap_err().to_string();
    assert_eq!(refused(0.0, [0.0; 2]), "resolution is 0, allowed is positive and finite, in metres");
    assert!(Geometry::new(f64::NAN, [0.0; 2]).is_err() && Geometry::new(f64::INFINITY, [0.0; 2]).is_err());
    assert_eq!(refused(0.05, [0.0, f64::INFINITY]), "origin is inf, allowed is finite, in metres");
    assert!(geometry().with_yaw(f64::NAN).is_err());
}

#[test]
fn pooling_states_its_limits() {
    let map = Grid::<Percent>::new(5, 3, geometry(), vec![20; 15]).unwrap();
    assert!(map.pooled(0).is_err() && map.pooled((1 << 31) + 1).is_err());
    let one = map.pooled(10).unwrap();
    assert_eq!((one.width(), one.height(), one.cells()), (1, 1, &[0.455][..]));
    assert!(map.pooled(1 << 20).unwrap().cells()[0] < 0.5);
    assert_eq!(
        map.pooled(1 << 31).unwrap().cells(),
        [0.5],
        "15 cells in 2^62 are below the spacing of floats"
    );
    let coarse = map.pooled(2).unwrap();
    assert_eq!((coarse.width(), coarse.height()), (3, 2));
    assert_eq!(coarse.geometry().resolution(), 0.1);
    assert_eq!(coarse.geometry().origin(), [-3.0, 7.0]);
    let huge = Grid::<Percent>::new(1, 1, Geometry::new(1e305, [0.0; 2]).unwrap(), vec![7]).unwrap();
    assert!(huge.pooled(1 << 31).is_err(), "the coarse resolution is not finite");
}

#[test]
fn a_map_in_sectors() {
    let cells = vec![0.1, 0.2, 0.3, 0.6, 0.7, 0.8];
    let map = PolarMap::<Probability<f64>>::new(2, 3, 0.125, cells).unwrap();
    assert_eq!((map.sectors(), map.rings(), map.resolution()), (2, 3, 0.125));
    assert_eq!(map.sector(0), Some(&[0.1, 0.2, 0.3][..]));
    assert_eq!(map.sector(1), Some(&[0.6, 0.7, 0.8][..]));
    assert_eq!((map.sector(2), map.occupancy(1, 2), map.occupancy(1, 3)), (None, Some(0.8), None));
}

/// What a cell is stored as, and back.
#[test]
fn each_encoding_has_its_unknown_and_its_values() {
    assert_eq!((Percent::unknown(), MrptLogOdds::unknown(), LogOdds::<f64>::unknown()), (-1, 0, 0.0));
    assert_eq!((Percent::value(29), MrptLogOdds::value(-32), LogOdds::value(2.5_f32)), (29.0, -32.0, 2.5));
    assert_eq!(Percent::cell(29), Cell::from_occupancy(0.29).ok());
    assert_eq!(geometry().cell_area(), 0.05 * 0.05);
    let bytes = [-128, -127, -32, 0, 0, 64, 127];
    let cells = bytes.map(|byte| MrptLogOdds::cell(byte).unwrap());
    assert_eq!(MrptLogOdds::tally(&bytes), cells.into_iter().collect());
}

/// More values than are counted at a time, some of them often, and what is no cell.
#[test]
fn repeated_log_odds_are_counted_as_cells_one_by_one() {
    // Of 256 cells so many in no order are of seven values: nearly all, so that they are counted, or too few for that.
    fn check<T: Real>(count: u32, often: u32) {
        let value = |k: u32| T::nearest(f64::from(k % 5003) / 256.0 - 9.5);
        let is_often = |k: u32| k.wrapping_mul(0x9e37_79b9) >> 24 < often;
        let mut cells: Vec<T> = (0..count).map(|k| value(if is_often(k) { k % 7 } else { k })).collect();
        cells.extend([T::nan(), T::infinity(), T::zero(), -T::zero(), T::nan(), T::nan(), T::neg_infinity()]);
        for start in [0, cells.len() - 7, cells.len() - 1, cells.len()] {
            let cells = &cells[start..];
            let one_by_one: Tally<T> = cells.iter().filter_map(|&l| LogOdds::cell(l)).collect();
            assert_eq!(LogOdds::tally(cells), one_by_one);
        }
    }
    for often in [85, 240] {
        check::<f64>(20_011, often);
        check::<f32>(20_011, often);
    }
}

/// A map of few values that ends with many: those that are counted lose their slots, and then cells are taken as they are.
#[test]
fn log_odds_that_recur_no_more_are_counted_as_cells_one_by_one() {
    fn check<T: Real>() {
        let few = (0..80_000).map(|k| T::nearest(f64::from(k % 64) / 8.0 + 0.0625));
        let many = (0..15_000).map(|k| T::nearest(f64::from(k) / -2048.0));
        let cells: Vec<T> = few.chain(many.clone()).collect();
        let mut one_by_one: Tally<T> = many.filter_map(LogOdds::cell).collect();
        for &l in &cells[..64] {
            let count = cells[..80_000].iter().filter(|&&other| other == l).count();
            one_by_one.add_many(LogOdds::cell(l).unwrap(), count as u64);
        }
        assert_eq!(LogOdds::tally(&cells), one_by_one);
    }
    check::<f64>();
    check::<f32>();
}

/// As `costmap_2d` stores them: costs to 254, 255 for unknown. Here with those above 200 not allowed.
#[derive(Clone, Copy, Debug)]
struct Costs;

impl Encoding for Costs {
    type Stored = u8;
    type Float = f32;
    const ALLOWED: &'static str = "0 to 200, or 255 for unknown";

    fn unknown() -> u8 {
        255
    }

    fn value(cost: u8) -> f64 {
        cost.into()
    }

    fn cell(cost: u8) -> Option<Cell<f32>> {
        Self::occupancy(cost).and_then(|p| Cell::from_occupancy(p).ok())
    }

    fn occupancy(cost: u8) -> Option<f32> {
        match cost {
            255 => Some(0.5),
            0..=200 => Some(f32::from(cost) / 256.0),
            _ => None,
        }
    }
}

#[test]
fn an_encoding_of_ones_own_is_counted_too() {
    let cells: Vec<u8> = (0..9000_u32).map(|k| (k / 7 % 256) as u8).collect();
    let one_by_one: Tally<f32> = cells.iter().filter_map(|&cost| Costs::cell(cost)).collect();
    assert_eq!(Costs::tally(&cells), one_by_one);
    let histogram = Histogram::from_cells(&cells);
    assert_eq!(histogram.tally::<Costs>(), one_by_one);
    assert!(histogram.cells() == 9000 && one_by_one.cells() < 9000 && one_by_one.unknown() > 0);
    assert_ne!(histogram, Histogram::from_cells(&cells[1..]));
    assert_eq!(histogram.information_sum::<Costs>(), (&one_by_one).into());
}

/// One by one, many at once and in parts: the same histogram, and information and tally of all cells.
#[test]
fn a_histogram_by_parts() {
    let cells: Vec<i8> = (0..70_000_i64).map(|k| (k * k / 300 % 102 - 1) as i8).collect();
    let all = Histogram::from_cells(&cells);
    assert_eq!(all.tally::<Percent>(), cells.iter().filter_map(|&cell| Percent::cell(cell)).collect());
    assert_eq!(all.information_sum::<Percent>(), (&all.tally::<Percent>()).into());
    assert_ne!(all.information_sum::<Percent>(), all.information_sum::<MrptLogOdds>());
    for piece in [7, 300, 5000] {
        let parts = cells.chunks(piece).map(Histogram::from_cells);
        let sum: Histogram = parts.sum();
        assert_eq!((&sum, sum.cells()), (&all, 70_000));
    }
    assert_eq!(cells.iter().copied().collect::<Histogram>(), all);
    let (mut counted, mut extended) = (Histogram::new(), Histogram::new());
    for percent in -1..=100_i8 {
        counted.add_many(percent, all.count(percent));
    }
    assert_eq!((&counted, counted.cells()), (&all, 70_000));
    extended.extend(cells.iter().map(|&cell| cell as u8));
    assert_eq!((&extended, extended.cells()), (&all, 70_000));
    assert_eq!(<[Histogram; 0]>::into_iter([]).sum::<Histogram>(), Histogram::new());
    let parts = [&cells[..999], &cells[999..]].map(Histogram::from_cells);
    assert_eq!(parts.iter().sum::<Histogram>(), all);
    assert_eq!(Histogram::from_counts(all.counts()), Ok(all));
    let mut counts = [0; 256];
    (counts[3], counts[200]) = (u64::MAX, 1);
    assert!(matches!(
        Histogram::from_counts(&counts),
        Err(Error::OutOfRange { value: 18446744073709551616.0, .. })
    ));
}

#[test]
fn a_percentage_is_the_float_nearest_to_its_hundredth() {
    for percent in i8::MIN..=i8::MAX {
        let expected = match percent {
            -1 => Some(0.5),
            0..=100 => Some(f64::from(percent) / 100.0),
            _ => None,
        };
        assert_eq!(Percent::occupancy(percent), expected, "{percent}");
    }
}

#[test]
#[should_panic(expected = "a histogram counts at most 2^64 - 1 cells")]
fn a_histogram_does_not_wrap_around() {
    let mut histogram = Histogram::from_cells(&[3_u8]);
    histogram.add_many(5_u8, u64::MAX);
}

/// The information of stored cells is that of their tally, and each is counted as the cell that it is.
#[test]
fn information_is_that_of_the_tally_in_every_encoding() {
    fn check<E: Encoding>(cells: &[E::Stored]) {
        let one_by_one: Tally<E::Float> = cells.iter().filter_map(|&stored| E::cell(stored)).collect();
        assert_eq!(one_by_one.cells(), cells.len() as u64);
        assert_eq!(E::tally(cells), one_by_one);
        assert_eq!(E::information_sum(cells), InformationSum::from(&one_by_one));
        assert!(one_by_one.observed() > 0);
    }
    check::<Probability<f64>>(&[0.125, 0.5, 0.75, 1.0]);
    check::<Probability<f32>>(&[0.125, 0.5, 0.75, 0.0]);
    check::<LogOdds<f64>>(&[-2.5, 0.0, 3.25, f64::INFINITY]);
    check::<LogOdds<f32>>(&[-2.5, 0.0, 3.25]);
    check::<Percent>(&[-1, 0, 37, 50, 100]);
    check::<MrptLogOdds>(&[-128, -127, 0, 45, 127]);
}
