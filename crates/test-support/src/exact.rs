//! The numbers of the vectors, read exactly: decimals and hexadecimal floats.

use mean_information::Real;
use num_bigint::BigUint;
use std::cmp::Ordering;

/// The number `m 2^binary 10^decimal`.
#[derive(Clone, Debug)]
pub struct Exact {
    /// The integer.
    pub m: BigUint,
    /// The exponent of two.
    pub binary: i32,
    /// The exponent of ten.
    pub decimal: i32,
}

impl Exact {
    /// Reads a decimal such as `1.25e-3`.
    pub fn decimal(text: &str) -> Option<Self> {
        let (significand, exponent) = text.split_once('e').unwrap_or((text, "0"));
        let (whole, fraction) = significand.split_once('.').unwrap_or((significand, ""));
        let m = format!("{whole}{fraction}").parse().ok()?;
        Some(Self { m, binary: 0, decimal: exponent.parse::<i32>().ok()? - fraction.len() as i32 })
    }

    /// Compares two numbers exactly.
    #[must_use]
    pub fn compare(&self, other: &Self) -> Ordering {
        let (binary, decimal) = (self.binary.min(other.binary), self.decimal.min(other.decimal));
        let integer = |x: &Self| {
            (&x.m << (x.binary - binary) as u32) * BigUint::from(10_u32).pow((x.decimal - decimal) as u32)
        };
        integer(self).cmp(&integer(other))
    }
}

/// Reads a C99 hexadecimal float exactly; `nan`, `inf` and `-inf` too.
pub fn float<T: Real>(text: &str) -> Option<T> {
    let (negative, magnitude) = text.strip_prefix('-').map_or((false, text), |rest| (true, rest));
    let x = match magnitude {
        "nan" => T::nan(),
        "inf" => T::infinity(),
        _ => {
            let (significand, exponent) = magnitude.strip_prefix("0x")?.split_once('p')?;
            let (whole, fraction) = significand.split_once('.').unwrap_or((significand, ""));
            let m = u64::from_str_radix(&format!("{whole}{fraction}"), 16).ok()?;
            T::from_parts(m, exponent.parse::<i32>().ok()? - 4 * fraction.len() as i32)
        }
    };
    Some(if negative { -x } else { x })
}
