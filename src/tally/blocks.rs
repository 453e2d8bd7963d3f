//! Summation of occupancies by the vector kernels: whole blocks at once (theorem *blocks*, [`sums`](crate::book::sums)),
//! and the cells that a block leaves undecided.

use crate::real::Real;
use crate::rounded::lanes::{BLOCK, Block, Results};

/// The number of cells below which single cells are as fast as a block, and need no tables.
const FEW: usize = 16;

/// Calls `take` with the sums of each block and the cells that the block leaves undecided. Returns the cells after the
/// last block: fewer than [`FEW`].
pub(super) fn each<T: Real>(
    mut cells: &[T],
    sums: fn(&[T; BLOCK], &mut Results<T>) -> Block,
    mut take: impl FnMut(&Block, &mut dyn Iterator<Item = T>),
) -> &[T] {
    // Too few cells to set up 4 KB of results for.
    if cells.len() < FEW {
        return cells;
    }
    let mut results = [T::zero(); 2 * BLOCK];
    // A block holds few enough cells that neither of its two integer sums overflows: theorem (blocks), "Sums".
    while let Some((block, rest)) = cells.split_first_chunk() {
        let sums = sums(block, &mut results);
        take(&sums, &mut sums.open(block));
        cells = rest;
    }
    if cells.len() < FEW {
        return cells;
    }
    // The last block is padded with NaN, which no kernel counts: theorem (blocks), "Domain".
    let mut last = [T::nan(); BLOCK];
    last[..cells.len()].copy_from_slice(cells);
    let sums = sums(&last, &mut results);
    take(&sums, &mut sums.open(cells));
    &[]
}
