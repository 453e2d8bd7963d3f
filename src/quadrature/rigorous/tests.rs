//! The rules, exactly; the remainder, where it is known; and the circular room, to the last bit.

use super::nodes::RULES;
use super::*;
use num_bigint::BigInt;

/// A number in `(0, 1)` given by its digits after the point, times `10^digits`, and that power.
fn decimal(text: &str) -> (BigInt, BigInt) {
    let digits = text.strip_prefix("0.").expect("a number below 1");
    (digits.parse().expect("digits"), BigInt::from(10).pow(digits.len() as u32))
}

/// Whether a decimal, correct to a unit of its last digit, can lie in the interval of two floats.
fn holds(lower: f64, upper: f64, text: &str) -> bool {
    let (digits, unit) = decimal(text);
    let scaled = |x: f64| {
        let (m, e) = x.parts();
        (BigInt::from(m) << (1074 + e)) * &unit
    };
    scaled(lower) <= (&digits + 1) << 1074_u32 && (digits - 1) << 1074_u32 <= scaled(upper)
}

/// `P_n(x 2^-127) 2^(127 n) n!`, by the recurrence `k P_k = (2k - 1) x P_(k-1) - (k - 1) P_(k-2)`.
fn legendre(n: u32, x: &BigInt) -> BigInt {
    let (mut before, mut value) = (BigInt::from(1), x.clone());
    for k in 2..=n {
        // Scaled by 2^(127 k) k!, a step back brings (k - 1) 2^254.
        let next = (2 * k - 1) * x * &value - ((((k - 1) * (k - 1)) * before) << 254_u32);
        (before, value) = (value, next);
    }
    value
}

/// A node lies between the stored integer and the next: `P_n` changes its sign there. They are `n` different ones.
#[test]
fn nodes_are_the_roots_of_legendre_polynomials() {
    for rule in RULES {
        let n = 2 * rule.len() as u32;
        for (k, &(node, _)) in rule.iter().enumerate() {
            let signs = [node, node + 1].map(|x| legendre(n, &BigInt::from(x)).sign());
            assert!(signs[0] != signs[1], "node {k} of {n}");
            assert!(k == 0 || rule[k - 1].0 < node);
        }
    }
}

/// The weights integrate `x^0, x^2, .., x^(n - 2)` exactly, which determines them: `sum w x^2k = 1 / (2k + 1)` lies
/// between the sums of the stored integers and of the next ones.
#[test]
fn weights_integrate_all_powers() {
    for rule in RULES {
        for k in 0..rule.len() as u32 {
            let sum = |up: u128| {
                let term =
                    |&(node, weight): &(u128, u128)| BigInt::from(node + up).pow(2 * k) * (weight + up);
                rule.iter().map(term).sum::<BigInt>() * (2 * k + 1)
            };
            let one = BigInt::from(1) << (127 * (2 * k + 1));
            assert!(sum(0) <= one && one <= sum(1), "power {} of {}", 2 * k, 2 * rule.len());
        }
    }
}

struct Exponential;
impl Integrand for Exponential {
    fn evaluate<S: Scalar>(&self, x: S) -> S {
        x.exp()
    }
}

/// The rectangles cover the upper half of the unit disc, which half axes stretch to an ellipse: from left to right
/// without a gap, each at least as high as the circle at its end nearer to the middle. In thousandths, exactly.
#[test]
fn rectangles_cover_the_ellipse() {
    let thousandths = |x: f64| (x * 1000.0).round() as i64;
    let mut rectangles = gauss::RECTANGLES.map(|(from, to, height)| [from, to, height].map(thousandths));
    rectangles.sort_unstable();
    let mut reached = -1000;
    for [from, to, height] in rectangles {
        assert_eq!(from, reached);
        let nearest = if from < 0 && 0 < to { 0 } else { from.abs().min(to.abs()) };
        assert!(height.pow(2) + nearest.pow(2) >= 1_000_000);
        reached = to;
    }
    assert_eq!(reached, 1000);
}

/// Where the remainder makes most of the width: `e^x` about 0, whose integral is `e^r - e^-r`.
#[test]
fn the_remainder_is_within_its_bound() {
    let mut evaluations = 0;
    for (radius, allowed) in [(1.0, 1e-3), (1.0, 1e-9), (2.5, 1e-6), (4.0, 1e-4), (6.0, 1e-2)] {
        let choice = gauss::Chooser::new()
            .choose(&Exponential, -radius, radius, allowed, &mut evaluations)
            .expect("an entire function");
        let rough = gauss::integrate(&Exponential, -radius, radius, &choice, &mut evaluations);
        let e = Interval::<Wide>::constant(radius).exp();
        let exact = e - Interval::constant(1.0) / e;
        assert!(rough.lower() <= exact.lower() && exact.upper() <= rough.upper(), "radius {radius}");
        let width: f64 = rough.width().to_real(Toward::Up);
        assert!(width <= 2.0 * allowed);
    }
}

/// `H(e^(-t^2 / 2))`, by area times `1 + t / ratio`.
struct Beam {
    ratio: Option<f64>,
}
impl Integrand for Beam {
    fn evaluate<S: Scalar>(&self, t: S) -> S {
        let entropy = (S::constant(-0.5) * t.clone() * t.clone()).exp().entropy();
        match self.ratio {
            Some(ratio) => (S::constant(1.0) + t / S::constant(ratio)) * entropy,
            None => entropy,
        }
    }
}

/// The two limits of the room for `z / σ = alpha`, with the evaluations they took. What both sides of the obstacle
/// have in common, up to the smaller of `alpha` and `b`, is integrated once; the weights `1 ± t / alpha` of both
/// sides add to 2.
fn room(alpha: f64) -> [(Interval<Wide>, u64); 2] {
    type Value = Interval<Wide>;
    let (one, two) = (Value::constant(1.0), Value::constant(2.0));
    let (z, b) = (Value::constant(alpha), (two * Value::ln_2()).sqrt());
    let (near, far, ratio) = if alpha < 1.17 { (z, b, alpha) } else { (b, z, -alpha) };
    let rule = Rigorous { absolute: f64::EPSILON / 64.0, ..Rigorous::default() };
    let common = rule.between(&Beam { ratio: None }, Value::constant(0.0), near);
    [None, Some(ratio)].map(|ratio| {
        let beam = Beam { ratio };
        let cut = Value::constant(40.0);
        let rest = if alpha > 40.0 { [(near, cut), (cut, far)].to_vec() } else { [(near, far)].to_vec() };
        let (mut integral, mut evaluations) = (two * common.value, common.evaluations);
        for (from, to) in rest {
            let part = rule.between(&beam, from, to);
            assert_eq!(part.status, Status::Converged);
            integral = integral + part.value;
            evaluations += part.evaluations;
        }
        let sum = z + b;
        let deficit = if ratio.is_none() { integral / sum } else { two * z * integral / (sum * sum) };
        (one - deficit, evaluations)
    })
}

/// `z / σ`, and the limits by radius and by area from mpmath 1.3 at 50 digits: `quad` of the definition over decades.
const ROOMS: [(f64, &str, &str); 16] = [
    (1e-06, "0.425822317716373143915268687801063137", "0.230838000828900272015363717463631574"),
    (0.001, "0.426309074960709978970319077535146271", "0.231168870217854798870205606326773333"),
    (0.1, "0.469461307069765806443825254540951449", "0.263634578790230590415655072324668235"),
    (0.5, "0.532116037999355284766470486730083665", "0.369680194684257841315870891971835780"),
    (1.0, "0.459629553995037196859231235473748576", "0.423030881214568565100827788256379877"),
    (1.75, "0.360066173853409604813794847879757658", "0.411328421270664624150272896860895353"),
    (2.5, "0.390328453547557039289999287042637874", "0.395239338866668630236792523069317957"),
    (5.0, "0.618828445159413930039940793125073420", "0.479389693866998480070415992564055933"),
    (10.0, "0.789336888025651415375532004498392847", "0.652510952972735116210077993461255244"),
    (25.0, "0.910049619991775042881059385954699708", "0.833561069851908846379990358840438895"),
    (39.5, "0.942113620856071114786129241981765703", "0.889802318614582011857642829009378535"),
    (41.0, "0.944172295598534942905490697664860625", "0.893530174715904681771259265831615145"),
    (100.0, "0.976727334899832003238650124383647822", "0.954355805784582828989267158521574787"),
    (10000.0, "0.999764560922917266542452459317834950", "0.999529214072219570351833395743859325"),
    (1000000.0, "0.999997645334793250030516629448521110", "0.999995290678811288735284464680498311"),
    (1000000000.0, "0.999999997645332023616026095833732664", "0.999999995290664056456862566925972289"),
];

#[test]
fn the_limits_of_the_room_within_two_ulps() {
    for (alpha, radial, area) in ROOMS {
        for ((value, evaluations), expected) in room(alpha).into_iter().zip([radial, area]) {
            let lower: f64 = value.lower().to_real(Toward::Down);
            let upper: f64 = value.upper().to_real(Toward::Up);
            assert!(holds(lower, upper, expected), "{alpha}: {expected} is not in [{lower}, {upper}]");
            // Well below an ulp in 128 bits: then it is the outward rounding that makes the width.
            assert!(upper <= lower.next_up().next_up(), "{alpha}: {lower} to {upper}");
            assert!(evaluations < 900, "{alpha}: {evaluations}");
        }
    }
}
