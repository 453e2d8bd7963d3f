//! What a file of vectors may hold in its places. What is read as one of these types makes sense; anything else is
//! refused with its value and what is allowed.

use super::exact::Exact;
use mean_information::Real;
use mean_information_report::hex_float;
use mean_information_report::protocol::errors;
use serde::{Deserialize, Deserializer, de};
use serde_json::Value as Json;
use std::fmt;

/// The largest tolerance, in ulp: half of the digits of `f64`. A larger one promises nothing.
pub const MAX_TOLERANCE: f64 = 67_108_864.0;
/// The largest absolute error that a port may claim, in bits: a thousandth of what a cell can hold.
pub const MAX_ABSOLUTE: f64 = 0.001;
/// The tolerance that means the nearest float.
pub const NEAREST: f64 = 0.5;

/// The version of the form of these files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(try_from = "u64")]
pub struct Version;

impl Version {
    /// The one that is read.
    pub const NUMBER: u64 = 1;
}

impl TryFrom<u64> for Version {
    type Error = String;

    fn try_from(version: u64) -> Result<Self, String> {
        let refused =
            || format!("version {version} is not known: this program reads version {}", Self::NUMBER);
        (version == Self::NUMBER).then_some(Self).ok_or_else(refused)
    }
}

/// The format of floats of arguments and answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FloatFormat {
    /// Single precision.
    F32,
    /// Double precision.
    F64,
}

impl FloatFormat {
    /// Returns its name in the protocol.
    pub fn name(self) -> &'static str {
        match self {
            Self::F32 => f32::FORMAT,
            Self::F64 => f64::FORMAT,
        }
    }
}

impl fmt::Display for FloatFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Reads how far an answer may be off, in ulp.
pub(super) fn tolerance<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let ulp = f64::deserialize(deserializer)?;
    let allowed = ulp == 0.0 || (NEAREST..=MAX_TOLERANCE).contains(&ulp);
    let refused = || format!("a tolerance of {ulp} ulp: it is 0, or {NEAREST} to {MAX_TOLERANCE}");
    allowed.then_some(ulp).ok_or_else(|| de::Error::custom(refused()))
}

/// Reads a tolerance whose key may be absent.
pub(super) fn some_tolerance<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    tolerance(deserializer).map(Some)
}

/// A decimal, as it is written and as a number.
#[derive(Clone, Debug, PartialEq)]
pub struct Decimal {
    /// The text as it was written.
    pub text: String,
    pub(super) value: Exact,
}

impl<'de> Deserialize<'de> for Decimal {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        let refused = || format!("\"{text}\" is no decimal such as \"1.25e-3\"");
        let value = Exact::decimal(&text).ok_or_else(|| de::Error::custom(refused()))?;
        Ok(Self { text, value })
    }
}

/// A right answer.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(try_from = "Fields")]
pub enum Want {
    /// The exact result lies between these decimals.
    Enclosure {
        /// The lower end.
        lo: Decimal,
        /// The upper end, not below the lower one.
        hi: Decimal,
    },
    /// The error `domain`.
    Domain,
    /// The count.
    Count(u64),
}

/// The keys of a right answer.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Fields {
    lo: Option<Decimal>,
    hi: Option<Decimal>,
    error: Option<String>,
    count: Option<u64>,
}

impl TryFrom<Fields> for Want {
    type Error = String;

    fn try_from(fields: Fields) -> Result<Self, String> {
        match (fields.lo, fields.hi, fields.error, fields.count) {
            (Some(lo), Some(hi), None, None) if lo.value.cmp(&hi.value).is_gt() => {
                Err(format!("an enclosure that holds nothing: from {} down to {}", lo.text, hi.text))
            }
            (Some(lo), Some(hi), None, None) => Ok(Self::Enclosure { lo, hi }),
            (None, None, Some(word), None) if word == errors::DOMAIN => Ok(Self::Domain),
            (None, None, Some(word), None) => {
                Err(format!("the error \"{word}\" is not wanted of any port: only \"{}\"", errors::DOMAIN))
            }
            (None, None, None, Some(count)) => Ok(Self::Count(count)),
            _ => Err("a wanted answer has either lo and hi, or error, or count".to_owned()),
        }
    }
}

/// The answer of a known mistake.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(try_from = "Json")]
pub enum Trap {
    /// A count.
    Count(u64),
    /// A float.
    Float(f64),
}

impl TryFrom<Json> for Trap {
    type Error = String;

    fn try_from(value: Json) -> Result<Self, String> {
        let float = value.as_str().and_then(|text| hex_float::parse(text).ok());
        let trap = value.as_u64().map(Self::Count).or(float.map(Self::Float));
        trap.ok_or_else(|| format!("the trap {value} is neither a hexadecimal float in a string nor a count"))
    }
}
