//! Comparisons within a bound by the traits of `approx` (feature `approx`).

use approx::{AbsDiffEq, RelativeEq, UlpsEq, abs_diff_eq, assert_ulps_eq, relative_eq, ulps_eq};
use mean_information::estimate::{Enclosure, Estimate, Status};
use mean_information::map::encoding::{LogOdds, Probability};
use mean_information::map::{Geometry, Grid, PolarMap};
use mean_information::quadrature::{adaptive::GaussKronrod, rigorous::Rigorous};
use mean_information::scalar::{Integrand, Scalar};
use mean_information::{InformationSum, Real, Tally};
use proptest::prelude::*;

fn grid<T: Real>(width: usize, height: usize, cells: &[T]) -> Grid<LogOdds<T>> {
    let geometry = Geometry::new(0.05, [-3.0, 2.0]).unwrap();
    Grid::new(width, height, geometry, cells.to_vec()).unwrap()
}

fn polar<T: Real>(sectors: usize, rings: usize, cells: &[T]) -> PolarMap<LogOdds<T>> {
    PolarMap::new(sectors, rings, 0.4, cells.to_vec()).unwrap()
}

/// Integrated over nothing, which costs nothing: nobody else than the library can make an estimate or an enclosure.
struct Identity;

impl Integrand for Identity {
    fn evaluate<S: Scalar>(&self, x: S) -> S {
        x
    }
}

/// An integral with other numbers.
fn estimate<T: Real>(value: T, error: T) -> Estimate<T> {
    let mut estimate = GaussKronrod::new().integrate(|x| x, T::HALF, T::HALF).unwrap();
    assert_eq!(estimate.status, Status::Converged);
    (estimate.value, estimate.error) = (value, error);
    estimate
}

/// An integral with other ends.
fn enclosure<T: Real>(lower: T, upper: T) -> Enclosure<T> {
    let mut enclosure = Rigorous::default().integrate(&Identity, T::HALF, T::HALF).unwrap();
    assert_eq!(enclosure.status, Status::Converged);
    (enclosure.lower, enclosure.upper) = (lower, upper);
    enclosure
}

/// `|a - b|` in units of the bits' integers, for numbers of one sign; 0 and -0 are equal, other signs have no distance.
macro_rules! bits_apart {
    ($a:expr, $b:expr) => {
        if $a == $b {
            Some(0)
        } else if $a.is_sign_negative() == $b.is_sign_negative() {
            Some(u64::from($a.to_bits().abs_diff($b.to_bits())))
        } else {
            None
        }
    };
}

/// The verdict on each result that holds the two floats, beside ones that are equal.
macro_rules! verdicts {
    ($macro:ident, $a:expr, $b:expr, $fixed:expr $(, $name:ident = $bound:expr)*) => {[
        $macro!(grid(3, 1, &[$fixed, $a, $fixed]), grid(3, 1, &[$fixed, $b, $fixed]) $(, $name = $bound)*),
        $macro!(polar(2, 1, &[$a, $fixed]), polar(2, 1, &[$b, $fixed]) $(, $name = $bound)*),
        $macro!(estimate($a, $fixed), estimate($b, $fixed) $(, $name = $bound)*),
        $macro!(estimate($fixed, $a), estimate($fixed, $b) $(, $name = $bound)*),
        $macro!(enclosure($a, $fixed), enclosure($b, $fixed) $(, $name = $bound)*),
        $macro!(enclosure($fixed, $a), enclosure($fixed, $b) $(, $name = $bound)*),
    ]};
}

/// The properties of one format: `$bits` is its integer.
macro_rules! properties {
    ($format:ident, $bits:ident) => {
        mod $format {
            use super::*;

            /// Any float but NaN, with one that is a few floats away, or with any other.
            fn pair() -> impl Strategy<Value = ($format, $format)> {
                let number = || any::<$bits>().prop_map($format::from_bits).prop_filter("a number", |x| !x.is_nan());
                let beside = (number(), -9_i8..=9).prop_map(|(x, steps)| {
                    let bits = x.to_bits().wrapping_add_signed(steps.into());
                    (x, $format::from_bits(bits))
                });
                prop_oneof![beside.prop_filter("a number", |pair| !pair.1.is_nan()), (number(), number())]
            }

            proptest! {
                #[test]
                fn ulps_are_the_distance_of_the_bits((a, b) in pair(), max_ulps in 0_u32..12) {
                    let near = bits_apart!(a, b).is_some_and(|apart| apart <= u64::from(max_ulps));
                    prop_assert_eq!(verdicts!(ulps_eq, a, b, 0.7, max_ulps = max_ulps), [near; 6]);
                }

                #[test]
                fn the_absolute_bound_is_on_every_float((a, b) in pair(), epsilon in 0.0..1e-3_f64) {
                    let epsilon = epsilon as $format * a.abs().min(1e30);
                    let near = a == b || (a - b).abs() <= epsilon;
                    prop_assert_eq!(verdicts!(abs_diff_eq, a, b, 0.7, epsilon = epsilon), [near; 6]);
                }

                #[test]
                fn the_relative_bound_is_on_every_float((a, b) in pair(), max_relative in 0.0..1e-3_f64) {
                    let max_relative = max_relative as $format;
                    let finite = a.is_finite() && b.is_finite();
                    let near = a == b || finite && (a - b).abs() <= a.abs().max(b.abs()) * max_relative;
                    prop_assert_eq!(verdicts!(relative_eq, a, b, 0.7, max_relative = max_relative), [near; 6]);
                }

                /// Of two cells, one of which moves by some ulps: the counts are equal, the sums seldom.
                #[test]
                fn tallies_are_near_if_their_sums_are(p in 0.01..0.49 as $format, steps in 0_i8..9, max_ulps in 0_u32..9) {
                    let q = $format::from_bits(p.to_bits().wrapping_add_signed(steps.into()));
                    let [one, other] = [p, q].map(|p| Tally::from_occupancies(&[p, 0.75, 0.5]));
                    let near = |a: $format, b: $format| bits_apart!(a, b).is_some_and(|apart| apart <= max_ulps.into());
                    let information = near(one.information(), other.information());
                    let entropy = near(one.entropy(), other.entropy());
                    prop_assert_eq!(ulps_eq!(one, other, max_ulps = max_ulps), information && entropy);
                    let [one, other] = [&one, &other].map(InformationSum::from);
                    prop_assert_eq!(ulps_eq!(one, other, max_ulps = max_ulps), information);
                }
            }

            #[test]
            fn what_is_no_number_is_near_nothing() {
                let all = $format::MAX;
                for (a, b) in [($format::NAN, $format::NAN), ($format::NAN, 0.3), (0.3, $format::NAN)] {
                    for (one, other) in [(estimate(a, 0.7), estimate(b, 0.7)), (estimate(0.7, a), estimate(0.7, b))] {
                        assert!(!one.abs_diff_eq(&other, all) && !one.ulps_eq(&other, all, u32::MAX));
                        assert!(!one.relative_eq(&other, all, all));
                    }
                    let (one, other) = (enclosure(a, 0.7), enclosure(b, 0.7));
                    assert!(!one.abs_diff_eq(&other, all) && !one.ulps_eq(&other, all, u32::MAX));
                }
            }

            /// Unlike two floats of `approx`, whose default difference is an ulp of 1.
            #[test]
            fn without_an_epsilon_small_numbers_are_no_closer_than_others() {
                let (a, b) = ($format::EPSILON / 1024.0, $format::EPSILON / 512.0);
                assert!(ulps_eq!(a, b, max_ulps = 1) && abs_diff_eq!(a, b));
                assert_eq!(verdicts!(ulps_eq, a, b, 0.7, max_ulps = 1), [false; 6]);
                assert_eq!(verdicts!(abs_diff_eq, a, b, 0.7), [false; 6]);
                assert_eq!(verdicts!(relative_eq, a, b, 0.7), [false; 6]);
                let tallies = [a, b].map(|p| Tally::from_occupancies(&[p]));
                assert!(!ulps_eq!(tallies[0], tallies[1], max_ulps = 1));
            }
        }
    };
}

properties!(f32, u32);
properties!(f64, u64);

#[test]
fn maps_of_another_place_or_shape_are_not_equal() {
    let cells = [0.3, -2.5, 0.0, 4.5, f64::INFINITY, -0.7];
    let map = grid(3, 2, &cells);
    let far = 1e9;
    let equal = |other: &Grid<LogOdds<f64>>| {
        let verdicts = [
            map.abs_diff_eq(other, far),
            map.relative_eq(other, far, far),
            map.ulps_eq(other, far, u32::MAX),
        ];
        assert_eq!(verdicts, [verdicts[0]; 3]);
        verdicts[0]
    };
    assert!(equal(&map.clone()));
    assert!(equal(&grid(3, 2, &[0.4, -2.0, 0.1, 4.0, f64::INFINITY, -0.1])));
    assert!(!equal(&grid(2, 3, &cells)) && !equal(&grid(6, 1, &cells)) && !equal(&grid(3, 1, &cells[..3])));
    for (resolution, origin, yaw) in [
        (0.05_f64.next_up(), [-3.0, 2.0], 0.0),
        (0.05, [-3.0, 2.0_f64.next_up()], 0.0),
        (0.05, [-3.0, 2.0], 1e-300),
    ] {
        let geometry = Geometry::new(resolution, origin).unwrap().with_yaw(yaw).unwrap();
        assert!(!equal(&Grid::new(3, 2, geometry, cells.to_vec()).unwrap()));
    }

    let map = polar(3, 2, &cells);
    assert!(map.abs_diff_eq(&map.clone(), 0.0) && map.ulps_eq(&map.clone(), 0.0, 0));
    assert!(!map.abs_diff_eq(&polar(2, 3, &cells), far));
    let coarser = PolarMap::new(3, 2, 0.4_f64.next_up(), cells.to_vec()).unwrap();
    assert!(!map.abs_diff_eq(&coarser, far) && !map.ulps_eq(&coarser, far, u32::MAX));
}

/// All cells are compared: the last one, too.
#[test]
fn a_port_that_is_off_in_one_cell_is_found() {
    let map = |last| {
        let mut cells = vec![0.3_f32; 12];
        cells[11] = last;
        Grid::<Probability<f32>>::new(4, 3, Geometry::new(0.1, [0.5, 0.25]).unwrap(), cells).unwrap()
    };
    assert_ulps_eq!(map(0.97), map(0.97_f32.next_up()), max_ulps = 1);
    assert!(!map(0.97).ulps_eq(&map(0.97_f32.next_up().next_up()), 0.0, 1));
}

/// `{0.3, 0.5}` and `{0.7, 0.5}` have the sums of each other.
#[test]
fn counts_are_exact() {
    let (free, occupied) = (Tally::from_occupancies(&[0.25, 0.5]), Tally::from_occupancies(&[0.75, 0.5]));
    assert_eq!((free.entropy(), free.information()), (occupied.entropy(), occupied.information()));
    assert!(!free.abs_diff_eq(&occupied, 9.0) && !free.ulps_eq(&occupied, 9.0, u32::MAX));
    let [one, other] = [&free, &occupied].map(InformationSum::from);
    assert!(one.abs_diff_eq(&other, 0.0));
    // A cell of 2^-106 bits is observed, one of none is not.
    let almost = [0.25, 0.5_f64.next_down()];
    assert!(!free.abs_diff_eq(&Tally::from_occupancies(&almost), 9.0));
    assert!(!one.abs_diff_eq(&InformationSum::from_occupancies(&almost), 9.0));
}

#[test]
fn results_that_ended_differently_are_not_equal() {
    let (mut near, mut proved) = (estimate(2.5, 0.25), enclosure(2.5, 2.75));
    near.evaluations += 64;
    proved.evaluations += 64;
    assert!(near.abs_diff_eq(&estimate(2.5, 0.25), 0.0));
    assert!(proved.abs_diff_eq(&enclosure(2.5, 2.75), 0.0));
    for status in [Status::RoundOff, Status::Unresolved { lower: 0.25, upper: 0.5 }] {
        let (mut estimate, mut enclosure) = (near, proved);
        (estimate.status, enclosure.status) = (status, status);
        assert!(!near.abs_diff_eq(&estimate, 9.0) && !proved.ulps_eq(&enclosure, 9.0, u32::MAX));
    }
}
