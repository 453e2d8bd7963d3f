//! Maps of different extents on one lattice of cells.

use crate::error::Error;
use crate::map::{Encoding, Geometry, Grid};
use alloc::vec::Vec;
use num_traits::float::FloatCore;

/// The largest distance of an origin from the lattice, in cells: more than file formats round by, and too little to matter.
const TOLERANCE: f64 = 1.0 / 1024.0;

/// The smallest grid that holds several maps, and the place of each in it.
#[derive(Clone, Debug)]
pub(super) struct Alignment {
    pub(super) geometry: Geometry,
    pub(super) width: usize,
    pub(super) height: usize,
    /// The column and row of the first cell of each map.
    pub(super) offsets: Vec<[usize; 2]>,
}

impl Alignment {
    /// Finds the smallest grid that holds the maps.
    ///
    /// # Errors
    /// [`Error::Item`] naming a map of another resolution or yaw than the first, or whose origin is not a whole
    /// number of cells from the others'; [`Error::TooManyCells`]; [`Error::NoMemory`].
    pub(super) fn of<E: Encoding>(maps: &[Grid<E>], limit: u64) -> Result<Self, Error> {
        let first = maps.first().ok_or_else(|| Error::out_of_range("number of maps", 0.0, "1 or more"))?;
        let (resolution, yaw) = (first.geometry().resolution(), first.geometry().yaw());
        for (index, map) in maps.iter().enumerate() {
            let refuse = |what, value, allowed| Err(Error::Item { what, index, value, allowed });
            if map.geometry().resolution() != resolution {
                return refuse("resolution of map", map.geometry().resolution(), "that of map 0");
            }
            if map.geometry().yaw() != yaw {
                return refuse("yaw of map", map.geometry().yaw(), "that of map 0");
            }
        }
        // A map without cells has no place.
        let placed = || maps.iter().filter(|map| !map.cells().is_empty());
        let lowest = |k: usize| placed().map(|map| map.geometry().origin()[k]).reduce(f64::min);
        let (Some(x), Some(y)) = (lowest(0), lowest(1)) else {
            let offsets = maps.iter().map(|_| [0; 2]).collect();
            return Ok(Self { geometry: *first.geometry(), width: 0, height: 0, offsets });
        };
        let mut offsets = Vec::with_capacity(maps.len());
        let (mut width, mut height) = (0_u128, 0_u128);
        for (index, map) in maps.iter().enumerate() {
            if map.cells().is_empty() {
                offsets.push([0; 2]);
                continue;
            }
            let [column, row] = [(0, x), (1, y)].map(|(k, lowest)| {
                let cells = (map.geometry().origin()[k] - lowest) / resolution;
                // A turned grid is turned about its own origin: others fit it only there.
                let fits =
                    (cells - FloatCore::round(cells)).abs() <= TOLERANCE && (yaw == 0.0 || cells == 0.0);
                let what = "offset in cells of map";
                let allowed =
                    if yaw == 0.0 { "a whole number, within 1/1024" } else { "0, for maps that are turned" };
                if fits {
                    Ok(FloatCore::round(cells))
                } else {
                    Err(Error::Item { what, index, value: cells, allowed })
                }
            });
            let (column, row) = (column?, row?);
            // A float beyond the integers saturates, far above any limit.
            width = width.max((column as u128).saturating_add(map.width() as u128));
            height = height.max((row as u128).saturating_add(map.height() as u128));
            offsets.push([column as usize, row as usize]);
        }
        let cells = width.saturating_mul(height);
        if cells > u128::from(limit) {
            return Err(Error::too_many_cells(cells, limit));
        }
        let (Ok(width), Ok(height)) = (usize::try_from(width), usize::try_from(height)) else {
            return Err(Error::no_memory(cells));
        };
        let geometry = Geometry::new(resolution, [x, y])?.with_yaw(yaw)?;
        Ok(Self { geometry, width, height, offsets })
    }
}
