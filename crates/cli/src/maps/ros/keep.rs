//! Whether the cells of an image are kept, or only counted.

use super::counting::count;
use super::doubts::Suspect;
use super::shading::{Shading, paint};
use crate::maps::image::{Image, MaxPixels};
use crate::maps::size::Size;
use crate::maps::{Cells, Contents, Counted, Fault, MAX_COUNTED, Options, Readable};
use mean_information::map::{Geometry, Grid};
use std::io::{BufRead, Seek};

/// What is kept of the cells of an image.
pub(in crate::maps) trait Keep: Sized {
    /// The most pixels of an image.
    fn max_pixels(options: &Options) -> MaxPixels;

    /// Of an image at its place, and how many of its pixels are suspect.
    fn keep<E: Readable<Float = f64>>(
        image: Image<impl BufRead + Seek>,
        shading: &Shading<E::Stored>,
        geometry: Geometry,
    ) -> Result<(Self, Vec<(Suspect, u64)>), Fault>;
}

impl Keep for Cells {
    fn max_pixels(options: &Options) -> MaxPixels {
        let most = options.max_kept();
        MaxPixels { pgm: most, png: most }
    }

    fn keep<E: Readable<Float = f64>>(
        image: Image<impl BufRead + Seek>,
        shading: &Shading<E::Stored>,
        geometry: Geometry,
    ) -> Result<(Self, Vec<(Suspect, u64)>), Fault> {
        let Size { width, height } = image.layout().size;
        let (cells, suspects) = paint(image, shading)?;
        Ok((E::cells(Grid::new(width, height, geometry, cells)?), suspects))
    }
}

impl Keep for Contents {
    /// Pixels that are counted take no memory, and a PGM ends where its file does.
    fn max_pixels(options: &Options) -> MaxPixels {
        MaxPixels {
            pgm: options.max_cells.unwrap_or(u64::MAX),
            png: options.max_cells.unwrap_or(MAX_COUNTED),
        }
    }

    fn keep<E: Readable<Float = f64>>(
        image: Image<impl BufRead + Seek>,
        shading: &Shading<E::Stored>,
        _: Geometry,
    ) -> Result<(Self, Vec<(Suspect, u64)>), Fault> {
        let Size { width, height } = image.layout().size;
        let (cells, suspects) = count(image, shading)?;
        Ok((Self::Counted(Box::new(Counted::new::<E>(width, height, &cells))), suspects))
    }
}
