//! Occupancies by the vector kernels: whole blocks at once, and what these leave open.

use crate::real::Real;
use crate::rounded::lanes::{BLOCK, Block};

/// Fewer cells than these are as quickly done one by one, without the kernels' tables.
const FEW: usize = 16;

/// Hands the sums of each block of the cells to `take`, with the cells that they leave open; the few cells after
/// the last.
pub(super) fn each<T: Real>(
    mut cells: &[T],
    sums: fn(&[T; BLOCK]) -> Block,
    mut take: impl FnMut(&Block, &mut dyn Iterator<Item = T>),
) -> &[T] {
    while let Some((block, rest)) = cells.split_first_chunk() {
        let sums = sums(block);
        take(&sums, &mut sums.open(block));
        cells = rest;
    }
    if cells.len() < FEW {
        return cells;
    }
    // The last block is filled up with what no kernel counts.
    let mut last = [T::nan(); BLOCK];
    last[..cells.len()].copy_from_slice(cells);
    let sums = sums(&last);
    take(&sums, &mut sums.open(cells));
    &[]
}
