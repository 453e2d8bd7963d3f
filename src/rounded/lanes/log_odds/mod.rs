//! Entropy, information and occupancy of many cells at once, from their log-odds.
//!
//! In both formats a value `V` is computed of which each result is either itself or `1 - V`: the information up to `|l| = 2`,
//! the entropy from there on; or, in `f64`, the smaller of the two probabilities, where `f32` has the occupancy itself. In `f64` it
//! is from a table as far as that goes, and from a series beyond ([`far`]).

pub(super) mod double;
pub(super) mod far;
#[rustfmt::skip] // as `proofs/log_odds.sollya` writes it
#[expect(clippy::excessive_precision)]
mod polynomials;
pub(super) mod single;
pub(super) mod table;

/// The magnitude of log-odds up to which `V` is the information, from which on it is the entropy.
const NEAR: f64 = 2.0;
/// `3/2 2^52`: added to a number below `2^51`, it leaves the nearest integer in the last bits.
const ROUND: f64 = 6755399441055744.0;

/// A result of one cell.
pub(super) trait Quantity {
    /// Whether `V` is the smaller of the two probabilities.
    const OF_OCCUPANCY: bool;
    /// The result at `l = 0`.
    const UNKNOWN: f64;

    /// Returns true if the result at log-odds `l` is `1 - V`.
    fn is_complement(l: f64) -> bool;
}

/// Names the entropy.
pub(super) struct Entropy;
/// Names the information.
pub(super) struct Information;
/// Names the occupancy.
pub(super) struct Occupancy;

impl Quantity for Entropy {
    const OF_OCCUPANCY: bool = false;
    const UNKNOWN: f64 = 1.0;

    #[inline(always)]
    fn is_complement(l: f64) -> bool {
        l.abs() < NEAR
    }
}

impl Quantity for Information {
    const OF_OCCUPANCY: bool = false;
    const UNKNOWN: f64 = 0.0;

    #[inline(always)]
    fn is_complement(l: f64) -> bool {
        l.abs() >= NEAR
    }
}

impl Quantity for Occupancy {
    const OF_OCCUPANCY: bool = true;
    const UNKNOWN: f64 = 0.5;

    #[inline(always)]
    fn is_complement(l: f64) -> bool {
        l > 0.0
    }
}

#[cfg(test)]
mod tests;
