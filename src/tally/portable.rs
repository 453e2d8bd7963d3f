//! A tally as text, so that it can travel between machines and be merged there (feature `serde`).
//!
//! The sums are written as hexadecimal integers in units of `2^-1074`: exact, and readable in any language with big
//! integers. Reading refuses counts that overflow, sums above 1 bit per cell, an entropy below that of the unknown cells, and
//! sums that are no multiple of the smallest number of the format.

use super::{ExactSum, Tally};
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
        for (limb, part) in sum.limbs.iter_mut().zip(digits.as_bytes().rchunks(16)) {
            *limb = part
                .iter()
                .fold(0, |value, &b| value << 4 | u64::from(char::from(b).to_digit(16).unwrap_or(0)));
        }
        Ok(sum)
    }
}

/// The fields of a tally, as they travel.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Portable {
    format: String,
    entropy: ExactSum,
    information: ExactSum,
    unknown: u64,
    free: u64,
    occupied: u64,
}

impl<T: Real> Serialize for Tally<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Portable {
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

impl<'de, T: Real> Deserialize<'de> for Tally<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Portable { format, entropy, information, unknown, free, occupied } =
            Portable::deserialize(deserializer)?;
        if format != T::FORMAT {
            return Err(D::Error::custom(format_args!("a tally of {format} cells, wanted is {}", T::FORMAT)));
        }
        let observed = free.checked_add(occupied);
        let Some((observed, cells)) =
            observed.and_then(|observed| Some((observed, observed.checked_add(unknown)?)))
        else {
            return Err(D::Error::custom("a tally holds at most 2^64 - 1 cells"));
        };
        if information.compare(observed).is_gt()
            || entropy.compare(cells).is_gt()
            || entropy.compare(unknown).is_lt()
        {
            return Err(D::Error::custom(
                "the sums of a tally are at most 1 bit per cell, and an unknown cell has an entropy of 1 bit",
            ));
        }
        if [&entropy, &information].iter().any(|sum| !sum.is_multiple_of_power(T::MIN_EXPONENT)) {
            return Err(D::Error::custom(format_args!("the sums are no sums of numbers of {format}")));
        }
        Ok(Self { entropy, information, unknown, free, occupied, format: PhantomData })
    }
}
