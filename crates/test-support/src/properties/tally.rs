//! The tally of any grid.

use mean_information::map::{Encoding, Grid};
use mean_information::{Real, Tally};

/// Checks that every cell is counted once, and the mean is in [0, 1]; the sums are those of the cells.
pub(super) fn check_tally<E: Encoding>(grid: &Grid<E>) {
    let tally = grid.tally();
    assert_eq!(tally.observed() + tally.unknown(), (grid.width() * grid.height()) as u64);
    assert_eq!(tally.free() + tally.occupied(), tally.observed());
    let mean = tally.mean_information().widen();
    assert!((0.0..=1.0).contains(&mean), "{mean}");
    assert!(tally.observed() > 0 || mean == 0.0);
    let one_by_one: Tally<E::Float> = grid.cells().iter().filter_map(|&stored| E::cell(stored)).collect();
    assert_eq!(tally, one_by_one);
}
