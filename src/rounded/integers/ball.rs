//! Fixed-point numbers of any precision with a counted error: [`Ball`].
//!
//! The series are those of the section "The comparison" of [`docs/rounding.md`](crate::book::rounding).

use super::limbs;
use alloc::{vec, vec::Vec};
use core::cmp::Ordering;

/// A real number in `[value - error, value + error]`, where `value` is a non-negative integer of limbs (lowest first)
/// and `error` an integer, both in units of `2^(-64 (limbs - 1))`: the top limb is the integer part.
///
/// Every operation floors and counts what it dropped. Values must stay below `2^64`.
#[derive(Clone, Debug)]
pub(crate) struct Ball {
    limbs: Vec<u64>,
    error: u128,
}

impl Ball {
    /// Creates `m 2^e` with `fraction` limbs below the integer part.
    pub(crate) fn dyadic(m: u64, e: i32, fraction: usize) -> Self {
        let mut limbs = vec![0; fraction + 1];
        limbs[fraction] = 1;
        Self { limbs, error: 0 }.scaled(m, e)
    }

    /// Returns the number of limbs below the integer part.
    pub(crate) fn fraction(&self) -> usize {
        self.limbs.len() - 1
    }

    /// Returns the top limb.
    fn integer_part(&self) -> u128 {
        u128::from(self.limbs[self.limbs.len() - 1])
    }

    /// Returns true if the value is 0, whatever the error.
    fn is_zero(&self) -> bool {
        self.limbs.iter().all(|&limb| limb == 0)
    }

    /// Returns the sum of two balls.
    pub(crate) fn plus(mut self, other: &Self) -> Self {
        // A value stays below 2^64: nothing carries out.
        limbs::add(&mut self.limbs, &other.limbs);
        self.error = self.error.saturating_add(other.error);
        self
    }

    /// Subtracts, where the difference is known not to be negative; gives 0 where floors made it so.
    pub(crate) fn minus(mut self, other: &Self) -> Self {
        self.error = self.error.saturating_add(other.error);
        if self.exact_order(other) == Ordering::Less {
            self.limbs.fill(0);
        } else {
            limbs::subtract_multiple(&mut self.limbs, &other.limbs, 1);
        }
        self
    }

    /// Returns `self m 2^e`.
    pub(crate) fn scaled(&self, m: u64, e: i32) -> Self {
        let n = self.limbs.len() as i64;
        // The product of n + 1 limbs, moved by e = 64 whole + part.
        let (whole, part) = (i64::from(e.div_euclid(64)), e.rem_euclid(64) as u32);
        let mut product = vec![0; self.limbs.len() + 2];
        let mut carry = 0_u128;
        for (k, limb) in product.iter_mut().enumerate() {
            // m 2^part has up to 127 bits: multiply by m, then shift the running sum limb by limb.
            let term = self.limbs.get(k).map_or(0, |&a| u128::from(a) * u128::from(m));
            let sum = carry + u128::from(term as u64);
            *limb = sum as u64;
            carry = (sum >> 64) + (term >> 64);
        }
        let bits_at =
            |k: i64| -> u64 { usize::try_from(k).ok().and_then(|k| product.get(k)).copied().unwrap_or(0) };
        let limbs = (0..n)
            .map(|k| {
                let (high, low) = (bits_at(k - whole), bits_at(k - whole - 1));
                if part == 0 { high } else { high << part | low >> (64 - part) }
            })
            .collect();
        // The error is scaled alike, rounded up, and the cut adds a unit.
        let error = if self.error == 0 {
            0
        } else if e >= 0 {
            let factor = 1_u128.checked_shl(e as u32).unwrap_or(u128::MAX);
            self.error.saturating_mul(u128::from(m)).saturating_mul(factor)
        } else {
            (self.error.saturating_mul(u128::from(m))).checked_shr(e.unsigned_abs()).unwrap_or(0) + 1
        };
        Self { limbs, error: error.saturating_add(1) }
    }

    /// Divides by an integer.
    pub(crate) fn over(mut self, divisor: u64) -> Self {
        limbs::divide(&mut self.limbs, divisor);
        self.error = (self.error / u128::from(divisor)).saturating_add(2);
        self
    }

    /// Multiplies.
    pub(crate) fn times(&self, other: &Self) -> Self {
        let n = self.limbs.len();
        let product = limbs::product(&self.limbs, &other.limbs);
        // |ab - a'b'| <= a' eb + b' ea + ea eb; a unit is at most 2^-128, so that ea eb is at most that of their upper halves.
        let both = ((self.error >> 64) + 1).saturating_mul((other.error >> 64) + 1);
        let error = (self.integer_part() + 1)
            .saturating_mul(other.error)
            .saturating_add((other.integer_part() + 1).saturating_mul(self.error));
        // The cut adds a unit.
        Self {
            limbs: product[n - 1..2 * n - 1].to_vec(),
            error: error.saturating_add(both).saturating_add(1),
        }
    }

    /// Divides by a divisor in `[1, 2]`, with a quotient below 2, bit by bit.
    pub(crate) fn divided_by(&self, divisor: &Self) -> Self {
        let n = self.limbs.len();
        let mut quotient = Self { limbs: vec![0; n], error: 0 };
        let mut rest = self.clone();
        for bit in (0..=64 * (n - 1)).rev() {
            if rest.exact_order(divisor) != Ordering::Less {
                rest = rest.minus(divisor);
                quotient.limbs[bit / 64] |= 1 << (bit % 64);
            }
            rest = rest.scaled(1, 1);
        }
        // |a/b - a'/b'| <= ea / b' + (a/b) eb / b' <= ea + 2 eb.
        quotient.error = self.error.saturating_add(divisor.error.saturating_mul(2)).saturating_add(2);
        quotient
    }

    /// Sums `D(q) = sum_{j >= 0} q^j / (j + 1) = -ln(1 - q) / q` for `0 <= q <= 1/2`.
    pub(crate) fn log_series(&self) -> Self {
        let fraction = self.fraction();
        let mut power = Self::dyadic(1, 0, fraction);
        let mut sum = power.clone();
        for j in 2.. {
            power = power.times(self);
            if power.is_zero() {
                break;
            }
            sum = sum.plus(&power.clone().over(j));
        }
        // The dropped powers: the first is at most its error, and each is at most half of the one before.
        sum.error = sum.error.saturating_add(power.error.saturating_mul(2));
        sum
    }

    /// Sums `T(u) = sum_{j >= 0} u^j / ((2j + 1) (2j + 2))` for `0 <= u <= 1/4`.
    pub(crate) fn information_series(&self) -> Self {
        let mut power = Self::dyadic(1, 0, self.fraction());
        let mut sum = power.clone().over(2);
        for j in 1.. {
            power = power.times(self);
            if power.is_zero() {
                break;
            }
            sum = sum.plus(&power.clone().over((2 * j + 1) * (2 * j + 2)));
        }
        // The dropped powers: the first is at most its error, and each is at most a quarter of the one before.
        sum.error = sum.error.saturating_add(power.error);
        sum
    }

    /// Sums `E(r) = (1 - e^-r) / r = sum_{j >= 0} (-r)^j / (j + 1)!` for `0 <= r < 1`.
    pub(crate) fn exp_quotient(&self) -> Self {
        self.alternating_series(|j| j + 1)
    }

    /// Sums `e^-r = sum_{j >= 0} (-r)^j / j!` for `0 <= r < 1`.
    pub(crate) fn exp_neg(&self) -> Self {
        self.alternating_series(|j| j)
    }

    /// Sums `1 - r / d(1) + r^2 / (d(1) d(2)) - ...` for `0 <= r < 1` and divisors of at least 1.
    fn alternating_series(&self, divisor: impl Fn(u64) -> u64) -> Self {
        let mut term = Self::dyadic(1, 0, self.fraction());
        let mut sum = term.clone();
        for j in 1.. {
            term = term.times(self).over(divisor(j));
            if term.is_zero() {
                break;
            }
            sum = if j % 2 == 0 { sum.plus(&term) } else { sum.minus(&term) };
        }
        // The dropped terms alternate and fall: their sum is at most the first, which is at most its error.
        sum.error = sum.error.saturating_add(term.error);
        sum
    }

    /// Computes `ln 2 = -ln(1 - 1/2) = D(1/2) / 2`.
    pub(crate) fn ln2(fraction: usize) -> Self {
        Self::dyadic(1, -1, fraction).log_series().scaled(1, -1)
    }

    /// Compares the values, whatever their errors: compares the numbers themselves if nothing was dropped.
    pub(crate) fn exact_order(&self, other: &Self) -> Ordering {
        limbs::compare(&self.limbs, &other.limbs)
    }

    /// Returns true if the number is above another; `None` if the balls meet.
    pub(crate) fn is_above(&self, other: &Self) -> Option<bool> {
        let order = self.exact_order(other);
        let (larger, smaller) = if order == Ordering::Less { (other, self) } else { (self, other) };
        let difference = larger.clone().minus(smaller);
        let error = difference.error;
        // The difference of the values against the sum of the errors, which fits two limbs.
        let exceeds = difference.limbs.iter().enumerate().any(|(k, &limb)| match k {
            0 | 1 => false,
            _ => limb != 0,
        }) || u128::from(difference.limbs[0]) | u128::from(difference.limbs[1]) << 64 > error;
        exceeds.then_some(order == Ordering::Greater)
    }
}

#[cfg(test)]
mod tests;
