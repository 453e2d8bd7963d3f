//! The sums behind every measure of a map: Eq. 2, the entropy `H(m) = sum H`, Eq. 3, the information
//! `I(m) = sum I`, and Eq. 4, the mean information `I(m) / N_obs`.
//!
//! The sums are exact ([`ExactSum`]), so a [`Tally`] does not depend on the order of the cells, nor on how they
//! were split and merged.

#[cfg(feature = "std")]
mod apart;
#[cfg(feature = "std")]
mod blocks;
mod bytes;
mod checked;
mod collection;
mod exact_sum;
mod information_sum;
mod map_tally;
#[cfg(feature = "serde")]
mod portable;
mod removal;

pub use crate::error::TallyFault;
pub use bytes::{TALLY_BYTES, format_of_bytes};
pub use exact_sum::ExactSum;
pub use information_sum::InformationSum;
pub use map_tally::Tally;
