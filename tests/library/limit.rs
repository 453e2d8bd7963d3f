//! The limit, three ways: closed form, adaptive and rigorous must agree, for rooms and for models of the user's own.

mod peaks;

use super::common::Random;
use approx::{abs_diff_eq, assert_abs_diff_eq, assert_relative_eq};
use mean_information::cell::{information, occupancy_from_log_odds};
use mean_information::elementary::{exp, ln};
use mean_information::estimate::Status;
use mean_information::limit::{Piece, RadialModel, RepeatedScans, Weight, adaptive, closed_form, rigorous};
use mean_information::quadrature::adaptive::{GaussKronrod, Rule};
use mean_information::quadrature::rigorous::Rigorous;
use mean_information::room::PolarRoom;
use mean_information::scalar::Scalar;
use mean_information::sensor::{GaussianSensor, InverseSensorModel, SteppedSensor};
use mean_information::{Error, Real};

const WEIGHTS: [Weight; 2] = [Weight::Radial, Weight::Area];

/// The spacing of the floats just above `x`.
fn ulp<T: Real>(x: T) -> T {
    let (m, e) = x.parts();
    T::from_parts(m + 1, e) - x
}

/// Settings with which the work ends early.
fn coarse_rules<T: Real>() -> [Rigorous<T>; 4] {
    let few = |n| Rigorous::new().limit(n);
    let wide = |absolute: f64| Rigorous::new().absolute(T::nearest(absolute)).relative(T::zero());
    [few(1), few(100), wide(1e30), wide(0.125)]
}

/// Asserts that the three methods agree on a room: overlap, and width.
fn assert_agreement<T: Real>(range: T, sigma: T) {
    let sensor = GaussianSensor::new(range, sigma).expect("positive");
    for weight in WEIGHTS {
        let what = format!("{} range {range:e}, sigma {sigma:e}, {weight:?}", T::FORMAT);
        let enclosure = rigorous(&sensor, weight, &Rigorous::default()).expect("a room");
        let (lower, upper) = (enclosure.lower, enclosure.upper);
        let ulp = ulp(lower * T::nearest(1.0 - 1e-7));
        assert_eq!(enclosure.status, Status::Converged, "{what}");
        assert!(lower <= upper && upper - lower <= T::nearest(4.0) * ulp, "{what}: {enclosure:?}");
        // Whatever is asked for, the enclosure holds the limit.
        for rule in coarse_rules() {
            let coarse = rigorous(&sensor, weight, &rule).expect("a room");
            assert!(
                coarse.lower <= lower && upper <= coarse.upper,
                "{what}: {rule:?}, {coarse:?}, {enclosure:?}"
            );
        }
        let closed = closed_form(&sensor, weight);
        let slack = ulp + ulp;
        assert!(lower - slack <= closed && closed <= upper + slack, "{what}: {closed:e}, {enclosure:?}");
        let relative = T::nearest(if T::PRECISION == 53 { 1e-12 } else { 1e-5 });
        let estimate = adaptive(&sensor, weight, &GaussKronrod::new().relative(relative)).expect("a room");
        let error = (estimate.value - lower).abs().max((estimate.value - upper).abs());
        assert!(error <= estimate.error + (upper - lower), "{what}: {estimate:?}, {enclosure:?}");
        assert_eq!(estimate.status, Status::Converged, "{what}: {estimate:?}");
        assert!(estimate.error <= relative + T::nearest(32.0) * T::epsilon(), "{what}: {estimate:?}");
    }
}

/// `MEANINFO_ROOMS` rooms in each format; `proofs/RESULTS.md` has the run with 10 000.
#[test]
fn the_three_methods_agree() {
    let rooms = std::env::var("MEANINFO_ROOMS").ok().and_then(|n| n.parse().ok()).unwrap_or(40);
    let mut random = Random::new(20_261_122);
    for _ in 0..rooms {
        // z / σ from 1e-6 to 1e9, evenly by its logarithm; lengths from millimetres to kilometres.
        let [ratio, sigma] = [(15.0, -6.0), (4.0, -3.0)]
            .map(|(decades, first)| exp(ln(10.0) * (decades * random.uniform() + first)));
        assert_agreement(ratio * sigma, sigma);
        assert_agreement((ratio * sigma) as f32, sigma as f32);
    }
}

#[test]
fn they_agree_at_the_turns_of_the_model() {
    let half_width = 1.177_410_022_515_474_7;
    for ratio in [1e-300, 1e-9, 0.46, half_width, 2.5, 40.0, 40.0_f64.next_up(), 1e12, 1e299] {
        assert_agreement(ratio * 0.25, 0.25);
    }
    for ratio in [1e-30, 1e-9, 0.46, half_width as f32, 2.5, 40.0, 40.0_f32.next_up(), 1e12, 1e34] {
        assert_agreement(ratio * 0.25, 0.25);
    }
}

/// No more than GSL's `qagp` takes at `z / σ = 10`, and the promise of `limit::adaptive`: the most by each rule, as the chapter has it.
#[test]
fn twelve_digits_in_545_evaluations() {
    let mut most = [0; 6];
    for tenth in -60..=90 {
        let ratio = exp(ln(10.0) * 0.1 * f64::from(tenth));
        let sensor = GaussianSensor::new(0.25 * ratio, 0.25).unwrap();
        for ((k, rule), weight) in
            Rule::ALL.iter().copied().enumerate().flat_map(|rule| WEIGHTS.map(|weight| (rule, weight)))
        {
            let estimate =
                adaptive(&sensor, weight, &GaussKronrod::new().relative(1e-12).rule(rule)).unwrap();
            assert_eq!(estimate.status, Status::Converged, "{ratio:e}, {rule:?}, {weight:?}");
            most[k] = estimate.evaluations.max(most[k]);
            // The closed form is within an ulp, which is at most epsilon / 2.
            let error = (estimate.value - closed_form(&sensor, weight)).abs();
            assert!(error <= estimate.error + f64::EPSILON / 2.0, "{ratio:e}, {rule:?}: {estimate:?}");
        }
    }
    assert_eq!(most, [545, 383, 253, 333, 412, 492]);
}

/// The bound on a model's tail does not hide what is there, nor what is undefined.
#[test]
fn pieces_that_matter_are_integrated() {
    let model = Ramp { low: 0.0625, high: 0.875, reach: 7.0 };
    let lax = adaptive(&model, Weight::Radial, &GaussKronrod::new().absolute(0.75)).unwrap();
    assert_eq!(lax.evaluations, 21 + 2);
    let blind = adaptive(&model, Weight::Radial, &GaussKronrod::new().absolute(2.5)).unwrap();
    assert_eq!((blind.value, blind.evaluations), (1.0, 1));
    assert!(blind.error >= 1.0);
    let undefined = Ramp { low: 2.0, high: 3.0, reach: 7.0 };
    let nothing = adaptive(&undefined, Weight::Area, &GaussKronrod::new()).unwrap();
    assert!(matches!(nothing.status, Status::NotFinite { .. }));
}

/// Where `z / σ` cannot be squared the integrals refuse; the closed form has no such limit.
#[test]
fn a_ratio_that_overflows_is_refused() {
    let sensor = GaussianSensor::new(1e300_f64, 1e-9).unwrap();
    for weight in WEIGHTS {
        assert!(matches!(adaptive(&sensor, weight, &GaussKronrod::new()), Err(Error::OutOfRange { .. })));
        assert!(matches!(rigorous(&sensor, weight, &Rigorous::default()), Err(Error::OutOfRange { .. })));
        assert_eq!(closed_form(&sensor, weight), 1.0);
    }
}

#[test]
fn an_evaluation_limit_below_one_rule_for_every_panel_is_refused() {
    let sensor = GaussianSensor::new(3.0_f64, 0.125).unwrap();
    let few = |limit| adaptive(&sensor, Weight::Area, &GaussKronrod::new().relative(1e-14).limit(limit));
    assert!(few(0).is_err() && few(100).is_err());
    let stopped = few(250).unwrap();
    assert_eq!(stopped.status, Status::EvaluationLimit);
    assert!(stopped.evaluations <= 250);
    let known = closed_form(&sensor, Weight::Area);
    assert!((stopped.value - known).abs() <= stopped.error && stopped.error > 1e-14);
}

/// Seven panels: four about the obstacle, two and the tail towards the sensor.
#[test]
fn every_panel_is_evaluated_once_at_least() {
    let sensor = GaussianSensor::new(3.0_f64, 0.125).unwrap();
    let few = |limit| adaptive(&sensor, Weight::Area, &GaussKronrod::new().limit(limit));
    let least = 7 * Rule::K21.evaluations();
    let Err(Error::OutOfRange { what, allowed, .. }) = few(least - 1) else { panic!("{:?}", few(least - 1)) };
    assert_eq!((what, allowed), ("evaluation limit", "at least one rule for every panel of the model"));
    assert!(few(least).unwrap().evaluations <= least);
}

/// What is known to matter less than the tolerance of the deficit is left at that.
#[test]
fn a_tolerance_above_the_deficit_needs_no_integration() {
    let sensor = GaussianSensor::new(3.0_f64, 3e-6).unwrap();
    for weight in WEIGHTS {
        let limit = adaptive(&sensor, weight, &GaussKronrod::new().absolute(1e-3)).unwrap();
        assert!(limit.evaluations <= 3 && limit.error < 1e-3, "{limit:?}");
        assert!((limit.value - closed_form(&sensor, weight)).abs() <= limit.error);
    }
}

#[test]
fn a_scale_that_is_no_length_is_refused_by_its_name() {
    for reach in [-7.0, 0.0, f64::NAN, f64::INFINITY] {
        let model = Ramp { low: 0.0625, high: 0.875, reach };
        let refused = adaptive(&model, Weight::Area, &GaussKronrod::new()).unwrap_err().to_string();
        assert_eq!(
            refused,
            format!("scale of the model is {reach}, allowed is positive and finite, in metres")
        );
        assert_eq!(rigorous(&model, Weight::Area, &Rigorous::default()).unwrap_err().to_string(), refused);
    }
}

#[test]
fn a_ratio_beyond_the_type_is_refused() {
    for (range, sigma) in [(1e308_f64, 1e-3), (1e306, 1.0), (f64::MAX, 1.0)] {
        let sensor = GaussianSensor::new(range, sigma).unwrap();
        let refused = rigorous(&sensor, Weight::Area, &Rigorous::default()).unwrap_err();
        assert!(refused.to_string().starts_with("range over sigma is"), "{refused}");
        assert!(adaptive(&sensor, Weight::Radial, &GaussKronrod::new()).is_err());
    }
    // Finite, with its thousandfold, in f64 but not in f32.
    let [single, double] =
        [GaussianSensor::new(1e36_f32, 1.0).is_ok(), GaussianSensor::new(1e36_f64, 1.0).is_ok()];
    assert!(single && double);
    let single = GaussianSensor::new(1e36_f32, 1.0).unwrap();
    assert!(rigorous(&single, Weight::Radial, &Rigorous::default()).is_err());
}

/// The status of the first piece that ends otherwise is that of the whole.
#[test]
fn a_limit_on_evaluations_shows_in_the_status() {
    let sensor = GaussianSensor::new(3.0_f64, 0.125).unwrap();
    let few = rigorous(&sensor, Weight::Radial, &Rigorous::new().limit(100)).unwrap();
    assert_eq!(few.status, Status::EvaluationLimit);
    assert!(few.contains(closed_form(&sensor, Weight::Radial)));
}

/// `n (1 - MI)` tends to a constant: the bumps narrow like `1 / n`, and the panels with them.
#[test]
fn a_million_scans() {
    let sensor = GaussianSensor::new(3.0_f64, 0.125).unwrap();
    let scaled = |scans: u32| {
        let model = RepeatedScans::new(sensor, scans).unwrap();
        assert_eq!(model.scans(), scans);
        let limit = adaptive(&model, Weight::Radial, &GaussKronrod::new().relative(1e-10)).unwrap();
        assert!(limit.status == Status::Converged && limit.evaluations < 6000, "{limit:?}");
        f64::from(scans) * (1.0 - limit.value)
    };
    let [coarse, fine] = [1 << 16, 1 << 20].map(scaled);
    assert_relative_eq!(coarse, fine, epsilon = 0.0, max_relative = 1e-3);
}

/// Steps have a limit that can be written down.
#[test]
fn steps_have_the_mean_of_their_two_levels() {
    let model = SteppedSensor::new(4.0_f64, 0.5, 0.2, 0.9).unwrap();
    let (near, far, free, occupied) = (3.75, 4.25, information(0.2), information(0.9));
    let known = [
        (near * free + 0.5 * occupied) / far,
        (near * near * free + (far * far - near * near) * occupied) / (far * far),
    ];
    for (weight, known) in WEIGHTS.into_iter().zip(known) {
        let enclosure = rigorous(&model, weight, &Rigorous::default()).unwrap();
        // The formula above rounds a few times.
        assert!(
            abs_diff_eq!(enclosure.lower, known, epsilon = 1e-15) && enclosure.width() < 5e-16,
            "{enclosure:?}"
        );
        let estimate = adaptive(&model, weight, &GaussKronrod::new()).unwrap();
        assert!((estimate.value - known).abs() <= estimate.error && estimate.error < 1e-11, "{estimate:?}");
    }
    let unknown = SteppedSensor::new(4.0_f64, 0.5, 0.5, 0.5).unwrap();
    let enclosure = rigorous(&unknown, Weight::Area, &Rigorous::default()).unwrap();
    assert_eq!((enclosure.lower, enclosure.upper), (0.0, 0.0));
    assert_eq!(adaptive(&unknown, Weight::Area, &GaussKronrod::new()).unwrap().value, 0.0);
}

/// A user's model: the occupancy rises linearly from `low` at the sensor to `high` at `reach`.
struct Ramp {
    low: f64,
    high: f64,
    reach: f64,
}

impl RadialModel for Ramp {
    type Float = f64;

    fn origin(&self) -> f64 {
        0.0
    }

    fn scale(&self) -> f64 {
        self.reach
    }

    fn pieces<S: Scalar>(&self) -> Vec<Piece<S>> {
        vec![Piece::new(S::constant(0.0), S::constant(1.0), 1)]
    }

    fn entropy<S: Scalar>(&self, _: usize, t: S) -> S {
        let low = S::constant(self.low);
        (low.clone() + (S::constant(self.high) - low) * t).entropy()
    }
}

/// `∫ H dp = (-p² ln p + p²/2 + q² ln q - q²/2) / (2 ln 2)` with `q = 1 - p`.
#[test]
fn a_model_of_ones_own() {
    let model = Ramp { low: 0.0625, high: 0.875, reach: 7.0 };
    let primitive = |p: f64| {
        let q = 1.0 - p;
        (-p * p * ln(p) + 0.5 * p * p + q * q * ln(q) - 0.5 * q * q) / (2.0 * ln(2.0))
    };
    let known = 1.0 - (primitive(model.high) - primitive(model.low)) / (model.high - model.low);
    let enclosure = rigorous(&model, Weight::Radial, &Rigorous::default()).unwrap();
    assert!(
        abs_diff_eq!(enclosure.lower, known, epsilon = 1e-15) && enclosure.width() < 2e-16,
        "{enclosure:?}, {known}"
    );
    let estimate = adaptive(&model, Weight::Radial, &GaussKronrod::new()).unwrap();
    assert!((estimate.value - known).abs() <= estimate.error, "{estimate:?}, {known}");
    let estimate = adaptive(&model, Weight::Area, &GaussKronrod::new()).unwrap();
    let enclosure = rigorous(&model, Weight::Area, &Rigorous::default()).unwrap();
    assert!((estimate.value - enclosure.lower).abs() <= estimate.error, "{estimate:?}, {enclosure:?}");
}

/// What `RepeatedScans` says of a point, for grids.
struct Fused {
    sensor: GaussianSensor<f64>,
    scans: f64,
}

impl InverseSensorModel for Fused {
    type Float = f64;

    fn occupancy(&self, rho: f64) -> f64 {
        let p = self.sensor.occupancy(rho);
        occupancy_from_log_odds(self.scans * (ln(p) - ln(1.0 - p)))
    }

    fn reach(&self) -> f64 {
        self.sensor.reach()
    }
}

/// Polar grids of fused readings tend to the limit. Between its peaks the information is monotone: down to 0 at `-b`, up to 1,
/// down to 0; so its variation is at most 3, and the bound `(3 + 1) / 2 h / (L - h / 2)`, as `docs/convergence.md` has it.
#[test]
fn grids_of_repeated_scans_tend_to_their_limit() {
    let sensor = GaussianSensor::new(3.0_f64, 0.25).unwrap();
    for scans in [1, 2, 7, 40] {
        let model = RepeatedScans::new(sensor, scans).unwrap();
        let limit = rigorous(&model, Weight::Radial, &Rigorous::default()).unwrap();
        assert!(limit.width() < 4.5e-16, "{limit:?}");
        for rule in coarse_rules() {
            let coarse = rigorous(&model, Weight::Radial, &rule).unwrap();
            assert!(coarse.lower <= limit.lower && limit.upper <= coarse.upper, "{rule:?}, {coarse:?}");
        }
        let estimate = adaptive(&model, Weight::Radial, &GaussKronrod::new()).unwrap();
        assert!((estimate.value - limit.lower).abs() <= estimate.error, "{estimate:?}, {limit:?}");
        for h in [0.05, 0.003] {
            let room = PolarRoom::new(Fused { sensor, scans: f64::from(scans) }, h).unwrap();
            let error = room.tally().unwrap().mean_information() - limit.lower;
            let bound = 2.0 * h / (sensor.reach() - h / 2.0);
            assert!(error.abs() <= bound, "{scans} scans, {h} m: {error:e}, {bound:e}");
        }
    }
    let one = RepeatedScans::new(sensor, 1).unwrap();
    let limit = rigorous(&one, Weight::Area, &Rigorous::default()).unwrap();
    assert_abs_diff_eq!(limit.lower, closed_form(&sensor, Weight::Area), epsilon = 4e-16);
}

/// The deficit of many scans is `c / n` (bumps of the same shape, narrower and narrower), and `O(1 / n^2)`: the one at the
/// outer edge is cut in half, and its flanks are not symmetric.
#[test]
fn the_deficit_of_many_scans_falls_like_their_number() {
    let sensor = GaussianSensor::new(3.0_f64, 0.25).unwrap();
    let deficit = |scans| {
        let model = RepeatedScans::new(sensor, scans).unwrap();
        f64::from(scans) * (1.0 - rigorous(&model, Weight::Radial, &Rigorous::default()).unwrap().upper)
    };
    let [coarse, fine] = [1_000, 4_000].map(|n| deficit(4 * n) / deficit(n) - 1.0);
    assert!(coarse.abs() < 1e-4 && abs_diff_eq!(coarse / fine, 4.0, epsilon = 0.1), "{coarse:e}, {fine:e}");
}
