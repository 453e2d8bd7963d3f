//! Maps laid over another: what each stores of a cell, and runs of cells of which all store the same.

use super::alignment::Alignment;
use crate::error::Error;
use crate::map::parts;
use crate::map::{Encoding, Grid};
use alloc::{vec, vec::Vec};
use core::iter::repeat;
use core::ops::Range;

/// Columns looked at together: the nearest cache holds them, of many maps of bytes.
const STRETCH: usize = 1 << 10;

/// Cells in a row.
pub(super) enum Run<'a, S> {
    /// So many, of which all maps store this.
    Agreed(S, usize),
    /// One, of which the maps store this.
    Mixed(&'a [S]),
}

/// Maps on one lattice, unknown beyond their own extents.
pub(super) struct Stack<'a, E: Encoding> {
    maps: &'a [Grid<E>],
    alignment: &'a Alignment,
}

/// Of a stretch of a row what a map stores, and at which of its cells it begins to.
type Part<'a, E> = (usize, &'a [<E as Encoding>::Stored]);

impl<'a, E: Encoding> Stack<'a, E> {
    pub(super) fn new(maps: &'a [Grid<E>], alignment: &'a Alignment) -> Self {
        Self { maps, alignment }
    }

    /// How many cells the grid has that holds them all.
    pub(super) fn cells(&self) -> u64 {
        self.alignment.width as u64 * self.alignment.height as u64
    }

    /// Hands these cells to `of`, by their numbers row by row, in runs.
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
                        // Before its start it has no cell either: the difference wraps around.
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

    /// What each map has of these columns of a row.
    fn parts(&self, row: usize, columns: &Range<usize>) -> impl Iterator<Item = Part<'a, E>> {
        self.maps.iter().zip(&self.alignment.offsets).map(move |(map, &[left, lower])| {
            let whole = row.checked_sub(lower).and_then(|row| map.row(row)).unwrap_or(&[]);
            let [start, end] = [columns.start.max(left), columns.end.min(left + whole.len())];
            if start < end { (start - columns.start, &whole[start - left..end - left]) } else { (0, &[][..]) }
        })
    }
}

/// What the first map stores, and where one of the others does not store the same.
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

/// Without a branch, by the processor's vector unit.
fn mark<S: Copy + PartialEq>(differs: &mut [bool], first: &[S], others: impl Iterator<Item = S>) {
    for ((differs, &first), other) in differs.iter_mut().zip(first).zip(others) {
        *differs |= first != other;
    }
}
