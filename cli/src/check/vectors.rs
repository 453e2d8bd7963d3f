//! The vectors as they are written: `vectors/README.md`.

use super::exact::Exact;
use crate::failure::Failure;
use crate::hex_float;
use crate::maps::Problem;
use crate::protocol::{Argument, Arguments};
use mean_information::Real;
use mean_information::vectors::FILES;
use serde::{Deserialize, Deserializer};
use std::collections::{BTreeMap, HashSet};
use std::fs;
use std::path::Path;

/// The file of the registry, which lies beside those of the operations.
const REGISTRY: &str = "operations.json";

/// The tests of one operation.
#[derive(Clone, Debug, Deserialize)]
pub struct Vectors {
    /// The operation.
    pub op: String,
    /// How far an answer may be off; 0.5 means the nearest float.
    pub tolerance_ulp: f64,
    /// What a test with a flag is about, by the name of the flag.
    pub flags: BTreeMap<String, String>,
    /// What an implementation did whose answer is that of a trap, by the name of the trap.
    #[serde(default)]
    pub traps: BTreeMap<String, String>,
    /// In the order of the file.
    pub tests: Vec<Test>,
}

/// One test.
#[derive(Clone, Debug, Deserialize)]
pub struct Test {
    /// Means this test for ever.
    pub id: String,
    /// `f32` or `f64`.
    pub format: String,
    /// By name.
    pub args: Arguments,
    /// The right answer.
    pub want: Want,
    /// Other answers that are as right.
    #[serde(default)]
    pub also: Vec<Want>,
    /// A larger tolerance than that of the file.
    pub tolerance_ulp: Option<f64>,
    /// Names of what it is about.
    #[serde(default)]
    pub flags: Vec<String>,
    /// What known mistakes answer.
    #[serde(default)]
    pub traps: BTreeMap<String, Trap>,
}

/// A right answer.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum Want {
    /// The exact result lies between these decimals.
    Enclosure {
        /// The lower end.
        lo: Decimal,
        /// The upper end.
        hi: Decimal,
    },
    /// The error of this name: `domain`.
    Error {
        /// Its name.
        error: String,
    },
    /// So many.
    Count {
        /// The number.
        count: u64,
    },
}

/// A decimal, as it is written and as a number.
#[derive(Clone, Debug, PartialEq)]
pub struct Decimal {
    /// Its digits.
    pub text: String,
    pub(super) value: Exact,
}

impl<'de> Deserialize<'de> for Decimal {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        let value = Exact::decimal(&text);
        let value = value.ok_or_else(|| serde::de::Error::custom(format!("{text} is not a decimal")))?;
        Ok(Self { text, value })
    }
}

/// What a mistake answers.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum Trap {
    /// A count.
    Count(u64),
    /// A hexadecimal float, or the name of an error.
    Text(String),
}

impl Vectors {
    /// Those this program was built with.
    ///
    /// # Errors
    /// None: a test reads them all.
    pub fn built_in() -> Result<Vec<Self>, Failure> {
        let parsed = FILES.iter().map(|(op, text)| Self::parse(text).map_err(|what| format!("{op}: {what}")));
        parsed.collect::<Result<_, _>>().and_then(checked).map_err(Failure::Vectors)
    }

    /// Those of the folder, in the order of their names.
    ///
    /// # Errors
    /// A folder or a file that cannot be read, or that holds something else.
    pub fn in_folder(folder: &Path) -> Result<Vec<Self>, Failure> {
        let unreadable = |e: std::io::Error| Problem::new(folder, format!("cannot be read: {e}"));
        let mut paths = Vec::new();
        for entry in fs::read_dir(folder).map_err(unreadable)? {
            let path = entry.map_err(unreadable)?.path();
            let named = |name: &str| path.file_name().is_some_and(|file| file == name);
            if path.extension().is_some_and(|extension| extension == "json") && !named(REGISTRY) {
                paths.push(path);
            }
        }
        paths.sort();
        if paths.is_empty() {
            return Err(Problem::new(folder, "holds no vectors; give a folder such as vectors/v1").into());
        }
        let mut all = Vec::new();
        for path in paths {
            let text =
                fs::read_to_string(&path).map_err(|e| Problem::new(&path, format!("cannot be read: {e}")))?;
            all.push(Self::parse(&text).map_err(|what| Problem::new(&path, what))?);
        }
        checked(all).map_err(|what| Problem::new(folder, what).into())
    }

    fn parse(text: &str) -> Result<Self, String> {
        let vectors: Self =
            serde_json::from_str(text).map_err(|e| format!("is not a file of vectors: {e}"))?;
        for test in &vectors.tests {
            let wants = std::iter::once(&test.want).chain(&test.also);
            let empty =
                |want: &Want| matches!(want, Want::Enclosure { lo, hi } if lo.value.cmp(&hi.value).is_gt());
            if wants.clone().any(empty) {
                return Err(format!("{}: an enclosure that holds nothing", test.id));
            }
            if !test.is_in_format() {
                return Err(format!(
                    "{}: arguments that are no floats of its format, {}",
                    test.id, test.format
                ));
            }
            if let Some(flag) = test.flags.iter().find(|flag| !vectors.flags.contains_key(*flag)) {
                return Err(format!("{}: nothing says what the flag {flag} means", test.id));
            }
            if let Some(trap) = test.traps.keys().find(|trap| !vectors.traps.contains_key(*trap)) {
                return Err(format!("{}: nothing says what the trap {trap} means", test.id));
            }
        }
        Ok(vectors)
    }
}

impl Test {
    /// Whether there is such a format, and it has all arguments.
    fn is_in_format(&self) -> bool {
        let has = match self.format.as_str() {
            f32::FORMAT => is_float::<f32>,
            f64::FORMAT => is_float::<f64>,
            _ => return false,
        };
        self.args.values().all(|argument| match argument {
            Argument::Float(text) => has(text),
            Argument::List(texts) => texts.iter().all(|text| has(text)),
            Argument::Rows(rows) => rows.iter().flatten().all(|text| has(text)),
        })
    }
}

fn is_float<T: Real>(text: &str) -> bool {
    hex_float::parse::<T>(text).is_ok()
}

/// An id and an operation mean one thing.
fn checked(all: Vec<Vectors>) -> Result<Vec<Vectors>, String> {
    let mut seen = HashSet::new();
    let mut names =
        all.iter().map(|vectors| &vectors.op).chain(all.iter().flat_map(|v| &v.tests).map(|test| &test.id));
    match names.find(|name| !seen.insert(*name)) {
        Some(name) => Err(format!("{name} is there twice")),
        None => Ok(all),
    }
}
