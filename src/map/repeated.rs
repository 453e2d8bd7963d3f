//! Counts of values that occur again and again, so that each is computed once for many cells.
//!
//! A map that scans were added to holds few log-odds, multiples of the readings' own; hypotheses agree on few values.
//! So cells are counted by their value first, each in the slot of its hash; when another value comes to a slot, the
//! count of the old one is given back. Sums of cells are exact: in any order they are the same.

use super::Encoding;
use crate::real::Real;
use crate::tally::Tally;
use alloc::{vec, vec::Vec};

/// The most values counted at a time: 64 KB of `f64`, 128 KB of 16 bytes each, which the nearer caches hold.
const SLOTS: u64 = 1 << 12;

/// How often values came, the latest of each slot.
pub(crate) struct Repeated<K> {
    slots: Vec<(K, u64)>,
    bits: u32,
}

impl<K: Copy + PartialEq> Repeated<K> {
    /// To count the values of so many cells; `any` value fills empty slots.
    pub(crate) fn new(cells: u64, any: K) -> Self {
        let bits = cells.min(SLOTS).next_power_of_two().trailing_zeros().max(1);
        Self { slots: vec![(any, 0); 1 << bits], bits }
    }

    /// Counts a value, of which equal ones should have equal `bits`; gives back what lost its slot to it.
    #[inline]
    pub(crate) fn add(&mut self, value: K, bits: u64, count: u64) -> Option<(K, u64)> {
        // Fibonacci hashing: the high bits of a product with 2^64 over the golden ratio.
        let hash = bits.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - self.bits);
        let slot = &mut self.slots[hash as usize];
        if slot.0 == value {
            slot.1 += count;
            return None;
        }
        let lost = core::mem::replace(slot, (value, count));
        (lost.1 > 0).then_some(lost)
    }

    /// What is left, and none of it any more.
    pub(crate) fn into_counts(self) -> impl Iterator<Item = (K, u64)> {
        self.slots.into_iter().filter(|&(_, count)| count > 0)
    }
}

pub(super) fn tally<E: Encoding<Stored: Real>>(cells: &[E::Stored]) -> Tally<E::Float> {
    let mut tally = Tally::new();
    let mut add = |(stored, count): (E::Stored, u64)| {
        if let Some(cell) = E::cell(stored) {
            tally.add_many(cell, count);
        }
    };
    let mut counts = Repeated::new(cells.len() as u64, E::unknown());
    for &stored in cells {
        if let Some(lost) = counts.add(stored, stored.widen().to_bits(), 1) {
            add(lost);
        }
    }
    counts.into_counts().for_each(add);
    tally
}
