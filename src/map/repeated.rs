//! Counts of values that occur again and again, so that each is computed once for many cells.
//!
//! A map made from scans holds few different log-odds, sums of those of single readings; hypotheses agree on few values.
//! So cells are counted by their value first, each in the slot of its hash. When another value needs the slot, the old
//! one is returned with its count. Sums of cells are exact, so their order does not matter.

use crate::real::Real;
use alloc::{vec, vec::Vec};

/// The largest number of slots: 64 KB of `f64`, 128 KB of values of 16 bytes, which fit in the second-level cache.
const SLOTS: u64 = 1 << 12;

/// A table of values and their counts, one value for each hash.
pub(crate) struct Repeated<K> {
    slots: Vec<(K, u64)>,
    bits: u32,
}

impl<K: Copy + PartialEq> Repeated<K> {
    /// Creates a table for the values of `cells` cells. The value `any` fills empty slots.
    pub(crate) fn new(cells: u64, any: K) -> Self {
        let bits = cells.min(SLOTS).next_power_of_two().trailing_zeros().max(1);
        Self { slots: vec![(any, 0); 1 << bits], bits }
    }

    /// Returns the slot of values that are hashed by `bits`.
    #[inline]
    fn slot(&mut self, bits: u64) -> &mut (K, u64) {
        // Fibonacci hashing: the high bits of a product with 2^64 over the golden ratio.
        let hash = bits.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - self.bits);
        &mut self.slots[hash as usize]
    }

    /// Adds `count` to a value's slot, hashed by `bits` (equal for equal values).
    ///
    /// If the slot held another value, returns that value and its count: the caller must add them to its sums.
    #[inline]
    pub(crate) fn add(&mut self, value: K, bits: u64, count: u64) -> Option<(K, u64)> {
        let slot = self.slot(bits);
        if slot.0 == value {
            slot.1 += count;
            return None;
        }
        let lost = core::mem::replace(slot, (value, count));
        (lost.1 > 0).then_some(lost)
    }

    /// Counts a value, hashed by `bits`, in place of another that has its slot; returns whether it was not there.
    fn is_new(&mut self, value: K, bits: u64) -> bool {
        let slot = self.slot(bits);
        if slot.0 == value && slot.1 > 0 {
            return false;
        }
        *slot = (value, 1);
        true
    }

    /// Returns the values that are still in the table, with their counts.
    pub(crate) fn into_counts(self) -> impl Iterator<Item = (K, u64)> {
        self.slots.into_iter().filter(|&(_, count)| count > 0)
    }
}

/// The cells after which it is decided anew whether values recur.
const STRETCH: usize = 1024;
/// The largest number of cells that are looked at to see whether values recur at all.
const SAMPLE: usize = 1024;
/// The number of equal cells that take as long in a block as one that is computed alone.
const FEW: u64 = 16;

/// Calls `one` with values that recur and their counts, and `many` with the other cells: each cell is in one call.
///
/// Where more than an eighth of a stretch finds its slots taken, eight stretches are taken as they are: counting costs more
/// than it saves there.
pub(super) fn each<T: Real>(mut cells: &[T], mut one: impl FnMut(T, u64), mut many: impl FnMut(&[T])) {
    if !recur(cells) {
        return many(cells);
    }
    let mut counts = Repeated::new(cells.len() as u64, T::zero());
    let mut single = Vec::with_capacity(STRETCH);
    let mut sort = |value, count, single: &mut Vec<T>| {
        if count < FEW { single.extend((0..count).map(|_| value)) } else { one(value, count) }
    };
    while !cells.is_empty() {
        let (stretch, rest) = cells.split_at(STRETCH.min(cells.len()));
        let mut lost = 0;
        for &value in stretch {
            if let Some((value, count)) = counts.add(value, value.widen().to_bits(), 1) {
                sort(value, count, &mut single);
                lost += 1;
            }
        }
        many(&single);
        single.clear();
        let as_they_are = if lost > stretch.len() / 8 { rest.len().min(8 * STRETCH) } else { 0 };
        let (stretch, rest) = rest.split_at(as_they_are);
        many(stretch);
        cells = rest;
    }
    counts.into_counts().for_each(|(value, count)| sort(value, count, &mut single));
    many(&single);
}

/// Returns whether of cells all over the map at most an eighth are new among those before.
fn recur<T: Real>(cells: &[T]) -> bool {
    let sample = SAMPLE.min(cells.len() / 64);
    let mut seen = Repeated::new(2 * sample as u64, T::zero());
    let places = (0..sample).map(|k| k * (cells.len() / sample));
    let mut new = 0;
    for value in places.map(|place| cells[place]) {
        new += usize::from(seen.is_new(value, value.widen().to_bits()));
        if new > sample / 8 {
            return false;
        }
    }
    sample > 0
}
