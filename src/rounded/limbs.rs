//! Natural numbers as slices of 64-bit limbs, lowest first: what the integers of any size here have in common.

use alloc::{vec, vec::Vec};
use core::cmp::Ordering;

/// The order of two numbers of as many limbs.
pub(crate) fn compare(a: &[u64], b: &[u64]) -> Ordering {
    a.iter().rev().cmp(b.iter().rev())
}

/// `a + b` in place, `a` being at least as long as `b`; whether it carries out of `a`.
#[inline]
pub(crate) fn add(a: &mut [u64], b: &[u64]) -> bool {
    let mut carry = false;
    let mut limbs = a.iter_mut();
    // `b` first, so that no limb is taken and lost where `b` ends.
    for (&more, limb) in b.iter().zip(limbs.by_ref()) {
        let (sum, first) = limb.overflowing_add(more);
        let (sum, second) = sum.overflowing_add(u64::from(carry));
        *limb = sum;
        carry = first | second;
    }
    for limb in limbs {
        if !carry {
            break;
        }
        (*limb, carry) = limb.overflowing_add(1);
    }
    carry
}

/// `a - factor b` in place, `a` being at least as long as `b`; the borrow that is left.
pub(crate) fn subtract_multiple(a: &mut [u64], b: &[u64], factor: u64) -> u64 {
    let mut borrow = 0_u128;
    for (k, limb) in a.iter_mut().enumerate() {
        let product = u128::from(b.get(k).copied().unwrap_or(0)) * u128::from(factor) + borrow;
        let (difference, below) = limb.overflowing_sub(product as u64);
        *limb = difference;
        borrow = (product >> 64) + u128::from(below);
    }
    borrow as u64
}

/// `a b`, in as many limbs as both have.
pub(super) fn product(a: &[u64], b: &[u64]) -> Vec<u64> {
    let mut limbs = vec![0; a.len() + b.len()];
    for (i, &x) in a.iter().enumerate() {
        let mut carry = 0;
        for (j, &y) in b.iter().enumerate() {
            let sum = u128::from(x) * u128::from(y) + u128::from(limbs[i + j]) + carry;
            limbs[i + j] = sum as u64;
            carry = sum >> 64;
        }
        limbs[i + b.len()] = carry as u64;
    }
    limbs
}

/// `a / divisor` in place, cut; the remainder.
pub(crate) fn divide(a: &mut [u64], divisor: u64) -> u64 {
    let mut remainder = 0_u128;
    for limb in a.iter_mut().rev() {
        let dividend = remainder << 64 | u128::from(*limb);
        *limb = (dividend / u128::from(divisor)) as u64;
        remainder = dividend % u128::from(divisor);
    }
    remainder as u64
}

/// `n 2^bit` for a bit of a limb.
#[inline]
pub(crate) fn at_bit(n: u128, bit: usize) -> [u64; 3] {
    let low = n << bit;
    let high = if bit == 0 { 0 } else { (n >> (128 - bit)) as u64 };
    [low as u64, (low >> 64) as u64, high]
}
