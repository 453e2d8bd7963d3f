//! What integrals of a function have to do with those of its scaled, mirrored and cut ones.

use super::super::common::power;
use super::{any_rule, peak};
use approx::abs_diff_eq;
use mean_information::quadrature::adaptive::GaussKronrod;
use proptest::prelude::*;

proptest! {
    /// Scaling the argument or the value by a power of two changes no digit.
    #[test]
    fn scaling_by_a_power_of_two_scales(
        a in -3.0_f64..0.3, b in 0.6_f64..4.0, s in -300_i32..300, v in -300_i32..300, rule in any_rule(),
    ) {
        let settings = GaussKronrod::new().rule(rule).relative(1e-9);
        let plain = settings.integrate_between(peak, &[a, 0.3, b])?;
        let [x, y] = [power(s), power(v)];
        let scaled = settings.integrate_between(|t| y * peak(t / x), &[a * x, 0.3 * x, b * x])?;
        prop_assert_eq!(scaled.value, plain.value * x * y);
        // But for the spacing of subnormal numbers that every claim covers.
        prop_assert!(abs_diff_eq!(scaled.error, plain.error * x * y, epsilon = 1e-9 * scaled.error));
        prop_assert_eq!(scaled.evaluations, plain.evaluations);
    }

    #[test]
    fn reversed_ends_reverse_the_sign_and_mirrored_ones_nothing(
        a in -3.0_f64..4.0, b in -3.0_f64..4.0, rule in any_rule(),
    ) {
        let settings = GaussKronrod::new().rule(rule).relative(1e-9);
        let forth = settings.integrate(peak, a, b)?;
        let back = settings.integrate(peak, b, a)?;
        prop_assert_eq!((back.value, back.error, back.evaluations), (-forth.value, forth.error, forth.evaluations));
        let mirrored = settings.integrate(|x| peak(-x), -b, -a)?;
        prop_assert!((mirrored.value - forth.value).abs() <= mirrored.error + forth.error);
    }

    /// The parts make the whole, within the claims.
    #[test]
    fn the_integral_is_additive(a in -3.0_f64..0.0, share in 0.0_f64..=1.0, b in 1.0_f64..4.0, rule in any_rule()) {
        let settings = GaussKronrod::new().rule(rule).relative(1e-9);
        let middle = a + share * (b - a);
        let whole = settings.integrate(peak, a, b)?;
        let cut = settings.integrate_between(peak, &[a, middle, middle, b])?;
        let parts = [settings.integrate(peak, a, middle)?, settings.integrate(peak, middle, b)?];
        let sum = parts[0].value + parts[1].value;
        let slack = parts[0].error + parts[1].error + f64::EPSILON * sum;
        prop_assert!((whole.value - sum).abs() <= whole.error + slack);
        prop_assert!((cut.value - sum).abs() <= cut.error + slack);
    }
}
