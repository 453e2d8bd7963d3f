//! The panels of an integral, in a tree that knows their sums and the worst of them.
//!
//! A panel at place `i` stands above those at `2i + 1` and `2i + 2`, as in a heap. Each place knows the totals of all
//! panels from it downwards. Replacing a panel renews the totals on its way to the root: each is always a sum of the
//! panels that are, never a running one, so nothing drifts.

use super::compensated::Compensated;
use super::panel::{Panel, SIDES};
use super::rule::Rule;
use super::stretch::Stretch;
use crate::real::Real;
use alloc::vec::Vec;

/// The sums over panels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Totals<T> {
    value: Compensated<T>,
    pub(super) reducible: T,
    pub(super) fixed: T,
    /// The place of the panel with the largest reducible part.
    pub(super) worst: usize,
    most: T,
}

impl<T: Real> Totals<T> {
    /// Returns the integral over all panels, as good as one rounding.
    pub(super) fn value(&self) -> T {
        self.value.value()
    }

    /// Merges the totals of two sets of panels; of two worst panels alike the former stays.
    fn merged(self, other: Self) -> Self {
        let (worst, most) =
            if other.most > self.most { (other.worst, other.most) } else { (self.worst, self.most) };
        Self {
            value: self.value.merged(other.value),
            // Claims are estimates: their sums may round.
            reducible: self.reducible + other.reducible,
            fixed: self.fixed + other.fixed,
            worst,
            most,
        }
    }
}

/// The panels.
pub(super) struct Panels<T> {
    places: Vec<(Panel<T>, Totals<T>)>,
}

impl<T: Real> Panels<T> {
    /// Creates a tree without panels.
    pub(super) fn new() -> Self {
        Self { places: Vec::new() }
    }

    /// Adds a panel at the next free place, to the right of the one at another.
    pub(super) fn push(&mut self, panel: Panel<T>, after: Option<usize>) -> usize {
        let place = self.places.len();
        // The panel after that one gets a new neighbour, too.
        let next = after.and_then(|after| self.places[after].0.beside[1].replace(place));
        if let Some(next) = next {
            self.places[next].0.beside[0] = Some(place);
        }
        let panel = Panel { beside: [after, next], ..panel };
        self.places.push((panel, alone(place, &panel)));
        self.renew(place);
        place
    }

    /// Returns the panel at a place.
    pub(super) fn at(&self, place: usize) -> &Panel<T> {
        &self.places[place].0
    }

    /// Puts another panel at a place, between the same ones.
    pub(super) fn replace(&mut self, place: usize, panel: Panel<T>) {
        // Neighbours stay: only what lies between them has changed.
        let beside = self.places[place].0.beside;
        self.places[place].0 = Panel { beside, ..panel };
        self.renew(place);
    }

    /// Doubts anew a panel and those beside it.
    pub(super) fn doubt(&mut self, place: usize, whole: Stretch<T>, rule: Rule) {
        let [before, after] = self.places[place].0.beside;
        // An end belongs to two panels: either's polynomial is compared with the other's.
        for place in [before, Some(place), after].into_iter().flatten() {
            let panel = self.places[place].0;
            let beside = panel.beside.map(|other| other.map(|other| &self.places[other].0));
            let doubts = SIDES.map(|side| panel.doubt(side, beside[side], whole, rule));
            self.places[place].0.doubts = doubts;
            self.renew(place);
        }
    }

    /// Returns the totals of all panels; none if there is no panel.
    pub(super) fn totals(&self) -> Option<Totals<T>> {
        self.places.first().map(|(_, totals)| *totals)
    }

    /// Renews the totals of a place and of those above it.
    fn renew(&mut self, mut place: usize) {
        loop {
            // Always a sum over panels, never a corrected one: large early claims leave no trace ("Halving the worst").
            let mut totals = alone(place, &self.places[place].0);
            // As in a heap: the places below are at twice this one.
            for below in [2 * place + 1, 2 * place + 2] {
                if let Some((_, other)) = self.places.get(below) {
                    totals = totals.merged(*other);
                }
            }
            self.places[place].1 = totals;
            if place == 0 {
                return;
            }
            // Only the way to the root has changed.
            place = (place - 1) / 2;
        }
    }
}

/// Returns the totals of one panel.
fn alone<T: Real>(place: usize, panel: &Panel<T>) -> Totals<T> {
    let [reducible, fixed] = panel.claim();
    Totals { value: Compensated::new(panel.value), reducible, fixed, worst: place, most: reducible }
}
