//! `p = A / (A + B)` with `A = prod p_i` and `B = prod (1 - p_i)`, as if computed exactly and rounded once.
//!
//! The powers of two of the factors `p_i = m_i 2^-n_i` and `1 - p_i = (2^n_i - m_i) 2^-n_i` are the same on both sides
//! and cancel: `A` and `B` stand for products of integers here. They are formed in 128 bits first; where these leave
//! two floats to choose from, which includes all ties, exactly. The errors are derived in
//! [`docs/fusion.md`](crate::book::fusion).

use super::fixed::{mul_high, reciprocal, shift_right};
use super::integers::natural_number::{NaturalNumber, round_quotient};
use super::round::{FixedEnclosure, Rounded};
use super::ziv::odd_parts;
use crate::real::Real;

/// A positive number, cut: `m 2^e` with a significand `m` in `[2^127, 2^128)`.
#[derive(Clone, Copy)]
struct Cut {
    m: u128,
    e: i64,
}

impl Cut {
    /// The number one.
    const ONE: Self = Self { m: 1 << 127, e: -127 };

    /// Creates `m 2^e` for `m > 0`, exactly.
    fn new(m: u128, e: i64) -> Self {
        let shift = m.leading_zeros();
        Self { m: m << shift, e: e - i64::from(shift) }
    }

    /// Multiplies; cut by less than 2 units of the last place.
    fn times(self, other: Self) -> Self {
        Self::new(mul_high(self.m, other.m), self.e + other.e + 128)
    }
}

/// Fuses occupancies inside `(0, 1)`: `A / (A + B)`, correctly rounded.
pub(crate) fn fused<T: Real>(occupancies: impl Iterator<Item = T> + Clone) -> T {
    match enclosure(occupancies.clone().filter_map(factors)).round() {
        Rounded::Decided(p) => p,
        Rounded::Between { .. } => exactly(occupancies.filter_map(factors)),
    }
}

/// Returns `m` and `n` with `p = m 2^-n`, `m` odd.
fn factors<T: Real>(p: T) -> Option<(u64, u32)> {
    odd_parts(p).map(|(m, e)| (m, (-e) as u32))
}

/// Encloses the fused occupancy within a relative `2^-80`, for fewer than `2^40` factors: each cuts below `2^-125`.
fn enclosure(factors: impl Iterator<Item = (u64, u32)>) -> FixedEnclosure {
    let (a, b) = factors.fold((Cut::ONE, Cut::ONE), |(a, b), (m, n)| {
        let free = if n < 128 { Cut::new((1 << n) - u128::from(m), 0) } else { rest_of_small(m, n) };
        (a.times(Cut::new(m.into(), 0)), b.times(free))
    });
    share(a, b)
}

/// Encloses `a / (a + b)` within a relative `2^-80`, for the cuts in `a` and `b`; the quotient adds less than `2^-118`.
fn share(a: Cut, b: Cut) -> FixedEnclosure {
    let occupied = (a.e, a.m) >= (b.e, b.m);
    let (large, small) = if occupied { (a, b) } else { (b, a) };
    // From 2000 on the nearest float is 0 or 1.
    let gap = (large.e - small.e).min(2000) as i32;
    // x = small / large = ratio 2^(-126 - gap), at most 1, and p or 1 - p is 1 / (1 + x).
    let ratio = mul_high(small.m, reciprocal(large.m >> 1) << 1);
    // 1 + x at scale 126: x is cut by less than a unit.
    let inverse = reciprocal((1 << 126) + shift_right(ratio, gap));
    let (value, exponent) =
        if occupied { (inverse, -126) } else { (mul_high(ratio << 1, inverse << 1), -126 - gap) };
    FixedEnclosure::around(value, value >> 80, exponent)
}

/// Computes `2^n - m` for `m < 2^53` and `n >= 128`, cut by at most a unit of the last place.
fn rest_of_small(m: u64, n: u32) -> Cut {
    // 2^128 - m 2^(128 - n), less a unit, so that the significand is below 2^128.
    Cut { m: u128::MAX - shift_right(u128::from(m), n as i32 - 128), e: i64::from(n) - 128 }
}

/// Computes `A / (A + B)` in integers of any size and rounds it once, ties to even.
fn exactly<T: Real>(factors: impl Iterator<Item = (u64, u32)>) -> T {
    let (mut a, mut b) = (NaturalNumber::from(1), NaturalNumber::from(1));
    for (m, n) in factors {
        a = a.times(&m.into());
        b = b.times(&NaturalNumber::from(1).shifted(n as usize).difference(&m.into()).0);
    }
    let whole = b.plus(&a);
    round_quotient(&a, &whole, 0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cell::in_unit_interval;
    use proptest::collection::vec;
    use proptest::prelude::*;

    fn inside() -> impl Strategy<Value = f64> {
        prop_oneof![
            (1_u64..1.0_f64.to_bits()).prop_map(f64::from_bits),
            (1_u32..64).prop_map(|k| f64::from(k) / 64.0),
            0.2..0.8,
        ]
        .prop_filter("inside", |&p| p > 0.0 && p < 1.0)
    }

    /// Next to a midpoint: `p = a b 2^-800 (1 + a 2^-400 + ...)` with `a b` of 54 bits, the last of them 1.
    #[test]
    fn what_128_bits_do_not_tell_is_told_exactly() {
        let (a, b) = ((1 << 27) + 1, (1 << 26) + 1);
        let p = [f64::from_parts(a, -400), f64::from_parts(b, -400)];
        let found = enclosure(p.into_iter().filter_map(factors)).round::<f64>();
        assert!(matches!(found, Rounded::Between { .. }));
        assert_eq!(fused(p.into_iter()), f64::from_parts(a * b / 2 + 1, -799));
    }

    /// Nor does an exponent wrap.
    #[test]
    fn what_lies_beyond_all_floats_is_certain() {
        let far = |e| Cut { m: 1 << 127, e };
        for gap in [1999, 2000, 2001, 1 << 31, 1 << 32, 1 << 40] {
            assert!(matches!(share(far(gap), far(0)).round(), Rounded::Decided(1.0_f64)));
            assert!(matches!(share(far(0), far(gap)).round(), Rounded::Decided(0.0_f64)));
        }
    }

    proptest! {
        #[test]
        fn the_rest_of_a_small_factor_is_cut_by_a_unit(m in 1_u64..1 << 53, n in 128_u32..200) {
            let rest = rest_of_small(m, n);
            // (2^n - m) 2^(128 - n) is below 2^128: what is missing, in units of the last place.
            let missing = (rest.m.wrapping_neg() as f64) - m as f64 / f64::from_parts(1, n as i32 - 128);
            prop_assert!((0.0..=1.0).contains(&missing));
            prop_assert_eq!(rest.e, i64::from(n) - 128);
        }

        /// Two ways: 128 bits, and exactly.
        #[test]
        fn the_enclosure_holds_the_exact_result(p in vec(inside(), 0..12)) {
            let exact: f64 = exactly(p.iter().copied().filter_map(factors));
            let found: f64 = fused(p.iter().copied());
            prop_assert!(in_unit_interval(exact));
            prop_assert_eq!(found.to_bits(), exact.to_bits(), "{:?}", p);
            let single: Vec<f32> = p.iter().map(|&p| p as f32).filter(|&p| p > 0.0 && p < 1.0).collect();
            let exact: f32 = exactly(single.iter().copied().filter_map(factors));
            prop_assert_eq!(fused(single.iter().copied()), exact);
        }
    }
}
