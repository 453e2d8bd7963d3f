//! Numbers that are compared and subtracted exactly: decimals of the vectors, floats of ports.

use mean_information::Real;
use num_bigint::{BigInt, BigUint};
use std::cmp::Ordering;

/// Decimals have exponents up to this: far beyond every float, and nothing that would take long.
const MAX_EXPONENT: i32 = 5000;

/// The number `m 2^binary 10^decimal`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Exact {
    m: BigInt,
    binary: i32,
    decimal: i32,
}

impl Exact {
    /// Creates the number `m 2^binary`.
    pub(super) fn new(m: impl Into<BigInt>, binary: i32) -> Self {
        Self { m: m.into(), binary, decimal: 0 }
    }

    /// Parses a decimal such as `-1.25e-3`; none if it is malformed, or of a length or exponent above `MAX_EXPONENT`.
    pub(super) fn decimal(text: &str) -> Option<Self> {
        let (significand, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        let (whole, fraction) = significand.split_once('.').unwrap_or((significand, ""));
        let exponent = exponent.parse::<i32>().ok()?;
        let short = text.len() <= MAX_EXPONENT as usize && exponent.unsigned_abs() <= MAX_EXPONENT as u32;
        let digits = format!("{whole}{fraction}");
        let plain = digits.trim_start_matches('-').bytes().all(|b| b.is_ascii_digit());
        if !short || !plain {
            return None;
        }
        Some(Self { m: digits.parse().ok()?, binary: 0, decimal: exponent - fraction.len() as i32 })
    }

    /// Returns the exact value of a finite float.
    pub(super) fn of<T: Real>(x: T) -> Self {
        let (m, e) = x.parts();
        let m = BigInt::from(m);
        Self::new(if x.is_sign_negative() { -m } else { m }, e)
    }

    /// Returns this number times `2^e`.
    pub(super) fn scaled(&self, e: i32) -> Self {
        Self { binary: self.binary + e, ..self.clone() }
    }

    /// Returns the absolute value.
    pub(super) fn abs(&self) -> Self {
        Self { m: self.m.magnitude().clone().into(), ..*self }
    }

    /// Returns both numbers as integers of a common unit, and that unit.
    fn common(&self, other: &Self) -> (BigInt, BigInt, Self) {
        let (binary, decimal) = (self.binary.min(other.binary), self.decimal.min(other.decimal));
        let integer = |x: &Self| {
            let tens = BigInt::from(10).pow((x.decimal - decimal) as u32);
            (&x.m << (x.binary - binary) as u32) * tens
        };
        (integer(self), integer(other), Self { m: 1.into(), binary, decimal })
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        let (a, b, unit) = self.common(other);
        Self { m: a + b, ..unit }
    }

    pub(super) fn minus(&self, other: &Self) -> Self {
        let (a, b, unit) = self.common(other);
        Self { m: a - b, ..unit }
    }

    pub(super) fn cmp(&self, other: &Self) -> Ordering {
        let (a, b, _) = self.common(other);
        a.cmp(&b)
    }

    /// Returns the nearest float within an ulp; infinity or zero beyond the range of floats.
    pub(super) fn approximate(&self) -> f64 {
        let tens = BigUint::from(10_u32).pow(self.decimal.unsigned_abs());
        let (mut m, mut e) = (self.m.magnitude().clone(), self.binary);
        if self.decimal >= 0 {
            m *= tens;
        } else {
            let wanted = tens.bits() + 64;
            let shift = wanted.saturating_sub(m.bits());
            m = (m << shift) / tens;
            e -= shift as i32;
        }
        let dropped = m.bits().saturating_sub(64);
        let top = (m >> dropped).iter_u64_digits().next().unwrap_or(0);
        // Rounded to a float's bits, which are then put where they belong.
        let (top, shift) = (top as f64).parts();
        let e = e + dropped as i32 + shift;
        let x = if e <= f64::MIN_EXPONENT - 64 { 0.0 } else { f64::from_parts(top, e) };
        if self.m.sign() == num_bigint::Sign::Minus { -x } else { x }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_and_floats() {
        let quarter = Exact::of(0.25_f64);
        for text in ["0.25", "2.5e-1", "25E-2", "0.2500e0", "2500e-4"] {
            assert!(Exact::decimal(text).unwrap().cmp(&quarter).is_eq(), "{text}");
        }
        assert!(Exact::decimal("-0.25").unwrap().cmp(&Exact::of(-0.25_f32)).is_eq());
        assert!(Exact::decimal("1e-324").unwrap().cmp(&Exact::of(f64::from_bits(1))).is_lt());
        for text in ["", "-", "1e", "e5", "0x1p3", "1.2.3", "1e999999999", "--1", "1-1", "nan", "+1"] {
            assert_eq!(Exact::decimal(text), None, "{text}");
        }
    }

    #[test]
    fn differences_and_approximations() {
        let third = Exact::decimal("0.3333333333333333333333333333333333333333").unwrap();
        assert_eq!(third.approximate(), 1.0 / 3.0);
        let difference = Exact::of(1.0_f64 / 3.0).minus(&third);
        assert_eq!(difference.approximate(), -1.850371707708594e-17);
        assert_eq!(difference.scaled(54).abs().approximate(), 1.0 / 3.0);
        assert_eq!(third.plus(&third).plus(&third).minus(&Exact::of(1.0_f64)).approximate(), -1e-40);
        assert_eq!(Exact::decimal("1e400").unwrap().approximate(), f64::INFINITY);
        assert_eq!(Exact::decimal("-1e-400").unwrap().approximate(), 0.0);
        assert_eq!(Exact::decimal("1e-400").unwrap().scaled(1074).approximate(), 2.024022533073106e-77);
    }
}
