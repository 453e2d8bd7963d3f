//! Doubts about the gap between the outermost node of a panel and its end, into which no node of the panel falls.
//!
//! ```text
//! |error| <= |f(end) - p(end)| gap        of a jump or a kink in the gap
//! ```
//!
//! `p` is the polynomial through the values at the nodes: a smooth integrand follows it to the end. `f(end)` is known
//! by the polynomial of the panel beside, or by one value next to the end, the *witness*. Derived in the chapter
//! [`quadrature`](crate::book::quadrature), "What the ends hide".

use super::panel::Panel;
use super::rule::Rule;
use super::stretch::Stretch;
use crate::real::Real;

/// A panel whose bands fall by this factor or more is smooth as far as its nodes can see: of others the own claim is
/// much larger than what a gap can hide.
const SMOOTH: u64 = 8;

impl<T: Real> Stretch<T> {
    /// Returns the argument next to an end; the other end, if that is nearer.
    pub(super) fn witness(self, side: usize, whole: Self) -> T {
        let step = self.step(whole);
        if side == 0 { (self.lower + step).min(self.upper) } else { (self.upper - step).max(self.lower) }
    }

    /// Returns the distance of a witness from the end: four spacings of floats as large as the whole.
    fn step(self, whole: Self) -> T {
        T::from_parts(4, 0) * T::epsilon() * self.magnitude().max(whole.widths(T::one()))
    }
}

impl<T: Real> Panel<T> {
    /// Returns true if the values at the nodes are those of a smooth integrand.
    pub(super) fn seems_smooth(&self) -> bool {
        self.difference <= self.noise || self.decay * T::from_parts(SMOOTH, 0) < T::one()
    }

    /// Returns the error that a gap may hide at one side, given the panel beside it.
    pub(super) fn doubt(&self, side: usize, beside: Option<&Self>, whole: Stretch<T>, rule: Rule) -> T {
        let own = self.ends[side];
        // Of a singular integrand the polynomials tell less than the values do.
        let apart = |value: T| {
            let apart = (value - own).abs();
            if self.seems_smooth() { apart } else { apart.min(self.spread) }
        };
        // What the polynomial of the panel beside says, without one more evaluation.
        let jump = beside.map_or(T::zero(), |beside| apart(beside.ends[1 - side]));
        // A witness that the nodes have passed says nothing about the gap.
        let nodes = self.stretch.pair(rule.outermost());
        let is_in_gap = |x: T| if side == 0 { x < nodes[0] } else { nodes[1] < x };
        // Twice the bound: of a kink beside the outermost node, inside, the polynomial follows half.
        let gap = rule.gap::<T>() + rule.gap::<T>();
        let doubt = match self.witnesses[side] {
            // A jump at the end itself: its place is known to the step of the witness.
            Some((x, value)) if is_in_gap(x) => {
                self.stretch.widths(gap * apart(value)) + jump * self.stretch.step(whole)
            }
            // Lemma (gap).
            _ => self.stretch.widths(gap * jump),
        };
        // A value that is no number tells nothing.
        if doubt.is_finite() { doubt } else { T::zero() }
    }

    /// Returns the parts of the claim: what halving can reduce, and what it cannot.
    pub(super) fn claim(&self) -> [T; 2] {
        let [mut reducible, mut fixed] = [self.reducible, self.fixed];
        for doubt in self.doubts {
            // The polynomials of two panels differ by their noise, too.
            if doubt <= self.fixed || self.is_settled {
                fixed = fixed + doubt;
            } else {
                reducible = reducible + doubt;
            }
        }
        [reducible, fixed]
    }

    /// Returns the side whose doubt makes most of the reducible claim.
    pub(super) fn doubtful_side(&self) -> Option<usize> {
        let side = usize::from(self.doubts[1] > self.doubts[0]);
        // Below the noise it is noise; below the own claim halving serves both.
        (self.doubts[side] > self.reducible && self.doubts[side] > self.fixed).then_some(side)
    }
}
