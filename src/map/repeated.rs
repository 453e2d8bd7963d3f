//! The tally of floats that occur again and again, each computed once for many.
//!
//! A map that scans were added to holds few log-odds, multiples of the readings' own. So cells are counted by their
//! value first, each in the slot of its hash; when another value comes to a slot, the cells of the old one go into the
//! tally. The sums are exact: in any order they are the same.

use super::Encoding;
use crate::real::Real;
use crate::tally::Tally;
use alloc::vec;

/// The most values counted at a time: 64 KB of `f64`, which the nearer caches hold.
const SLOTS: usize = 1 << 12;

pub(super) fn tally<E: Encoding<Stored: Real>>(cells: &[E::Stored]) -> Tally<E::Float> {
    let mut tally = Tally::new();
    let mut add = |stored: E::Stored, count: u64| {
        if let Some(cell) = E::cell(stored) {
            tally.add_many(cell, count);
        }
    };
    let bits = cells.len().min(SLOTS).next_power_of_two().trailing_zeros().max(1);
    let mut slots = vec![(E::unknown(), 0_u64); 1 << bits];
    for &stored in cells {
        // Fibonacci hashing: the high bits of a product with 2^64 over the golden ratio.
        let hash = stored.widen().to_bits().wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - bits);
        let (value, count) = &mut slots[hash as usize];
        if *value != stored {
            if *count > 0 {
                add(*value, *count);
            }
            (*value, *count) = (stored, 0);
        }
        *count += 1;
    }
    for (value, count) in slots {
        if count > 0 {
            add(value, count);
        }
    }
    tally
}
