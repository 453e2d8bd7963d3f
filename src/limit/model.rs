//! Radial models: the integrand of the continuous mean information (Eq. 6), written once for floats, intervals and
//! rectangles.

use alloc::vec;
use alloc::vec::Vec;

use crate::real::Real;
use crate::scalar::Scalar;
use crate::sensor::{GaussianSensor, SteppedSensor};

/// A stretch of `t` from `start` to `start + length`, over which the entropy is smooth but perhaps at its start.
///
/// A negative length runs towards smaller `t`. A singularity, or a bump much narrower than the piece, may lie at the
/// start: the adaptive integral begins with panels that shrink towards it. Elsewhere it sees a narrow bump only if that
/// is the only thing in the piece: beside it the entropy is 0 to the floats.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece<S> {
    /// The start.
    pub start: S,
    /// The length, with its sign.
    pub length: S,
    /// The number of panels that the adaptive integral begins with, each an eighth of the one before: enough for the
    /// smallest to be no wider than what is to be seen at the start. At least 1.
    pub panels: usize,
    /// True if the piece stands for two stretches: itself and its mirror image about `t = 0`, with the same entropy at
    /// `-t` as at `t`. They are integrated at once, at half the work.
    pub mirrored: bool,
}

impl<S: Scalar> Piece<S> {
    /// Creates a piece of the given start, length and number of panels.
    pub fn new(start: S, length: S, panels: usize) -> Self {
        Self { start, length, panels, mirrored: false }
    }

    /// Returns the piece together with its mirror image about `t = 0`.
    #[must_use]
    pub fn mirrored(self) -> Self {
        Self { mirrored: true, ..self }
    }
}

/// The entropy of the occupancy along a beam after one sensor reading, or several.
///
/// Distances are `ρ = origin + scale t`, so that `t` can be small where `ρ` is large and its digits would be lost. The
/// pieces together are the observed stretch, without overlap. Derived in [`limit`](crate::book::limit) (Eq. 6).
///
/// ```
/// use mean_information::limit::RadialModel;
/// use mean_information::sensor::GaussianSensor;
/// let sensor = GaussianSensor::new(2.0_f64, 0.2)?;
/// assert_eq!((sensor.origin(), sensor.scale()), (2.0, 0.2)); // metres
/// // Behind the range, and as far before it.
/// let pieces = sensor.pieces::<f64>();
/// assert_eq!((pieces[0].start, pieces[0].mirrored), (0.0, true));
/// assert_eq!(sensor.entropy(0, 0.75_f64), 0.8035170368928104); // bits, at 2.15 m and at 1.85 m
/// # Ok::<(), mean_information::Error>(())
/// ```
pub trait RadialModel {
    /// The type of the distances.
    type Float: Real;

    /// Returns the distance (metres) at `t = 0`, exactly.
    fn origin(&self) -> Self::Float;

    /// Returns the metres per unit of `t`, exactly; positive.
    fn scale(&self) -> Self::Float;

    /// Returns the pieces of the observed stretch, their ends computed in `S`: as intervals they contain the exact
    /// ones.
    fn pieces<S: Scalar>(&self) -> Vec<Piece<S>>;

    /// Returns the entropy (bits) of the occupancy at `t`, within the piece of the given index.
    fn entropy<S: Scalar>(&self, piece: usize, t: S) -> S;
}

/// Returns `√(ln 4)`, where the Gaussian has fallen to 1/2.
pub(super) fn half_width<S: Scalar>() -> S {
    (S::constant(2.0) * S::ln_2()).sqrt()
}

/// Returns `z / σ` of a sensor.
pub(super) fn ratio<T: Real, S: Scalar>(sensor: &GaussianSensor<T>) -> S {
    S::constant(sensor.range().widen()) / S::constant(sensor.sigma().widen())
}

/// Returns the negative logarithm of the Gaussian, `t^2 / 2`.
pub(super) fn exponent<S: Scalar>(t: S) -> S {
    S::constant(0.5) * t.clone() * t
}

/// Beyond this many `σ` the entropy is below `2^-97`: nothing there but a tail.
const TAIL: f64 = 12.0;

/// The longer side of `z`, of the side of the sensor (`z / σ`) and the far one (`√(ln 4)`).
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Longer {
    Near,
    Far,
    /// Neither for certain: they differ by roundings at most, so that their difference may have either sign.
    Neither,
}

impl Longer {
    /// Compares the sides of a sensor's range.
    pub(super) fn of<T: Real>(sensor: &GaussianSensor<T>) -> Self {
        // Root, quotient and quotient of both err by less than 2 epsilon together.
        let excess = ratio::<T, f64>(sensor) / half_width::<f64>() - 1.0;
        match excess {
            _ if excess > 4.0 * f64::EPSILON => Self::Near,
            _ if excess < -4.0 * f64::EPSILON => Self::Far,
            _ => Self::Neither,
        }
    }
}

/// Returns the pieces from `-√(ln 4)` down to the sensor, where that is the longer side: its tail apart.
pub(super) fn beyond<T: Real, S: Scalar>(sensor: &GaussianSensor<T>, panels: usize) -> Vec<Piece<S>> {
    let piece = |end| Piece::new(-half_width::<S>(), half_width::<S>() - end, panels);
    if ratio::<T, f64>(sensor) <= TAIL {
        return vec![piece(ratio(sensor))];
    }
    vec![piece(S::constant(TAIL)), Piece::new(S::constant(-TAIL), S::constant(TAIL) - ratio(sensor), 1)]
}

/// The number of panels about `z`, where the entropy is `t^2 ln |t|`.
const PANELS: usize = 4;

/// The pieces: what both sides of `z` have in common, and what the longer one has beyond.
impl<T: Real> RadialModel for GaussianSensor<T> {
    type Float = T;

    fn origin(&self) -> T {
        self.range()
    }

    fn scale(&self) -> T {
        self.sigma()
    }

    fn pieces<S: Scalar>(&self) -> Vec<Piece<S>> {
        let from_obstacle = |length| Piece::new(S::constant(0.0), length, PANELS);
        match Longer::of(self) {
            Longer::Near => {
                let mut pieces = beyond(self, 2);
                pieces.insert(0, from_obstacle(half_width()).mirrored());
                pieces
            }
            Longer::Far => {
                let near = ratio::<T, S>(self);
                let rest = Piece::new(near.clone(), half_width::<S>() - near.clone(), 4);
                vec![rest, from_obstacle(near).mirrored()]
            }
            Longer::Neither => vec![from_obstacle(half_width()), from_obstacle(-ratio::<T, S>(self))],
        }
    }

    fn entropy<S: Scalar>(&self, _: usize, t: S) -> S {
        (-exponent(t)).entropy_from_log_occupancy()
    }
}

/// The free space, and the obstacle. Here `t` is the distance itself.
impl<T: Real> RadialModel for SteppedSensor<T> {
    type Float = T;

    fn origin(&self) -> T {
        T::zero()
    }

    fn scale(&self) -> T {
        T::one()
    }

    fn pieces<S: Scalar>(&self) -> Vec<Piece<S>> {
        let stretch = |[from, to]: [T; 2]| {
            let start = S::constant(from.widen());
            Piece::new(start.clone(), S::constant(to.widen()) - start, 1)
        };
        self.observed().map(|(ends, _)| stretch(ends)).collect()
    }

    fn entropy<S: Scalar>(&self, piece: usize, _: S) -> S {
        let level = self.observed().nth(piece).map_or(T::HALF, |(_, p)| p);
        S::constant(level.widen()).entropy()
    }
}
