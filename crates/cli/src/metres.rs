//! Lengths as the command line takes them.

use mean_information::Real;
use mean_information_report::hex_float;
use std::str::FromStr;

/// Reads a positive, finite number of metres: decimal, or a hexadecimal float for exactly that number.
pub(crate) fn positive<T: Real + FromStr>(text: &str) -> Result<T, String> {
    let number: T = if text.to_ascii_lowercase().contains("0x") {
        hex_float::parse(text).map_err(|error| error.to_string())?
    } else {
        text.parse().map_err(|_| "not a number".to_owned())?
    };
    if number > T::zero() && number.is_finite() {
        Ok(number)
    } else {
        Err("not positive and finite".to_owned())
    }
}
