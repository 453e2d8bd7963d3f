//! The block jackknife: how far the difference of two trajectories' mean information would move with other scans,
//! `se² = (K - 1) / K Σ (θ₋ₖ - θ̄)²`.

use crate::elementary::sqrt;
use crate::error::Error;
use crate::real::Real;
use crate::rounded::{NaturalNumber, round_quotient};
use crate::tally::Tally;
use core::ops::Range;

/// Units of a difference: `2^-63` bits.
const SCALE: i32 = 63;

/// The difference of the mean information (Eq. 4) of two maps that were made of the same scans, in bits per observed cell, with its
/// block jackknife standard error (Künsch 1989; the chapter [`evidence`](crate::book::evidence) says why blocks, and how far to
/// trust it).
///
/// ```
/// use mean_information::{Tally, scan::Difference};
/// let map = |p: f64| Tally::from_occupancies(&[p, 0.25, 0.5, 0.875]);
/// let whole = [&map(0.75), &map(0.125)];
/// let without = [[map(0.625), map(0.125)], [map(0.75), map(0.25)], [map(0.875), map(0.125)]];
/// let difference = Difference::by_jackknife(whole, &without)?;
/// assert_eq!((difference.value(), difference.blocks()), (0.08923789375317881, 3));
/// assert_eq!(difference.standard_error(), 0.09130434660563747);
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    value: f64,
    standard_error: f64,
    blocks: usize,
}

impl Difference {
    /// Compares the second map with the first: from the tallies of both with all scans, and with all but one block of scans, for
    /// each block ([`TalliedMap::without`](super::TalliedMap::without), [`blocks`]).
    ///
    /// With `θ` the difference and `θ₋ₖ` that without block `k` of `K`, `se = √((K - 1) / K Σ (θ₋ₖ - θ̄)²)`. The value is within
    /// `2^-52` bits of the exact difference. The standard error is within 1 ulp of that of the mean information rounded to `f64`,
    /// which is within `√(K - 1) 2^-52` bits of the exact one (both proved, [`evidence`](crate::book::evidence)). No order of the
    /// blocks changes a bit.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if there are fewer than 2 blocks.
    pub fn by_jackknife<T: Real>(whole: [&Tally<T>; 2], without: &[[Tally<T>; 2]]) -> Result<Self, Error> {
        let blocks = without.len();
        if blocks < 2 {
            return Err(Error::out_of_range("number of blocks", blocks as f64, "2 or more"));
        }
        let [first, second] = whole.map(Tally::mean_information_as::<f64>);
        let difference = |pair: &[Tally<T>; 2]| {
            // At most 1; below 2^-10 cut to the units.
            let [first, second] = [&pair[0], &pair[1]].map(|tally| units(tally.mean_information_as()));
            second - first
        };
        let sum: i128 = without.iter().map(difference).sum();
        // K (θ₋ₖ - θ̄), below 2^64 K: exact, and so are the squares and their sum.
        let squares = without.iter().map(|pair| {
            let from_mean =
                NaturalNumber::from([(blocks as i128 * difference(pair) - sum).unsigned_abs(), 0]);
            from_mean.times(&from_mean)
        });
        let squares = squares.fold(NaturalNumber::default(), |sum, square| sum.plus(&square));
        // Rounded here, and in the root.
        let [more, count] = [blocks - 1, blocks].map(|n| NaturalNumber::from(n as u64));
        let variance: f64 =
            round_quotient(&squares.times(&more), &count.times(&count).times(&count), -2 * SCALE);
        Ok(Self { value: second - first, standard_error: sqrt(variance), blocks })
    }

    /// Returns the mean information of the second map less that of the first, in bits per observed cell, within `2^-52` bits of
    /// the exact difference of the sums.
    pub fn value(&self) -> f64 {
        self.value
    }

    /// Returns the standard error of the difference, in bits per observed cell; its bound is that of [`Self::by_jackknife`].
    pub fn standard_error(&self) -> f64 {
        self.standard_error
    }

    /// Returns the number of blocks.
    pub fn blocks(&self) -> usize {
        self.blocks
    }
}

/// Splits `scans` scans into `count` blocks of consecutive ones, their sizes differing by at most one; as many blocks as
/// scans if there are fewer.
///
/// ```
/// use mean_information::scan::blocks;
/// assert_eq!(blocks(7, 3).collect::<Vec<_>>(), [0..2, 2..4, 4..7]);
/// ```
pub fn blocks(scans: usize, count: usize) -> impl ExactSizeIterator<Item = Range<usize>> {
    let count = count.min(scans);
    let start = move |block: usize| (scans as u128 * block as u128 / count as u128) as usize;
    (0..count).map(move |block| start(block)..start(block + 1))
}

/// Returns a number in `[0, 1]` in units of `2^-63`, cut.
fn units(x: f64) -> i128 {
    let (m, e) = x.parts();
    let shift = e + SCALE;
    if shift >= 0 {
        i128::from(m) << shift
    } else {
        i128::from(m.checked_shr(shift.unsigned_abs()).unwrap_or(0))
    }
}
