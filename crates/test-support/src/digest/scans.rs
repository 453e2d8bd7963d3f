//! Maps of twenty scans of a scanner of 181 beams: two levels and Eq. 5, in both formats.

use super::{Digest, next};
use mean_information::scan::{Beam, Pose, Scan, ScanMap};
use mean_information::sensor::{GaussianSensor, InverseSensorModel, SteppedSensor};
use mean_information::{Error, Real};

/// A number of `bits` bits over a power of two, less a half of all: no rounding.
fn part(random: u64, bits: u32, exponent: i32) -> f64 {
    let integer = random & ((1 << bits) - 1);
    f64::from_parts(integer, -exponent) - f64::from_parts(1 << (bits - 1), -exponent)
}

/// The scans: poses within four metres, beams of a degree or so either way round, between 1 and 5 m or without return.
fn scans<T: Real>() -> Vec<Scan<T>> {
    let mut state = 0x9e37_79b9_7f4a_7c15;
    let scan = |k: u32| {
        let bits = next(&mut state);
        let pose =
            Pose::new(part(bits, 12, 9), part(bits >> 12, 12, 9), part(bits >> 24, 16, 13)).expect("finite");
        let from = part(bits >> 40, 8, 5);
        let step = if k.is_multiple_of(2) { 71.0 / 4096.0 } else { -71.0 / 4096.0 };
        let mut wall = 3.0;
        let mut beam = |k: u32| {
            let bits = next(&mut state);
            // A wall that comes and goes, now and then with a jump.
            wall = if bits.is_multiple_of(29) {
                3.0 + part(bits >> 8, 11, 10)
            } else {
                wall + part(bits >> 8, 11, 16)
            };
            let range = T::nearest(wall + part(bits >> 32, 11, 16));
            Beam { bearing: from + f64::from(k) * step, range: (bits % 31 != 1).then_some(range) }
        };
        let beams = (0..181).map(&mut beam).collect();
        Scan::new(pose, T::nearest(6.0), beams).expect("ranges of 1 to 5 m")
    };
    (0..20).map(scan).collect()
}

/// Inserts the scans into a map of cells of 2.5 cm, and takes some out again.
fn update<T: Real, M: InverseSensorModel<Float = T>>(
    digest: &mut Digest,
    scans: &[Scan<T>],
    model: impl Fn(T) -> Result<M, Error>,
) {
    let mut map = ScanMap::<T>::new(0.025).expect("positive");
    for scan in scans {
        map.insert(scan, &model).expect("a scan");
    }
    for scan in &scans[..3] {
        map.remove(scan, &model).expect("a scan of the map");
    }
    let grid = map.log_odds().expect("a map");
    for x in [grid.width() as f64, grid.height() as f64].into_iter().chain(grid.geometry().origin()) {
        digest.update(x);
    }
    grid.cells().iter().for_each(|&cell| digest.update(cell));
}

/// The digest of the log-odds of all cells.
pub(super) fn digest() -> u64 {
    let mut digest = Digest::new();
    let (double, single) = (scans::<f64>(), scans::<f32>());
    update(&mut digest, &double, |range| SteppedSensor::new(range, 0.125, 0.25, 0.875));
    update(&mut digest, &double, |range| GaussianSensor::new(range, 0.0625));
    update(&mut digest, &single, |range| SteppedSensor::new(range, 0.125, 0.25, 0.875));
    update(&mut digest, &single, |range| GaussianSensor::new(range, 0.0625));
    digest.0
}
