//! Memory that is refused to a raster of this thread, to test what is left without it.

use crate::error::Error;
use std::cell::Cell;

std::thread_local! {
    /// How many rasters are made before one is refused; `None` if none is.
    static BEFORE: Cell<Option<u32>> = const { Cell::new(None) };
}

/// Refuses one raster after so many others.
pub(super) fn after(rasters: u32) {
    BEFORE.set(Some(rasters));
}

/// Refuses a raster of so many cells if it is the one.
pub(super) fn ask(cells: usize) -> Result<(), Error> {
    let before = BEFORE.take();
    BEFORE.set(before.and_then(|rasters| rasters.checked_sub(1)));
    if before == Some(0) { Err(Error::no_memory(cells as u128)) } else { Ok(()) }
}
