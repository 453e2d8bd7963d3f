//! Correct rounding of entropy, information and occupancy, of `e^x`, `ln x` and the Gaussian, by Ziv's strategy, in
//! integers.
//!
//! 1. [`approximate`] computes an enclosure of the value in 128-bit fixed point, by the kernels of [`fixed`], with a
//!    proved bound on its error.
//! 2. [`FixedEnclosure::round`] rounds it, if the whole enclosure rounds to one float ([`round`]).
//! 3. If not, the enclosure holds one midpoint between two floats, and [`compare`] decides on which side of it the value
//!    lies, in [`integers`] of 256 bits, then 512, and so on.
//!
//! Integers because they are exact where floating point rounds, the same on every platform, and easy to prove: every
//! error is a discarded fraction. The proof is the chapter [`rounding`](crate::book::rounding); `proofs/` has it
//! machine-checked.
//!
//! A file uses only those above it:
//!
//! | file | holds |
//! |---|---|
//! | `constants` | the constants of the kernels, generated |
//! | `fixed` | the kernels: `log2`, `2^-x`, the series of the information, the reciprocal |
//! | `root` | the square root of an integer |
//! | `round` | enclosures and integers rounded to the nearest float (step 2) |
//! | `integers` | limbs, natural numbers, balls |
//! | `ziv` | the three steps joined, and how arguments are taken apart |
//! | `approximate` | the enclosures (step 1) |
//! | `compare` | the comparisons with a midpoint (step 3) |
//! | `short_gaussian` | the enclosure of the Gaussian in 64 bits |
//! | `cell`, `elementary`, `log_odds`, `gaussian`, `distance`, `fusion` | the functions that the crate calls |
//! | `beyond_float`, `wide_elementary` | step 1 at arguments of 63 and of 128 bits |
//! | `angle` | cosine and sine of an angle in turns |
//! | `lanes` | entropy and information of many cells at once |

mod angle;
mod approximate;
pub(crate) mod beyond_float;
mod cell;
mod compare;
#[rustfmt::skip] // as `proofs/constants.sollya` writes it
mod constants;
mod distance;
mod elementary;
mod fixed;
mod fusion;
mod gaussian;
mod integers;
#[cfg(feature = "std")]
pub(crate) mod lanes;
mod log_odds;
mod root;
mod round;
mod short_gaussian;
pub(crate) mod wide_elementary;
mod ziv;

pub(crate) use angle::{cos_sin, short_cos_sin, short_turns, turns};
pub(crate) use cell::{CellEnclosures, occupancy_from_log_odds};
pub(crate) use distance::{Coordinate, distance, distance_by_square, multiple};
pub(crate) use elementary::{exp, ln};
pub(crate) use fixed::{horner, mul_high, reciprocal, shift_right};
pub(crate) use fusion::fused;
pub(crate) use gaussian::gaussian;
pub(crate) use integers::limbs;
pub(crate) use integers::natural_number::{Leading, NaturalNumber, leading, round_quotient};
pub(crate) use log_odds::{
    LOG_ODDS_SCALE, fixed_log_odds, log_odds_from_occupancy, occupancy_from_fixed_log_odds, round_log_odds,
};
pub(crate) use root::square_root;
pub(crate) use round::{FixedEnclosure, round_integer, round_limbs};
pub(crate) use ziv::{normalised, odd_parts};

#[cfg(test)]
pub(crate) mod oracle;
#[cfg(test)]
mod tests;
