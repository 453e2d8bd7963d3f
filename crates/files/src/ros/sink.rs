//! Where the cells of an image go: into a grid, or into counts of how often each value occurs, which are all that the
//! measures of a map need and take no memory for its cells.

use super::pixel_table::{PixelTable, TableIndex, paint};
use super::suspects::SuspectGrey;
use crate::cells::{Cells, Contents, Counts, ImageEncoding};
use crate::error::Error;
use crate::image::{Image, Layout, MaxPixels};
use crate::options::{MAX_COUNTED, Options};
use crate::size::Size;
use mean_information::map::{Geometry, Grid, Histogram};
use std::io::{BufRead, Seek};
use std::ops::Range;

/// Where the cells of an image go.
pub(crate) trait Sink: Sized {
    /// Returns the most pixels of an image.
    fn max_pixels(options: &Options) -> MaxPixels;

    /// Takes the cells of an image, and counts its suspect pixels.
    fn take<E: ImageEncoding>(
        image: Image<impl BufRead + Seek>,
        table: &PixelTable<E::Stored>,
        geometry: Geometry,
    ) -> Result<(Self, Vec<(SuspectGrey, u64)>), Error>;
}

impl Sink for Cells {
    fn max_pixels(options: &Options) -> MaxPixels {
        let most = options.max_kept();
        MaxPixels { pgm: most, png: most }
    }

    fn take<E: ImageEncoding>(
        image: Image<impl BufRead + Seek>,
        table: &PixelTable<E::Stored>,
        geometry: Geometry,
    ) -> Result<(Self, Vec<(SuspectGrey, u64)>), Error> {
        let Size { width, height } = image.layout().size;
        let (cells, suspects) = paint(image, table)?;
        Ok((E::cells(Grid::new(width, height, geometry, cells)?), suspects))
    }
}

impl Sink for Contents {
    /// Returns no limit for a PGM, which ends where its file does: pixels that are counted take no memory.
    fn max_pixels(options: &Options) -> MaxPixels {
        MaxPixels {
            pgm: options.max_cells.unwrap_or(u64::MAX),
            png: options.max_cells.unwrap_or(MAX_COUNTED),
        }
    }

    fn take<E: ImageEncoding>(
        image: Image<impl BufRead + Seek>,
        table: &PixelTable<E::Stored>,
        _: Geometry,
    ) -> Result<(Self, Vec<(SuspectGrey, u64)>), Error> {
        let Size { width, height } = image.layout().size;
        let (values, suspects) = count(image, table)?;
        Ok((Self::Counted(E::counted(Counts { width, height, values })), suspects))
    }
}

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
fn count<C: Copy, R: BufRead + Seek>(image: Image<R>, table: &PixelTable<C>) -> Result<CellCounts<C>, Error> {
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
