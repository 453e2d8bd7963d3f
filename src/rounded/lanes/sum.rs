//! The exact sum of the results of a block, in integers.
//!
//! The bounds are those of theorem (blocks) in the chapter [`sums`](crate::book::sums), *Sums*.

use super::format::{BLOCK, Lane};
use crate::real::Real;
use crate::rounded::beyond_float::Fixed;

/// Holds an exact sum in parts: of large results, of smaller ones, and of those that are smaller still, which only `f32` has:
/// results of blocks in `f64` are 0 or above `2^-86`.
pub(crate) type Parts = [Fixed; 3];

/// Returns how many binades below 1 hold the large results: all their bits are in two words of their format.
const fn binades<T: Lane>() -> i32 {
    T::PRECISION as i32 - 3
}

/// Sums the large results of a block, exactly; returns whether there are smaller ones, too.
#[inline(always)]
pub(super) fn large<T: Lane>(results: &[T; BLOCK]) -> (Parts, bool) {
    let (sum, smaller) = part(results.iter().copied(), binades::<T>());
    ([sum, Fixed::default(), Fixed::default()], smaller)
}

/// Adds the parts of the smaller results, exactly: in `f64` those from `2^-150` on, in `f32` all.
#[inline(always)]
pub(super) fn add_small<T: Lane>(parts: &mut Parts, results: &[T; BLOCK]) {
    let up = binades::<T>();
    let (sum, smaller) = scaled(results, up, binades::<f64>());
    parts[1] = sum;
    if smaller {
        parts[2] = scaled(results, up + binades::<f64>(), f64::MAX_EXP).0;
    }
}

/// Sums the results below `2^-up` as [`part`] does, in `f64` and times `2^up`.
#[inline(always)]
fn scaled<T: Lane>(results: &[T; BLOCK], up: i32, binades: i32) -> (Fixed, bool) {
    let scale = f64::from_parts(1, up);
    let scaled = results.iter().map(|result| {
        let x = result.widen() * scale;
        if x < 1.0 { x } else { 0.0 }
    });
    let (Fixed { value, exponent }, smaller) = part(scaled, binades);
    (Fixed { value, exponent: exponent - up }, smaller)
}

/// Sums the numbers from `2^-binades` on; returns whether there are smaller ones.
#[inline(always)]
fn part<T: Lane>(numbers: impl Iterator<Item = T>, binades: i32) -> (Fixed, bool) {
    let least = T::from_parts(1, -binades);
    let (mut sum, mut others) = (Sum::new(), T::Word::default());
    for x in numbers {
        let large = if x >= least { x } else { T::zero() };
        // Exactly `x` or 0.
        others = others | (x - large).bits();
        sum.add(large);
    }
    (sum.fixed(), others != T::Word::default())
}

/// Sums numbers in `[0, 1]` in integers: units of `2^(2 - PRECISION)`, and what is left, in as many bits below.
#[derive(Clone, Copy)]
struct Sum<T: Lane> {
    high: T::Word,
    low: T::Word,
}

impl<T: Lane> Sum<T> {
    /// Returns 3, whose ulp is `2^(2 - PRECISION)`, as it is up to 4.
    #[inline(always)]
    fn high_origin() -> T {
        T::one() + T::one() + T::one()
    }

    /// Returns 3/2 ulps of [`Sum::high_origin`]: its own ulp is as far below as that is below 1.
    #[inline(always)]
    fn low_origin() -> T {
        (Self::high_origin() + Self::high_origin()) * T::epsilon()
    }

    /// Creates an empty sum.
    fn new() -> Self {
        Self { high: T::Word::default(), low: T::Word::default() }
    }

    /// Adds a number in `[0, 1]`, exactly.
    #[inline(always)]
    fn add(&mut self, x: T) {
        // Sums: to a multiple of `2^(2 - PRECISION)`, the ulp of 3, which the bits then count.
        let high = x + Self::high_origin();
        // Sums: what `high` has lost, from the low origin on: every step is exact.
        let low = x - (high - (Self::high_origin() + Self::low_origin()));
        self.high = T::add_bits(self.high, high);
        self.low = T::add_bits(self.low, low);
    }

    /// Returns the sum as an integer times a power of two.
    fn fixed(self) -> Fixed {
        let high = i128::from(T::ulps(self.high, Self::high_origin(), BLOCK));
        let low = i128::from(T::ulps(self.low, Self::low_origin(), BLOCK));
        // Each of the two parts has units `2^-places` of the one above it.
        let places = T::PRECISION as i32 - 2;
        Fixed { value: ((high << places) + low) as u128, exponent: -2 * places }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tally::ExactSum;
    use proptest::prelude::*;

    /// Compares the sum of a block with that of its results one by one.
    fn check<T: Lane>(results: &[T; BLOCK]) {
        let mut one_by_one = ExactSum::new();
        for &x in results {
            one_by_one.add(x);
        }
        let (mut parts, some_are_small) = large(results);
        let least = T::from_parts(1, -binades::<T>());
        assert_eq!(some_are_small, results.iter().any(|&x| x > T::zero() && x < least));
        if some_are_small {
            add_small(&mut parts, results);
        }
        let mut sum = ExactSum::new();
        sum.add_parts::<T>(parts);
        assert_eq!(sum, one_by_one);
    }

    /// The exponents that the chapter names.
    #[test]
    fn the_parts_are_those_of_the_chapter() {
        assert_eq!((binades::<f32>(), binades::<f64>()), (21, 50));
    }

    /// The ends of each part: alone in a block, with each of the others, and in all of it.
    #[test]
    fn the_ends_of_the_parts() {
        let ends = [0, 20, 21, 22, 50, 51, 71, 72, 97, 99, 100, 101, 149].map(|k| f64::from_parts(1, -k));
        for x in ends.into_iter().flat_map(|x| [x, x.next_down()]).chain([0.0]) {
            check(&[x; BLOCK]);
            check(&core::array::from_fn(|k| if k == 77 { x } else { 0.75 }));
            check(&[x as f32; BLOCK]);
            for y in ends {
                check(&core::array::from_fn(|k| if k == 77 { x } else { y }));
                check(&core::array::from_fn(|k| if k == 77 { x as f32 } else { y as f32 }));
            }
        }
        for x in [1, 0x7f_ffff, 0x80_0000].map(f32::from_bits) {
            check(&[x; BLOCK]);
            check(&core::array::from_fn(|k| if k == 77 { x } else { 0.7 }));
        }
    }

    proptest! {
        /// Significands of all bits, of every size that the kernels have.
        #[test]
        fn sums_are_those_of_the_results_one_by_one(results in prop::collection::vec((1_u64 << 52..1 << 53, 0_i32..150), BLOCK)) {
            check::<f64>(&core::array::from_fn(|k| f64::from_parts(results[k].0, -53 - results[k].1)));
            check::<f32>(&core::array::from_fn(|k| f64::from_parts(results[k].0, -53 - results[k].1) as f32));
        }
    }
}
