//! The scalar types of this crate: [`Real`], sealed over `f32` and `f64`.
//!
//! A `Real` can be taken apart into an integer times a power of two and put together again, without rounding.
//! Everything else in the crate that must be the same on every platform is built from these two steps and
//! integer arithmetic, so no elementary function of the standard library is called anywhere.

use core::fmt::{Debug, Display, LowerExp};
use num_traits::float::FloatCore;

mod sealed {
    /// An array of floats of either format.
    #[derive(Clone, Copy, Debug)]
    pub enum Floats<'a, const N: usize> {
        /// Floats of 32 bits.
        Single(&'a [f32; N]),
        /// Floats of 64 bits.
        Double(&'a [f64; N]),
    }

    /// Arguments and the places of their results, in either format.
    #[derive(Debug)]
    pub enum Pair<'a, const N: usize, const M: usize> {
        /// Floats of 32 bits.
        Single(&'a [f32; N], &'a mut [f32; M]),
        /// Floats of 64 bits.
        Double(&'a [f64; N], &'a mut [f64; M]),
    }

    /// The seal: only this crate implements it.
    pub trait Sealed: Sized {
        /// Returns the same floats with their format as a value, for code that is not generic.
        fn floats<const N: usize>(floats: &[Self; N]) -> Floats<'_, N>;

        /// Returns the same arguments and places, with their format as a value.
        fn pair<'a, const N: usize, const M: usize>(
            arguments: &'a [Self; N],
            results: &'a mut [Self; M],
        ) -> Pair<'a, N, M>;
    }

    impl Sealed for f32 {
        fn floats<const N: usize>(floats: &[Self; N]) -> Floats<'_, N> {
            Floats::Single(floats)
        }

        fn pair<'a, const N: usize, const M: usize>(
            arguments: &'a [Self; N],
            results: &'a mut [Self; M],
        ) -> Pair<'a, N, M> {
            Pair::Single(arguments, results)
        }
    }

    impl Sealed for f64 {
        fn floats<const N: usize>(floats: &[Self; N]) -> Floats<'_, N> {
            Floats::Double(floats)
        }

        fn pair<'a, const N: usize, const M: usize>(
            arguments: &'a [Self; N],
            results: &'a mut [Self; M],
        ) -> Pair<'a, N, M> {
            Pair::Double(arguments, results)
        }
    }
}
#[cfg(feature = "std")]
pub(crate) use sealed::{Floats, Pair};

/// A binary floating-point type of IEEE 754: `f32` or `f64`.
///
/// Sealed: every bound in this crate is proved for these two formats.
///
/// ```
/// use mean_information::Real;
/// assert_eq!(f64::PRECISION, 53);
/// assert_eq!(0.75_f32.parts(), (0xc0_0000, -24));
/// assert_eq!(f32::from_parts(0xc0_0000, -24), 0.75);
/// ```
pub trait Real:
    sealed::Sealed + FloatCore + Debug + Display + LowerExp + Default + Send + Sync + 'static
{
    /// The number of significant bits, the leading one included: 24 or 53.
    const PRECISION: u32;
    /// The exponent of the smallest positive number: `2^-149` or `2^-1074`.
    const MIN_EXPONENT: i32;
    /// The name of the format, as the port protocol spells it.
    const FORMAT: &'static str;
    /// The number one half: the occupancy of an unknown cell.
    const HALF: Self;

    /// Returns the significand `m` and exponent `e` of the magnitude `|x| = m * 2^e` of a finite number, exactly.
    ///
    /// Zero gives `m = 0`. The pair of an infinity or a NaN means nothing.
    fn parts(self) -> (u64, i32);

    /// Returns the number `m * 2^e`, exactly if it is representable.
    ///
    /// Special cases: of another number the digits below the last one are cut off, which gives 0 below the smallest
    /// positive number; a product above the largest finite number gives infinity.
    fn from_parts(m: u64, e: i32) -> Self;

    /// Converts to `f64`, exactly.
    fn widen(self) -> f64;

    /// Rounds an `f64` to the nearest `Self`, ties to even; the same value where it is representable.
    fn nearest(x: f64) -> Self;
}

/// Implements [`Real`] for one format: `$bits` is its integer, `$stored` its stored significand bits.
macro_rules! impl_real {
    ($float:ident, $bits:ident, $stored:literal, $bias:literal, $format:literal) => {
        impl Real for $float {
            const PRECISION: u32 = $stored + 1;
            const MIN_EXPONENT: i32 = 1 - $bias - $stored;
            const FORMAT: &'static str = $format;
            const HALF: Self = 0.5;

            #[inline]
            fn parts(self) -> (u64, i32) {
                let bits = self.to_bits();
                let fraction = u64::from(bits & ((1 << $stored) - 1));
                let biased = ((bits >> $stored) & (2 * $bias + 1)) as i32;
                // Subnormal numbers have the exponent of the smallest normal ones, and no implicit bit.
                if biased == 0 {
                    (fraction, Self::MIN_EXPONENT)
                } else {
                    (fraction | (1 << $stored), biased - 1 + Self::MIN_EXPONENT)
                }
            }

            #[inline]
            fn from_parts(m: u64, e: i32) -> Self {
                if m == 0 {
                    return 0.0;
                }
                // Bring the leading one to the place of the implicit bit, or as near as a subnormal allows.
                let shift =
                    (m.leading_zeros() as i32 + $stored - 63).min(e.saturating_sub(Self::MIN_EXPONENT));
                // Below the smallest number all bits may leave; above the largest, the exponent may.
                let m =
                    if shift >= 0 { m << shift } else { m.checked_shr(shift.unsigned_abs()).unwrap_or(0) };
                let e = e.saturating_sub(shift);
                let biased = if m >> $stored == 0 {
                    0
                } else {
                    e.saturating_sub(Self::MIN_EXPONENT).saturating_add(1)
                };
                if biased > 2 * $bias {
                    return Self::INFINITY;
                }
                Self::from_bits((biased as $bits) << $stored | (m as $bits & ((1 << $stored) - 1)))
            }

            #[inline]
            fn widen(self) -> f64 {
                f64::from(self)
            }

            #[inline]
            fn nearest(x: f64) -> Self {
                x as $float
            }
        }
    };
}

impl_real!(f32, u32, 23, 127, "f32");
impl_real!(f64, u64, 52, 1023, "f64");

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn parts_and_back_keep_every_bit_f64(x in any::<f64>().prop_filter("finite", |x| x.is_finite())) {
            let (m, e) = x.parts();
            prop_assert_eq!(f64::from_parts(m, e).to_bits(), x.abs().to_bits());
        }

        #[test]
        fn parts_and_back_keep_every_bit_f32(x in any::<f32>().prop_filter("finite", |x| x.is_finite())) {
            let (m, e) = x.parts();
            prop_assert_eq!(f32::from_parts(m, e).to_bits(), x.abs().to_bits());
            prop_assert_eq!(x.widen() as f32, x);
        }
    }

    #[test]
    fn the_edges_of_both_formats() {
        assert_eq!(f64::from_parts(1, -1074), f64::from_bits(1));
        assert_eq!(f32::from_parts(1, -149), f32::from_bits(1));
        assert_eq!(f64::from_parts(3, 1023).to_bits(), f64::INFINITY.to_bits());
        assert_eq!(f64::from_parts(1, i32::MAX).to_bits(), f64::INFINITY.to_bits());
        assert_eq!(f64::from_parts(1 << 60, -60), 1.0);
        assert_eq!(f64::from_parts(u64::MAX, i32::MAX), f64::INFINITY);
        for (m, e) in [(1 << 62, -1200), (u64::MAX, -1138), (3, -1076), (u64::MAX, i32::MIN), (1, i32::MIN)] {
            assert_eq!((f64::from_parts(m, e).to_bits(), f32::from_parts(m, e).to_bits()), (0, 0), "{m} {e}");
        }
        assert_eq!(
            (f64::from_parts(u64::MAX, -1137), f32::from_parts(7, -151)),
            (f64::from_bits(1), f32::from_bits(1))
        );
        assert_eq!(f64::MAX.parts(), ((1 << 53) - 1, 971));
        assert_eq!(f64::from_parts((1 << 53) - 1, 971), f64::MAX);
    }
}
