//! Summation of occupancies by the vector kernels: whole blocks at once (theorem *blocks*, [`sums`](crate::book::sums)),
//! and the cells that a block leaves undecided.

use crate::real::Real;
use crate::rounded::lanes::{self, BLOCK, Block, FEW, Results};

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
    let Some(last) = lanes::padded(cells) else {
        return cells;
    };
    let sums = sums(&last, &mut results);
    take(&sums, &mut sums.open(cells));
    &[]
}
