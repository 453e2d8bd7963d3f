//! Directions in the plane: the cosine and the sine of an angle, the same bits on every platform.

use crate::error::Error;
use crate::rounded;

/// A direction in the plane: a cosine and a sine in units of `2^-62`.
///
/// Each is within `0.51 * 2^-62` of that of the exact sum of the angles (proved, [`scan`](crate::book::scan)), whatever their
/// size.
///
/// ```
/// use mean_information::scan::Direction;
/// let direction = Direction::new(&[0.75, -2.5])?;
/// assert_eq!([direction.cos(), direction.sin()], [-0.17824605564949209, -0.9839859468739369]);
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Direction {
    cos: i64,
    sin: i64,
}

impl Direction {
    /// Finds the direction of the sum of the angles (radians, counter-clockwise from the x axis), added up without
    /// rounding.
    ///
    /// # Errors
    /// [`Error::Item`] naming the first angle that is not finite.
    pub fn new(angles: &[f64]) -> Result<Self, Error> {
        let mut sum = 0_u128;
        for (index, &value) in angles.iter().enumerate() {
            if !value.is_finite() {
                return Err(Error::Item { what: "angle", index, value, allowed: "finite, in radians" });
            }
            // In units of 2^-128 turns, within 2 of them, which wrap as angles do: `scan.md`, "Which cells", 1.
            sum = sum.wrapping_add(rounded::turns(value));
        }
        Ok(Self::of_turns(sum))
    }

    /// Finds the direction of an angle in turns modulo 1, in units of `2^-128`.
    #[inline]
    pub(super) fn of_turns(turns: u128) -> Self {
        // To units of 2^-62, within 0.51 of them.
        let [cos, sin] = rounded::cos_sin(turns);
        Self { cos, sin }
    }

    /// Returns the cosine: an integer of units of `2^-62` rounded once to nearest ([`scan`](crate::book::scan)).
    pub fn cos(self) -> f64 {
        self.cos as f64 / SCALE
    }

    /// Returns the sine: an integer of units of `2^-62` rounded once to nearest ([`scan`](crate::book::scan)).
    pub fn sin(self) -> f64 {
        self.sin as f64 / SCALE
    }

    /// Returns the cosine and the sine in units of `2^-62`.
    pub(super) fn units(self) -> [i64; 2] {
        [self.cos, self.sin]
    }
}

/// `2^62`.
const SCALE: f64 = (1_u64 << 62) as f64;
