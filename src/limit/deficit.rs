//! The integrals of Eq. 6: what the observed points lack of one bit each, and how much of the beam they are.
//!
//! ```text
//! 1 - Ī = sum over pieces of ∫ H(p) g dt  /  sum over pieces of ∫ g dt,    g = 1 (radial), g = ρ (area)
//! ```
//!
//! The deficit `1 - Ī` rather than the mean information `Ī`: it is small where little is uncertain, and so are its
//! errors. Distances are taken in units of `z + σ`, so that `g` neither overflows nor vanishes.

use super::Weight;
use super::model::{Piece, RadialModel};
use crate::error::{Error, positive};
use crate::real::Real;
use crate::scalar::{Integrand, Scalar};
use num_traits::float::FloatCore;

/// The integrand `H(p) g` along one piece of a model; of a mirrored one, the sum at `t` and `-t`.
pub(super) struct Deficit<'a, M> {
    pub(super) model: &'a M,
    pub(super) weight: Weight,
    pub(super) piece: usize,
    pub(super) mirrored: bool,
}

impl<M: RadialModel> Integrand for Deficit<'_, M> {
    fn evaluate<S: Scalar>(&self, t: S) -> S {
        let entropy = self.model.entropy(self.piece, t.clone());
        match self.weight {
            Weight::Radial if !self.mirrored => entropy,
            _ => entropy * density(self.model, self.weight, self.mirrored, t),
        }
    }
}

/// Returns `g` at `t`, in units of `z + σ` by area; mirrored `g(t) + g(-t)`, which is `2 g(0)`, as `g` is linear.
fn density<M: RadialModel, S: Scalar>(model: &M, weight: Weight, mirrored: bool, t: S) -> S {
    let distance = |t: S| {
        let ratio = S::constant(model.origin().widen()) / S::constant(model.scale().widen());
        (ratio.clone() + t) / (ratio + S::constant(1.0))
    };
    match (weight, mirrored) {
        (Weight::Radial, false) => S::constant(1.0),
        (Weight::Radial, true) => S::constant(2.0),
        (Weight::Area, false) => distance(t),
        (Weight::Area, true) => S::constant(2.0) * distance(S::constant(0.0)),
    }
}

/// Returns `∫ g dt` over a piece, without its sign: the length, times `g` in the middle.
pub(super) fn extent<M: RadialModel, S: Scalar>(model: &M, weight: Weight, piece: &Piece<S>) -> S {
    let middle = piece.start.clone() + S::constant(0.5) * piece.length.clone();
    piece.length.clone() * density(model, weight, piece.mirrored, middle)
}

/// Refuses a scale that is no length, and a `z / σ` that the type cannot square.
pub(super) fn check<M: RadialModel>(model: &M) -> Result<(), Error> {
    let scale = positive("scale of the model", model.scale())?;
    let ratio = model.origin().widen() / scale.widen();
    if !(ratio.is_finite() && M::Float::nearest(ratio * 1e3).is_finite()) {
        return Err(Error::out_of_range(
            "range over sigma",
            ratio,
            "finite, and so a thousand times it; the closed form takes any",
        ));
    }
    Ok(())
}
