//! Natural numbers of any size, and the nearest float to the quotient of two.

use super::inline_limbs::Limbs;
use super::limbs;
use crate::real::Real;
use crate::rounded::round::round_integer;
use core::cmp::Ordering;

/// A natural number: limbs, lowest first, the last of which is not 0.
#[derive(Clone, Debug)]
pub(crate) struct NaturalNumber {
    limbs: Limbs,
}

impl Default for NaturalNumber {
    fn default() -> Self {
        Self { limbs: Limbs::zeros(0) }
    }
}

impl From<u64> for NaturalNumber {
    fn from(n: u64) -> Self {
        Self::from([n.into(), 0])
    }
}

/// Converts `low + high 2^128`.
impl From<[u128; 2]> for NaturalNumber {
    #[inline]
    fn from([low, high]: [u128; 2]) -> Self {
        let mut limbs = Limbs::zeros(4);
        limbs.copy_from_slice(&[low as u64, (low >> 64) as u64, high as u64, (high >> 64) as u64]);
        Self { limbs }.trimmed()
    }
}

impl NaturalNumber {
    /// Returns the number without limbs of 0 at the top.
    fn trimmed(mut self) -> Self {
        self.trim();
        self
    }

    /// Drops limbs of 0 at the top.
    fn trim(&mut self) {
        let length = self.limbs.iter().rposition(|&limb| limb != 0).map_or(0, |top| top + 1);
        self.limbs.resize(length);
    }

    /// Returns true for 0.
    pub(crate) fn is_zero(&self) -> bool {
        self.limbs.is_empty()
    }

    /// Returns the number of bits up to the leading one; 0 for 0.
    pub(crate) fn bits(&self) -> usize {
        self.limbs.last().map_or(0, |top| 64 * self.limbs.len() - top.leading_zeros() as usize)
    }

    /// Adds `n 2^shift`.
    pub(crate) fn add_shifted(&mut self, n: u128, shift: usize) {
        let (at, part) = (shift / 64, shift % 64);
        self.add_limbs(at, &limbs::at_bit(n, part));
    }

    /// Returns the sum of two numbers.
    pub(crate) fn plus(mut self, other: &Self) -> Self {
        self.add_limbs(0, &other.limbs);
        self
    }

    /// Adds `addend 2^(64 at)`.
    fn add_limbs(&mut self, at: usize, addend: &[u64]) {
        // One limb more than either, so that nothing carries out.
        let length = self.limbs.len().max(at + addend.len()) + 1;
        self.limbs.resize(length);
        limbs::add(&mut self.limbs[at..], addend);
        self.trim();
    }

    /// Returns `self 2^shift`.
    pub(crate) fn shifted(&self, shift: usize) -> Self {
        let (whole, part) = (shift / 64, shift % 64);
        let mut limbs = Limbs::zeros(whole + self.limbs.len() + 1);
        let mut carry = 0;
        for (shifted, &limb) in limbs[whole..].iter_mut().zip(self.limbs.iter()) {
            *shifted = limb << part | carry;
            carry = if part == 0 { 0 } else { limb >> (64 - part) };
        }
        limbs[whole + self.limbs.len()] = carry;
        Self { limbs }.trimmed()
    }

    /// Returns the magnitude of `self - other`, and true if the difference is negative.
    pub(crate) fn difference(&self, other: &Self) -> (Self, bool) {
        let negative = *self < *other;
        let (large, small) = if negative { (other, self) } else { (self, other) };
        let mut limbs = large.limbs.clone();
        // The subtrahend is the smaller one: no borrow is left.
        limbs::subtract_multiple(&mut limbs, &small.limbs, 1);
        (Self { limbs }.trimmed(), negative)
    }

    /// Returns the magnitude of `self 2^shift - other 2^other_shift`, and true if the difference is negative.
    pub(crate) fn shifted_difference(&self, shift: usize, other: &Self, other_shift: usize) -> (Self, bool) {
        // Almost always below 2^256, in two integers of 128 bits.
        let (Some(a), Some(b)) = (self.halves(shift), other.halves(other_shift)) else {
            return self.shifted(shift).difference(&other.shifted(other_shift));
        };
        let negative = (a[1], a[0]) < (b[1], b[0]);
        let (large, small) = if negative { (b, a) } else { (a, b) };
        let (low, borrow) = large[0].overflowing_sub(small[0]);
        (Self::from([low, large[1] - small[1] - u128::from(borrow)]), negative)
    }

    /// Returns `low` and `high` with `self 2^shift = low + high 2^128`; `None` unless that is below `2^256`.
    #[inline]
    fn halves(&self, shift: usize) -> Option<[u128; 2]> {
        if self.bits() + shift > 256 {
            return None;
        }
        let limb = |k: usize| u128::from(self.limbs.get(k).copied().unwrap_or(0));
        let [low, high] = [limb(1) << 64 | limb(0), limb(3) << 64 | limb(2)];
        Some(match shift {
            0..128 => [low << shift, high << shift | (low >> 1) >> (127 - shift)],
            128..256 => [0, low << (shift - 128)],
            _ => [0, 0],
        })
    }

    /// Multiplies.
    pub(crate) fn times(&self, other: &Self) -> Self {
        Self { limbs: limbs::product(&self.limbs, &other.limbs).into() }.trimmed()
    }
}

impl PartialEq for NaturalNumber {
    fn eq(&self, other: &Self) -> bool {
        *self.limbs == *other.limbs
    }
}

impl Eq for NaturalNumber {}

impl PartialOrd for NaturalNumber {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for NaturalNumber {
    fn cmp(&self, other: &Self) -> Ordering {
        let (a, b) = (&self.limbs, &other.limbs);
        a.len().cmp(&b.len()).then_with(|| limbs::compare(a, b))
    }
}

/// Computes `n 2^e / divisor`, rounded once to nearest, ties to even, for a divisor that is not 0.
pub(crate) fn round_quotient<T: Real>(n: &NaturalNumber, divisor: &NaturalNumber, e: i32) -> T {
    leading(n, divisor, e).map_or(T::zero(), |(leading, sticky)| leading.nearest(sticky))
}

/// The leading 63 bits of a positive number: `m 2^e`, `m` in `[2^63, 2^64)` and even.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leading {
    pub(crate) m: u64,
    pub(crate) e: i32,
}

impl Leading {
    /// Rounds the number, or a little more if `sticky`, to the nearest float; ties to even.
    pub(crate) fn nearest<T: Real>(self, sticky: bool) -> T {
        round_integer(u128::from(self.m), self.e, sticky)
    }
}

/// Returns the leading 63 bits of `n 2^e / divisor`, and true if bits follow that are not 0; `None` if it is 0.
///
/// The result depends on the number, not on the fraction that it is written as. Exponents stop at `-4096`.
pub(crate) fn leading(n: &NaturalNumber, divisor: &NaturalNumber, e: i32) -> Option<(Leading, bool)> {
    if n.is_zero() {
        return None;
    }
    // A quotient of 63 or 64 bits, one step of long division (Knuth, The Art of Computer Programming 4.3.1, algorithm
    // D): the divisor's top limb at least 2^63, the dividend below 2^64 times the divisor.
    let scale = (divisor.bits() + 63) as i64 - n.bits() as i64;
    let (digit, sticky) = match short(divisor) {
        Some((divisor, normalising)) if scale + normalising as i64 >= 0 => {
            short_digit(n, (scale + normalising as i64) as usize, divisor)
        }
        _ => long_digit(n, scale, divisor),
    };
    // n 2^e / divisor = digit 2^(e - scale). Whether there is a 64th bit is up to the fraction: it is cut.
    let shift = digit.leading_zeros();
    let (m, e) = (digit << shift, i64::from(e) - scale - i64::from(shift));
    Some((Leading { m: m & !1, e: clamped(e) }, sticky || m & 1 == 1))
}

/// Shifts a divisor of at most 128 bits up to 128 bits, and returns with it the shift; `None` for longer ones.
fn short(divisor: &NaturalNumber) -> Option<(u128, u32)> {
    let n = match *divisor.limbs {
        [low] => u128::from(low),
        [low, high] => u128::from(high) << 64 | u128::from(low),
        _ => return None,
    };
    Some((n << n.leading_zeros(), n.leading_zeros()))
}

/// Computes `n 2^shift / divisor`, below `2^64`, cut, for a divisor of 128 bits, and returns true with it if a
/// remainder is left.
#[inline]
fn short_digit(n: &NaturalNumber, shift: usize, divisor: u128) -> (u64, bool) {
    // The dividend has three limbs.
    let (whole, part) = (shift / 64, shift % 64);
    let limb = |k: usize| n.limbs.get(k.wrapping_sub(whole)).copied().unwrap_or(0);
    let shifted =
        |k: usize| if part == 0 { limb(k) } else { limb(k) << part | limb(k.wrapping_sub(1)) >> (64 - part) };
    let top = u128::from(shifted(2)) << 64 | u128::from(shifted(1));
    let (high, low) = (divisor >> 64, divisor & u128::from(u64::MAX));
    // The estimate is not too small, and at most two too large (Knuth, theorem B).
    let mut digit = (top / high).min(u128::from(u64::MAX));
    // The rest of the two upper limbs; with the third it is below 2^64 divisors, and at least minus two of them.
    let mut rest = top - digit * high;
    loop {
        // While digit low > rest 2^64 + the third limb: at most two too large, and then the rest is of one limb.
        let product = digit * low;
        if rest >> 64 != 0 || product <= (rest << 64 | u128::from(shifted(0))) {
            return (digit as u64, rest >> 64 != 0 || product != (rest << 64 | u128::from(shifted(0))));
        }
        digit -= 1;
        rest += high;
    }
}

/// Computes `n 2^scale / divisor`, in `(2^62, 2^64)`, cut, and returns true with it if a remainder is left.
fn long_digit(n: &NaturalNumber, scale: i64, divisor: &NaturalNumber) -> (u64, bool) {
    let length = divisor.limbs.len();
    let normalising = 64 * length - divisor.bits();
    // Where the scale is negative, as for a far longer dividend, the divisor is moved instead: by whole limbs.
    let more = usize::try_from(-scale).map_or(0, |excess| excess.div_ceil(64) * 64);
    let divisor = divisor.shifted(normalising + more);
    let moved = scale + (normalising + more) as i64;
    let mut rest = n.shifted(moved as usize).limbs;
    let top = divisor.limbs.len();
    rest.resize(top + 1);
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
    (digit, sticky)
}

/// Clamps an exponent to a range beyond which every float is 0 or infinite.
fn clamped(e: i64) -> i32 {
    e.clamp(-4096, 4096) as i32
}

#[cfg(test)]
mod tests;
