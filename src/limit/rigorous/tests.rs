//! The limits of the circular room, to the last bit.

use super::*;
use crate::sensor::GaussianSensor;
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
        let sensor = GaussianSensor::new(alpha * 0.25, 0.25).expect("positive");
        for (weight, expected) in [(Weight::Radial, radial), (Weight::Area, area)] {
            let limit = rigorous(&sensor, weight, &Rigorous::default()).expect("a room");
            let Enclosure { lower, upper, status, evaluations } = limit;
            assert_eq!(status, Status::Converged);
            assert!(holds(lower, upper, expected), "{alpha}: {expected} is not in [{lower}, {upper}]");
            // Well below an ulp in 128 bits: then it is the outward rounding that makes the width.
            assert!(upper <= lower.next_up().next_up(), "{alpha}: {lower} to {upper}");
            assert!(evaluations < 900, "{alpha}: {evaluations}");
        }
    }
}

#[test]
fn the_magnitude_of_an_integral_whose_sign_is_open() {
    let interval = |lower, upper| Interval::<Wide>::constant(lower).hull(Interval::constant(upper));
    for (ends, magnitude) in [((-3.0, 2.0), (0.0, 3.0)), ((-3.0, -2.0), (2.0, 3.0)), ((2.0, 3.0), (2.0, 3.0))]
    {
        assert_eq!(super::magnitude(interval(ends.0, ends.1)), interval(magnitude.0, magnitude.1));
    }
}
