//! The limit of any radial model by adaptive Gauss–Kronrod quadrature: a value with the error it is believed to have.

use super::Weight;
use super::deficit::{Deficit, check, extent};
use super::model::{Piece, RadialModel};
use crate::error::Error;
use crate::estimate::{Estimate, Status};
use crate::interval::{Interval, Toward, Wide};
use crate::quadrature::adaptive::{GaussKronrod, graded};
use crate::real::Real;
use crate::scalar::{Integrand, Scalar};
use num_traits::float::FloatCore;
use num_traits::{One, Zero};

/// Estimates the limit of the mean information (bits per cell) as cells shrink, Eq. 6, by adaptive quadrature.
///
/// The tolerances of `quadrature` are those of the deficit `1 - Ī`, its evaluation limit that of all integrals
/// together. What is integrated is the entropy in the local coordinate `t` of each piece, with panels that shrink
/// towards its start; so a peak of any relative width is seen. A piece whose range, an interval, shows that it matters
/// less than the tolerance is left at that.
///
/// **Error**: [`Estimate::error`], an estimate: the sum of those of the pieces ([`GaussKronrod`]), and the rounding of the last steps.
/// Measured: never below the true error in 10 000 random rooms, both weights and formats.
///
/// A room takes at most 511 evaluations at a relative tolerance of `1e-12` in `f64`, by any rule and for any `z / σ`
/// from `1e-6` to `1e9` (measured: [`quadrature`](crate::book::quadrature)).
///
/// Special case: 0, exactly, for a model that observes nothing.
///
/// # Errors
/// [`Error::OutOfRange`] as [`GaussKronrod::integrate`]; or if `z / σ` is so large that a thousand times it overflows.
///
/// ```
/// use mean_information::limit::{Weight, adaptive};
/// use mean_information::quadrature::adaptive::GaussKronrod;
/// use mean_information::sensor::GaussianSensor;
/// let sensor = GaussianSensor::new(2.0_f64, 0.2)?;
/// let limit = adaptive(&sensor, Weight::Radial, &GaussKronrod::new().relative(1e-12))?;
/// assert!((limit.value - 0.7893368880256514).abs() <= limit.error && limit.error < 1e-12);
/// # Ok::<(), mean_information::Error>(())
/// ```
pub fn adaptive<M: RadialModel>(
    model: &M,
    weight: Weight,
    quadrature: &GaussKronrod<M::Float>,
) -> Result<Estimate<M::Float>, Error> {
    check(model)?;
    let pieces = model.pieces::<M::Float>();
    let whole = pieces
        .iter()
        .map(|piece| extent(model, weight, piece).abs())
        .fold(M::Float::zero(), |sum, extent| sum + extent);
    let mut sum = Estimate {
        value: M::Float::zero(),
        error: M::Float::zero(),
        status: Status::Converged,
        evaluations: 0,
    };
    if whole.is_zero() {
        return Ok(sum);
    }
    // Every panel of the pieces to come is evaluated at least once.
    let least = |pieces: &[Piece<M::Float>]| -> u64 {
        pieces.iter().map(|piece| piece.panels as u64 * quadrature.rule.evaluations()).sum()
    };
    if quadrature.limit < least(&pieces) {
        let allowed = "at least one rule for every panel of the model";
        return Err(Error::out_of_range("evaluation limit", quadrature.limit as f64, allowed));
    }
    for (index, piece) in pieces.iter().enumerate() {
        let deficit = Deficit { model, weight, piece: index, mirrored: piece.mirrored };
        // Of the deficit times the extent: the relative tolerance counts what the pieces before have found.
        let tolerance =
            (quadrature.tolerance.absolute * whole).max(quadrature.tolerance.relative * sum.value);
        // Half of what the pieces before have left of it.
        let allowed = (tolerance - sum.error).max(tolerance * ratio()) * M::Float::HALF;
        let most = most(&deficit, piece);
        let part = if most <= allowed {
            Estimate { value: M::Float::zero(), error: most, status: Status::Converged, evaluations: 1 }
        } else {
            let sign = piece.length.signum();
            let points = graded(piece.length.abs(), M::Float::zero(), ratio(), piece.panels)?;
            quadrature
                .absolute(allowed)
                .limit(quadrature.limit - sum.evaluations - least(&pieces[index + 1..]))
                .integrate_between(|x| deficit.evaluate(piece.start + sign * x), &points)?
        };
        sum.value = sum.value + part.value;
        sum.error = sum.error + part.error;
        sum.evaluations += part.evaluations;
        if sum.status == Status::Converged {
            sum.status = part.status;
        }
    }
    // The extents, the sums and the last steps round a dozen times.
    let rounding = M::Float::nearest(16.0) * M::Float::epsilon();
    let value = (M::Float::one() - sum.value / whole).max(M::Float::zero());
    Ok(Estimate { value, error: sum.error / whole + rounding, ..sum })
}

/// Bounds the integral over a piece by the range of the integrand: enough to know of a tail.
fn most<T: Real>(deficit: &impl Integrand, piece: &Piece<T>) -> T {
    let [start, end] =
        [piece.start, piece.start + piece.length].map(|x| Interval::<Wide>::constant(x.widen()));
    let range = deficit.evaluate(start.hull(end));
    if range.is_empty() { T::infinity() } else { (range * (end - start)).magnitude().to_real(Toward::Up) }
}

/// Returns the ratio of a panel to the one before: an eighth.
fn ratio<T: Real>() -> T {
    T::HALF * T::HALF * T::HALF
}
