//! Rooms that are refused: models that break their promise, and more samples than the limit.

use approx::relative_eq;
use mean_information::room::{CartesianRoom, PolarRoom, Sampling};
use mean_information::sensor::{GaussianSensor, InverseSensorModel};
use mean_information::{Error, Real};

/// A model that breaks its promise.
struct Broken<T>(T, T);

impl<T: Real> InverseSensorModel for Broken<T> {
    type Float = T;

    fn occupancy(&self, _: T) -> T {
        self.0
    }

    fn reach(&self) -> T {
        self.1
    }
}

#[test]
fn what_cannot_be_built_is_refused_with_its_reason() {
    let sensor = GaussianSensor::new(2.0_f64, 0.2).unwrap();
    for h in [0.0, -0.5, f64::NAN, f64::INFINITY] {
        assert!(matches!(PolarRoom::new(sensor, h), Err(Error::OutOfRange { what: "resolution", .. })));
        let room = CartesianRoom::new(sensor, h, [0.25; 2]);
        assert!(matches!(room, Err(Error::OutOfRange { what: "resolution", .. })));
    }
    for offsets in [[f64::NAN, 0.25], [0.25, f64::INFINITY]] {
        let room = CartesianRoom::new(sensor, 0.5, offsets);
        assert!(matches!(room, Err(Error::OutOfRange { what: "offset", .. })));
    }
    let room = CartesianRoom::new(sensor, 1e-9, [0.25; 2]).unwrap();
    assert_eq!(
        room.tally().unwrap_err().to_string(),
        "the Cartesian grid of a room has 1.999e19 samples, allowed are 17179869184"
    );
    let room = PolarRoom::new(sensor, 1e-300).unwrap();
    let refused = room.tally().unwrap_err().to_string();
    assert_eq!(refused, "the polar map of a room has 2.235e300 samples, allowed are 17179869184");
    let room = CartesianRoom::new(sensor, 0.5, [0.25; 2]).unwrap().with_limit(80);
    assert!(matches!(room.tally(), Err(Error::TooManySamples { count: 81.0, limit: 80, .. })));
    assert!(matches!(room.clone().with_limit(81).map(80), Err(Error::TooManyCells { .. })));
    assert_eq!(room.with_limit(81).map(81).unwrap().cells().len(), 81);
    for n in [0, 3, 2048] {
        let sampled = PolarRoom::new(sensor, 0.5).unwrap().with_sampling(Sampling::Averaged(n));
        assert!(matches!(sampled, Err(Error::OutOfRange { what: "samples per side", .. })));
    }
    let averaged =
        CartesianRoom::new(sensor, 0.5, [0.25; 2]).unwrap().with_sampling(Sampling::Averaged(1024));
    assert!(averaged.unwrap().with_limit(1 << 26).tally().is_err(), "samples count");
    for reach in [f64::NAN, f64::INFINITY, 0.0, -2.5] {
        assert!(PolarRoom::new(Broken(0.5, reach), 0.5).is_err());
    }
    for p in [f32::NAN, 1.5, -0.5] {
        assert!(PolarRoom::new(Broken(p, 3.0), 0.5).unwrap().tally().is_err());
        let room = CartesianRoom::new(Broken(p, 3.0), 0.5, [0.0; 2]).unwrap();
        assert!(room.tally().is_err() && room.map(1000).is_err());
    }
    let room = CartesianRoom::new(sensor, 0.5, [0.25; 2]).unwrap();
    assert!(room.tally_part(3, 3).is_err() && room.tally_part(0, 0).is_err());
    assert!(room.distance(1 << 44, 0).is_err());
}

/// As many samples as there are, and not one less: of rooms of one cell and of more, in cells of any number of samples.
#[test]
fn limits_count_samples() {
    let sensor = GaussianSensor::new(2.0_f64, 0.25).unwrap();
    for (h, n) in [(4.75, 1), (4.75, 16), (4.75, 1024), (0.5, 1), (0.5, 4), (0.21, 32)] {
        let cartesian = CartesianRoom::new(sensor, h, [0.0; 2]).unwrap();
        let cartesian = cartesian.with_sampling(Sampling::Averaged(n)).unwrap().with_limit(u64::MAX);
        let samples = cartesian.width().unwrap() * cartesian.height().unwrap() * u64::from(n * n);
        assert!(cartesian.clone().with_limit(samples).width().is_ok(), "{h} {n}");
        let refused = cartesian.with_limit(samples - 1).width();
        assert!(matches!(refused, Err(Error::TooManySamples { .. })), "{h} {n}");
        let polar = PolarRoom::new(sensor, h / 2.0).unwrap().with_sampling(Sampling::Averaged(n)).unwrap();
        let rings = polar.clone().with_limit(u64::MAX).rings().unwrap();
        let samples = rings * u64::from(n);
        assert_eq!(polar.clone().with_limit(samples).rings(), Ok(rings), "{h} {n}");
        let refused = polar.clone().with_limit(samples - 1).rings();
        assert!(matches!(refused, Err(Error::TooManySamples { .. })), "{h} {n}");
        let cells = 3 * rings as usize;
        assert!(polar.map(3, cells).is_ok() && polar.map(3, cells - 1).is_err(), "{h} {n}");
    }
    // Beyond the indices that can be counted, whatever the limit.
    for h in [1e-16, 1e-19, 1e-300] {
        let room = CartesianRoom::new(sensor, h, [0.0; 2]).unwrap().with_limit(u64::MAX);
        let Err(Error::TooManySamples { count, .. }) = room.width() else { panic!("{:?}", room.width()) };
        let across = 2.0 * sensor.reach() / h;
        assert!(
            count == across * across
                || relative_eq!(count / across, across, epsilon = 0.0, max_relative = 1e-9),
            "{h}: {count}"
        );
    }
}
