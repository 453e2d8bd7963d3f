//! Cells summed up many at once, against the same cells one by one.

use mean_information::cell::Cell;
use mean_information::{Information, Tally};

/// Whether the cells of these bits have the same sums either way.
pub(crate) fn agree(bits: impl Iterator<Item = u32>) -> bool {
    let cells: Vec<f32> = bits.map(f32::from_bits).collect();
    let one_by_one: Tally<f32> = cells.iter().flat_map(|&p| Cell::from_occupancy(p)).collect();
    Tally::from_occupancies(&cells) == one_by_one
        && Information::from_occupancies(&cells) == Information::from(&one_by_one)
}
