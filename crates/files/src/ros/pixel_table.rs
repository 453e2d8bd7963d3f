//! Look-up tables from pixels to the cells that are stored.
//!
//! Every loader sums a pixel's samples with some weights and decides by the sum, and by whether alpha is below some
//! value. So a cell is one look-up, and what a sum means is computed once.

use super::suspects::SuspectGrey;
use crate::error::Error;
use crate::image::{Image, Layout};
use crate::size::reserve;
use std::io::{BufRead, Seek};
use std::ops::Range;

/// A look-up table from the pixels of one layout to cells.
pub(crate) struct PixelTable<C> {
    weights: [u32; 4],
    /// Cells by the weighted sum of samples.
    opaque: Vec<C>,
    /// The sums to be counted, and why.
    watched: Vec<(SuspectGrey, Range<usize>)>,
    /// The alpha below which `clear` holds instead.
    opaque_from: u16,
    clear: Vec<C>,
}

impl<C: Copy> PixelTable<C> {
    /// Tabulates `entry`, a cell and why it is to be counted, over all values of the weighted sum of a pixel's samples.
    pub(super) fn new(
        layout: &Layout,
        weights: [u32; 4],
        entry: impl Fn(u32) -> (C, Option<SuspectGrey>),
    ) -> Self {
        let most = weights.iter().sum::<u32>() * u32::from(layout.max);
        let mut opaque = Vec::with_capacity(most as usize + 1);
        let mut watched: Vec<(SuspectGrey, Range<usize>)> = Vec::new();
        for sum in 0..=most {
            let (cell, suspect) = entry(sum);
            let index = opaque.len();
            match (suspect, watched.last_mut()) {
                (Some(suspect), Some((last, sums))) if *last == suspect && sums.end == index => {
                    sums.end += 1;
                }
                (Some(suspect), _) => watched.push((suspect, index..index + 1)),
                (None, _) => {}
            }
            opaque.push(cell);
        }
        Self { weights, opaque, watched, opaque_from: 0, clear: Vec::new() }
    }

    /// Turns pixels whose alpha is below `opaque_from` into `clear` of their opaque cell, and does not count them.
    pub(super) fn with_alpha(mut self, opaque_from: u16, clear: impl Fn(C) -> C) -> Self {
        self.opaque_from = opaque_from;
        self.clear = self.opaque.iter().map(|&cell| clear(cell)).collect();
        self
    }

    /// Appends the cells of some pixels, and counts the watched ones.
    fn extend(&self, cells: &mut Vec<C>, counts: &mut [u64], layout: &Layout, pixels: &[u8]) {
        if layout.pixel_bytes() == 1
            && let Ok(table) = <&[C; 256]>::try_from(self.opaque.as_slice())
        {
            return self.extend_by(table, cells, counts, pixels);
        }
        self.indices(layout, pixels, |at| {
            let TableIndex::Opaque(index) = at else {
                return cells.push(self.cell(at));
            };
            for (count, (_, sums)) in counts.iter_mut().zip(&self.watched) {
                *count += u64::from(sums.contains(&index));
            }
            cells.push(self.opaque[index]);
        });
    }

    /// Appends the cells of pixels that are their own index.
    fn extend_by(&self, table: &[C; 256], cells: &mut Vec<C>, counts: &mut [u64], pixels: &[u8]) {
        cells.extend(pixels.iter().map(|&pixel| table[usize::from(pixel)]));
        for (count, (_, sums)) in counts.iter_mut().zip(&self.watched) {
            let (first, span) = (sums.start as u8, (sums.len() - 1) as u8);
            // In 32 bits, which holds the longest piece, for the sake of vector code.
            let inside = |&pixel: &u8| u32::from(pixel.wrapping_sub(first) <= span);
            *count += u64::from(pixels.iter().map(inside).sum::<u32>());
        }
    }

    /// Returns the cell at a place of the tables.
    pub(super) fn cell(&self, index: TableIndex) -> C {
        match index {
            TableIndex::Opaque(index) => self.opaque[index],
            TableIndex::Clear(index) => self.clear[index],
        }
    }

    /// Returns the lengths of both tables.
    pub(super) fn lengths(&self) -> [usize; 2] {
        [self.opaque.len(), self.clear.len()]
    }

    /// Returns what is counted, and its indices in the first table.
    pub(super) fn watched(&self) -> &[(SuspectGrey, Range<usize>)] {
        &self.watched
    }

    /// Gives where the cells of some pixels are in the tables, one after the other.
    pub(super) fn indices(&self, layout: &Layout, pixels: &[u8], each: impl FnMut(TableIndex)) {
        match (layout.sample_bytes(), layout.channels.count()) {
            (1, 1) => self.indices_from::<1, 1>(pixels, each),
            (1, 2) => self.indices_from::<2, 1>(pixels, each),
            (1, 3) => self.indices_from::<3, 1>(pixels, each),
            (1, _) => self.indices_from::<4, 1>(pixels, each),
            (_, 1) => self.indices_from::<2, 2>(pixels, each),
            (_, 2) => self.indices_from::<4, 2>(pixels, each),
            (_, 3) => self.indices_from::<6, 2>(pixels, each),
            (_, _) => self.indices_from::<8, 2>(pixels, each),
        }
    }

    /// Does so for pixels of `PIXEL` bytes with samples of `SAMPLE` bytes, the high one first.
    fn indices_from<const PIXEL: usize, const SAMPLE: usize>(
        &self,
        pixels: &[u8],
        mut each: impl FnMut(TableIndex),
    ) {
        for pixel in pixels.as_chunks::<PIXEL>().0 {
            let (mut sum, mut last) = (0, 0);
            for (sample, weight) in pixel.as_chunks::<SAMPLE>().0.iter().zip(self.weights) {
                last = sample.iter().fold(0, |high, &low| high << 8 | u32::from(low));
                sum += weight * last;
            }
            let index = sum as usize;
            let clear = last < u32::from(self.opaque_from);
            each(if clear { TableIndex::Clear(index) } else { TableIndex::Opaque(index) });
        }
    }
}

/// A place in the tables, by the weighted sum of a pixel's samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TableIndex {
    /// In that of opaque pixels.
    Opaque(usize),
    /// In that of others.
    Clear(usize),
}

/// The cells of an image, the lowest row first, and how many of them were watched, by the reason.
type Painted<C> = (Vec<C>, Vec<(SuspectGrey, u64)>);

/// Reads the pixels of an image into cells.
pub(super) fn paint<C: Copy, R: BufRead + Seek>(
    image: Image<R>,
    table: &PixelTable<C>,
) -> Result<Painted<C>, Error> {
    let layout = image.layout();
    let total = layout.size.cells();
    let mut cells = Vec::new();
    let mut counts = vec![0; table.watched.len()];
    image.pixels(|pixels| {
        reserve(&mut cells, pixels.len() / layout.pixel_bytes(), total)?;
        table.extend(&mut cells, &mut counts, &layout, pixels);
        Ok(())
    })?;
    layout.require(cells.len() as u64)?;
    turn_over(&mut cells, layout.size.width);
    let reasons = table.watched.iter().map(|&(suspect, _)| suspect);
    Ok((cells, reasons.zip(counts).collect()))
}

/// Puts the last row first.
fn turn_over<C>(cells: &mut [C], width: usize) {
    let mut rows = cells.chunks_exact_mut(width);
    while let (Some(low), Some(high)) = (rows.next(), rows.next_back()) {
        low.swap_with_slice(high);
    }
}
