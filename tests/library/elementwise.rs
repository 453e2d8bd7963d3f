//! Functions of many cells at once: bit for bit those of the single cells, whatever the number of cells and their place.

use super::common::{occupancy, power};
use mean_information::{Real, cell, elementwise};
use proptest::collection::vec;
use proptest::prelude::*;

/// A function of many cells and that of one.
type Pair<T> = (&'static str, fn(&[T], &mut [T]), fn(T) -> T);

fn of_occupancies<T: Real>() -> [Pair<T>; 3] {
    [
        ("entropy", elementwise::entropy, cell::entropy),
        ("information", elementwise::information, cell::information),
        ("log_odds_from_occupancy", elementwise::log_odds_from_occupancy, cell::log_odds_from_occupancy),
    ]
}

fn of_log_odds<T: Real>() -> [Pair<T>; 3] {
    [
        ("entropy_from_log_odds", elementwise::entropy_from_log_odds, cell::entropy_from_log_odds),
        (
            "information_from_log_odds",
            elementwise::information_from_log_odds,
            cell::information_from_log_odds,
        ),
        ("occupancy_from_log_odds", elementwise::occupancy_from_log_odds, cell::occupancy_from_log_odds),
    ]
}

/// Compares each element, 0 with its sign and NaN with NaN.
fn check<T: Real>(pairs: &[Pair<T>], arguments: &[T]) {
    for (name, many, one) in pairs {
        let mut results = vec![T::nearest(0.375); arguments.len()];
        many(arguments, &mut results);
        for (&x, &result) in arguments.iter().zip(&results) {
            let expected = one(x);
            let equal = result.widen().to_bits() == expected.widen().to_bits();
            assert!(
                equal || result.is_nan() && expected.is_nan(),
                "{name} at {x:e}: {result:e} for {expected:e}"
            );
        }
    }
}

fn check_both(occupancies: &[f64], log_odds: &[f64]) {
    let single = |x: &[f64]| x.iter().map(|&x| x as f32).collect::<Vec<f32>>();
    check(&of_occupancies(), occupancies);
    check(&of_log_odds(), log_odds);
    check(&of_occupancies(), &single(occupancies));
    check(&of_log_odds(), &single(log_odds));
}

/// Log-odds of maps, of every magnitude, and where results leave the floats.
fn log_odds() -> impl Strategy<Value = f64> {
    prop_oneof![
        8 => -12.0..12.0,
        2 => -50.0..50.0,
        1 => any::<f64>(),
        1 => -800.0..800.0,
        1 => (-150..-80).prop_map(|exponent| 1.375 * power(exponent)),
        1 => prop::sample::select(vec![0.0, -0.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 1024.0, f64::MAX]),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    #[test]
    fn many_cells_have_the_bits_of_single_cells(
        occupancies in vec(prop_oneof![20 => occupancy(), 1 => Just(f64::NAN), 1 => -1.0..2.0], 0..900),
        log_odds in vec(log_odds(), 0..900),
    ) {
        check_both(&occupancies, &log_odds);
    }
}

/// Every binade of both formats, with both signs.
#[test]
fn every_magnitude() {
    let magnitudes =
        (-1074..1024).flat_map(|exponent| [1.0, 1.375].map(|m| m * f64::from_parts(1, exponent)));
    let both: Vec<f64> = magnitudes.flat_map(|x| [x, -x]).collect();
    check_both(&both, &both);
}

/// Blocks of far cells alone, of some, of few and of one, of either sign.
#[test]
fn log_odds_far_from_0() {
    for every in [1, 2, 5, 100, 300] {
        let cell = |k: u32| {
            let far = 63.0 + (0.377 * f64::from(k)).fract() * 710.0;
            let l = if k.is_multiple_of(every) { far } else { far / 64.0 };
            if k.is_multiple_of(3) { l } else { -l }
        };
        check(&of_log_odds(), &(0..1100).map(cell).collect::<Vec<f64>>());
    }
    let free: Vec<f64> = (0..256).map(|k| -64.0 - f64::from(k) * 2.5).collect();
    check(&of_log_odds(), &free);
    check(&of_log_odds(), &free.iter().map(|l| -l).collect::<Vec<f64>>());
}

/// Fewer than a block, a block, and more, with what no function is defined at in between.
#[test]
fn any_number_of_cells() {
    for count in (0..600).step_by(23).chain([255, 256, 257]) {
        let spread =
            |scale: f64| (0..count).map(move |k| (0.377 * f64::from(k)).fract() * scale - 0.03).collect();
        let (occupancies, log_odds): (Vec<f64>, Vec<f64>) = (spread(1.06), spread(30.0));
        check_both(&occupancies, &log_odds);
    }
}

#[test]
#[should_panic(expected = "3 arguments need as many places for results, not 2")]
fn lengths_that_differ_are_refused() {
    elementwise::information(&[0.25, 0.5, 0.75], &mut [0.0; 2]);
}
