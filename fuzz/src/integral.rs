//! Integrals, and their claims.

use mean_information::estimate::{Estimate, Status};
use mean_information::quadrature::adaptive::{GaussKronrod, Rule, graded};
use mean_information::{Error, Real};

/// Integrals between any points with any settings. The bytes are the format and rule, the kind of integrand, the
/// number of points and the limit on evaluations (in units of 16), then floats: the two tolerances, the points, and
/// what the integrand is made of.
pub fn integrate(bytes: &[u8]) {
    let [rule, kind, points, limit, floats @ ..] = bytes else {
        return;
    };
    let integral = Integral {
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

struct Integral {
    rule: Rule,
    kind: u8,
    points: usize,
    limit: u64,
}

impl Integral {
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
        let Ok(Estimate { value, error, status, evaluations }) = estimate.inspect_err(|fault| {
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
        if self.kind.is_multiple_of(5) && !value.is_nan() {
            let (from, to) = (points[0].widen(), points[points.len() - 1].widen());
            judge_polynomial(made_of, [from, to], value.widen(), error.widen());
        }
    }
}

/// Horner's scheme of degree 7 has 16 roundings of at most the sum of the terms' magnitudes: beyond the 2 ulp
/// that a claim takes an integrand to be off by. The antiderivative has as many.
fn judge_polynomial<T: Real>(made_of: &[T], [from, to]: [f64; 2], value: f64, error: f64) {
    let mut primitive = [0.0; 2];
    let (mut size, mut total) = (0.0_f64, 0.0_f64);
    for (k, (c, ends)) in coefficients(made_of).zip([[from, to]; 8]).enumerate() {
        let c = c.widen() / (k + 1) as f64;
        for (end, sum) in ends.into_iter().zip(&mut primitive) {
            let power = (0..=k).fold(1.0, |power, _| power * end);
            *sum += c * power;
            size += (c * power).abs();
        }
        // |f| of every term, times the length.
        let largest = from.abs().max(to.abs());
        total += (c * (k + 1) as f64 * (0..k).fold(1.0, |power, _| power * largest) * (to - from)).abs();
    }
    let truth = primitive[1] - primitive[0];
    let slack = 32.0 * f64::EPSILON * size + 16.0 * T::epsilon().widen() * total + 1e-290;
    let tiny = if T::FORMAT == "f32" { 1e-37 } else { 1e-300 };
    if truth.is_finite() && slack.is_finite() && size < 1e30 {
        let slack = slack + tiny * (1.0 + (to - from).abs());
        assert!((value - truth).abs() <= error + slack, "{value} for {truth}, claim {error}");
    }
}

fn coefficients<T: Real>(made_of: &[T]) -> impl DoubleEndedIterator<Item = T> {
    made_of[..made_of.len().min(8)].iter().copied()
}
