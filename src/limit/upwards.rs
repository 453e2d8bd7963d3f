//! Arithmetic rounded upwards: numbers that are at least what they stand for.

use crate::elementary::{exp, ln, sqrt};
use core::ops::{Add, Div, Mul};

/// A number not below the non-negative one that it stands for; infinite or NaN if that is beyond all floats.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(super) struct Up(pub(super) f64);

impl Up {
    /// The smaller of two bounds of one number.
    pub(super) fn or(self, other: Self) -> Self {
        if other.0 < self.0 { other } else { self }
    }

    pub(super) fn sqrt(self) -> Self {
        Self(sqrt(self.0).next_up())
    }

    /// The power of two thirds.
    pub(super) fn two_thirds_power(self) -> Self {
        // The logarithm is below 745, so its roundings move the power by less than 745 * 2^-52 of its value.
        Self(exp(ln(self.0) * (2.0 / 3.0))) * Self(1.0 + 1e-12)
    }
}

impl Add for Up {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self((self.0 + other.0).next_up())
    }
}

impl Mul for Up {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self((self.0 * other.0).next_up())
    }
}

/// By a positive number that is not above the one that it stands for.
impl Div<f64> for Up {
    type Output = Self;

    fn div(self, divisor: f64) -> Self {
        Self((self.0 / divisor).next_up())
    }
}
