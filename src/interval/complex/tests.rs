//! At points of a rectangle, in plain floating point: each result lies in the rectangle's, and small rectangles stay
//! small.

use super::*;
use approx::abs_diff_eq;
use proptest::prelude::*;

/// A complex number in plain floating point, by functions that are correctly rounded.
#[derive(Clone, Copy, Debug)]
struct Point(f64, f64);

impl Point {
    fn plus(self, other: Self) -> Self {
        Self(self.0 + other.0, self.1 + other.1)
    }

    fn minus(self, other: Self) -> Self {
        Self(self.0 - other.0, self.1 - other.1)
    }

    fn times(self, other: Self) -> Self {
        Self(self.0 * other.0 - self.1 * other.1, self.0 * other.1 + self.1 * other.0)
    }

    fn over(self, other: Self) -> Self {
        let square = other.0 * other.0 + other.1 * other.1;
        let product = self.times(Self(other.0, -other.1));
        Self(product.0 / square, product.1 / square)
    }

    fn exp(self) -> Self {
        let magnitude = core_math::exp(self.0);
        Self(magnitude * core_math::cos(self.1), magnitude * core_math::sin(self.1))
    }

    fn ln(self) -> Self {
        Self(core_math::log(core_math::hypot(self.0, self.1)), core_math::atan2(self.1, self.0))
    }

    fn sqrt(self) -> Self {
        Self(0.5, 0.0).times(self.ln()).exp()
    }

    fn entropy(self) -> Self {
        let rest = Self(1.0, 0.0).minus(self);
        self.times(self.ln()).plus(rest.times(rest.ln())).over(Self(-core_math::log(2.0), 0.0))
    }

    fn entropy_from_log_odds(self) -> Self {
        let l = if self.0 < 0.0 { Self(-self.0, -self.1) } else { self };
        let x = Self(-l.0, -l.1).exp();
        let sum = Self(1.0, 0.0).plus(x);
        sum.ln().plus(l.times(x).over(sum)).over(Self(core_math::log(2.0), 0.0))
    }
}

/// A rectangle of the given size, somewhere about the origin, and points in it, its corners among them.
#[derive(Clone, Debug)]
struct Case {
    rectangle: Complex,
    points: Vec<Point>,
}

use std::vec::Vec;

fn case(size: f64) -> impl Strategy<Value = Case> {
    (-4.0..4.0, prop_oneof![Just(0.0), -4.0..4.0], 0.0..=size, 0.0..=size).prop_map(
        |(x, y, width, height)| {
            let (right, top) = (x + width, y + height);
            let rectangle = Complex::new(Interval::between(x, right), Interval::between(y, top));
            let steps = [0.0, 0.3, 0.7, 1.0];
            let points = steps
                .iter()
                .flat_map(|s| steps.map(|t| Point((x + s * width).min(right), (y + t * height).min(top))))
                .collect();
            Case { rectangle, points }
        },
    )
}

type Function = (&'static str, fn(Complex) -> Complex, fn(Point) -> Point);

const FUNCTIONS: [Function; 7] = [
    ("square", |z| z * z, |z| z.times(z)),
    ("inverse", |z| Complex::constant(1.0) / z, |z| Point(1.0, 0.0).over(z)),
    ("exp", Complex::exp, Point::exp),
    ("ln", Complex::ln, Point::ln),
    ("sqrt", Complex::sqrt, Point::sqrt),
    ("entropy", Complex::entropy, Point::entropy),
    ("log-odds", Complex::entropy_from_log_odds, Point::entropy_from_log_odds),
];

/// How far plain floating point may be off: some operations on numbers below `2^10`, each within `2^-53` of it.
const PLAIN: f64 = 1.0 / (1_u64 << 36) as f64;

fn holds(x: RealInterval, value: f64, magnitude: f64) -> bool {
    let slack = PLAIN * (1.0 + magnitude);
    x.lower() - slack <= value && value <= x.upper() + slack
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn every_point_goes_into_the_rectangle(case in prop_oneof![case(3.0), case(0.1), case(0.0)]) {
        for (name, function, at) in FUNCTIONS {
            let image = function(case.rectangle);
            if image.bound().is_infinite() {
                continue;
            }
            for point in &case.points {
                let value = at(*point);
                let magnitude = value.0.abs() + value.1.abs();
                prop_assert!(magnitude <= image.bound() * (1.0 + PLAIN) + PLAIN, "{name} at {point:?}");
                prop_assert!(
                    holds(image.re, value.0, magnitude) && holds(image.im, value.1, magnitude),
                    "{name} at {point:?}: {value:?} not in {image:?}"
                );
            }
        }
    }

    /// Away from singularities, a rectangle of size `10^-3` has an image not much larger. The arc tangent's bounds
    /// are up to `2^-9` apart.
    #[test]
    fn small_rectangles_stay_small(case in case(1e-3)) {
        let Complex { re, im, .. } = case.rectangle;
        let distance = |x: f64| core_math::hypot(re.lower() - x, im.lower());
        if distance(0.0) < 0.5 || distance(1.0) < 0.5 || re.lower() < 0.1 && im.lower().abs() < 0.1 {
            return Ok(());
        }
        for (name, function, _) in FUNCTIONS {
            let image = function(case.rectangle);
            if name == "log-odds" || name == "entropy" && re.lower() > 0.9 && im.contains(0.0) {
                continue;
            }
            prop_assert!(image.bound().is_finite(), "{name} of {:?}", case.rectangle);
            if im.magnitude() > 1.57 && name == "exp" {
                continue;
            }
            prop_assert!(image.re.width().max(image.im.width()) < 0.05 * (1.0 + image.bound()), "{name}: {image:?}");
        }
    }

    /// `1 - e^z` for small `z` keeps its digits: against `-z (1 + z/2 + z^2/6)`, of which the next term is `z^3 /
    /// 24`.
    #[test]
    fn small_differences_keep_their_digits(x in -1.0_f64..1.0, y in -1.0_f64..1.0, k in 11_i32..40) {
        let scale = core_math::exp2(-f64::from(k));
        let z = Point(x * scale, y * scale);
        let rectangle = Complex::new(Interval::point(z.0), Interval::point(z.1));
        let image = Complex::constant(1.0) - rectangle.exp();
        let (half, sixth) = (z.times(Point(0.5, 0.0)), z.times(z).times(Point(1.0 / 6.0, 0.0)));
        let exact = Point(-z.0, -z.1).times(Point(1.0, 0.0).plus(half).plus(sixth));
        let slack = scale * (scale * scale * scale + 1e-15);
        for (part, value) in [(image.re, exact.0), (image.im, exact.1)] {
            prop_assert!(part.lower() - slack <= value && value <= part.upper() + slack);
            prop_assert!(part.width() <= 4.0 * scale * scale * scale + slack);
        }
    }
}

/// The logarithm of an exponential goes on where the principal branch would have jumped.
#[test]
fn the_logarithm_of_an_exponential_is_its_argument() {
    let z = Complex::new(Interval::between(-2.0, -1.5), Interval::between(2.5, 7.0));
    let back = z.exp().ln();
    assert_eq!((back.re, back.im), (z.re, z.im));
    // A copy remembers, a product does not.
    assert!((z.exp() * Complex::constant(1.0)).ln().bound().is_infinite());
}

#[test]
fn nothing_is_analytic_across_a_cut_or_a_pole() {
    let about = |x: f64| Complex::new(Interval::between(x - 0.25, x + 0.25), Interval::between(0.0, 0.5));
    let image = |f: fn(Complex) -> Complex, x| f(about(x)).bound();
    assert!(image(Complex::ln, 0.125).is_infinite() && image(Complex::ln, -3.0).is_infinite());
    assert!(image(Complex::ln, 0.75).is_finite());
    assert!(image(Complex::sqrt, 0.125).is_infinite() && image(Complex::sqrt, 0.75).is_finite());
    assert!(image(|z| Complex::constant(3.0) / z, 0.125).is_infinite());
    assert!(image(Complex::entropy, 0.125).is_infinite() && image(Complex::entropy, 0.875).is_infinite());
    assert!(image(Complex::entropy, 0.5).is_finite() && image(Complex::entropy, 1.5).is_infinite());
    // A failure stays one, whatever comes after.
    assert!(image(|z| -(z.ln() - Complex::constant(1000.0)).exp(), -0.125).is_infinite());
    assert!(image(|z| Complex::constant(0.0) * z.ln(), -0.125).is_infinite());
    assert!(image(|z| Complex::constant(f64::NAN) + z, 0.5).is_infinite());
}

/// The poles of the entropy at log-odds `l` are at `±iπ`, `±3iπ`, ...; to their right all is well.
#[test]
fn log_odds_are_analytic_between_the_poles_and_beside_them() {
    let bound = |x: f64, y: f64| {
        Complex::new(Interval::between(x - 0.125, x + 0.125), Interval::between(y - 0.125, y + 0.125))
            .entropy_from_log_odds()
            .bound()
    };
    assert!(bound(0.0, 3.125).is_infinite() && bound(0.0, 9.375).is_infinite());
    assert!(bound(0.0, 1.0) < 4.0 && bound(3.0, 9.375) < 4.0 && bound(-3.0, 3.125) < 4.0);
}

/// With 0 at a corner or on a side, also where 0 times it, or its root, would have bounds.
#[test]
fn nothing_is_analytic_that_touches_a_cut_or_a_pole() {
    let [side, corner] =
        [-1.0, 0.0].map(|lower| Complex::new(Interval::between(0.0, 1.0), Interval::between(lower, 1.0)));
    for rectangle in [side, corner] {
        assert!(rectangle.sqrt().bound().is_infinite());
        assert!((Complex::constant(0.0) / rectangle).bound().is_infinite());
    }
}

/// Only `1 - e^z` is computed as such.
#[test]
fn a_difference_from_another_number_is_not_small() {
    let power = Complex::new(Interval::point(1e-9), Interval::point(1e-9)).exp();
    for minuend in [Complex::constant(3.0), Complex::new(ONE, Interval::point(2.0))] {
        assert!((minuend - power).bound() > 1.9);
    }
}

#[test]
fn a_real_divisor_divides_the_parts() {
    let (x, y, d) = (RealInterval::point(0.1), RealInterval::point(0.7), RealInterval::point(0.3));
    let quotient = Complex::new(x, y) / Complex::new(d, ZERO);
    assert_eq!((quotient.re, quotient.im), (x / d, y / d));
}

/// On either side of it, however small; tiny numbers stay tiny.
#[test]
fn about_a_number() {
    for v in [f64::from_bits(1), 1e-310, 1e-291, 1e-290, 1e-289, 0.7, 1e300] {
        let (lower, upper) = about(v);
        assert!(0.0 <= lower && lower < v && v < upper, "{v:e}");
        assert!(upper <= (v * 1.000_000_1).max(2.1e-290), "{v:e}");
    }
    assert_eq!(about(0.0), (0.0, 0.0));
}

/// Two convergents in a row are apart by the product of their partial numerators, `x^9 (1 2 3 4)^2`, over that of their
/// denominators.
#[test]
fn the_convergents_are_those_of_the_arc_tangent() {
    for k in 1..=64 {
        let x = f64::from(k) / 64.0;
        let s = x * x;
        let (lower, upper) = convergents(x);
        let arctangent = core_math::atan(x);
        assert!(lower <= arctangent && arctangent <= upper, "{x}");
        let denominators = (105.0 + s * (90.0 + s * 9.0)) * (945.0 + s * (1050.0 + s * 225.0));
        let apart = s * s * s * s * x * 576.0 / denominators;
        assert!(abs_diff_eq!(upper - lower, apart, epsilon = x / f64::from(1 << 30)), "{x}");
    }
}
