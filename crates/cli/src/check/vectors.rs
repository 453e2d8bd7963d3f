//! The vectors as they are written: `vectors/README.md`.

use super::values::{FloatFormat, NEAREST, Trap, Version, Want, some_tolerance, tolerance};
use crate::failure::Failure;
use mean_information::operations::{Operation, Outcome, find};
use mean_information::vectors::FILES;
use mean_information_report::protocol::{Arguments, values};
use serde::Deserialize;
use serde_json::Value as Json;
use std::collections::{BTreeMap, HashSet};
use std::fs;
use std::path::Path;

/// The file of the registry, which lies beside those of the operations.
const REGISTRY: &str = "operations.json";

/// The tests of one operation.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Vectors {
    /// The operation.
    pub op: String,
    /// The version of the format.
    pub version: Version,
    /// The exact result, in words.
    #[serde(default)]
    pub formula: String,
    /// The tolerance in ulp; 0.5 means the nearest float.
    #[serde(deserialize_with = "tolerance")]
    pub tolerance_ulp: f64,
    /// The meaning of the tolerance, in words.
    #[serde(default)]
    pub verdict: String,
    /// The tools that computed the right answers.
    #[serde(default)]
    pub source: String,
    /// The subject of the tests with a flag, by the name of the flag.
    pub flags: BTreeMap<String, String>,
    /// The mistake behind a trap's answer, by the name of the trap.
    #[serde(default)]
    pub traps: BTreeMap<String, String>,
    /// The tests, in the order of the file.
    pub tests: Vec<Test>,
}

/// A test: arguments and the right answer.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Test {
    /// The id, which means this test for ever.
    pub id: String,
    /// The format of the floats.
    pub format: FloatFormat,
    /// The arguments by name.
    pub args: Arguments,
    /// The right answer.
    pub want: Want,
    /// Other answers that are as right.
    #[serde(default)]
    pub also: Vec<Want>,
    /// A larger tolerance than that of the file.
    #[serde(default, deserialize_with = "some_tolerance")]
    pub tolerance_ulp: Option<f64>,
    /// The flags of what it is about.
    #[serde(default)]
    pub flags: Vec<String>,
    /// The answers of known mistakes, by the name of the trap.
    #[serde(default)]
    pub traps: BTreeMap<String, Trap>,
}

impl Vectors {
    /// Returns the vectors that this program was built with.
    ///
    /// # Errors
    /// None: a test reads them all.
    pub fn built_in() -> Result<Vec<Self>, Failure> {
        let parsed = FILES.iter().map(|(op, text)| Self::parse(text).map_err(|what| format!("{op}: {what}")));
        parsed.collect::<Result<_, _>>().and_then(checked).map_err(Failure::Vectors)
    }

    /// Reads the vectors of a folder, in the order of the files' names.
    ///
    /// # Errors
    /// A folder or a file that cannot be read, or that holds something else.
    pub fn in_folder(folder: &Path) -> Result<Vec<Self>, Failure> {
        let unreadable = |e: std::io::Error| Failure::file(folder, format!("cannot be read: {e}"));
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
            return Err(Failure::file(folder, "holds no vectors; give a folder such as vectors/v1"));
        }
        let mut all = Vec::new();
        for path in paths {
            let text = fs::read_to_string(&path)
                .map_err(|e| Failure::file(&path, format!("cannot be read: {e}")))?;
            all.push(Self::parse(&text).map_err(|what| Failure::file(&path, what))?);
        }
        checked(all).map_err(|what| Failure::file(folder, what))
    }

    fn parse(text: &str) -> Result<Self, String> {
        let refused = |what: String| format!("is not a file of vectors: {what}");
        let vectors: Self = serde_json::from_str(text).map_err(|error| refused(explained(text, &error)))?;
        let Self { op, tolerance_ulp, tests, .. } = &vectors;
        let operation = find(op).ok_or_else(|| format!("{op} is no operation of `meaninfo check --list`"))?;
        if (*tolerance_ulp == 0.0) != (operation.result == Outcome::Count) {
            return Err(format!(
                "a tolerance of {tolerance_ulp} ulp for {op}: counts have 0, floats {NEAREST} or more"
            ));
        }
        if tests.is_empty() {
            return Err("has no tests".to_owned());
        }
        let problem = tests.iter().find_map(|test| Some((test, vectors.problem_of(operation, test)?)));
        problem.map_or(Ok(()), |(test, what)| Err(format!("{}: {what}", test.id)))?;
        Ok(vectors)
    }

    /// Returns what is wrong with a test whose parts make sense alone.
    fn problem_of(&self, operation: &Operation, test: &Test) -> Option<String> {
        if test.id.is_empty() {
            return Some("a test whose id is empty".to_owned());
        }
        if let Err(what) = match test.format {
            FloatFormat::F32 => values::<f32>(operation, &test.args).map(drop),
            FloatFormat::F64 => values::<f64>(operation, &test.args).map(drop),
        } {
            return Some(what);
        }
        let counts = operation.result == Outcome::Count;
        let of_another_kind = |want: &Want| match want {
            Want::Enclosure { .. } => counts,
            Want::Count(_) => !counts,
            Want::Domain => false,
        };
        let outcome = operation.result.name();
        if std::iter::once(&test.want).chain(&test.also).any(of_another_kind) {
            return Some(format!("what is wanted is not the result of {}: a {outcome}", operation.name));
        }
        if let Some(own) = test.tolerance_ulp.filter(|own| counts || *own <= self.tolerance_ulp) {
            return Some(format!(
                "a tolerance of {own} ulp, not above that of the file, {}",
                self.tolerance_ulp
            ));
        }
        if let Some(flag) = test.flags.iter().find(|flag| !self.flags.contains_key(*flag)) {
            return Some(format!("nothing says what the flag {flag} means"));
        }
        if let Some(trap) = test.traps.keys().find(|trap| !self.traps.contains_key(*trap)) {
            return Some(format!("nothing says what the trap {trap} means"));
        }
        let trap = test.traps.iter().find(|(_, trap)| matches!(trap, Trap::Count(_)) != counts);
        trap.map(|(name, _)| {
            format!("the trap {name} is not what {} can answer: a {outcome}", operation.name)
        })
    }
}

/// Explains why a file cannot be read, by the id of the first test that is refused.
fn explained(text: &str, error: &serde_json::Error) -> String {
    let file: Json = serde_json::from_str(text).unwrap_or_default();
    let tests = file["tests"].as_array().into_iter().flatten().enumerate();
    let refused = tests.filter_map(|(index, test)| {
        let what = Test::deserialize(test).err()?;
        Some(match test["id"].as_str() {
            Some(id) => format!("{id}: {what}"),
            None => format!("test {} of \"tests\": {what}", index + 1),
        })
    });
    // What is wrong with the rest of the file has a line and a column.
    refused.into_iter().next().unwrap_or_else(|| error.to_string())
}

/// Refuses an id or an operation that is there twice.
fn checked(all: Vec<Vectors>) -> Result<Vec<Vectors>, String> {
    let mut seen = HashSet::new();
    let mut names =
        all.iter().map(|vectors| &vectors.op).chain(all.iter().flat_map(|v| &v.tests).map(|test| &test.id));
    match names.find(|name| !seen.insert(*name)) {
        Some(name) => Err(format!("{name} is there twice")),
        None => Ok(all),
    }
}
