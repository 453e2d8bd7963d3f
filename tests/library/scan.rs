//! Scans inserted into maps: against cells found one by one, relations that change no bit, and what is refused.

use super::common::power;
use mean_information::build::{Beam, Direction, Pose, Scan, ScanMap};
use mean_information::cell::log_odds_from_occupancy;
use mean_information::map::encoding::LogOdds;
use mean_information::map::{Geometry, Grid, encoding::Probability};
use mean_information::sensor::{GaussianSensor, InverseSensorModel, SteppedSensor};
use mean_information::{Error, Tally};
use proptest::collection::vec;
use proptest::prelude::*;

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
                prop_assert!(doubtful || (found - sum).abs() <= poses.len() as f64 * 9.0 / SIGMA * 4e-9, "{found} {sum}");
            }
        }
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
            (direction.cos() - core_math::cos(angle)).abs() <= tolerance && (direction.sin() - core_math::sin(angle)).abs() <= tolerance
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
        let differ = wide.cells().iter().zip(narrow.cells()).filter(|&(&a, &b)| (a - f64::from(b)).abs() > 9.0 / SIGMA * 1e-6).count();
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
    assert!((found.mean_information() - sampled.mean_information()).abs() <= 2e-15);
    assert!((found.mean_information() - 0.6525).abs() < 2e-3, "near the area limit");
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

#[test]
fn what_is_no_scan_is_refused_with_its_place() {
    let beam = |bearing, range| Beam { bearing, range: Some(range) };
    let refused =
        |beams: Vec<Beam<f64>>| Scan::new(pose_of(0.5, 0.5, 0.5), 4.0, beams).unwrap_err().to_string();
    assert_eq!(refused(vec![]), "number of beams is 0, allowed is 1 or more");
    let allowed = "allowed is above 0, up to the maximum range";
    for (range, shown) in
        [(-1.5, "-1.5"), (4.5, "4.5"), (f64::NAN, "NaN"), (f64::INFINITY, "inf"), (0.0, "0")]
    {
        let text = refused(vec![beam(0.25, 2.0), beam(0.5, range)]);
        assert_eq!(text, format!("range of beam 1 is {shown}, {allowed}"));
    }
    assert_eq!(
        refused(vec![beam(f64::INFINITY, 2.0)]),
        "bearing of beam 0 is inf, allowed is finite, in radians"
    );
    for maximum in [0.0, -2.0, f64::NAN, f64::INFINITY] {
        assert!(Scan::new(pose_of(0.5, 0.5, 0.5), maximum, vec![beam(0.25, 2.0)]).is_err());
    }
    for bad in [f64::NAN, f64::INFINITY] {
        assert!(Pose::new(bad, 0.5, 0.5).is_err() && Pose::new(0.5, bad, 0.5).is_err());
        assert!(Pose::new(0.5, 0.5, bad).unwrap_err().to_string().starts_with("theta of the pose"));
        assert!(Direction::new(&[0.5, bad]).is_err());
    }
    for resolution in [0.0, -0.25, f64::NAN, f64::INFINITY] {
        assert!(ScanMap::<f64>::new(resolution).is_err());
    }
}

/// A model that is no model beyond half a metre.
struct Broken;

impl InverseSensorModel for Broken {
    type Float = f64;

    fn occupancy(&self, rho: f64) -> f64 {
        if rho < 0.5 { 0.25 } else { 1.5 }
    }

    fn reach(&self) -> f64 {
        2.0
    }
}

/// One that reaches as far as it says.
struct Reaching(f64);

impl InverseSensorModel for Reaching {
    type Float = f64;

    fn occupancy(&self, _: f64) -> f64 {
        0.25
    }

    fn reach(&self) -> f64 {
        self.0
    }
}

#[test]
fn a_reach_is_a_length() {
    let pose = pose_of(0.125, -0.25, 0.5);
    assert_eq!((pose.position(), pose.theta()), ([0.125, -0.25], 0.5));
    let scan = Scan::new(pose, 9.0, vec![Beam { bearing: 0.25, range: Some(3.0) }]).unwrap();
    for reach in [-1.5, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let refused = ScanMap::new(0.25).unwrap().insert(&scan, |_| Ok(Reaching(reach))).unwrap_err();
        assert!(matches!(refused, Error::Item { what: "reach of beam", index: 0, .. }), "{refused}");
    }
    ScanMap::new(0.25).unwrap().insert(&scan, |_| Ok(Reaching(0.0))).unwrap();
}

#[test]
fn a_refused_scan_changes_nothing() {
    let scan = |x: f64, range: f64| {
        Scan::new(pose_of(x, 0.1, 0.3), 1e9, vec![Beam { bearing: 0.2, range: Some(range) }]).unwrap()
    };
    let mut map = ScanMap::<f64>::new(0.25).unwrap().with_max_cells(500);
    map.insert(&scan(0.0, 2.0), gaussian).unwrap();
    let before = grid(&map);
    assert_eq!((before.width(), before.height()), (8, 5));

    let too_large = map.insert(&scan(0.0, 40.0), gaussian).unwrap_err();
    assert_eq!(too_large, Error::TooManyCells { what: "the map", count: 141.0 * 78.0, limit: 500 });
    assert_eq!(too_large.to_string(), "the map has 1.100e4 cells, allowed are 500");
    assert!(matches!(map.insert(&scan(1000.0, 2.0), gaussian), Err(Error::TooManyCells { limit: 500, .. })));
    assert!(matches!(map.insert(&scan(0.0, 1e8), gaussian), Err(Error::TooManyCells { .. })));
    let far = map.insert(&scan(1e200, 2.0), gaussian).unwrap_err();
    assert_eq!(
        far.to_string(),
        format!("x of the pose is {}, allowed is within 2^33 cells of the origin", 1e200)
    );
    let long = map.insert(&scan(0.0, 2.0), |_| GaussianSensor::new(f64::MAX, 0.5)).unwrap_err();
    assert!(long.to_string().starts_with("reach of beam 0 is"), "{long}");
    let no_model = map.insert(&scan(0.0, 2.0), |range| GaussianSensor::new(range, -0.5)).unwrap_err();
    assert!(no_model.to_string().starts_with("sigma is -0.5"));
    let broken = map.insert(&scan(0.0, 2.0), |_| Ok(Broken)).unwrap_err();
    assert_eq!(broken.to_string(), "occupancy by the model of beam 0 is 1.5, allowed is 0 to 1");

    assert_eq!((grid(&map), map.scans()), (before, 1));
}

/// Grown in every direction, within the limit to the last cell; the map is as large as what the beams crossed.
#[test]
fn a_map_grows_to_its_limit() {
    let along = |x: f64, y: f64, theta: f64| {
        Scan::new(pose_of(x, y, theta), 4.0, vec![Beam { bearing: 0.0, range: Some(1.1) }]).unwrap()
    };
    let scans = [along(0.1, 0.1, 0.0), along(-3.1, 0.1, 0.0), along(0.1, 3.1, 0.0), along(0.1, -2.9, 0.0)];
    let model = |range| SteppedSensor::new(range, 0.125, 0.25, 0.875);
    // Columns -13 to 5, rows -12 to 12.
    for (limit, fits) in [(19 * 25, true), (19 * 25 - 1, false)] {
        let mut map = ScanMap::<f64>::new(0.25).unwrap().with_max_cells(limit);
        let done: Vec<bool> = scans.iter().map(|scan| map.insert(scan, model).is_ok()).collect();
        assert_eq!(done, [true, true, true, fits]);
    }
    let mut map = ScanMap::<f64>::new(0.25).unwrap();
    assert!(map.log_odds().unwrap().cells().is_empty());
    for scan in &scans {
        map.insert(scan, model).unwrap();
    }
    let grid = map.log_odds().unwrap();
    assert_eq!((grid.width(), grid.height(), grid.geometry().origin()), (19, 25, [-3.25, -3.0]));
    assert_eq!(grid.tally().observed(), 20);
}
