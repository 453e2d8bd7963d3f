//! Look-up tables from pixels to the cells that are stored.
//!
//! Every loader sums a pixel's samples with some weights and decides by the sum, and by whether alpha is below some
//! value. So a cell is one look-up, and what a sum means is computed once.

use super::suspects::SuspectGrey;
use crate::image::Layout;
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
    /// What is to be said of pixels below it.
    see_through: Option<SuspectGrey>,
}

impl<C: Copy + PartialEq> PixelTable<C> {
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
        Self { weights, opaque, watched, opaque_from: 0, clear: Vec::new(), see_through: None }
    }

    /// Turns pixels whose alpha is below `opaque_from` into `clear` of their opaque cell, and counts those that this
    /// changes, or all of them where alpha is averaged.
    pub(super) fn with_alpha(
        mut self,
        opaque_from: u16,
        see_through: Option<SuspectGrey>,
        clear: impl Fn(C) -> C,
    ) -> Self {
        self.opaque_from = opaque_from;
        self.see_through = see_through;
        self.clear = self.opaque.iter().map(|&cell| clear(cell)).collect();
        self
    }

    /// Appends the cells of some pixels.
    pub(super) fn extend(&self, cells: &mut Vec<C>, layout: &Layout, pixels: &[u8]) {
        if layout.pixel_bytes() == 1
            && let Ok(table) = <&[C; 256]>::try_from(self.opaque.as_slice())
        {
            cells.extend(pixels.iter().map(|&pixel| table[usize::from(pixel)]));
        } else {
            self.indices(layout, pixels, |at| cells.push(self.cell(at)));
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

    /// Returns the weighted sum of white, unless alpha is averaged with it.
    pub(super) fn white(&self) -> Option<usize> {
        (self.see_through != Some(SuspectGrey::AlphaAveraged)).then(|| self.opaque.len() - 1)
    }

    /// Returns what there is to say of pixels that were counted by their places in the two tables.
    pub(super) fn suspects(&self, opaque: &[u64], clear: &[u64]) -> Vec<(SuspectGrey, u64)> {
        let of =
            |(suspect, sums): &(SuspectGrey, Range<usize>)| (*suspect, opaque[sums.clone()].iter().sum());
        let mut suspects: Vec<_> = self.watched.iter().map(of).collect();
        suspects.extend(self.see_through.map(|why| {
            let cells = self.opaque.iter().zip(&self.clear).zip(clear);
            let speaks =
                cells.filter(|((before, after), _)| why == SuspectGrey::AlphaAveraged || before != after);
            (why, speaks.map(|(_, count)| count).sum())
        }));
        suspects
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

    /// Calls `each` with the table index of every pixel of `PIXEL` bytes, whose samples have `SAMPLE` bytes, the high one
    /// first.
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
    /// An index into `opaque`.
    Opaque(usize),
    /// An index into `clear`.
    Clear(usize),
}

/// Puts the last row first.
pub(super) fn turn_over<C>(cells: &mut [C], width: usize) {
    let mut rows = cells.chunks_exact_mut(width);
    while let (Some(low), Some(high)) = (rows.next(), rows.next_back()) {
        low.swap_with_slice(high);
    }
}
