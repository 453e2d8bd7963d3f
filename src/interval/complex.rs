//! Rectangles of the complex plane, [`Complex`]: they bound a function on a neighbourhood of a real interval, and prove
//! that it is analytic there.
//!
//! An operation gives a rectangle that contains its result for any numbers of its arguments. If the function is not known
//! to be analytic at each of them, and real where they are, the result is [`NOT_ANALYTIC`](Complex::NOT_ANALYTIC), and so
//! is that of every later operation. `ln` and `√` have their principal branches, cut along the negative axis, and are
//! analytic away from the cut.
//!
//! A few digits suffice here: the magnitude is only a factor of the remainder of a rule.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::ends::Interval;
use crate::scalar::Scalar;

/// The intervals of real and of imaginary parts.
type RealInterval = Interval<f64>;

/// The complex numbers with real part in one interval and imaginary part in another.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Complex {
    re: RealInterval,
    im: RealInterval,
    /// The rectangle of which this is the exponential, if it is one: its logarithm, exactly.
    ///
    /// `ln(e^z) = z` on the real axis, so `z` is its analytic continuation, also where the principal branch has jumped.
    logarithm: Option<(RealInterval, RealInterval)>,
}

const ZERO: RealInterval = Interval::point(0.0);
const ONE: RealInterval = Interval::point(1.0);
const PI: RealInterval = Interval::between(core::f64::consts::PI, core::f64::consts::PI.next_up());

impl Complex {
    /// The value where a function is not known to be analytic.
    pub(crate) const NOT_ANALYTIC: Self =
        Self { re: RealInterval::EMPTY, im: RealInterval::EMPTY, logarithm: None };

    /// Creates the rectangle of two intervals.
    pub(crate) const fn new(re: RealInterval, im: RealInterval) -> Self {
        Self { re, im, logarithm: None }
    }

    /// Bounds the magnitude of each number: finite only if the function is analytic on the whole rectangle.
    pub(crate) fn bound(self) -> f64 {
        if self.re.is_bounded() && self.im.is_bounded() {
            // |z| <= |re| + |im|, the sum rounded upwards.
            (RealInterval::point(self.re.magnitude()) + RealInterval::point(self.im.magnitude())).upper()
        } else {
            f64::INFINITY
        }
    }

    /// Returns whether all numbers are real.
    fn is_real(self) -> bool {
        self.im == ZERO
    }

    /// Returns whether no number is 0 or negative.
    fn avoids_cut(self) -> bool {
        self.re.lower() > 0.0 || self.im.lower() > 0.0 || self.im.upper() < 0.0
    }

    /// Encloses `|z|^2`.
    fn square_magnitude(self) -> RealInterval {
        // Squares, not products: neither is below 0.
        self.re.square() + self.im.square()
    }

    /// Encloses the argument, for a rectangle that avoids the cut.
    fn argument(self) -> RealInterval {
        let half = RealInterval::constant(0.5) * PI;
        // A quotient whose divisor has no 0: by the half plane in which the rectangle lies.
        if self.re.lower() > 0.0 {
            arctangent(self.im / self.re)
        } else if self.im.lower() > 0.0 {
            half - arctangent(self.re / self.im)
        } else {
            -half - arctangent(self.re / self.im)
        }
    }

    /// Returns the rectangle, or its opposite if that lies to the right.
    fn to_the_right(self) -> Self {
        // For even functions: the half plane where e^-l is small.
        if self.re.upper() < 0.0 { -self } else { self }
    }
}

/// Encloses `1 - e^z = -z (1 + z/2 + r)`, with all digits for small `z`: `|r| <= |z|^2 / 5` for `|z| <= 1/2`.
fn one_minus_exponential(z: Complex) -> Complex {
    // 1/6 + |z|/24 + ... <= 1/5 for |z| <= 1/2: integration.md, "Rectangles".
    let rest = (z.square_magnitude() * RealInterval::constant(0.2)).upper();
    let rest = RealInterval::between(-rest, rest);
    -z * (Complex::constant(1.0) + Complex::constant(0.5) * z + Complex::new(rest, rest))
}

/// Encloses a rising odd function from lower and upper bounds of its values at numbers that are not negative.
fn odd(x: RealInterval, bounds: impl Fn(f64) -> (f64, f64)) -> RealInterval {
    let end = |x: f64| {
        let (lower, upper) = bounds(x.abs());
        if x < 0.0 { (-upper, -lower) } else { (lower, upper) }
    };
    // Rising: the ends tell.
    RealInterval::between(end(x.lower()).0, end(x.upper()).1)
}

/// Widens `v >= 0` by `2^-36` of its value, more than the truncation and the roundings of the functions below. All tiny
/// numbers get one pair of bounds, so that nothing underflows. All functions here are 0 at 0, exactly.
fn about(v: f64) -> (f64, f64) {
    const MARGIN: f64 = 1.0 / (1_u64 << 36) as f64;
    const TINY: f64 = 1e-290;
    if v == 0.0 {
        (0.0, 0.0)
    } else if v < TINY {
        (0.0, 2.0 * TINY)
    } else {
        (v * (1.0 - MARGIN), v * (1.0 + MARGIN))
    }
}

/// Encloses `sin x` for `|x| <= 1.57 < π/2`: its series up to `x^15`; the next term is below `2^-37` of the sum.
fn sine(x: RealInterval) -> RealInterval {
    odd(x, |x| {
        let square = x * x;
        // Terms alternate and fall: what is left out is below x^17 / 17!, 2^-37 of the sum, within the margin.
        about(x * (1..=7).rev().fold(1.0, |sum, k| 1.0 - sum * square / f64::from(2 * k * (2 * k + 1))))
    })
}

/// Encloses `cos x` for `|x| <= 1.57`: `1 - cos x` by its series up to `x^16`; the next term is below `2^-40` of the sum.
fn cosine(x: RealInterval) -> RealInterval {
    let versine = |x: f64| {
        let square = x * x;
        // Likewise: x^18 / 18! is below 2^-40 of the sum.
        about(
            0.5 * square
                * (2..=8).rev().fold(1.0, |sum, k| 1.0 - sum * square / f64::from(2 * k * (2 * k - 1))),
        )
    };
    // 1 - cos is even and rises with |x|.
    let (far, near) = (x.magnitude(), x.lower().max(-x.upper()).max(0.0));
    ONE - RealInterval::between(versine(near).0, versine(far).1)
}

/// Encloses `arctan x` between the fourth and the fifth convergent of Lambert's continued fraction, which alternate about it.
fn arctangent(x: RealInterval) -> RealInterval {
    odd(x, |x| {
        if x > 1.0 {
            let (lower, upper) = convergents(1.0 / x);
            // The quotient's rounding is in the margins.
            let half = RealInterval::constant(0.5) * PI;
            return (
                (half - RealInterval::point(upper)).lower(),
                (half - RealInterval::point(lower)).upper(),
            );
        }
        convergents(x)
    })
}

/// Returns the fourth and the fifth convergent at `x` in `[0, 1]`, each moved outward by the margin.
fn convergents(x: f64) -> (f64, f64) {
    let square = x * x;
    // Lambert's fraction has positive terms, so its convergents lie alternately below and above arctan.
    let fourth = x * (105.0 + 55.0 * square) / (105.0 + square * (90.0 + 9.0 * square));
    let fifth = x * (945.0 + square * (735.0 + 64.0 * square)) / (945.0 + square * (1050.0 + 225.0 * square));
    (about(fourth).0, about(fifth).1)
}

impl Neg for Complex {
    type Output = Self;
    fn neg(self) -> Self {
        // Not an exponential any more: the logarithm is dropped, as in every operation but exp.
        Self::new(-self.re, -self.im)
    }
}

impl Add for Complex {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.re + other.re, self.im + other.im)
    }
}

impl Sub for Complex {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        // 1 - e^z near 0, where the difference of the two loses its digits.
        if self.is_real()
            && self.re == ONE
            && let Some((re, im)) = other.logarithm
            && re.magnitude().max(im.magnitude()) <= 1.0 / 1024.0
        {
            return one_minus_exponential(Self::new(re, im));
        }
        Self::new(self.re - other.re, self.im - other.im)
    }
}

impl Mul for Complex {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        if self.is_real() {
            // A real factor: no products to add up, and real stays real.
            return Self::new(self.re * other.re, self.re * other.im);
        }
        if other.is_real() {
            return other * self;
        }
        // Intervals as if independent: wider than need be, and never too narrow ("Intervals").
        Self::new(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)
    }
}

impl Div for Complex {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if other.is_real() && !other.re.contains(0.0) {
            return Self::new(self.re / other.re, self.im / other.re);
        }
        // a / c = a c* / |c|^2, analytic unless the divisor may be 0.
        let square = other.square_magnitude();
        if square.is_empty() || square.lower() <= 0.0 {
            return Self::NOT_ANALYTIC;
        }
        // The conjugate is not analytic, the quotient is: only its values matter here.
        let product = self * Self::new(other.re, -other.im);
        Self::new(product.re / square, product.im / square)
    }
}

impl Scalar for Complex {
    fn constant(x: f64) -> Self {
        if x.is_finite() { Self::new(RealInterval::point(x), ZERO) } else { Self::NOT_ANALYTIC }
    }

    fn ln_2() -> Self {
        Self::new(RealInterval::ln_2(), ZERO)
    }

    /// Encloses `re^2 - im^2 + 2 i re im`: neither square is negative.
    fn square(self) -> Self {
        let product = self.re * self.im;
        Self::new(self.re.square() - self.im.square(), product + product)
    }

    /// Encloses `e^re (cos im + i sin im)`.
    fn exp(self) -> Self {
        let magnitude = self.re.exp();
        // Beyond 1.57 the whole range serves: sine and cosine are in [-1, 1].
        let (cosine, sine) = if self.is_real() {
            (ONE, ZERO)
        } else if self.im.magnitude() <= 1.57 {
            (cosine(self.im), sine(self.im))
        } else {
            (RealInterval::between(-1.0, 1.0), RealInterval::between(-1.0, 1.0))
        };
        // The branch for ln, "Rectangles".
        let logarithm = Some((self.re, self.im));
        Self { re: magnitude * cosine, im: magnitude * sine, logarithm }
    }

    fn ln(self) -> Self {
        // The logarithm of an exponential is its argument: the same branch, without loss.
        if let Some((re, im)) = self.logarithm {
            return Self::new(re, im);
        }
        if !self.avoids_cut() {
            return Self::NOT_ANALYTIC;
        }
        if self.is_real() {
            return Self::new(self.re.ln(), ZERO);
        }
        // ln |c|^2 / 2 + i arg c.
        Self::new(RealInterval::constant(0.5) * self.square_magnitude().ln(), self.argument())
    }

    fn sqrt(self) -> Self {
        // By the principal logarithm: not analytic where that is not.
        (Self::constant(0.5) * self.ln()).exp()
    }

    /// Encloses Eq. 1 with `ln p` and `ln(1 - p)`, both away from the cut.
    fn entropy(self) -> Self {
        // p ln p + (1 - p) ln(1 - p); both logarithms hand on that they are not analytic.
        let rest = Self::constant(1.0) - self;
        -(self * self.ln() + rest * rest.ln()) / Self::ln_2()
    }

    /// Encloses `(ln(1 + x) + l x / (1 + x)) / ln 2` with `x = e^-l`: analytic where `|im l| < π`, and where `re l > 0`, for
    /// there `|x| < 1`. It is even, so it is analytic where `re l < 0`, too.
    fn entropy_from_log_odds(self) -> Self {
        let l = self.to_the_right();
        if !(l.re.lower() > 0.0 || l.im.magnitude() < PI.lower()) {
            return Self::NOT_ANALYTIC;
        }
        // re l > 0, so |x| < 1, or |im l| < π: 1 + x is never on the cut.
        let x = (-l).exp();
        let sum = Self::constant(1.0) + x;
        (sum.ln() + l * x / sum) / Self::ln_2()
    }
}

#[cfg(test)]
mod tests;
