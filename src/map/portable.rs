//! Histograms as text, so that they can travel between machines and be merged there (feature `serde`).
//!
//! The form is a list of the 256 counts, indexed by the values' bits, as NumPy's
//! `bincount(cells.view(uint8), minlength=256)` returns it.

use super::histogram::Histogram;
use alloc::vec::Vec;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

impl Serialize for Histogram {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.counts())
    }
}

impl<'de> Deserialize<'de> for Histogram {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let counts = Vec::<u64>::deserialize(deserializer)?;
        let counts = <[u64; 256]>::try_from(counts).map_err(|counts| {
            D::Error::custom(format_args!("a histogram is a list of 256 counts, not of {}", counts.len()))
        })?;
        Self::from_counts(&counts).map_err(D::Error::custom)
    }
}
