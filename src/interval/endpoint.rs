//! What the ends of an interval are: floats with arithmetic rounded in a given direction.
//!
//! For `f32` and `f64` the rounded result of the processor is taken, and the sign of its exact residual (Knuth's
//! TwoSum, Dekker's product) tells on which side of the true one it lies. No rounding mode is switched and no fused
//! operation assumed. The elementary functions are those of [`Wide`].

use core::fmt::Debug;
use core::ops::Neg;

use super::{Interval, Wide};
use crate::elementary;

/// Where a result is rounded to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Toward {
    /// Not above the exact result.
    Down,
    /// Not below the exact result.
    Up,
}

pub(super) mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// An end of an interval: `f32`, `f64`, or the wide float of this crate's integrals.
///
/// Sealed: the soundness of every interval rests on it. No operation is given a NaN or makes one: `0 inf = 0`, since
/// an infinite end stands for numbers without bound, each of them finite.
pub trait Endpoint: sealed::Sealed + Copy + Debug + PartialOrd + Neg<Output = Self> {
    /// 0.
    const ZERO: Self;
    /// 1/2.
    const HALF: Self;
    /// 1.
    const ONE: Self;
    /// No bound above.
    const INFINITY: Self;
    /// No bound below.
    const NEG_INFINITY: Self;
    /// An interval that contains `ln 2`.
    const LN_2: Interval<Self>;

    /// `x`, rounded in the given direction.
    #[must_use]
    fn convert(x: f64, toward: Toward) -> Self;

    /// `self + other`.
    #[must_use]
    fn add(self, other: Self, toward: Toward) -> Self;

    /// `self * other`.
    #[must_use]
    fn mul(self, other: Self, toward: Toward) -> Self;

    /// `self / other` for `other >= 0`; infinite, with the sign of `self`, if only `other` is 0.
    #[must_use]
    fn div(self, other: Self, toward: Toward) -> Self;

    /// An interval that contains `√self`, for `self >= 0`.
    fn sqrt(self) -> Interval<Self>;

    /// An interval that contains `e^self`.
    fn exp(self) -> Interval<Self>;

    /// An interval that contains `ln self`, for `self >= 0`.
    fn ln(self) -> Interval<Self>;

    /// An interval that contains the entropies (bits) of the occupancies `p`, in `[0, 1]`.
    fn entropy(p: Interval<Self>) -> Interval<Self>;

    /// An interval that contains the entropies (bits) at the log-odds `l`.
    fn entropy_from_log_odds(l: Interval<Self>) -> Interval<Self>;
}

/// [`Endpoint`] for one format: `$split` is `2^ceil(precision / 2) + 1`; products in `$plain`, of factors up to its
/// upper end, neither overflow on the way nor have residuals below the smallest float.
macro_rules! impl_endpoint {
    ($float:ident, $split:literal, $plain:expr) => {
        const _: () = {
            /// The next float in the given direction.
            fn step(x: $float, toward: Toward) -> $float {
                match toward {
                    Toward::Down => x.next_down(),
                    Toward::Up => x.next_up(),
                }
            }

            /// `x`, a rounded result, or the next float if `x` may lie on the wrong side: `residual` is the exact
            /// result minus `x`, of which only the sign counts, or NaN where it is not known.
            #[inline]
            fn settle(x: $float, residual: $float, toward: Toward) -> $float {
                let right = match toward {
                    Toward::Down => residual >= 0.0,
                    Toward::Up => residual <= 0.0,
                };
                if right { x } else { step(x, toward) }
            }

            /// `a b - product` exactly, where `product` is `a b` rounded to nearest; NaN where that is not certain.
            #[inline]
            fn product_residual(a: $float, b: $float, product: $float) -> $float {
                let plain = $plain;
                if !(plain.contains(&product.abs()) && a.abs() <= *plain.end() && b.abs() <= *plain.end()) {
                    return $float::NAN;
                }
                let halves = |x: $float| {
                    let shifted = $split * x;
                    let high = shifted - (shifted - x);
                    (high, x - high)
                };
                let ((a1, a0), (b1, b0)) = (halves(a), halves(b));
                a0 * b0 - (((product - a1 * b1) - a0 * b1) - a1 * b0)
            }

            /// The best ends about an enclosure that is much narrower than floats are apart.
            fn outward(value: Interval<Wide>) -> Interval<$float> {
                Interval { lower: value.lower.to_real(Toward::Down), upper: value.upper.to_real(Toward::Up) }
            }

            impl Endpoint for $float {
                const ZERO: Self = 0.0;
                const HALF: Self = 0.5;
                const ONE: Self = 1.0;
                const INFINITY: Self = $float::INFINITY;
                const NEG_INFINITY: Self = $float::NEG_INFINITY;
                const LN_2: Interval<Self> = {
                    let nearest = core::$float::consts::LN_2;
                    Interval { lower: nearest.next_down(), upper: nearest.next_up() }
                };

                fn convert(x: f64, toward: Toward) -> Self {
                    let nearest = x as $float;
                    // A difference of two doubles has the sign of the exact one.
                    if f64::from(nearest) == x {
                        nearest
                    } else {
                        settle(nearest, (x - f64::from(nearest)).signum() as $float, toward)
                    }
                }

                #[inline]
                fn add(self, other: Self, toward: Toward) -> Self {
                    let sum = self + other;
                    if self.is_infinite() || other.is_infinite() {
                        return sum;
                    }
                    let part = sum - self;
                    settle(sum, (self - (sum - part)) + (other - part), toward)
                }

                #[inline]
                fn mul(self, other: Self, toward: Toward) -> Self {
                    if self == 0.0 || other == 0.0 {
                        return 0.0;
                    }
                    let product = self * other;
                    if self.is_infinite() || other.is_infinite() {
                        return product;
                    }
                    settle(product, product_residual(self, other, product), toward)
                }

                #[inline]
                fn div(self, other: Self, toward: Toward) -> Self {
                    if self == 0.0 || other.is_infinite() && self.is_finite() {
                        // A finite number over one without bound comes as near to 0 as one likes.
                        return 0.0;
                    }
                    if self.is_infinite() || other == 0.0 {
                        return $float::INFINITY.copysign(self);
                    }
                    let quotient = self / other;
                    // The first difference is exact (Sterbenz), and rounding the second keeps its sign.
                    let product = quotient * other;
                    let rest = (self - product) - product_residual(quotient, other, product);
                    settle(quotient, rest, toward)
                }

                fn sqrt(self) -> Interval<Self> {
                    if self == 0.0 || self.is_infinite() {
                        return Interval { lower: self.min($float::MAX), upper: self };
                    }
                    let root = elementary::sqrt(self);
                    let square = root * root;
                    let rest = (self - square) - product_residual(root, root, square);
                    Interval {
                        lower: settle(root, rest, Toward::Down),
                        upper: settle(root, rest, Toward::Up),
                    }
                }

                fn exp(self) -> Interval<Self> {
                    outward(Wide::from(self).exp())
                }

                fn ln(self) -> Interval<Self> {
                    outward(Wide::from(self).ln())
                }

                fn entropy(p: Interval<Self>) -> Interval<Self> {
                    outward(Wide::entropy(p.into()))
                }

                fn entropy_from_log_odds(l: Interval<Self>) -> Interval<Self> {
                    outward(Wide::entropy_from_log_odds(l.into()))
                }
            }
        };
    };
}

impl_endpoint!(f32, 4097.0, 1e-30..=1e34);
impl_endpoint!(f64, 134217729.0, 1e-280..=1e299);
