//! The marginals of cells and the sums over them: entropy and information of the exact weighted means.

use super::weights::{Mean, Weights};
use crate::cell::State;
use crate::map::Encoding;
use crate::map::repeated::Repeated;
use crate::real::Real;
use crate::rounded::beyond_float::{self, Both};
use crate::rounded::{Leading, NaturalNumber};
use crate::tally::Tally;
use alloc::vec::Vec;
use core::cmp::Ordering;
use num_traits::Zero;

/// The marginal of a cell: its state, and entropy with information as the sums need them.
pub(super) type Summand = (State, Both);

/// Computes the marginal of a cell from an exact mean of occupancies; `first` tells what [`Mean::leading`] does.
pub(super) fn summand(mean: &Mean<'_>, first: impl Fn() -> Option<(Leading, bool)>) -> Summand {
    let beside_half = mean.beside_half();
    let state = match beside_half.sign() {
        Ordering::Less => State::Free,
        Ordering::Greater => State::Occupied,
        Ordering::Equal => State::Unknown,
    };
    // A certain mean, 0 or 1, has no smaller probability to go by.
    let minor = || {
        let minor = if state == State::Free { first() } else { mean.complement().leading() };
        minor.map_or(beyond_float::CERTAIN, |(leading, _)| beyond_float::at_smaller_probability(leading))
    };
    let beside_unknown =
        || beside_half.leading().and_then(|(leading, _)| beyond_float::at_distance_from_unknown(leading));
    let both = match state {
        State::Unknown => beyond_float::UNKNOWN,
        _ if beside_half.is_above_a_sixteenth() => minor(),
        _ => beside_unknown().unwrap_or_else(minor),
    };
    (state, both)
}

/// Computes the marginal of a cell on which all maps agree, from its occupancy.
pub(super) fn agreed<T: Real>(p: T) -> Summand {
    let one = NaturalNumber::from(1);
    let mean = Mean::of_one(p, &one);
    summand(&mean, || mean.leading())
}

/// The sums over the marginals of cells.
pub(super) struct Marginals<'a, E: Encoding> {
    weights: &'a Weights,
    tally: Tally<E::Float>,
    /// The counts of cells on which all maps agree, by their stored value.
    agreed: Repeated<E::Stored>,
    occupancies: Vec<E::Float>,
}

impl<'a, E: Encoding> Marginals<'a, E> {
    /// Creates empty sums for at most `cells` cells.
    pub(super) fn new(weights: &'a Weights, cells: u64) -> Self {
        let agreed = Repeated::new(cells, E::unknown());
        Self { weights, tally: Tally::new(), agreed, occupancies: Vec::new() }
    }

    /// Adds a cell, of which the maps store these values. Returns the nearest float to its mean.
    pub(super) fn add(&mut self, stored: &[E::Stored]) -> E::Float {
        self.occupancies.clear();
        self.occupancies.extend(stored.iter().filter_map(|&stored| E::occupancy(stored)));
        let mean = self.weights.mean(&self.occupancies);
        let first = mean.leading();
        let (state, both) = summand(&mean, || first);
        self.tally.add_fixed(state, both, 1);
        first.map_or(E::Float::zero(), |(leading, cut)| leading.nearest(cut))
    }

    /// Adds cells of which all maps store the same value; their mean is [`nearest`].
    #[inline]
    pub(super) fn add_agreed(&mut self, stored: E::Stored, count: u64) {
        if let Some((stored, count)) = self.agreed.add(stored, E::value(stored).to_bits(), count) {
            add_agreed::<E>(&mut self.tally, stored, count);
        }
    }

    /// Returns the sums.
    pub(super) fn into_tally(self) -> Tally<E::Float> {
        let mut tally = self.tally;
        self.agreed.into_counts().for_each(|(stored, count)| add_agreed::<E>(&mut tally, stored, count));
        tally
    }
}

/// Adds `count` cells with this stored value to a tally.
fn add_agreed<E: Encoding>(tally: &mut Tally<E::Float>, stored: E::Stored, count: u64) {
    let (state, both) = agreed(nearest::<E>(stored));
    tally.add_fixed(state, both, count);
}

/// Returns the mean where all maps store the same value: its occupancy, and never `-0`.
pub(super) fn nearest<E: Encoding>(stored: E::Stored) -> E::Float {
    E::occupancy(stored).unwrap_or(E::Float::HALF) + E::Float::zero()
}
