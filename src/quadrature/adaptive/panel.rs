//! A panel: a stretch, the value of the rule on it, and all that its claim rests on.

use super::stretch::Stretch;

/// The lower and the upper end of a panel.
pub(super) const SIDES: [usize; 2] = [0, 1];

/// A stretch and the claim on its integral.
#[derive(Clone, Copy, Debug)]
pub(super) struct Panel<T> {
    pub(super) stretch: Stretch<T>,
    pub(super) value: T,
    /// The difference from the truth that the rule showed.
    pub(super) difference: T,
    /// The factor by which halving reduces that, the slower of the last two.
    pub(super) ratio: T,
    /// True if both halves of the panel above had a difference of about its size.
    pub(super) alike: bool,
    /// The ratio of the bands.
    pub(super) decay: T,
    /// The rounding error of the value.
    pub(super) noise: T,
    /// The largest value less the smallest.
    pub(super) spread: T,
    /// The part of the claimed error that halving can reduce, doubts apart.
    pub(super) reducible: T,
    /// The part that it cannot.
    pub(super) fixed: T,
    /// True if floats are too coarse to halve the panel, or a half has no value.
    pub(super) is_settled: bool,
    /// The polynomial through the values, at either end.
    pub(super) ends: [T; 2],
    /// An argument next to either end and the value there, where it was asked for.
    pub(super) witnesses: [Option<(T, T)>; 2],
    /// The error that the gap at either end may hide.
    pub(super) doubts: [T; 2],
    /// The places of the panels beside this one.
    pub(super) beside: [Option<usize>; 2],
}
