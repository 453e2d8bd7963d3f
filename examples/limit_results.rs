//! A filter for checks by other tools: reads pairs of floats, little-endian, range and sigma, and writes both limits of each.
//!
//!     limit_results f32 < rooms > results
//!
//! Both streams hold nothing but floats of the given format; `proofs/limit_check.py` compares them with Arb.

use mean_information::Real;
use mean_information::limit::{Weight, closed_form};
use mean_information::sensor::GaussianSensor;
use std::env;
use std::error::Error;
use std::io::{self, Read, Write};

/// Computes the radial limit and the area limit.
fn limits<T: Real>(range: T, sigma: T) -> Result<[T; 2], mean_information::Error> {
    let sensor = GaussianSensor::new(range, sigma)?;
    Ok([Weight::Radial, Weight::Area].map(|weight| closed_form(&sensor, weight)))
}

fn main() -> Result<(), Box<dyn Error>> {
    let format = env::args().nth(1).unwrap_or_default();
    let (mut input, mut output) = (Vec::new(), Vec::new());
    io::stdin().lock().read_to_end(&mut input)?;
    match format.as_str() {
        "f32" => {
            for [range, sigma] in input.as_chunks::<4>().0.as_chunks().0 {
                let results = limits(f32::from_le_bytes(*range), f32::from_le_bytes(*sigma))?;
                output.extend(results.iter().flat_map(|result| result.to_le_bytes()));
            }
        }
        "f64" => {
            for [range, sigma] in input.as_chunks::<8>().0.as_chunks().0 {
                let results = limits(f64::from_le_bytes(*range), f64::from_le_bytes(*sigma))?;
                output.extend(results.iter().flat_map(|result| result.to_le_bytes()));
            }
        }
        _ => return Err("usage: limit_results f32|f64".into()),
    }
    Ok(io::stdout().lock().write_all(&output)?)
}
