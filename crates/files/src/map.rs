//! A map as it was read.

use crate::cells::Cells;
use crate::warning::Warning;
use std::path::PathBuf;

/// A map read from a file.
#[derive(Clone, Debug)]
pub struct Map<C = Cells> {
    /// The cells.
    pub cells: C,
    /// The side of a cell in metres; `None` if the file does not say.
    pub resolution: Option<f64>,
    /// The signs that the map means less than it seems.
    pub warnings: Vec<Warning>,
    /// The files it was read from, so that no output overwrites one.
    pub files: Vec<PathBuf>,
}

impl Map {
    /// Returns the map with its cells in another form.
    pub(crate) fn with<C: From<Cells>>(self) -> Map<C> {
        let Self { cells, resolution, warnings, files } = self;
        Map { cells: cells.into(), resolution, warnings, files }
    }
}
