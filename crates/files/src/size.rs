//! The size of a map, checked before anything is allocated for it, and memory that grows with what was read.

use crate::error::{Error, ErrorKind};
use mean_information::map::Geometry;
use std::io::{self, Read};

/// The bytes that are read at a time.
pub(crate) const CHUNK: usize = 1 << 16;

/// Columns and rows, known to be within the limit on cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    /// Columns.
    pub(crate) width: usize,
    /// Rows.
    pub(crate) height: usize,
}

impl Size {
    /// Checks the size that a file claims.
    ///
    /// # Errors
    /// An [`Error`] stating the limit if it has more cells than `max_cells`.
    pub(crate) fn within(width: u64, height: u64, max_cells: u64) -> Result<Self, Error> {
        let cells = u128::from(width) * u128::from(height);
        Self::claimed(width, height, max_cells, || format!("{width} x {height} = {cells} cells,"))
    }

    /// Checks the size of what a file claims to have, in the words of `claim`.
    ///
    /// # Errors
    /// An [`Error`] with the claim and the limit if it has more cells than `max_cells`.
    pub(crate) fn claimed(
        width: u64,
        height: u64,
        max_cells: u64,
        claim: impl FnOnce() -> String,
    ) -> Result<Self, Error> {
        // More cannot be numbered.
        let limit = max_cells.min(isize::MAX as u64);
        if u128::from(width) * u128::from(height) <= u128::from(limit)
            && let (Ok(width), Ok(height)) = (width.try_into(), height.try_into())
        {
            return Ok(Self { width, height });
        }
        // A larger limit may be given; more than can be numbered, no machine holds.
        let kind = if limit == max_cells { ErrorKind::TooLarge } else { ErrorKind::OutOfMemory };
        let value = (u128::from(width) * u128::from(height)).to_string();
        let refused = Error::new(kind, format!("claims {} more than", claim())).with_value(value);
        Err(refused.allowing(" ", format!("the limit of {limit}")))
    }

    /// Returns columns times rows.
    pub(crate) fn cells(self) -> usize {
        self.width * self.height
    }

    /// Places a map of this size, if numbers can say where it lies.
    ///
    /// # Errors
    /// An [`Error`] if the resolution is not positive and finite, the origin or yaw not finite, or the map so large or
    /// so fine that its far corner or its area is not a positive finite number.
    pub(crate) fn placed(self, resolution: f64, origin: [f64; 2], yaw: f64) -> Result<Geometry, Error> {
        let geometry = Geometry::new(resolution, origin)?.with_yaw(yaw)?;
        let side = |cells: usize| cells.max(1) as f64 * resolution;
        let area = side(self.width) * side(self.height);
        let far = (origin[0] + side(self.width)).abs().max((origin[1] + side(self.height)).abs());
        if far.is_finite() && area.is_finite() && geometry.cell_area().is_normal() {
            return Ok(geometry);
        }
        let value = format!(
            "{} x {} cells of {resolution} m from ({}, {})",
            self.width, self.height, origin[0], origin[1]
        );
        let message = format!("{value} are larger or smaller than a number can say");
        let refused = Error::new(ErrorKind::OutOfRange, message).with_value(value);
        Err(refused.allowing("; allowed is ", "a positive finite area"))
    }
}

/// Makes room for `more` cells, doubling but never beyond `total`: memory follows what was read, not what is claimed.
pub(crate) fn reserve<T>(cells: &mut Vec<T>, more: usize, total: usize) -> Result<(), Error> {
    if cells.capacity() - cells.len() < more {
        let room = cells.len().saturating_mul(2).min(total).max(cells.len() + more);
        cells.try_reserve_exact(room - cells.len())?;
    }
    Ok(())
}

/// Reads exactly `count` elements of `bytes` bytes each, in pieces of whole elements of at most [`CHUNK`] bytes.
pub(crate) fn read_pieces(
    mut input: impl Read,
    count: usize,
    bytes: usize,
    mut each: impl FnMut(&[u8]) -> Result<(), Error>,
) -> Result<(), Error> {
    let mut buffer = vec![0; CHUNK];
    let mut left = count;
    while left > 0 {
        let now = left.min(CHUNK / bytes);
        let piece = &mut buffer[..now * bytes];
        input.read_exact(piece)?;
        each(piece)?;
        left -= now;
    }
    Ok(())
}

/// Tells whether the input holds nothing more.
pub(crate) fn at_end(mut input: impl Read) -> io::Result<bool> {
    loop {
        match input.read(&mut [0]) {
            Ok(read) => return Ok(read == 0),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_limit_counts_cells_and_cannot_be_passed_by_overflow() {
        assert_eq!(Size::within(5, 7, 35).unwrap(), Size { width: 5, height: 7 });
        let refused = Size::within(5, 7, 34).unwrap_err();
        assert_eq!(refused.to_string(), "claims 5 x 7 = 35 cells, more than the limit of 34");
        assert_eq!((refused.kind(), refused.value()), (ErrorKind::TooLarge, Some("35")));
        assert_eq!(refused.allowed(), Some("the limit of 34"));
        let refused = Size::within(1 << 32, 1 << 31, u64::MAX).unwrap_err();
        assert_eq!(refused.kind(), ErrorKind::OutOfMemory);
        let words = format!("cells, more than the limit of {}", isize::MAX);
        assert!(refused.to_string().ends_with(&words), "{refused}");
        assert!(Size::within(1, isize::MAX as u64, u64::MAX).is_ok());
        assert!(Size::within(u64::MAX, u64::MAX, u64::MAX).is_err());
    }

    #[test]
    fn a_map_that_numbers_cannot_place_is_refused() {
        let size = Size { width: 300, height: 200 };
        assert!(size.placed(0.05, [-10.0, 3.0], 0.5).is_ok());
        for (resolution, origin) in [
            (0.0, 0.0),
            (-0.05, 0.0),
            (f64::NAN, 0.0),
            (f64::INFINITY, 0.0),
            (0.05, f64::NAN),
            (1e306, 0.0),
            (1e200, 0.0),
            (1e-200, 0.0),
            (0.05, f64::INFINITY),
        ] {
            assert!(size.placed(resolution, [origin, 0.0], 0.0).is_err(), "{resolution} {origin}");
        }
    }

    #[test]
    fn room_doubles_up_to_the_total() {
        let mut cells = vec![0_u8; 100];
        reserve(&mut cells, 10, 150).unwrap();
        assert!((110..=150).contains(&cells.capacity()), "{}", cells.capacity());
    }
}
