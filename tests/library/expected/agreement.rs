//! Cells of which all maps store the same, and those of which not all do.

use super::{Map, expected};
use crate::common::Random;
use mean_information::Tally;
use mean_information::cell::Cell;
use mean_information::expected::Hypotheses;
use mean_information::map::encoding::Probability;
use mean_information::map::{Encoding, Geometry, Grid};

/// Longer rows than what is compared at once, of maps that begin anywhere: the sums, the map and each cell alone agree.
#[test]
fn runs_of_agreement_are_counted_as_their_cells() {
    let mut random = Random::new(0x9e37_79b9_7f4a_7c15);
    for round in 0..40 {
        let width = [3, 1030, 2500][round % 3];
        let height = if round % 3 == 0 { 700 } else { 2 };
        let few = [0.5, 0.0, -0.0, 0.25, 0.75];
        let mut common: Vec<f64> = Vec::new();
        while common.len() < width * height {
            let (value, length) =
                (few[(5.0 * random.uniform()) as usize], (100.0 * random.uniform()) as usize);
            common.resize((common.len() + length).min(width * height), value);
        }
        let maps: Vec<Map> = (0..=round % 4)
            .map(|map| {
                let mut cells = common.clone();
                for _ in 0..(20 * map) {
                    let at = (random.uniform() * cells.len() as f64) as usize;
                    cells[at] = few[(5.0 * random.uniform()) as usize];
                }
                // Some begin a little later: nothing agrees but by chance.
                let shift = if round % 5 == 0 { map as f64 } else { 0.0 };
                let place = [0.05 * shift, 0.05 * (map * (round % 2)) as f64];
                Grid::new(width, height, Geometry::new(0.05, place).unwrap(), cells).unwrap()
            })
            .collect();
        let weights = &[0.3, 0.0, 0.7, 0.1][..maps.len()];
        let whole = expected(&maps, weights);
        assert_eq!(&Hypotheses::new(&maps, weights).unwrap().expected_tally().unwrap(), whole.tally());
        let pool = Hypotheses::new(&maps, weights).unwrap().log_linear_pool();
        // The other way, each cell for itself.
        let (origin, mut tally) = (whole.grid().geometry().origin(), Tally::new());
        let one =
            |p| Grid::<Probability<f64>>::new(1, 1, Geometry::new(0.05, [0.0; 2]).unwrap(), vec![p]).unwrap();
        for row in 0..whole.grid().height() {
            for column in 0..whole.grid().width() {
                let cells: Vec<Map> = maps
                    .iter()
                    .map(|map| {
                        let [left, lower] = [0, 1]
                            .map(|k| ((map.geometry().origin()[k] - origin[k]) / 0.05).round() as usize);
                        let place = row.checked_sub(lower).zip(column.checked_sub(left));
                        one(place.and_then(|(row, column)| map.occupancy(row, column)).unwrap_or(0.5))
                    })
                    .collect();
                let alone = expected(&cells, weights);
                assert_eq!(
                    alone.grid().cells()[0].to_bits(),
                    whole.grid().occupancy(row, column).unwrap().to_bits()
                );
                tally.merge(alone.tally());
                if let Ok(pool) = &pool {
                    let alone = Hypotheses::new(&cells, weights).unwrap().log_linear_pool().unwrap();
                    assert_eq!(alone.cells()[0].to_bits(), pool.row(row).unwrap()[column].to_bits());
                }
            }
        }
        assert_eq!(&tally, whole.tally());
    }
}

/// What is stored need not equal itself: a sensor's own "not measured", for one.
#[derive(Clone, Copy, Debug)]
struct Unmeasured;

impl Encoding for Unmeasured {
    type Stored = f64;
    type Float = f64;
    const ALLOWED: &'static str = "a probability, or NaN for unknown";

    fn unknown() -> f64 {
        f64::NAN
    }

    fn value(p: f64) -> f64 {
        p
    }

    fn cell(p: f64) -> Option<Cell<f64>> {
        Self::occupancy(p).and_then(|p| Cell::from_occupancy(p).ok())
    }

    fn occupancy(p: f64) -> Option<f64> {
        if p.is_nan() { Some(0.5) } else { (0.0..=1.0).contains(&p).then_some(p) }
    }
}

#[test]
fn cells_that_do_not_equal_themselves() {
    let geometry = Geometry::new(0.5, [0.0; 2]).unwrap();
    let one = |cells: [f64; 4]| Grid::<Unmeasured>::new(4, 1, geometry, cells.to_vec()).unwrap();
    let maps = [one([f64::NAN, f64::NAN, 0.25, 0.25]), one([f64::NAN, 0.75, 0.25, f64::NAN])];
    for count in [1, 2] {
        let hypotheses = Hypotheses::new(&maps[..count], &[3.0, 3.0][..count]).unwrap();
        let expected = hypotheses.expected_map().unwrap();
        assert_eq!(expected.grid().cells(), [[0.5, 0.5, 0.25, 0.25], [0.5, 0.625, 0.25, 0.375]][count - 1]);
        assert_eq!(&hypotheses.expected_tally().unwrap(), expected.tally());
        assert_eq!(expected.tally().unknown(), [2, 1][count - 1]);
    }
}
