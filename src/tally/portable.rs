//! Tallies as text, so that they can travel between machines and be merged there (feature `serde`).
//!
//! The sums are written as hexadecimal integers in units of `2^-1074`: exact, and readable in any language with big
//! integers. Reading refuses what no cells have, as reading their [bytes](Tally::from_bytes) does.

use super::checked::{check_format, check_information, total};
use super::exact_sum::ExactSum;
use super::information_sum::InformationSum;
use super::map_tally::Tally;
use crate::real::Real;
use alloc::string::{String, ToString};
use core::fmt::Write;
use core::marker::PhantomData;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

impl Serialize for ExactSum {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut digits = String::new();
        for limb in self.limbs.iter().rev() {
            write!(digits, "{limb:016x}").expect("a string can be written to");
        }
        // The highest limb first: one hexadecimal integer in units of 2^-1074.
        let digits = digits.trim_start_matches('0');
        serializer.serialize_str(if digits.is_empty() { "0" } else { digits })
    }
}

impl<'de> Deserialize<'de> for ExactSum {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let digits = String::deserialize(deserializer)?;
        let mut sum = Self::new();
        if digits.is_empty()
            || digits.len() > 16 * sum.limbs.len()
            || digits.bytes().any(|b| !b.is_ascii_hexdigit())
        {
            let allowed = 16 * sum.limbs.len();
            return Err(D::Error::custom(format_args!(
                "a sum is 1 to {allowed} hexadecimal digits, not {digits:?}"
            )));
        }
        // From the last 16 digits on, the lowest limb first.
        for (limb, part) in sum.limbs.iter_mut().zip(digits.as_bytes().rchunks(16)) {
            *limb = part
                .iter()
                .fold(0, |value, &b| value << 4 | u64::from(char::from(b).to_digit(16).unwrap_or(0)));
        }
        Ok(sum)
    }
}

/// The serialized fields of a tally.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct PortableTally {
    format: String,
    entropy: ExactSum,
    information: ExactSum,
    unknown: u64,
    free: u64,
    occupied: u64,
}

/// The serialized fields of a sum of information.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct PortableInformationSum {
    format: String,
    information: ExactSum,
    unknown: u64,
    observed: u64,
}

impl<T: Real> Serialize for Tally<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        PortableTally {
            format: T::FORMAT.to_string(),
            entropy: self.entropy.clone(),
            information: self.information.clone(),
            unknown: self.unknown,
            free: self.free,
            occupied: self.occupied,
        }
        .serialize(serializer)
    }
}

impl<T: Real> Serialize for InformationSum<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        PortableInformationSum {
            format: T::FORMAT.to_string(),
            information: self.sum.clone(),
            unknown: self.unknown,
            observed: self.observed,
        }
        .serialize(serializer)
    }
}

impl<'de, T: Real> Deserialize<'de> for Tally<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let PortableTally { format, entropy, information, unknown, free, occupied } =
            PortableTally::deserialize(deserializer)?;
        require_format::<T, _>(&format)?;
        Self::from_parts([entropy, information], [unknown, free, occupied]).map_err(D::Error::custom)
    }
}

impl<'de, T: Real> Deserialize<'de> for InformationSum<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let PortableInformationSum { format, information, unknown, observed } =
            PortableInformationSum::deserialize(deserializer)?;
        require_format::<T, _>(&format)?;
        let refused = |error: crate::error::Error| D::Error::custom(error);
        total(observed, unknown).map_err(refused)?;
        check_information(&information, observed).map_err(refused)?;
        check_format::<T>("information of the tally", &information).map_err(refused)?;
        Ok(Self { sum: information, unknown, observed, format: PhantomData })
    }
}

/// Refuses a tally of another format than `T`.
fn require_format<T: Real, E: Error>(format: &str) -> Result<(), E> {
    if format == T::FORMAT {
        Ok(())
    } else {
        Err(E::custom(format_args!("a tally of {format} cells, wanted is {}", T::FORMAT)))
    }
}
