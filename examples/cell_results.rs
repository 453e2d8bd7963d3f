//! A filter for checks by other tools: reads floats, little-endian, and writes the results of one function for them.
//!
//!     cell_results entropy_from_log_odds f32 < arguments > results
//!
//! Both streams hold nothing but floats of the given format; `proofs/random_check.py` compares them with MPFR.

use mean_information::Real;
use mean_information::cell::{
    entropy, entropy_from_log_odds, information, information_from_log_odds, occupancy_from_log_odds,
};
use std::env;
use std::error::Error;
use std::io::{self, Read, Write};

fn function<T: Real>(name: &str) -> Result<fn(T) -> T, String> {
    Ok(match name {
        "entropy" => entropy,
        "information" => information,
        "entropy_from_log_odds" => entropy_from_log_odds,
        "information_from_log_odds" => information_from_log_odds,
        "occupancy_from_log_odds" => occupancy_from_log_odds,
        _ => return Err(format!("no function `{name}`")),
    })
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [name, format] = &arguments[..] else {
        return Err("usage: cell_results FUNCTION f32|f64".into());
    };
    let (mut input, mut output) = (Vec::new(), Vec::new());
    io::stdin().lock().read_to_end(&mut input)?;
    match format.as_str() {
        "f32" => {
            let f = function::<f32>(name)?;
            for bytes in input.as_chunks().0 {
                output.extend(f(f32::from_le_bytes(*bytes)).to_le_bytes());
            }
        }
        "f64" => {
            let f = function::<f64>(name)?;
            for bytes in input.as_chunks().0 {
                output.extend(f(f64::from_le_bytes(*bytes)).to_le_bytes());
            }
        }
        _ => return Err(format!("no format `{format}`").into()),
    }
    io::stdout().lock().write_all(&output)?;
    Ok(())
}
