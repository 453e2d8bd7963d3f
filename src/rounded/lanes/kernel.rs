//! What the kernels share: the results of a block of cells, stored and then summed up, exactly; the distances of occupancies.
//!
//! The bounds are those of theorem (blocks) in the chapter [`sums`](crate::book::sums), whose paragraphs the comments name.

use super::format::{BLOCK, Lane};
use super::sum::{self, Parts};

/// Holds the entropies of a block, then its information.
pub(crate) type Results<T> = [T; 2 * BLOCK];

/// Splits the results of a block into entropies and information.
#[inline(always)]
pub(super) fn halves<T>(results: &mut Results<T>) -> (&mut [T; BLOCK], &mut [T; BLOCK]) {
    let (entropies, informations) = results.split_first_chunk_mut().expect("two blocks have one");
    (entropies, informations.first_chunk_mut().expect("and another"))
}

/// Marks what became of a cell: each mark but [`OPEN`](mark::OPEN) is a bit of its own, so that bits are counted.
pub(super) mod mark {
    /// Marks a cell that is in no sum yet: not decided, or beyond the table.
    pub(in super::super) const OPEN: u8 = 0;
    /// Marks a cell in the sums, below 1/2; without entropies, or above.
    pub(in super::super) const FREE: u8 = 1;
    pub(in super::super) const OCCUPIED: u8 = 2;
    pub(in super::super) const UNKNOWN: u8 = 4;
    /// Marks what is no cell.
    pub(in super::super) const NONE: u8 = 8;
}

/// Holds what a block of cells adds to a tally, except for those that are left open.
#[derive(Debug)]
pub(crate) struct Block {
    /// Holds the exact sum of the rounded entropies, or 0 without them.
    pub(crate) entropy: Parts,
    /// Holds the exact sum of the rounded information.
    pub(crate) information: Parts,
    pub(crate) unknown: u64,
    pub(crate) free: u64,
    /// Counts the occupied cells; 0 without entropies, where they are among the free ones.
    pub(crate) occupied: u64,
    pub(super) marks: [u8; BLOCK],
    /// Whether there are small entropies, and information, that are in no sum yet.
    pub(super) has_small: [bool; 2],
}

/// Counts the marks of one kind, eight bytes at a time.
#[inline(always)]
fn count(marks: &[u8; BLOCK], of: u8) -> u64 {
    let these = u64::from_ne_bytes([of; 8]);
    let eights = marks.as_chunks::<8>().0.iter();
    eights.map(|&marks| u64::from((u64::from_ne_bytes(marks) & these).count_ones())).sum()
}

impl Block {
    /// Returns the cells of the block that are in no sum.
    pub(crate) fn open<T: Copy>(&self, cells: &[T]) -> impl Iterator<Item = T> {
        // Eight at a time, since there are few: of eight marks, one bit each, some are open if there are fewer bits.
        let eights = self.marks.as_chunks::<8>().0.iter().zip(cells.chunks(8));
        let some_open = |marks: &[u8; 8]| u64::from_ne_bytes(*marks).count_ones() < 8;
        eights.filter(move |(marks, _)| some_open(marks)).flat_map(|(marks, cells)| {
            marks.iter().zip(cells).filter(|(mark, _)| **mark == mark::OPEN).map(|(_, &p)| p)
        })
    }

    /// Creates a block from the results of its cells, 0 where they are left open, and what became of each.
    #[inline(always)]
    pub(super) fn new<T: Lane, const ENTROPY: bool>(
        entropies: &[T; BLOCK],
        informations: &[T; BLOCK],
        marks: [u8; BLOCK],
    ) -> Self {
        let (entropy, small_entropies) =
            if ENTROPY { sum::large(entropies) } else { (Parts::default(), false) };
        let (information, small_information) = sum::large(informations);
        Self {
            entropy,
            information,
            unknown: count(&marks, mark::UNKNOWN),
            free: count(&marks, mark::FREE),
            occupied: count(&marks, mark::OCCUPIED),
            marks,
            has_small: [small_entropies, small_information],
        }
    }

    /// Adds to the sums what small results of the block are not in them.
    #[inline(always)]
    pub(super) fn add_small<T: Lane>(&mut self, results: &Results<T>) {
        let sums = [&mut self.entropy, &mut self.information];
        let small = core::mem::take(&mut self.has_small);
        for ((parts, results), _) in
            sums.into_iter().zip(results.as_chunks().0).zip(small).filter(|(_, small)| *small)
        {
            sum::add_small(parts, results);
        }
    }
}

/// Returns the distance from unknown and `true`, or twice that from certain and `false` if this is at most 1/2.
#[inline(always)]
pub(super) fn distance<T: Lane>(p: T) -> (T, bool) {
    let rest = T::one() - p;
    // Distances: where `1 - p` is rounded, `p` is the lesser; the rest is exact by Sterbenz's lemma.
    let q = if p < rest { p } else { rest };
    let double = q + q;
    let near = double > T::HALF;
    (if near { T::one() - double } else { double }, near)
}

/// Computes `a b + c`, in one step or in two.
#[inline(always)]
pub(super) fn fused<T: Lane, const FUSED: bool>(a: T, b: T, c: T) -> T {
    if FUSED { T::fused(a, b, c) } else { a * b + c }
}
