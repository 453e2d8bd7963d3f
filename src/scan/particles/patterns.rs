//! Patterns: what the particles' maps say of one cell, and how many cells have each.

use super::index::{Index, hash};
use alloc::{vec, vec::Vec};

/// The patterns by number: for each particle the number of one of [`Values`](super::values::Values). Number 0 is that of a cell
/// of which no particle knows anything, and has no count.
#[derive(Clone, Debug)]
pub(super) struct Patterns {
    particles: usize,
    /// The values of the particles, pattern by pattern.
    values: Vec<u32>,
    /// The number of cells of each pattern.
    counts: Vec<u64>,
    /// The number of patterns of one cell or more.
    used: usize,
    index: Index,
}

impl Patterns {
    /// Creates the patterns of which only number 0 is there.
    pub(super) fn new(particles: usize) -> Self {
        let (values, counts) = (Vec::new(), Vec::new());
        let mut patterns = Self { particles, values, counts, used: 0, index: Index::new() };
        patterns.number(&vec![0; particles]);
        patterns
    }

    /// Returns how many there are, of which some may have no cell any more.
    pub(super) fn len(&self) -> usize {
        self.counts.len()
    }

    /// Tells whether most patterns have no cell any more.
    pub(super) fn are_stale(&self) -> bool {
        self.len() > 4 * self.used + (1 << 12)
    }

    /// Returns the values of a pattern.
    pub(super) fn values(&self, number: u32) -> &[u32] {
        &self.values[number as usize * self.particles..][..self.particles]
    }

    /// Returns the number of cells of a pattern.
    pub(super) fn count(&self, number: u32) -> u64 {
        self.counts[number as usize]
    }

    /// Counts `cells` more cells of a pattern.
    pub(super) fn add(&mut self, number: u32, cells: u64) {
        if number > 0 && cells > 0 {
            let count = &mut self.counts[number as usize];
            self.used += usize::from(*count == 0);
            *count += cells;
        }
    }

    /// Counts a cell of a pattern no more.
    pub(super) fn remove(&mut self, number: u32) {
        if number > 0 {
            let count = &mut self.counts[number as usize];
            *count -= 1;
            self.used -= usize::from(*count == 0);
        }
    }

    /// Returns the number of a pattern, which is added if there is none; `None` if numbers have run out.
    pub(super) fn number(&mut self, values: &[u32]) -> Option<u32> {
        let hash = hash(values.iter().map(|&value| u64::from(value)));
        let found = self.index.find(hash, |number| self.values(number) == values);
        if found.is_some() {
            return found;
        }
        let number = u32::try_from(self.len()).ok().filter(|&number| number < u32::MAX)?;
        self.values.extend(values);
        self.counts.push(0);
        self.index.add(hash, number);
        Some(number)
    }
}
