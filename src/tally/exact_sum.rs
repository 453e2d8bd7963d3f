//! An exact sum of non-negative floating-point numbers: a fixed-point integer wide enough for every `f64`
//! (Kulisch's long accumulator, without sign).

use crate::error::Error;
use crate::real::Real;
use crate::rounded::beyond_float::Fixed;
use crate::rounded::{limbs, round_limbs, shift_right};
use core::cmp::Ordering;

/// The number of 64-bit limbs. The lowest bit is worth `2^-1074`, so the sum can reach `2^(64 * 18 - 1074) = 2^78`.
const LIMBS: usize = 18;
/// The weight of the lowest bit, as an exponent of two: the smallest positive `f64`.
const LOWEST: i32 = -1074;

/// The exact sum of non-negative numbers in `f32` or `f64`, each at most 1.
///
/// Addition is exact, hence associative and commutative: any order and any tree of merges gives equal sums.
/// Reading the sum, or its quotient by a count, rounds once, to nearest with ties to even (proved,
/// [`sums`](crate::book::sums)).
///
/// ```
/// use mean_information::ExactSum;
/// let mut sum = ExactSum::new();
/// sum.add(0.1_f64);
/// sum.add_many(1e-17_f64, 1_000_000);
/// assert_eq!(sum.value::<f64>(), 0.10000000001);
/// assert_eq!(sum.mean::<f32>(4), 0.025);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExactSum {
    pub(super) limbs: [u64; LIMBS],
}

impl Default for ExactSum {
    fn default() -> Self {
        Self::new()
    }
}

impl ExactSum {
    /// Creates an empty sum, 0.
    pub const fn new() -> Self {
        Self { limbs: [0; LIMBS] }
    }

    /// Adds `x`, a number in `[0, 1]`.
    ///
    /// # Panics
    /// If `x` is NaN or outside `[0, 1]`, or if the sum would reach `2^78`; then the sum is lost.
    #[inline]
    pub fn add<T: Real>(&mut self, x: T) {
        self.add_many(x, 1);
    }

    /// Adds `x` in `[0, 1]`, `count` times, in one step.
    ///
    /// # Panics
    /// If `x` is NaN or outside `[0, 1]`, or if the sum would reach `2^78`; then the sum is lost.
    #[inline]
    pub fn add_many<T: Real>(&mut self, x: T, count: u64) {
        // Beyond [0, 1] the theorem (exact sums) says nothing: the sum could reach 2^78.
        assert!(x >= T::zero() && x <= T::one(), "an exact sum takes numbers in [0, 1], not {x}");
        let (m, e) = x.parts();
        // x = m 2^e in units of 2^LOWEST: the place is e - LOWEST, and the product of 53 and 64 bits fits in 128.
        self.add_at((e - LOWEST) as usize, u128::from(m) * u128::from(count));
    }

    /// Adds numbers in `[0, 1]`, as [`ExactSum::add`] does one by one.
    #[cfg(feature = "std")]
    pub(crate) fn add_all<T: Real>(&mut self, numbers: &[T]) {
        // 2^12 integers of 53 bits, moved by 63 bits at most, fit in 128: carries wait until the end.
        for numbers in numbers.chunks(1 << 12) {
            // The last word is for 1 in `f32`, `2^23` times `2^-23`: its place is 1051.
            let mut sums = [0_u128; LIMBS - 1];
            for x in numbers {
                let (m, e) = x.parts();
                let place = (e - LOWEST) as usize;
                sums[place / 64] += u128::from(m) << (place % 64);
            }
            let sums = sums.into_iter().enumerate().filter(|(_, sum)| *sum > 0);
            sums.for_each(|(limb, sum)| self.add_at(64 * limb, sum));
        }
    }

    /// Adds `value 2^exponent`, cut below the smallest positive `T`, `count` times.
    ///
    /// The cut loses less than one unit of the smallest number of `T`; all else is exact.
    #[inline]
    pub(crate) fn add_fixed<T: Real>(&mut self, Fixed { value, exponent }: Fixed, count: u64) {
        // Only terms below the normal numbers are cut, so that the sum stays a multiple of the smallest number of T.
        let exponent_kept = exponent.max(T::MIN_EXPONENT);
        let (place, n) = ((exponent_kept - LOWEST) as usize, shift_right(value, exponent_kept - exponent));
        if count == 1 {
            return self.add_at(place, n);
        }
        // 128 bits times 64 in halves, the upper one 64 places higher: 192 bits, exactly.
        self.add_at(place, u128::from(n as u64) * u128::from(count));
        self.add_at(place + 64, (n >> 64) * u128::from(count));
    }

    /// Adds the parts of a block's sum, exactly: multiples of the smallest number of `T`.
    #[cfg(feature = "std")]
    pub(crate) fn add_parts<T: Real>(&mut self, parts: [Fixed; 3]) {
        for part in parts.into_iter().filter(|part| part.value > 0) {
            self.add_fixed::<T>(part, 1);
        }
    }

    /// Adds `n` units of `2^(LOWEST + place)`.
    #[inline]
    fn add_at(&mut self, place: usize, n: u128) {
        // A number of 128 bits at any bit of a limb touches three limbs; the carry goes on from there.
        let (limb, bit) = (place / 64, place % 64);
        self.carry_into(limb, &limbs::at_bit(n, bit));
    }

    /// Takes `x` in `[0, 1]` out of the sum again, `count` times: the exact inverse of [`ExactSum::add_many`].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if `x` is NaN or outside `[0, 1]`, or if `count` times `x` is more than the sum. Then the sum
    /// has not changed.
    ///
    /// ```
    /// use mean_information::ExactSum;
    /// let mut sum = ExactSum::new();
    /// sum.add(0.75_f64);
    /// sum.add_many(1e-300_f64, 3);
    /// sum.remove_many(0.75_f64, 1)?;
    /// assert_eq!(sum.value::<f64>(), 3e-300);
    /// assert!(sum.remove_many(1e-300_f64, 4).is_err());
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn remove_many<T: Real>(&mut self, x: T, count: u64) -> Result<(), Error> {
        if !(x >= T::zero() && x <= T::one()) {
            return Err(Error::out_of_range("number to remove from a sum", x.widen(), "0 to 1"));
        }
        let (m, e) = x.parts();
        // The place at which add_many has put it.
        let (limb, bit) = ((e - LOWEST) as usize / 64, (e - LOWEST) as usize % 64);
        // On a copy: a borrow from beyond the last limb means that the sum holds less, and leaves it as it was.
        let mut rest = self.limbs;
        let removed = limbs::at_bit(u128::from(m) * u128::from(count), bit);
        if limbs::subtract_multiple(&mut rest[limb..], &removed, 1) != 0 {
            let total = x.widen() * count as f64;
            return Err(Error::out_of_range("amount to remove from a sum", total, "at most the sum"));
        }
        self.limbs = rest;
        Ok(())
    }

    /// Adds the sum of another.
    ///
    /// # Panics
    /// If the sum would reach `2^78`; then the sum is lost.
    pub fn merge(&mut self, other: &Self) {
        // One unit for all sums: limb by limb, without rounding.
        self.carry_into(0, &other.limbs);
    }

    /// Adds the integer of the given limbs, the first of which stands at limb `at`.
    #[inline]
    fn carry_into(&mut self, at: usize, addend: &[u64]) {
        let carry = limbs::add(&mut self.limbs[at..], addend);
        // Fewer than 2^64 terms of at most 1 stay below 2^78: sums.md, theorem (exact sums).
        assert!(!carry, "an exact sum stays below 2^78");
    }

    /// Compares the sum with another.
    pub(super) fn compare_sum(&self, other: &Self) -> Ordering {
        limbs::compare(&self.limbs, &other.limbs)
    }

    /// Returns whether the sum is a multiple of `2^exponent`.
    pub(super) fn is_multiple_of_power(&self, exponent: i32) -> bool {
        let bits = (exponent - LOWEST) as usize;
        // The bits of each limb that are worth less than the power.
        let below = |(k, limb): (usize, &u64)| match bits.saturating_sub(64 * k) {
            0 => 0,
            low @ 1..64 => limb & ((1 << low) - 1),
            _ => *limb,
        };
        self.limbs.iter().enumerate().map(below).all(|low| low == 0)
    }

    /// Returns the sum, rounded once to nearest.
    pub fn value<T: Real>(&self) -> T {
        // No remainder: one rounding, theorem (exact sums).
        self.mean(1)
    }

    /// Returns the sum divided by `count`: the exact quotient, rounded once to nearest; 0 if `count` is 0.
    pub fn mean<T: Real>(&self, count: u64) -> T {
        if count == 0 {
            return T::zero();
        }
        // Scale 1074 becomes 1138: one more limb below, so that the quotient keeps 64 bits under the smallest subnormal.
        let mut quotient = [0; LIMBS + 1];
        quotient[1..].copy_from_slice(&self.limbs);
        let remainder = limbs::divide(&mut quotient, count);
        // The remainder breaks ties: with the quotient it determines the nearest float, theorem (exact sums).
        round_limbs(&quotient, LOWEST - 64, remainder != 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    /// Ten limbs of ones, and one unit more.
    #[test]
    fn a_carry_runs_through_all_limbs() {
        let mut sum = ExactSum::new();
        for limb in 0..10 {
            sum.add_many(f64::from_parts(1, LOWEST + 64 * limb), u64::MAX);
        }
        sum.add(f64::from_bits(1));
        // Not the values: rounding would hide ones that were left standing.
        let mut power = ExactSum::new();
        power.add(f64::from_parts(1, LOWEST + 640));
        assert_eq!(sum, power);
    }

    /// Of every size, more than are added without a carry.
    #[cfg(feature = "std")]
    #[test]
    fn all_at_once_are_one_by_one() {
        fn check<T: Real>(numbers: &[T]) {
            let (mut all, mut one_by_one) = (ExactSum::new(), ExactSum::new());
            all.add_all(numbers);
            for &x in numbers {
                one_by_one.add(x);
            }
            assert_eq!(all, one_by_one);
        }
        let most = |k: u64| f64::from_bits((1023 - k % 1023) << 52).next_down();
        let ends = [0.0, 1.0, f64::from_bits(1), f64::MIN_POSITIVE, f64::MIN_POSITIVE.next_down()];
        // At the last bit of a limb, as large as can be.
        let largest = f64::from_parts((1 << 53) - 1, LOWEST + 64 * 15 - 1);
        let largest = core::iter::repeat_n(largest, 4_500);
        let numbers: Vec<f64> = ends.into_iter().chain((0..9_000).map(most)).chain(largest).collect();
        check(&numbers);
        let singles: Vec<f32> = numbers.iter().map(|&x| x as f32).collect();
        check(&singles);
        check(&[1.0_f32.next_down()].repeat(4_500));
    }

    /// `(c + 1) / (2 c)` units, `c = 2^63 + 1`: above the midpoint of 0 and one unit by less than any bit kept.
    #[test]
    fn a_remainder_alone_breaks_a_tie() {
        let (unit, count) = (f64::from_bits(1), (1 << 63) + 1);
        let mut sum = ExactSum::new();
        sum.add_many(unit, (1 << 62) + 1);
        assert_eq!(sum.mean::<f64>(count), unit);
        let mut tie = ExactSum::new();
        tie.add_many(unit, 1 << 62);
        assert_eq!(tie.mean::<f64>(1 << 63), 0.0);
    }
}
