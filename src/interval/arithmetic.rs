//! The arithmetic of intervals: each result is the hull of the results at the ends, rounded outwards
//! ([`integration`](crate::book::integration), "Intervals").

use super::endpoint::{Endpoint, Toward};
use super::ends::Interval;
use crate::error::Error;
use crate::real::Real;
use crate::scalar::Scalar;
use Toward::{Down, Up};
use core::ops::{Add, Div, Mul, Neg, Sub};

impl<T: Real + Endpoint> Interval<T> {
    /// Creates the interval from `lower` to `upper`, ends included.
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
    /// The empty interval, the result of a function outside its domain.
    pub const EMPTY: Self = Self { lower: T::INFINITY, upper: T::NEG_INFINITY };

    /// The interval of all numbers, without bounds.
    pub const WHOLE: Self = Self { lower: T::NEG_INFINITY, upper: T::INFINITY };

    /// Returns the lower end; `inf` if empty.
    pub fn lower(&self) -> T {
        self.lower
    }

    /// Returns the upper end; `-inf` if empty.
    pub fn upper(&self) -> T {
        self.upper
    }

    /// Returns whether the interval contains no number.
    pub fn is_empty(&self) -> bool {
        self.lower > self.upper
    }

    /// Returns whether both ends are finite.
    pub fn is_bounded(&self) -> bool {
        T::NEG_INFINITY < self.lower && self.lower <= self.upper && self.upper < T::INFINITY
    }

    /// Returns whether the interval contains `x`.
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

    /// Computes `upper - lower`, rounded up, within the spacing of floats there (proved in
    /// [`integration`](crate::book::integration)); `-inf` if empty.
    ///
    /// ```
    /// use mean_information::interval::Interval;
    /// assert_eq!(Interval::new(-0.25_f64, 3.0)?.width(), 3.25);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn width(&self) -> T {
        // Negation is exact, so this is one rounding.
        self.upper.add(-self.lower, Up)
    }

    /// Returns the largest magnitude in the interval.
    pub(crate) fn magnitude(&self) -> T {
        max(self.upper, -self.lower)
    }

    /// Returns the smallest interval that contains both.
    pub(crate) fn hull(self, other: Self) -> Self {
        // The empty interval has inf below -inf: it adds nothing.
        Self { lower: min(self.lower, other.lower), upper: max(self.upper, other.upper) }
    }

    /// Returns the numbers that both intervals contain.
    pub(crate) fn intersection(self, other: Self) -> Self {
        let common = Self { lower: max(self.lower, other.lower), upper: min(self.upper, other.upper) };
        // One form of the empty interval, which == knows.
        if common.is_empty() { Self::EMPTY } else { common }
    }

    /// Encloses the values of a rising function; `at` encloses its value at one number. A point is evaluated once.
    pub(super) fn rising(self, at: impl Fn(T) -> Self) -> Self {
        // Rising: the lower end of the first value, the upper end of the last.
        let lower = at(self.lower);
        let upper = if self.lower == self.upper { lower } else { at(self.upper) };
        Self { lower: lower.lower, upper: upper.upper }
    }
}

/// Returns the smaller of two numbers that are not NaN.
pub(super) fn min<T: PartialOrd>(a: T, b: T) -> T {
    if b < a { b } else { a }
}

/// Returns the larger of two numbers that are not NaN.
pub(super) fn max<T: PartialOrd>(a: T, b: T) -> T {
    if b > a { b } else { a }
}

impl<T: Endpoint> Neg for Interval<T> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        // Exact: the ends change places.
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
        // The sum rises with both numbers: its ends are those of the sums of ends, rounded outwards.
        Self { lower: self.lower.add(other.lower, Down), upper: self.upper.add(other.upper, Up) }
    }
}

impl<T: Endpoint> Sub for Interval<T> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        // Negation rounds nothing: the ends of the difference are those of a sum.
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
        // Opposites until neither upper end is negative: exact, and four cases are left.
        if self.upper < T::ZERO {
            return -(-self * other);
        }
        if other.upper < T::ZERO {
            return -(self * -other);
        }
        // The hull of the products of the ends; here both upper ends are at least 0.
        let (a, b, c, d) = (self.lower, self.upper, other.lower, other.upper);
        let lower = match (a < T::ZERO, c < T::ZERO) {
            (false, false) => a.mul(c, Down),
            (true, false) => a.mul(d, Down),
            (false, true) => b.mul(c, Down),
            (true, true) => min(a.mul(d, Down), b.mul(c, Down)),
        };
        // Two negative lower ends may have the largest product.
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
        // Both signs are changed, so that the divisor is not negative.
        if other.upper <= T::ZERO {
            return -self / -other;
        }
        // With 0 inside the divisor the quotient has no bounds.
        if other.lower < T::ZERO {
            return Self::WHOLE;
        }
        // A numerator of either sign is nearest to 0 over the larger end of the divisor.
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
        // A double may lie between two floats of T.
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
        // The part on which the function is defined: integration.md, "Intervals".
        let positive = self.intersection(Self { lower: T::ZERO, upper: T::INFINITY });
        if positive.is_empty() || positive.upper == T::ZERO { Self::EMPTY } else { positive.rising(T::ln) }
    }

    fn sqrt(self) -> Self {
        // The part on which the function is defined.
        let positive = self.intersection(Self { lower: T::ZERO, upper: T::INFINITY });
        if positive.is_empty() { positive } else { positive.rising(T::sqrt) }
    }

    /// Encloses the entropies of the occupancies in the interval. Those outside `[0, 1]` are left out: rounding may have
    /// widened the interval beyond.
    fn entropy(self) -> Self {
        let p = self.intersection(Self { lower: T::ZERO, upper: T::ONE });
        if p.is_empty() { p } else { T::entropy(p).intersection(Self { lower: T::ZERO, upper: T::ONE }) }
    }

    fn entropy_from_log_odds(self) -> Self {
        if self.is_empty() {
            return self;
        }
        // Entropies are in [0, 1]: what rounding added beyond is cut off.
        T::entropy_from_log_odds(self).intersection(Self { lower: T::ZERO, upper: T::ONE })
    }
}
