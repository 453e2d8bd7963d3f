//! Inverse sensor models: the occupancy that one range reading gives to a point at a distance `ρ` from the sensor (Eq. 5).

use crate::elementary::{ln, sqrt};
use crate::error::{Error, positive};
use crate::real::Real;
use crate::rounded;
use num_traits::Zero;

/// The occupancy that a reading of a range sensor gives to points along its beam.
///
/// Implement it to build maps from a model of your own. Maps take its values as exact
/// ([`sensor`](crate::book::sensor)). Builders ask for the occupancy at the centres of cells, or at samples, and at 0;
/// [`ScanMap::insert`](crate::scan::ScanMap::insert) also asks at the side of a cell.
///
/// ```
/// use mean_information::sensor::{InverseSensorModel, SteppedSensor};
/// let sensor = SteppedSensor::new(2.0_f64, 0.25, 0.125, 0.875)?;
/// assert_eq!((sensor.plateau(), sensor.reach()), (1.8749999999999998, 2.125)); // metres
/// assert_eq!(sensor.occupancy(1.5), 0.125);
/// # Ok::<(), mean_information::Error>(())
/// ```
pub trait InverseSensorModel {
    /// The type of distances and occupancies.
    type Float: Real;

    /// Returns the occupancy at distance `rho` (metres) from the sensor, in `[0, 1]`; NaN at NaN. That of
    /// [`GaussianSensor`] is correctly rounded, that of [`SteppedSensor`] exact.
    fn occupancy(&self, rho: Self::Float) -> Self::Float;

    /// Returns a distance (metres) beyond which nothing is observed: `occupancy` is exactly 1/2 at every greater `rho`.
    fn reach(&self) -> Self::Float;

    /// Returns a distance (metres) up to which `occupancy` is exactly that at 0. Grid builders count those cells at once,
    /// and [`ScanMap::insert`](crate::scan::ScanMap::insert) gives them the occupancy at 0 without asking for theirs.
    ///
    /// Any such distance is valid; the default is 0. A distance that is too large gives wrong maps.
    fn plateau(&self) -> Self::Float {
        Self::Float::zero()
    }

    /// Returns a distance (metres) up to which `occupancy` is at most `p`, for a `p` that is not below the occupancy at 0.
    /// [`ScanMap::insert`](crate::scan::ScanMap::insert) asks for it at the `p` whose reading is the least it takes, and gives
    /// that reading to the cells up to there.
    ///
    /// Any such distance is valid; the default is the plateau. A distance that is too large gives wrong maps. That of
    /// [`GaussianSensor`] is below `z - σ √(-2 ln p)` by some `8 ε z` (measured), and the model is at most `p` there, by its own,
    /// correctly rounded word (proved in [`sensor`](crate::book::sensor)).
    ///
    /// ```
    /// use mean_information::sensor::{GaussianSensor, InverseSensorModel};
    /// let sensor = GaussianSensor::new(2.5_f64, 0.125)?;
    /// let edge = sensor.free_until(0.25);
    /// assert!((edge - 2.291_861_3).abs() < 1e-6 && sensor.occupancy(edge) <= 0.25); // metres
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    fn free_until(&self, p: Self::Float) -> Self::Float {
        let _ = p;
        self.plateau()
    }

    /// Returns two distances (metres) from and to which `occupancy` is exactly one number, ends included, and that number.
    /// [`ScanMap::insert`](crate::scan::ScanMap::insert) gives it to the cells there without asking for theirs.
    ///
    /// Any such stretch is valid; the default is none. A stretch that is too long gives wrong maps.
    ///
    /// ```
    /// use mean_information::sensor::{InverseSensorModel, SteppedSensor};
    /// let sensor = SteppedSensor::new(2.0_f64, 0.5, 0.25, 0.875)?;
    /// assert_eq!(sensor.obstacle(), Some(([1.75, 2.25], 0.875))); // metres, and the occupancy there
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    fn obstacle(&self) -> Option<([Self::Float; 2], Self::Float)> {
        None
    }
}

/// The number `√(ln 4)`, as `sqrt` and `ln` round it, in either format.
const ROOT_OF_LN_4: f64 = 1.177_410_022_515_474_7;

/// The model of Eq. 5: a range `z` read with Gaussian noise of standard deviation `σ`,
/// `p(ρ) = exp(-((ρ - z) / (σ √2))^2)` for `ρ <= z + σ √(ln 4)`, and 1/2 beyond.
///
/// ```
/// use mean_information::sensor::{GaussianSensor, InverseSensorModel};
/// let sensor = GaussianSensor::new(2.0_f64, 0.2)?;
/// assert_eq!(sensor.occupancy(2.0), 1.0);
/// assert_eq!(sensor.occupancy(1.75), 0.4578333617716143);
/// assert_eq!(sensor.occupancy(2.25), 0.5); // beyond 2 + 0.2 √(ln 4) = 2.2355
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussianSensor<T> {
    range: T,
    sigma: T,
}

impl<T: Real> GaussianSensor<T> {
    /// Creates the model of a reading of `range` with standard deviation `sigma`, both in metres.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if one of them is not positive and finite.
    pub fn new(range: T, sigma: T) -> Result<Self, Error> {
        Ok(Self { range: positive("range", range)?, sigma: positive("sigma", sigma)? })
    }

    /// Returns the range `z`, in metres.
    pub fn range(&self) -> T {
        self.range
    }

    /// Returns the standard deviation `σ`, in metres.
    pub fn sigma(&self) -> T {
        self.sigma
    }
}

impl<T: Real> InverseSensorModel for GaussianSensor<T> {
    type Float = T;

    /// Computes `p(ρ)`, correctly rounded (proved): as if computed exactly from the three floats and rounded once.
    ///
    /// `ρ` may be any float: before the sensor (`ρ < 0`) the formula goes on, to 0 at `-inf`; 1/2 at `inf`; NaN at NaN.
    fn occupancy(&self, rho: T) -> T {
        if rho.is_nan() {
            return rho;
        }
        if rho.is_infinite() {
            return if rho > T::zero() { T::HALF } else { T::zero() };
        }
        let p = rounded::gaussian(rho, self.range, self.sigma);
        // Rounding is monotone: beyond the edge the Gaussian is below 1/2, and its float at most 1/2.
        if rho > self.range && p <= T::HALF { T::HALF } else { p }
    }

    /// Computes `z + σ √(ln 4)`, within 2 ulp and never too short (proved in [`rounding`](crate::book::rounding)):
    /// `occupancy` is 1/2 at every greater float. Infinite where the sum overflows.
    fn reach(&self) -> T {
        let mut reach = self.range + self.sigma * T::nearest(ROOT_OF_LN_4);
        // The roundings may have left it short by two floats. The model falls beyond z: one float at 1/2 speaks for the rest.
        while reach.is_finite() {
            let (m, e) = reach.parts();
            let next = T::from_parts(m + 1, e);
            if self.occupancy(next) == T::HALF {
                break;
            }
            reach = next;
        }
        reach
    }

    /// Returns the distance up to which `p` underflows to 0; the whole free space if `z` is so far below `σ` that `p` rounds
    /// to 1.
    fn plateau(&self) -> T {
        let nearest = self.occupancy(T::zero());
        // e^-r is below half of the smallest number beyond r = n ln 2. Five roundings, of ln 2, its product, the root, the
        // product with sigma and the difference, move the edge by 2 eps z at most: where p is 0 at 0, sigma times the root
        // is below z. If it underflows, the smallest normal number makes up for it; a margin that overflows asks the model.
        let n = T::from_parts((1 - T::MIN_EXPONENT) as u64, 0);
        let two = T::one() + T::one();
        let edge = self.range - self.sigma * sqrt(two * ln(two) * n);
        let margin = self.range * T::from_parts(8, 0) * T::epsilon() + T::min_positive_value();
        let is_flat = |rho: T| {
            if nearest.is_zero() && (rho - edge).abs() > margin {
                rho < edge
            } else {
                self.occupancy(rho) == nearest
            }
        };
        let (mut plateau, mut end) = (T::zero(), self.range);
        // The rounded model does not fall before z: two distances at one occupancy have it between them. Bisection.
        for _ in 0..T::PRECISION {
            let middle = plateau + (end - plateau) * T::HALF;
            if is_flat(middle) {
                plateau = middle;
            } else {
                end = middle;
            }
        }
        plateau
    }

    /// Returns `z - σ √(-2 ln p)`, a little less, for `p < 1/2`: the model says at most `p` there, and does not fall before `z`.
    /// 0 where that is not so by the roundings.
    fn free_until(&self, p: T) -> T {
        if !(p > T::zero() && p < T::HALF) {
            return T::zero();
        }
        let two = T::one() + T::one();
        let edge = self.range - self.sigma * sqrt(-(two * ln(p)));
        // A few roundings of the range, and of the root times sigma, which is below it where the edge is not.
        let edge = edge - self.range * T::from_parts(8, 0) * T::epsilon();
        if edge > T::zero() && self.occupancy(edge) <= p { edge } else { T::zero() }
    }
}

/// The model of steps: free up to the obstacle, occupied over its thickness, unknown behind it
/// (the inverse range sensor model of Thrun, Burgard and Fox, *Probabilistic Robotics*, table 9.2).
///
/// ```
/// use mean_information::sensor::{InverseSensorModel, SteppedSensor};
/// let sensor = SteppedSensor::new(2.0_f64, 0.5, 0.25, 0.875)?;
/// assert_eq!([1.5, 1.75, 2.25, 2.5].map(|rho| sensor.occupancy(rho)), [0.25, 0.875, 0.875, 0.5]);
/// assert_eq!([sensor.near(), sensor.far(), sensor.free(), sensor.occupied()], [1.75, 2.25, 0.25, 0.875]);
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteppedSensor<T> {
    near: T,
    far: T,
    free: T,
    occupied: T,
}

impl<T: Real> SteppedSensor<T> {
    /// Creates the model of a reading of `range` (metres) at an obstacle of the given `thickness` (metres), with the
    /// occupancies of free space and of the obstacle. The obstacle lies from `range - thickness / 2` to `range + thickness / 2`, each rounded once, ends
    /// included.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if `range` or `thickness` is not positive and finite, `free` not in `[0, 1/2]`, or `occupied` not in
    /// `[1/2, 1]`.
    pub fn new(range: T, thickness: T, free: T, occupied: T) -> Result<Self, Error> {
        let (range, thickness) = (positive("range", range)?, positive("thickness", thickness)?);
        if !(free >= T::zero() && free <= T::HALF) {
            return Err(Error::out_of_range("occupancy of free space", free.widen(), "0 to 1/2"));
        }
        if !(occupied >= T::HALF && occupied <= T::one()) {
            return Err(Error::out_of_range("occupancy of the obstacle", occupied.widen(), "1/2 to 1"));
        }
        let half = thickness * T::HALF;
        Ok(Self { near: range - half, far: range + half, free, occupied })
    }

    /// Returns the distance at which the obstacle begins, in metres: negative if it holds the sensor.
    pub fn near(&self) -> T {
        self.near
    }

    /// Returns the distance at which the obstacle ends, in metres.
    pub fn far(&self) -> T {
        self.far
    }

    /// Returns the occupancy of free space.
    pub fn free(&self) -> T {
        self.free
    }

    /// Returns the occupancy of the obstacle.
    pub fn occupied(&self) -> T {
        self.occupied
    }

    /// Returns the stretches of a beam that are observed, nearest first, each with its occupancy.
    pub(crate) fn observed(&self) -> impl Iterator<Item = ([T; 2], T)> {
        let near = self.near.max(T::zero());
        let stretches = [([T::zero(), near], self.free), ([near, self.far], self.occupied)];
        stretches.into_iter().filter(|&([from, to], p)| from < to && p != T::HALF)
    }
}

impl<T: Real> InverseSensorModel for SteppedSensor<T> {
    type Float = T;

    fn occupancy(&self, rho: T) -> T {
        if rho.is_nan() {
            rho
        } else if rho < self.near {
            self.free
        } else if rho <= self.far {
            self.occupied
        } else {
            T::HALF
        }
    }

    fn reach(&self) -> T {
        self.far
    }

    fn obstacle(&self) -> Option<([T; 2], T)> {
        Some(([self.near, self.far], self.occupied))
    }

    fn plateau(&self) -> T {
        if self.near > T::zero() {
            let (m, e) = self.near.parts();
            T::from_parts(m - 1, e)
        } else {
            self.far
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_root_is_that_of_the_logarithm_in_either_format() {
        fn computed<T: Real>() -> T {
            let two = T::one() + T::one();
            sqrt(two * ln(two))
        }
        assert_eq!(ROOT_OF_LN_4, computed::<f64>());
        assert_eq!(f32::nearest(ROOT_OF_LN_4), computed::<f32>());
    }
}
