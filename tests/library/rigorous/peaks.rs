//! Peaks inside wide intervals, and that what converged without a survey costs no more with one.

use super::{Logistic, Witch, integrand, number};
use mean_information::estimate::{Enclosure, Status};
use mean_information::quadrature::rigorous::Rigorous;
use mean_information::scalar::{Integrand, Scalar};

/// `e^(-(x - at)^2 / 2)`, by `square` or by a product, whose factors count as independent.
struct Gaussian {
    at: f64,
    by_square: bool,
}
impl Integrand for Gaussian {
    fn evaluate<S: Scalar>(&self, x: S) -> S {
        let t = x - number(self.at);
        let square = if self.by_square { t.clone().square() } else { t.clone() * t };
        (number::<S>(-0.5) * square).exp()
    }
}

/// `√(2π)`, between two decimals.
const ROOT: [f64; 2] = [2.506_628_274_631, 2.506_628_274_631_001];

/// The goal: a relative width of 1e-12 on ±10^k, wherever the peak is, by at most 5000 evaluations at `k = 3`, and as
/// many more for each factor of 10 as halvings take.
#[test]
fn a_peak_anywhere_in_a_wide_interval() {
    for by_square in [true, false] {
        for k in 2..=9 {
            let half = f64::from(10_u32.pow(k));
            let mut most = 0;
            for place in [0.0, 0.3, -0.7, 0.123_456_789, 0.9, -0.85, 1e-3] {
                let peak = Gaussian { at: place * half, by_square };
                let integral = Rigorous::<f64>::new().relative(1e-12).integrate(&peak, -half, half).unwrap();
                assert_eq!(integral.status, Status::Converged, "{place}, {k}: {integral:?}");
                assert!(integral.lower <= ROOT[1] && ROOT[0] <= integral.upper, "{place}, {k}: {integral:?}");
                assert!(integral.width() <= 1e-12 * ROOT[1], "{place}, {k}: {integral:?}");
                most = integral.evaluations.max(most);
            }
            println!("±1e{k}, by square {by_square}: at most {most}");
            // 3.3 halvings on either side, each a range in the survey and a panel with two rectangles in the sum.
            assert!(most <= 400 + 60 * u64::from(k), "±1e{k}: {most}");
        }
    }
}

/// Many integrands by few evaluations.
#[test]
fn narrow_peaks_by_dependent_factors() {
    integrand!(Narrow, x => {
        let t = x - number(0.3125);
        (number::<S>(-1000.0) * t.clone() * t).exp()
    });
    for half in [2.0, 20.0, 37.0, 1e6] {
        let integral = Rigorous::<f64>::new().relative(1e-12).integrate(&Narrow, -half, half).unwrap();
        assert!(integral.contains(0.056_049_912_163_979_29), "{half}: {integral:?}"); // √(π/1000)
        assert!(integral.status == Status::Converged && integral.evaluations < 1000, "{half}: {integral:?}");
    }
}

/// Evaluations at 1e-3 and at 1e-12 before there was a survey (of a Gauss sum that had seen nothing the tolerance was
/// made), and ranges over middle halves: none takes an eighth more.
#[test]
fn what_converged_is_no_slower() {
    integrand!(Spike, x => number::<S>(1.0) / (number::<S>(9.5367431640625e-7) + x.clone() * x));
    integrand!(Odd, x => x.clone() * (-(x.clone() * x)).exp());
    integrand!(Eta, x => (number::<S>(-0.5) * x.clone() * x).exp().entropy());
    integrand!(LogOdds, x => x.entropy_from_log_odds());
    integrand!(Root, x => x.sqrt());
    let mut slower = Vec::new();
    let mut check = |name: &str, before: [u64; 2], integrate: &dyn Fn(f64) -> Enclosure<f64>| {
        for (relative, before) in [1e-3, 1e-12].into_iter().zip(before) {
            let integral = integrate(relative);
            assert_eq!(integral.status, Status::Converged, "{name}: {integral:?}");
            if integral.evaluations * 8 > before * 9 {
                slower.push(format!("{name} to {relative:e}: {} instead of {before}", integral.evaluations));
            }
        }
    };
    let rule = |relative| Rigorous::<f64>::new().relative(relative);
    check("1/(1 + x²) from -3", [96, 201], &|t| rule(t).integrate(&Witch, -3.0, 5.0).unwrap());
    check("1/(1 + x²) on ±1000", [482, 714], &|t| rule(t).integrate(&Witch, -1e3, 1e3).unwrap());
    check("1/(1 + x²) on ±10^6", [1056, 1533], &|t| rule(t).integrate(&Witch, -1e6, 1e6).unwrap());
    check("spike", [482, 714], &|t| rule(t).integrate(&Spike, -1.0, 1.0).unwrap());
    check("spike, askew", [392, 795], &|t| rule(t).integrate(&Spike, -1.0, 0.7).unwrap());
    check("logistic", [95, 198], &|t| rule(t).integrate(&Logistic, 0.0, 3.0).unwrap());
    check("logistic, wide", [157, 420], &|t| rule(t).integrate(&Logistic, -300.0, 300.0).unwrap());
    check("odd", [94, 60], &|t| rule(t).integrate(&Odd, -3.0, 4.0).unwrap());
    check("entropy of t", [422, 1064], &|t| rule(t).integrate(&Eta, -10.0, 10.0).unwrap());
    check("entropy of t, wide", [377, 998], &|t| rule(t).integrate(&Eta, -3.0, 1000.0).unwrap());
    check("log-odds", [342, 564], &|t| rule(t).integrate(&LogOdds, -3200.0, 325.0).unwrap());
    check("root", [163, 515], &|t| rule(t).integrate(&Root, 0.0, 2.5).unwrap());
    assert!(slower.is_empty(), "{}", slower.join("\n"));
}

/// `∫ -p ln p dp` from 0 to 1 is 1/4: as a product it has no bound at 0, as one function it has.
#[test]
fn minus_p_ln_p_converges() {
    integrand!(Term, p => -p.x_ln_x());
    for relative in [1e-3, 1e-12] {
        let quarter = Rigorous::<f64>::new().relative(relative).integrate(&Term, 0.0, 1.0).unwrap();
        assert_eq!(quarter.status, Status::Converged);
        assert!(quarter.contains(0.25) && quarter.width() <= relative && quarter.evaluations < 1000);
    }
}
