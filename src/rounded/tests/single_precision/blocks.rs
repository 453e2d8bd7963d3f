//! Cells summed up many at once, against the same cells one by one.

use crate::cell::Cell;
use crate::{InformationSum, Real, Tally};

/// Whether the cells of these bits have the same sums either way.
pub(crate) fn agree(bits: impl Iterator<Item = u32>) -> bool {
    agree_on(&bits.map(f32::from_bits).collect::<Vec<f32>>())
}

/// Whether these cells have the same sums either way.
pub(crate) fn agree_on<T: Real>(cells: &[T]) -> bool {
    let one_by_one: Tally<T> = cells.iter().flat_map(|&p| Cell::from_occupancy(p)).collect();
    Tally::from_occupancies(cells) == one_by_one
        && InformationSum::from_occupancies(cells) == InformationSum::from(&one_by_one)
}
