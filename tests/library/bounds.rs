//! The proved bounds between grids and their limits, on rooms of every kind.

use super::common::power;
use approx::abs_diff_eq;
use mean_information::cell::entropy;
use mean_information::elementary::{exp, ln, sqrt};
use mean_information::limit::{Weight, bounds, closed_form};
use mean_information::room::{CartesianRoom, PolarRoom};
use mean_information::sensor::GaussianSensor;
use mean_information::{Error, Real};
use proptest::prelude::*;

/// `√(ln 4)`.
const B: f64 = 1.177_410_022_515_474_7;

/// `α` from 10^-3 to 10^5, cells from twice the room to 1/60 of it.
fn rooms() -> impl Strategy<Value = (f64, f64, f64)> {
    (0.3_f64..9.0, -3.0_f64..5.0, -0.6_f64..4.1).prop_map(|(z, alpha, cells)| {
        let sigma = z / exp(alpha * core::f64::consts::LN_10);
        (z, sigma, (z + B * sigma) / exp(cells))
    })
}

/// What a bound allows, and the error of the grid.
pub(crate) struct Outcome {
    pub(crate) error: f64,
    pub(crate) bound: f64,
    pub(crate) with_count: f64,
}

impl Outcome {
    fn holds(&self) -> Result<(), TestCaseError> {
        prop_assert!(self.error <= self.bound, "{} above {}", self.error, self.bound);
        prop_assert!(self.error <= self.with_count, "{} above {}", self.error, self.with_count);
        Ok(())
    }
}

/// A room as these bounds see it: its sensor, and the limit of a grid of it.
fn sensor<T: Real>(z: T, sigma: T, weight: Weight) -> Result<(GaussianSensor<T>, f64), Error> {
    // An ulp or two of f64 off, with the difference: below the rounding that the bound allows for.
    let wide = GaussianSensor::new(z.widen(), sigma.widen())?;
    Ok((GaussianSensor::new(z, sigma)?, closed_form(&wide, weight)))
}

/// The polar map of a room.
pub(crate) fn polar<T: Real>(z: T, sigma: T, h: T) -> Result<Outcome, Error> {
    let (sensor, limit) = sensor(z, sigma, Weight::Radial)?;
    let tally = PolarRoom::new(sensor, h)?.tally()?;
    Ok(Outcome {
        error: (tally.mean_information().widen() - limit).abs(),
        bound: bounds::polar(&sensor, h)?.widen(),
        with_count: bounds::polar_with_count(&sensor, h, tally.observed())?.widen(),
    })
}

/// The Cartesian grid of a room.
pub(crate) fn cartesian<T: Real>(z: T, sigma: T, h: T, offsets: [T; 2]) -> Result<Outcome, Error> {
    let (sensor, limit) = sensor(z, sigma, Weight::Area)?;
    let tally = CartesianRoom::new(sensor, h, offsets)?.tally()?;
    Ok(Outcome {
        error: (tally.mean_information().widen() - limit).abs(),
        bound: bounds::cartesian(&sensor, h)?.widen(),
        with_count: bounds::cartesian_with_count(&sensor, h, tally.observed())?.widen(),
    })
}

/// The polar and the Cartesian grid of one room.
fn outcomes<T: Real>(z: T, sigma: T, h: T, offsets: [T; 2]) -> Result<[Outcome; 2], Error> {
    Ok([polar(z, sigma, h)?, cartesian(z, sigma, h, offsets)?])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn every_grid_lies_within_its_bound_of_its_limit((z, sigma, h) in rooms(), x in -0.5_f64..=0.5, y in -0.5_f64..=0.5, corner in 0_u8..4) {
        let offsets = match corner { 0 => [0.0; 2], 1 => [0.5; 2], _ => [x, y] };
        for outcome in outcomes(z, sigma, h, offsets)? {
            outcome.holds()?;
        }
        for outcome in outcomes(z as f32, sigma as f32, h as f32, offsets.map(|x| x as f32))? {
            outcome.holds()?;
        }
    }

    /// The general form of the theorem that this one sharpens: Gauss's bound for points in a disc, and no second order.
    #[test]
    fn the_bounds_are_sharper_than_the_plain_ones((z, sigma, h) in rooms(), finer in 10_i32..40) {
        let h = h / f64::from(finer);
        let sensor = GaussianSensor::new(z, sigma)?;
        let [radial, area] = [Weight::Radial, Weight::Area].map(|weight| closed_form(&sensor, weight));
        let x = (z + B * sigma) / h;
        prop_assume!(x > 3.0);
        let free = 1.0 - entropy(exp(-(z / sigma) * (z / sigma) / 2.0));
        let variation = if z > B * sigma { 2.0 + free } else { 2.0 - free };
        let plain = f64::midpoint(variation, radial) / (x - 0.5);
        // One ring may lie where p is 1/2; almost never does one.
        prop_assert!(bounds::polar(&sensor, h)? <= plain * (1.0 + 1e-9));
        let error = core::f64::consts::PI * (sqrt(2.0) * x + 0.5);
        let plain = (variation + area) * error / (core::f64::consts::PI * x * x - error).max(0.0);
        prop_assert!(bounds::cartesian(&sensor, h)? <= plain);
    }

    /// Where cells are small beside the noise, an eighth of them gives an eighth of the polar bound and a sixteenth of the
    /// Cartesian one.
    #[test]
    fn the_bounds_fall_at_their_order(z in 0.3_f64..9.0, alpha in 1.2_f64..50.0) {
        let sensor = GaussianSensor::new(z, z / alpha)?;
        let h = z * (1.0 + B / alpha) / 1e5;
        let [coarse, fine] = [h, h / 8.0].map(|h| bounds::polar(&sensor, h).unwrap());
        prop_assert!(abs_diff_eq!(coarse / fine, 8.0, epsilon = 0.1), "{}", coarse / fine);
        let [coarse, fine] = [h, h / 8.0].map(|h| bounds::cartesian(&sensor, h).unwrap());
        prop_assert!(abs_diff_eq!(coarse / fine, 16.0, epsilon = 0.1), "{}", coarse / fine);
    }

    #[test]
    fn scaling_by_a_power_of_two_changes_no_bit((z, sigma, h) in rooms(), k in -300_i32..300, observed in 2_u64..1 << 40) {
        let of = |s: f64| {
            let sensor = GaussianSensor::new(z * s, sigma * s).unwrap();
            [
                bounds::polar(&sensor, h * s),
                bounds::cartesian(&sensor, h * s),
                bounds::polar_with_count(&sensor, h * s, observed),
                bounds::cartesian_with_count(&sensor, h * s, observed),
            ]
        };
        prop_assert_eq!(of(1.0), of(power(k)));
    }

    #[test]
    fn any_bits_give_a_bound_or_an_error(bits in any::<[u64; 3]>(), observed in any::<u64>()) {
        let [z, sigma, h] = bits.map(f64::from_bits);
        let Ok(sensor) = GaussianSensor::new(z.abs(), sigma.abs()) else { return Ok(()) };
        for bound in [
            bounds::polar(&sensor, h),
            bounds::cartesian(&sensor, h),
            bounds::polar_with_count(&sensor, h, observed),
            bounds::cartesian_with_count(&sensor, h, observed),
        ] {
            match bound {
                Ok(bound) => prop_assert!(0.0 < bound && bound <= 1.0),
                Err(_) => prop_assert!(!(h > 0.0 && h.is_finite())),
            }
        }
    }
}

/// Half a ring is all that a beam can gain or lose, and where rings are small beside the noise there is little else.
#[test]
fn the_polar_bound_is_attained() {
    let (z, sigma) = (2.0_f64, 0.25);
    let reach = z + B * sigma;
    for rings in [500.499_999, 500.500_001] {
        let [polar, _] = outcomes(z, sigma, reach / rings, [0.5; 2]).unwrap();
        polar.holds().unwrap();
        assert!(polar.error > 0.95 * polar.bound, "{} of {}", polar.error, polar.bound);
    }
}

/// A circle of cells at which `p` is 1/2 after rounding, and a ring: the count before counting allows for them.
#[test]
fn rooms_whose_inner_circle_is_hit() {
    // 6.5 cells: 2 rings of 4 cells each, on which the distance of (2.5, 6) is exact.
    let (z, sigma) = (2.0_f64, 0.5);
    let sensor = GaussianSensor::new(z, sigma).unwrap();
    let circle = z - sigma * B;
    for (h, offsets) in [(circle / 6.5, [0.5, 0.0]), (circle / 5.0, [0.0, 0.0]), (circle / 32.5, [0.5, 0.0])]
    {
        for h in [h, h * 1.000_000_1] {
            for outcome in outcomes(z, sigma, h, offsets).unwrap() {
                outcome.holds().unwrap();
            }
        }
        // The ring k with k + 1/2 = 6.5 or 32.5 is hit, as far as rounding can tell, and the one beside it is not.
        let [hit, missed] = [h, h * 1.000_000_1].map(|h| bounds::polar(&sensor, h).unwrap());
        assert_eq!(offsets[0] == 0.5, hit > missed * 1.01, "{hit} {missed}");
    }
}

#[test]
fn what_is_no_room_is_refused_with_its_reason() {
    let sensor = GaussianSensor::new(2.0_f64, 0.2).unwrap();
    let refused = bounds::polar(&sensor, 0.0).unwrap_err().to_string();
    assert_eq!(refused, "resolution is 0, allowed is positive and finite, in metres");
    assert!(bounds::cartesian(&sensor, f64::NAN).is_err());
    assert_eq!(bounds::cartesian(&sensor, 100.0), Ok(1.0));
    assert_eq!(bounds::polar_with_count(&sensor, 0.25, 0), Ok(1.0));
}

/// `cargo test --release -p mean-information --test library -- --ignored --nocapture largest_ratios`
#[test]
#[ignore = "prints how much of the bounds is used"]
fn largest_ratios() {
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    let mut uniform = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 * power(-53)
    };
    let mut largest = [[0.0_f64; 2]; 2];
    let mut means = [[0.0_f64; 2]; 2];
    for _ in 0..1000 {
        let z = 0.3 + 8.7 * uniform();
        let sigma = z / exp((-2.0 + 6.0 * uniform()) * core::f64::consts::LN_10);
        let h = (z + B * sigma) / exp(ln(3.0) + ln(100.0) * uniform());
        let offsets = [uniform() - 0.5, uniform() - 0.5];
        for (k, outcome) in outcomes(z, sigma, h, offsets).unwrap().iter().enumerate() {
            for (j, bound) in [outcome.bound, outcome.with_count].into_iter().enumerate() {
                let ratio = outcome.error / bound;
                largest[k][j] = largest[k][j].max(ratio);
                means[k][j] += ratio / 1000.0;
            }
        }
    }
    println!("polar, Cartesian; before and after counting: largest {largest:.3?}, mean {means:.3?}");
}
