//! A result in the precision it was computed in.

use crate::hex_float;
use mean_information::Real;
use serde::{Serialize, Serializer};
use std::fmt;

/// A floating-point result. Written with the fewest digits that read back as the same number of its own precision, so
/// that an `f32` does not show the digits of a widened `f64`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Number {
    /// A number of a map in single precision.
    Single(f32),
    /// A number of a map in double precision, percent or bytes.
    Double(f64),
}

impl Number {
    /// Keeps a number with its precision.
    pub fn new<T: Real>(x: T) -> Self {
        if T::PRECISION == f32::PRECISION {
            Self::Single(f32::nearest(x.widen()))
        } else {
            Self::Double(x.widen())
        }
    }

    /// Wraps a number that was given, in single precision if that holds it: what a file stores as the `f32` nearest to
    /// 0.04 is 0.04, not 0.03999999910593033.
    pub fn given(x: f64) -> Self {
        if f64::from(x as f32) == x { Self::Single(x as f32) } else { Self::Double(x) }
    }

    /// Returns the same value in double precision, exactly.
    pub fn widen(self) -> f64 {
        match self {
            Self::Single(x) => x.widen(),
            Self::Double(x) => x,
        }
    }

    /// Writes the same value as a hexadecimal float.
    pub fn hex(self) -> String {
        match self {
            Self::Single(x) => hex_float::format(x),
            Self::Double(x) => hex_float::format(x),
        }
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Debug: always with a point or an exponent, as in JSON.
        match self {
            Self::Single(x) => write!(f, "{x:?}"),
            Self::Double(x) => write!(f, "{x:?}"),
        }
    }
}

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match *self {
            Self::Single(x) => serializer.serialize_f32(x),
            Self::Double(x) => serializer.serialize_f64(x),
        }
    }
}

/// Returns `x` to at most four significant digits.
pub fn short(x: f64) -> String {
    let rounded: f64 = format!("{x:.3e}").parse().unwrap_or(x);
    if rounded == 0.0 || (-4..6).contains(&decimal_exponent(rounded)) {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

/// Returns the `n` of `x = d.ddd * 10^n`.
pub fn decimal_exponent(x: f64) -> i32 {
    format!("{x:e}").split_once('e').and_then(|(_, n)| n.parse().ok()).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn given_numbers_have_the_digits_they_were_given_with() {
        assert_eq!(Number::given(f64::from(0.04_f32)).to_string(), "0.04");
        assert_eq!(Number::given(f64::from(0.04_f32) * 2048.0).to_string(), "81.92");
        assert_eq!(Number::given(0.04).to_string(), "0.04");
        assert_eq!(Number::given(0.05000001).to_string(), "0.05000001");
    }

    #[test]
    fn four_digits() {
        assert_eq!(short(0.05), "0.05");
        assert_eq!(short(0.123456), "0.1235");
        assert_eq!(short(1638.4), "1638");
        assert_eq!(short(0.1 + 0.2), "0.3");
        assert_eq!(short(1e6), "1e6");
        assert_eq!(short(2e-5), "2e-5");
    }
}
