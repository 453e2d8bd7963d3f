//! Natural numbers of any size, and the nearest float to the quotient of two.

use super::round_integer;
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
        while self.limbs.last() == Some(&0) {
            self.limbs.pop();
        }
        self
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
        let low = n << part;
        let high = if part == 0 { 0 } else { (n >> (128 - part)) as u64 };
        self.add_limbs(at, &[low as u64, (low >> 64) as u64, high]);
    }

    pub(crate) fn plus(mut self, other: &Self) -> Self {
        self.add_limbs(0, &other.limbs);
        self
    }

    fn add_limbs(&mut self, at: usize, addend: &[u64]) {
        let length = self.limbs.len().max(at + addend.len()) + 1;
        self.limbs.resize(length, 0);
        let mut carry = false;
        for (k, limb) in self.limbs[at..].iter_mut().enumerate() {
            if k >= addend.len() && !carry {
                break;
            }
            let (sum, first) = limb.overflowing_add(addend.get(k).copied().unwrap_or(0));
            let (sum, second) = sum.overflowing_add(u64::from(carry));
            *limb = sum;
            carry = first | second;
        }
        while self.limbs.last() == Some(&0) {
            self.limbs.pop();
        }
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
        subtract_multiple(&mut limbs, &small.limbs, 1);
        (Self { limbs }.trimmed(), negative)
    }

    pub(crate) fn times(&self, other: &Self) -> Self {
        let mut limbs = vec![0; self.limbs.len() + other.limbs.len()];
        for (i, &a) in self.limbs.iter().enumerate() {
            let mut carry = 0;
            for (j, &b) in other.limbs.iter().enumerate() {
                let sum = u128::from(a) * u128::from(b) + u128::from(limbs[i + j]) + carry;
                limbs[i + j] = sum as u64;
                carry = sum >> 64;
            }
            limbs[i + other.limbs.len()] = carry as u64;
        }
        Self { limbs }.trimmed()
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
        a.len().cmp(&b.len()).then_with(|| a.iter().rev().cmp(b.iter().rev()))
    }
}

/// `a - factor b` in place, `a` being at least as long as `b`; the borrow that is left.
fn subtract_multiple(a: &mut [u64], b: &[u64], factor: u64) -> u64 {
    let mut borrow = 0_u128;
    for (k, limb) in a.iter_mut().enumerate() {
        let product = u128::from(b.get(k).copied().unwrap_or(0)) * u128::from(factor) + borrow;
        let (difference, below) = limb.overflowing_sub(product as u64);
        *limb = difference;
        borrow = (product >> 64) + u128::from(below);
    }
    borrow as u64
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
    if subtract_multiple(&mut rest, &divisor.limbs, digit) != 0 {
        // At most two too large.
        loop {
            digit -= 1;
            if add_back(&mut rest, &divisor.limbs) {
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

/// `a + b` in place; whether it carries out of `a`, which ends a borrow.
fn add_back(a: &mut [u64], b: &[u64]) -> bool {
    let mut carry = false;
    for (k, limb) in a.iter_mut().enumerate() {
        let (sum, first) = limb.overflowing_add(b.get(k).copied().unwrap_or(0));
        let (sum, second) = sum.overflowing_add(u64::from(carry));
        *limb = sum;
        carry = first | second;
    }
    carry
}

#[cfg(test)]
mod tests;
