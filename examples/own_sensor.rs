//! A sensor model of your own: on a grid, and in the limit of small cells, estimated and proved.
//! `cargo run --example own_sensor`.

use mean_information::Error;
use mean_information::limit::{Piece, RadialModel, Weight, adaptive, rigorous};
use mean_information::quadrature::{adaptive::GaussKronrod, rigorous::Rigorous};
use mean_information::room::{CartesianRoom, PolarRoom};
use mean_information::scalar::Scalar;
use mean_information::sensor::InverseSensorModel;

/// A sonar: free space becomes less certain with the distance, and the obstacle is somewhere in a stretch about the range.
struct Sonar {
    /// The range read, in metres.
    range: f64,
    /// The length of the stretch about the range, in metres.
    thickness: f64,
    /// The length over which free space loses most of its certainty, in metres.
    fading: f64,
    /// The occupancy over the thickness.
    occupied: f64,
}

impl Sonar {
    fn near(&self) -> f64 {
        self.range - 0.5 * self.thickness
    }

    /// Computes `p = 0.45 - 0.4 e^(-ρ / fading)`: 0.05 at the sensor.
    ///
    /// Of an `S: Scalar` this `exp` is correctly rounded; of a plain `f64` it would be the standard library's: there
    /// `Scalar::exp(x)`.
    fn free<S: Scalar>(&self, rho: S) -> S {
        S::constant(0.45) - S::constant(0.4) * (-rho / S::constant(self.fading)).exp()
    }
}

/// The model for grids: the occupancy at a distance.
impl InverseSensorModel for Sonar {
    type Float = f64;

    fn occupancy(&self, rho: f64) -> f64 {
        match rho {
            _ if rho < self.near() => self.free(rho),
            _ if rho <= self.reach() => self.occupied,
            _ => 0.5,
        }
    }

    fn reach(&self) -> f64 {
        self.range + 0.5 * self.thickness
    }
}

/// The model for integrals: the entropy along a beam, in smooth pieces, for any kind of number. Here `t` is the distance.
impl RadialModel for Sonar {
    type Float = f64;

    fn origin(&self) -> f64 {
        0.0
    }

    fn scale(&self) -> f64 {
        1.0
    }

    fn pieces<S: Scalar>(&self) -> Vec<Piece<S>> {
        let piece = |from, to| Piece::new(S::constant(from), S::constant(to) - S::constant(from), 1);
        vec![piece(0.0, self.near()), piece(self.near(), self.reach())]
    }

    fn entropy<S: Scalar>(&self, piece: usize, rho: S) -> S {
        let p = if piece == 0 { self.free(rho) } else { S::constant(self.occupied) };
        p.entropy()
    }
}

fn main() -> Result<(), Error> {
    let sonar = || Sonar { range: 3.0, thickness: 0.4, fading: 2.5, occupied: 0.8 };
    for (weight, name) in [(Weight::Radial, "polar"), (Weight::Area, "Cartesian")] {
        let estimate = adaptive(&sonar(), weight, &GaussKronrod::new())?;
        let enclosure = rigorous(&sonar(), weight, &Rigorous::default())?;
        assert!((estimate.value - enclosure.lower).abs() <= estimate.error);
        println!("{name}: estimated {} ± {:.1e}", estimate.value, estimate.error);
        println!("{name}: proved    {} to {}", enclosure.lower, enclosure.upper);
        for cell in [0.16, 0.04, 0.01] {
            let tally = if weight == Weight::Radial {
                PolarRoom::new(sonar(), cell)?.tally()?
            } else {
                CartesianRoom::new(sonar(), cell, [0.5, 0.5])?.tally()?
            };
            println!("    cells of {cell:4} m: {}", tally.mean_information());
        }
    }
    Ok(())
}

/// The limits that the integrals prove are those of grids.
#[test]
fn the_examples_numbers_agree() {
    main().unwrap();
}
