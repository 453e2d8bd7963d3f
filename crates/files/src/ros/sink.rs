//! Where the cells of an image go: into a grid, or into counts of how often each value occurs, which are all that the
//! measures of a map need and take no memory for its cells.

use super::pixel_table::{PixelTable, TableIndex, turn_over};
use super::suspects::SuspectGrey;
use crate::cells::{Cells, Contents, Counts, ImageEncoding};
use crate::error::Error;
use crate::image::{Image, Layout, MaxPixels, Rest};
use crate::options::{MAX_COUNTED, Options};
use crate::size::{Size, reserve};
use mean_information::map::{Geometry, Grid, Histogram};
use std::io::{BufRead, Seek};

/// Where the cells of an image go.
pub(crate) trait Sink: Sized {
    /// Returns the most pixels of an image.
    fn max_pixels(options: &Options) -> MaxPixels;

    /// Takes the cells of an image, and counts its suspect pixels.
    fn take<E: ImageEncoding>(
        image: Image<impl BufRead + Seek>,
        table: &PixelTable<E::Stored>,
        geometry: Geometry,
    ) -> Result<(Self, Found), Error>;
}

impl Sink for Cells {
    fn max_pixels(options: &Options) -> MaxPixels {
        let most = options.max_kept();
        MaxPixels { pgm: most, png: most, decoded: most }
    }

    fn take<E: ImageEncoding>(
        image: Image<impl BufRead + Seek>,
        table: &PixelTable<E::Stored>,
        geometry: Geometry,
    ) -> Result<(Self, Found), Error> {
        let Size { width, height } = image.layout().size;
        let (cells, found) = paint(image, table)?;
        Ok((E::cells(Grid::new(width, height, geometry, cells)?), found))
    }
}

impl Sink for Contents {
    /// Returns no limit for a PGM, which ends where its file does: pixels that are counted take no memory.
    fn max_pixels(options: &Options) -> MaxPixels {
        MaxPixels {
            pgm: options.max_cells.unwrap_or(u64::MAX),
            png: options.max_cells.unwrap_or(MAX_COUNTED),
            decoded: options.max_kept(),
        }
    }

    fn take<E: ImageEncoding>(
        image: Image<impl BufRead + Seek>,
        table: &PixelTable<E::Stored>,
        _: Geometry,
    ) -> Result<(Self, Found), Error> {
        let Size { width, height } = image.layout().size;
        let (values, found) = count(image, table)?;
        Ok((Self::Counted(E::counted(Counts { width, height, values })), found))
    }
}

/// The number of lanes in which pixels are counted in turn: equal neighbours would wait for each other.
const LANES: usize = 4;

/// The number of pixels at each index of a [`PixelTable`]'s tables.
enum IndexCounts {
    /// Pixels that are bytes, and their own index.
    Bytes(Box<Histogram>),
    /// Opaque pixels, and others.
    Indices([Vec<[u64; LANES]>; 2]),
}

impl IndexCounts {
    /// Creates counts of 0.
    fn new<C: Copy + PartialEq>(table: &PixelTable<C>, layout: &Layout) -> Self {
        let lengths = table.lengths();
        if layout.pixel_bytes() == 1 && lengths[0] == 256 {
            Self::Bytes(Box::default())
        } else {
            Self::Indices(lengths.map(|length| vec![[0; LANES]; length]))
        }
    }

    /// Counts pixels by their index.
    fn extend<C: Copy + PartialEq>(&mut self, table: &PixelTable<C>, layout: &Layout, pixels: &[u8]) {
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

/// What was found of an image beside its cells.
pub(crate) struct Found {
    /// The number of pixels of each suspect grey.
    pub(crate) suspects: Vec<(SuspectGrey, u64)>,
    /// The number of opaque pixels of each weighted sum that occurs, in order.
    pub(crate) sums: Vec<(usize, u64)>,
    /// The weighted sum of white; none where alpha is part of it.
    pub(crate) white: Option<usize>,
    /// What follows the image in its file.
    pub(crate) rest: Rest,
}

/// Reads the pixels of an image into cells, the lowest row first.
fn paint<C: Copy + PartialEq, R: BufRead + Seek>(
    image: Image<R>,
    table: &PixelTable<C>,
) -> Result<(Vec<C>, Found), Error> {
    let layout = image.layout();
    let mut cells = Vec::new();
    let (_, found) = visit(image, table, |pixels| {
        reserve(&mut cells, pixels.len() / layout.pixel_bytes(), layout.size.cells())?;
        table.extend(&mut cells, &layout, pixels);
        Ok(())
    })?;
    turn_over(&mut cells, layout.size.width);
    Ok((cells, found))
}

/// Counts the cells of an image. A cell may be listed more than once.
fn count<C: Copy + PartialEq, R: BufRead + Seek>(
    image: Image<R>,
    table: &PixelTable<C>,
) -> Result<(Vec<(C, u64)>, Found), Error> {
    let ([opaque, clear], found) = visit(image, table, |_| Ok(()))?;
    let all = (0..).map(TableIndex::Opaque).zip(&opaque).chain((0..).map(TableIndex::Clear).zip(&clear));
    let present = all.filter(|&(_, &count)| count > 0);
    Ok((present.map(|(index, &count)| (table.cell(index), count)).collect(), found))
}

/// Counts the pixels of an image by their places in the tables, and gives them to `each`, a piece at a time.
fn visit<C: Copy + PartialEq, R: BufRead + Seek>(
    image: Image<R>,
    table: &PixelTable<C>,
    mut each: impl FnMut(&[u8]) -> Result<(), Error>,
) -> Result<([Vec<u64>; 2], Found), Error> {
    let layout = image.layout();
    let mut counts = IndexCounts::new(table, &layout);
    let rest = image.pixels(|pixels| {
        counts.extend(table, &layout, pixels);
        each(pixels)
    })?;
    let [opaque, clear] = counts.totals();
    layout.require(opaque.iter().chain(&clear).sum())?;
    let suspects = table.suspects(&opaque, &clear);
    let sums = opaque.iter().copied().enumerate().filter(|&(_, count)| count > 0).collect();
    Ok(([opaque, clear], Found { suspects, sums, white: table.white(), rest }))
}
