//! A number for each cell of a map.

use crate::map::Geometry;
use alloc::vec::Vec;

/// A number for each cell of a map that is no occupancy: rows of cells from the lowest, with their place in the world.
///
/// ```
/// use mean_information::scan::ScanMap;
/// let layer = ScanMap::<f64>::new(0.25)?.with_agreement()?.contradictions()?;
/// let layer = layer.expect("a map with agreement");
/// assert_eq!((layer.width(), layer.height(), layer.cells().len()), (0, 0, 0));
/// assert_eq!(layer.into_cells(), []);
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Layer<T> {
    size: [usize; 2],
    geometry: Geometry,
    cells: Vec<T>,
}

impl<T> Layer<T> {
    /// Creates a layer from its columns and rows, its place, and as many numbers.
    pub(super) fn new(size: [usize; 2], geometry: Geometry, cells: Vec<T>) -> Self {
        Self { size, geometry, cells }
    }

    /// Returns the number of columns.
    pub fn width(&self) -> usize {
        self.size[0]
    }

    /// Returns the number of rows.
    pub fn height(&self) -> usize {
        self.size[1]
    }

    /// Returns resolution and origin.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// Returns the numbers, row by row from the lowest.
    pub fn cells(&self) -> &[T] {
        &self.cells
    }

    /// Returns the numbers and frees the rest.
    pub fn into_cells(self) -> Vec<T> {
        self.cells
    }
}
