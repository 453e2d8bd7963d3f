//! The circular room: streaming against maps against brute force, to the bit, and its relations.

mod refused;

use super::common::power;
use mean_information::cell::Cell;
use mean_information::limit::{Weight, bounds, closed_form};
use mean_information::map::encoding::Probability;
use mean_information::map::{Geometry, Grid};
use mean_information::room::{CartesianRoom, PolarRoom, Sampling};
use mean_information::sensor::{GaussianSensor, InverseSensorModel, SteppedSensor};
use mean_information::{Real, Tally};
use num_bigint::BigUint;
use proptest::prelude::*;

const MAX_CELLS: usize = 1 << 20;

fn cartesian<T: Real>(z: T, sigma: T, h: T, offsets: [T; 2]) -> CartesianRoom<GaussianSensor<T>> {
    CartesianRoom::new(GaussianSensor::new(z, sigma).unwrap(), h, offsets).unwrap()
}

fn polar<T: Real>(z: T, sigma: T, h: T) -> PolarRoom<GaussianSensor<T>> {
    PolarRoom::new(GaussianSensor::new(z, sigma).unwrap(), h).unwrap()
}

/// Offsets of every kind: on a cell, on a corner, anywhere, next to those, and beyond a cell.
fn offset() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(0.0),
        Just(0.5),
        Just(-0.5),
        -0.5..0.5,
        -7.0..7.0,
        (1_i32..1074).prop_map(|k| power(-k)),
        (2_i32..53).prop_map(|k| power(-k) - 0.5),
    ]
}

/// A sensor that reaches `cells` cells of the resolution: the range, the noise and the resolution.
fn room(cells: core::ops::Range<f64>) -> impl Strategy<Value = (f64, f64, f64)> {
    (0.3_f64..9.0, -6_f64..4.0, cells).prop_map(|(z, ratio, cells)| {
        // σ from z / 64 to 16 z.
        let sigma = z * (1.0 + ratio.fract().abs()) * power(ratio as i32);
        (z, sigma, (z + 1.18 * sigma) / cells)
    })
}

/// `2^-20 h √n`, rounded to nearest, for a sum of squares `n`.
fn distance(h: f64, n: u64) -> f64 {
    let (m, e) = h.parts();
    let square = (BigUint::from(m) * m * n) << 200_u32;
    let root = square.sqrt();
    let drop = root.bits().saturating_sub(53);
    let (kept, rest) = (&root >> drop, (&root << 1_u32) - ((&root >> drop) << (drop + 1)));
    let half = BigUint::from(1_u32) << drop;
    let exact = &root * &root == square;
    let kept = kept.iter_u64_digits().next().unwrap_or(0);
    let up = rest > half || rest == half && (!exact || kept % 2 == 1);
    f64::from_parts(kept + u64::from(up), e - 120 + drop as i32)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// Cell by cell over a square that is surely large enough, with distances from big integers.
    #[test]
    fn streaming_is_brute_force((z, sigma, h) in room(0.2..14.0), x in -(1_i64 << 19)..1 << 19, y in prop_oneof![Just(0), Just(1 << 19), -(1_i64 << 19)..1 << 19]) {
        let sensor = GaussianSensor::new(z, sigma)?;
        let offset = |k: i64| k as f64 * power(-20);
        let mut tally = Tally::new();
        for i in -18..=18 {
            for j in -18..=18 {
                let square = |k: i64, offset: i64| ((k << 20) + offset).unsigned_abs().pow(2);
                let p = sensor.occupancy(distance(h, square(i, x) + square(j, y)));
                if p != 0.5 {
                    tally.add(Cell::from_occupancy(p)?);
                }
            }
        }
        let streamed = cartesian(z, sigma, h, [offset(x), offset(y)]).tally()?;
        let (unknown, mut padded) = (streamed.unknown(), tally);
        padded.add_many(Cell::unknown(), unknown);
        prop_assert_eq!(streamed, padded);
    }

    #[test]
    fn streaming_is_the_tally_of_the_map((z, sigma, h) in room(0.2..25.0), x in offset(), y in offset(), per_side in 0_u32..4, same in any::<bool>()) {
        let y = if same { -x } else { y };
        let sampling = if per_side == 0 { Sampling::Centre } else { Sampling::Averaged(1 << (per_side - 1)) };
        let room = cartesian(z, sigma, h, [x, y]).with_sampling(sampling)?;
        let map = room.map(MAX_CELLS)?;
        prop_assert_eq!([map.width() as u64, map.height() as u64], [room.width()?, room.height()?]);
        prop_assert_eq!(room.tally()?, map.tally());
        let single = cartesian(z as f32, sigma as f32, h as f32, [x as f32, y as f32]).with_sampling(sampling)?;
        prop_assert_eq!(single.tally()?, single.map(MAX_CELLS)?.tally());
        let beam = polar(z, sigma, h / 9.0).with_sampling(sampling)?;
        let turn = beam.map(3, MAX_CELLS)?;
        let mut thrice = beam.tally()?;
        thrice.merge(&beam.tally()?);
        thrice.merge(&beam.tally()?);
        prop_assert_eq!((turn.tally(), turn.rings() as u64), (thrice, beam.rings()?));
    }

    #[test]
    fn whole_cells_and_mirrors_change_nothing((z, sigma, h) in room(0.2..25.0), x in -(1_i64 << 30)..1 << 30, y in -(1_i64 << 30)..1 << 30, i in -900_i32..900) {
        let (x, y) = (x as f64 * power(-31), y as f64 * power(-31));
        let tally = cartesian(z, sigma, h, [x, y]).tally()?;
        for offsets in [[x + f64::from(i), y], [-x, y], [y, x], [x, -y - f64::from(i)]] {
            prop_assert_eq!(&cartesian(z, sigma, h, offsets).tally()?, &tally);
        }
    }

    #[test]
    fn scaling_by_a_power_of_two_changes_no_bit((z, sigma, h) in room(0.2..25.0), x in offset(), y in offset(), k in -300_i32..300) {
        let s = power(k);
        let tally = cartesian(z, sigma, h, [x, y]).tally()?;
        prop_assert_eq!(cartesian(z * s, sigma * s, h * s, [x, y]).tally()?, tally);
        prop_assert_eq!(polar(z * s, sigma * s, h * s).tally()?, polar(z, sigma, h).tally()?);
    }

    #[test]
    fn parts_merge_to_the_whole((z, sigma, h) in room(0.2..25.0), x in offset(), y in offset(), parts in 2_usize..9) {
        let room = cartesian(z, sigma, h, [x, y]);
        let mut tally = Tally::new();
        for part in (0..parts).rev() {
            tally.merge(&room.tally_part(part, parts)?);
        }
        prop_assert_eq!(tally, room.tally()?);
    }

    /// An averaged cell is the pooled block of the finer grid that its samples are the centres of.
    #[test]
    fn averages_are_pooled_centres((z, sigma, h) in room(0.4..7.0), x in -256_i32..256, y in -256_i32..256, n in prop::sample::select(vec![2_u32, 4, 8])) {
        let offsets = [x, y].map(|k| f64::from(k) / 512.0);
        let coarse = cartesian(z, sigma, h, offsets).with_sampling(Sampling::Averaged(n))?.map(MAX_CELLS)?;
        let (sides, n) = (f64::from(n), n as usize);
        let fine = cartesian(z, sigma, h / sides, offsets.map(|x| x * sides - (sides - 1.0) / 2.0)).map(MAX_CELLS)?;
        // Where the finer grid begins within the coarse one.
        let [column, row] = [0, 1].map(|k| {
            let [from, to] = [&coarse, &fine].map(|map: &Grid<_>| map.geometry().origin()[k]);
            ((to - from) / fine.geometry().resolution()).round() as usize
        });
        let (width, height) = (coarse.width() * n, coarse.height() * n);
        let mut cells = vec![0.5; width * height];
        for j in 0..fine.height() {
            cells[(row + j) * width + column..][..fine.width()].copy_from_slice(fine.row(j).unwrap());
        }
        let padded = Grid::<Probability<f64>>::new(width, height, Geometry::new(h, [0.0; 2])?, cells)?;
        let pooled = padded.pooled(n)?;
        prop_assert_eq!(pooled.cells(), coarse.cells());
    }

    /// The bound of the chapter: a sample is, on average over its part of the cell, 0.3826 of its side from the rest (a
    /// quarter, along a beam), and `p` is no steeper than `e^(-1/2) / σ`. Both means are rounded, and their distances.
    #[test]
    fn averages_are_within_their_bound_of_finer_ones((z, sigma, h) in room(2.0..9.0), x in offset(), y in offset(), n in prop::sample::select(vec![1_u32, 2, 4])) {
        let steepness = 0.6066 * h / sigma / f64::from(n) * (1.0 + 1.0 / 8.0) + 1e-13 * (z / sigma + 2.0);
        let room = cartesian(z, sigma, h, [x, y]);
        let [few, many] = [n, 8 * n].map(|n| room.clone().with_sampling(Sampling::Averaged(n)).unwrap().map(MAX_CELLS).unwrap());
        let shift = [0, 1].map(|k| ((few.geometry().origin()[k] - many.geometry().origin()[k]) / h).round() as usize);
        for j in 0..few.height() {
            for i in 0..few.width() {
                let (p, q) = (few.occupancy(j, i).unwrap(), many.occupancy(j + shift[1], i + shift[0]).unwrap());
                prop_assert!((p - q).abs() <= 0.3826 * steepness, "{} {}", p, q);
            }
        }
        let [few, many] = [n, 8 * n].map(|n| polar(z, sigma, h).with_sampling(Sampling::Averaged(n)).unwrap().map(1, MAX_CELLS).unwrap());
        for (p, q) in few.cells().iter().zip(many.cells()) {
            prop_assert!((p - q).abs() <= 0.25 * steepness, "{} {}", p, q);
        }
    }

    /// Jensen: cells that hold the mean over nested cells. Each mean and each information is rounded: `ε` of the chapter.
    #[test]
    fn averaged_grids_grow_under_refinement((z, sigma, h) in room(0.6..12.0), x in -256_i32..256, y in -256_i32..256, n in prop::sample::select(vec![2_u32, 4, 8])) {
        let epsilon = 29.0 * power(-53);
        let offsets = [x, y].map(|k| f64::from(k) / 512.0);
        let tally = |h: f64, offsets, n| cartesian(z, sigma, h, offsets).with_sampling(Sampling::Averaged(n)).unwrap().tally().unwrap();
        let (coarse, fine) = (tally(h, offsets, n), tally(h / 2.0, offsets.map(|x| 2.0 * x - 0.5), n / 2));
        prop_assert!(4 * coarse.observed() >= fine.observed());
        prop_assert!(coarse.mean_information() <= fine.mean_information() + 2.0 * epsilon);
        let tally = |h: f64, n| polar(z, sigma, h).with_sampling(Sampling::Averaged(n)).unwrap().tally().unwrap();
        let (coarse, fine) = (tally(h, n), tally(h / 2.0, n / 2));
        prop_assert!(2 * coarse.observed() >= fine.observed());
        prop_assert!(coarse.mean_information() <= fine.mean_information() + 2.0 * epsilon);
    }

    /// No bits of any sort make it panic or run on.
    #[test]
    fn any_bits_give_a_tally_or_an_error(bits in any::<[u64; 5]>(), near in any::<bool>(), n in 0_u32..9) {
        let [z, sigma, h, x, y] = bits.map(f64::from_bits);
        let h = if near { z.abs() / 7.3 } else { h };
        let Ok(sensor) = GaussianSensor::new(z.abs(), sigma.abs()) else { return Ok(()) };
        let sampling = Sampling::Averaged(n);
        let room = CartesianRoom::new(sensor, h, [x, y]).and_then(|room| room.with_sampling(sampling));
        if let Ok(tally) = room.and_then(|room| room.with_limit(2000).tally()) {
            prop_assert!((0.0..=1.0).contains(&tally.mean_information()) && tally.cells() <= 2000);
        }
        let room = PolarRoom::new(sensor, h).and_then(|room| room.with_sampling(sampling));
        if let Ok(tally) = room.and_then(|room| room.with_limit(2000).tally()) {
            prop_assert!((0.0..=1.0).contains(&tally.mean_information()) && tally.cells() <= 2000);
        }
    }
}

/// Here `σ` is large beside the floats' spacing, and centres on the circle `ρ = z - σ √(ln 4)` have `p = 1/2` after rounding.
#[test]
fn centres_where_the_model_is_one_half_are_unobserved() {
    let (z, sigma) = (2.0_f32, 1.5);
    let sensor = GaussianSensor::new(z, sigma).unwrap();
    let mut rho = 0.2338_f32;
    while sensor.occupancy(rho) != 0.5 {
        rho = rho.next_up();
    }
    let beam = PolarRoom::new(sensor, 2.0 * rho).unwrap();
    let map = beam.map(1, 100).unwrap();
    assert_eq!((map.occupancy(0, 0), beam.distance(0)), (Some(0.5), rho));
    assert_eq!(beam.tally().unwrap().unknown(), 1);
    // Twelve cells are 5 from the origin: (±3, ±4), (±4, ±3), (±5, 0), (0, ±5).
    let mut h = rho / 5.0;
    let mut room = CartesianRoom::new(sensor, h, [0.0; 2]).unwrap();
    while sensor.occupancy(room.distance(3, -4).unwrap()) != 0.5 {
        h = h.next_up();
        room = CartesianRoom::new(sensor, h, [0.0; 2]).unwrap();
    }
    let within = |reach: f32| {
        let side = (reach / h) as i64 + 2;
        let indices = (-side..=side).flat_map(|i| (-side..=side).map(move |j| (i, j)));
        indices.filter(|&(i, j)| room.distance(i, j).unwrap() <= reach).count() as u64
    };
    let reach = sensor.reach();
    // At the outer edge the float may be 1/2 as well: no centre lies there.
    assert_eq!(room.tally().unwrap().observed(), within(reach) - 12);
}

#[test]
fn steps_are_counted_exactly() {
    // Free up to 3.75, occupied to 4.25, in cells of 1/2: rings end at 7.5 and 8.5 cells.
    let sensor = SteppedSensor::new(4.0_f64, 0.5, 0.25, 0.875).unwrap();
    let tally = PolarRoom::new(sensor, 0.5).unwrap().tally().unwrap();
    assert_eq!(
        (tally.free(), tally.occupied(), tally.unknown()),
        (7, 2, 0),
        "8.5 cells: the face is included"
    );
    // The cell of the step, from 7 to 8, is half free and half occupied: 9/16.
    let averaged = PolarRoom::new(sensor, 0.5).unwrap().with_sampling(Sampling::Averaged(2)).unwrap();
    assert_eq!(averaged.map(1, 9).unwrap().cells()[6..], [0.25, 0.5625, 0.6875]);
    assert_eq!(averaged.tally().unwrap(), averaged.map(1, 9).unwrap().tally());
    let tally = CartesianRoom::new(sensor, 0.5, [-3.0, 2.0]).unwrap().tally().unwrap();
    // Lattice points with i^2 + j^2 < 56.25, and up to 72.25.
    let count = |limit: f64| {
        let points = (-9..=9).flat_map(|i| (-9..=9).map(move |j| f64::from(i * i + j * j)));
        points.filter(|&n| n < limit).count() as u64
    };
    assert_eq!((tally.free(), tally.observed(), tally.cells()), (count(56.25), count(72.3), 17 * 17));
    assert!(
        PolarRoom::new(SteppedSensor::new(1.0, 4.0, 0.5, 0.875).unwrap(), 0.3)
            .unwrap()
            .tally()
            .unwrap()
            .free()
            == 0
    );
}

#[test]
fn a_grid_may_miss_the_room() {
    let sensor = GaussianSensor::new(2.0_f64, 0.2).unwrap();
    let room = CartesianRoom::new(sensor, 10.0, [0.5, 0.0]).unwrap();
    assert_eq!((room.width().unwrap(), room.height().unwrap()), (0, 1));
    let tally = room.tally().unwrap();
    assert_eq!((tally.cells(), tally.mean_information()), (0, 0.0));
    assert_eq!(room.map(0).unwrap().tally(), tally);
    assert_eq!(PolarRoom::new(sensor, 10.0).unwrap().tally().unwrap().cells(), 0);
    // A corner of the averaged cell is within.
    let averaged = PolarRoom::new(sensor, 10.0).unwrap().with_sampling(Sampling::Averaged(4)).unwrap();
    assert_eq!(averaged.tally().unwrap().free(), 1);
}

/// The numbers of the chapter and of the crate's theory: cells of 8 cm, 1 cm and 2.5 mm.
#[test]
fn the_known_values() {
    for (h, cartesian_value, polar_value) in
        [(0.08, 0.651_649, 0.787_331), (0.01, 0.652_433, 0.787_744), (0.0025, 0.652_525, 0.789_507)]
    {
        let grid = cartesian(2.0_f64, 0.2, h, [0.5; 2]).tally().unwrap().mean_information();
        let beam = polar(2.0_f64, 0.2, h).tally().unwrap().mean_information();
        assert_eq!([grid, beam].map(|x| (x * 1e6).round() / 1e6), [cartesian_value, polar_value]);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// One place, a square four times as wide as the reach `L`, in ever smaller cells. Of its `(4 L / h)^2` cells at most
    /// `(2 L / h + 1)^2` are observed, and each of the others adds a bit: for `h <= L / 2` the entropy is at least `9.75 (L /
    /// h)^2`, without bound. The mean information stays within a bound of its limit that shrinks with `h`.
    #[test]
    fn entropy_grows_without_bound_while_mean_information_settles((z, sigma, coarse) in room(3.0..9.0), offsets in [offset(), offset()]) {
        let sensor = GaussianSensor::new(z, sigma)?;
        let limit = closed_form(&sensor, Weight::Area);
        let mut before = (0.0, f64::INFINITY);
        for k in 0..5 {
            let h = coarse * power(-k);
            // A little short of the reach, so that the bound on the entropy holds with roundings.
            let cells = (z + 1.177 * sigma) / h;
            let mut tally = CartesianRoom::new(sensor, h, offsets)?.tally()?;
            let all = (16.0 * cells * cells) as u64;
            tally.add_many(Cell::unknown(), all - tally.cells());
            let bound = bounds::cartesian(&sensor, h)?;
            prop_assert!(tally.entropy() >= 9.75 * cells * cells && tally.entropy() > 3.0 * before.0);
            // From where it says more than that they differ by at most 1.
            prop_assert!((tally.mean_information() - limit).abs() <= bound && (bound < 0.75 * before.1 || before.1 >= 1.0));
            before = (tally.entropy(), bound);
        }
    }
}

/// The nearest sample of the cell about the sensor decides whether it is in the grid: here `(0.05, 0.05)` of a cell whose
/// centre is at `(0.2, 0.2)`, and of which the reach is 0.11.
#[test]
fn the_nearest_sample_of_the_cell_about_the_sensor() {
    for offset in [0.2, -0.2] {
        let room = cartesian(0.1_f64, 0.01, 1.0, [offset; 2]).with_sampling(Sampling::Averaged(2)).unwrap();
        let tally = room.tally().unwrap();
        assert_eq!((tally.cells(), tally.observed()), (1, 1));
        assert_eq!(room.map(1).unwrap().tally(), tally);
    }
}
