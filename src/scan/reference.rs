//! How scans were inserted before anything was short, as a reference: each cell of each beam is asked about, places are exact
//! quotients, and sums are kept one by one.

use super::beams::{Beam, Scan};
use super::direction::Direction;
use super::lattice::Lattice;
use super::pose::Pose;
use super::rays::Rays;
use super::scan_map::ScanMap;
use super::traversal::Traversal;
use crate::error::Error;
use crate::real::Real;
use crate::rounded::fixed_log_odds;
use crate::sensor::{GaussianSensor, InverseSensorModel, SteppedSensor};
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use core::cell::Cell;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::TestRunner;

/// The sum of the readings of each cell, and that of their magnitudes.
type Sums = BTreeMap<[i64; 2], (i128, i128)>;

/// Adds a scan by its definition, `sign` times: each cell of each beam, the strongest occupancy of each cell, its limited log-odds.
fn add<T: Real, M: InverseSensorModel<Float = T>>(
    sums: &mut Sums,
    scan: &Scan<T>,
    [resolution, limit]: [f64; 2],
    model: impl Fn(T) -> Result<M, Error>,
    sign: i128,
) {
    let lattice = Lattice::new(resolution);
    let start = scan.pose().position().map(|x| lattice.nearest(x).unwrap());
    let mut told: BTreeMap<[i64; 2], T> = BTreeMap::new();
    for beam in scan.beams() {
        let model = model(beam.range.unwrap_or(scan.maximum_range())).unwrap();
        let length = if beam.range.is_some() { model.reach() } else { scan.maximum_range() };
        let direction = Direction::new(&[scan.pose().theta(), beam.bearing]).unwrap();
        let end = lattice.along_exactly(start, direction, length.widen()).unwrap();
        for cell in Traversal::new(start, end) {
            let p = model.occupancy(T::nearest(lattice.distance_to_centre(start, cell)));
            if beam.range.is_some() || p < T::HALF {
                let known = told.entry(cell).or_insert(T::HALF);
                *known = if *known > T::HALF || p > T::HALF { known.max(p) } else { known.min(p) };
            }
        }
    }
    let limit = (limit * f64::from_parts(1, 80)) as i128;
    for (cell, p) in told {
        let reading = fixed_log_odds(p).clamp(-limit, limit);
        let sum = sums.entry(cell).or_insert((0, 0));
        *sum = (sum.0 + sign * reading, sum.1 + sign * reading.abs());
    }
}

/// The scans of a map: poses and beams; a fan of dense beams, as scanners have them, or a few anywhere.
fn scans() -> impl Strategy<Value = Vec<Scan<f64>>> {
    let beam = (-7.0_f64..7.0, prop_oneof![5 => (0.03_f64..3.0).prop_map(Some), 1 => Just(None)])
        .prop_map(|(bearing, range)| Beam { bearing, range });
    let fan = (-4.0_f64..4.0, -0.06_f64..0.06, 0.3_f64..3.0, 0.0_f64..0.6, 9_u32..40).prop_map(
        |(from, step, range, rough, count)| {
            let beam = |k: u32| {
                let part = (f64::from(k) * 0.618_033_988_749_894_9).fract();
                Beam {
                    bearing: from + f64::from(k) * step,
                    range: Some((range * (1.0 - rough * part)).max(0.03)),
                }
            };
            (0..count).map(beam).collect()
        },
    );
    let beams = prop_oneof![vec(beam, 1..12), fan];
    let place = || prop_oneof![-2.0_f64..2.0, (-8_i32..8).prop_map(|k| f64::from(k) * 0.25)];
    let scan = (place(), place(), prop_oneof![-9.0_f64..9.0, Just(0.0)], beams)
        .prop_map(|(x, y, theta, beams)| Scan::new(Pose::new(x, y, theta).unwrap(), 3.25, beams).unwrap());
    vec(scan, 1..4)
}

/// A scan of neighbours that share cells: 70 beams or more at half a degree to two, up to 3 m and mostly far, with some of no return.
fn dense() -> impl Strategy<Value = Scan<f64>> {
    let step =
        prop_oneof![Just(1.0), 0.5_f64..2.0].prop_flat_map(|step| prop_oneof![Just(step), Just(-step)]);
    let fan = (-180.0_f64..180.0, step, 1.0_f64..3.0, 0.0_f64..0.6, 70_u32..110);
    let place = || prop_oneof![-2.0_f64..2.0, (-8_i32..8).prop_map(|k| f64::from(k) * 0.25)];
    (place(), place(), -4.0_f64..4.0, fan).prop_map(|(x, y, theta, (from, step, range, rough, count))| {
        let beam = |k: u32| {
            let part = (f64::from(k) * 0.618_033_988_749_894_9).fract();
            let bearing = (from + f64::from(k) * step + 180.0).rem_euclid(360.0) - 180.0;
            let range = (k % 23 != 22).then_some(range * (1.0 - rough * part));
            Beam { bearing: bearing.to_radians(), range }
        };
        Scan::new(Pose::new(x, y, theta).unwrap(), 3.25, (0..count).map(beam).collect()).unwrap()
    })
}

/// A scan from the centre of a cell of 25 cm, along axes and through the centres at 3 by 4 cells, of lengths in eighths of a metre.
fn centred() -> impl Strategy<Value = Scan<f64>> {
    // The arc tangents of 3/4 and 4/3.
    let angles = prop_oneof![Just(0.0), Just(0.643_501_108_793_284_4), Just(0.927_295_218_001_612_2)];
    let beam = (angles, 0_u32..4, 2_u32..26).prop_map(|(angle, quarters, eighths)| Beam {
        bearing: angle + f64::from(quarters) * std::f64::consts::FRAC_PI_2,
        range: Some(f64::from(eighths) / 8.0),
    });
    let centre = || (-8_i32..8).prop_map(|k| f64::from(2 * k + 1) / 8.0);
    (centre(), centre(), vec(beam, 2..12))
        .prop_map(|(x, y, beams)| Scan::new(Pose::new(x, y, 0.0).unwrap(), 3.25, beams).unwrap())
}

/// Sides of cells of which most near the sensor are shared, and limits.
fn fine() -> impl Strategy<Value = [f64; 2]> {
    [prop_oneof![Just(0.025), 0.02_f64..0.03].boxed(), prop_oneof![Just(3.5), 0.2_f64..40.0].boxed()]
}

/// Sides of cells, with which many beams go through corners, and limits.
fn setting() -> impl Strategy<Value = [f64; 2]> {
    let side = prop_oneof![Just(0.25), Just(0.0625), 0.05_f64..0.6];
    [side.boxed(), prop_oneof![Just(3.5), 0.2_f64..40.0].boxed()]
}

/// Inserts the scans, and removes and inserts some; compares each sum with the reference.
fn check<T: Real, M: InverseSensorModel<Float = T>>(
    scans: &[Scan<T>],
    [resolution, limit]: [f64; 2],
    removed: usize,
    model: impl Fn(T) -> Result<M, Error>,
) -> Result<(), TestCaseError> {
    let mut map = ScanMap::<T>::new(resolution)?.with_reading_limit(limit)?.with_agreement()?;
    let mut sums = Sums::new();
    for scan in scans {
        map.insert(scan, &model)?;
        add(&mut sums, scan, [resolution, limit], &model, 1);
    }
    compare(&map, &sums)?;
    for scan in scans.iter().take(removed) {
        map.remove(scan, &model)?;
        add(&mut sums, scan, [resolution, limit], &model, -1);
    }
    compare(&map, &sums)?;
    for scan in scans.iter().take(removed).rev() {
        map.insert(scan, &model)?;
        add(&mut sums, scan, [resolution, limit], &model, 1);
    }
    compare(&map, &sums)
}

fn compare<T: Real>(map: &ScanMap<T>, sums: &Sums) -> Result<(), TestCaseError> {
    let Some(stored) = &map.sums else {
        prop_assert!(sums.values().all(|&sum| sum == (0, 0)));
        return Ok(());
    };
    let ([column, row], [width, _]) = (stored.seen().low(), stored.seen().size());
    let mut others = sums.values().filter(|&&sum| sum != (0, 0)).count();
    for (k, pair) in stored.pairs().expect("agreement").enumerate() {
        let cell = [column + (k % width) as i64, row + (k / width) as i64];
        prop_assert_eq!(pair, sums.get(&cell).copied().unwrap_or((0, 0)), "{:?}", cell);
        others -= usize::from(pair != (0, 0));
    }
    prop_assert_eq!(others, 0, "outside of the map");
    Ok(())
}

/// Compares maps of dense scans of two levels and of Eq. 5 with the reference; returns how many columns neighbours share.
fn check_shared(
    scan: &Scan<f64>,
    setting: [f64; 2],
    stepped: impl Fn(f64) -> Result<SteppedSensor<f64>, Error>,
    smooth: impl Fn(f64) -> Result<GaussianSensor<f64>, Error>,
) -> Result<u64, TestCaseError> {
    check(std::slice::from_ref(scan), setting, 0, &stepped)?;
    check(std::slice::from_ref(scan), setting, 0, &smooth)?;
    let map = ScanMap::<f64>::new(setting[0])?.with_reading_limit(setting[1])?;
    let stepped = Rays::new(map.lattice, map.limit, scan, stepped)?.shared_columns();
    let smooth = Rays::new(map.lattice, map.limit, scan, smooth)?.shared_columns();
    Ok(stepped.min(smooth))
}

fn single(scan: &Scan<f64>) -> Scan<f32> {
    let beam = |beam: &Beam<f64>| Beam { bearing: beam.bearing, range: beam.range.map(|range| range as f32) };
    Scan::new(*scan.pose(), 3.25, scan.beams().iter().map(beam).collect()).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(30))]

    /// Of two levels, which are counted; thicker than some ranges, too, and of one level alone.
    #[test]
    fn steps_are_those_of_the_reference(
        scans in scans(), setting in setting(), removed in 0_usize..5, thickness in 0.01_f64..1.0,
        free in prop_oneof![0.0..0.49, Just(0.5), Just(0.0)], occupied in prop_oneof![0.51..1.0, Just(0.5)],
    ) {
        check(&scans, setting, removed, |range| SteppedSensor::new(range, thickness, free, occupied))?;
        let scans: Vec<_> = scans.iter().map(single).collect();
        let [thickness, free, occupied] = [thickness, free, occupied].map(|x| x as f32);
        check(&scans, setting, removed, |range| SteppedSensor::new(range, thickness, free, occupied))?;
    }

    /// Of levels that differ from beam to beam, which are counted until they are too many.
    #[test]
    fn mixed_levels_are_those_of_the_reference(
        scans in scans(), setting in setting(), removed in 0_usize..5, free in [0.0..0.49, 0.0..0.49], from in 0.0_f64..3.0,
    ) {
        check(&scans, setting, removed, |range| SteppedSensor::new(range, 0.125, free[usize::from(range > from)], 0.875))?;
    }

    /// Of obstacles that differ, all of them surer than the limit: of one cell, told two of them, the reading is added once.
    #[test]
    fn obstacles_beyond_the_limit_are_those_of_the_reference(scans in scans(), removed in 0_usize..5, occupied in [0.9..1.0, 0.9..1.0]) {
        let of = |range: f64| occupied[(range * 64.0) as usize % 2];
        check(&scans, [0.25, 2.0], removed, |range| SteppedSensor::new(range, 0.25, 0.25, of(range)))?;
    }

    /// Of walls that begin and end at the centres of cells, where no square of a distance decides.
    #[test]
    fn walls_from_centre_to_centre_are_those_of_the_reference(scan in centred(), thickness in prop_oneof![Just(0.25), Just(0.5)]) {
        check(std::slice::from_ref(&scan), [0.25, 3.5], 1, |range| SteppedSensor::new(range, thickness, 0.25, 0.875))?;
        check(&[single(&scan)], [0.25, 3.5], 1, |range| SteppedSensor::new(range, thickness as f32, 0.25, 0.875))?;
    }

    #[test]
    fn the_model_of_eq_5_is_that_of_the_reference(
        scans in scans(), setting in setting(), removed in 0_usize..5, sigma in prop_oneof![0.002_f64..0.3, Just(0.05)],
    ) {
        check(&scans, setting, removed, |range| GaussianSensor::new(range, sigma))?;
        let scans: Vec<_> = scans.iter().map(single).collect();
        check(&scans, setting, removed, |range| GaussianSensor::new(range, sigma as f32))?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Of few beams whose walls begin one to four cells from the sensor: a beam cuts off corners of cells whose centres are farther.
    #[test]
    fn near_walls_are_those_of_the_reference(
        place in [-0.5_f64..0.5, -0.5_f64..0.5], beams in vec((-4.0_f64..4.0, 0.25_f64..0.9), 1..5),
    ) {
        let beam = |(bearing, near)| Beam { bearing, range: Some(near + 0.5) };
        let beams = beams.into_iter().map(beam).collect();
        let scan = Scan::new(Pose::new(place[0], place[1], 0.0)?, 3.25, beams)?;
        check(&[scan], [0.25, 3.5], 0, |range| SteppedSensor::new(range, 1.0, 0.25, 0.875))?;
    }
}

/// A beam past the corner of a cell, above it, whose wall begins behind the corner and before the centre of that cell.
#[test]
fn a_cell_is_not_free_where_only_its_corner_is() {
    let pose = Pose::new(0.125, 0.13, 0.0).unwrap();
    let beam = Beam { bearing: std::f64::consts::FRAC_PI_4, range: Some(1.0425) };
    let scan = Scan::new(pose, 3.25, [beam].into()).unwrap();
    check(&[scan], [0.25, 3.5], 0, |range| SteppedSensor::new(range, 1.0, 0.25, 0.875)).unwrap();
}

/// What neighbours share is drawn once; of nearly all scans it is most of the columns near the sensor.
#[test]
fn dense_scans_are_those_of_the_reference() {
    let (cases, shared) = (12, Cell::new([0; 2]));
    let strategy = (dense(), fine(), 0.05_f64..0.3, prop_oneof![0.0..0.49, Just(0.25)], 0.005_f64..0.1);
    let mut runner = TestRunner::new(ProptestConfig::with_cases(cases));
    let outcome = runner.run(&strategy, |(scan, setting, thickness, free, sigma)| {
        let stepped = |range| SteppedSensor::new(range, thickness, free, 0.875);
        let columns = check_shared(&scan, setting, stepped, |range| GaussianSensor::new(range, sigma))?;
        let [scans, all] = shared.get();
        shared.set([scans + u64::from(columns > 0), all + columns]);
        Ok(())
    });
    outcome.unwrap();
    let [scans, columns] = shared.get();
    assert!(scans * 4 > u64::from(cases) * 3, "{scans} of {cases} scans share columns");
    assert!(columns > 500 * u64::from(cases), "{columns} columns are shared");
}
