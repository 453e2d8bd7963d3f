//! The place of a grid in the world.

use crate::error::{Error, finite, positive};

/// The size of a grid's cells and the place of its lower left corner.
///
/// ```
/// use mean_information::map::Geometry;
/// let geometry = Geometry::new(0.05, [-10.0, -10.0])?;
/// assert_eq!(geometry.cell_area(), 0.0025000000000000005);
/// assert!(Geometry::new(0.0, [0.0, 0.0]).is_err());
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geometry {
    resolution: f64,
    origin: [f64; 2],
    yaw: f64,
}

impl Geometry {
    /// Creates the geometry of square cells of side `resolution` (metres) from `origin` (x, y in metres), the corner of
    /// row 0 and column 0.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the resolution is not positive and finite, or the origin not finite.
    pub fn new(resolution: f64, origin: [f64; 2]) -> Result<Self, Error> {
        let resolution = positive("resolution", resolution)?;
        for x in origin {
            finite("origin", x, "finite, in metres")?;
        }
        Ok(Self { resolution, origin, yaw: 0.0 })
    }

    /// Turns the grid about its origin by `yaw` (radians, counter-clockwise).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the angle is not finite.
    pub fn with_yaw(self, yaw: f64) -> Result<Self, Error> {
        finite("yaw", yaw, "finite, in radians")?;
        Ok(Self { yaw, ..self })
    }

    /// Returns the side of a cell, in metres.
    pub fn resolution(&self) -> f64 {
        self.resolution
    }

    /// Returns the corner of row 0 and column 0: x and y, in metres.
    pub fn origin(&self) -> [f64; 2] {
        self.origin
    }

    /// Returns the angle by which the grid is turned about its origin, in radians.
    pub fn yaw(&self) -> f64 {
        self.yaw
    }

    /// Returns the area of a cell, in square metres.
    pub fn cell_area(&self) -> f64 {
        self.resolution * self.resolution
    }

    /// Creates the geometry with the same origin and cells `k` times as wide.
    pub(crate) fn coarser(&self, k: usize) -> Result<Self, Error> {
        Self::new(self.resolution * k as f64, self.origin)?.with_yaw(self.yaw)
    }
}
