//! Arithmetic rounded upwards: numbers that are not below the exact ones.

use crate::elementary::{exp, ln, sqrt};
use core::ops::{Add, Div, Mul};

/// An upper bound of a non-negative number; infinite or NaN if the number is beyond all floats.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(super) struct Up(pub(super) f64);

impl Up {
    /// Returns the smaller of two bounds of one number.
    pub(super) fn or(self, other: Self) -> Self {
        if other.0 < self.0 { other } else { self }
    }

    /// Computes the square root.
    pub(super) fn sqrt(self) -> Self {
        Self(sqrt(self.0).next_up())
    }

    /// Computes the power of two thirds.
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

/// Division by a lower bound of a positive number.
impl Div<f64> for Up {
    type Output = Self;

    fn div(self, divisor: f64) -> Self {
        Self((self.0 / divisor).next_up())
    }
}
