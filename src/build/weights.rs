//! Weighted means, exactly: `sum w_i x_i / sum w_i` as a quotient of integers, rounded once where a float is asked
//! for.

use crate::error::Error;
use crate::real::Real;
use crate::rounded::{Leading, Natural, leading, odd_parts, quotient};
use alloc::vec::Vec;
use core::cmp::Ordering;

/// The mean of `values` with the given weights, `sum w_i x_i / sum w_i`.
///
/// Correctly rounded, ties to even (proved, [`expected`](crate::book::expected)): neither order nor scale of the
/// weights changes a bit.
///
/// # Errors
/// As [`Hypotheses::new`](super::Hypotheses::new) on the weights; [`Error::Item`] naming the first value that is not
/// finite.
///
/// ```
/// use mean_information::build::weighted_mean;
/// assert_eq!(weighted_mean(&[0.3, 0.1, 0.2], &[0.5, 0.5, 0.5_f64])?, 0.5);
/// assert_eq!(weighted_mean(&[3.0, 0.5], &[-2.0, 12.0_f32])?, 0.0);
/// # Ok::<(), mean_information::Error>(())
/// ```
pub fn weighted_mean<T: Real>(weights: &[f64], values: &[T]) -> Result<T, Error> {
    let weights = Weights::new(weights, values.len())?;
    if let Some(index) = values.iter().position(|x| !x.is_finite()) {
        return Err(Error::Item { what: "value", index, value: values[index].widen(), allowed: "finite" });
    }
    Ok(weights.mean(values).nearest())
}

/// Weights and their sum, without rounding.
#[derive(Clone, Debug)]
pub(super) struct Weights {
    /// Each is `m 2^shift` in units of the least bit of all.
    parts: Vec<(u64, usize)>,
    total: Natural,
}

impl Weights {
    /// As many weights as there are `items`.
    pub(super) fn new(weights: &[f64], items: usize) -> Result<Self, Error> {
        if weights.len() != items {
            return Err(Error::WeightCount { given: weights.len(), items });
        }
        if let Some(index) = weights.iter().position(|&w| !(w >= 0.0 && w.is_finite())) {
            let (what, value) = ("weight", weights[index]);
            return Err(Error::Item { what, index, value, allowed: "not negative and finite" });
        }
        let least = weights.iter().filter_map(|&w| odd_parts(w)).map(|(_, e)| e).min();
        let least = least.ok_or_else(|| Error::out_of_range("sum of the weights", 0.0, "above 0"))?;
        let part = |&w: &f64| odd_parts(w).map_or((0, 0), |(m, e)| (m, (e - least) as usize));
        let parts: Vec<_> = weights.iter().map(part).collect();
        let mut total = Natural::default();
        for &(m, shift) in &parts {
            total.add_shifted(m.into(), shift);
        }
        Ok(Self { parts, total })
    }

    /// Whether an item has any weight.
    pub(super) fn is_positive(&self, index: usize) -> bool {
        self.parts[index].0 > 0
    }

    /// The mean of finite numbers, one for each weight.
    pub(super) fn mean<T: Real>(&self, values: &[T]) -> Mean<'_> {
        let parts = |&x: &T| odd_parts(x);
        let exponent = values.iter().filter_map(parts).map(|(_, e)| e).min().unwrap_or(0);
        let (mut positive, mut negative) = (Natural::default(), Natural::default());
        for (&(weight, shift), x) in self.parts.iter().zip(values) {
            if let Some((m, e)) = odd_parts(*x) {
                let sum = if *x < T::zero() { &mut negative } else { &mut positive };
                sum.add_shifted(u128::from(weight) * u128::from(m), shift + (e - exponent) as usize);
            }
        }
        let (sum, is_negative) = positive.difference(&negative);
        Mean { sum, is_negative, exponent, total: &self.total }
    }
}

/// A mean, `±sum 2^exponent / total`; of numbers in `[0, 1]` the exponent is at most 0.
pub(super) struct Mean<'a> {
    sum: Natural,
    is_negative: bool,
    exponent: i32,
    total: &'a Natural,
}

impl Mean<'_> {
    pub(super) fn nearest<T: Real>(&self) -> T {
        let magnitude: T = quotient(&self.sum, self.total, self.exponent);
        if self.is_negative { -magnitude } else { magnitude }
    }

    /// `total 2^-exponent`: what `sum` is if the mean is 1.
    fn whole(&self) -> Natural {
        self.total.shifted(self.exponent.unsigned_abs() as usize)
    }

    /// Of a mean `p` in `[0, 1]`: `2p - 1`, exactly.
    pub(super) fn beside_half(&self) -> Self {
        let (sum, is_negative) = self.sum.shifted(1).difference(&self.whole());
        Self { sum, is_negative, ..*self }
    }

    /// Of a mean `p` in `[0, 1]`: `1 - p`, exactly.
    pub(super) fn complement(&self) -> Self {
        let (sum, _) = self.whole().difference(&self.sum);
        Self { sum, ..*self }
    }

    /// Whether the mean is below, at or above 0, exactly.
    pub(super) fn sign(&self) -> Ordering {
        match (self.sum.is_zero(), self.is_negative) {
            (true, _) => Ordering::Equal,
            (false, true) => Ordering::Less,
            (false, false) => Ordering::Greater,
        }
    }

    /// The first 62 bits of the magnitude; `None` for 0.
    pub(super) fn leading(&self) -> Option<Leading> {
        leading(&self.sum, self.total, self.exponent).map(|(leading, _)| leading)
    }
}
