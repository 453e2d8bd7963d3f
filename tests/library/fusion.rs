//! Fusion of observations: the formula, its relations, and certainties.

use super::common::{mirrorable, occupancy};
use approx::abs_diff_eq;
use mean_information::Error;
use mean_information::cell::{information, log_odds_from_occupancy, occupancy_from_log_odds};
use mean_information::fusion::fuse;
use proptest::collection::vec;
use proptest::prelude::*;

/// Not certain, so that nothing contradicts.
fn doubtful() -> impl Strategy<Value = f64> {
    occupancy().prop_filter("not certain", |&p| p > 0.0 && p < 1.0)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// The second way: log-odds added up in floats. Of `n` terms and `n` sums each is off by half an ulp of at most
    /// `n 745`; `p` moves by at most `p (1 - p)` per nat, and rounds.
    #[test]
    fn log_odds_add(p in vec(doubtful(), 0..9)) {
        let sum: f64 = p.iter().map(|&p| log_odds_from_occupancy(p)).sum();
        let sum_of_magnitudes: f64 = p.iter().map(|&p| log_odds_from_occupancy(p).abs()).sum();
        let error = (p.len() + 1) as f64 * sum_of_magnitudes * f64::EPSILON;
        let fused = fuse(&p)?;
        let [low, high] = [sum - error, sum + error].map(occupancy_from_log_odds);
        prop_assert!(low.next_down() <= fused && fused <= high.next_up(), "{fused:e} not in {low:e} {high:e}");
    }

    #[test]
    fn no_order_changes_a_bit(p in vec(doubtful(), 1..9), turn in 0_usize..9) {
        let mut other = p.clone();
        other.rotate_left(turn % p.len());
        other.push(0.5);
        prop_assert_eq!(fuse(&p)?, fuse(&other)?);
    }

    #[test]
    fn one_observation_is_itself_and_opposites_cancel(p in doubtful(), q in mirrorable()) {
        prop_assert_eq!(fuse(&[p])?, p);
        prop_assume!(q > 0.0 && q < 1.0);
        prop_assert_eq!(fuse(&[q, 1.0 - q])?, 0.5);
        prop_assert_eq!(fuse(&[q, p, 1.0 - q])?, p);
    }

    /// Mirrored observations, mirrored result: `1 - p` rounds once.
    #[test]
    fn free_and_occupied_are_alike(p in vec(mirrorable(), 1..6)) {
        prop_assume!(p.iter().all(|&p| p > 0.0 && p < 1.0));
        let mirrored: Vec<f64> = p.iter().map(|&p| 1.0 - p).collect();
        let (p, q) = (fuse(&p)?, fuse(&mirrored)?);
        prop_assert!(abs_diff_eq!(p + q, 1.0, epsilon = f64::EPSILON / 2.0));
    }

    /// Evidence of the same sign never lowers information.
    #[test]
    fn agreement_informs(p in doubtful(), q in doubtful()) {
        let q = if (p < 0.5) == (q < 0.5) { q } else { 1.0 - q };
        prop_assume!(p != 0.5 && q != 0.5 && q != 1.0);
        let fused = fuse(&[p, q])?;
        prop_assert!(information(fused) >= information(p).max(information(q)));
        prop_assert!((fused - 0.5).abs() >= (p - 0.5).abs().max((q - 0.5).abs()));
    }

    #[test]
    fn a_certainty_prevails(p in vec(doubtful(), 0..5), occupied in any::<bool>(), at in 0_usize..5) {
        let mut p = p;
        let certain = if occupied { 1.0 } else { 0.0 };
        p.insert(at.min(p.len()), certain);
        prop_assert_eq!(fuse(&p)?, certain);
    }

    #[test]
    fn single_precision_is_double_precision_rounded_again(p in vec(0.01_f32..0.99, 0..6)) {
        let wide: Vec<f64> = p.iter().copied().map(f64::from).collect();
        let (narrow, wide) = (fuse(&p)?, fuse(&wide)?);
        prop_assert!(abs_diff_eq!(f64::from(narrow), wide, epsilon = f64::from(f32::EPSILON) / 4.0 * wide.max(0.25) * 2.01));
    }
}

#[test]
fn what_cannot_be_fused_is_named() {
    let refused = |p: &[f64]| fuse(p).unwrap_err();
    assert!(matches!(refused(&[0.25, 1.0, 0.5, 0.0]), Error::Contradiction { free: 3, occupied: 1, .. }));
    assert_eq!(
        refused(&[0.0, 1.0]).to_string(),
        "observations 0 and 1 are 0 and 1, which contradict each other"
    );
    assert_eq!(refused(&[0.25, 1.5]).to_string(), "observation 1 is 1.5, allowed is 0 to 1");
    assert!(matches!(refused(&[f64::NAN]), Error::Item { index: 0, .. }));
    assert_eq!(fuse::<f64>(&[]), Ok(0.5));
}

/// Far beyond the exponents of floats, and thousands of observations.
#[test]
fn many_observations() {
    assert_eq!(fuse(&[1e-300_f64; 3]), Ok(0.0));
    assert_eq!(fuse(&[1.0 - f64::EPSILON; 40]), Ok(1.0));
    let mut both = vec![0.75; 5000];
    both.resize(10_000, 0.25);
    both.push(0.625);
    assert_eq!(fuse(&both), Ok(0.625));
    assert_eq!(
        fuse(&[1e-300, 1.0 - f64::EPSILON / 2.0, 1.0 - f64::EPSILON / 2.0, 0.5]),
        fuse(&[1e-300, 1.0 - f64::EPSILON / 2.0, 1.0 - f64::EPSILON / 2.0])
    );
}
