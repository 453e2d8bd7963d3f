//! The lemmas of the chapter, against counts.

use super::*;
use crate::elementary::{exp, ln, sqrt};
use proptest::prelude::*;
use std::format;
use std::vec::Vec;

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
        let sensor = GaussianSensor::new(3.0 * (radius + 2.5 * EDGE[0]), 7.5).unwrap();
        let room = Room::new(&sensor, 3.0, Weight::Area).unwrap();
        assert!(held <= room.cells_at_one_half(Up(0.0)).0);
    }
    // However small, a disc may hold a point.
    assert!(
        [1e-9, 0.01, 0.3].map(|radius| points_in_a_disc(Up(radius)).0).iter().all(|&points| points >= 1.0)
    );
    // Half-way between cells: 2 n = (2i + 1)^2 + (2j + 1)^2.
    assert_eq!(points(0.5, 0.5, 0.7..=0.71), 4.0);
}

#[test]
fn the_steepest_information_and_its_bend() {
    // η' = t p log2(p / (1 - p)): its three extremes, and 0 between them.
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
    assert_eq!([EDGE[0].next_up(), PI[0].next_up()], [EDGE[1], PI[1]]);
    // e^(-b^2 / 2) = 1/2: at EDGE the exponents lie on either side of ln 2.
    let square = |x: f64| {
        let (m, e) = x.parts();
        (u128::from(m) * u128::from(m), 2 * e)
    };
    // 2 ln 2 at scale 104.
    let (below, above) = (square(EDGE[0]), square(EDGE[1]));
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

/// Sensors on either side of `z = σ √(ln 4)`, and cells of which the room is from one to some millions wide.
fn rooms<T: Real>() -> Vec<(GaussianSensor<T>, T)> {
    let sensor = |alpha| GaussianSensor::new(T::nearest(3.0 * alpha), T::nearest(3.0)).expect("positive");
    let cells = [1.7, 4.9, 5.0, 12.3, 217.0, 1e4, 3e6, 1e8];
    let rooms = [0.4, 1.1, 1.3, 9.0, 3e3]
        .map(|alpha| cells.map(|x| (sensor(alpha), T::nearest(3.0 * (alpha + EDGE[0]) / x))));
    rooms.concat()
}

/// The chapter's formulas in plain floating point, with the terms of rounding: `unit = 2^-P`.
struct Plain {
    x: f64,
    sigma: f64,
    variation: f64,
    limit: f64,
    shift: f64,
    rounding: f64,
}

impl Plain {
    fn new<T: Real>(sensor: &GaussianSensor<T>, h: T, weight: Weight) -> Self {
        let (z, sigma, unit) = (sensor.range().widen(), sensor.sigma().widen(), T::epsilon().widen() / 2.0);
        let x = (z + sigma * EDGE[0]) / h.widen();
        let free = information(sensor.occupancy(T::zero())).widen();
        let rounding = f64::from(T::PRECISION + 5) / 2.0 * unit;
        let variation = 2.0 + if z > sigma * EDGE[0] { free } else { -free } + rounding;
        let limit = closed_form(sensor, weight).widen() * (1.0 + 2.0 * unit);
        Self {
            x,
            sigma: sigma / h.widen(),
            variation,
            limit: limit.min(1.0),
            shift: 2.0 * unit * x,
            rounding,
        }
    }

    /// `[miscount, information]`: half a cell, and the terms of first and of second order.
    fn beam(&self) -> [f64; 2] {
        let miscount = 0.5 + self.shift;
        let cells = self.x + miscount;
        let second = BEND.0 / (8.0 * self.sigma) + STEEPEST.0 * self.shift / self.sigma * cells;
        [miscount, (self.variation * miscount).min(second) + self.rounding * cells]
    }

    fn points(x: f64) -> f64 {
        let by_columns = 2.0 * x + 1.72 * sqrt(x) + 1.0;
        if x < 5.0 { by_columns } else { by_columns.min(7.14 * exp(ln(x) * 2.0 / 3.0) + 0.5) }
    }

    fn disc(&self) -> [f64; 2] {
        let miscount = Self::points(self.x + self.shift) + 7.0 * self.x * self.shift;
        let cells = PI[0] * self.x * self.x + miscount;
        let root = sqrt(self.x);
        let second =
            0.8403 * ((BEND.0 + STEEPEST.0) * root / self.sigma + 2.0 * self.variation * root / self.x);
        let second = second + STEEPEST.0 * self.shift / self.sigma * cells;
        [miscount, (self.variation * miscount).min(second) + self.rounding * cells]
    }
}

/// At least the number, and hardly more.
fn assert_just_above(bound: f64, number: f64, what: &str) {
    assert!(bound >= number * (1.0 - 1e-12) && bound <= number * (1.0 + 1e-9), "{what}: {bound} {number}");
}

fn assert_formulas<T: Real>() {
    for (sensor, h) in rooms::<T>() {
        for weight in [Weight::Radial, Weight::Area] {
            let room = Room::new(&sensor, h, weight).expect("positive");
            let plain = Plain::new(&sensor, h, weight);
            let what = &format!("{sensor:?} {h}");
            let (observed, size, [miscount, information]) = match weight {
                Weight::Radial => (room.beam(), plain.x, plain.beam()),
                Weight::Area => (room.disc(), PI[0] * plain.x * plain.x, plain.disc()),
            };
            assert_just_above(observed.miscount.0, miscount, what);
            assert_just_above(observed.information.0, information, what);
            assert_just_above(room.limit.0, plain.limit, what);
            let [below, above] = observed.size;
            assert!(below <= size && size <= above && above <= below * (1.0 + 1e-14), "{what}");
            // Before counting: as many cells more or fewer, and 7 that are unknown.
            let missing = miscount + 7.0;
            let bound: f64 = observed.before_counting(room.limit, Up(7.0));
            if size > 1.001 * missing {
                let expected = (information + plain.limit * missing) / (size - missing);
                assert_just_above(bound, expected.min(1.0), what);
            } else {
                assert!(bound > 0.9, "{what}");
            }
            // After: more than by size, and fewer.
            for count in [(1.1 * size) as u64 + 1, (0.9 * size) as u64 + 1] {
                let expected = (information + plain.limit * (count as f64 - size).abs()) / count as f64;
                let bound: f64 = observed.with_count(room.limit, count);
                assert!(
                    bound >= expected.min(1.0) * (1.0 - 1e-12) && bound <= expected * (1.0 + 1e-6),
                    "{what}"
                );
            }
        }
    }
}

#[test]
fn the_bounds_are_the_formulas_of_the_chapter() {
    assert_formulas::<f64>();
    assert_formulas::<f32>();
}

/// Both ends, rounded outwards by `wide`; and as many centres of rings between them as are counted, or one more at either end.
#[test]
fn the_circle_at_one_half() {
    for (sensor, h) in rooms::<f32>() {
        let room = Room::new(&sensor, h, Weight::Area).expect("positive");
        let wide = room.shift().0;
        let circle = (sensor.range().widen() - sensor.sigma().widen() * EDGE[0]) / h.widen();
        let [near, far] = room.ring();
        // The difference above rounds.
        let slack = 1e-15 * room.radius().0;
        assert!(
            near <= circle - wide + slack && near >= circle - wide - 4.0 * slack,
            "{near} {circle} {wide}"
        );
        assert!(far >= circle + wide - slack && far <= circle + wide + 4.0 * slack, "{far} {circle} {wide}");
        let first = (near as i64 - 2).max(0);
        let last = far.max(0.0) as i64;
        let held = (first..=last).map(|k| k as f64 + 0.5).filter(|x| (near..=far).contains(x)).count();
        let counted = room.rings_at_one_half().0;
        assert!(held as f64 <= counted && counted <= held as f64 + 2.01, "{held} {counted}");
        let cells = room.cells_at_one_half(Up(123.0)).0;
        let x = room.radius().0;
        if far < 0.0 {
            assert_eq!(cells, 0.0);
        } else if x < 90.0 {
            assert_just_above(cells, 6.31 * exp(ln(far) * 2.0 / 3.0) + 2.0, "points of a circle");
        } else {
            assert_just_above(cells, 246.0 + 14.0 * x * wide, "points of a ring");
        }
    }
}

/// The nearest `f32` from above; 1 at most.
#[test]
fn a_bound_is_rounded_up_to_its_format() {
    let bound = |information: f64| {
        let observed = Observed { size: [1.0; 2], miscount: Up(0.0), information: Up(information) };
        observed.bound::<f32>(Up(0.0), Up(0.0), 1.0)
    };
    for k in 1..100 {
        let information = f64::from(k) / 101.0;
        let found = bound(information);
        assert!(found.widen() > information && found.next_down().widen() <= information, "{information}");
    }
    assert_eq!([bound(0.25 - 1e-12), bound(1.5), bound(f64::NAN)], [0.25, 1.0, 1.0]);
}
