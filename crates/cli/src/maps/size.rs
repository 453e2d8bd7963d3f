//! The size of a map, checked before anything is allocated for it, and memory that grows with what was read.

use super::Fault;
use mean_information::map::Geometry;
use std::io::{self, Read};

/// How many bytes are read at a time.
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
    /// The size a file claims.
    ///
    /// # Errors
    /// A [`Fault`] stating the limit if it has more cells than `max_cells`.
    pub(crate) fn within(width: u64, height: u64, max_cells: u64) -> Result<Self, Fault> {
        let cells = u128::from(width) * u128::from(height);
        Self::claimed(width, height, max_cells, || format!("{width} x {height} = {cells} cells,"))
    }

    /// The size of what a file claims to have.
    ///
    /// # Errors
    /// A [`Fault`] with the claim and the limit if it has more cells than `max_cells`.
    pub(crate) fn claimed(
        width: u64,
        height: u64,
        max_cells: u64,
        claim: impl FnOnce() -> String,
    ) -> Result<Self, Fault> {
        // More cannot be numbered.
        let limit = max_cells.min(isize::MAX as u64);
        if u128::from(width) * u128::from(height) <= u128::from(limit)
            && let (Ok(width), Ok(height)) = (width.try_into(), height.try_into())
        {
            return Ok(Self { width, height });
        }
        let raise = if limit == max_cells { "; raise it with --max-cells if the file is meant" } else { "" };
        Err(Fault::new(format!("claims {} more than the limit of {limit}{raise}", claim())))
    }

    /// Columns times rows.
    pub(crate) fn cells(self) -> usize {
        self.width * self.height
    }

    /// Where a map of this size lies, if numbers can say it.
    ///
    /// # Errors
    /// A [`Fault`] if the resolution is not positive and finite, the origin or yaw not finite, or the map so large or
    /// so fine that its far corner or its area is not a positive finite number.
    pub(crate) fn placed(self, resolution: f64, origin: [f64; 2], yaw: f64) -> Result<Geometry, Fault> {
        let geometry = Geometry::new(resolution, origin)?.with_yaw(yaw)?;
        let side = |cells: usize| cells.max(1) as f64 * resolution;
        let area = side(self.width) * side(self.height);
        let far = (origin[0] + side(self.width)).abs().max((origin[1] + side(self.height)).abs());
        if far.is_finite() && area.is_finite() && geometry.cell_area().is_normal() {
            return Ok(geometry);
        }
        Err(Fault::new(format!(
            "{} x {} cells of {resolution} m from ({}, {}) are larger or smaller than a number can say; \
             allowed is a positive finite area",
            self.width, self.height, origin[0], origin[1]
        )))
    }
}

/// So many cells, in words.
pub(crate) fn cells_in_words(count: u64) -> String {
    if count == 1 { "1 cell".to_owned() } else { format!("{count} cells") }
}

/// Makes room for `more` cells, doubling but never beyond `total`: memory follows what was read, not what is claimed.
pub(crate) fn reserve<T>(cells: &mut Vec<T>, more: usize, total: usize) -> Result<(), Fault> {
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
    mut each: impl FnMut(&[u8]) -> Result<(), Fault>,
) -> Result<(), Fault> {
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

/// Whether the input holds nothing more.
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
        assert_eq!(Size::within(5, 7, 35), Ok(Size { width: 5, height: 7 }));
        let refused = Size::within(5, 7, 34).unwrap_err().to_string();
        assert!(refused.contains("5 x 7 = 35 cells") && refused.contains("limit of 34"), "{refused}");
        assert!(
            refused.ends_with("limit of 34; raise it with --max-cells if the file is meant"),
            "{refused}"
        );
        let refused = Size::within(1 << 32, 1 << 31, u64::MAX).unwrap_err().to_string();
        assert!(refused.ends_with(&format!("cells, more than the limit of {}", isize::MAX)), "{refused}");
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
