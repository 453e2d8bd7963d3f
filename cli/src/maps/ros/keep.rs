//! Whether the cells of an image are kept, or only counted.

use super::counting::count;
use super::doubts::Suspect;
use super::shading::{Shading, paint};
use crate::maps::image::Image;
use crate::maps::size::Size;
use crate::maps::{Cells, Contents, Counted, Fault, Readable};
use mean_information::map::{Geometry, Grid};
use std::io::{BufRead, Seek};

/// What is kept of the cells of an image.
pub(in crate::maps) trait Keep: Sized {
    /// Of an image at its place, and how many of its pixels are suspect.
    fn keep<E: Readable<Float = f64>>(
        image: Image<impl BufRead + Seek>,
        shading: &Shading<E::Stored>,
        geometry: Geometry,
    ) -> Result<(Self, Vec<(Suspect, u64)>), Fault>;
}

impl Keep for Cells {
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
