//! Occupancies by the vector kernels: whole blocks at once, and what these leave open.

use crate::real::Real;
use crate::rounded::lanes::{BLOCK, Block};

/// Hands each whole block of the cells to `take`, with the cells that its sums leave open; the cells after the last block.
pub(super) fn each<T: Real>(
    mut cells: &[T],
    sums: fn(&[T; BLOCK]) -> Block,
    mut take: impl FnMut(&Block, &mut dyn Iterator<Item = T>),
) -> &[T] {
    while let Some((block, rest)) = cells.split_first_chunk() {
        let sums = sums(block);
        let open = sums.closed.iter().zip(block).filter(|(closed, _)| **closed == 0);
        take(&sums, &mut open.map(|(_, &p)| p));
        cells = rest;
    }
    cells
}
