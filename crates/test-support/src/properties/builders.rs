//! Scans inserted into maps, and expected maps.

use mean_information::expected::{Hypotheses, weighted_mean};
use mean_information::map::encoding::Probability;
use mean_information::map::{Geometry, Grid};
use mean_information::scan::{Beam, Pose, Scan, ScanMap};
use mean_information::sensor::{GaussianSensor, SteppedSensor};
use mean_information::{Error, Real};

/// Numbers from bytes: any bits, or multiples of 1/64 up to 512, which meet on lines and corners.
struct Numbers<'a> {
    bytes: &'a [u8],
    any_bits: bool,
}

impl Numbers<'_> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (first, rest) = self.bytes.split_first_chunk()?;
        self.bytes = rest;
        Some(*first)
    }

    fn next(&mut self) -> Option<f64> {
        if self.any_bits {
            self.take().map(f64::from_le_bytes)
        } else {
            self.take().map(|bytes| f64::from(i16::from_le_bytes(bytes)) / 64.0)
        }
    }
}

/// Inserts scans: they are inserted or refused. A refused one changes nothing; if none is, no order of scans or beams changes a
/// bit. The bytes are how numbers are written, which sensor, how many beams a scan has, the resolution, the sensor's
/// width, and the scans.
pub fn scan(bytes: &[u8]) {
    let [how, beams, bytes @ ..] = bytes else {
        return;
    };
    let mut numbers = Numbers { bytes, any_bits: how & 1 == 1 };
    let (Some(resolution), Some(width)) = (numbers.next(), numbers.next()) else {
        return;
    };
    let Ok(map) = ScanMap::<f64>::new(resolution) else {
        assert!(!(resolution > 0.0 && resolution.is_finite()));
        return;
    };
    let map = map.with_max_cells(1 << 14);
    let scans: Vec<Scan<f64>> = std::iter::from_fn(|| one_scan(&mut numbers, beams % 16))
        .take(6)
        .filter_map(|scan| scan.inspect_err(said).ok())
        .collect();
    if how & 2 == 0 {
        check_insertion(&map, &scans, |range| GaussianSensor::new(range, width));
    } else {
        check_insertion(&map, &scans, |range| SteppedSensor::new(range, width, 0.25, 0.875));
    }
}

/// The next scan; nothing where the bytes end.
fn one_scan(numbers: &mut Numbers, beams: u8) -> Option<Result<Scan<f64>, Error>> {
    let [x, y, theta, maximum] = [numbers.next()?, numbers.next()?, numbers.next()?, numbers.next()?];
    let beam = |_| {
        let [bearing, range] = [numbers.next()?, numbers.next()?];
        Some(Beam { bearing, range: (range != 0.0).then_some(range) })
    };
    let beams: Vec<Beam<f64>> = (0..beams).map_while(beam).collect();
    Some(Pose::new(x, y, theta).and_then(|pose| Scan::new(pose, maximum, beams)))
}

/// An error says something.
fn said(error: &Error) {
    assert!(!error.to_string().is_empty());
}

fn check_insertion<M, F>(empty: &ScanMap<f64>, scans: &[Scan<f64>], model: F)
where
    M: mean_information::sensor::InverseSensorModel<Float = f64>,
    F: Fn(f64) -> Result<M, Error> + Copy,
{
    let mut map = empty.clone();
    let mut done = 0;
    for scan in scans {
        let before = map.log_odds();
        match map.insert(scan, model) {
            Ok(()) => done += 1,
            Err(error) => {
                said(&error);
                assert_eq!(map.log_odds(), before);
            }
        }
    }
    assert_eq!(map.scans(), done);
    let Ok(grid) = map.log_odds() else { return };
    assert_eq!(map.tally(), grid.tally());
    assert!(grid.cells().len() <= 1 << 14);
    assert!(grid.cells().iter().all(|l| l.abs() <= 3.5 * done as f64));
    if done == scans.len() as u64 {
        let mut backwards = empty.clone();
        for scan in scans.iter().rev() {
            let beams = scan.beams().iter().rev().copied().collect();
            let scan = Scan::new(*scan.pose(), scan.maximum_range(), beams).expect("the same beams");
            backwards.insert(&scan, model).expect("it fitted before");
        }
        assert_eq!(backwards.log_odds().expect("as before"), grid);
    }
}

/// Takes expected maps of any maps and weights: refused, or the same in another order, unknown where all are, and no more
/// informed than the maps. The bytes are the columns, how numbers are written, and per map a weight, its offset in
/// columns, and its cells.
pub fn expected(bytes: &[u8]) {
    let [width, how, bytes @ ..] = bytes else {
        return;
    };
    let width = usize::from(width % 8) + 1;
    let mut numbers = Numbers { bytes, any_bits: how & 1 == 1 };
    let (mut maps, mut weights) = (Vec::new(), Vec::new());
    while let Some((weight, map)) = one_map(&mut numbers, width) {
        weights.push(weight);
        maps.extend(map);
    }
    let hypotheses = match Hypotheses::new(&maps, &weights) {
        Ok(hypotheses) => hypotheses.with_max_cells(1 << 10),
        Err(error) => return said(&error),
    };
    let expected = match hypotheses.expected_map() {
        Ok(expected) => expected,
        Err(error) => return said(&error),
    };
    let (grid, tally) = (expected.grid(), expected.tally());
    assert_eq!(tally.cells(), grid.cells().len() as u64);
    assert!(hypotheses.expected_tally().is_ok_and(|alone| alone == *tally));
    let mean = tally.mean_information();
    assert!((0.0..=1.0).contains(&mean), "{mean}");

    let backwards: Vec<_> = maps.iter().rev().cloned().collect();
    let turned: Vec<f64> = weights.iter().rev().copied().collect();
    let again = Hypotheses::new(&backwards, &turned).and_then(|hypotheses| hypotheses.expected_map());
    // An origin within the tolerance of another may stand for it.
    assert!(again.is_ok_and(|again| again.grid().cells() == grid.cells() && again.tally() == tally));

    // Jensen; each cell of the maps is rounded by at most 2^-54, and the sums once.
    let own: Vec<f64> = maps.iter().map(|map| map.tally().information()).collect();
    let bound = weighted_mean(&weights, &own).expect("good weights");
    let slack = (tally.cells() + 2) as f64 * f64::from_parts(1, -52);
    assert!(
        tally.information() <= bound * (1.0 + f64::EPSILON) + slack,
        "{} above {bound}",
        tally.information()
    );
    if let Ok(pool) = hypotheses.log_linear_pool() {
        assert_eq!(pool.cells().len(), grid.cells().len());
    }
}

/// The next weight, and the next map if its numbers can be meant: a row of cells.
fn one_map(numbers: &mut Numbers, width: usize) -> Option<(f64, Option<Grid<Probability<f64>>>)> {
    let weight = numbers.next()?;
    let [offset] = numbers.take()?;
    let cells: Vec<f64> = (0..width)
        .map_while(|_| numbers.next())
        .map(|x| if x.is_finite() { x.abs().fract() } else { 0.5 })
        .collect();
    let geometry = Geometry::new(0.25, [f64::from(offset as i8) * 0.25, 0.0]).expect("a good geometry");
    Some((weight, Grid::new(cells.len(), 1, geometry, cells).ok()))
}
