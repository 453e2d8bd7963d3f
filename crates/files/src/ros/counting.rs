//! How often each value occurs in an image: all that the measures of a map need, and no memory for its cells.

use super::pixel_table::{PixelTable, TableIndex};
use super::suspects::SuspectGrey;
use crate::error::Error;
use crate::image::{Image, Layout};
use mean_information::map::Histogram;
use std::io::{BufRead, Seek};
use std::ops::Range;

/// Pixels are counted in so many lanes in turn: equal neighbours would wait for each other.
const LANES: usize = 4;

/// The number of pixels at each index of a [`PixelTable`]'s tables occurs.
enum IndexCounts {
    /// Pixels that are bytes, and their own index.
    Bytes(Box<Histogram>),
    /// Opaque pixels, and others.
    Indices([Vec<[u64; LANES]>; 2]),
}

impl IndexCounts {
    /// Creates counts of 0.
    fn new<C: Copy>(table: &PixelTable<C>, layout: &Layout) -> Self {
        let lengths = table.lengths();
        if layout.pixel_bytes() == 1 && lengths[0] == 256 {
            Self::Bytes(Box::default())
        } else {
            Self::Indices(lengths.map(|length| vec![[0; LANES]; length]))
        }
    }

    /// IndexCounts some pixels.
    fn extend<C: Copy>(&mut self, table: &PixelTable<C>, layout: &Layout, pixels: &[u8]) {
        match self {
            Self::Bytes(histogram) => histogram.add_cells(pixels),
            Self::Indices([opaque, clear]) => {
                let mut lane = 0;
                table.indices(layout, pixels, |index| {
                    match index {
                        TableIndex::Opaque(index) => opaque[index][lane] += 1,
                        TableIndex::Clear(index) => clear[index][lane] += 1,
                    }
                    lane = (lane + 1) % LANES;
                });
            }
        }
    }

    /// Returns how often each index of opaque pixels, and of others, occurs.
    fn totals(self) -> [Vec<u64>; 2] {
        match self {
            Self::Bytes(histogram) => [histogram.counts().to_vec(), Vec::new()],
            Self::Indices(tables) => {
                tables.map(|table| table.iter().map(|lanes| lanes.iter().sum()).collect())
            }
        }
    }
}

/// The number of times that each cell of an image, and each suspect grey, occurs. A cell may be listed more than once.
type CellCounts<C> = (Vec<(C, u64)>, Vec<(SuspectGrey, u64)>);

/// IndexCounts the cells of an image.
pub(super) fn count<C: Copy, R: BufRead + Seek>(
    image: Image<R>,
    table: &PixelTable<C>,
) -> Result<CellCounts<C>, Error> {
    let layout = image.layout();
    let mut counts = IndexCounts::new(table, &layout);
    image.pixels(|pixels| {
        counts.extend(table, &layout, pixels);
        Ok(())
    })?;
    let [opaque, clear] = counts.totals();
    let found = opaque.iter().chain(&clear).sum();
    layout.require(found)?;
    let all = (0..).map(TableIndex::Opaque).zip(&opaque).chain((0..).map(TableIndex::Clear).zip(&clear));
    let present = all.filter(|&(_, &count)| count > 0);
    let cells = present.map(|(index, &count)| (table.cell(index), count)).collect();
    let of = |(suspect, sums): &(SuspectGrey, Range<usize>)| (*suspect, opaque[sums.clone()].iter().sum());
    Ok((cells, table.watched().iter().map(of).collect()))
}
