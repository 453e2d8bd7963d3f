//! The marginals of cells and the sums over them: entropy and information of the exact weighted means.

use super::weights::{Mean, Weights};
use crate::cell::State;
use crate::map::Encoding;
use crate::map::repeated::Repeated;
use crate::real::Real;
use crate::rounded::NaturalNumber;
use crate::rounded::beyond_float::{self, Both};
use crate::tally::Tally;
use alloc::vec::Vec;
use core::cmp::Ordering;
use num_traits::Zero;

/// The marginal of a cell: the nearest float, the state, and entropy with information as the sums need them.
#[derive(Clone, Copy)]
struct Marginal<T> {
    nearest: T,
    state: State,
    both: Both,
}

impl<T: Real> Marginal<T> {
    /// Computes the marginal from an exact mean of occupancies.
    fn of(mean: &Mean<'_>) -> Self {
        let beside_half = mean.beside_half();
        let state = match beside_half.sign() {
            Ordering::Less => State::Free,
            Ordering::Greater => State::Occupied,
            Ordering::Equal => State::Unknown,
        };
        let first = mean.leading();
        let nearest = first.map_or(T::zero(), |(leading, cut)| leading.nearest(cut));
        // A certain mean, 0 or 1, has no smaller probability to go by.
        let minor = || {
            let minor = if state == State::Free { first } else { mean.complement().leading() };
            minor.map_or(beyond_float::CERTAIN, |(leading, _)| beyond_float::at_smaller_probability(leading))
        };
        let beside_unknown =
            || beside_half.leading().and_then(|(leading, _)| beyond_float::at_distance_from_unknown(leading));
        let both = match state {
            State::Unknown => beyond_float::UNKNOWN,
            _ if beside_half.is_above_a_sixteenth() => minor(),
            _ => beside_unknown().unwrap_or_else(minor),
        };
        Self { nearest, state, both }
    }
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
        let marginal = Marginal::of(&self.weights.mean(&self.occupancies));
        self.tally.add_fixed(marginal.state, marginal.both, 1);
        marginal.nearest
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
    let marginal = Marginal::<E::Float>::of(&Mean::of_one(nearest::<E>(stored), &NaturalNumber::from(1)));
    tally.add_fixed(marginal.state, marginal.both, count);
}

/// Returns the mean where all maps store the same value: its occupancy, and never `-0`.
pub(super) fn nearest<E: Encoding>(stored: E::Stored) -> E::Float {
    E::occupancy(stored).unwrap_or(E::Float::HALF) + E::Float::zero()
}
