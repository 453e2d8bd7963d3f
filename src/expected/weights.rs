//! Weighted means, exactly: `sum w_i x_i / sum w_i` as a quotient of integers, rounded once where a float is asked
//! for.

use crate::error::Error;
use crate::real::Real;
use crate::rounded::{Leading, NaturalNumber, leading, odd_parts, round_quotient};
use alloc::vec::Vec;
use core::cmp::Ordering;

/// Computes the weighted mean of `values`, `sum w_i x_i / sum w_i`.
///
/// Correctly rounded, ties to even (proved, [`expected`](crate::book::expected)): neither order nor scale of the
/// weights changes a bit.
///
/// # Errors
/// Those of [`Hypotheses::new`](super::Hypotheses::new) on the weights; [`Error::Item`] naming the first value that is not
/// finite.
///
/// ```
/// use mean_information::expected::weighted_mean;
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

/// The weights and their exact sum.
#[derive(Clone, Debug)]
pub(super) struct Weights {
    /// The weights as `m 2^shift`, in units of the lowest bit of all.
    parts: Vec<(u64, usize)>,
    /// The largest of these shifts.
    spread: usize,
    total: NaturalNumber,
}

impl Weights {
    /// Creates the weights of `items` items.
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
        let mut total = NaturalNumber::default();
        for &(m, shift) in &parts {
            total.add_shifted(m.into(), shift);
        }
        let spread = parts.iter().map(|&(_, shift)| shift).max().unwrap_or(0);
        Ok(Self { parts, spread, total })
    }

    /// Returns whether an item has a weight above 0.
    pub(super) fn is_positive(&self, index: usize) -> bool {
        self.parts[index].0 > 0
    }

    /// Returns the weights as integers in units of their lowest bit, if their sum is below `2^128`.
    pub(super) fn integers(&self) -> Option<Vec<u128>> {
        let fits = self.total.bits() <= 128;
        fits.then(|| self.parts.iter().map(|&(m, shift)| u128::from(m) << shift).collect())
    }

    /// Computes the exact mean of occupancies, each with the sum of the [`integers`](Self::integers) of the weights of those that
    /// have it; `None` if their exponents are too far apart for 256 bits.
    pub(super) fn mean_of_groups<T: Real>(&self, groups: &[(u128, T)]) -> Option<Mean<'_>> {
        let parts = || groups.iter().filter(|(_, x)| !x.is_zero()).map(|&(weight, x)| (weight, x.parts()));
        let least = parts().map(|(_, (_, e))| e).min().unwrap_or(0);
        let (mut low, mut high) = (0_u128, 0_u128);
        for (weight, (m, e)) in parts() {
            let shift = (e - least) as u32;
            // Weights below 2^128 in all, times 2^53 and 2^64: below 2^245, and their sum is one of such a product.
            if shift > 64 {
                return None;
            }
            let half = |weight: u128| weight * u128::from(m);
            let (bottom, top) = (half(weight & u128::from(u64::MAX)), half(weight >> 64));
            let (bottom, carry) = bottom.overflowing_add(top << 64);
            let top = (top >> 64) + u128::from(carry);
            let carry;
            (low, carry) = low.overflowing_add(bottom << shift);
            high += (top << shift) + ((bottom >> 1) >> (127 - shift)) + u128::from(carry);
        }
        let sum = NaturalNumber::from([low, high]);
        Some(Mean { sum, is_negative: false, exponent: least, total: &self.total })
    }

    /// Computes the exact mean of finite numbers, one for each weight.
    pub(super) fn mean<T: Real>(&self, values: &[T]) -> Mean<'_> {
        let (mut small, mut large) = (T::max_value(), T::zero());
        for x in values.iter().map(|x| x.abs()) {
            small = if x < small && !x.is_zero() { x } else { small };
            large = if x > large { x } else { large };
        }
        let least = if large.is_zero() { 0 } else { small.parts().1 };
        let highest = self.spread + (large.parts().1 - least).max(0) as usize;
        let (sum, is_negative) = if highest < 128 && values.len() < MANY {
            self.short_sum(values, least)
        } else {
            self.long_sum(values, least)
        };
        Mean { sum, is_negative, exponent: least, total: &self.total }
    }

    /// Returns `w_i x_i` for each `x_i` that is not 0: an integer and its shift in units of `2^least`, and whether it is
    /// negative.
    #[inline]
    fn terms<T: Real>(&self, values: &[T], least: i32) -> impl Iterator<Item = (u128, usize, bool)> {
        let pairs = self.parts.iter().zip(values).filter(|(_, x)| !x.is_zero());
        pairs.map(move |(&(weight, shift), &x)| {
            let (m, e) = x.parts();
            (u128::from(weight) * u128::from(m), shift + (e - least) as usize, x < T::zero())
        })
    }

    /// Computes the magnitude of `sum w_i x_i`, and whether it is negative, in two halves of 128 bits: for fewer than
    /// [`MANY`] terms of 106 bits, with shifts below 128.
    fn short_sum<T: Real>(&self, values: &[T], least: i32) -> (NaturalNumber, bool) {
        let (mut low, mut high) = (0_u128, 0_i128);
        for (n, shift, negative) in self.terms(values, least) {
            let (bottom, top) = (n << shift, ((n >> 1) >> (127 - shift)) as i128);
            let carry;
            (low, carry) = if negative { low.overflowing_sub(bottom) } else { low.overflowing_add(bottom) };
            let top = top + i128::from(carry);
            high += if negative { -top } else { top };
        }
        let is_negative = high < 0;
        if is_negative {
            high = -high - i128::from(low != 0);
            low = low.wrapping_neg();
        }
        (NaturalNumber::from([low, high as u128]), is_negative)
    }

    /// Computes the magnitude of `sum w_i x_i`, and whether it is negative, for any terms.
    fn long_sum<T: Real>(&self, values: &[T], least: i32) -> (NaturalNumber, bool) {
        let (mut positive, mut negative) = (NaturalNumber::default(), NaturalNumber::default());
        for (n, shift, is_negative) in self.terms(values, least) {
            let sum = if is_negative { &mut negative } else { &mut positive };
            sum.add_shifted(n, shift);
        }
        positive.difference(&negative)
    }
}

/// The number of terms from which a sum might not fit in 256 bits.
const MANY: usize = 1 << 20;

/// An exact mean, `±sum 2^exponent / total`; for numbers in `[0, 1]` the exponent is at most 0.
pub(super) struct Mean<'a> {
    sum: NaturalNumber,
    is_negative: bool,
    exponent: i32,
    total: &'a NaturalNumber,
}

impl<'a> Mean<'a> {
    /// Creates the mean of equal values `p` in `[0, 1]`; `one` is the integer 1.
    pub(super) fn of_one<T: Real>(p: T, one: &'a NaturalNumber) -> Self {
        let (m, exponent) = if p.is_zero() { (0, 0) } else { p.parts() };
        Self { sum: NaturalNumber::from(m), is_negative: false, exponent, total: one }
    }
}

impl Mean<'_> {
    /// Returns the nearest float, ties to even.
    pub(super) fn nearest<T: Real>(&self) -> T {
        let magnitude: T = round_quotient(&self.sum, self.total, self.exponent);
        if self.is_negative { -magnitude } else { magnitude }
    }

    /// Returns the shift of `total` that gives the `sum` of a mean of 1.
    fn whole(&self) -> usize {
        self.exponent.unsigned_abs() as usize
    }

    /// Returns `2p - 1` for a mean `p` in `[0, 1]`, exactly.
    pub(super) fn beside_half(&self) -> Self {
        let (sum, is_negative) = self.sum.shifted_difference(1, self.total, self.whole());
        Self { sum, is_negative, ..*self }
    }

    /// Returns `1 - p` for a mean `p` in `[0, 1]`, exactly.
    pub(super) fn complement(&self) -> Self {
        let (sum, _) = self.total.shifted_difference(self.whole(), &self.sum, 0);
        Self { sum, ..*self }
    }

    /// Compares the mean with 0, exactly.
    pub(super) fn sign(&self) -> Ordering {
        match (self.sum.is_zero(), self.is_negative) {
            (true, _) => Ordering::Equal,
            (false, true) => Ordering::Less,
            (false, false) => Ordering::Greater,
        }
    }

    /// Returns whether the first bit of a distance of numbers in `[0, 1]` shows that it is above `2^-4`.
    pub(super) fn is_above_a_sixteenth(&self) -> bool {
        self.sum.bits() + 3 >= self.total.bits() + self.whole()
    }

    /// Returns the first 63 bits of the magnitude, and whether there are more; `None` for 0.
    pub(super) fn leading(&self) -> Option<(Leading, bool)> {
        leading(&self.sum, self.total, self.exponent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::collection::vec;
    use proptest::prelude::*;

    proptest! {
        /// Two ways: in 256 bits, and in as many as it takes.
        #[test]
        fn a_short_sum_is_the_long_one(pairs in vec((1e-9_f64..1e9, prop_oneof![-1e9_f64..1e9, -1e-9_f64..1e-9, Just(0.0)]), 1..9), last in any::<bool>()) {
            let (weights, mut values): (Vec<f64>, Vec<f64>) = pairs.into_iter().unzip();
            if last {
                // Nothing is left of the first but for its sign.
                values[0] = -values[0];
            }
            let sums = Weights::new(&weights, values.len()).unwrap();
            let least = values.iter().filter(|x| **x != 0.0).map(|x| x.parts().1).min().unwrap_or(0);
            prop_assume!(values.iter().all(|x| *x == 0.0 || x.parts().1 - least + (sums.spread as i32) < 128));
            prop_assert_eq!(sums.short_sum(&values, least), sums.long_sum(&values, least));
        }

        /// `d 2^e` of 1, as the first bit says and as it is.
        #[test]
        fn above_a_sixteenth(d in 1_u64.., total in 1_u64.., shift in 0_i32..12) {
            let one = NaturalNumber::from(total);
            let mean = Mean { sum: NaturalNumber::from(d), is_negative: false, exponent: -shift, total: &one };
            let is_above = u128::from(d) << 4 > u128::from(total) << shift;
            prop_assert!(!mean.is_above_a_sixteenth() || is_above);
            // And above an eighth it says so.
            prop_assert!(mean.is_above_a_sixteenth() || u128::from(d) << 3 < u128::from(total) << shift);
        }
    }
}
