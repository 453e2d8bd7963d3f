//! The ends `f32` and `f64`.
//!
//! The processor's result is rounded to nearest, and the sign of its exact residual (Knuth's TwoSum, Dekker's product)
//! tells on which side of the exact result it lies ([`integration`](crate::book::integration), "Intervals"). No rounding
//! mode is switched, and no fused operation is assumed. The elementary functions are those of [`Wide`].

use super::endpoint::{Endpoint, Toward, sealed::Sealed};
use super::ends::Interval;
use super::wide::Wide;
use crate::elementary;

impl Sealed for f32 {}
impl Sealed for f64 {}

/// Implements [`Endpoint`] for one format. `$split` is `2^ceil(precision / 2) + 1`; products in `$plain`, of factors up to
/// its upper end, neither overflow on the way nor have residuals below the smallest float.
macro_rules! impl_endpoint {
    ($float:ident, $split:literal, $plain:expr) => {
        const _: () = {
            /// Returns the next float in the given direction.
            fn step(x: $float, toward: Toward) -> $float {
                match toward {
                    Toward::Down => x.next_down(),
                    Toward::Up => x.next_up(),
                }
            }

            /// Returns `x`, a result rounded to nearest, or the next float if `x` may lie on the wrong side of the exact one.
            /// Only the sign of `residual`, the exact result minus `x`, matters; it is NaN if it is not known.
            #[inline]
            fn directed(x: $float, residual: $float, toward: Toward) -> $float {
                let right = match toward {
                    Toward::Down => residual >= 0.0,
                    Toward::Up => residual <= 0.0,
                };
                if right { x } else { step(x, toward) }
            }

            /// Computes `a b - product` exactly, where `product` is `a b` rounded to nearest; NaN where that is not certain.
            #[inline]
            fn product_residual(a: $float, b: $float, product: $float) -> $float {
                let plain = $plain;
                // Where the residual could overflow or fall below the smallest float, the next float is taken in any case.
                if !(plain.contains(&product.abs()) && a.abs() <= *plain.end() && b.abs() <= *plain.end()) {
                    return $float::NAN;
                }
                // Dekker's product: halves of the significand have exact products.
                let halves = |x: $float| {
                    // Veltkamp's split: the upper half of the significand, and what is left.
                    let shifted = $split * x;
                    let high = shifted - (shifted - x);
                    (high, x - high)
                };
                let ((a1, a0), (b1, b0)) = (halves(a), halves(b));
                a0 * b0 - (((product - a1 * b1) - a0 * b1) - a1 * b0)
            }

            /// Rounds the ends of an enclosure outwards; it is much narrower than the spacing of floats.
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
                    // Rounded to nearest: the sign of the difference tells whether that is the wrong side.
                    let nearest = x as $float;
                    // A difference of two doubles has the sign of the exact one.
                    if f64::from(nearest) == x {
                        nearest
                    } else {
                        directed(nearest, (x - f64::from(nearest)).signum() as $float, toward)
                    }
                }

                #[inline]
                fn add(self, other: Self, toward: Toward) -> Self {
                    let sum = self + other;
                    if self.is_infinite() || other.is_infinite() {
                        return sum;
                    }
                    // Knuth's TwoSum: the residual of a sum is a float, exactly.
                    let part = sum - self;
                    directed(sum, (self - (sum - part)) + (other - part), toward)
                }

                #[inline]
                fn mul(self, other: Self, toward: Toward) -> Self {
                    // 0 inf = 0: an infinite end stands for finite numbers without bound.
                    if self == 0.0 || other == 0.0 {
                        return 0.0;
                    }
                    let product = self * other;
                    if self.is_infinite() || other.is_infinite() {
                        return product;
                    }
                    directed(product, product_residual(self, other, product), toward)
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
                    directed(quotient, rest, toward)
                }

                fn sqrt(self) -> Interval<Self> {
                    if self == 0.0 || self.is_infinite() {
                        return Interval { lower: self.min($float::MAX), upper: self };
                    }
                    let root = elementary::sqrt(self);
                    // As for the quotient, with root * root for the product.
                    let square = root * root;
                    let rest = (self - square) - product_residual(root, root, square);
                    Interval {
                        // The two floats about the root, or the root itself if its square is exact.
                        lower: directed(root, rest, Toward::Down),
                        upper: directed(root, rest, Toward::Up),
                    }
                }

                // The functions are those of 128 bits: integration.md, lemma (128 bits).
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
