//! The formats of the kernel's lanes: what differs between `f32` and `f64`, and the operations on their bits.

use crate::real::Real;
use core::ops::BitOr;

/// Counts the cells that are summed up at once: so few that no sum of bits overflows.
pub(crate) const BLOCK: usize = 256;
/// The number of cells below which single cells are as fast as a block, and need no tables.
pub(crate) const FEW: usize = 16;
/// The significand bits by which a distance finds its centre: each binade has `2^CELL_BITS` centres.
pub(super) const CELL_BITS: u32 = 7;
/// The centres of one half of the table, a power of two so that an index is a mask.
pub(super) const HALF: usize = 4096;
/// Bounds the tables: smaller distances have no centre.
pub(super) const LEAST: f32 = f32::from_bits((127 - BINADES as u32) << 23); // 2^-32
/// The binades of distances that have centres.
const BINADES: i32 = 32;

/// Names a format of floats and the integer of its bits: one lane of a vector.
pub(crate) trait Lane: Real {
    /// Holds the bits of a float.
    type Word: Copy
        + Default
        + PartialEq
        + BitOr<Output = Self::Word>
        + core::fmt::Debug
        + Send
        + Sync
        + 'static;
    /// Stands for a result that is not decided; results are in `[0, 1]`.
    const OPEN: Self;

    /// Returns the centre of the table's cell in which `x` in `[LEAST, 1/2]` lies, and the cell's number in its
    /// half. Returns any pair, the number below [`HALF`], for other `x`.
    fn centre(x: Self) -> (Self, u32);

    /// Returns the centre of the cell of a number; `None` beyond the last.
    fn centre_of(number: usize) -> Option<Self>;

    /// Computes `a b + c`, rounded once.
    fn fused(a: Self, b: Self, c: Self) -> Self;

    /// Returns the bits of a float.
    fn bits(self) -> Self::Word;

    /// Adds the bits of a float to a sum of bits.
    fn add_bits(sum: Self::Word, x: Self) -> Self::Word;

    /// Returns the sum of the `k` from a sum of the bits of `count` floats `origin + k ulp`.
    fn ulps(sum: Self::Word, origin: Self, count: usize) -> i64;
}

macro_rules! impl_lane {
    ($float:ident, $word:ident, $signed:ident) => {
        impl Lane for $float {
            type Word = $word;
            const OPEN: Self = -1.0;

            #[inline(always)]
            fn centre(x: Self) -> (Self, u32) {
                // Series: the bits of a binade's cell are the leading ones of the significand.
                const BELOW: u32 = $float::PRECISION - 1 - CELL_BITS;
                const FIRST: $word = (($float::MAX_EXP - 1 - BINADES) as $word) << CELL_BITS;
                // Exponent and cell together count the cells from the first binade on.
                let cell = x.to_bits() >> BELOW;
                // The half of a cell is one bit more: 9 bits, so that `x - c` is exact.
                let centre = Self::from_bits(x.to_bits() & !((1 << BELOW) - 1) | 1 << (BELOW - 1));
                (centre, cell.wrapping_sub(FIRST) as u32 & (HALF as u32 - 1))
            }

            fn centre_of(number: usize) -> Option<Self> {
                let binade = $float::from_parts(1, (number >> CELL_BITS) as i32 - BINADES);
                let x =
                    binade + (number % (1 << CELL_BITS)) as $float * (binade / (1 << CELL_BITS) as $float);
                (x <= 0.5).then(|| Self::centre(x).0)
            }

            #[inline(always)]
            fn fused(a: Self, b: Self, c: Self) -> Self {
                a.mul_add(b, c)
            }

            #[inline(always)]
            fn bits(self) -> $word {
                self.to_bits()
            }

            #[inline(always)]
            fn add_bits(sum: $word, x: Self) -> $word {
                // Sums: within one binade bits are multiples of the ulp, and wrapping loses nothing.
                sum.wrapping_add(x.to_bits())
            }

            fn ulps(sum: $word, origin: Self, count: usize) -> i64 {
                i64::from(sum.wrapping_sub(origin.to_bits().wrapping_mul(count as $word)) as $signed)
            }
        }
    };
}

impl_lane!(f32, u32, i32);
impl_lane!(f64, u64, i64);

/// Splits a float in two: what only lanes of `f64` need, since there is no wider float.
pub(super) trait Split: Sized {
    /// Packs two floats of few bits into one word: the slope's rest into the last bits of the value's.
    fn pack(value: Self, slope: Self) -> u64;

    /// Returns the floats of [`Split::pack`], the first with the second's bits as noise in its last ones.
    fn unpack(word: u64) -> (Self, Self);

    /// Cuts the float to 9 bits, towards zero.
    fn head(self) -> Self;
}

/// The bits of a word that hold the slope's rest.
const SLOPE: u32 = 24;

impl Split for f64 {
    fn pack(value: Self, slope: Self) -> u64 {
        const LOW: u64 = (1 << SLOPE) - 1;
        const DOWN: u32 = u64::BITS - SLOPE;
        // Error, slope: to the nearest of 13 bits.
        let slope = (slope.to_bits() >> (DOWN - 1)).div_ceil(2);
        // Error, value: to 29 bits. Of the words with these last bits, the nearest.
        let below = value.to_bits() & !LOW | slope;
        let beside = [below, below.wrapping_sub(LOW + 1), below.wrapping_add(LOW + 1)];
        let distance = |word: &u64| (Self::from_bits(*word) - value).abs();
        beside.into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(below)
    }

    #[inline(always)]
    fn unpack(word: u64) -> (Self, Self) {
        const UP: u32 = u64::BITS - SLOPE;
        (Self::from_bits(word), Self::from_bits(word << UP))
    }

    #[inline(always)]
    fn head(self) -> Self {
        // Error, slope: 9 bits, since `x - c` has the others.
        const BELOW: u32 = f64::MANTISSA_DIGITS - 9;
        Self::from_bits(self.to_bits() & !((1 << BELOW) - 1))
    }
}
