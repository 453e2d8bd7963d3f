//! Counts of values that occur again and again, so that each is computed once for many cells.
//!
//! A map made from scans holds few different log-odds, sums of those of single readings; hypotheses agree on few values.
//! So cells are counted by their value first, each in the slot of its hash. When another value needs the slot, the old
//! one is returned with its count. Sums of cells are exact, so their order does not matter.

use crate::real::Real;
use alloc::{vec, vec::Vec};

/// The largest number of slots: 64 KB of `f64`, 128 KB of values of 16 bytes, which fit in the second-level cache.
const SLOTS: u64 = 1 << 12;

/// The ratio of `2^64` to the golden ratio: the high bits of products with it are hashes.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

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
        // Fibonacci hashing.
        let hash = bits.wrapping_mul(GOLDEN) >> (64 - self.bits);
        &mut self.slots[hash as usize]
    }

    /// Adds `count` to a value's slot, hashed by `bits` (equal for equal values).
    ///
    /// If the slot held another value, returns that value and its count: the caller must add them to its sums. A value that does
    /// not equal itself recurs nowhere.
    #[inline]
    pub(crate) fn add(&mut self, value: K, bits: u64, count: u64) -> Option<(K, u64)> {
        self.add_if(value, bits, count, |_| true)
    }

    /// Adds as [`Repeated::add`] does, but nothing where a value that is not in its slot yet is not `wanted`.
    #[inline]
    fn add_if(
        &mut self,
        value: K,
        bits: u64,
        count: u64,
        wanted: impl FnOnce(K) -> bool,
    ) -> Option<(K, u64)> {
        let slot = self.slot(bits);
        if slot.0 == value {
            slot.1 += count;
            return None;
        }
        if !wanted(value) {
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
/// Whether many cells at once are faster than cells one by one: if not, counting is never a loss.
const BLOCKS: bool = cfg!(feature = "std");
/// The number of equal cells that take as long in a block as one that is computed alone.
const FEW: u64 = if BLOCKS { 16 } else { 2 };

/// Calls `one` with values that recur and their counts, and `many` with the other cells: each cell but NaN is in one call.
///
/// Where more than one in 32 of a stretch finds its slot taken, eight stretches are taken as they are: counting costs more
/// than it saves there.
pub(super) fn each<T: Real>(mut cells: &[T], mut one: impl FnMut(T, u64), mut many: impl FnMut(&[T])) {
    if BLOCKS && !recur(cells) {
        return many(cells);
    }
    let mut counts = Repeated::new(cells.len() as u64, T::zero());
    let mut single = Vec::with_capacity(2 * STRETCH);
    let mut sort = |value, count, single: &mut Vec<T>| {
        if count < FEW { single.extend((0..count).map(|_| value)) } else { one(value, count) }
    };
    while !cells.is_empty() {
        let (stretch, rest) = cells.split_at(STRETCH.min(cells.len()));
        let mut lost = 0;
        for &value in stretch {
            // NaN is no cell.
            if let Some((value, count)) = counts.add_if(value, value.widen().to_bits(), 1, |x| !x.is_nan()) {
                sort(value, count, &mut single);
                lost += 1;
            }
        }
        // A few at a time would leave blocks mostly empty.
        if single.len() >= STRETCH {
            many(&single);
            single.clear();
        }
        let is_loss = BLOCKS && lost > stretch.len() / 32;
        let (stretch, rest) = rest.split_at(if is_loss { rest.len().min(8 * STRETCH) } else { 0 });
        many(stretch);
        cells = rest;
    }
    counts.into_counts().for_each(|(value, count)| sort(value, count, &mut single));
    many(&single);
}

/// Returns whether of cells all over the map at most a quarter are new among those before.
fn recur<T: Real>(cells: &[T]) -> bool {
    let sample = SAMPLE.min(cells.len() / 64);
    let mut seen = Repeated::new(2 * sample as u64, T::zero());
    let mut new = 0;
    for k in 0..sample {
        // One of each part, at a place of its own: the same place of each could be a column of the map.
        let part = cells.len() / sample;
        let value = cells[k * part + ((k as u64).wrapping_mul(GOLDEN) >> 32) as usize % part];
        new += usize::from(!value.is_nan() && seen.is_new(value, value.widen().to_bits()));
        if new > sample / 4 {
            return false;
        }
    }
    sample > 0
}

#[cfg(all(test, feature = "std"))]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    /// So many values, each as often, in no order.
    fn values(count: u64, cells: u64) -> Vec<f64> {
        (0..cells).map(|k| ((k.wrapping_mul(GOLDEN) >> 32) % count) as f64 + 0.5).collect()
    }

    /// Rows of 1024 cells: one value in the first of each does not make the others recur, nor does NaN make values rare.
    #[test]
    fn values_recur_wherever_they_are() {
        assert!(recur(&values(200, 1 << 20)) && recur(&values(100, 1 << 16)) && recur(&values(32, 10_000)));
        assert!(!recur(&values(4000, 1 << 20)) && !recur(&values(1, 63)));
        let column = (0..1 << 18).map(|k| f64::from(if k % 256 == 0 { 0 } else { k })).collect::<Vec<_>>();
        assert!(!recur(&column));
        let half: Vec<f64> = values(100, 1 << 16).into_iter().flat_map(|x| [x, f64::NAN]).collect();
        assert!(recur(&half));
        // Of 64 that are looked at a quarter is new, and a quarter and one.
        assert!(recur(&values(16, 1 << 12)) && !recur(&values(17, 1 << 12)));
        let begins_alike: Vec<f64> = (0..1 << 20).map(|k| f64::from(k.max(1 << 12))).collect();
        assert!(!recur(&begins_alike));
    }

    /// Also the value that fills empty slots, and one that lost its slot to another.
    #[test]
    fn a_value_is_new_once_while_it_has_its_slot() {
        let mut seen = Repeated::new(2, 0);
        assert!(seen.is_new(0, 1) && !seen.is_new(0, 1));
        assert!(seen.is_new(5, 1) && !seen.is_new(5, 1) && seen.is_new(0, 1));
    }

    #[test]
    fn nan_takes_no_slot() {
        let cells: Vec<f64> = values(64, 40_000).into_iter().flat_map(|x| [x, f64::NAN]).collect();
        let mut counted = 0;
        let one = |value: f64, count| {
            assert!(!value.is_nan());
            counted += count;
        };
        each(&cells, one, |many| assert!(many.iter().all(|value| !value.is_nan())));
        assert_eq!(counted, 40_000);
    }

    /// Every cell in one call, and others many at a time: of a map of few values first, whose end has many.
    #[test]
    fn each_cell_is_taken_once() {
        let mut cells = values(64, 80_000);
        cells.extend((1..=15_000).map(|k| -f64::from(k)));
        cells.push(f64::NAN);
        let mut taken = BTreeMap::new();
        let mut single = Vec::new();
        let mut lengths = Vec::new();
        each(
            &cells,
            |value, count| *taken.entry(value.to_bits()).or_insert(0) += count,
            |many| {
                single.extend_from_slice(many);
                lengths.push(many.len());
            },
        );
        assert!(single.len() < 16_000 && taken.values().sum::<u64>() > 78_000);
        for value in &single {
            *taken.entry(value.to_bits()).or_insert(0) += 1;
        }
        let mut given = BTreeMap::new();
        for value in &cells {
            *given.entry(value.to_bits()).or_insert(0) += 1;
        }
        taken.remove(&f64::NAN.to_bits());
        given.remove(&f64::NAN.to_bits());
        assert!(taken == given, "some cells are lost or taken twice");
        // The last two calls are what is left.
        lengths.retain(|&length| length > 0);
        assert!(lengths.contains(&(8 * STRETCH)));
        assert!(lengths.len() > 2 && lengths[..lengths.len() - 2].iter().all(|&length| length >= STRETCH));
    }
}
