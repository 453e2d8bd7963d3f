//! What the integration tests share: strategies for cells.

use mean_information::Real;
use mean_information::cell::Cell;
use proptest::prelude::*;

/// `2^exponent`, exactly.
pub(crate) fn power(exponent: i32) -> f64 {
    f64::from_parts(1, exponent)
}

/// Occupancies from everywhere it matters: both ends, subnormals, about one half, and in between.
pub(crate) fn occupancy() -> impl Strategy<Value = f64> {
    prop_oneof![
        0.0..=1.0,
        (0_u64..=1.0_f64.to_bits()).prop_map(f64::from_bits),
        (1_i32..=53, any::<bool>()).prop_map(|(k, up)| if up { 0.5 + power(-k) } else { 0.5 - power(-k) }),
        (1_i32..=53).prop_map(|k| 1.0 - power(-k)),
        prop::sample::select(vec![0.0, 0.5, 1.0, f64::from_bits(1), f64::MIN_POSITIVE]),
    ]
}

/// Occupancies whose complement `1 - p` is a float: multiples of `2^-53`.
pub(crate) fn mirrorable() -> impl Strategy<Value = f64> {
    (0_u64..=1 << 53).prop_map(|k| k as f64 / (1_u64 << 53) as f64)
}

/// The cell of an occupancy that is known to be in `[0, 1]`.
pub(crate) fn cell(p: f64) -> Cell<f64> {
    Cell::from_occupancy(p).expect("an occupancy in [0, 1]")
}

/// Xorshift, for runs of a length that the caller chooses.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// A number in `[0, 1)`.
    pub(crate) fn uniform(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 * power(-53)
    }
}
