//! The limits in closed form (Eq. 7 and its counterpart by area), by piecewise polynomials in 64-bit integers.
//!
//! ```text
//! radial = 1 - K / (α + b)                    K = int_-α^b η(t) dt,    α = z / σ,  b = √(ln 4)
//! area   = 1 - 2 (α K + M) / (α + b)^2        M = int_-α^b t η(t) dt,  η(t) = H(e^(-t^2/2))
//! ```
//!
//! Both depend on `α` alone, and each is one polynomial on each of 233 panels ([`locate`]). The chapter
//! [`closed_form`](crate::book::closed_form) derives the form and proves the bound.

#[rustfmt::skip] // as `proofs/limit_tables.py` writes it
mod tables;

use super::weight::Weight;
use crate::real::Real;
use crate::rounded::{horner, normalised, round_integer, shift_right};
use crate::sensor::GaussianSensor;
use tables::Polynomial;

/// The first octave `[2^octave, 2^(octave + 1))` of `α` that has panels of its own.
const LOWEST: i32 = -24;
/// The last octave of `α` that has panels of its own.
const HIGHEST: i32 = 3;
/// The logarithm of the number of panels in an octave: `2^3`.
const SPLIT: u32 = 3;
/// The number of panels: one for all lower octaves, eight for each octave, and eight for all higher octaves.
const PANELS: usize = BEYOND + (1 << SPLIT);
/// The first panel of the higher octaves.
const BEYOND: usize = 1 + (((HIGHEST - LOWEST + 1) as usize) << SPLIT);

/// Computes the limit of the mean information of one reading as cells shrink, in bits per observed cell: Eq. 7 for polar
/// maps, and its counterpart by area for Cartesian grids.
///
/// With `α = z / σ`, `b = √(ln 4)` and the Bernoulli entropy `H` of Eq. 1, in bits,
///
/// ```text
/// radial = 1 - K / (α + b)                        K = int_-α^b H(e^(-t^2/2)) dt
/// area   = 1 - 2 (α K + M) / (α + b)^2            M = int_-α^b t H(e^(-t^2/2)) dt
/// ```
///
/// Error: at most 0.501 ulp in `f32` and `f64`, for every sensor (proved in the chapter
/// [`closed_form`](crate::book::closed_form), with its tables by ball arithmetic). `α` is the exact quotient of the two floats: it may overflow or underflow.
///
/// The result is in `[0.357, 1]` (radial) or `[0.230, 1]` (area). As `α` falls to 0 it tends to 0.4258 or 0.2308; it rises with
/// `α` from 1.903 or 2.550 on, but not everywhere below (same chapter). It is 1 where 1 is the nearest float: in `f64` from
/// `α = 4.3e16` or `8.5e16` on.
///
/// ```
/// use mean_information::limit::{Weight, closed_form};
/// use mean_information::sensor::GaussianSensor;
///
/// let sensor = GaussianSensor::new(2.0_f64, 0.2)?; // metres
/// assert_eq!(closed_form(&sensor, Weight::Radial), 0.7893368880256514);
/// assert_eq!(closed_form(&sensor, Weight::Area), 0.6525109529727351);
/// # Ok::<(), mean_information::Error>(())
/// ```
pub fn closed_form<T: Real>(sensor: &GaussianSensor<T>, weight: Weight) -> T {
    round_integer(value(sensor, weight), -120, false)
}

/// Evaluates the limit, scale 120, with an error below `2^-65` (theorem *closed form*).
fn value<T: Real>(sensor: &GaussianSensor<T>, weight: Weight) -> u128 {
    let (panel, y) = locate(sensor.range(), sensor.sigma());
    let table: &[Polynomial; PANELS] = match weight {
        Weight::Radial => &tables::RADIAL,
        Weight::Area => &tables::AREA,
    };
    let (middle, slopes) = table[panel];
    // The polynomial is within 2^-67 of the limit (Arb); y is a unit of 2^-64 too small at most, times a slope below 2^-4:
    // 2^-68; Horner's floors are below a unit of 2^-67.
    let rise = i128::from(horner(slopes, y, 64)) * i128::from(y);
    // Scale 67 + 64 = 131 becomes 120: the last floor, 2^-120.
    (middle as i128 + (rise >> 11)) as u128
}

/// Finds the panel of `α = range / sigma`, and `y`, the distance from the middle of the panel in widths of it, in
/// `[-1/2, 1/2)`: scale 64, at most one unit too small.
fn locate<T: Real>(range: T, sigma: T) -> (usize, i64) {
    let ((z, z_exponent), (s, s_exponent)) = (normalised(range), normalised(sigma));
    // α = z / s 2^e, and z / s is in (1/2, 2).
    let e = z_exponent - s_exponent;
    let octave = e - i32::from(z < s);
    // The place among the panels from the first of the octave, scale 64: exact except for the floor of one division.
    let (first, place) = if octave < LOWEST {
        (0, scaled(z, e - LOWEST + 64) / u128::from(s))
    } else if octave <= HIGHEST {
        // (α / 2^octave - 1) 2^SPLIT: eight panels of equal width in α.
        let rise = (z << (e - octave)) - s;
        (1 + (((octave - LOWEST) as usize) << SPLIT), (u128::from(rise) << (SPLIT + 64)) / u128::from(s))
    } else {
        // Panels of equal width in 1/α, from 0 to 2^-4; rounded up and less one, so that the upper end does not start another.
        let shift = HIGHEST + 1 + SPLIT as i32 + 64;
        (BEYOND, scaled(s, shift - e).saturating_sub(1) / u128::from(z))
    };
    // The fraction of the place is y + 1/2: flipping its top bit subtracts 1/2 in two's complement.
    (first + (place >> 64) as usize, (place as u64 ^ 1 << 63) as i64)
}

/// Computes `floor(m 2^e)`.
fn scaled(m: u64, e: i32) -> u128 {
    if e >= 0 { u128::from(m) << e } else { shift_right(m.into(), -e) }
}

#[cfg(test)]
mod tests;
