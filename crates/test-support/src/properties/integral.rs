//! Integrals, and their claims.

use mean_information::estimate::{Estimate, Status};
use mean_information::quadrature::adaptive::{GaussKronrod, Rule, graded};
use mean_information::{Error, Real};

/// Takes integrals between any points with any settings. The bytes are the format and rule, the kind of integrand, the
/// number of points and the limit on evaluations (in units of 16), then floats: the two tolerances, the points, and
/// what the integrand is made of.
pub fn integrate(bytes: &[u8]) {
    let [rule, kind, points, limit, floats @ ..] = bytes else {
        return;
    };
    let integral = IntegralCase {
        rule: Rule::ALL[usize::from(rule / 2) % Rule::ALL.len()],
        kind: *kind,
        points: usize::from(points % 16),
        limit: u64::from(*limit) * 16,
    };
    if rule % 2 == 0 {
        integral
            .check(&floats.as_chunks().0.iter().map(|&bytes| f32::from_le_bytes(bytes)).collect::<Vec<_>>());
    } else {
        integral
            .check(&floats.as_chunks().0.iter().map(|&bytes| f64::from_le_bytes(bytes)).collect::<Vec<_>>());
    }
}

struct IntegralCase {
    rule: Rule,
    kind: u8,
    points: usize,
    limit: u64,
}

impl IntegralCase {
    fn check<T: Real>(&self, floats: &[T]) {
        let [absolute, relative, rest @ ..] = floats else {
            return;
        };
        let (points, made_of) = rest.split_at(self.points.min(rest.len()));
        let settings =
            GaussKronrod::new().absolute(*absolute).relative(*relative).limit(self.limit).rule(self.rule);
        let mut sorted = points.to_vec();
        sorted.sort_by(|a, b| a.widen().total_cmp(&b.widen()));
        if let [from, to, ..] = points {
            let _ = graded(*from, *to, *relative, self.points).inspect(|points| assert!(points.is_sorted()));
            self.judge(
                settings.integrate(|x| self.integrand(made_of, x), *from, *to),
                made_of,
                &[*from, *to],
            );
        }
        for points in [points, &sorted] {
            let estimate = settings.integrate_between(|x| self.integrand(made_of, x), points);
            self.judge(estimate, made_of, points);
        }
    }

    /// A polynomial of low degree, a peak, a jump to NaN or infinity, or a power.
    fn integrand<T: Real>(&self, made_of: &[T], x: T) -> T {
        let [a, b] = [0, 1].map(|k| made_of.get(k).copied().unwrap_or(T::HALF));
        match self.kind % 5 {
            0 => coefficients(made_of).rev().fold(T::zero(), |sum, c| sum * x + c),
            1 => b / ((x - a) * (x - a) + b * b),
            2 if x > a => b,
            3 if x < a => T::infinity(),
            4 => x.abs().powi(self.rule as i32 - 3),
            _ => x,
        }
    }

    /// It ends within the limit, and the claim is a claim: for the polynomials, it holds.
    fn judge<T: Real>(&self, estimate: Result<Estimate<T>, Error>, made_of: &[T], points: &[T]) {
        let Ok(Estimate { value, error, status, evaluations, .. }) = estimate.inspect_err(|fault| {
            assert!(!fault.to_string().is_empty());
        }) else {
            return;
        };
        assert!(evaluations <= self.limit, "{evaluations} of {}", self.limit);
        assert!(error >= T::zero(), "{error}");
        if let Status::NotFinite { lower, upper } | Status::Unresolved { lower, upper } = status {
            assert!(
                lower < upper && points.iter().any(|&x| x <= lower) && points.iter().any(|&x| upper <= x)
            );
        }
        assert_eq!(value.is_nan(), matches!(status, Status::NotFinite { .. }));
        let ends = [points[0].widen(), points[points.len() - 1].widen()];
        // Powers of these are floats of full precision, and their errors those of Horner's scheme alone.
        let moderate = |x: f64| x == 0.0 || (1e-4..=1e4).contains(&x.abs());
        if self.kind.is_multiple_of(5)
            && ends.into_iter().chain(coefficients(made_of).map(T::widen)).all(moderate)
        {
            let coefficients: Vec<f64> = coefficients(made_of).map(T::widen).collect();
            judge_polynomial(&coefficients, ends, value.widen(), error.widen(), T::epsilon().widen());
        }
    }
}

/// Horner's scheme of degree 7 has 16 roundings of at most the sum of the terms' magnitudes, beyond the 2 ulp that a claim
/// takes an integrand to be off by. The antiderivative has as many in double precision.
fn judge_polynomial(coefficients: &[f64], [from, to]: [f64; 2], value: f64, error: f64, epsilon: f64) {
    let largest = from.abs().max(to.abs());
    let (mut truth, mut rounding) = (0.0, 0.0);
    let mut powers = [1.0; 3];
    for (&c, degree) in coefficients.iter().zip(1..) {
        rounding += 16.0 * epsilon * (c * powers[2] * (to - from)).abs();
        for (power, x) in powers.iter_mut().zip([from, to, largest]) {
            *power *= x;
        }
        let [lower, upper, size] = powers.map(|power| c / f64::from(degree) * power);
        truth += upper - lower;
        rounding += 32.0 * f64::EPSILON * size.abs();
    }
    assert!((value - truth).abs() <= error + rounding, "{value:e} for {truth:e}, claim {error:e}");
}

fn coefficients<T: Real>(made_of: &[T]) -> impl DoubleEndedIterator<Item = T> {
    made_of[..made_of.len().min(8)].iter().copied()
}
