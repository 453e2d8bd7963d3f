//! Scans and models that are refused, and that nothing has changed then.

use super::{gaussian, grid, pose_of};
use mean_information::Error;
use mean_information::scan::{Beam, Direction, Pose, Scan, ScanMap};
use mean_information::sensor::{GaussianSensor, InverseSensorModel, SteppedSensor};

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
    let cells = 141.0 * 78.0;
    assert!(
        matches!(too_large, Error::TooManyCells { count, limit: 500, .. } if count == cells),
        "{too_large}"
    );
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

/// No limit, and 2^63 cells: none of that is said of the limit.
#[test]
fn memory_that_cannot_be_had_is_no_limit() {
    let beam = Beam { bearing: 0.6435, range: Some(4e9) };
    let scan = Scan::new(pose_of(0.0, 0.0, 0.0), 5e9, vec![beam]).unwrap();
    let mut map = ScanMap::<f64>::new(1.0).unwrap().with_max_cells(u64::MAX);
    let refused = map.insert(&scan, |range| SteppedSensor::new(range, 0.5, 0.25, 0.875)).unwrap_err();
    assert!(
        matches!(refused, Error::NoMemory { cells, .. } if (7.6e18..7.7e18).contains(&cells)),
        "{refused}"
    );
    assert_eq!(refused.to_string(), "there is no memory for 7.680e18 cells");
    assert_eq!(map.scans(), 0);
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
