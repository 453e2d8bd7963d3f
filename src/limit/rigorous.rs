//! The limit of any radial model by rigorous integration: two floats with the true value between them.

use super::Weight;
use super::deficit::{Deficit, check, extent};
use super::model::RadialModel;
use crate::error::Error;
use crate::estimate::{Enclosure, Status};
use crate::interval::{Interval, Toward, Wide};
use crate::quadrature::Tolerance;
use crate::quadrature::rigorous::Rigorous;
use crate::real::Real;
use crate::scalar::Scalar;
use num_traits::float::FloatCore;
use num_traits::{One, Zero};

/// Encloses the limit of the mean information (bits per cell) as cells shrink, Eq. 6, between two floats.
///
/// The tolerances of `quadrature` are those of the deficit `1 - Ī`, though no finer than a 64th of the spacing of
/// floats at 1; its evaluation limit is that of each piece.
///
/// **Error**: none; the true value lies in the enclosure, whatever the status (proved:
/// [`integration`](crate::book::integration)). With the default tolerances it is at most 3 ulp wide for the limits of a
/// room (measured).
///
/// Special case: 0, exactly, for a model that observes nothing.
///
/// # Errors
/// [`Error::OutOfRange`] as [`Rigorous::integrate`]; or if `z / σ` is so large that a thousand times it overflows.
///
/// ```
/// use mean_information::limit::{Weight, rigorous};
/// use mean_information::quadrature::rigorous::Rigorous;
/// use mean_information::sensor::GaussianSensor;
/// let sensor = GaussianSensor::new(2.0_f64, 0.2)?;
/// let limit = rigorous(&sensor, Weight::Area, &Rigorous::default())?;
/// assert!(limit.contains(0.6525109529727351) && limit.width() < 2.3e-16);
/// # Ok::<(), mean_information::Error>(())
/// ```
pub fn rigorous<M: RadialModel>(
    model: &M,
    weight: Weight,
    quadrature: &Rigorous<M::Float>,
) -> Result<Enclosure<M::Float>, Error> {
    check(model)?;
    quadrature.check()?;
    let pieces = model.pieces::<Interval<Wide>>();
    if pieces.is_empty() {
        let zero = M::Float::zero();
        return Ok(Enclosure { lower: zero, upper: zero, status: Status::Converged, evaluations: 0 });
    }
    let (mut deficit, mut whole) = (Interval::constant(0.0), Interval::constant(0.0));
    for piece in &pieces {
        whole = whole + magnitude(extent(model, weight, piece));
    }
    let (mut status, mut evaluations) = (Status::Converged, 0);
    for (index, piece) in pieces.into_iter().enumerate() {
        let to = piece.start + piece.length;
        // What is small beside the pieces before it need not be known to the same digits.
        let Tolerance { absolute, relative } = quadrature.tolerance();
        let absolute = (absolute.max(Rigorous::finest()) * to_float(whole)).max(relative * to_float(deficit));
        let part = quadrature.absolute(absolute).between(
            &Deficit { model, weight, piece: index, mirrored: piece.mirrored },
            piece.start,
            to,
        );
        deficit = deficit + magnitude(part.value);
        evaluations += part.evaluations;
        if status == Status::Converged {
            status = part.status.nearest();
        }
    }
    let value = Interval::constant(1.0) - deficit / whole;
    // Between 0 and 1 by definition.
    Ok(Enclosure {
        lower: value.lower().to_real::<M::Float>(Toward::Down).max(M::Float::zero()),
        upper: value.upper().to_real::<M::Float>(Toward::Up).min(M::Float::one()),
        status,
        evaluations,
    })
}

/// Returns the magnitudes: where a wide enclosure leaves the sign open, from 0 on.
fn magnitude(x: Interval<Wide>) -> Interval<Wide> {
    let zero = Interval::constant(0.0);
    if x.upper() <= zero.upper() {
        -x
    } else if x.lower() >= zero.lower() {
        x
    } else {
        let positive = Interval::between(zero.lower(), Interval::<Wide>::WHOLE.upper());
        x.hull(-x).intersection(positive)
    }
}

/// Returns a float near the lower end of `x`, to compare errors with.
fn to_float<T: Real>(x: Interval<Wide>) -> T {
    x.lower().to_real(Toward::Down)
}

#[cfg(test)]
mod tests;
