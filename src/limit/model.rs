//! Radial models: what the continuous mean information integrates (Eq. 6), written once for floats, intervals and rectangles.

use alloc::vec;
use alloc::vec::Vec;

use crate::real::Real;
use crate::scalar::Scalar;
use crate::sensor::{GaussianSensor, SteppedSensor};

/// A stretch of `t` from `start` to `start + length`, over which the entropy is smooth but perhaps at its start.
///
/// A negative length runs towards smaller `t`. A singularity, or a bump much narrower than the piece, may lie at the start, and
/// only there: the adaptive integral begins with panels that shrink towards it.
#[derive(Clone, Debug)]
pub struct Piece<S> {
    /// Where it starts.
    pub start: S,
    /// How far it reaches, with its sign.
    pub length: S,
    /// How many panels the adaptive integral begins with, each a quarter of the one before: enough for the smallest to be no wider
    /// than what is to be seen at the start. At least 1.
    pub panels: usize,
}

impl<S: Scalar> Piece<S> {
    /// The piece of the given start, length and number of panels.
    pub fn new(start: S, length: S, panels: usize) -> Self {
        Self { start, length, panels }
    }
}

/// What one sensor reading, or several, say of the points around it: the entropy of the occupancy along a beam.
///
/// Distances are `ρ = origin + scale t`, so that `t` can be small where `ρ` is large and its digits would be lost. The pieces
/// together are the observed stretch, without overlap.
pub trait RadialModel {
    /// The type of the distances.
    type Float: Real;

    /// The distance (metres) at `t = 0`.
    fn origin(&self) -> Self::Float;

    /// Metres per unit of `t`; positive.
    fn scale(&self) -> Self::Float;

    /// The pieces of the observed stretch.
    fn pieces<S: Scalar>(&self) -> Vec<Piece<S>>;

    /// The entropy (bits) of the occupancy at `t`, within the piece of the given index.
    fn entropy<S: Scalar>(&self, piece: usize, t: S) -> S;
}

/// `√(ln 4)`: where the Gaussian has fallen to 1/2.
pub(super) fn half_width<S: Scalar>() -> S {
    (S::constant(2.0) * S::ln_2()).sqrt()
}

/// `z / σ` of a sensor.
pub(super) fn ratio<T: Real, S: Scalar>(sensor: &GaussianSensor<T>) -> S {
    S::constant(sensor.range().widen()) / S::constant(sensor.sigma().widen())
}

/// The negative logarithm of the Gaussian, `t^2 / 2`.
pub(super) fn exponent<S: Scalar>(t: S) -> S {
    S::constant(0.5) * t.clone() * t
}

/// Beyond this many `σ` the Gaussian is below `2^-1154`: nothing there but a tail.
pub(super) const TAIL: f64 = 40.0;

/// The panels about `z`, where the entropy is `t^2 ln |t|`.
const PANELS: usize = 5;

/// The near side from `z` down to the sensor, its tail apart, and the far side up to the edge.
impl<T: Real> RadialModel for GaussianSensor<T> {
    type Float = T;

    fn origin(&self) -> T {
        self.range()
    }

    fn scale(&self) -> T {
        self.sigma()
    }

    fn pieces<S: Scalar>(&self) -> Vec<Piece<S>> {
        let far = Piece::new(S::constant(0.0), half_width(), PANELS);
        if ratio::<T, f64>(self) > TAIL {
            let near = Piece::new(S::constant(0.0), S::constant(-TAIL), PANELS + 1);
            vec![far, near, Piece::new(S::constant(-TAIL), S::constant(TAIL) - ratio(self), 1)]
        } else {
            // What is far narrower than the far side counts for little beside it.
            let panels = if ratio::<T, f64>(self) < 0.125 { 1 } else { PANELS + 1 };
            vec![far, Piece::new(S::constant(0.0), -ratio::<T, S>(self), panels)]
        }
    }

    fn entropy<S: Scalar>(&self, _: usize, t: S) -> S {
        (-exponent(t)).exp().entropy()
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
