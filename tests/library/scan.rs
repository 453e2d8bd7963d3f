//! Scans inserted into maps: against cells found one by one, and relations that change no bit.

mod agreement;
mod jackknife;
mod particles;
mod public_log;
mod refused;
mod removal;

use super::common::power;
use approx::{abs_diff_eq, abs_diff_ne, assert_abs_diff_eq};
use mean_information::cell::log_odds_from_occupancy;
use mean_information::map::encoding::LogOdds;
use mean_information::map::{Geometry, Grid, encoding::Probability};
use mean_information::scan::{Beam, Direction, Pose, Scan, ScanMap};
use mean_information::sensor::{GaussianSensor, InverseSensorModel, SteppedSensor};
use mean_information::{Error, Real, Tally};
use proptest::collection::vec;
use proptest::prelude::*;
use std::cell::Cell;

const SIGMA: f64 = 0.07;
const MAXIMUM: f64 = 3.25;

fn gaussian(range: f64) -> Result<GaussianSensor<f64>, Error> {
    GaussianSensor::new(range, SIGMA)
}

fn beam() -> impl Strategy<Value = Beam<f64>> {
    let range = prop_oneof![4 => (0.05..MAXIMUM).prop_map(Some), 1 => Just(None)];
    (-7.0_f64..7.0, range).prop_map(|(bearing, range)| Beam { bearing, range })
}

fn pose() -> impl Strategy<Value = [f64; 3]> {
    [-2.0_f64..2.0, -2.0_f64..2.0, -9.0_f64..9.0]
}

fn scan([x, y, theta]: [f64; 3], beams: &[Beam<f64>]) -> Scan<f64> {
    Scan::new(Pose::new(x, y, theta).unwrap(), MAXIMUM, beams.to_vec()).unwrap()
}

fn built(resolution: f64, scans: &[Scan<f64>]) -> ScanMap<f64> {
    let mut map = ScanMap::new(resolution).unwrap();
    for scan in scans {
        map.insert(scan, gaussian).unwrap();
    }
    map
}

fn grid(map: &ScanMap<f64>) -> Grid<LogOdds<f64>> {
    map.log_odds().unwrap()
}

/// How long a segment stays in a square, as a part of it: the slab method.
fn part_inside(from: [f64; 2], to: [f64; 2], corner: [f64; 2], side: f64) -> f64 {
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    for k in [0, 1] {
        let d = to[k] - from[k];
        let (a, b) = ((corner[k] - from[k]) / d, (corner[k] + side - from[k]) / d);
        low = low.max(a.min(b));
        high = high.min(a.max(b));
    }
    high - low
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    /// The definition, cell by cell: which beams cross it, what their models say at its centre, the stronger reading,
    /// limited.
    #[test]
    fn it_is_the_definition(poses in vec(pose(), 1..4), beams in vec(beam(), 1..9), resolution in 0.1_f64..0.6) {
        let scans: Vec<_> = poses.iter().map(|&pose| scan(pose, &beams)).collect();
        let map = grid(&built(resolution, &scans));
        let origin = map.geometry().origin();
        for row in 0..map.height() {
            for column in 0..map.width() {
                let corner = [origin[0] + column as f64 * resolution, origin[1] + row as f64 * resolution];
                let mut sum = 0.0;
                let mut doubtful = false;
                for &[x, y, theta] in &poses {
                    let from = [x, y];
                    let centre = corner.map(|c| c + resolution / 2.0);
                    let (dx, dy) = (centre[0] - x, centre[1] - y);
                    let rho = mean_information::elementary::sqrt(dx * dx + dy * dy);
                    let (mut occupied, mut free) = (0.5_f64, 0.5_f64);
                    for beam in &beams {
                        let sensor = gaussian(beam.range.unwrap_or(MAXIMUM))?;
                        let length = if beam.range.is_some() { sensor.reach() } else { MAXIMUM };
                        let direction = Direction::new(&[theta, beam.bearing])?;
                        let to = [x + length * direction.cos(), y + length * direction.sin()];
                        let inside = part_inside(from, to, corner, resolution);
                        // A corner that is cut so thinly may fall on either side of it in floats.
                        doubtful |= inside.abs() < 1e-7;
                        let p = sensor.occupancy(rho);
                        // The edges of the model: 1/2, and the end of free space.
                        doubtful |= (rho - sensor.reach()).abs() < 1e-7 || (p - 0.5).abs() < 1e-5;
                        if inside > 0.0 && (beam.range.is_some() || p < 0.5) {
                            occupied = occupied.max(p);
                            free = free.min(p);
                        }
                    }
                    let p = if occupied > 0.5 { occupied } else { free };
                    sum += log_odds_from_occupancy(p).clamp(-3.5, 3.5);
                }
                let found = map.cells()[row * map.width() + column];
                // Distances are off by 2^-28 of a cell and some ulps, below 4e-9 m, and the slope |t| / (σ (1 - p))
                // of the log-odds is at most 9 / σ where they are not limited.
                prop_assert!(doubtful || abs_diff_eq!(found, sum, epsilon = poses.len() as f64 * 9.0 / SIGMA * 4e-9), "{found} {sum}");
            }
        }
    }

    /// A model whose plateau the map does not know of is asked in every cell, and says the same.
    #[test]
    fn the_plateau_changes_no_bit(poses in vec(pose(), 1..4), beams in vec(beam(), 1..9), resolution in 0.02_f64..0.3, sigma in prop_oneof![Just(0.004), 0.001_f64..0.2]) {
        fn inserted<M: InverseSensorModel<Float = T>, T: Real>(resolution: f64, scans: &[Scan<T>], model: impl Fn(T) -> Result<M, Error>) -> (Tally<T>, Vec<T>) {
            let mut map = ScanMap::<T>::new(resolution).unwrap();
            for scan in scans {
                map.insert(scan, &model).unwrap();
            }
            (map.tally(), map.log_odds().unwrap().cells().to_vec())
        }
        let scans: Vec<_> = poses.iter().map(|&pose| scan(pose, &beams)).collect();
        let sensor = |range| GaussianSensor::new(range, sigma);
        prop_assert_eq!(
            inserted(resolution, &scans, sensor),
            inserted(resolution, &scans, |range| sensor(range).map(WithoutPlateau))
        );
        let steps = |range| SteppedSensor::new(range, sigma, 0.3, 0.9);
        prop_assert_eq!(
            inserted(resolution, &scans, steps),
            inserted(resolution, &scans, |range| steps(range).map(WithoutPlateau))
        );
        let single = |beam: &Beam<f64>| Beam { bearing: beam.bearing, range: beam.range.map(|range| range as f32) };
        let scans: Vec<_> = scans.iter().map(|scan| {
            Scan::new(*scan.pose(), MAXIMUM as f32, scan.beams().iter().map(single).collect()).unwrap()
        }).collect();
        let sensor = |range| GaussianSensor::new(range, sigma as f32);
        prop_assert_eq!(
            inserted(resolution, &scans, sensor),
            inserted(resolution, &scans, |range| sensor(range).map(WithoutPlateau))
        );
    }

    /// The sums with and without a map, and of each cell for itself, of cells alike and not.
    #[test]
    fn the_tally_is_that_of_the_map(poses in vec(pose(), 0..4), beams in vec(beam(), 1..9), resolution in 0.05_f64..0.6) {
        let scans: Vec<_> = poses.iter().map(|&pose| scan(pose, &beams)).collect();
        let mut map = built(resolution, &scans);
        prop_assert_eq!(map.tally(), grid(&map).tally());
        for scan in &scans {
            map.insert(scan, |range| SteppedSensor::new(range, 0.2, 0.375, 1.0)).unwrap();
            prop_assert_eq!(map.tally(), grid(&map).tally());
        }
        let grid = map.log_odds().unwrap();
        let cells = grid.cells().iter().map(|&l| mean_information::cell::Cell::from_log_odds(l).unwrap());
        prop_assert_eq!(map.tally(), cells.collect());
    }

    #[test]
    fn no_order_of_scans_or_beams_changes_a_bit(scans in vec((pose(), vec(beam(), 1..9)), 1..5), turn in 1_usize..9) {
        let straight: Vec<_> = scans.iter().map(|(pose, beams)| scan(*pose, beams)).collect();
        let mut turned: Vec<_> = scans.iter().map(|(pose, beams)| {
            let mut beams = beams.clone();
            let turn = turn % beams.len();
            beams.rotate_left(turn);
            beams.reverse();
            scan(*pose, &beams)
        }).collect();
        turned.rotate_left(turn % scans.len());
        prop_assert_eq!(grid(&built(0.19, &straight)), grid(&built(0.19, &turned)));
    }

    /// Against a correctly rounded library: each is rounded to nearest from within `0.51 * 2^-62`, so both are within half an
    /// ulp of 1 and that. Angles add up without rounding: multiples of `2^-20` do so in floats too.
    #[test]
    fn directions_agree_with_core_math(any in any::<f64>(), a in -1_i64 << 40..1 << 40, b in -1_i64 << 40..1 << 40) {
        let tolerance = power(-53) + power(-62);
        let near = |direction: Direction, angle: f64| {
            abs_diff_eq!(direction.cos(), core_math::cos(angle), epsilon = tolerance) && abs_diff_eq!(direction.sin(), core_math::sin(angle), epsilon = tolerance)
        };
        let [a, b] = [a, b].map(|k| k as f64 * power(-20));
        prop_assert!(near(Direction::new(&[a])?, a));
        prop_assert!(near(Direction::new(&[a, b])?, a + b));
        prop_assert!(near(Direction::new(&[b, a, -b])?, a));
        prop_assume!(any.is_finite());
        prop_assert!(near(Direction::new(&[any])?, any));
    }

    /// The limit is one on the map, not on the memory that growing it takes: a map fits exactly, in any order.
    #[test]
    fn a_map_that_fits_fits_in_any_order(poses in vec([-9.0_f64..9.0, -9.0_f64..9.0, -9.0_f64..9.0], 2..9), beams in vec(beam(), 1..4), turn in 0_usize..9) {
        let mut scans: Vec<_> = poses.iter().map(|&pose| scan(pose, &beams)).collect();
        let whole = grid(&built(0.3, &scans));
        let turn = turn % scans.len();
        scans.rotate_left(turn);
        let limit = whole.cells().len() as u64;
        let mut map = ScanMap::<f64>::new(0.3)?.with_max_cells(limit);
        for scan in &scans {
            map.insert(scan, gaussian)?;
        }
        prop_assert_eq!(grid(&map), whole);
        let mut map = ScanMap::<f64>::new(0.3)?.with_max_cells(limit - 1);
        prop_assert!(scans.iter().any(|scan| map.insert(scan, gaussian).is_err()));
    }

    /// Mirrored at the x axis: poses, headings and bearings change sign, rows too.
    #[test]
    fn a_mirrored_scan_has_a_mirrored_map(pose in pose(), beams in vec(beam(), 1..12)) {
        let [x, y, theta] = pose;
        let mirrored: Vec<_> = beams.iter().map(|beam| Beam { bearing: -beam.bearing, ..*beam }).collect();
        let straight = grid(&built(0.19, &[scan(pose, &beams)]));
        let mirrored = grid(&built(0.19, &[scan([x, -y, -theta], &mirrored)]));
        prop_assert_eq!((straight.width(), straight.height()), (mirrored.width(), mirrored.height()));
        for row in 0..straight.height() {
            prop_assert_eq!(straight.row(row), mirrored.row(straight.height() - 1 - row));
        }
    }

    /// Lengths times a power of two, and places moved by whole cells: the same bits.
    #[test]
    fn scaled_and_moved_scans_have_the_same_map(pose in pose(), beams in vec(beam(), 1..9), k in -3_i32..4, columns in -99_i32..99, rows in -99_i32..99) {
        // Multiples of 2^-20, so that sums are exact.
        let whole = |x: f64| (x * power(20)).round() / power(20);
        let [x, y, theta] = pose;
        let (x, y) = (whole(x), whole(y));
        let scale = power(k);
        let resolution = 0.125;
        let first = grid(&built(resolution, &[scan([x, y, theta], &beams)]));
        let (x, y) = (x + f64::from(columns) * resolution, y + f64::from(rows) * resolution);
        let scaled: Vec<_> = beams.iter().map(|beam| Beam { range: beam.range.map(|r| r * scale), ..*beam }).collect();
        let scaled = Scan::new(Pose::new(x * scale, y * scale, theta)?, MAXIMUM * scale, scaled)?;
        let mut map = ScanMap::<f64>::new(resolution * scale)?;
        map.insert(&scaled, |range| GaussianSensor::new(range, SIGMA * scale))?;
        let second = map.log_odds()?;
        prop_assert_eq!(first.cells(), second.cells());
        for (k, moved) in [columns, rows].into_iter().enumerate() {
            let (old, new) = (first.geometry().origin()[k], second.geometry().origin()[k]);
            prop_assert_eq!((old + f64::from(moved) * resolution) * scale, new);
        }
    }

    /// The same scan again doubles every log-odds, to the last bit, and never lowers the information.
    #[test]
    fn a_repeated_scan_doubles_the_log_odds(pose in pose(), beams in vec(beam(), 1..9)) {
        let scan = scan(pose, &beams);
        let (once, twice) = (built(0.19, std::slice::from_ref(&scan)), built(0.19, &[scan.clone(), scan]));
        let doubled: Vec<f64> = grid(&once).cells().iter().map(|l| 2.0 * l).collect();
        prop_assert_eq!(grid(&twice).cells().to_vec(), doubled);
        let (once, twice) = (grid(&once).tally(), grid(&twice).tally());
        prop_assert_eq!(once.observed(), twice.observed());
        prop_assert!(twice.mean_information() >= once.mean_information());
    }

    #[test]
    fn a_beam_without_return_frees_and_never_occupies(pose in pose(), bearing in -7.0_f64..7.0) {
        let map = built(0.07, &[scan(pose, &[Beam { bearing, range: None }])]);
        let tally = grid(&map).tally();
        prop_assert!(tally.occupied() == 0 && tally.free() > 20);
    }

    #[test]
    fn single_precision_agrees_with_double(pose in pose(), beams in vec(beam(), 1..9)) {
        let wide = grid(&built(0.19, &[scan(pose, &beams)]));
        let narrow: Vec<_> = beams.iter().map(|b| Beam { bearing: b.bearing, range: b.range.map(|r| r as f32) }).collect();
        let narrow = Scan::new(Pose::new(pose[0], pose[1], pose[2])?, MAXIMUM as f32, narrow)?;
        let mut map = ScanMap::<f32>::new(0.19)?;
        map.insert(&narrow, |range| GaussianSensor::new(range, SIGMA as f32))?;
        let narrow = map.log_odds()?;
        prop_assume!((wide.width(), wide.height()) == (narrow.width(), narrow.height()));
        // Ranges are off by 2^-24 of 3.25 m; at the edges of the model a cell may change sides.
        let differ = wide.cells().iter().zip(narrow.cells()).filter(|&(&a, &b)| abs_diff_ne!(a, f64::from(b), epsilon = 9.0 / SIGMA * 1e-6)).count();
        prop_assert!(differ <= 1);
    }
}

fn pose_of(x: f64, y: f64, theta: f64) -> Pose {
    Pose::new(x, y, theta).unwrap()
}

/// A circular room, seen from its middle by beams so dense that they cross every cell: the Cartesian grid of the
/// report, each cell sampled at its centre, but for the limit on log-odds.
#[test]
fn a_dense_scan_of_the_circular_room_is_its_cartesian_grid() {
    let (z, sigma, resolution, beams) = (2.0, 0.2, 0.0625, 2000);
    let beams = (0..beams).map(|k| Beam { bearing: f64::from(k) * 0.00315, range: Some(z) }).collect();
    let scan = Scan::new(pose_of(0.0, 0.0, 0.0), 5.0, beams).unwrap();
    let mut map = ScanMap::<f64>::new(resolution).unwrap().with_reading_limit(40.0).unwrap();
    map.insert(&scan, |range| GaussianSensor::new(range, sigma)).unwrap();
    let sensor = GaussianSensor::new(z, sigma).unwrap();
    let mut cells = Vec::new();
    for row in -40..40 {
        for column in -40..40 {
            let [x, y] = [column, row].map(|k| (f64::from(k) + 0.5) * resolution);
            cells.push(sensor.occupancy(mean_information::elementary::sqrt(x * x + y * y)));
        }
    }
    let sampled =
        Grid::<Probability<f64>>::new(80, 80, Geometry::new(resolution, [-2.5; 2]).unwrap(), cells).unwrap();
    let (found, sampled): (Tally<f64>, Tally<f64>) = (map.log_odds().unwrap().tally(), sampled.tally());
    assert_eq!((found.free(), found.occupied()), (sampled.free(), sampled.occupied()));
    // A cell of l = 40 has H = 2.5e-16 bits; those beyond are limited to it. Roundings of p and l move I by less than
    // 1e-15.
    assert_abs_diff_eq!(found.mean_information(), sampled.mean_information(), epsilon = 2e-15);
    // Near the area limit.
    assert_abs_diff_eq!(found.mean_information(), 0.6525, epsilon = 2e-3);
}

/// Free cells that another beam of the scan finds occupied stay occupied; of two alike the surer counts, once.
#[test]
fn within_a_scan_occupied_wins_and_nothing_counts_twice() {
    let beams = [1.0, 3.0].map(|range| Beam { bearing: 0.0, range: Some(range) });
    let model = |range| SteppedSensor::new(range, 0.25, 0.25, 0.875);
    let pose = pose_of(0.125, 0.125, 0.0);
    let scan = |beams: &[Beam<f64>]| Scan::new(pose, 4.0, beams.to_vec()).unwrap();
    let map_of = |beams: &[Beam<f64>]| {
        let mut map = ScanMap::<f64>::new(0.25).unwrap();
        map.insert(&scan(beams), model).unwrap();
        map.probabilities().unwrap().cells().to_vec()
    };
    let (near, far, both) = (map_of(&beams[..1]), map_of(&beams[1..]), map_of(&beams));
    assert_eq!(near, [0.25, 0.25, 0.25, 0.25, 0.875, 0.5]);
    assert_eq!((far[4], far[12], far.len()), (0.25, 0.875, 14));
    assert_eq!(both[..5], near[..5]);
    assert_eq!(both[5..], far[5..]);
}

#[test]
fn readings_are_limited_and_add_up() {
    let beams = vec![Beam { bearing: 0.0, range: Some(1.0) }];
    let scan = Scan::new(pose_of(0.125, 0.125, 0.0), 4.0, beams).unwrap();
    let certain = |range| SteppedSensor::new(range, 0.25, 0.0, 1.0);
    let mut map = ScanMap::<f64>::new(0.25).unwrap().with_reading_limit(2.25).unwrap();
    for _ in 0..3 {
        map.insert(&scan, certain).unwrap();
    }
    assert_eq!(map.log_odds().unwrap().cells(), [-6.75, -6.75, -6.75, -6.75, 6.75, 0.0]);
    assert_eq!(map.scans(), 3);
    for limit in [0.0, -1.0, 40.5, f64::NAN] {
        assert!(ScanMap::<f64>::new(0.25).unwrap().with_reading_limit(limit).is_err(), "{limit}");
    }
}

/// A model that does not say where its plateau ends.
struct WithoutPlateau<M>(M);

impl<M: InverseSensorModel> InverseSensorModel for WithoutPlateau<M> {
    type Float = M::Float;

    fn occupancy(&self, rho: M::Float) -> M::Float {
        self.0.occupancy(rho)
    }

    fn reach(&self) -> M::Float {
        self.0.reach()
    }
}

/// A model that counts how often it is asked.
struct CountsCalls<'a>(SteppedSensor<f64>, &'a Cell<usize>);

impl InverseSensorModel for CountsCalls<'_> {
    type Float = f64;

    fn occupancy(&self, rho: f64) -> f64 {
        self.1.set(self.1.get() + 1);
        self.0.occupancy(rho)
    }

    fn reach(&self) -> f64 {
        self.0.reach()
    }

    fn plateau(&self) -> f64 {
        self.0.plateau()
    }
}

/// Of a beam of 400 cells the model is asked about the wall and what is next to it.
#[test]
fn cells_of_the_plateau_are_not_asked_about() {
    let asked = Cell::new(0);
    let scan =
        Scan::new(pose_of(0.001, 0.002, 0.7), 9.0, vec![Beam { bearing: 0.1, range: Some(4.0) }]).unwrap();
    let mut map = ScanMap::new(0.01).unwrap();
    map.insert(&scan, |range| Ok(CountsCalls(SteppedSensor::new(range, 0.03, 0.25, 0.875)?, &asked)))
        .unwrap();
    assert!(map.tally().observed() > 400 && asked.get() < 20, "{}", asked.get());
}
