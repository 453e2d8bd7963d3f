//! Particles' maps that share what they have in common, against maps built one by one: sharing changes no bit.

use super::*;
use mean_information::expected::Hypotheses;
use mean_information::scan::ParticleMaps;

fn stepped(range: f64) -> Result<SteppedSensor<f64>, Error> {
    SteppedSensor::new(range, 0.3, 0.4, 0.7)
}

/// A step of a filter: the beams, a pose and a weight of each particle, and where each of the next continues.
#[derive(Clone, Debug)]
struct Step {
    beams: Vec<Beam<f64>>,
    poses: Vec<[f64; 3]>,
    weights: Vec<f64>,
    continued: Option<Vec<usize>>,
}

const PARTICLES: usize = 5;

/// Poses of which some are equal, and weights far apart or 0.
fn step() -> impl Strategy<Value = Step> {
    let spot = prop_oneof![2 => Just([0.3, -0.7, 0.25]), 3 => pose(), 1 => Just([0.3, -0.7, 0.5])];
    let weight =
        prop_oneof![5 => 1e-3_f64..0.9, 1 => Just(0.0), 1 => (-300_i32..300).prop_map(|k| 1.5 * power(k))];
    let weights = vec(weight, PARTICLES).prop_filter("a weight above 0", |w| w.iter().any(|&w| w > 0.0));
    let continued = prop::option::of(vec(0..PARTICLES, PARTICLES));
    let all = (vec(beam(), 1..12), vec(spot, PARTICLES), weights, continued);
    all.prop_map(|(beams, poses, weights, continued)| Step { beams, poses, weights, continued })
}

/// Compares with maps of each particle's own scans at every step.
fn check<M: InverseSensorModel<Float = f64>>(
    steps: &[Step],
    resolution: f64,
    model: fn(f64) -> Result<M, Error>,
) -> Result<(), TestCaseError> {
    let empty = ScanMap::new(resolution).unwrap();
    let mut shared = ParticleMaps::new(empty.clone(), PARTICLES).unwrap();
    let mut alone = vec![empty; PARTICLES];
    for step in steps {
        let scans: Vec<_> = step.poses.iter().map(|&pose| scan(pose, &step.beams)).collect();
        shared.insert(&scans, model).unwrap();
        for (map, scan) in alone.iter_mut().zip(&scans) {
            map.insert(scan, model).unwrap();
        }
        let grids: Vec<_> = alone.iter().map(grid).collect();
        for (particle, (map, grid)) in alone.iter().zip(&grids).enumerate() {
            prop_assert_eq!(shared.tally(particle).unwrap(), &map.tally());
            prop_assert_eq!(&shared.log_odds(particle).unwrap(), grid);
        }
        let hypotheses = Hypotheses::new(&grids, &step.weights).unwrap();
        prop_assert_eq!(shared.expected_tally(&step.weights).unwrap(), hypotheses.expected_tally().unwrap());
        let mean = shared.mean_of_mean_information(&step.weights).unwrap();
        prop_assert_eq!(mean, hypotheses.mean_of_mean_information());
        if let Some(continued) = &step.continued {
            shared.resample(continued).unwrap();
            alone = continued.iter().map(|&particle| alone[particle].clone()).collect();
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    /// Steps give few sums of log-odds, Eq. 5 many.
    #[test]
    fn sharing_changes_no_bit(steps in vec(step(), 1..6), resolution in 0.11_f64..0.6, is_stepped in any::<bool>()) {
        if is_stepped {
            check(&steps, resolution, stepped)?;
        } else {
            check(&steps, resolution, gaussian)?;
        }
    }
}

/// So many steps that patterns without cells are dropped, not only when particles are drawn anew.
#[test]
fn patterns_that_no_cell_has_are_dropped() {
    let beams: Vec<_> = (0..60).map(|k| Beam { bearing: 0.11 * f64::from(k), range: Some(2.3) }).collect();
    let step = |k: u32| {
        let pose = |particle: u32| {
            [0.013 * f64::from(k), 0.017 * f64::from(particle), 0.05 * f64::from(k * particle)]
        };
        let (poses, weights) = ((0..5).map(pose).collect(), vec![0.5, 0.25, 0.125, 0.7, 0.3]);
        Step { beams: beams.clone(), poses, weights, continued: None }
    };
    check(&(0..25).map(step).collect::<Vec<_>>(), 0.1, gaussian).unwrap();
}

/// A particle that saw further and is dropped leaves no cells behind.
#[test]
fn the_rectangle_is_that_of_the_particles_that_are_left() {
    let beams = [Beam { bearing: 0.0, range: Some(2.5) }];
    let mut maps = ParticleMaps::new(ScanMap::<f64>::new(0.25).unwrap(), 2).unwrap();
    maps.insert(&[scan([0.1, 0.1, 0.0], &beams), scan([9.1, 5.1, 0.0], &beams)], stepped).unwrap();
    let both = maps.expected_tally(&[0.5, 0.25]).unwrap().cells();
    maps.resample(&[0, 0, 0]).unwrap();
    assert_eq!(maps.particles(), 3);
    let left = maps.expected_tally(&[0.5, 0.25, 2.0]).unwrap();
    let mut alone = ScanMap::<f64>::new(0.25).unwrap();
    alone.insert(&scan([0.1, 0.1, 0.0], &beams), stepped).unwrap();
    assert_eq!(maps.tally(2), Some(&alone.tally()));
    let grids = [grid(&alone), grid(&alone), grid(&alone)];
    let hypotheses = Hypotheses::new(&grids, &[0.5, 0.25, 2.0]).unwrap();
    assert_eq!(left, hypotheses.expected_tally().unwrap());
    // 9 m and 5 m further on, at 4 cells a metre: less than both rectangles together.
    assert_eq!(both, (left.cells() + 36) * 21);
}

#[test]
fn what_does_not_fit_is_refused_and_changes_nothing() {
    let beams = [Beam { bearing: 0.0, range: Some(2.5) }];
    let empty = ScanMap::<f64>::new(0.25).unwrap().with_max_cells(100);
    let refused = |result: Result<ParticleMaps<f64>, Error>| result.unwrap_err().to_string();
    let words = "number of particles is 0, allowed is 1 or more";
    assert_eq!(refused(ParticleMaps::new(empty.clone(), 0)), words);
    let mut filled = empty.clone();
    filled.insert(&scan([0.1, 0.1, 0.0], &beams), stepped).unwrap();
    assert!(
        refused(ParticleMaps::new(filled, 2)).starts_with("number of scans of the map of all particles is 1")
    );

    let mut maps = ParticleMaps::new(empty, 2).unwrap();
    let near = [scan([0.1, 0.1, 0.0], &beams), scan([0.1, 0.4, 0.0], &beams)];
    maps.insert(&near, stepped).unwrap();
    let before = maps.clone();
    let far = [near[0].clone(), scan([0.1, 9.1, 0.0], &beams)];
    let all: [Result<(), Error>; 6] = [
        maps.insert(&near[..1], stepped),
        maps.insert(&far, stepped),
        maps.insert(&near, |_| stepped(-1.0)),
        maps.resample(&[]),
        maps.resample(&[1, 2]),
        maps.expected_tally(&[0.5]).map(drop),
    ];
    let words = all.map(|refused| refused.unwrap_err().to_string());
    let expected = [
        "number of scans is 1, allowed is one for each particle",
        "the map has 4.440e2 cells, allowed are 100",
        "range is -1, allowed is positive and finite, in metres",
        "number of particles is 0, allowed is 1 or more",
        "resampled particle 1 is 2, allowed is a particle, counted from 0",
        "number of weights is 1, allowed is 2: one for each item",
    ];
    for (words, expected) in words.iter().zip(expected) {
        assert_eq!(words, expected);
    }
    assert!(maps.tally(2).is_none() && maps.log_odds(2).is_err());
    for particle in 0..2 {
        assert_eq!(maps.log_odds(particle), before.log_odds(particle));
        assert_eq!(maps.tally(particle), before.tally(particle));
    }
    assert_eq!(maps.expected_tally(&[0.5, 0.7]), before.expected_tally(&[0.5, 0.7]));
}
