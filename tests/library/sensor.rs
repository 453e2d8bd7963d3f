//! Inverse sensor models: Eq. 5 against its formula, its relations and its edge.

use super::common::power;
use approx::abs_diff_eq;
use mean_information::Real;
use mean_information::elementary::exp;
use mean_information::sensor::{GaussianSensor, InverseSensorModel, SteppedSensor};
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// The formula in floating point: four roundings of `r = t^2 / 2` move `p` by `4 r` half ulps, and `exp` rounds once.
    #[test]
    fn it_is_the_formula_rounded(z in 0.01_f64..80.0, sigma in 0.001_f64..3.0, place in -37.0_f64..1.17) {
        let rho = z + place * sigma;
        let sensor = GaussianSensor::new(z, sigma)?;
        let t = (rho - z) / sigma;
        let r = t * t / 2.0;
        let p = exp(-r);
        prop_assert!(abs_diff_eq!(sensor.occupancy(rho), p, epsilon = p * (4.0 * r + 2.0) * f64::EPSILON));
    }

    #[test]
    fn scaling_by_a_power_of_two_changes_no_bit(z in 0.01_f64..80.0, sigma in 0.001_f64..3.0, rho in 0.0_f64..90.0, k in -60_i32..60) {
        let scaled = GaussianSensor::new(z * power(k), sigma * power(k))?;
        prop_assert_eq!(GaussianSensor::new(z, sigma)?.occupancy(rho), scaled.occupancy(rho * power(k)));
    }

    /// In front of the obstacle the model is symmetric with what lies behind, up to the edge.
    #[test]
    fn it_is_symmetric_about_the_range(z in 1_u32..1000, sigma in 0.1_f64..50.0, d in 0_u32..50) {
        let (z, d) = (f64::from(z), f64::from(d) / 64.0);
        let sensor = GaussianSensor::new(z, sigma)?;
        prop_assert_eq!(sensor.occupancy(z - d).max(0.5), sensor.occupancy(z + d));
    }

    #[test]
    fn beyond_its_reach_nothing_is_observed(z in 0.01_f64..80.0, sigma in 0.001_f64..3.0, beyond in 0.0_f64..1e6) {
        let sensor = GaussianSensor::new(z, sigma)?;
        let edge = sensor.reach();
        prop_assert_eq!(sensor.occupancy(edge.next_up() + beyond), 0.5);
        // Its error is below 2 ulp.
        prop_assert!(sensor.occupancy(edge.next_down().next_down().next_down()) > 0.5);
        prop_assert!(sensor.occupancy(z + 1.177 * sigma) > 0.5);
    }

    /// Of any sizes, and of sizes that meet: no panic, and the rules hold at the reading, at its reach and at `rho`.
    #[test]
    fn the_rules_hold_for_any_bits_f64(bits in any::<[u64; 3]>(), near in (-80_i32..80, -46.0_f64..46.0)) {
        let [rho, z, sigma] = bits.map(f64::from_bits);
        the_rules_hold(rho, z.abs(), sigma.abs())?;
        let sigma = z.abs() * power(near.0);
        the_rules_hold(rho, z.abs(), sigma)?;
        the_rules_hold(z.abs() + near.1 * sigma, z.abs(), sigma)?;
    }

    #[test]
    fn the_rules_hold_for_any_bits_f32(bits in any::<[u32; 3]>(), near in (-40_i32..40, -15.0_f32..15.0)) {
        let [rho, z, sigma] = bits.map(f32::from_bits);
        the_rules_hold(rho, z.abs(), sigma.abs())?;
        let sigma = z.abs() * power(near.0) as f32;
        the_rules_hold(rho, z.abs(), sigma)?;
        the_rules_hold(z.abs() + near.1 * sigma, z.abs(), sigma)?;
    }

    #[test]
    fn single_precision_agrees_with_double(z in 0.1_f32..80.0, sigma in 0.01_f32..3.0, rho in 0.0_f32..90.0) {
        let narrow = GaussianSensor::new(z, sigma)?.occupancy(rho);
        let wide = GaussianSensor::new(f64::from(z), f64::from(sigma))?.occupancy(f64::from(rho));
        prop_assert!(abs_diff_eq!(f64::from(narrow), wide, epsilon = wide * f64::from(f32::EPSILON) / 2.0 * (1.0 + 1e-8) + 1e-45));
    }
}

/// What Eq. 5 says of every `rho`, of whatever size.
fn the_rules_hold<T: Real>(rho: T, z: T, sigma: T) -> Result<(), TestCaseError> {
    let Ok(sensor) = GaussianSensor::new(z, sigma) else {
        prop_assert!(![z, sigma].iter().all(|x| x.is_finite() && *x > T::zero()));
        return Ok(());
    };
    let (p, reach) = (sensor.occupancy(rho), sensor.reach());
    prop_assert_eq!(p.is_nan(), rho.is_nan());
    prop_assert!(rho.is_nan() || (T::zero() <= p && p <= T::one()));
    prop_assert!(rho.is_nan() || rho <= reach || p == T::HALF);
    prop_assert!(rho.is_nan() || rho < z || p >= T::HALF);
    prop_assert!(reach >= z && sensor.occupancy(z) == T::one());
    Ok(())
}

/// The square of `(z - rho) / sigma` is within `2^-117` of `2150 ln 2`: so `p` is next to `2^-1075`, the midpoint of 0 and the
/// smallest number, and only its exact comparison tells on which side. (From a search; likewise for `f32`.)
#[test]
fn a_tie_between_nothing_and_the_smallest_number() {
    let below =
        GaussianSensor::new(f64::from_bits(0x404c_8ecb_7f51_9be8), f64::from_bits(0x3ff7_ac23_b3cd_6580))
            .unwrap();
    assert_eq!(below.occupancy(f64::from_bits(0x3b99_7a26_fdd2_b5fc)), 0.0);
    let above =
        GaussianSensor::new(f64::from_bits(0x404a_dca9_6bc7_f43e), f64::from_bits(0x3ff6_4445_fb95_b19a))
            .unwrap();
    assert_eq!(above.occupancy(f64::from_bits(0xbc5e_f821_28f1_8410)), f64::from_bits(1));
    let below = GaussianSensor::new(25.614_93_f32, 1.776_314_3).unwrap();
    assert_eq!(below.occupancy(3.578_178_4e-11), 0.0);
    let above = GaussianSensor::new(27.427_313_f32, 1.901_997_3).unwrap();
    assert_eq!(above.occupancy(1.579_982_5e-9), f32::from_bits(1));
}

#[test]
fn the_reach_at_the_ends_of_the_format() {
    let reach = |z: f64, sigma: f64| GaussianSensor::new(z, sigma).unwrap().reach();
    let smallest = f64::from_bits(1);
    assert_eq!(reach(smallest, smallest), 2.0 * smallest); // 1 + 1.177...
    assert_eq!(reach(4.0 * smallest, 3.0 * smallest), 8.0 * smallest); // 4 + 3.532...
    assert_eq!(reach(1e300, 1e-300), 1e300);
    assert_eq!([reach(f64::MAX, f64::MAX), reach(1.0, f64::MAX)], [f64::INFINITY; 2]);
    assert_eq!(reach(f64::MAX, 1.0), f64::MAX);
    let sensor = GaussianSensor::new(f64::MAX, f64::MAX).unwrap();
    assert_eq!([0.0, f64::MAX].map(|rho| sensor.occupancy(rho)), [0.606_530_659_712_633_4, 1.0]);
}

#[test]
fn distances_far_beyond_the_noise_and_far_below_it() {
    let sensor = GaussianSensor::new(1e300_f64, 1e-300).unwrap();
    assert_eq!([0.0, -1e300, 1e300_f64.next_down()].map(|rho| sensor.occupancy(rho)), [0.0; 3]);
    assert_eq!([1e300, 1e300_f64.next_up()].map(|rho| sensor.occupancy(rho)), [1.0, 0.5]);
    let sensor = GaussianSensor::new(1e-300_f64, 1e300).unwrap();
    assert_eq!([0.0, 1.0, 1e280].map(|rho| sensor.occupancy(rho)), [1.0; 3]);
    assert_eq!(sensor.occupancy(f64::MAX), 0.5);
    assert!(sensor.occupancy(f64::NAN).is_nan());
    assert_eq!([f64::INFINITY, f64::NEG_INFINITY].map(|rho| sensor.occupancy(rho)), [0.5, 0.0]);
}

#[test]
fn what_is_no_sensor_is_refused_with_its_reason() {
    let refused = |z: f64, sigma: f64| GaussianSensor::new(z, sigma).unwrap_err().to_string();
    assert_eq!(refused(0.0, 0.2), "range is 0, allowed is positive and finite, in metres");
    assert_eq!(refused(2.0, -0.2), "sigma is -0.2, allowed is positive and finite, in metres");
    assert!(refused(f64::NAN, 0.2).starts_with("range is NaN"));
    assert!(refused(2.0, f64::INFINITY).starts_with("sigma is inf"));
    let refused =
        |thickness, free, occupied| SteppedSensor::new(2.0_f32, thickness, free, occupied).unwrap_err();
    assert!(refused(0.0, 0.25, 0.75).to_string().starts_with("thickness is 0"));
    assert_eq!(refused(0.5, 0.75, 0.75).to_string(), "occupancy of free space is 0.75, allowed is 0 to 1/2");
    assert_eq!(
        refused(0.5, 0.25, 0.25).to_string(),
        "occupancy of the obstacle is 0.25, allowed is 1/2 to 1"
    );
    assert!(SteppedSensor::new(2.0, 0.5, 0.25, f32::NAN).is_err());
}

#[test]
fn steps_include_both_faces_of_the_obstacle() {
    let sensor = SteppedSensor::new(3.0_f64, 0.5, 0.125, 0.875).unwrap();
    let expected = [(2.75_f64.next_down(), 0.125), (2.75, 0.875), (3.25, 0.875), (3.25_f64.next_up(), 0.5)];
    for (rho, p) in expected {
        assert_eq!(sensor.occupancy(rho), p);
    }
    assert_eq!(sensor.reach(), 3.25);
    assert!(sensor.occupancy(f64::NAN).is_nan());
}

/// The plateau by bisection, asking the model each time.
fn halved<T: Real>(sensor: &GaussianSensor<T>) -> T {
    let (mut plateau, mut end) = (T::zero(), sensor.range());
    for _ in 0..T::PRECISION {
        let middle = plateau + (end - plateau) * T::HALF;
        let is_flat = sensor.occupancy(middle) == sensor.occupancy(T::zero());
        if is_flat { plateau = middle } else { end = middle }
    }
    plateau
}

proptest! {
    #[test]
    fn the_plateau_is_that_of_the_occupancies(z in 1e-3_f64..1e3, ratio in 2.0_f64..4096.0) {
        let sensor = GaussianSensor::new(z, z / ratio).unwrap();
        prop_assert_eq!(sensor.plateau(), halved(&sensor));
        let sensor = GaussianSensor::new(z as f32, (z / ratio) as f32).unwrap();
        prop_assert_eq!(sensor.plateau(), halved(&sensor));
    }
}

/// Up to the last float or so at the occupancy of the sensor's own place.
#[test]
fn the_plateau_ends_where_the_occupancy_changes() {
    for (z, sigma) in [(2.0_f64, 0.01), (7.0, 0.125), (3.0, 1e9)] {
        let sensor = GaussianSensor::new(z, sigma).unwrap();
        let plateau = sensor.plateau();
        assert!(0.25 * z < plateau && plateau < z, "{plateau}");
        assert_eq!(sensor.occupancy(plateau), sensor.occupancy(0.0));
        // To 53 halvings of the range.
        let beyond = plateau + 4.0 * z * f64::EPSILON;
        assert!(beyond >= z || sensor.occupancy(beyond) != sensor.occupancy(0.0), "{plateau}");
    }
    // The smallest numbers, and single precision.
    for (z, sigma) in [(1e-300, 1e-303), (3e-308, 5e-310), (4e-321, 5e-323)] {
        let sensor = GaussianSensor::new(z, sigma).unwrap();
        assert_eq!(sensor.plateau(), halved(&sensor), "{z:e}");
    }
    let sensor = GaussianSensor::new(7.0_f32, 0.125).unwrap();
    assert_eq!(sensor.plateau(), halved(&sensor));
    // Nothing before the sensor: the whole obstacle.
    let touching = SteppedSensor::new(0.25_f64, 0.5, 0.125, 0.875).unwrap();
    assert_eq!((touching.occupancy(0.0), touching.plateau()), (0.875, 0.5));
    let steps = SteppedSensor::new(3.0_f64, 0.5, 0.125, 0.875).unwrap();
    assert_eq!(steps.plateau(), 2.75_f64.next_down());
}

proptest! {
    /// The models are at most `p` up to where they say, by their own word at many distances, and say it late enough to be of use.
    #[test]
    fn free_space_is_at_most_as_occupied_as_asked(z in 0.05_f64..50.0, sigma in 0.001_f64..0.5, p in 1e-12_f64..0.49, part in 0.0_f64..1.0) {
        fn check<T: Real>(z: T, sigma: T, p: T, part: T) -> Result<(), TestCaseError> {
            let sensor = GaussianSensor::new(z, sigma)?;
            let edge = sensor.free_until(p);
            prop_assert!(edge >= T::zero() && edge < z);
            prop_assert!(edge.is_zero() || (sensor.occupancy(edge) <= p && sensor.occupancy(edge * part) <= p));
            let beyond = edge + (z + sigma) * T::from_parts(64, 0) * T::epsilon();
            prop_assert!(sensor.occupancy(beyond) > p || sensor.occupancy(T::zero()) > p, "{:?}", edge);
            Ok(())
        }
        check(z, sigma, p, part)?;
        check(z as f32, sigma as f32, p as f32, part as f32)?;
    }

    #[test]
    fn an_obstacle_is_one_occupancy(range in 0.05_f64..5.0, thickness in 0.01_f64..2.0, part in 0.0_f64..1.0) {
        let sensor = SteppedSensor::new(range, thickness, 0.25, 0.875)?;
        let ([near, far], p) = sensor.obstacle().expect("a wall");
        for rho in [near, far, near + part * (far - near)] {
            prop_assert_eq!(sensor.occupancy(rho), p);
        }
        prop_assert_eq!((far, sensor.occupancy(near.next_down())), (sensor.reach(), 0.25));
        prop_assert_eq!(GaussianSensor::new(range, thickness)?.obstacle(), None);
    }
}
