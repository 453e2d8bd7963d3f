//! The state of a rigorous integration, and its result in 128 bits.

use crate::estimate::Status;
use crate::interval::{Interval, Wide};

/// A panel narrower than this share of the whole is not cut any more.
pub(super) const NARROWEST: f64 = 1.0 / (1_u128 << 120) as f64;

/// The state of a rigorous integration.
pub(super) struct Search<'a, F> {
    pub(super) f: &'a F,
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) evaluations: u64,
    pub(super) limit: u64,
}

/// An integral in 128 bits, for results that are computed from several.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Integral {
    /// Contains the integral.
    pub(crate) value: Interval<Wide>,
    pub(crate) status: Status<f64>,
    pub(crate) evaluations: u64,
}
