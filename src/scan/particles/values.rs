//! The sums of log-odds that cells of particles' maps have, by number: each is measured once.

use super::index::{Index, hash};
use crate::cell::Cell;
use crate::map::Encoding;
use crate::map::encoding::LogOdds;
use crate::real::Real;
use crate::rounded::round_log_odds;
use alloc::vec::Vec;

/// Sums of log-odds in units of `2^-80` nats; number 0 is that of an unknown cell, 0.
#[derive(Clone, Debug)]
pub(super) struct Values<T> {
    values: Vec<Value<T>>,
    index: Index,
}

/// A sum, and what a cell of it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Value<T> {
    pub(super) sum: i128,
    /// The occupancy of the float nearest to the sum.
    pub(super) occupancy: T,
    pub(super) cell: Cell<T>,
}

impl<T: Real> Values<T> {
    /// Creates the values of which only number 0 is there.
    pub(super) fn new() -> Self {
        let mut values = Self { values: Vec::new(), index: Index::new() };
        values.number(0);
        values
    }

    /// Returns how many there are.
    pub(super) fn len(&self) -> usize {
        self.values.len()
    }

    /// Returns the value of a number.
    pub(super) fn get(&self, number: u32) -> &Value<T> {
        &self.values[number as usize]
    }

    /// Returns the number of a sum, which is added if there is none; `None` if numbers have run out.
    pub(super) fn number(&mut self, sum: i128) -> Option<u32> {
        let hash = hash([sum as u64, (sum >> 64) as u64]);
        let found = self.index.find(hash, |number| self.get(number).sum == sum);
        if found.is_some() {
            return found;
        }
        let number = u32::try_from(self.values.len()).ok().filter(|&number| number < u32::MAX)?;
        let stored: T = round_log_odds(sum);
        // A sum of integers is no NaN.
        let occupancy = LogOdds::occupancy(stored).unwrap_or(T::HALF);
        let cell = LogOdds::cell(stored).unwrap_or_else(Cell::unknown);
        self.values.push(Value { sum, occupancy, cell });
        self.index.add(hash, number);
        Some(number)
    }
}
