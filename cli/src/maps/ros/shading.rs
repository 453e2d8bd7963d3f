//! From pixels to cells by tables.
//!
//! Every loader sums a pixel's samples with some weights and decides by the sum, and by whether alpha is below some
//! value. So a cell is one look-up, and what a sum means is computed once.

use crate::maps::Fault;
use crate::maps::image::{Image, Layout};
use crate::maps::size::reserve;
use std::io::{BufRead, Seek};
use std::ops::Range;

/// How pixels of one layout become cells.
pub(super) struct Shading<C> {
    weights: [u32; 4],
    /// Cells by the weighted sum of samples.
    opaque: Vec<C>,
    /// The sums to be counted, none if empty.
    watched: Range<usize>,
    /// The alpha below which `clear` holds instead.
    opaque_from: u16,
    clear: Vec<C>,
}

impl<C: Copy> Shading<C> {
    /// Tabulates `entry`, a cell and whether it is to be counted, over all values of the weighted sum of a pixel's
    /// samples. The sums to be counted must be neighbours.
    pub(super) fn new(layout: &Layout, weights: [u32; 4], entry: impl Fn(u32) -> (C, bool)) -> Self {
        let most = weights.iter().sum::<u32>() * u32::from(layout.max);
        let mut opaque = Vec::with_capacity(most as usize + 1);
        let mut watched = 0..0;
        for sum in 0..=most {
            let (cell, is_watched) = entry(sum);
            if is_watched {
                let first = if watched.is_empty() { opaque.len() } else { watched.start };
                watched = first..opaque.len() + 1;
            }
            opaque.push(cell);
        }
        Self { weights, opaque, watched, opaque_from: 0, clear: Vec::new() }
    }

    /// Pixels whose alpha is below `opaque_from` become `clear` of their opaque cell instead, and are not counted.
    pub(super) fn with_alpha(mut self, opaque_from: u16, clear: impl Fn(C) -> C) -> Self {
        self.opaque_from = opaque_from;
        self.clear = self.opaque.iter().map(|&cell| clear(cell)).collect();
        self
    }

    /// Appends the cells of some pixels, and counts the watched ones.
    fn extend(&self, cells: &mut Vec<C>, layout: &Layout, pixels: &[u8]) -> u64 {
        match (layout.sample_bytes(), layout.channels.count()) {
            (1, 1) => match <&[C; 256]>::try_from(self.opaque.as_slice()) {
                Ok(table) => self.extend_by(table, cells, pixels),
                Err(_) => self.extend_from::<1, 1>(cells, pixels),
            },
            (1, 2) => self.extend_from::<2, 1>(cells, pixels),
            (1, 3) => self.extend_from::<3, 1>(cells, pixels),
            (1, _) => self.extend_from::<4, 1>(cells, pixels),
            (_, 1) => self.extend_from::<2, 2>(cells, pixels),
            (_, 2) => self.extend_from::<4, 2>(cells, pixels),
            (_, 3) => self.extend_from::<6, 2>(cells, pixels),
            (_, _) => self.extend_from::<8, 2>(cells, pixels),
        }
    }

    /// Pixels that are their own index.
    fn extend_by(&self, table: &[C; 256], cells: &mut Vec<C>, pixels: &[u8]) -> u64 {
        cells.extend(pixels.iter().map(|&pixel| table[usize::from(pixel)]));
        if self.watched.is_empty() {
            return 0;
        }
        let (first, span) = (self.watched.start as u8, (self.watched.len() - 1) as u8);
        // In 32 bits, which holds the longest piece, for the sake of vector code.
        pixels.iter().map(|&pixel| u32::from(pixel.wrapping_sub(first) <= span)).sum::<u32>().into()
    }

    /// Pixels of `PIXEL` bytes with samples of `SAMPLE` bytes, the high one first.
    fn extend_from<const PIXEL: usize, const SAMPLE: usize>(&self, cells: &mut Vec<C>, pixels: &[u8]) -> u64 {
        let mut count = 0;
        cells.extend(pixels.as_chunks::<PIXEL>().0.iter().map(|pixel| {
            let (mut sum, mut last) = (0, 0);
            for (sample, weight) in pixel.as_chunks::<SAMPLE>().0.iter().zip(self.weights) {
                last = sample.iter().fold(0, |high, &low| high << 8 | u32::from(low));
                sum += weight * last;
            }
            let index = sum as usize;
            if last < u32::from(self.opaque_from) {
                return self.clear[index];
            }
            count += u64::from(self.watched.contains(&index));
            self.opaque[index]
        }));
        count
    }
}

/// The cells of an image, the lowest row first, and how many of them were watched.
pub(super) fn paint<C: Copy, R: BufRead + Seek>(
    image: Image<R>,
    shading: &Shading<C>,
) -> Result<(Vec<C>, u64), Fault> {
    let layout = image.layout();
    let total = layout.size.cells();
    let mut cells = Vec::new();
    let mut watched = 0;
    image.pixels(|pixels| {
        reserve(&mut cells, pixels.len() / layout.pixel_bytes(), total)?;
        watched += shading.extend(&mut cells, &layout, pixels);
        Ok(())
    })?;
    if cells.len() != total {
        return Err(Fault::new(format!("holds {} pixels, its header claims {total}", cells.len())));
    }
    turn_over(&mut cells, layout.size.width);
    Ok((cells, watched))
}

/// Puts the last row first.
fn turn_over<C>(cells: &mut [C], width: usize) {
    let mut rows = cells.chunks_exact_mut(width);
    while let (Some(low), Some(high)) = (rows.next(), rows.next_back()) {
        low.swap_with_slice(high);
    }
}
