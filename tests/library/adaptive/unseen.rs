//! Kinks and jumps at any place, the gaps at the ends of panels and of the interval not left out.

use mean_information::elementary::exp;
use mean_information::estimate::{Estimate, Status};
use mean_information::quadrature::adaptive::{GaussKronrod, Rule};
use mean_information_test_support::battery::{Case, cases};
use num_traits::Float;

/// An integrand over [0, 1] that is not smooth at a place, and its integral.
struct Family {
    name: &'static str,
    value: fn(f64, f64) -> f64,
    integral: fn(f64) -> f64,
}

const FAMILIES: [Family; 6] = [
    Family {
        name: "kink e^|x - c|",
        value: |x, c| exp((x - c).abs()),
        integral: |c| Float::exp_m1(c) + Float::exp_m1(1.0 - c),
    },
    Family {
        name: "kink |x - c|",
        value: |x, c| (x - c).abs(),
        integral: |c| 0.5 * (c * c + (1.0 - c) * (1.0 - c)),
    },
    Family {
        name: "jump of e^x to -x",
        value: |x, c| if x < c { exp(x) } else { -x },
        integral: |c| Float::exp_m1(c) - 0.5 * (1.0 - c * c),
    },
    Family { name: "jump of 0 to 1", value: |x, c| f64::from(x >= c), integral: |c| 1.0 - c },
    Family {
        name: "jump of a thousandth",
        value: |x, c| if x < c { 1.0 + x * x } else { 1.001 + x * x },
        integral: |c| 4.0 / 3.0 + 0.001 * (1.0 - c),
    },
    Family {
        name: "cusp |x - c|^(3/2)",
        value: |x, c| Float::powf((x - c).abs(), 1.5),
        integral: |c| 0.4 * (Float::powf(c, 2.5) + Float::powf(1.0 - c, 2.5)),
    },
];

/// Small kinks beside a smooth part, and a relative tolerance each.
const SMALL: [(Family, f64); 6] = [
    (
        Family {
            name: "e^x + 1e-4 max(x - c, 0)",
            value: |x, c| exp(x) + 1e-4 * (x - c).max(0.0),
            integral: |c| Float::exp_m1(1.0) + 0.5e-4 * (1.0 - c) * (1.0 - c),
        },
        1e-8,
    ),
    (
        Family {
            name: "e^x + 1e-5 max(x - c, 0)",
            value: |x, c| exp(x) + 1e-5 * (x - c).max(0.0),
            integral: |c| Float::exp_m1(1.0) + 0.5e-5 * (1.0 - c) * (1.0 - c),
        },
        1e-10,
    ),
    (
        Family {
            name: "1/(1 + x) + 1e-5 max(x - c, 0)",
            value: |x, c| 1.0 / (1.0 + x) + 1e-5 * (x - c).max(0.0),
            integral: |c| core::f64::consts::LN_2 + 0.5e-5 * (1.0 - c) * (1.0 - c),
        },
        1e-8,
    ),
    (
        Family {
            name: "1/(0.2 + x) + 1e-3 max(x - c, 0)",
            value: |x, c| 1.0 / (0.2 + x) + 1e-3 * (x - c).max(0.0),
            integral: |c| Float::ln(6.0) + 0.5e-3 * (1.0 - c) * (1.0 - c),
        },
        1e-8,
    ),
    (
        Family {
            name: "1/(1 + 25 x^2) + 1e-4 max(x - c, 0)",
            value: |x, c| 1.0 / (1.0 + 25.0 * x * x) + 1e-4 * (x - c).max(0.0),
            integral: |c| 0.2 * Float::atan(5.0) + 0.5e-4 * (1.0 - c) * (1.0 - c),
        },
        1e-8,
    ),
    (
        Family {
            name: "1/(0.2 + x) + 1e-6 max(x - c, 0)",
            value: |x, c| 1.0 / (0.2 + x) + 1e-6 * (x - c).max(0.0),
            integral: |c| Float::ln(6.0) + 0.5e-6 * (1.0 - c) * (1.0 - c),
        },
        1e-12,
    ),
];

/// The integral of one integrand, and whether its claim is false. The integral that it is compared with is rounded a
/// few times, at numbers up to 2.
fn judged(family: &Family, rule: Rule, relative: f64, place: f64) -> (Estimate<f64>, bool) {
    let settings = GaussKronrod::new().rule(rule).relative(relative);
    let estimate = settings.integrate(|x| (family.value)(x, place), 0.0, 1.0).expect("good settings");
    let error = (estimate.value - (family.integral)(place)).abs();
    (estimate, error > estimate.error + 2.0 * f64::EPSILON)
}

/// False claims over so many places, spread evenly by the golden ratio; and evaluations.
fn false_claims(family: &Family, rule: Rule, relative: f64, places: u32) -> (Vec<f64>, u64) {
    let mut evaluations = 0;
    let places = (0..places).map(|k| ((f64::from(k) + 0.5) * 0.618_033_988_749_894_9).fract());
    let wrong = places.filter(|&place| {
        let (estimate, is_false) = judged(family, rule, relative, place);
        evaluations += estimate.evaluations;
        is_false
    });
    (wrong.collect(), evaluations)
}

fn none_is_false(families: &[Family], relatives: &[f64], places: u32) {
    for family in families {
        for &rule in Rule::ALL {
            for &relative in relatives {
                let (wrong, evaluations) = false_claims(family, rule, relative, places);
                let mean = evaluations / u64::from(places);
                println!(
                    "{}, {rule:?}, {relative:e}: {} false of {places}; {mean} evaluations",
                    family.name,
                    wrong.len()
                );
                assert!(wrong.is_empty(), "{}, {rule:?}, {relative:e}: {wrong:?}", family.name);
            }
        }
    }
}

#[test]
fn a_hundred_places() {
    none_is_false(&FAMILIES, &[1e-3, 1e-8, 1e-12], 100);
}

/// Some minutes: `cargo test --release --test library -- --ignored --nocapture twenty_thousand_places`.
#[test]
#[ignore = "takes minutes"]
fn twenty_thousand_places() {
    none_is_false(&FAMILIES, &[1e-8, 1e-10, 1e-12], 20_000);
}

/// In the coefficients of the Legendre series a small kink drowns in the smooth part; in the highest degrees it does not.
#[test]
fn small_kinks_beside_a_smooth_part() {
    for (family, relative) in SMALL {
        none_is_false(&[family], &[relative], 100);
    }
}

/// A minute: `cargo test --release --test library -- --ignored --nocapture small_kinks`.
#[test]
#[ignore = "takes a minute"]
fn small_kinks_at_twenty_thousand_places() {
    for (family, relative) in SMALL {
        none_is_false(&[family], &[relative], 20_000);
    }
}

/// Places that were wrong once: beside 1/2, in the gap of the first panel, and at its outermost node from inside.
#[test]
fn places_that_were_wrong() {
    for (family, place, relative) in [
        (0, 0.499, 1e-12),
        (0, 0.763_680_219_961_315_7, 1e-10),
        (0, 0.995_481_586_768_391_9, 1e-5),
        (0, 0.497_838_903_623_232_9, 1e-5),
        (0, 0.004_486_718_732_550_798, 1e-3),
        (2, 0.004_213_129_037_452_745, 1e-8),
        (3, 0.998_272_179_512_241_6, 1e-12),
        (3, 0.5, 1e-12),
    ] {
        for &rule in Rule::ALL {
            let family = &FAMILIES[family];
            let (estimate, is_false) = judged(family, rule, relative, place);
            assert!(!is_false, "{}, {rule:?}, {place}: {estimate:?}", family.name);
        }
    }
}

/// A jump at the very end of a panel is no error: two values tell, and no panel is cut.
#[test]
fn a_jump_at_an_end_costs_a_value_on_either_side() {
    let jump = |x: f64| if x < 0.5 { 1.0 } else { 3.0 };
    let settings = GaussKronrod::new().relative(1e-12);
    let told = settings.integrate_between(jump, &[0.0, 0.5, 1.0]).unwrap();
    assert_eq!((told.value, told.status, told.evaluations), (2.0, Status::Converged, 2 * 21 + 4));
    // Found by halving.
    let found = settings.integrate(jump, 0.0, 1.0).unwrap();
    assert_eq!((found.value, found.status, found.evaluations), (2.0, Status::Converged, 3 * 21 + 4));
}

/// Every value was 0: of an integrand that is, or of one that underflows beside its peak.
#[test]
fn nothing_but_zeros_is_said() {
    let settings = GaussKronrod::<f64>::new();
    for &rule in Rule::ALL {
        let peak = settings.rule(rule).integrate(|x: f64| exp(-1e6 * x * x), -1000.0, 1700.0).unwrap();
        assert_eq!((peak.value, peak.status), (0.0, Status::AllZero), "{rule:?}");
        let one = settings.rule(rule).integrate(|_| 0.75, -1000.0, 1700.0).unwrap();
        assert_eq!(one.status, Status::Converged, "{rule:?}");
    }
}

/// `x^-0.99` overflows next to 0: the panel that had a value stays, and is named.
#[test]
fn a_panel_that_had_a_value_stays() {
    for rule in [Rule::K15, Rule::K21, Rule::K31] {
        let power =
            GaussKronrod::<f64>::new().rule(rule).integrate(|x| Float::powf(x, -0.99), 0.0, 1.0).unwrap();
        assert!(
            matches!(power.status, Status::Unresolved { lower: 0.0, upper } if upper < 1e-300),
            "{power:?}"
        );
        assert!((power.value - 100.0).abs() <= power.error && power.error.is_finite(), "{power:?}");
    }
}

/// Evaluations over the smooth families at 1e-8, 1e-10 and 1e-12 before ends were doubted and highest degrees were read: at
/// most a twentieth more.
#[test]
fn smooth_integrands_cost_hardly_more() {
    let smooth = [
        "quadpack-2",
        "quadpack-3",
        "lyness-peak",
        "lyness-oscillation",
        "genz-oscillatory",
        "genz-product-peak",
        "genz-corner-peak",
        "genz-gaussian",
        "runge-scaled",
    ];
    let before: [[u64; 3]; 6] = [
        [122_385, 170_205, 187_065],
        [105_525, 123_543, 132_741],
        [90_489, 95_635, 99_169],
        [101_229, 105_247, 107_379],
        [115_821, 118_167, 122_043],
        [125_355, 129_869, 132_431],
    ];
    for (rule, before) in Rule::ALL.iter().copied().zip(before) {
        for (relative, before) in [1e-8, 1e-10, 1e-12].into_iter().zip(before) {
            let settings = GaussKronrod::new().rule(rule).relative(relative);
            let evaluations = |case: &Case| {
                settings
                    .integrate_between(case.integrand::<f64>(), &case.points)
                    .expect("good settings")
                    .evaluations
            };
            let cases = cases();
            let now: u64 = cases.iter().filter(|case| smooth.contains(&case.family)).map(evaluations).sum();
            let share = 100.0 * (now as f64 / before as f64 - 1.0);
            println!("{rule:?}, {relative:e}: {now} evaluations, {share:.2} % more than {before}");
            assert!(now * 20 <= before * 21, "{rule:?}, {relative:e}: {now} evaluations, {before} before");
        }
    }
}
