//! An index of contents by their hashes: open addressing, with the contents elsewhere.

use crate::error::Error;
use alloc::{vec, vec::Vec};

/// The slot of no number.
const EMPTY: (u64, u32) = (0, u32::MAX);

/// Creates the error of contents for which no number is left.
pub(super) fn no_number() -> Error {
    let what = "number of values, or of patterns, of the particles' maps";
    Error::out_of_range(what, f64::from(u32::MAX) + 1.0, "at most 2^32 - 1")
}

/// The numbers of contents that are kept elsewhere, found by the hashes of these.
#[derive(Clone, Debug)]
pub(super) struct Index {
    /// Hashes with their numbers; at most half of the slots are taken, so that every search ends.
    slots: Vec<(u64, u32)>,
    taken: usize,
}

impl Index {
    /// Creates an index of nothing.
    pub(super) fn new() -> Self {
        Self { slots: vec![EMPTY; 16], taken: 0 }
    }

    /// Finds the number of this hash whose contents are the right ones, as `is` tells.
    pub(super) fn find(&self, hash: u64, is: impl Fn(u32) -> bool) -> Option<u32> {
        let mut at = self.first(hash);
        while self.slots[at] != EMPTY {
            let (other, number) = self.slots[at];
            if other == hash && is(number) {
                return Some(number);
            }
            at = (at + 1) % self.slots.len();
        }
        None
    }

    /// Adds a number below [`u32::MAX`] that is not there.
    pub(super) fn add(&mut self, hash: u64, number: u32) {
        self.taken += 1;
        if 2 * self.taken > self.slots.len() {
            let doubled = vec![EMPTY; 2 * self.slots.len()];
            let old = core::mem::replace(&mut self.slots, doubled);
            old.into_iter().filter(|&slot| slot != EMPTY).for_each(|slot| self.place(slot));
        }
        self.place((hash, number));
    }

    /// Puts a hash and its number into the next empty slot.
    fn place(&mut self, slot: (u64, u32)) {
        let mut at = self.first(slot.0);
        while self.slots[at] != EMPTY {
            at = (at + 1) % self.slots.len();
        }
        self.slots[at] = slot;
    }

    /// Returns the slot at which a search begins: by the high bits of a hash, which are its best.
    fn first(&self, hash: u64) -> usize {
        (hash >> (64 - self.slots.len().trailing_zeros())) as usize
    }
}

/// Hashes words: products with 2^64 over the golden ratio, turned so that all bits come to count.
pub(super) fn hash(words: impl IntoIterator<Item = u64>) -> u64 {
    let mix = |hash: u64, word: u64| (hash.rotate_left(23) ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = words.into_iter().fold(0, mix);
    (mixed ^ mixed >> 32).wrapping_mul(0x9e37_79b9_7f4a_7c15)
}
