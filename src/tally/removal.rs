//! Cells taken out of a tally again: its sums are integers, so that what was added can be subtracted without any error.

use super::Tally;
use crate::cell::{Cell, State};
use crate::error::Error;
use crate::real::Real;

impl<T: Real> Tally<T> {
    /// Takes one cell out of the tally again: the exact inverse of [`Tally::add`].
    ///
    /// # Errors
    /// As [`Tally::remove_many`].
    pub fn remove(&mut self, cell: Cell<T>) -> Result<(), Error> {
        self.remove_many(cell, 1)
    }

    /// Takes `count` equal cells out of the tally again: the exact inverse of [`Tally::add_many`], to the bits of a tally that
    /// never had them.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the tally holds fewer cells of that state, or less entropy or information than they have: such
    /// cells were never added. Then the tally has not changed. Other cells that were never added cannot be told from those that
    /// were; the sums then are those of the cells added, less those of the cells removed.
    ///
    /// ```
    /// use mean_information::{Tally, cell::Cell};
    /// let mut tally = Tally::from_occupancies(&[0.25, 0.5, 0.96875]);
    /// tally.remove_many(Cell::from_occupancy(0.25)?, 1)?;
    /// assert_eq!(tally, Tally::from_occupancies(&[0.5, 0.96875]));
    /// assert!(tally.remove_many(Cell::unknown(), 2).is_err());
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn remove_many(&mut self, cell: Cell<T>, count: u64) -> Result<(), Error> {
        let held = match cell.state() {
            State::Unknown => &mut self.unknown,
            State::Free => &mut self.free,
            State::Occupied => &mut self.occupied,
        };
        // Checked before anything changes.
        let Some(left) = held.checked_sub(count) else {
            let allowed = "at most those of that state in the tally";
            return Err(Error::out_of_range("number of cells to remove", count as f64, allowed));
        };
        // Both or neither.
        let mut entropy = self.entropy.clone();
        // The integers that add_many added: subtracting them leaves no trace.
        entropy.remove_many(cell.entropy(), count)?;
        self.information.remove_many(cell.information(), count)?;
        (self.entropy, *held) = (entropy, left);
        Ok(())
    }
}
