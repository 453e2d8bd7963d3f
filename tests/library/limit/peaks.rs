//! Narrow peaks of a radial model of one's own: alone in a piece, and beside another peak.

use mean_information::estimate::Status;
use mean_information::limit::{Piece, RadialModel, Weight, adaptive, rigorous};
use mean_information::quadrature::adaptive::{GaussKronrod, Rule};
use mean_information::quadrature::rigorous::Rigorous;
use mean_information::scalar::Scalar;

/// A Gaussian room in metres, as one piece, from the sensor to so far: all of it in `ρ`.
struct InMetres {
    range: f64,
    sigma: f64,
    end: f64,
}

impl RadialModel for InMetres {
    type Float = f64;

    fn origin(&self) -> f64 {
        0.0
    }

    fn scale(&self) -> f64 {
        1.0
    }

    fn pieces<S: Scalar>(&self) -> Vec<Piece<S>> {
        vec![Piece::new(S::constant(0.0), S::constant(self.end), 1)]
    }

    fn entropy<S: Scalar>(&self, _: usize, rho: S) -> S {
        let t = (rho - S::constant(self.range)) / S::constant(self.sigma);
        (S::constant(-0.5) * t.square()).entropy_from_log_occupancy()
    }
}

/// Two peaks, broad and narrow, in one piece or in two: from 0 to 1200, cut at the narrow one.
struct TwoPeaks {
    is_cut: bool,
}

impl RadialModel for TwoPeaks {
    type Float = f64;

    fn origin(&self) -> f64 {
        0.0
    }

    fn scale(&self) -> f64 {
        1.0
    }

    fn pieces<S: Scalar>(&self) -> Vec<Piece<S>> {
        let piece = |start, length, panels| Piece::new(S::constant(start), S::constant(length), panels);
        if self.is_cut {
            // 8^-8 of the length is below the width of the peak.
            vec![piece(1000.25, -1000.25, 8), piece(1000.25, 199.75, 8)]
        } else {
            vec![piece(0.0, 1200.0, 1)]
        }
    }

    fn entropy<S: Scalar>(&self, _: usize, t: S) -> S {
        let peak = |at, width| {
            let t = (t.clone() - S::constant(at)) / S::constant(width);
            S::constant(0.375) * (S::constant(-0.5) * t.square()).exp()
        };
        peak(300.0, 10.0) + peak(1000.25, 0.001)
    }
}

/// Beside another peak a narrow one is seen if a piece starts there, and, as the documentation says, not otherwise.
#[test]
fn a_second_peak_needs_a_piece_of_its_own() {
    let model = |is_cut| TwoPeaks { is_cut };
    let enclosure = rigorous(&model(true), Weight::Radial, &Rigorous::default()).unwrap();
    let is_missed = |is_cut| {
        let settings = GaussKronrod::new().relative(1e-9);
        let estimate = adaptive(&model(is_cut), Weight::Radial, &settings).unwrap();
        assert_eq!(estimate.status, Status::Converged);
        (estimate.value - enclosure.lower).abs() > estimate.error + enclosure.width()
    };
    assert!(!is_missed(true) && is_missed(false));
}

/// A peak at the end of a piece, and one inside.
#[test]
fn a_narrow_peak_in_metres_is_seen() {
    for (range, sigma, end) in [
        (1000.0, 0.001, 1000.001),
        (1000.0, 0.001, 1500.0),
        (1000.0, 1e-6, 1500.0),
        (0.25, 1e-5, 40.0),
        (39.9, 1e-5, 40.0),
    ] {
        let model = InMetres { range, sigma, end };
        let enclosure = rigorous(&model, Weight::Radial, &Rigorous::default()).unwrap();
        for &rule in Rule::ALL {
            let estimate = adaptive(&model, Weight::Radial, &GaussKronrod::new().rule(rule)).unwrap();
            let error =
                (estimate.value - enclosure.lower).abs().max((estimate.value - enclosure.upper).abs());
            let context = format!("{range}, {sigma}, {end}, {rule:?}: {estimate:?}, {enclosure:?}");
            assert!(error <= estimate.error + enclosure.width() && estimate.value < 1.0, "{context}");
            assert!(estimate.error < 1e-11, "{context}");
        }
    }
    // Too few evaluations to look again: the error is the bound by the range.
    let model = InMetres { range: 1000.0, sigma: 0.001, end: 1500.0 };
    let few = adaptive(&model, Weight::Radial, &GaussKronrod::new().limit(60)).unwrap();
    assert!(few.status == Status::AllZero && few.error >= 0.5 && few.evaluations <= 60, "{few:?}");
}
