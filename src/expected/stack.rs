//! Maps on top of each other: the stored values of a cell, and runs of cells on which all maps agree.

use super::alignment::Alignment;
use crate::error::Error;
use crate::map::parts;
use crate::map::{Encoding, Grid};
use alloc::{vec, vec::Vec};
use core::iter::repeat;
use core::ops::Range;

/// The number of columns that are compared at once: in many maps of bytes they fit in the first-level cache.
const STRETCH: usize = 1 << 10;

/// A run of neighbouring cells in a row.
pub(super) enum Run<'a, S> {
    /// The value that all maps store, and the number of cells.
    Agreed(S, usize),
    /// The values that the maps store of one cell.
    Mixed(&'a [S]),
}

/// The maps on their common lattice, unknown beyond their own extents.
pub(super) struct Stack<'a, E: Encoding> {
    maps: &'a [Grid<E>],
    alignment: &'a Alignment,
}

/// The part of a map in a stretch of a row: the first of its cells within the stretch, and the stored values from there.
type Part<'a, E> = (usize, &'a [<E as Encoding>::Stored]);

impl<'a, E: Encoding> Stack<'a, E> {
    /// Creates the stack of aligned maps.
    pub(super) fn new(maps: &'a [Grid<E>], alignment: &'a Alignment) -> Self {
        Self { maps, alignment }
    }

    /// Returns the number of cells of the grid that holds all maps.
    pub(super) fn cells(&self) -> u64 {
        self.alignment.width as u64 * self.alignment.height as u64
    }

    /// Calls `of` with the runs of these cells, which are numbered row by row.
    pub(super) fn each_run(
        &self,
        cells: Range<u64>,
        mut of: impl FnMut(Run<E::Stored>) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let width = self.alignment.width;
        let longest = width.min(STRETCH);
        let (mut first, mut differs) = (vec![E::unknown(); longest], vec![false; longest]);
        let (mut parts, mut stored) =
            (Vec::with_capacity(self.maps.len()), vec![E::unknown(); self.maps.len()]);
        for (row, columns) in parts::rows(cells, width, STRETCH) {
            parts.clear();
            parts.extend(self.parts(row, &columns));
            let (first, differs) = (&mut first[..columns.len()], &mut differs[..columns.len()]);
            compare::<E>(&parts, first, differs);
            let mut at = 0;
            while at < first.len() {
                if differs[at] {
                    for (stored, &(start, part)) in stored.iter_mut().zip(&parts) {
                        // Before the start there is no cell: the difference wraps around, beyond the part.
                        *stored = part.get(at.wrapping_sub(start)).copied().unwrap_or(E::unknown());
                    }
                    of(Run::Mixed(&stored))?;
                    at += 1;
                    continue;
                }
                let (agreed, rest) = (first[at], first[at + 1..].iter().zip(&differs[at + 1..]));
                let more = rest.take_while(|&(&stored, &differs)| stored == agreed && !differs).count();
                of(Run::Agreed(agreed, 1 + more))?;
                at += 1 + more;
            }
        }
        Ok(())
    }

    /// Returns the part of each map in these columns of a row.
    fn parts(&self, row: usize, columns: &Range<usize>) -> impl Iterator<Item = Part<'a, E>> {
        self.maps.iter().zip(&self.alignment.offsets).map(move |(map, &[left, lower])| {
            let whole = row.checked_sub(lower).and_then(|row| map.row(row)).unwrap_or(&[]);
            let [start, end] = [columns.start.max(left), columns.end.min(left + whole.len())];
            if start < end { (start - columns.start, &whole[start - left..end - left]) } else { (0, &[][..]) }
        })
    }
}

/// Writes the values of the first map to `first`, and to `differs` where another map stores another value.
fn compare<E: Encoding>(parts: &[Part<E>], first: &mut [E::Stored], differs: &mut [bool]) {
    first.fill(E::unknown());
    differs.fill(false);
    let mut parts = parts.iter();
    if let Some(&(start, part)) = parts.next() {
        first[start..start + part.len()].copy_from_slice(part);
    }
    for &(start, part) in parts {
        let end = start + part.len();
        let unknown = repeat(E::unknown());
        mark(&mut differs[..start], &first[..start], unknown.clone());
        mark(&mut differs[start..end], &first[start..end], part.iter().copied());
        mark(&mut differs[end..], &first[end..], unknown);
    }
}

/// Marks where `others` differ from `first`, without branches, so that compilers use vector instructions.
fn mark<S: Copy + PartialEq>(differs: &mut [bool], first: &[S], others: impl Iterator<Item = S>) {
    for ((differs, &first), other) in differs.iter_mut().zip(first).zip(others) {
        *differs |= first != other;
    }
}
