//! The block jackknife: against its formula in floats, and what changes no bit.

use super::super::common::occupancy;
use approx::{abs_diff_eq, assert_abs_diff_eq};
use mean_information::scan::{Difference, blocks};
use mean_information::{Real, Tally};
use proptest::collection::vec;
use proptest::prelude::*;

fn tally(cells: &[f64]) -> Tally<f64> {
    Tally::from_occupancies(cells)
}

proptest! {
    /// The formula in floats: `K` differences of numbers up to 1, each within 2^-52; their squares and root.
    #[test]
    fn it_is_the_formula(pairs in vec([vec(occupancy(), 1..9), vec(occupancy(), 1..9)], 2..30)) {
        let without: Vec<_> = pairs.iter().map(|pair| [tally(&pair[0]), tally(&pair[1])]).collect();
        let whole = [&without[0][0], &without[0][1]];
        let found = Difference::by_jackknife(whole, &without)?;
        let k = without.len() as f64;
        let theta: Vec<_> = without.iter().map(|pair| pair[1].mean_information() - pair[0].mean_information()).collect();
        let mean = theta.iter().sum::<f64>() / k;
        let squares: f64 = theta.iter().map(|theta| (theta - mean) * (theta - mean)).sum();
        let expected = mean_information::elementary::sqrt((k - 1.0) / k * squares);
        // Sums of K terms: K/2 ulp each; what is short of them by the rounding of the inputs.
        let tolerance = expected * k * f64::EPSILON + mean_information::elementary::sqrt(k) * (k + 2.0) * f64::EPSILON;
        prop_assert!(abs_diff_eq!(found.standard_error(), expected, epsilon = tolerance), "{} {}", found.standard_error(), expected);
        prop_assert_eq!((found.value(), found.blocks()), (theta[0], without.len()));
    }

    #[test]
    fn relations_that_change_no_bit(pairs in vec([vec(occupancy(), 1..9), vec(occupancy(), 1..9)], 2..30), turn in 0_usize..30) {
        let mut without: Vec<_> = pairs.iter().map(|pair| [tally(&pair[0]), tally(&pair[1])]).collect();
        let whole = without[0].clone();
        let straight = Difference::by_jackknife([&whole[0], &whole[1]], &without)?;
        let turn = turn % without.len();
        without.rotate_left(turn);
        prop_assert_eq!(Difference::by_jackknife([&whole[0], &whole[1]], &without)?, straight);
        let swapped: Vec<_> = without.iter().map(|[a, b]| [b.clone(), a.clone()]).collect();
        let swapped = Difference::by_jackknife([&whole[1], &whole[0]], &swapped)?;
        prop_assert_eq!((swapped.value(), swapped.standard_error()), (-straight.value(), straight.standard_error()));
        // Blocks without which all is the same: no error.
        let level = vec![whole.clone(); without.len()];
        prop_assert_eq!(Difference::by_jackknife([&whole[0], &whole[1]], &level)?.standard_error(), 0.0);
    }

    #[test]
    fn blocks_hold_each_scan_once(scans in 0_usize..5000, count in 1_usize..60) {
        let blocks: Vec<_> = blocks(scans, count).collect();
        prop_assert_eq!(blocks.len(), count.min(scans));
        let mut next = 0;
        for block in blocks {
            prop_assert_eq!(block.start, next);
            next = block.end;
            prop_assert!((scans / count..=scans.div_ceil(count)).contains(&block.len()) || scans < count);
        }
        prop_assert_eq!(next, scans);
    }
}

/// Two blocks: `se² = 1/2 ((d/2)² + (d/2)²)`, `se = d/2`. Cells of f32 are summed up exactly and rounded once to f64.
#[test]
fn two_blocks_have_half_their_distance() {
    let of = |p: f32| Tally::from_occupancies(&[p, 0.25, 0.875]);
    let without = [[of(0.125), of(0.75)], [of(0.25), of(0.625)]];
    let found = Difference::by_jackknife([&of(0.5), &of(0.0)], &without).unwrap();
    let exact = |p: f32| {
        let terms = [p, 0.25, 0.875].map(|p| mean_information::cell::information(p).widen());
        terms.into_iter().sum::<f64>() / 3.0
    };
    let [first, second] = [exact(0.75) - exact(0.125), exact(0.625) - exact(0.25)];
    assert_abs_diff_eq!(found.standard_error(), (first - second).abs() / 2.0, epsilon = 1e-15);
    assert!(first.abs() > 0.05 && second.abs() > 0.03, "{first} {second}");
}

#[test]
fn one_block_is_refused() {
    let tally = tally(&[0.25, 0.75]);
    for without in [vec![], vec![[tally.clone(), tally.clone()]]] {
        let refused = Difference::by_jackknife([&tally, &tally], &without).unwrap_err();
        assert_eq!(
            refused.to_string(),
            format!("number of blocks is {}, allowed is 2 or more", without.len())
        );
    }
}
