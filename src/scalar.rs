//! The numbers that an integrand is written in: [`Scalar`], for which floats, intervals and rectangles of the complex
//! plane can stand.
//!
//! A formula written once, generic over `Scalar`, gives values at floats, ranges over intervals, and, over rectangles,
//! a bound on its magnitude where it is analytic.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::cell;
use crate::elementary;
use crate::real::Real;

/// A number that formulas can be evaluated in: a float, an interval, or a rectangle of complex numbers.
///
/// **Error**: floats have each function correctly rounded, except `exp_m1` and
/// `entropy_from_log_occupancy` (within 2 ulp), `x_ln_x` (1.5 ulp) and
/// `powi` (`|n| + 1` ulp); intervals and rectangles contain
/// the exact results (proved, [`rounding`](crate::book::rounding), [`quadrature`](crate::book::quadrature),
/// [`integration`](crate::book::integration)). Floats are NaN outside the domain.
///
/// On an `f32` or `f64` with the standard library `x.exp()` is the standard library's method, whose precision Rust leaves
/// open, as methods of the type come first: write `Scalar::exp(x)` there. On an `S: Scalar` it is always this trait's.
///
/// ```
/// use mean_information::scalar::Scalar;
/// fn deficit<S: Scalar>(t: S) -> S {
///     (S::constant(-0.5) * t.clone() * t).exp().entropy()
/// }
/// assert_eq!(deficit(1.75_f64), 0.7532889301805203); // bits
/// assert_eq!(Scalar::exp_m1(1e-17_f64), 1e-17); // e^x rounds to 1
/// assert_eq!((Scalar::ln(2.5_f64), Scalar::sqrt(2.5_f64)), (0.9162907318741551, 1.5811388300841898));
/// assert_eq!((-2.5_f64).entropy_from_log_odds(), 0.3874143787596851); // bits
/// ```
pub trait Scalar:
    Clone
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Returns the number `x`: exactly, or the nearest float where the scalar is one of fewer bits.
    fn constant(x: f64) -> Self;

    /// Returns `ln 2`: the nearest float, or an enclosure.
    fn ln_2() -> Self;

    /// Returns `x^2`: of floats correctly rounded; of intervals the least that holds it, never below 0.
    ///
    /// Over an interval about 0 the product `x * x` holds negative numbers, as its factors count as independent: write
    /// `x.square()`.
    ///
    /// ```
    /// use mean_information::interval::Interval;
    /// use mean_information::scalar::Scalar;
    /// let x = Interval::new(-1.5_f64, 2.0)?;
    /// assert_eq!((x.square(), x * x), (Interval::new(0.0, 4.0)?, Interval::new(-3.0, 4.0)?));
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    #[must_use]
    fn square(self) -> Self {
        self.clone() * self
    }

    /// Returns `x^n`, by squares: 1 for `n = 0`; of floats, for `|n|` up to 1000, within `|n| + 1` ulp where neither
    /// `x^n` nor `x^-n` leaves the normal range (proved: the value has the factors `1 + δ`, `|δ| <= 2^-P`, of at most
    /// `|n| - 1` products and a quotient); of intervals about 0 without the negative numbers that an even power lacks.
    ///
    /// ```
    /// use mean_information::interval::Interval;
    /// use mean_information::scalar::Scalar;
    /// let x = Interval::new(-0.5_f64, 2.0)?;
    /// assert_eq!((x.powi(4), x.powi(3)), (Interval::new(0.0, 16.0)?, Interval::new(-0.125, 8.0)?));
    /// assert_eq!(Scalar::powi(2.5_f32, -2), 0.16);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    #[must_use]
    fn powi(self, n: i32) -> Self {
        let (mut power, mut square, mut rest) = (Self::constant(1.0), self, n.unsigned_abs());
        while rest > 0 {
            if rest % 2 == 1 {
                power = power * square.clone();
            }
            rest /= 2;
            if rest > 0 {
                square = square.square();
            }
        }
        if n < 0 { Self::constant(1.0) / power } else { power }
    }

    /// Returns `x ln x` (nats if `x` is a probability), 0 at 0: of floats within 1.5 ulp (proved: a logarithm within
    /// half an ulp, and a product); of intervals from 0 on with a bound, which the product of `[0, ε]` and `[-inf, ln
    /// ε]` has not.
    ///
    /// ```
    /// use mean_information::interval::Interval;
    /// use mean_information::scalar::Scalar;
    /// let p = Interval::new(0.0_f64, 0.5)?; // the least value is -1/e
    /// assert_eq!((p.x_ln_x().lower(), p.x_ln_x().upper()), (-0.36787944117144233, 0.0));
    /// assert_eq!((0.0_f64.x_ln_x(), 0.25_f64.x_ln_x()), (0.0, -0.34657359027997264));
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    #[must_use]
    fn x_ln_x(self) -> Self {
        self.clone() * self.ln()
    }

    /// Returns `e^x`: of floats correctly rounded.
    #[must_use]
    fn exp(self) -> Self;

    /// Returns `e^x - 1`; floats keep their digits next to 0, within 2 ulp.
    #[must_use]
    fn exp_m1(self) -> Self {
        -(Self::constant(1.0) - self.exp())
    }

    /// Returns the natural logarithm: of floats correctly rounded.
    #[must_use]
    fn ln(self) -> Self;

    /// Returns the square root: of floats correctly rounded.
    #[must_use]
    fn sqrt(self) -> Self;

    /// Returns the Bernoulli entropy in bits (Eq. 1), `-(p ln p + (1 - p) ln(1 - p)) / ln 2` for `p` in `[0, 1]`: of
    /// floats correctly rounded.
    #[must_use]
    fn entropy(self) -> Self;

    /// Returns the Bernoulli entropy in bits at occupancy `e^l`, `l <= 0`; floats keep their digits where it is next to
    /// 1, within 2 ulp.
    ///
    /// ```
    /// use mean_information::scalar::Scalar;
    /// let l = -1e-17_f64; // e^l rounds to 1, of which the entropy is 0
    /// assert_eq!(l.entropy_from_log_occupancy(), 5.791547265397413e-16);
    /// ```
    #[must_use]
    fn entropy_from_log_occupancy(self) -> Self {
        self.exp().entropy()
    }

    /// Returns the Bernoulli entropy in bits at log-odds `l = ln(p / (1 - p))`: of floats correctly rounded.
    #[must_use]
    fn entropy_from_log_odds(self) -> Self;
}

/// A function of one variable, written once for floats, intervals and rectangles.
///
/// ```
/// use mean_information::scalar::{Integrand, Scalar};
/// /// `e^(-rate x)`.
/// struct Decay { rate: f64 }
/// impl Integrand for Decay {
///     fn evaluate<S: Scalar>(&self, x: S) -> S {
///         (-(S::constant(self.rate) * x)).exp()
///     }
/// }
/// assert_eq!(Decay { rate: 3.0 }.evaluate(0.5_f64), 0.22313016014842982);
/// ```
pub trait Integrand {
    /// Returns the value at `x`, as exact as `S` computes it ([`integration`](crate::book::integration)).
    fn evaluate<S: Scalar>(&self, x: S) -> S;
}

/// Floats: NaN outside the domain; each operation and function correctly rounded, except `exp_m1` and
/// `entropy_from_log_occupancy` (within 2 ulp), `x_ln_x` and `powi`.
impl<T: Real> Scalar for T {
    fn constant(x: f64) -> Self {
        T::nearest(x)
    }

    fn ln_2() -> Self {
        T::nearest(core::f64::consts::LN_2)
    }

    fn x_ln_x(self) -> Self {
        if self.is_zero() { T::zero() } else { self * elementary::ln(self) }
    }

    fn exp(self) -> Self {
        elementary::exp(self)
    }

    fn exp_m1(self) -> Self {
        elementary::exp_m1(self)
    }

    fn ln(self) -> Self {
        elementary::ln(self)
    }

    fn sqrt(self) -> Self {
        elementary::sqrt(self)
    }

    fn entropy(self) -> Self {
        cell::entropy(self)
    }

    fn entropy_from_log_occupancy(self) -> Self {
        // Next to 1 the complement keeps what the occupancy has lost, and has the same entropy.
        if self.abs() < T::HALF * T::HALF {
            cell::entropy(-elementary::exp_m1(self))
        } else {
            cell::entropy(elementary::exp(self))
        }
    }

    fn entropy_from_log_odds(self) -> Self {
        cell::entropy_from_log_odds(self)
    }
}
