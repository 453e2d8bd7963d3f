//! Bounds on the distance between the mean information of a grid of the circular room and its limit: bounds before the grid
//! is counted, and sharper ones for a known number of observed cells.
//!
//! With cells of side `h` and `x = L / h`, `L = z + σ √(ln 4)`, all of them are
//!
//! ```text
//! |Ī_h - Ī| <= (E_I + Ī E_N) / N,
//! ```
//!
//! where `Ī_h` is the mean information of the grid and `Ī` its limit, `E_I` bounds the error of the sum of information, `E_N`
//! that of the number of observed cells, and `N` is that number or a lower bound of it. The proofs are the chapter
//! [`convergence`](crate::book::convergence), whose symbols are used here. All arithmetic is rounded outwards, in `f64`.

use super::closed_form::closed_form;
use super::upwards::Up;
use super::weight::Weight;
use crate::cell::information;
use crate::error::{Error, positive};
use crate::real::Real;
use crate::sensor::{GaussianSensor, InverseSensorModel};
use num_traits::float::FloatCore;

/// The floats below and above `b = √(ln 4)`, the far edge in standard deviations.
const EDGE: [f64; 2] = [1.177_410_022_515_474_7, 1.177_410_022_515_474_9];
/// The floats below and above `π`.
const PI: [f64; 2] = [core::f64::consts::PI, core::f64::consts::PI.next_up()];
/// A bound on `max |η'|`, the steepest slope of the information over `t`.
const STEEPEST: Up = Up(1.32404);
/// A bound on `W`, the total variation of `η'`.
const BEND: Up = Up(6.7619);

/// Bounds the distance of the mean information `Ī_h` of a polar map of the circular room from its limit `Ī`, the radial one
/// (Eq. 7); in bits per cell, and not above 1. The map has rings of width `resolution`, `h` (metres), sampled at their centres:
/// [`PolarRoom`](crate::room::PolarRoom).
///
/// ```text
/// |Ī_h - Ī| <= (E_I + Ī (E_N + N_½)) / (x - E_N - N_½),
/// E_N = 1/2 + w,  E_I = min(V E_N, W h / (8 σ)),  x = L/h
/// ```
///
/// with `V = 2 + f(0)` if `z > σ √(ln 4)`, else `2 - f(0)`, where `f(0)` is the information at the sensor; `W = 6.7619`; `N_½`
/// the number of rings whose centre lies on `ρ = z - σ √(ln 4)`, where `p = 1/2`: computed, mostly 0. `w` and the terms not
/// shown are of the order of the rounding of the grid's cells in `T`; they are included.
///
/// Proved ([`convergence`](crate::book::convergence)), for every sensor and resolution; rounded up.
///
/// # Errors
/// [`Error::OutOfRange`] if the resolution is not positive and finite.
///
/// ```
/// use mean_information::room::PolarRoom;
/// use mean_information::limit::{Weight, bounds, closed_form};
/// use mean_information::sensor::GaussianSensor;
/// let sensor = GaussianSensor::new(2.0_f64, 0.2)?;
/// let error = PolarRoom::new(sensor, 0.01)?.tally()?.mean_information() - closed_form(&sensor, Weight::Radial);
/// assert_eq!(error, -0.0015928739679037518);
/// assert_eq!(bounds::polar(&sensor, 0.01)?, 0.001958905376202138);
/// # Ok::<(), mean_information::Error>(())
/// ```
pub fn polar<T: Real>(sensor: &GaussianSensor<T>, resolution: T) -> Result<T, Error> {
    let room = Room::new(sensor, resolution, Weight::Radial)?;
    let beam = room.beam();
    Ok(beam.before_counting(room.limit, room.rings_at_one_half()))
}

/// Bounds `|Ī_h - Ī|` for a polar map of which the number `N` of observed rings is known.
///
/// ```text
/// |Ī_h - Ī| <= (E_I + Ī |N - x|) / N
/// ```
///
/// with `E_I` and `x` as in [`polar`].
///
/// Proved ([`convergence`](crate::book::convergence)), and rounded up.
///
/// # Errors
/// Those of [`polar`].
///
/// ```
/// use mean_information::room::PolarRoom;
/// use mean_information::limit::bounds;
/// use mean_information::sensor::GaussianSensor;
/// let sensor = GaussianSensor::new(2.0_f64, 0.2)?;
/// let tally = PolarRoom::new(sensor, 0.01)?.tally()?;
/// assert_eq!(tally.observed(), 224); // of 223.548 by length
/// assert_eq!(bounds::polar_with_count(&sensor, 0.01, tally.observed())?, 0.0017807318105608533);
/// # Ok::<(), mean_information::Error>(())
/// ```
pub fn polar_with_count<T: Real>(
    sensor: &GaussianSensor<T>,
    resolution: T,
    observed: u64,
) -> Result<T, Error> {
    let room = Room::new(sensor, resolution, Weight::Radial)?;
    Ok(room.beam().with_count(room.limit, observed))
}

/// Bounds the distance of the mean information `Ī_h` of a Cartesian grid of the circular room from its limit `Ī`, the area
/// limit; in bits per cell, and not above 1. Its cells are of side `resolution`, `h` (metres), sampled at their centres, wherever
/// they lie: [`CartesianRoom`](crate::room::CartesianRoom).
///
/// ```text
/// |Ī_h - Ī| <= (E_I + Ī (E_N + N_½)) / (π x^2 - E_N - N_½),
/// E_N = D + 7 x w,  D = min(2 x + 1.72 √x + 1, 7.14 x^(2/3) + 1/2 from x = 5 on),
/// E_I = min(V E_N, 0.8403 (8.086 √x h/σ + 2 V / √x)),
/// N_½ = 2 + 6.31 r^(2/3),  r = z/h - √(ln 4) σ/h
/// ```
///
/// with `x`, `V` and `w` as in [`polar`]; `D` bounds the error of counting the cells in a disc, and `N_½` how many cell
/// centres can lie on the circle of radius `r` cells where `p = 1/2`: 0 if `r < 0`, and slightly more than `2 E_N` if cells
/// are so fine that rounding widens the circle.
///
/// So the error falls at least as fast as `h^(4/3)`.
///
/// Proved ([`convergence`](crate::book::convergence)), for every sensor, resolution and offset; rounded up.
///
/// # Errors
/// [`Error::OutOfRange`] if the resolution is not positive and finite.
///
/// ```
/// use mean_information::room::CartesianRoom;
/// use mean_information::limit::{Weight, bounds, closed_form};
/// use mean_information::sensor::GaussianSensor;
/// let sensor = GaussianSensor::new(2.0_f64, 0.2)?;
/// let tally = CartesianRoom::new(sensor, 0.01, [0.5, 0.5])?.tally()?;
/// assert_eq!(tally.mean_information() - closed_form(&sensor, Weight::Area), -7.769584712724598e-5);
/// assert_eq!(bounds::cartesian(&sensor, 0.01)?, 0.001968805442307659);
/// # Ok::<(), mean_information::Error>(())
/// ```
pub fn cartesian<T: Real>(sensor: &GaussianSensor<T>, resolution: T) -> Result<T, Error> {
    let room = Room::new(sensor, resolution, Weight::Area)?;
    let disc = room.disc();
    Ok(disc.before_counting(room.limit, room.cells_at_one_half(disc.miscount)))
}

/// Bounds `|Ī_h - Ī|` for a Cartesian grid of which the number `N` of observed cells is known.
///
/// ```text
/// |Ī_h - Ī| <= (E_I + Ī |N - π x^2|) / N
/// ```
///
/// with `E_I` and `x` as in [`cartesian`]. Most of a grid's error is the second term: the error of the sum of information
/// falls like `h^(5/2)`.
///
/// Proved ([`convergence`](crate::book::convergence)), and rounded up.
///
/// # Errors
/// That of [`cartesian`].
///
/// ```
/// use mean_information::room::CartesianRoom;
/// use mean_information::limit::bounds;
/// use mean_information::sensor::GaussianSensor;
/// let sensor = GaussianSensor::new(2.0_f64, 0.2)?;
/// let tally = CartesianRoom::new(sensor, 0.01, [0.5, 0.5])?.tally()?;
/// assert_eq!(bounds::cartesian_with_count(&sensor, 0.01, tally.observed())?, 0.00011214103522213827);
/// # Ok::<(), mean_information::Error>(())
/// ```
pub fn cartesian_with_count<T: Real>(
    sensor: &GaussianSensor<T>,
    resolution: T,
    observed: u64,
) -> Result<T, Error> {
    let room = Room::new(sensor, resolution, Weight::Area)?;
    Ok(room.disc().with_count(room.limit, observed))
}

/// The quantities of a room from which the bounds are made. Lengths are in cells.
struct Room {
    /// The range `z` over the resolution, below and above.
    range: [f64; 2],
    /// The deviation `σ` over the resolution, below and above.
    sigma: [f64; 2],
    /// The reach `L` over the resolution, below and above.
    radius: [f64; 2],
    /// The total variation `V` of the information.
    variation: Up,
    /// The limit `Ī`.
    limit: Up,
    /// The unit roundoff `u = 2^-P`: numbers are rounded by at most `u` times their value, occupancies by half of that.
    unit: Up,
    /// The bound `ε` on the change of a cell's information by the rounding of its occupancy, of itself, and of the mean.
    rounding: Up,
}

/// The observed part of a grid: cells along a beam, or in a disc.
struct Observed {
    /// The observed length or area `Ω` in cells, below and above.
    size: [f64; 2],
    /// The bound `E_N` on the difference of the count from `Ω`.
    miscount: Up,
    /// The bound `E_I` on the error of the sum of information.
    information: Up,
}

/// Encloses `a / b` for positive numbers: below and above.
fn enclosed_ratio(a: f64, b: f64) -> [f64; 2] {
    [(a / b).next_down().max(0.0), (a / b).next_up()]
}

impl Room {
    /// Computes the quantities of the room of a sensor.
    fn new<T: Real>(sensor: &GaussianSensor<T>, resolution: T, weight: Weight) -> Result<Self, Error> {
        let resolution = positive("resolution", resolution)?.widen();
        let bits = T::PRECISION as i32;
        // Distances below the normal range are rounded by more. Floats that hold no distances of the room give no bound.
        let smallest = T::from_parts(1, T::MIN_EXPONENT).widen();
        let spacing = (smallest / (sensor.range().widen() + sensor.sigma().widen())).next_up();
        let unit = f64::from_parts(1, -bits).max(spacing);
        let unit = Up(if unit > 1.0 / 1024.0 { f64::INFINITY } else { unit });
        // ε = (P + 5) u / 2: convergence.md, "Rounding".
        let rounding = Up(f64::from(bits + 5) / 2.0) * unit;
        let range = enclosed_ratio(sensor.range().widen(), resolution);
        let sigma = enclosed_ratio(sensor.sigma().widen(), resolution);
        let radius = [
            (range[0] + (sigma[0] * EDGE[0]).next_down()).next_down(),
            (Up(range[1]) + Up(sigma[1]) * Up(EDGE[1])).0,
        ];
        // The float tells the sign of z - σ √(ln 4): it is 1/2 only where the information is 0, but for the rounding.
        let at_the_sensor = sensor.occupancy(T::zero());
        let information = information(at_the_sensor).widen();
        let change = if at_the_sensor > T::HALF { -information } else { information };
        let variation = Up((2.0 + change).next_up()) + rounding;
        // The closed form is less than an ulp below.
        let limit = (Up(closed_form(sensor, weight).widen()) * (Up(1.0) + Up(2.0) * unit)).or(Up(1.0));
        Ok(Self { range, sigma, radius, variation, limit, unit, rounding })
    }

    /// Returns the reach `L`, above.
    fn radius(&self) -> Up {
        Up(self.radius[1])
    }

    /// Bounds the distance `w` by which rounding can move a circle of the model: `u L` by the distances of the cells,
    /// `0.86 u σ` by the occupancies of 1/2.
    fn shift(&self) -> Up {
        Up(2.0) * self.unit * self.radius()
    }

    /// Bounds the change of one cell's information by the rounding of its distance, for the bound of second order.
    fn displacement(&self) -> Up {
        STEEPEST * self.shift() / self.sigma[0]
    }

    /// Bounds count and sum along a beam of the polar map, of cells of width 1.
    fn beam(&self) -> Observed {
        let miscount = Up(0.5) + self.shift();
        let cells = self.radius() + miscount;
        // First order: V E_N; second order: W h / (8 σ), by the kernel of the midpoint rule: convergence.md, "The sum of information".
        let first = self.variation * miscount;
        let second = BEND * Up(0.125) / self.sigma[0] + self.displacement() * cells;
        Observed { size: self.radius, miscount, information: first.or(second) + self.rounding * cells }
    }

    /// Bounds count and sum in the disc of the Cartesian grid, of cells of area 1.
    fn disc(&self) -> Observed {
        let radius = self.radius();
        let size = [
            ((self.radius[0] * self.radius[0]).next_down() * PI[0]).next_down(),
            (radius * radius * Up(PI[1])).0,
        ];
        // π (2 x w + w^2) < 7 x w: convergence.md, "Rounding".
        let ring = Up(7.0) * radius * self.shift();
        let miscount = points_in_a_disc(radius + self.shift()) + ring;
        let cells = Up(size[1]) + miscount;
        let first = self.variation * miscount;
        let root = radius.sqrt();
        let bend = (BEND + STEEPEST) * root / self.sigma[0];
        let second = Up(0.8403) * (bend + Up(2.0) * self.variation * root / self.radius[0]);
        let second = second + self.displacement() * cells;
        Observed { size, miscount, information: first.or(second) + self.rounding * cells }
    }

    /// Encloses the radius `z - σ √(ln 4)` of the circle where `p = 1/2`, in cells, as far as rounding can move it; an end may
    /// be negative.
    fn ring(&self) -> [f64; 2] {
        let wide = self.shift().0;
        let near = self.range[0] - (self.sigma[1] * EDGE[1]).next_up();
        let far = self.range[1] - (self.sigma[0] * EDGE[0]).next_down();
        [(near.next_down() - wide).next_down(), (far.next_up() + wide).next_up()]
    }

    /// Counts the centres `k + 1/2` of rings that can lie on the circle where `p = 1/2`.
    fn rings_at_one_half(&self) -> Up {
        let [near, far] = self.ring();
        let first = FloatCore::ceil((near - 0.5).next_down()).max(0.0);
        let last = FloatCore::floor((far - 0.5).next_up());
        if last < first { Up(0.0) } else { Up(last - first) + Up(1.0) }
    }

    /// Bounds the number of centres of cells on the circle where `p = 1/2`: lattice points on a circle.
    fn cells_at_one_half(&self, miscount: Up) -> Up {
        let far = self.ring()[1];
        if far < 0.0 {
            return Up(0.0);
        }
        let radius = self.radius();
        if (Up(2048.0) * self.unit * radius * radius).0 <= 1.0 {
            Up(6.31) * Up(far).two_thirds_power() + Up(2.0)
        } else {
            Up(2.0) * miscount + Up(14.0) * radius * self.shift()
        }
    }
}

/// Bounds the error of counting the points of a shifted unit lattice in a disc of the given radius.
fn points_in_a_disc(radius: Up) -> Up {
    let by_columns = Up(2.0) * radius + Up(1.72) * radius.sqrt() + Up(1.0);
    if radius.0 < 5.0 {
        return by_columns;
    }
    by_columns.or(Up(7.14) * radius.two_thirds_power() + Up(0.5))
}

impl Observed {
    /// Computes the bound for every possible count, of which `unobserved` cells can be missing.
    fn before_counting<T: Real>(&self, limit: Up, unobserved: Up) -> T {
        let missing = self.miscount + unobserved;
        self.bound(limit, missing, (self.size[0] - missing.0).next_down())
    }

    /// Computes the bound for this count.
    fn with_count<T: Real>(&self, limit: Up, observed: u64) -> T {
        let count = observed as f64;
        let [below, above] = self.size;
        // The conversion to a float rounds.
        let miscount = (count.next_up() - below).max(above - count.next_down()).next_up();
        self.bound(limit, Up(miscount), count.next_down())
    }

    /// Computes `(E_I + Ī miscount) / count` for a lower bound of the count; 1 where that is no bound.
    fn bound<T: Real>(&self, limit: Up, miscount: Up, count: f64) -> T {
        if count <= 0.0 {
            return T::one();
        }
        let bound = ((self.information + limit * miscount) / count).0;
        let rounded = T::nearest(bound);
        // The next float of T: a comparison with NaN leaves 1.
        let (m, e) = rounded.parts();
        let above = if rounded.widen() < bound { T::from_parts(m + 1, e) } else { rounded };
        if above < T::one() { above } else { T::one() }
    }
}

#[cfg(test)]
mod tests;
