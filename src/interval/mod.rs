//! Outward-rounded intervals: [`Interval`], for whose operations `f(X)` contains `{f(x): x in X}`, always.
//!
//! The chapter [`integration`](crate::book::integration) says why, and what they are for.

mod complex;
mod endpoint;
mod powers;
mod wide;

pub(crate) use complex::Complex;
pub use endpoint::{Endpoint, Toward};
pub(crate) use wide::Wide;

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::error::Error;
use crate::real::Real;
use crate::scalar::Scalar;
use Toward::{Down, Up};

/// All real numbers from `lower` to `upper`, or none.
///
/// An operation on intervals gives an interval that contains the exact result of the operation on any numbers in
/// them; so does a formula. An infinite end means that there is no bound on that side.
///
/// A function is taken where it is defined: `√[-1, 4]` is `[0, 2]`, and `ln [-2, -1]` is [`EMPTY`](Self::EMPTY),
/// which every operation hands on. Division by an interval with 0 inside leaves no bounds.
///
/// The ends are the best floats. They may be the next ones for products, quotients and roots near overflow and
/// underflow, and for a value of another function that is within `2^-65` of a float, relative to it (proved in
/// [`integration`](crate::book::integration)).
///
/// ```
/// use mean_information::interval::Interval;
/// use mean_information::scalar::Scalar;
///
/// let p = Interval::new(0.25_f64, 0.75)?;
/// let entropy = p.entropy(); // bits; 1 at p = 1/2
/// assert_eq!((entropy.lower(), entropy.upper()), (0.8112781244591328, 1.0));
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval<T> {
    /// Never `+inf`, but in the empty interval.
    lower: T,
    /// Never `-inf`, but in the empty interval.
    upper: T,
}

impl<T: Real + Endpoint> Interval<T> {
    /// The numbers from `lower` to `upper`, ends included.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if an end is NaN, the lower one above the upper one, or both are the same infinity.
    ///
    /// ```
    /// use mean_information::interval::Interval;
    /// assert!(Interval::new(2.5_f64, 2.25).is_err());
    /// assert!(Interval::new(2.5_f32, f32::INFINITY).is_ok());
    /// ```
    pub fn new(lower: T, upper: T) -> Result<Self, Error> {
        if lower.is_nan() || lower == T::INFINITY {
            return Err(Error::out_of_range("lower end", lower.widen(), "a number or -inf"));
        }
        if upper.is_nan() || upper < lower || upper == T::NEG_INFINITY {
            return Err(Error::out_of_range(
                "upper end",
                upper.widen(),
                "a number not below the lower end, or inf",
            ));
        }
        Ok(Self { lower, upper })
    }
}

impl<T: Endpoint> Interval<T> {
    /// No number: what a function gives outside its domain.
    pub const EMPTY: Self = Self { lower: T::INFINITY, upper: T::NEG_INFINITY };

    /// Every number: no bounds.
    pub const WHOLE: Self = Self { lower: T::NEG_INFINITY, upper: T::INFINITY };

    /// The one number `x`, finite.
    pub(crate) const fn point(x: T) -> Self {
        Self { lower: x, upper: x }
    }

    /// From one end to the other, for the caller who knows their order.
    pub(crate) const fn between(lower: T, upper: T) -> Self {
        Self { lower, upper }
    }

    /// The lower end; `inf` if empty.
    pub fn lower(&self) -> T {
        self.lower
    }

    /// The upper end; `-inf` if empty.
    pub fn upper(&self) -> T {
        self.upper
    }

    /// Whether there is no number in it.
    pub fn is_empty(&self) -> bool {
        self.lower > self.upper
    }

    /// Whether both ends are finite.
    pub fn is_bounded(&self) -> bool {
        T::NEG_INFINITY < self.lower && self.lower <= self.upper && self.upper < T::INFINITY
    }

    /// Whether `x` is in it.
    ///
    /// ```
    /// use mean_information::interval::Interval;
    /// let interval = Interval::new(-0.25_f64, 3.0)?;
    /// assert!(interval.contains(-0.25) && !interval.contains(3.5));
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn contains(&self, x: T) -> bool {
        self.lower <= x && x <= self.upper
    }

    /// `upper - lower`, within the spacing of floats there, rounded up; `-inf` if empty.
    ///
    /// ```
    /// use mean_information::interval::Interval;
    /// assert_eq!(Interval::new(-0.25_f64, 3.0)?.width(), 3.25);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn width(&self) -> T {
        self.upper.add(-self.lower, Up)
    }

    /// The largest magnitude in it.
    pub(crate) fn magnitude(&self) -> T {
        max(self.upper, -self.lower)
    }

    /// The smallest interval that contains both.
    pub(crate) fn hull(self, other: Self) -> Self {
        Self { lower: min(self.lower, other.lower), upper: max(self.upper, other.upper) }
    }

    /// The numbers in both.
    pub(crate) fn intersection(self, other: Self) -> Self {
        let common = Self { lower: max(self.lower, other.lower), upper: min(self.upper, other.upper) };
        if common.is_empty() { Self::EMPTY } else { common }
    }

    /// The values of a rising function, of which `at` encloses one; both ends at once for a point.
    fn rising(self, at: impl Fn(T) -> Self) -> Self {
        let lower = at(self.lower);
        let upper = if self.lower == self.upper { lower } else { at(self.upper) };
        Self { lower: lower.lower, upper: upper.upper }
    }
}

/// The smaller of two numbers that are not NaN.
fn min<T: PartialOrd>(a: T, b: T) -> T {
    if b < a { b } else { a }
}

/// The larger of two numbers that are not NaN.
fn max<T: PartialOrd>(a: T, b: T) -> T {
    if b > a { b } else { a }
}

impl<T: Endpoint> Neg for Interval<T> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { lower: -self.upper, upper: -self.lower }
    }
}

impl<T: Endpoint> Add for Interval<T> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        if self.is_empty() || other.is_empty() {
            return Self::EMPTY;
        }
        Self { lower: self.lower.add(other.lower, Down), upper: self.upper.add(other.upper, Up) }
    }
}

impl<T: Endpoint> Sub for Interval<T> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<T: Endpoint> Mul for Interval<T> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        if self.is_empty() || other.is_empty() {
            return Self::EMPTY;
        }
        if self.upper < T::ZERO {
            return -(-self * other);
        }
        if other.upper < T::ZERO {
            return -(self * -other);
        }
        let (a, b, c, d) = (self.lower, self.upper, other.lower, other.upper);
        let lower = match (a < T::ZERO, c < T::ZERO) {
            (false, false) => a.mul(c, Down),
            (true, false) => a.mul(d, Down),
            (false, true) => b.mul(c, Down),
            (true, true) => min(a.mul(d, Down), b.mul(c, Down)),
        };
        let upper = b.mul(d, Up);
        let upper = if a < T::ZERO && c < T::ZERO { max(upper, a.mul(c, Up)) } else { upper };
        Self { lower, upper }
    }
}

impl<T: Endpoint> Div for Interval<T> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if self.is_empty() || other.is_empty() || other == Self::point(T::ZERO) {
            return Self::EMPTY;
        }
        if other.upper <= T::ZERO {
            return -self / -other;
        }
        if other.lower < T::ZERO {
            return Self::WHOLE;
        }
        let lower = self.lower.div(if self.lower < T::ZERO { other.lower } else { other.upper }, Down);
        let upper = self.upper.div(if self.upper < T::ZERO { other.upper } else { other.lower }, Up);
        Self { lower, upper }
    }
}

impl<T: Endpoint> Scalar for Interval<T> {
    fn constant(x: f64) -> Self {
        if !x.is_finite() {
            return Self::EMPTY;
        }
        Self { lower: T::convert(x, Down), upper: T::convert(x, Up) }
    }

    fn ln_2() -> Self {
        T::LN_2
    }

    fn square(self) -> Self {
        self.power(2)
    }

    fn powi(self, n: i32) -> Self {
        self.power(n)
    }

    fn x_ln_x(self) -> Self {
        self.times_logarithm()
    }

    fn exp(self) -> Self {
        if self.is_empty() { self } else { self.rising(T::exp) }
    }

    fn ln(self) -> Self {
        let positive = self.intersection(Self { lower: T::ZERO, upper: T::INFINITY });
        if positive.is_empty() || positive.upper == T::ZERO { Self::EMPTY } else { positive.rising(T::ln) }
    }

    fn sqrt(self) -> Self {
        let positive = self.intersection(Self { lower: T::ZERO, upper: T::INFINITY });
        if positive.is_empty() { positive } else { positive.rising(T::sqrt) }
    }

    /// Of the occupancies, which are in `[0, 1]`: rounding may have brought the interval beyond.
    fn entropy(self) -> Self {
        let p = self.intersection(Self { lower: T::ZERO, upper: T::ONE });
        if p.is_empty() { p } else { T::entropy(p).intersection(Self { lower: T::ZERO, upper: T::ONE }) }
    }

    fn entropy_from_log_odds(self) -> Self {
        if self.is_empty() {
            return self;
        }
        T::entropy_from_log_odds(self).intersection(Self { lower: T::ZERO, upper: T::ONE })
    }
}
