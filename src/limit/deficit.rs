//! The integrals of Eq. 6: what the observed points lack of one bit each, and how much of the beam they are.
//!
//! ```text
//! 1 - MI = sum over pieces of ∫ H(p) w dt  /  sum over pieces of ∫ w dt,    w = 1 (radial), w = ρ (area)
//! ```
//!
//! The deficit `H = 1 - I` rather than `I`: it is small where little is uncertain, and so are its errors. Distances are taken in
//! units of `z + σ`, so that `w` neither overflows nor vanishes.

use super::Weight;
use super::model::RadialModel;
use crate::error::Error;
use crate::real::Real;
use crate::scalar::{Integrand, Scalar};
use num_traits::Zero;
use num_traits::float::FloatCore;

/// `H(p) w` along one piece of a model.
pub(super) struct Deficit<'a, M> {
    pub(super) model: &'a M,
    pub(super) weight: Weight,
    pub(super) piece: usize,
}

impl<M: RadialModel> Integrand for Deficit<'_, M> {
    fn evaluate<S: Scalar>(&self, t: S) -> S {
        let entropy = self.model.entropy(self.piece, t.clone());
        match self.weight {
            Weight::Radial => entropy,
            Weight::Area => entropy * distance(self.model, t),
        }
    }
}

/// `ρ / (z + σ)` at `t`.
fn distance<M: RadialModel, S: Scalar>(model: &M, t: S) -> S {
    let ratio = S::constant(model.origin().widen()) / S::constant(model.scale().widen());
    (ratio.clone() + t) / (ratio + S::constant(1.0))
}

/// `∫ w dt` over a piece, without its sign: the length, times `w` in the middle.
pub(super) fn extent<M: RadialModel, S: Scalar>(model: &M, weight: Weight, piece: usize) -> S {
    let Some(stretch) = model.pieces::<S>().into_iter().nth(piece) else { return S::constant(0.0) };
    match weight {
        Weight::Radial => stretch.length,
        Weight::Area => {
            let middle = stretch.start + S::constant(0.5) * stretch.length.clone();
            stretch.length * distance(model, middle)
        }
    }
}

/// An error where `z / σ` is beyond what the type can square.
pub(super) fn check<M: RadialModel>(model: &M) -> Result<(), Error> {
    let ratio = model.origin().widen() / model.scale().widen();
    if !(model.scale() > M::Float::zero() && ratio.is_finite() && M::Float::nearest(ratio * 1e3).is_finite())
    {
        return Err(Error::out_of_range(
            "range over sigma",
            ratio,
            "finite, and so a thousand times it; the closed form takes any",
        ));
    }
    Ok(())
}
