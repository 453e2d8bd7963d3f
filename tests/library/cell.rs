//! One cell: its bounds, symmetries and special cases, in both formats.

use super::common::{mirrorable, occupancy};
use approx::abs_diff_eq;
use mean_information::cell::{
    Cell, State, entropy, entropy_from_log_odds, information, information_from_log_odds,
    occupancy_from_log_odds,
};
use mean_information::{Error, Real};
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn entropy_and_information_lie_in_the_unit_interval(p in occupancy()) {
        prop_assert!((0.0..=1.0).contains(&entropy(p)));
        prop_assert!((0.0..=1.0).contains(&information(p)));
        prop_assert!((0.0..=1.0).contains(&entropy(p as f32)));
    }

    /// Each is within half an ulp, at most `2^-54`, the exact values add to 1, and so do the floats but for one rounding.
    #[test]
    fn entropy_and_information_add_to_one_bit(p in occupancy()) {
        prop_assert!(abs_diff_eq!(entropy(p) + information(p), 1.0, epsilon = f64::EPSILON));
    }

    #[test]
    fn free_and_occupied_are_symmetric(p in mirrorable()) {
        prop_assert_eq!(entropy(p).to_bits(), entropy(1.0 - p).to_bits());
        prop_assert_eq!(information(p).to_bits(), information(1.0 - p).to_bits());
    }

    /// Correct rounding of a monotone function is monotone: neighbouring floats never step the wrong way.
    #[test]
    fn entropy_rises_to_one_half_ulp_by_ulp(p in occupancy()) {
        let next = p.next_up();
        if next <= 0.5 {
            prop_assert!(entropy(p) <= entropy(next) && information(p) >= information(next));
        } else if next <= 1.0 && p >= 0.5 {
            prop_assert!(entropy(p) >= entropy(next) && information(p) <= information(next));
        }
    }

    /// A single-precision result is the double-precision one rounded, unless that lies at a midpoint of `f32`.
    #[test]
    fn single_precision_agrees_with_double(p in 0.0_f32..=1.0) {
        let (narrow, wide) = (information(p), information(f64::from(p)));
        let half_ulp = f64::from(narrow.next_up() - narrow) / 2.0;
        prop_assert!(abs_diff_eq!(f64::from(narrow), wide, epsilon = half_ulp * (1.0 + 1e-8)));
    }

    #[test]
    fn log_odds_are_symmetric(l in -800.0_f64..800.0) {
        prop_assert_eq!(entropy_from_log_odds(l).to_bits(), entropy_from_log_odds(-l).to_bits());
        prop_assert_eq!(information_from_log_odds(l).to_bits(), information_from_log_odds(-l).to_bits());
        prop_assert_eq!(Cell::from_log_odds(l)?.information(), information_from_log_odds(l));
    }

    /// Two ways to the same cell: `|I(fl(p)) - I(p)| <= |l| / ln 2 * ulp(p) / 2` by the mean value theorem, plus two roundings.
    #[test]
    fn log_odds_agree_with_the_occupancy_they_stand_for(l in -30.0_f64..30.0) {
        let p = occupancy_from_log_odds(l);
        let slope = (l.abs() + 1.0) / std::f64::consts::LN_2;
        let epsilon = (slope + 2.0) * f64::EPSILON;
        prop_assert!(abs_diff_eq!(information(p), information_from_log_odds(l), epsilon = epsilon));
    }
}

fn special_cases<T: Real>() {
    let (zero, one) = (T::zero(), T::one());
    for (p, h, i) in [(zero, zero, one), (T::neg_zero(), zero, one), (T::HALF, one, zero), (one, zero, one)] {
        assert_eq!((entropy(p), information(p)), (h, i));
    }
    for p in [T::nan(), -T::epsilon(), one + T::epsilon(), T::infinity(), T::neg_infinity()] {
        assert!(entropy(p).is_nan() && information(p).is_nan(), "{p}");
    }
    for (l, h, p) in [(zero, one, T::HALF), (T::infinity(), zero, one), (T::neg_infinity(), zero, zero)] {
        assert_eq!((entropy_from_log_odds(l), information_from_log_odds(l)), (h, one - h));
        assert_eq!(occupancy_from_log_odds(l), p);
    }
    for l in [T::max_value(), T::min_value()] {
        assert_eq!((entropy_from_log_odds(l), information_from_log_odds(l)), (zero, one));
        assert_eq!(occupancy_from_log_odds(l), if l > zero { one } else { zero });
    }
    assert!(entropy_from_log_odds(T::nan()).is_nan());
    assert!(information_from_log_odds(T::nan()).is_nan());
    assert!(occupancy_from_log_odds(T::nan()).is_nan());
}

#[test]
fn the_special_cases_hold_in_both_formats() {
    special_cases::<f32>();
    special_cases::<f64>();
}

#[test]
fn a_cell_is_observed_if_and_only_if_it_is_not_one_half() -> Result<(), Error> {
    for (p, state) in [
        (0.5, State::Unknown),
        (0.5_f64.next_up(), State::Occupied),
        (0.5_f64.next_down(), State::Free),
        (0.0, State::Free),
        (1.0, State::Occupied),
    ] {
        assert_eq!(Cell::from_occupancy(p)?.state(), state);
    }
    // Too little evidence to move p off 1/2 in floating point, or I off 0, is still evidence.
    let whisper = Cell::from_log_odds(-1e-200_f64)?;
    assert_eq!((whisper.state(), whisper.information()), (State::Free, 0.0));
    assert_eq!(Cell::from_log_odds(-0.0_f32)?.state(), State::Unknown);
    Ok(())
}

#[test]
fn a_refused_cell_is_named_with_its_value_and_the_allowed_range() {
    let refused = |p: f64| Cell::from_occupancy(p).unwrap_err().to_string();
    assert_eq!(refused(-0.25), "occupancy is -0.25, allowed is 0 to 1");
    assert_eq!(refused(f64::NAN), "occupancy is NaN, allowed is 0 to 1");
    assert!(Cell::from_log_odds(f32::NAN).is_err());
}
