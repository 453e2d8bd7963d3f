//! The kernel of single results: entropy or information of each cell of a block, stored instead of summed.
//!
//! Value and rounding test are those of the sums, theorem (blocks) in the chapter [`sums`](crate::book::sums).

use super::format::{BLOCK, Lane};
use super::kernel::{bounds, complements, distance, value};
use super::table::Table;

/// Stores the entropies of the cells, or their information: the nearest floats, NaN where a cell is no probability, and
/// [`Lane::OPEN`] where the rounding is not decided.
#[inline(always)]
pub(super) fn of_occupancies<T: Lane, const FUSED: bool, const ENTROPY: bool>(
    table: &Table<T>,
    cells: &[T; BLOCK],
    results: &mut [T; BLOCK],
) {
    let rows = table.rows::<ENTROPY>();
    let (zero, one) = (T::zero(), T::one());
    let least = T::from_parts(1, -T::BINADES);
    for (&p, result) in cells.iter().zip(results) {
        let (x, near) = distance(p);
        // Not 0 itself: subnormal numbers are slow.
        let inside = if x > least { x } else { least };
        let (head, tail) = value::<T, FUSED, ENTROPY>(&rows, inside, near);
        let (below, above) = bounds::<T, FUSED>(head, tail);
        let (other, other_above) = complements(head, below, above);
        // The entropy is `1 - V` near 1/2, where `V` is the information.
        let complement = ENTROPY & near;
        let lower = if complement { other } else { head + below };
        let upper = if complement { other_above } else { head + above };
        // Domain: nearer to 0 there is no cell of the table; where the distance is 0 the answer is exact.
        let decided = if (x >= least) & (lower == upper) { lower } else { T::OPEN };
        let edge = if near == ENTROPY { one } else { zero };
        let exact = if x.is_zero() { edge } else { decided };
        *result = if x >= zero { exact } else { T::nan() };
    }
}
