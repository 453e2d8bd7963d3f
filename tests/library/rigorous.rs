//! Rigorous integration: against integrals that are known in closed form, by their relations, and where it must give
//! up.

mod peaks;

use mean_information::Real;
use mean_information::estimate::{Enclosure, Status};
use mean_information::interval::Interval;
use mean_information::quadrature::rigorous::Rigorous;
use mean_information::scalar::{Integrand, Scalar};
use num_bigint::BigInt;
use proptest::prelude::*;

/// An integrand from an expression in `x`.
macro_rules! integrand {
    ($name:ident, $x:ident => $value:expr) => {
        struct $name;
        impl Integrand for $name {
            fn evaluate<S: Scalar>(&self, $x: S) -> S {
                $value
            }
        }
    };
}

fn number<S: Scalar>(x: f64) -> S {
    S::constant(x)
}

use integrand;

integrand!(Cubic, x => x.clone() * x.clone() * x.clone() - number::<S>(2.0) * x + number(0.25));
integrand!(Witch, x => number::<S>(1.0) / (number::<S>(1.0) + x.clone() * x));
integrand!(Spike, x => number::<S>(1.0) / (number::<S>(f64::from_parts(1, -20)) + x.clone() * x));
integrand!(Exponential, x => x.exp());
integrand!(Root, x => x.sqrt());
integrand!(XLnX, x => x.clone() * x.ln());
integrand!(Peak, x => {
    let t = x - number(0.3125);
    (number::<S>(-1000.0) * t.clone() * t).exp()
});
integrand!(Logistic, x => number::<S>(1.0) / (number::<S>(1.0) + (number::<S>(-20.0) * (x - number(0.3125))).exp()));
integrand!(Entropy, x => x.entropy());
integrand!(EntropyOfLogOdds, x => x.entropy_from_log_odds());
integrand!(Odd, x => x.clone() * (-(x.clone() * x)).exp());
integrand!(Cancelling, x => (number::<S>(1.0) / (number::<S>(1.0) + x.clone() * x)).entropy());
integrand!(Pole, x => number::<S>(1.0) / x);
integrand!(Undefined, x => (x - number(2.0)).sqrt());
integrand!(OneFunction, x => x.x_ln_x());
integrand!(Hole, x => (-(number::<S>(1.0) / x.square())).exp());

/// `T_12`, which oscillates between -1 and 1.
struct Chebyshev;
impl Integrand for Chebyshev {
    fn evaluate<S: Scalar>(&self, x: S) -> S {
        let (mut before, mut value) = (number::<S>(1.0), x.clone());
        for _ in 1..12 {
            let next = number::<S>(2.0) * x.clone() * value.clone() - before;
            (before, value) = (value, next);
        }
        value
    }
}

/// Whether a decimal that is correct to a unit of its last digit can lie in the enclosure.
fn holds<T: Real>(enclosure: Enclosure<T>, text: &str) -> bool {
    let (sign, text) = text.strip_prefix('-').map_or((1, text), |rest| (-1, rest));
    let (whole, fraction) = text.split_once('.').expect("a point");
    let digits = sign * [whole, fraction].concat().parse::<BigInt>().expect("digits");
    let unit = BigInt::from(10).pow(fraction.len() as u32);
    let scaled = |x: T| {
        let (m, e) = x.parts();
        let magnitude = (BigInt::from(m) << (1100 + e)) * &unit;
        if x.is_sign_negative() { -magnitude } else { magnitude }
    };
    scaled(enclosure.lower) <= (&digits + 1) << 1100_u32
        && (digits - 1) << 1100_u32 <= scaled(enclosure.upper)
}

/// At the finest tolerance the ends are neighbours, or two floats apart, in both formats; at a coarse one they are as
/// wide as asked for at most; and they always contain the integral.
fn check(f: &impl Integrand, from: f64, to: f64, expected: &str) {
    let finest = Rigorous::<f64>::default().integrate(f, from, to).unwrap();
    assert!(holds(finest, expected), "{expected} is not in {finest:?}");
    assert_eq!(finest.status, Status::Converged, "{expected}");
    assert!(finest.upper <= finest.lower.next_up().next_up(), "{expected} in {finest:?}");
    let single = Rigorous::<f32>::default().integrate(f, from as f32, to as f32).unwrap();
    assert!(holds(single, expected), "{expected} is not in {single:?}");
    assert!(single.upper <= single.lower.next_up().next_up(), "{expected} in {single:?}");
    for tolerance in [0.25, 1e-2, 1e-4, 1e-8] {
        let coarse = Rigorous::new().relative(tolerance).integrate(f, from, to).unwrap();
        assert!(holds(coarse, expected), "{expected} is not in {coarse:?}");
        assert_eq!(coarse.status, Status::Converged, "{expected}");
        assert!(
            coarse.width() <= tolerance * finest.lower.abs().max(finest.upper.abs()) + 2.0 * f64::EPSILON
        );
        assert!(coarse.evaluations <= finest.evaluations, "{expected}");
    }
}

/// Closed forms, by mpmath 1.3 at 45 digits; but for the third from last, which is `quad` of the definition.
#[test]
fn known_integrals() {
    check(&Cubic, 0.0, 2.0, "0.5");
    // π/4
    check(&Witch, 0.0, 1.0, "0.7853981633974483096156608458198757210493");
    // 2^11 arctan 2^10
    check(&Spike, -1.0, 1.0, "3214.990877911730789992280599429189941754");
    // e^2.75 - e^0.25
    check(&Exponential, 0.25, 2.75, "14.35860646750043012613927747809422238670");
    // (2/3) 2.5^(3/2)
    check(&Root, 0.0, 2.5, "2.635231383473649443332411287027265444766");
    // x^2 (2 ln x - 1) / 4 between the ends
    check(&XLnX, f64::from_parts(1, -10), 2.0, "0.3862979047217876675238745347412731141811");
    // √(π/1000)/2 (erf(√1000 1.6875) + erf(√1000 0.3125))
    check(&Peak, 0.0, 2.0, "0.05604991216397928699311282433868800893854");
    // (ln(1 + e^53.75) - ln(1 + e^-6.25)) / 20
    check(&Logistic, 0.0, 3.0, "2.687403570339789030961083720082679320349");
    check(&EntropyOfLogOdds, -32.0, 3.25, "4.457097118236375130685781785982496502758");
    // (T_13 / 13 - T_11 / 11) / 2 between the ends
    check(&Chebyshev, -0.75, 0.5, "-0.03758037006938374125874125874125874125874");
    // 1 / (2 ln 2), both ends singular
    check(&Entropy, 0.0, 1.0, "0.7213475204444817036799623405009460687133");
}

/// `H(e^(-t^2 / 2))` over `t = length u`, an end that is no float.
struct Beam {
    ratio: Option<[f64; 2]>,
}
impl Beam {
    /// `z / σ`, or `√(ln 4)`.
    fn length<S: Scalar>(&self) -> S {
        match self.ratio {
            Some([range, sigma]) => number::<S>(range) / number(sigma),
            None => (number::<S>(2.0) * S::ln_2()).sqrt(),
        }
    }
}
impl Integrand for Beam {
    fn evaluate<S: Scalar>(&self, u: S) -> S {
        let t = self.length::<S>() * u;
        self.length::<S>() * (number::<S>(-0.5) * t.clone() * t).exp().entropy()
    }
}

/// Eq. 7 at `z = 2`, `σ = 0.2` (the ratio of these floats), from two enclosures: the limit is in an interval of some
/// ulps.
#[test]
fn the_limit_of_the_room() {
    let integrate = |beam: &Beam| {
        let integral = Rigorous::<f64>::default().integrate(beam, 0.0, 1.0).unwrap();
        assert_eq!(integral.status, Status::Converged);
        assert!(integral.evaluations < 800);
        Interval::new(integral.lower, integral.upper).unwrap()
    };
    let (near, far) = (Beam { ratio: Some([2.0, 0.2]) }, Beam { ratio: None });
    let stretch = near.length::<Interval<f64>>() + far.length();
    let limit = Interval::constant(1.0) - (integrate(&near) + integrate(&far)) / stretch;
    assert!(limit.contains(0.789_336_888_025_651_4));
    // Two integrals within 2 ulp of values up to 2, their sum, a quotient of 0.2 and the difference: 4 ulp of 1.
    assert!(limit.width() <= 2.0 * f64::EPSILON);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// Parts add up, the ends change places with the sign, and other ends that are floats do as well.
    #[test]
    fn parts_add_up(
        from in -3.0_f64..3.0, length in 1e-3_f64..4.0, share in 0.0_f64..=1.0, width in 1e-15_f64..1e-3
    ) {
        let rule = Rigorous::new().absolute(width).relative(0.0);
        let to = from + length;
        let middle = (from + share * length).clamp(from, to);
        let integrals = |f: fn(&Rigorous<f64>, f64, f64) -> Enclosure<f64>| {
            let [whole, left, right, back] =
                [(from, to), (from, middle), (middle, to), (to, from)].map(|(a, b)| f(&rule, a, b));
            let between = |x: Enclosure<f64>| Interval::new(x.lower, x.upper).unwrap();
            let sum = between(left) + between(right);
            (whole.lower <= sum.upper() && sum.lower() <= whole.upper)
                && (back.lower, back.upper) == (-whole.upper, -whole.lower)
                && sum.width() <= 2.0 * width + 8.0 * f64::EPSILON * (1.0 + sum.upper().abs())
        };
        prop_assert!(integrals(|rule, a, b| rule.integrate(&Exponential, a, b).unwrap()));
        prop_assert!(integrals(|rule, a, b| rule.integrate(&EntropyOfLogOdds, a, b).unwrap()));
        prop_assert!(integrals(|rule, a, b| rule.integrate(&Witch, a, b).unwrap()));
        let beam: fn(&Rigorous<f64>, f64, f64) -> Enclosure<f64> = |rule, a, b| {
            let beam = Beam { ratio: Some([7.0, 3.0]) };
            rule.integrate(&beam, a, b).unwrap()
        };
        prop_assert!(integrals(beam));
    }

    /// `int_a^b x^k = (b^(k+1) - a^(k+1)) / (k + 1)`, in integers.
    #[test]
    fn powers_are_integrated_exactly(a in -64_i32..64, b in -64_i32..64, k in 1_u32..9) {
        struct Power(u32);
        impl Integrand for Power {
            fn evaluate<S: Scalar>(&self, x: S) -> S {
                (1..self.0).fold(x.clone(), |power, _| power * x.clone())
            }
        }
        let integral = Rigorous::new().absolute(0.01).relative(0.0).integrate(&Power(k), f64::from(a) / 8.0, f64::from(b) / 8.0)?;
        // In units of 1 / (8^(k+1) (k+1)): integers below 2^53.
        let exact = i64::from(b).pow(k + 1) - i64::from(a).pow(k + 1);
        let unit = f64::from_parts(1, 3 * (k as i32 + 1)) * f64::from(k + 1);
        prop_assert!(integral.contains(exact as f64 / unit), "{integral:?} misses {exact} / {unit}");
        prop_assert!(integral.width() <= 0.02);
    }
}

#[test]
fn no_length_no_integral() {
    let rule = Rigorous::<f64>::default();
    let nothing = rule.integrate(&Pole, 0.0, 0.0).unwrap();
    assert_eq!((nothing.lower, nothing.upper, nothing.evaluations), (0.0, 0.0, 0));
    assert_eq!(nothing.status, Status::Converged);
    // Of length 2^-1074.
    let smallest = f64::from_bits(1);
    let integral = rule.integrate(&Exponential, 0.0, smallest).unwrap();
    assert!(integral.contains(smallest) && integral.upper <= 2.0 * smallest);
    let integral =
        Rigorous::new().absolute(1e300).relative(0.0).integrate(&Witch, -f64::MAX, f64::MAX).unwrap();
    assert!(integral.contains(core::f64::consts::PI));
}

/// The status names the stretch, and the enclosure has no bounds.
#[test]
fn where_there_is_no_integral() {
    let rule = Rigorous::<f64>::default();
    let undefined = rule.integrate(&Undefined, 0.25, 3.0).unwrap();
    let Status::NotFinite { lower, upper } = undefined.status else { panic!("{undefined:?}") };
    assert!(0.25 <= lower && upper <= 2.0);
    let pole = rule.integrate(&Pole, -1.0, 3.0).unwrap();
    let Status::Unresolved { lower, upper } = pole.status else { panic!("{pole:?}") };
    assert!(lower <= 0.0 && 0.0 <= upper && upper - lower < 1e-30);
    // x ln x has a limit at 0, but the range of the product of [0, ε] and [-inf, ln ε] has no bound.
    let product = rule.integrate(&XLnX, 0.0, 2.0).unwrap();
    assert!(matches!(product.status, Status::Unresolved { lower: 0.0, .. }));
    for nothing_known in [undefined, pole, product] {
        assert_eq!((nothing_known.lower, nothing_known.upper), (f64::NEG_INFINITY, f64::INFINITY));
        assert!(nothing_known.evaluations < 20_000);
    }
}

/// A panel over which the integrand is defined at an end alone has a range, and no integral.
#[test]
fn undefined_but_at_an_end_of_a_panel() {
    fn refused(f: &impl Integrand, from: f64, to: f64) {
        for rule in [Rigorous::<f64>::default(), Rigorous::new().relative(1e-3)] {
            let nothing_known = rule.integrate(f, from, to).unwrap();
            let Status::NotFinite { lower, upper } = nothing_known.status else {
                panic!("{nothing_known:?}")
            };
            assert!(from <= lower && lower < upper && upper <= to, "{nothing_known:?}");
            assert_eq!((nothing_known.lower, nothing_known.upper), (f64::NEG_INFINITY, f64::INFINITY));
        }
    }
    refused(&Root, -1.0, 1.0);
    refused(&Root, -2.0, 0.0);
    refused(&Entropy, 0.5, 1.5);
    refused(&Entropy, -1.0, 1.0);
    refused(&OneFunction, -1.0, 1.0);
    // Undefined at a single point only, the middle of the only panel: `int_(-1/4)^(1/4)` is below `e^-16 / 2`.
    let hole = Rigorous::new().absolute(1.0).relative(0.0).integrate(&Hole, -0.25_f64, 0.25).unwrap();
    assert_eq!((hole.lower, hole.status), (0.0, Status::Converged));
    assert!(hole.upper < 6e-8);
}

/// The points cancel, and no range has a bound: the pole is found, and not in as many evaluations as there may be.
#[test]
fn a_pole_in_the_middle_is_named() {
    let pole = Rigorous::<f64>::default().integrate(&Pole, -1.0, 1.0).unwrap();
    let Status::Unresolved { lower, upper } = pole.status else { panic!("{pole:?}") };
    assert!(lower <= 0.0 && 0.0 <= upper && upper - lower < 1e-30 && pole.evaluations < 2000, "{pole:?}");
}

/// Next to `t = 0` the occupancy is so near to 1 that 128 bits hold few digits of `1 - p`: what they hold is given,
/// at the usual price. `int_0^(1/1024)`, by mpmath 1.3 at 50 digits, `quad` of the definition.
#[test]
fn roundings_do_not_make_it_search_for_ever() {
    let beam = |denominator| Beam { ratio: Some([1.0, denominator]) };
    let integral = Rigorous::<f64>::default().integrate(&beam(1024.0), 0.0, 1.0).unwrap();
    assert!(holds(integral, "0.000000003632854738864173169948915295972996389"), "{integral:?}");
    assert!(
        integral.upper <= integral.lower.next_up().next_up() && integral.evaluations < 2000,
        "{integral:?}"
    );
    let integral = Rigorous::<f64>::default().integrate(&beam(1048576.0), 0.0, 1.0).unwrap();
    assert_eq!(integral.status, Status::RoundOff);
    assert!(integral.width() < 1e-9 * integral.upper && integral.evaluations < 2000, "{integral:?}");
}

/// `1 - p` from a rounded `p`: below `10^-8` rectangles find nothing analytic, and ranges do not shrink with the
/// panel. An absolute tolerance that 128 bits can hold is met, and a finer one is given up.
#[test]
fn roundings_of_the_integrand_do_not_make_it_search_for_ever() {
    let rule = Rigorous::<f64>::new().absolute(1e-22).relative(0.0);
    let integral = rule.integrate(&Cancelling, 0.0, 1e-3).unwrap();
    assert_eq!(integral.status, Status::Converged);
    assert!(integral.evaluations < 2000);
    let finest = Rigorous::<f64>::default().integrate(&Cancelling, 0.0, 1e-3).unwrap();
    assert_eq!(finest.status, Status::EvaluationLimit);
    assert!(finest.evaluations <= 100_000);
    for integral in [integral, finest] {
        assert!(holds(integral, "0.000000007445349188717191869845953532713247435892"), "{integral:?}");
    }
    // The tolerance, and an ulp at each end.
    assert!(integral.width() <= 1e-22 + 2e-24);
    // By a laxer tolerance: ten digits at the least.
    assert!(finest.width() <= 1e-10 * finest.upper);
}

/// With few evaluations the enclosure is wide, and still one.
#[test]
fn the_limit_of_evaluations_is_kept() {
    for limit in [1, 20, 100, 200, 400, 100_000] {
        let rule = Rigorous::<f64>::new().limit(limit);
        let integral = rule.integrate(&Entropy, 0.0, 1.0).unwrap();
        assert!(holds(integral, "0.7213475204444817036799623405009460687133"), "{limit}");
        assert_eq!(integral.status == Status::EvaluationLimit, limit < 1000, "{limit}");
        // 16 nodes, the ranges of the survey, of the panel and of its middle half.
        assert!(integral.evaluations <= limit.max(19), "{limit}: {}", integral.evaluations);
    }
}

/// An odd integrand: no relative tolerance can be met, and all that 128 bits hold is given.
#[test]
fn a_vanishing_integral_ends_with_round_off() {
    let integral = Rigorous::<f64>::default().integrate(&Cubic, -1.5, 1.0).unwrap();
    assert_eq!(integral.status, Status::Converged);
    let integral = Rigorous::<f64>::default().integrate(&Odd, -3.0, 3.0).unwrap();
    assert_eq!(integral.status, Status::RoundOff);
    assert!(integral.contains(0.0) && integral.width() < 1e-18 && integral.evaluations < 10_000);
}

#[test]
fn bad_requests_are_refused_with_their_reason() {
    let rule = Rigorous::<f64>::default();
    let refused = |from, to| rule.integrate(&Witch, from, to).unwrap_err().to_string();
    assert_eq!(refused(f64::NAN, 2.0), "lower limit of the integral is NaN, allowed is finite");
    assert_eq!(refused(2.0, f64::INFINITY), "upper limit of the integral is inf, allowed is finite");
    let refused = |rule: Rigorous<f64>| rule.integrate(&Witch, 0.5, 2.0).unwrap_err().to_string();
    for absolute in [-1.0, f64::NAN, f64::INFINITY] {
        let expected = format!("absolute tolerance is {absolute}, allowed is 0, or positive and finite");
        assert_eq!(refused(rule.absolute(absolute)), expected);
    }
    for relative in [-0.25, 1e-18, 1.5, f64::NAN] {
        let allowed = "allowed is 0, or from 2^-58 (f32: 2^-29) up to 1";
        assert_eq!(refused(rule.relative(relative)), format!("relative tolerance is {relative}, {allowed}"));
    }
    let none = "tolerance is 0, allowed is a positive absolute or relative one";
    assert_eq!(refused(rule.relative(0.0)), none);
    let single = |relative| Rigorous::<f32>::new().relative(relative).integrate(&Witch, 0.5, 2.0);
    assert!(single(1e-9).is_err() && single(1e-8).is_ok());
    assert_eq!(refused(rule.limit(0)), "evaluation limit is 0, allowed is 1 or more");
}
