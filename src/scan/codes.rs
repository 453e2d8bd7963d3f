//! What most cells of a scan are told, as a byte for each.

/// The codes of cells in the raster: nothing, or one of the two levels.
pub(super) const NOTHING: u8 = 0;
pub(super) const FREE: u8 = 1;
pub(super) const OCCUPIED: u8 = 2;
