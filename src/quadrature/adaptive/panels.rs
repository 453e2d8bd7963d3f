//! The panels of an integral, in a tree that knows their sums and the worst of them.
//!
//! A panel at place `i` stands above those at `2i + 1` and `2i + 2`, as in a heap. Each place knows the totals of all
//! panels from it downwards. Replacing a panel renews the totals on its way to the root: each is always a sum of the
//! panels that are, never a running one, so nothing drifts.

use super::compensated::Compensated;
use super::stretch::Stretch;
use crate::real::Real;
use alloc::vec::Vec;

/// A stretch and the claim on its integral.
#[derive(Clone, Copy, Debug)]
pub(super) struct Panel<T> {
    pub(super) stretch: Stretch<T>,
    pub(super) value: T,
    /// How far off the rule seemed to be.
    pub(super) difference: T,
    /// How fast that falls.
    pub(super) ratio: T,
    /// Whether it is about as large as that of the other half, and as that of both before.
    pub(super) alike: bool,
    /// The part of the claimed error that halving can reduce.
    pub(super) reducible: T,
    /// The part that it cannot.
    pub(super) fixed: T,
}

/// Sums over panels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Totals<T> {
    value: Compensated<T>,
    pub(super) reducible: T,
    pub(super) fixed: T,
    /// The place of the panel with the largest reducible part.
    worst: usize,
    most: T,
}

impl<T: Real> Totals<T> {
    pub(super) fn value(&self) -> T {
        self.value.value()
    }

    fn merged(self, other: Self) -> Self {
        let (worst, most) =
            if other.most > self.most { (other.worst, other.most) } else { (self.worst, self.most) };
        Self {
            value: self.value.merged(other.value),
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
    pub(super) fn new() -> Self {
        Self { places: Vec::new() }
    }

    pub(super) fn push(&mut self, panel: Panel<T>) {
        let place = self.places.len();
        self.places.push((panel, alone(place, &panel)));
        self.renew(place);
    }

    /// The totals; none if there is no panel.
    pub(super) fn totals(&self) -> Option<Totals<T>> {
        self.places.first().map(|(_, totals)| *totals)
    }

    pub(super) fn worst(&self, totals: &Totals<T>) -> Panel<T> {
        self.places[totals.worst].0
    }

    /// Puts another panel in the place of the worst.
    pub(super) fn replace_worst(&mut self, totals: &Totals<T>, panel: Panel<T>) {
        self.places[totals.worst].0 = panel;
        self.renew(totals.worst);
    }

    /// Renews the totals of a place and of those above it.
    fn renew(&mut self, mut place: usize) {
        loop {
            let mut totals = alone(place, &self.places[place].0);
            for below in [2 * place + 1, 2 * place + 2] {
                if let Some((_, other)) = self.places.get(below) {
                    totals = totals.merged(*other);
                }
            }
            self.places[place].1 = totals;
            if place == 0 {
                return;
            }
            place = (place - 1) / 2;
        }
    }
}

/// The totals of one panel.
fn alone<T: Real>(place: usize, panel: &Panel<T>) -> Totals<T> {
    Totals {
        value: Compensated::new(panel.value),
        reducible: panel.reducible,
        fixed: panel.fixed,
        worst: place,
        most: panel.reducible,
    }
}
