//! The lemmas of the chapter, against counts.

use super::*;
use crate::elementary::{exp, ln, sqrt};
use proptest::prelude::*;

/// The points of the unit lattice, moved by `x` and `y`, whose distance from the origin is in the range.
fn points(x: f64, y: f64, distances: core::ops::RangeInclusive<f64>) -> f64 {
    let side = *distances.end() as i64 + 2;
    let square = |k: i64, offset: f64| (k as f64 + offset) * (k as f64 + offset);
    let all = (-side..=side).flat_map(|i| (-side..=side).map(move |j| sqrt(square(i, x) + square(j, y))));
    all.filter(|distance| distances.contains(distance)).count() as f64
}

proptest! {
    #[test]
    fn a_disc_holds_as_many_points_as_its_area_but_for_the_bound(x in -0.5_f64..0.5, y in -0.5_f64..0.5, root in 0.0_f64..10.0) {
        let radius = root * root;
        let error = points(x, y, 0.0..=radius) - PI[0] * radius * radius;
        prop_assert!(error.abs() <= points_in_a_disc(Up(radius)).0, "{error} at {radius}");
    }
}

/// Circles of many points: their squared radii are products of primes of the form `4 k + 1`.
#[test]
fn a_circle_holds_no_more_points_than_the_bound() {
    for (square, expected) in
        [(1.0_f64, 4.0), (25.0, 12.0), (65.0, 16.0), (325.0, 24.0), (1105.0, 32.0), (5525.0, 48.0)]
    {
        let radius = sqrt(square);
        let held = points(0.0, 0.0, radius - 1e-9..=radius + 1e-9);
        assert_eq!(held, expected);
        // In cells of 3 m, a room whose p is 1/2 on this circle.
        let sensor = GaussianSensor::new(3.0 * (radius + 2.5 * B[0]), 7.5).unwrap();
        let room = Room::new(&sensor, 3.0, Weight::Area).unwrap();
        assert!(held <= room.cells_at_one_half(Up(0.0)).0);
    }
    // Half-way between cells: 2 n = (2i + 1)^2 + (2j + 1)^2.
    assert_eq!(points(0.5, 0.5, 0.7..=0.71), 4.0);
}

#[test]
fn the_steepest_information_and_its_bend() {
    // φ' = t p log2(p / (1 - p)): its three extremes, and 0 between them.
    let slope = |t: f64| {
        let p = exp(-t * t / 2.0);
        t * p * (ln(p) - ln(1.0 - p)) / core::f64::consts::LN_2
    };
    let extreme =
        |from: u32, to: u32| (from..to).map(|k| slope(f64::from(k) / 1e4).abs()).fold(0.0, f64::max);
    let (near, far) = (extreme(1, 11774), extreme(11774, 90000));
    assert!(near <= STEEPEST.0 && near > STEEPEST.0 - 1e-5, "{near}");
    let bend = 2.0 * (2.0 * near + far);
    assert!(bend <= BEND.0 && bend > BEND.0 - 2e-4, "{bend}");
}

#[test]
fn the_constants_lie_where_they_say() {
    assert_eq!([B[0].next_up(), PI[0].next_up()], [B[1], PI[1]]);
    // e^(-b^2 / 2) = 1/2: at B the exponents lie on either side of ln 2.
    let square = |x: f64| {
        let (m, e) = x.parts();
        (u128::from(m) * u128::from(m), 2 * e)
    };
    // 2 ln 2 at scale 104.
    let (below, above) = (square(B[0]), square(B[1]));
    assert_eq!([below.1, above.1], [-104; 2]);
    let twice_ln_2 = 28_117_390_063_466_226_355_784_433_217_543_u128;
    assert!(below.0 < twice_ln_2 && twice_ln_2 < above.0);
}

#[test]
fn powers_are_rounded_up() {
    for cube in [8.0_f64, 27.0, 1e-300 * 1e3, 1e300] {
        let power = Up(cube).two_thirds_power().0;
        let exact = exp(ln(cube) / 3.0 * 2.0);
        assert!(power > exact * (1.0 - 1e-13) && power < exact * (1.0 + 3e-12));
    }
    assert!(Up(8.0).two_thirds_power().0 >= 4.0 && Up(27.0).two_thirds_power().0 >= 9.0);
    assert!(Up(0.1).0 + 0.2 < (Up(0.1) + Up(0.2)).0 && (Up(1.0) / 3.0).0 > 1.0 / 3.0);
}
