//! Rounding to the nearest float: of a number that is known only to lie in an interval (step 2 of Ziv's strategy), and
//! of integers, which are exact.
//!
//! The section "Rounding an enclosure" of [`docs/rounding.md`](crate::book::rounding) proves the first.

use crate::real::Real;

/// An enclosure in fixed point: a positive real number between `lo * 2^exponent` and `(lo + width) * 2^exponent`, ends
/// included.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FixedEnclosure {
    pub(crate) lo: u128,
    pub(crate) width: u128,
    pub(crate) exponent: i32,
}

/// The number `m * 2^exponent` half-way between two neighbouring floats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Midpoint {
    pub(super) m: u64,
    pub(super) exponent: i32,
}

/// The float nearest to a number, as far as its enclosure decides it.
pub(super) enum Rounded<T> {
    /// All of the enclosure rounds to this float.
    Decided(T),
    /// The enclosure holds the midpoint of these two neighbours.
    Between { below: T, above: T, midpoint: Midpoint },
}

impl FixedEnclosure {
    /// Encloses the numbers within `error` units of `value`.
    pub(super) fn around(value: u128, error: u128, exponent: i32) -> Self {
        Self { lo: value.saturating_sub(error), width: 2 * error, exponent }
    }

    /// Rounds to nearest, if the enclosure allows only one result.
    ///
    /// Needs `lo + width < 2^127` and a width below a quarter of the spacing of the floats there.
    #[inline]
    pub(super) fn round<T: Real>(self) -> Rounded<T> {
        // The bits of the lower end below the last one that the float keeps, subnormal floats included.
        let bits = 128 - self.lo.leading_zeros() as i32;
        let drop = (bits - T::PRECISION as i32).max(T::MIN_EXPONENT - self.exponent);
        if drop > 127 {
            // Below 2^127 units, and half of the smallest float is at least that much.
            return Rounded::Decided(T::zero());
        }
        debug_assert!(drop >= 2 && self.width < 1 << (drop - 2), "too wide an enclosure: {self:?}");
        let kept = (self.lo >> drop) as u64;
        let rest = self.lo & ((1 << drop) - 1);
        let half = 1_u128 << (drop - 1);
        let exponent = self.exponent + drop;
        let (below, above) = (|| T::from_parts(kept, exponent), || T::from_parts(kept + 1, exponent));
        // Rounding.md, "Rounding an enclosure": all below the midpoint, all above it, or it is inside.
        if rest + self.width < half {
            Rounded::Decided(below())
        } else if rest > half {
            // The next midpoint is half a spacing above `above`: further than the width.
            Rounded::Decided(above())
        } else {
            let midpoint = Midpoint { m: 2 * kept + 1, exponent: exponent - 1 };
            Rounded::Between { below: below(), above: above(), midpoint }
        }
    }
}

/// Rounds the integer of the limbs (lowest first) times `2^e`, a little more if `sticky`, to nearest, ties to even.
pub(crate) fn round_limbs<T: Real>(limbs: &[u64], e: i32, sticky: bool) -> T {
    let Some(top) = limbs.iter().rposition(|&limb| limb != 0) else {
        return T::zero();
    };
    // The two leading limbs have 65 bits or more, enough to round 53; the others only break ties.
    let low = top.saturating_sub(1);
    let m = limbs[low..=top].iter().rev().fold(0_u128, |m, &limb| m << 64 | u128::from(limb));
    let sticky = sticky || limbs[..low].iter().any(|&limb| limb != 0);
    round_integer(m, e + 64 * low as i32, sticky)
}

/// Rounds `m * 2^e`, a little more if `sticky`, to nearest, ties to even.
pub(crate) fn round_integer<T: Real>(m: u128, e: i32, sticky: bool) -> T {
    let bits = 128 - m.leading_zeros() as i32;
    let drop = (bits - T::PRECISION as i32).max(T::MIN_EXPONENT - e);
    // No bit to drop: the integer is a float.
    if drop <= 0 {
        return T::from_parts(m as u64, e);
    }
    // Below half of the smallest float.
    if drop > 128 {
        return T::zero();
    }
    let kept = m.checked_shr(drop as u32).unwrap_or(0);
    let rest = m ^ kept.checked_shl(drop as u32).unwrap_or(0);
    let half = 1_u128 << (drop - 1);
    // A tie goes to even, unless something beyond the bits makes it no tie.
    let up = rest > half || rest == half && (sticky || kept & 1 == 1);
    T::from_parts(kept as u64 + u64::from(up), e + drop)
}

#[cfg(test)]
mod tests;
