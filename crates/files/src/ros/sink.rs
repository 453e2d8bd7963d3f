//! Where the cells of an image go: into a grid, or into counts.

use super::counting::count;
use super::pixel_table::{PixelTable, paint};
use super::suspects::SuspectGrey;
use crate::cells::{Cells, Contents, Counts, ImageEncoding};
use crate::error::Error;
use crate::image::{Image, MaxPixels};
use crate::options::{MAX_COUNTED, Options};
use crate::size::Size;
use mean_information::map::{Geometry, Grid};
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
