//! Natural numbers of any size, and the nearest float to the quotient of two.

use super::{limbs, round_integer};
use crate::real::Real;
use alloc::{vec, vec::Vec};
use core::cmp::Ordering;

/// A natural number: limbs, lowest first, the last of which is not 0.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Natural {
    limbs: Vec<u64>,
}

impl From<u64> for Natural {
    fn from(n: u64) -> Self {
        Self { limbs: vec![n] }.trimmed()
    }
}

impl Natural {
    fn trimmed(mut self) -> Self {
        self.trim();
        self
    }

    fn trim(&mut self) {
        while self.limbs.last() == Some(&0) {
            self.limbs.pop();
        }
    }

    pub(crate) fn is_zero(&self) -> bool {
        self.limbs.is_empty()
    }

    /// How many bits it takes.
    pub(crate) fn bits(&self) -> usize {
        self.limbs.last().map_or(0, |top| 64 * self.limbs.len() - top.leading_zeros() as usize)
    }

    /// Adds `n 2^shift`.
    pub(crate) fn add_shifted(&mut self, n: u128, shift: usize) {
        let (at, part) = (shift / 64, shift % 64);
        self.add_limbs(at, &limbs::at_bit(n, part));
    }

    pub(crate) fn plus(mut self, other: &Self) -> Self {
        self.add_limbs(0, &other.limbs);
        self
    }

    fn add_limbs(&mut self, at: usize, addend: &[u64]) {
        let length = self.limbs.len().max(at + addend.len()) + 1;
        self.limbs.resize(length, 0);
        limbs::add(&mut self.limbs[at..], addend);
        self.trim();
    }

    /// `self 2^shift`.
    pub(crate) fn shifted(&self, shift: usize) -> Self {
        let (whole, part) = (shift / 64, shift % 64);
        let mut limbs = vec![0; whole];
        let mut carry = 0;
        for &limb in &self.limbs {
            limbs.push(limb << part | carry);
            carry = if part == 0 { 0 } else { limb >> (64 - part) };
        }
        limbs.push(carry);
        Self { limbs }.trimmed()
    }

    /// `self - other` and whether it is negative: its magnitude.
    pub(crate) fn difference(&self, other: &Self) -> (Self, bool) {
        let negative = *self < *other;
        let (large, small) = if negative { (other, self) } else { (self, other) };
        let mut limbs = large.limbs.clone();
        // The larger: no borrow is left.
        limbs::subtract_multiple(&mut limbs, &small.limbs, 1);
        (Self { limbs }.trimmed(), negative)
    }

    pub(crate) fn times(&self, other: &Self) -> Self {
        Self { limbs: limbs::product(&self.limbs, &other.limbs) }.trimmed()
    }
}

impl PartialOrd for Natural {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Natural {
    fn cmp(&self, other: &Self) -> Ordering {
        let (a, b) = (&self.limbs, &other.limbs);
        a.len().cmp(&b.len()).then_with(|| limbs::compare(a, b))
    }
}

/// `n 2^e / divisor`, rounded once to nearest, ties to even, for a divisor that is not 0.
pub(crate) fn quotient<T: Real>(n: &Natural, divisor: &Natural, e: i32) -> T {
    leading(n, divisor, e)
        .map_or(T::zero(), |(leading, sticky)| round_integer(u128::from(leading.m), leading.e, sticky))
}

/// The first bits of a positive number: `m 2^e`, `m` in `[2^63, 2^64)`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leading {
    pub(crate) m: u64,
    pub(crate) e: i32,
}

/// `n 2^e / divisor` cut by less than `2^-62` of it, and whether it was cut; `None` if it is 0. Exponents stop at
/// `-4096`.
pub(crate) fn leading(n: &Natural, divisor: &Natural, e: i32) -> Option<(Leading, bool)> {
    if n.is_zero() {
        return None;
    }
    // A quotient of 63 or 64 bits, one step of long division (Knuth, The Art of Computer Programming 4.3.1, algorithm
    // D): the divisor's top limb at least 2^63, the dividend below 2^64 times the divisor.
    let length = divisor.limbs.len();
    let normalising = 64 * length - divisor.bits();
    let scale = (divisor.bits() + 63) as i64 - n.bits() as i64;
    // A dividend that is far longer moves the divisor instead.
    let more = usize::try_from(-scale).map_or(0, |excess| excess.div_ceil(64) * 64);
    let divisor = divisor.shifted(normalising + more);
    let moved = scale + (normalising + more) as i64;
    let mut rest = n.shifted(moved as usize).limbs;
    let top = divisor.limbs.len();
    rest.resize(top + 1, 0);
    let estimate =
        (u128::from(rest[top]) << 64 | u128::from(rest[top - 1])) / u128::from(divisor.limbs[top - 1]);
    let mut digit = u64::try_from(estimate).unwrap_or(u64::MAX);
    if limbs::subtract_multiple(&mut rest, &divisor.limbs, digit) != 0 {
        // At most two too large.
        loop {
            digit -= 1;
            // A carry out ends the borrow.
            if limbs::add(&mut rest, &divisor.limbs) {
                break;
            }
        }
    }
    let sticky = rest.iter().any(|&limb| limb != 0);
    // n 2^e / divisor = digit 2^(e - scale).
    let shift = digit.leading_zeros();
    let e = i64::from(e) - scale - i64::from(shift);
    Some((Leading { m: digit << shift, e: clamped(e) }, sticky))
}

/// Beyond these exponents everything is 0 or infinite.
fn clamped(e: i64) -> i32 {
    e.clamp(-4096, 4096) as i32
}

#[cfg(test)]
mod tests;
