//! The kernel of log-odds beyond the tables: what it decides, and how far its value is from the enclosures.

use super::super::far::{self, FARTHEST, OF_ENTROPY, OF_OCCUPANCY};
use super::super::table::LAST;
use super::super::{Entropy, Occupancy, Quantity};
use super::{Expected, float_in_units, in_units};
use crate::cell::{entropy_from_log_odds, occupancy_from_log_odds};
use crate::rounded::lanes::format::BLOCK;
use crate::rounded::ziv::normalised;
use crate::rounded::{approximate, beyond_float, fixed};

/// Far cells of either sign: those of a kernel of their own are left open by few, by all without fused operations.
#[test]
fn far_cells_are_decided() {
    fn decided<Q: Quantity, const FUSED: bool>(block: &Expected<f64>, one: fn(f64) -> f64) -> usize {
        block.results::<Q, FUSED>(|k| one(block.cells[k]))
    }
    for (low, high) in [(LAST, 80.0), (80.0, 300.0), (300.0, FARTHEST)] {
        let share = |k: usize| (0.618_033_988_7 * (k + 1) as f64).fract();
        let block = Expected::new(core::array::from_fn(|k| {
            (low + (high - low) * share(k)) * if k % 3 == 0 { 1.0 } else { -1.0 }
        }));
        assert!(decided::<Entropy, true>(&block, entropy_from_log_odds) > BLOCK - 4);
        assert!(decided::<Occupancy, true>(&block, occupancy_from_log_odds) > BLOCK - 4);
        assert_eq!(decided::<Entropy, false>(&block, entropy_from_log_odds), 0);
        assert_eq!(decided::<Occupancy, false>(&block, occupancy_from_log_odds), BLOCK.div_ceil(3));
    }
}

/// The largest error of the far kernel's value, relative to the value.
fn largest_of_far<Q: Quantity>() -> f64 {
    let powers = if Q::OF_OCCUPANCY { &OF_OCCUPANCY } else { &OF_ENTROPY };
    let error = |a: f64| {
        let (m, e) = normalised(a);
        let (entropy, _) = approximate::from_log_odds(m, e);
        let q = approximate::occupancy(fixed::floor_117(m, e), true);
        let exact = beyond_float::middle(if Q::OF_OCCUPANCY { q } else { entropy });
        // Of 120 bits, whatever its size.
        let unit = exact.exponent + 8 - exact.value.leading_zeros() as i32;
        let exact = in_units(exact, unit);
        let (head, tail, scale) = far::value::<Q>(powers, a);
        let k = 1023 - (scale.to_bits() >> 52) as i32;
        let found = float_in_units(head, unit + k) + float_in_units(tail, unit + k);
        (found - exact).abs() as f64 / exact as f64
    };
    // Where a step ends, and what is left is largest, of either sign; and anywhere.
    let steps = (0..230_000).map(|n| LAST + (f64::from(n) + 0.5) * core::f64::consts::LN_2 / 256.0);
    let anywhere = (0..10_000).map(|k| LAST + (FARTHEST - LAST) * (0.618_033_988_7 * f64::from(k)).fract());
    steps.chain(anywhere).filter(|a| (LAST..=FARTHEST).contains(a)).map(error).fold(0.0, f64::max)
}

#[test]
fn errors_far_out_are_within_the_bound() {
    for largest in [largest_of_far::<Entropy>(), largest_of_far::<Occupancy>()] {
        let share = largest / far::ERROR;
        assert!((0.1..=1.0).contains(&share), "{share}");
    }
}
