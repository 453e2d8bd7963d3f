//! Agreement and contradictions: against sums over single readings, and relations that change no bit.

use super::{MAXIMUM, SIGMA, beam, gaussian, pose, scan};
use approx::abs_diff_eq;
use mean_information::scan::{Beam, Layer, Pose, Scan, ScanMap};
use mean_information::sensor::GaussianSensor;
use proptest::collection::vec;
use proptest::prelude::*;

fn built(resolution: f64, scans: &[Scan<f64>]) -> ScanMap<f64> {
    let mut map = ScanMap::new(resolution).unwrap().with_agreement().unwrap();
    for scan in scans {
        map.insert(scan, gaussian).unwrap();
    }
    map
}

fn layer(map: &ScanMap<f64>) -> Layer<f64> {
    map.contradictions().unwrap().unwrap()
}

/// The log-odds of every cell of `whole` that one scan tells.
fn alone(resolution: f64, scan: &Scan<f64>, whole: &Layer<f64>) -> Vec<f64> {
    let grid = built(resolution, std::slice::from_ref(scan)).log_odds().unwrap();
    let offset = [0, 1].map(|k| {
        let metres = grid.geometry().origin()[k] - whole.geometry().origin()[k];
        (metres / resolution).round() as usize
    });
    let mut cells = vec![0.0; whole.cells().len()];
    for row in 0..grid.height() {
        let start = (row + offset[1]) * whole.width() + offset[0];
        cells[start..start + grid.width()].copy_from_slice(grid.row(row).unwrap());
    }
    cells
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    /// Theorem (agreement), and the definition: sums of floats, each reading within 2^-53 of itself and 2^-76, sums of at most
    /// 40 000 terms.
    #[test]
    fn it_is_the_quotient_of_the_sums(poses in vec(pose(), 1..5), beams in vec(beam(), 1..9), resolution in 0.1_f64..0.6) {
        let scans: Vec<_> = poses.iter().map(|&pose| scan(pose, &beams)).collect();
        let map = built(resolution, &scans);
        let layer = layer(&map);
        let readings: Vec<_> = scans.iter().map(|scan| alone(resolution, scan, &layer)).collect();
        let (mut held, mut told) = (0.0, 0.0);
        for (k, &contradiction) in layer.cells().iter().enumerate() {
            let of_cell = || readings.iter().map(|cells| cells[k]);
            let (sum, magnitudes) = (of_cell().sum::<f64>(), of_cell().map(f64::abs).sum::<f64>());
            held += sum.abs();
            told += magnitudes;
            // 4 readings of up to 3.5 nats, each sum rounded thrice.
            prop_assert!(abs_diff_eq!(contradiction, magnitudes - sum.abs(), epsilon = 14.0 * 4.0 * f64::EPSILON));
            let [free, occupied] = [of_cell().any(|l| l < 0.0), of_cell().any(|l| l > 0.0)];
            prop_assert_eq!(contradiction > 0.0, free && occupied);
        }
        let agreement = map.agreement().unwrap();
        let expected = if told == 0.0 { 1.0 } else { held / told };
        prop_assert!(abs_diff_eq!(agreement, expected, epsilon = 40_004.0 * f64::EPSILON), "{} {}", agreement, expected);
        prop_assert!((0.0..=1.0).contains(&agreement));
        if layer.cells().iter().all(|&contradiction| contradiction == 0.0) {
            prop_assert_eq!(agreement, 1.0);
        }
        if layer.cells().iter().any(|&contradiction| contradiction > 1e-9) {
            prop_assert!(agreement < 1.0);
        }
    }

    /// Mirrored at the x axis; moved by whole cells and scaled by a power of two; each scan three times; in another order.
    #[test]
    fn relations_that_change_no_bit(poses in vec(pose(), 2..5), beams in vec(beam(), 1..9), columns in -99_i32..99) {
        let scans: Vec<_> = poses.iter().map(|&pose| scan(pose, &beams)).collect();
        let straight = built(0.1875, &scans);
        let agreement = straight.agreement();
        let mirrored_beams: Vec<_> = beams.iter().map(|beam| Beam { bearing: -beam.bearing, ..*beam }).collect();
        let mirrored: Vec<_> = poses.iter().map(|&[x, y, theta]| scan([x, -y, -theta], &mirrored_beams)).collect();
        let mirrored = built(0.1875, &mirrored);
        prop_assert_eq!(mirrored.agreement(), agreement);
        let (a, b) = (layer(&straight), layer(&mirrored));
        prop_assert_eq!((a.width(), a.height()), (b.width(), b.height()));
        for (row, other) in a.cells().chunks(a.width()).zip(b.cells().chunks(b.width()).rev()) {
            prop_assert_eq!(row, other);
        }
        let thrice: Vec<_> = scans.iter().rev().cycle().take(3 * scans.len()).cloned().collect();
        prop_assert_eq!(built(0.1875, &thrice).agreement(), agreement);

        // Multiples of 2^-20, so that sums are exact.
        let whole = |x: f64| (x * 1_048_576.0).round() / 1_048_576.0;
        let place = |scale: f64, columns: f64| -> Vec<Scan<f64>> {
            let beams: Vec<_> = beams.iter().map(|beam| Beam { range: beam.range.map(|r| r * scale), ..*beam }).collect();
            let scan = |&[x, y, theta]: &[f64; 3]| {
                let pose = Pose::new((whole(x) + columns * 0.1875) * scale, whole(y) * scale, theta).unwrap();
                Scan::new(pose, MAXIMUM * scale, beams.clone()).unwrap()
            };
            poses.iter().map(scan).collect()
        };
        let first = built(0.1875, &place(1.0, 0.0));
        let mut moved = ScanMap::new(0.1875 * 8.0)?.with_agreement()?;
        for scan in place(8.0, f64::from(columns)) {
            moved.insert(&scan, |range| GaussianSensor::new(range, SIGMA * 8.0))?;
        }
        prop_assert_eq!(first.agreement(), moved.agreement());
        let (first, moved) = (layer(&first), layer(&moved));
        prop_assert_eq!(first.cells(), moved.cells());
    }

    /// Opposite readings in every cell: nothing is held.
    #[test]
    fn what_cancels_does_not_agree(pose in pose(), bearing in -3.0_f64..3.0, limit in 0.25_f64..4.0) {
        let scan = scan(pose, &[Beam { bearing, range: Some(2.5) }]);
        let mut map = ScanMap::<f64>::new(0.3)?.with_reading_limit(limit)?.with_agreement()?;
        map.insert(&scan, |_| Ok(Level(0.0)))?;
        prop_assert_eq!(map.agreement(), Some(1.0));
        map.insert(&scan, |_| Ok(Level(1.0)))?;
        prop_assert_eq!(map.agreement(), Some(0.0));
        // Twice the limit in each cell that was crossed, and nothing is observed any more.
        let layer = layer(&map);
        prop_assert!(layer.cells().iter().all(|&told| told == 0.0 || told == 2.0 * limit));
        prop_assert!(layer.cells().contains(&(2.0 * limit)));
        prop_assert_eq!(map.tally().observed(), 0);
        map.remove(&scan, |_| Ok(Level(0.0)))?;
        prop_assert_eq!(map.agreement(), Some(1.0));
        prop_assert!(map.tally().free() == 0 && map.tally().occupied() > 0);
    }
}

/// The same occupancy everywhere, to 2.5 m.
struct Level(f64);

impl mean_information::sensor::InverseSensorModel for Level {
    type Float = f64;

    fn occupancy(&self, _: f64) -> f64 {
        self.0
    }

    fn reach(&self) -> f64 {
        2.5
    }
}

#[test]
fn of_no_readings_all_agree() {
    let empty = ScanMap::<f32>::new(0.25).unwrap().with_agreement().unwrap();
    assert_eq!(empty.agreement(), Some(1.0));
    assert!(empty.contradictions().unwrap().unwrap().cells().is_empty());
}
