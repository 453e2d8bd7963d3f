//! Cells by their stored value, so that the entropy of a value that occurs again is not computed again.

use mean_information::cell::Cell;
use mean_information::map::Encoding;

/// Values remembered at a time: all that an 8-bit image can hold, with little overlap.
const SLOTS: u32 = 12;

/// The last cell of each slot; a value has one slot.
pub(crate) struct CellCache<E: Encoding>(Vec<Option<(u64, Cell<E::Float>)>>);

impl<E: Encoding> CellCache<E> {
    /// Creates an empty cache.
    pub(crate) fn new() -> Self {
        Self(vec![None; 1 << SLOTS])
    }

    /// Returns [`Encoding::cell`] of a stored value.
    pub(crate) fn cell(&mut self, stored: E::Stored) -> Option<Cell<E::Float>> {
        let value = E::value(stored).to_bits();
        // Fibonacci hashing: the high bits of a product with 2^64 over the golden ratio.
        let slot = &mut self.0[(value.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - SLOTS)) as usize];
        match slot {
            Some((known, cell)) if *known == value => Some(*cell),
            _ => {
                let cell = E::cell(stored)?;
                *slot = Some((value, cell));
                Some(cell)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mean_information::map::encoding::{LogOdds, MrptLogOdds, Probability};

    /// More values than slots, each several times: every cell is its own.
    #[test]
    fn a_remembered_cell_is_the_cell() {
        let mut cache = CellCache::<LogOdds<f64>>::new();
        for k in (0..10_000).chain(0..10_000).rev() {
            let l = f64::from(k % 7001) / 256.0 - 13.5;
            assert_eq!(cache.cell(l), LogOdds::cell(l), "{l}");
            assert_eq!(cache.cell(l), LogOdds::cell(l), "{l}");
        }
        assert_eq!(cache.cell(f64::NAN), None);
        let mut cache = CellCache::<Probability<f32>>::new();
        for p in [0.0, -0.0, 1.0, 0.5, f32::MIN_POSITIVE] {
            assert_eq!(cache.cell(p), Probability::cell(p), "{p}");
        }
        let mut cache = CellCache::<MrptLogOdds>::new();
        assert!((i8::MIN..=i8::MAX).all(|byte| cache.cell(byte) == MrptLogOdds::cell(byte)));
    }
}
