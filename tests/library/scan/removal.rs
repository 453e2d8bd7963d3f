//! Scans removed again, and tallies as scans come and go: the bits of maps that never had them, and of whole measurements.

use super::{MAXIMUM, SIGMA, beam, pose};
use mean_information::scan::{Beam, Pose, Scan, ScanMap, TalliedMap};
use mean_information::sensor::{GaussianSensor, InverseSensorModel, SteppedSensor};
use mean_information::{Error, Real};
use proptest::collection::vec;
use proptest::prelude::*;

type Place = ([f64; 3], Vec<Beam<f64>>);

/// Scans of which one comes twice.
fn places() -> impl Strategy<Value = Vec<Place>> {
    vec((pose(), vec(beam(), 1..7)), 2..8).prop_map(|mut places| {
        places.push(places[0].clone());
        places
    })
}

fn in_format<T: Real>((pose, beams): &Place) -> Scan<T> {
    let [x, y, theta] = *pose;
    let beam = |beam: &Beam<f64>| Beam { bearing: beam.bearing, range: beam.range.map(T::nearest) };
    let beams = beams.iter().map(beam).collect();
    Scan::new(Pose::new(x, y, theta).unwrap(), T::nearest(MAXIMUM), beams).unwrap()
}

/// Inserts all scans, removes those that are not kept in some order, and compares with a map that has never had them; and so the
/// tallies on the way.
fn check<T: Real, M: InverseSensorModel<Float = T>>(
    places: &[Place],
    order: &[usize],
    kept: usize,
    resolution: f64,
    model: impl Fn(T) -> Result<M, Error>,
) -> Result<(), TestCaseError> {
    let scans: Vec<Scan<T>> = places.iter().map(in_format).collect();
    let empty = ScanMap::<T>::new(resolution)?.with_agreement()?;
    let (mut map, mut tallied) = (empty.clone(), TalliedMap::new(empty.clone()));
    for scan in &scans {
        map.insert(scan, &model)?;
        prop_assert_eq!(tallied.insert(scan, &model)?, &map.tally());
    }
    let mut alone = empty;
    for &k in order.iter().take(kept) {
        alone.insert(&scans[k], &model)?;
    }
    prop_assert_eq!(tallied.without(order[kept..].iter().map(|&k| &scans[k]), &model)?, alone.tally());
    for &k in &order[kept..] {
        map.remove(&scans[k], &model)?;
        prop_assert_eq!(tallied.remove(&scans[k], &model)?, &map.tally());
    }
    prop_assert_eq!(&map, &alone);
    prop_assert_eq!(map.scans(), kept as u64);
    prop_assert_eq!(map.log_odds()?, alone.log_odds()?);
    prop_assert_eq!((map.tally(), map.agreement()), (alone.tally(), alone.agreement()));
    prop_assert_eq!(map.contradictions()?, alone.contradictions()?);
    // There and back: also in the room that is left.
    for &k in &order[kept..] {
        map.insert(&scans[k], &model)?;
        prop_assert_eq!(tallied.insert(&scans[k], &model)?, &map.tally());
    }
    let mut whole = alone;
    for &k in order[kept..].iter().rev() {
        whole.insert(&scans[k], &model)?;
    }
    prop_assert_eq!(&map, &whole);
    prop_assert_eq!(tallied.into_map(), whole);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn removed_scans_leave_no_bit(
        (places, order) in places().prop_flat_map(|places| {
            let order: Vec<_> = (0..places.len()).collect();
            (Just(places), Just(order).prop_shuffle())
        }),
        kept in 0_usize..8, resolution in 0.11_f64..0.6,
    ) {
        let kept = kept % (places.len() + 1);
        check(&places, &order, kept, resolution, |range| GaussianSensor::new(range, SIGMA))?;
        check(&places, &order, kept, resolution, |range: f64| SteppedSensor::new(range, 0.3, 0.375, 0.8125))?;
        check(&places, &order, kept, resolution, |range| GaussianSensor::new(range, SIGMA as f32))?;
        check(&places, &order, kept, resolution, |range: f32| SteppedSensor::new(range, 0.3, 0.375, 0.8125))?;
    }

    /// Agreement costs memory, not bits.
    #[test]
    fn agreement_changes_no_other_result(places in places(), resolution in 0.11_f64..0.6) {
        let (mut with, mut without) = (ScanMap::new(resolution)?.with_agreement()?, ScanMap::new(resolution)?);
        for scan in places.iter().map(in_format::<f64>) {
            with.insert(&scan, super::gaussian)?;
            without.insert(&scan, super::gaussian)?;
        }
        prop_assert_eq!(with.log_odds()?, without.log_odds()?);
        prop_assert_eq!(with.tally(), without.tally());
        prop_assert_eq!((without.agreement(), without.contradictions()?), (None, None));
        prop_assert!(without.with_agreement().is_err() && with.with_agreement().is_ok());
    }

    /// Whatever is refused, nothing has changed.
    #[test]
    fn a_scan_that_the_map_does_not_hold_is_refused(places in places(), resolution in 0.11_f64..0.6, part in 0.9_f64..0.99) {
        // Without the one that comes again.
        let scans: Vec<Scan<f64>> = places[1..].iter().map(in_format).collect();
        let mut map = ScanMap::<f64>::new(resolution)?;
        prop_assert!(map.remove(&scans[0], super::gaussian).is_err());
        for scan in &scans[1..] {
            map.insert(scan, super::gaussian)?;
        }
        let before = map.clone();
        let moved = |scan: &Scan<f64>| {
            let ([x, y], theta) = (scan.pose().position(), scan.pose().theta());
            Scan::new(Pose::new(x, y, theta + 0.01).unwrap(), MAXIMUM, scan.beams().to_vec()).unwrap()
        };
        let model_of = |sigma: f64| move |range| GaussianSensor::new(range, sigma);
        prop_assert!(map.remove(&scans[0], super::gaussian).is_err());
        prop_assert!(map.remove(&moved(&scans[1]), super::gaussian).is_err());
        // Beams without return have the same end by both.
        if scans[1].beams().iter().any(|beam| beam.range.is_some()) {
            prop_assert!(map.remove(&scans[1], model_of(part * SIGMA)).is_err());
        }
        prop_assert!(map.remove(&scans[1], model_of(-1.5)).is_err());
        prop_assert_eq!(&map, &before);
        // Beams in another order are the same scan.
        let backwards = scans[1].beams().iter().rev().copied().collect();
        map.remove(&Scan::new(*scans[1].pose(), MAXIMUM, backwards)?, super::gaussian)?;
        prop_assert!(map.remove(&scans[1], super::gaussian).is_err());
        prop_assert_eq!(map.scans() + 1, before.scans());
    }
}

/// A model of one's own that does not say where its obstacle is.
struct Silent(SteppedSensor<f64>);

impl InverseSensorModel for Silent {
    type Float = f64;

    fn occupancy(&self, rho: f64) -> f64 {
        self.0.occupancy(rho)
    }

    fn reach(&self) -> f64 {
        self.0.reach()
    }

    fn plateau(&self) -> f64 {
        self.0.plateau()
    }
}

/// A wall that is surer ends beams where they ended: told apart by the print, or else where no other scan was.
#[test]
fn another_obstacle_is_refused() {
    let scan = |x: f64, range| {
        let beams =
            vec![Beam { bearing: 0.25, range: Some(range) }, Beam { bearing: 1.5, range: Some(1.25) }];
        Scan::new(Pose::new(x, 0.25, 0.125).unwrap(), 4.0, beams).unwrap()
    };
    let stepped = |occupied| move |range| SteppedSensor::new(range, 0.25, 0.25, occupied);
    let mut map = ScanMap::<f64>::new(0.125).unwrap();
    map.insert(&scan(0.5, 1.5), stepped(0.875)).unwrap();
    map.insert(&scan(0.5, 2.5), stepped(0.875)).unwrap();
    let before = map.clone();
    for range in [1.5, 2.5] {
        assert!(map.remove(&scan(0.5, range), stepped(0.9375)).is_err());
        assert_eq!(map, before);
    }
    let model = |occupied| move |range| stepped(occupied)(range).map(Silent);
    let mut map = ScanMap::<f64>::new(0.125).unwrap();
    map.insert(&scan(0.5, 1.5), model(0.875)).unwrap();
    map.insert(&scan(0.5, 2.5), model(0.875)).unwrap();
    let before = map.clone();
    assert!(map.remove(&scan(0.5, 2.5), model(0.9375)).is_err());
    assert_eq!(map, before);
    // Inside of another it is taken for the one inserted, as the documentation says ...
    map.remove(&scan(0.5, 1.5), model(0.9375)).unwrap();
    // ... unless magnitudes are kept, which would be less than what they are magnitudes of.
    let mut map = ScanMap::<f64>::new(0.125).unwrap().with_agreement().unwrap();
    map.insert(&scan(0.5, 1.5), model(0.875)).unwrap();
    map.insert(&scan(0.5, 2.5), model(0.875)).unwrap();
    let before = map.clone();
    assert!(map.remove(&scan(0.5, 1.5), model(0.9375)).is_err());
    assert_eq!(map, before);
}
