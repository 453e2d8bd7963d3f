//! Expected maps: exact means, Jensen's inequality, alignment, and what is refused.

use super::common::{mirrorable, occupancy, power};
use approx::abs_diff_eq;
use mean_information::Error;
use mean_information::cell::{information, occupancy_from_log_odds};
use mean_information::expected::{ExpectedMap, Hypotheses, weighted_mean};
use mean_information::fusion::fuse;
use mean_information::map::encoding::{LogOdds, MrptLogOdds, Probability};
use mean_information::map::{Geometry, Grid};
use num_bigint::BigInt;
use proptest::collection::vec;
use proptest::prelude::*;

mod agreement;

type Map = Grid<Probability<f64>>;

const SIZE: [usize; 2] = [5, 3];

fn map(cells: Vec<f64>) -> Map {
    Grid::new(SIZE[0], SIZE[1], Geometry::new(0.05, [-3.0, 7.0]).unwrap(), cells).unwrap()
}

/// Weights of which none is 1 and some are 0, not normalised, far apart.
fn weight() -> impl Strategy<Value = f64> {
    prop_oneof![4 => 1e-3_f64..50.0, 1 => Just(0.0), 1 => (-300_i32..300).prop_map(|k| 1.5 * power(k))]
}

/// Up to six maps and their weights.
fn hypotheses(p: impl Strategy<Value = f64>) -> impl Strategy<Value = (Vec<Map>, Vec<f64>)> {
    let one = (vec(p, SIZE[0] * SIZE[1]), weight());
    vec(one, 1..7)
        .prop_map(|all| all.into_iter().map(|(cells, weight)| (map(cells), weight)).unzip())
        .prop_filter("a weight above 0", |(_, weights): &(_, Vec<f64>)| weights.iter().any(|&w| w > 0.0))
}

fn expected(maps: &[Map], weights: &[f64]) -> ExpectedMap<f64> {
    Hypotheses::new(maps, weights).unwrap().expected_map().unwrap()
}

/// `x 2^1074`.
fn big(x: f64) -> BigInt {
    let (m, e) = mean_information::Real::parts(x);
    let magnitude = BigInt::from(m) << (e + 1074);
    if x < 0.0 { -magnitude } else { magnitude }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// The other way: in integers of any size, `|x - mean| <= |y - mean|` for both neighbours `y` of the float.
    #[test]
    fn a_weighted_mean_is_the_nearest_float(pairs in vec((weight(), prop_oneof![occupancy(), -1e3..1e3, any::<f64>()]), 1..7)) {
        let (weights, values): (Vec<f64>, Vec<f64>) = pairs.into_iter().unzip();
        prop_assume!(weights.iter().any(|&w| w > 0.0) && values.iter().all(|x| x.abs() < 1e300));
        let mean = weighted_mean(&weights, &values)?;
        let total: BigInt = weights.iter().copied().map(big).sum();
        let sum: BigInt = weights.iter().zip(&values).map(|(&w, &x)| big(w) * big(x)).sum();
        let error = |x: f64| {
            let error: BigInt = big(x) * &total - &sum;
            error.magnitude().clone()
        };
        prop_assert!(error(mean) <= error(mean.next_up()) && error(mean) <= error(mean.next_down()), "{:e}", mean);
    }

    /// Two ways: with the map and without; many cells agree, in stretches and alone.
    #[test]
    fn the_tally_without_a_map_is_that_with_one(
        common in vec((occupancy(), any::<bool>()), SIZE[0] * SIZE[1]), (maps, weights) in hypotheses(occupancy()), offsets in vec(0_usize..3, 7),
        bytes in vec(any::<i8>(), 2 * SIZE[0] * SIZE[1]),
    ) {
        let maps: Vec<Map> = maps.into_iter().enumerate().map(|(k, one)| {
            let agreed = |(&(p, agree), &own): (&(f64, bool), &f64)| if agree { if p < 0.3 { 0.5 } else { p } } else { own };
            let cells = common.iter().zip(one.cells()).map(agreed).collect();
            let place = [-3.0 + 0.05 * offsets[k] as f64, 7.0 + 0.05 * (offsets[k] / 2) as f64];
            Grid::new(SIZE[0], SIZE[1], Geometry::new(0.05, place).unwrap(), cells).unwrap()
        }).collect();
        let (alone, with_map) = (Hypotheses::new(&maps, &weights)?.expected_tally()?, expected(&maps, &weights));
        prop_assert_eq!(&alone, with_map.tally());
        let bytes: Vec<_> = bytes.chunks(SIZE[0] * SIZE[1]).map(|cells| {
            Grid::<MrptLogOdds>::new(SIZE[0], SIZE[1], *maps[0].geometry(), cells.to_vec()).unwrap()
        }).collect();
        let hypotheses = Hypotheses::new(&bytes, &[0.75, 0.3])?;
        let (alone, with_map) = (hypotheses.expected_tally()?, hypotheses.expected_map()?);
        prop_assert_eq!(&alone, with_map.tally());
        let single = |map: &Map| {
            let cells = map.cells().iter().map(|&p| p as f32).collect();
            Grid::<Probability<f32>>::new(SIZE[0], SIZE[1], *map.geometry(), cells).unwrap()
        };
        let single: Vec<_> = maps.iter().map(single).collect();
        let hypotheses = Hypotheses::new(&single, &weights)?;
        let (alone, with_map) = (hypotheses.expected_tally()?, hypotheses.expected_map()?);
        prop_assert_eq!(&alone, with_map.tally());
    }

    /// A cell in which all agree, and one in which one of no weight differs, by which the sums take the other way.
    #[test]
    fn agreement_is_a_mean_like_any_other(p in occupancy(), other in occupancy(), weights in vec(1e-3_f64..50.0, 1..5)) {
        let one = |p| Grid::<Probability<f64>>::new(1, 1, Geometry::new(0.5, [0.0; 2]).unwrap(), vec![p]).unwrap();
        let mut maps = vec![one(p); weights.len()];
        let agreed = Hypotheses::new(&maps, &weights)?.expected_map()?;
        maps.push(one(other));
        let mut weights = weights;
        weights.push(0.0);
        prop_assert_eq!(agreed, Hypotheses::new(&maps, &weights)?.expected_map()?);
    }

    #[test]
    fn unknown_in_all_stays_unknown((maps, weights) in hypotheses(occupancy()), at in 0..SIZE[0] * SIZE[1]) {
        let maps: Vec<Map> = maps.into_iter().map(|one| {
            let mut cells = one.cells().to_vec();
            cells[at] = 0.5;
            map(cells)
        }).collect();
        let expected = expected(&maps, &weights);
        prop_assert_eq!(expected.grid().cells()[at], 0.5);
        prop_assert!(expected.tally().unknown() >= 1);
        let pool = Hypotheses::new(&maps, &weights)?.log_linear_pool();
        prop_assert!(pool.is_err() || pool.is_ok_and(|pool| pool.cells()[at] == 0.0));
    }

    /// Scales of three bits, of weights of 50: their products are floats.
    #[test]
    fn neither_order_nor_scale_of_the_weights_changes_a_bit(
        (maps, weights) in hypotheses(occupancy()), turn in 0_usize..6, scale in prop::sample::select(vec![1, 3, 5, 7]), k in -40_i32..40,
    ) {
        let mut weights: Vec<f64> = weights.into_iter().map(|w| f64::from_bits(w.to_bits() & !7)).collect();
        let whole = expected(&maps, &weights);
        let turn = turn % maps.len();
        let mut maps = maps;
        maps.rotate_left(turn);
        weights.rotate_left(turn);
        for weight in &mut weights {
            *weight *= f64::from(scale) * power(k);
        }
        prop_assert_eq!(whole, expected(&maps, &weights));
    }

    /// Agreement: the expected map of equal maps is the map, and so is that of one with weight.
    #[test]
    fn hypotheses_that_agree(cells in vec(occupancy(), SIZE[0] * SIZE[1]), other in vec(occupancy(), SIZE[0] * SIZE[1]), weights in vec(1e-3_f64..50.0, 1..5)) {
        let one = map(cells);
        let maps = vec![one.clone(); weights.len()];
        let together = expected(&maps, &weights);
        prop_assert_eq!(together.grid(), &one);
        let alone = expected(&[map(other), one.clone()], &[0.0, weights[0]]);
        prop_assert_eq!(alone, together.clone());
        let (own, expected) = (one.tally(), together.tally());
        prop_assert_eq!((own.free(), own.occupied(), own.unknown()), (expected.free(), expected.occupied(), expected.unknown()));
        // Cells here are rounded, each by at most 2^-54; there they are not; then both round.
        let cells = one.cells().len() as f64;
        let tolerance = cells * (power(-54) + power(-63)) + own.information() * f64::EPSILON;
        prop_assert!(abs_diff_eq!(own.information(), expected.information(), epsilon = tolerance));
        prop_assert!(abs_diff_eq!(own.entropy(), expected.entropy(), epsilon = cells * (power(-54) + power(-63)) + own.entropy() * f64::EPSILON));
        prop_assert!(abs_diff_eq!(own.mean_information(), expected.mean_information(), epsilon = power(-54) + power(-63) + power(-53)));
    }

    /// `I(EM) <= sum w_i I(m_i) / sum w_i`: each cell of the right side is rounded by at most `2^-54`, each of the
    /// left by `2^-63`; the three sums round once each.
    #[test]
    fn disagreement_only_lowers_information((maps, weights) in hypotheses(occupancy())) {
        let expected = expected(&maps, &weights);
        let own: Vec<f64> = maps.iter().map(|map| map.tally().information()).collect();
        let mean = weighted_mean(&weights, &own)?;
        let cells = (SIZE[0] * SIZE[1]) as f64;
        prop_assert!(expected.tally().information() <= mean * (1.0 + 2.0 * f64::EPSILON) + cells * (power(-54) + power(-63)));
        // Cell by cell, on the rounded means.
        for (k, &p) in expected.grid().cells().iter().enumerate() {
            let own: Vec<f64> = maps.iter().map(|map| information(map.cells()[k])).collect();
            // |dI/dp| ulp(p) / 2 is at most 53 bits at 1 - 2^-53, times 2^-54.
            prop_assert!(information(p) <= weighted_mean(&weights, &own)? + 54.0 * power(-54) + power(-52));
        }
    }

    /// Free and occupied change places, to the last bit: `1 - p` is a float here.
    #[test]
    fn mirrored_hypotheses_have_the_same_sums((maps, weights) in hypotheses(mirrorable())) {
        let mirrored: Vec<Map> = maps.iter().map(|one| map(one.cells().iter().map(|p| 1.0 - p).collect())).collect();
        let (straight, mirrored) = (expected(&maps, &weights), expected(&mirrored, &weights));
        let (a, b) = (straight.tally(), mirrored.tally());
        prop_assert_eq!((a.free(), a.occupied()), (b.occupied(), b.free()));
        prop_assert_eq!(a.mean_information().to_bits(), b.mean_information().to_bits());
        prop_assert_eq!(a.entropy().to_bits(), b.entropy().to_bits());
    }

    /// A map of its own extent is the map padded with unknown cells.
    #[test]
    fn beyond_its_extent_a_map_is_unknown((maps, weights) in hypotheses(occupancy()), offsets in vec((0_usize..4, 0_usize..4), 7)) {
        let resolution = 0.05;
        let place = |k: usize| [-3.0 + offsets[k].0 as f64 * resolution, 7.0 + offsets[k].1 as f64 * resolution];
        let placed: Vec<Map> = maps.iter().enumerate().map(|(k, map)| {
            Grid::new(SIZE[0], SIZE[1], Geometry::new(resolution, place(k)).unwrap(), map.cells().to_vec()).unwrap()
        }).collect();
        let low = [0, 1].map(|axis| (0..maps.len()).map(|k| [offsets[k].0, offsets[k].1][axis]).min().unwrap());
        let high = [0, 1].map(|axis| (0..maps.len()).map(|k| [offsets[k].0, offsets[k].1][axis] + SIZE[axis]).max().unwrap());
        let (width, height) = (high[0] - low[0], high[1] - low[1]);
        let padded: Vec<Map> = maps.iter().enumerate().map(|(k, map)| {
            let mut cells = vec![0.5; width * height];
            for row in 0..SIZE[1] {
                let start = (row + offsets[k].1 - low[1]) * width + offsets[k].0 - low[0];
                cells[start..start + SIZE[0]].copy_from_slice(map.row(row).unwrap());
            }
            Grid::new(width, height, Geometry::new(resolution, [0.0; 2]).unwrap(), cells).unwrap()
        }).collect();
        let (placed, padded) = (expected(&placed, &weights), expected(&padded, &weights));
        prop_assert_eq!((placed.grid().width(), placed.grid().height()), (width, height));
        prop_assert_eq!(placed.grid().cells(), padded.grid().cells());
        prop_assert_eq!(placed.tally(), padded.tally());
        let origin = placed.grid().geometry().origin();
        prop_assert!(abs_diff_eq!(origin[0], -3.0 + low[0] as f64 * resolution, epsilon = 1e-12));
    }

    /// Twice the pool of two equal weights is the sum of the log-odds, as in fusion; all four roundings are relative
    /// to the two.
    #[test]
    fn the_log_linear_pool_of_two_is_half_their_fusion(p in 0.001_f64..0.999, q in 0.001_f64..0.999) {
        let one = |p| Grid::<Probability<f64>>::new(1, 1, Geometry::new(0.5, [0.0; 2]).unwrap(), vec![p]).unwrap();
        let maps = [one(p), one(q)];
        let pool = Hypotheses::new(&maps, &[3.0, 3.0])?.log_linear_pool()?.cells()[0];
        prop_assert!(abs_diff_eq!(occupancy_from_log_odds(2.0 * pool), fuse(&[p, q])?, epsilon = 16.0 * f64::EPSILON));
    }
}

fn row(resolution: f64, x: f64, cells: &[f64]) -> Map {
    Grid::new(cells.len(), 1, Geometry::new(resolution, [x, 0.25]).unwrap(), cells.to_vec()).unwrap()
}

/// Within the limit, and beyond any memory.
#[test]
fn a_map_without_memory_is_not_beyond_the_limit() {
    let maps = [row(1.0, 0.0, &[0.25]), row(1.0, 4e18, &[0.25])];
    let hypotheses = Hypotheses::new(&maps, &[3.0, 5.0]).unwrap().with_max_cells(u64::MAX);
    let refused = hypotheses.expected_map().map(drop).unwrap_err();
    assert!(matches!(refused, Error::NoMemory { cells: 4e18, .. }), "{refused}");
}

/// The mean is not 1/2, but the nearest float is: the cell was observed all the same.
#[test]
fn a_cell_that_one_unlikely_particle_saw_is_observed() {
    let maps = [row(0.5, 0.0, &[0.5, 0.25]), row(0.5, 0.0, &[0.875, 0.25])];
    let expected = Hypotheses::new(&maps, &[3.0, 3e-20]).unwrap().expected_map().unwrap();
    assert_eq!(expected.grid().cells(), [0.5, 0.25]);
    assert_eq!((expected.tally().observed(), expected.tally().occupied()), (2, 1));
    assert_eq!(expected.tally().mean_information(), information(0.25) / 2.0);
}

/// One number, two fractions: in thirds and in ninths, whose long divisions differ by a bit.
#[test]
fn weights_in_other_units() {
    let maps = [row(0.5, 0.0, &[0.1]), row(0.5, 0.0, &[0.2])];
    assert_eq!(expected(&maps, &[1.0, 2.0]), expected(&maps, &[3.0, 6.0]));
}

#[test]
fn certain_and_impossible_means() {
    let maps = [row(0.5, 0.0, &[0.0, 1.0, 0.0]), row(0.5, 0.0, &[0.0, 1.0, 1.0])];
    let expected = Hypotheses::new(&maps, &[3.0, 3.0]).unwrap().expected_map().unwrap();
    assert_eq!(expected.grid().cells(), [0.0, 1.0, 0.5]);
    let tally = expected.tally();
    assert_eq!((tally.free(), tally.occupied(), tally.unknown()), (1, 1, 1));
    assert_eq!((tally.mean_information(), tally.entropy()), (1.0, 1.0));
}

#[test]
fn maps_that_do_not_fit_are_refused_with_the_reason() {
    let refused = |maps: &[Map]| {
        let hypotheses = Hypotheses::new(maps, &vec![0.25; maps.len()]).unwrap();
        let hypotheses = hypotheses.with_max_cells(1000);
        assert_eq!(hypotheses.expected_tally().unwrap_err(), hypotheses.expected_map().unwrap_err());
        hypotheses.expected_map().unwrap_err().to_string()
    };
    let first = row(0.5, 1.0, &[0.25, 0.75]);
    assert_eq!(
        refused(&[first.clone(), row(0.25, 1.0, &[0.25])]),
        "resolution of map 1 is 0.25, allowed is that of map 0"
    );
    assert_eq!(
        refused(&[first.clone(), row(0.5, 1.75, &[0.25])]),
        "offset in cells of map 1 is 1.5, allowed is a whole number, within 1/1024"
    );
    assert_eq!(
        refused(&[first.clone(), row(0.5, 1e3, &[0.25])]),
        "the map has 1.999e3 cells, allowed are 1000"
    );
    assert!(refused(&[first.clone(), row(0.5, 1e300, &[0.25])]).starts_with("the map has"));
    let turned = |x: f64, yaw| {
        let geometry = Geometry::new(0.5, [x, 0.25]).unwrap().with_yaw(yaw).unwrap();
        Map::new(1, 1, geometry, vec![0.25]).unwrap()
    };
    assert_eq!(
        refused(&[turned(1.0, 0.3), turned(1.0, 0.4)]),
        "yaw of map 1 is 0.4, allowed is that of map 0"
    );
    assert!(
        refused(&[turned(1.0, 0.3), turned(1.5, 0.3)]).contains("allowed is 0, for maps that are turned")
    );
    let both = [turned(1.0, 0.3), turned(1.0, 0.3)];
    assert_eq!(Hypotheses::new(&both, &[2.0, 3.0]).unwrap().expected_map().unwrap().grid(), &both[0]);
    // Off by less than file formats round: 2 mm in 5 m.
    let near = [first, row(0.5, 1.5004, &[0.25])];
    let expected = Hypotheses::new(&near, &[2.0, 2.0]).unwrap().expected_map().unwrap();
    assert_eq!(expected.grid().cells(), [0.375, 0.5]);
}

#[test]
fn maps_without_cells_lie_nowhere() {
    let empty = row(0.5, 77.125, &[]);
    let maps = [empty.clone(), row(0.5, 1.0, &[0.25])];
    let expected = Hypotheses::new(&maps, &[1.5, 0.5]).unwrap().expected_map().unwrap();
    assert_eq!((expected.grid().cells(), expected.grid().geometry().origin()), (&[0.4375][..], [1.0, 0.25]));
    let none = [empty];
    assert_eq!(Hypotheses::new(&none, &[1.5]).unwrap().expected_map().unwrap().tally().cells(), 0);
}

#[test]
fn weights_are_checked() {
    let maps = [row(0.5, 0.0, &[0.25]), row(0.5, 0.0, &[0.75])];
    let refused = |weights: &[f64]| Hypotheses::new(&maps, weights).unwrap_err().to_string();
    assert_eq!(refused(&[0.5]), "number of weights is 1, allowed is 2: one for each item");
    assert_eq!(refused(&[0.5, -0.5]), "weight 1 is -0.5, allowed is not negative and finite");
    assert!(refused(&[f64::NAN, 0.5]).starts_with("weight 0 is NaN"));
    assert!(refused(&[0.5, f64::INFINITY]).starts_with("weight 1 is inf"));
    assert_eq!(refused(&[0.0, -0.0]), "sum of the weights is 0, allowed is above 0");
    assert_eq!(
        Hypotheses::<Probability<f64>>::new(&[], &[]).unwrap_err().to_string(),
        "number of maps is 0, allowed is 1 or more"
    );
    assert!(matches!(weighted_mean(&[0.5, 0.5], &[1.0, f64::INFINITY]), Err(Error::Item { index: 1, .. })));
    // The largest and the smallest weights there are.
    let hypotheses = Hypotheses::new(&maps, &[f64::MAX, f64::MAX]).unwrap();
    assert_eq!(hypotheses.expected_map().unwrap().grid().cells(), [0.5]);
    let hypotheses = Hypotheses::new(&maps, &[f64::from_bits(1), f64::from_bits(3)]).unwrap();
    assert_eq!(hypotheses.expected_map().unwrap().grid().cells(), [0.625]);
    let hypotheses = Hypotheses::new(&maps, &[f64::from_bits(1), f64::MAX]).unwrap();
    assert_eq!(hypotheses.expected_map().unwrap().grid().cells(), [0.75]);
}

/// Not `-0`, in whatever order the values cancel.
#[test]
fn what_cancels_is_zero() {
    for values in [[3.0_f64, -1.0], [-3.0, 1.0], [0.0, 0.0], [-0.0, -0.0]] {
        assert_eq!(weighted_mean(&[2.0, 6.0], &values).unwrap().to_bits(), 0);
    }
}

#[test]
fn certainties_in_the_log_linear_pool() {
    let one =
        |l: f64| Grid::<LogOdds<f64>>::new(1, 1, Geometry::new(0.5, [0.0; 2]).unwrap(), vec![l]).unwrap();
    let pool = |l: [f64; 2], weights: [f64; 2]| {
        Hypotheses::new(&[one(l[0]), one(l[1])], &weights)
            .unwrap()
            .log_linear_pool()
            .map(|pool| pool.cells()[0])
    };
    let infinite = f64::INFINITY;
    assert_eq!(pool([2.0, -6.0], [3.0, 5.0]), Ok(-3.0));
    assert_eq!(pool([infinite, -6.0], [3.0, 5.0]), Ok(infinite));
    assert_eq!(pool([infinite, -6.0], [0.0, 5.0]), Ok(-6.0));
    assert_eq!(pool([infinite, -infinite], [0.0, 5.0]), Ok(-infinite));
    assert!(matches!(pool([infinite, -infinite], [3.0, 5.0]), Err(Error::Cell { row: 0, column: 0, .. })));
}

/// Runs on which all agree, between cells on which they do not; and the place of a contradiction.
#[test]
fn the_pool_of_maps_that_mostly_agree() {
    let infinite = f64::INFINITY;
    let map = |differing: f64, last: f64| {
        let cells = vec![1.5, 1.5, 1.5, 0.0, differing, -2.5, -2.5, last, 0.75];
        Grid::<LogOdds<f64>>::new(3, 3, Geometry::new(0.5, [0.0; 2]).unwrap(), cells).unwrap()
    };
    let pool = |maps: [Grid<LogOdds<f64>>; 2]| Hypotheses::new(&maps, &[3.0, 5.0]).unwrap().log_linear_pool();
    let pooled = pool([map(2.0, 4.0), map(-6.0, 4.0)]).unwrap();
    assert_eq!(pooled.cells(), [1.5, 1.5, 1.5, 0.0, -3.0, -2.5, -2.5, 4.0, 0.75]);
    let refused = pool([map(2.0, infinite), map(2.0, -infinite)]).unwrap_err();
    assert!(matches!(refused, Error::Cell { row: 2, column: 1, .. }), "{refused}");
}

/// In MRPT's encoding the pool is a mean of bytes: `-16 l`.
#[test]
fn the_pool_of_bytes() {
    let one =
        |byte: i8| Grid::<MrptLogOdds>::new(1, 1, Geometry::new(0.5, [0.0; 2]).unwrap(), vec![byte]).unwrap();
    let maps = [one(127), one(-100), one(0)];
    let pool = Hypotheses::new(&maps, &[2.0, 5.0, 3.0]).unwrap().log_linear_pool().unwrap();
    assert_eq!(pool.cells(), [24.6 / 16.0]);
    let hypotheses = Hypotheses::new(&maps, &[2.0, 5.0, 3.0]).unwrap();
    let own: Vec<f64> = maps.iter().map(|map| map.tally().mean_information()).collect();
    assert_eq!(hypotheses.mean_of_mean_information(), weighted_mean(&[2.0, 5.0, 3.0], &own).unwrap());
}
