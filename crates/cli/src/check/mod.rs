//! A port, checked against the vectors: `meaninfo check`.
//!
//! | module | holds |
//! |---|---|
//! | `exact` | numbers that are compared exactly |
//! | `values`, `vectors` | the tests |
//! | `judge` | whether an answer is right |
//! | `group`, `process`, `run` | the port, and the conversation with it |
//! | `known` | failures that are expected |
//! | `candidate`, `facts`, `fitted`, `diagnosis` | why tests failed |
//! | `words`, `report`, `junit` | the verdict, written |
//! | `registry` | the list of operations, written |

mod candidate;
mod diagnosis;
mod exact;
mod facts;
mod fitted;
mod glob;
mod group;
mod judge;
mod junit;
mod known;
mod process;
mod registry;
mod report;
mod run;
mod values;
mod vectors;
mod words;

pub use candidate::{Kind, Role};
pub use diagnosis::Cause;
pub use judge::{Answered, Deviation, Judged};
pub use known::KnownFailures;
pub use process::{End, PortError};
pub use registry::Registry;
pub use run::PortFailure;
pub use values::{Decimal, FloatFormat, MAX_ABSOLUTE, MAX_TOLERANCE, NEAREST, Trap, Version, Want};
pub use vectors::{Test, Vectors};

use crate::failure::Failure;
use crate::progress::Progress;
use mean_information::Real;
use mean_information_report::protocol::{Claim, Reply, Welcome};
use run::{Conversation, Ending, Outcome};
use std::ffi::OsString;
use std::time::Duration;

/// The port, and the tests to run.
#[derive(Clone, Debug)]
pub struct Options {
    /// The command that starts the port.
    pub command: Vec<OsString>,
    /// The time that an answer may take.
    pub limit: Duration,
    /// Patterns of operations; none means all.
    pub ops: Vec<String>,
    /// Failures that are expected.
    pub known: KnownFailures,
}

/// The verdict on a port.
#[derive(Debug)]
pub struct Check {
    command: String,
    port: Welcome,
    /// The selected operations, in the order of the vectors.
    operations: Vec<Checked>,
    ending: Ending,
    /// Entries of the file of known failures that are none, with what they are.
    stale: Vec<String>,
    notes: Vec<String>,
}

/// The verdict on an operation.
#[derive(Debug)]
struct Checked {
    vectors: Vectors,
    declared: bool,
    /// The port's claim, where it is more than the contract's tolerance.
    claimed: Claim,
    /// The verdict on each test.
    verdicts: Vec<Verdict>,
    causes: Vec<Cause>,
}

/// The verdict on a test.
#[derive(Clone, Debug, PartialEq)]
enum Verdict {
    Passed(Judged),
    Failed(TestFailure),
    /// Failed, as was known.
    Known(TestFailure),
    /// Skipped, with the reason.
    Skipped(String),
}

/// The failure of a test.
#[derive(Clone, Debug, PartialEq)]
enum TestFailure {
    Answer(Judged),
    /// The port, not an answer.
    Port(PortFailure),
    /// Skipped, with the reason.
    NotRun(String),
}

/// The numbers of tests by how they ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct TestCounts {
    cases: usize,
    passed: usize,
    /// The passed answers that only the port's claims allow.
    by_claim: usize,
    failed: usize,
    /// The skipped tests, known failures included.
    skipped: usize,
    known: usize,
}

impl TestCounts {
    fn of<'a>(verdicts: impl IntoIterator<Item = &'a Verdict>) -> Self {
        verdicts.into_iter().fold(Self::default(), |mut counts, verdict| {
            counts.cases += 1;
            match verdict {
                Verdict::Passed(judged) => {
                    counts.passed += 1;
                    counts.by_claim += usize::from(judged.by_claim);
                }
                Verdict::Failed(_) => counts.failed += 1,
                Verdict::Known(_) => {
                    counts.skipped += 1;
                    counts.known += 1;
                }
                Verdict::Skipped(_) => counts.skipped += 1,
            }
            counts
        })
    }
}

impl Check {
    /// Runs the port against the vectors.
    ///
    /// # Errors
    /// A port that cannot be started or talked to; patterns that no operation matches. What goes wrong later is part of
    /// the verdict.
    pub fn run(options: &Options, all: Vec<Vectors>) -> Result<Self, Failure> {
        if let Some(pattern) =
            options.ops.iter().find(|pattern| all.iter().all(|v| !glob::matches(pattern, &v.op)))
        {
            let names: Vec<_> = all.iter().map(|vectors| vectors.op.as_str()).collect();
            return Err(Failure::Usage(format!(
                "--ops {pattern}: no such operation among {}",
                names.join(", ")
            )));
        }
        let mut stale = unknown_ids(&options.known, &all);
        let names: Vec<String> = all.iter().map(|vectors| vectors.op.clone()).collect();
        let (mut conversation, port) = Conversation::open(&options.command, options.limit)?;
        let command = run::command_line(&options.command);
        refuse_strangers(&port, &names)
            .map_err(|message| Failure::Port { command: command.clone(), message })?;

        let selected =
            |op: &str| options.ops.is_empty() || options.ops.iter().any(|pattern| glob::matches(pattern, op));
        let selection: Vec<_> = all.into_iter().filter(|vectors| selected(&vectors.op)).collect();
        let progress = Progress::new(selection.iter().map(|vectors| vectors.tests.len()).sum());
        let mut operations = Vec::with_capacity(selection.len());
        for vectors in selection {
            progress.begin(&vectors.op);
            operations.push(check(vectors, &port, &mut conversation, &options.known, &progress));
        }
        drop(progress);
        stale.extend(operations.iter().flat_map(|operation| stale_ids(operation, &options.known)));
        Ok(Self {
            command,
            notes: notes(&port, &names),
            port,
            operations,
            ending: conversation.close(),
            stale,
        })
    }

    /// Counts the tests of all operations; stale known failures and troubles between requests count as failed.
    fn totals(&self) -> TestCounts {
        let mut counts = TestCounts::of(self.operations.iter().flat_map(|operation| &operation.verdicts));
        counts.failed += self.stale.len() + self.ending.port_failures.len();
        counts
    }

    /// Returns whether something passed, and nothing failed.
    pub fn holds(&self) -> bool {
        let counts = self.totals();
        counts.passed > 0 && counts.failed == 0
    }
}

/// Asks, judges and diagnoses one operation.
fn check(
    vectors: Vectors,
    port: &Welcome,
    conversation: &mut Conversation<'_>,
    known: &KnownFailures,
    progress: &Progress,
) -> Checked {
    let declared = port.ops.contains(&vectors.op);
    let claims = port.claims.iter().filter(|(pattern, _)| glob::matches(pattern, &vectors.op));
    let claim = claims.map(|(_, claim)| *claim).fold(Claim::default(), Claim::or);
    let has = |format: FloatFormat| port.formats.iter().any(|name| name == format.name());
    let asked: Vec<_> = vectors.tests.iter().filter(|test| declared && has(test.format)).collect();
    (asked.len()..vectors.tests.len()).for_each(|_| progress.done());
    let mut outcomes = conversation.run(&vectors.op, &asked, || progress.done()).into_iter();
    let verdict = |test: &Test| {
        if !declared {
            return Verdict::Skipped("the port does not declare the operation".to_owned());
        }
        if !has(test.format) {
            return Verdict::Skipped(format!("the port does not declare {}", test.format));
        }
        let contract = test.tolerance_ulp.unwrap_or(vectors.tolerance_ulp);
        let failure = match outcomes.next().unwrap_or(Outcome::NotRun) {
            Outcome::Answered(Reply::Skipped(reason)) => return Verdict::Skipped(reason),
            Outcome::Answered(reply) => {
                let judged = judge::judge(test, contract, claim, &reply);
                if judged.right {
                    return Verdict::Passed(judged);
                }
                TestFailure::Answer(judged)
            }
            Outcome::Failed(failure) => TestFailure::Port(failure),
            // Whether it is a known failure has not been seen.
            Outcome::NotRun => {
                return Verdict::Failed(TestFailure::NotRun("not run after too much trouble".to_owned()));
            }
        };
        if known.contains(&test.id) { Verdict::Known(failure) } else { Verdict::Failed(failure) }
    };
    let verdicts: Vec<_> = vectors.tests.iter().map(verdict).collect();
    let causes = diagnosis::diagnose(&vectors, &verdicts);
    // Counts are exact, whatever a port claims.
    let claimed =
        if vectors.tolerance_ulp > 0.0 { claim.above(vectors.tolerance_ulp) } else { Claim::default() };
    Checked { vectors, declared, claimed, verdicts, causes }
}

/// Refuses a port that has nothing which could be checked.
fn refuse_strangers(port: &Welcome, names: &[String]) -> Result<(), String> {
    if !port.formats.iter().any(|format| [f32::FORMAT, f64::FORMAT].contains(&format.as_str())) {
        return Err(format!("its formats are neither f32 nor f64: {:?}", port.formats));
    }
    if !port.ops.iter().any(|op| names.contains(op)) {
        return Err(format!("it has no operation that is known: {:?}", port.ops));
    }
    Ok(())
}

/// Returns notes on what the port declares and nobody can check.
fn notes(port: &Welcome, names: &[String]) -> Vec<String> {
    let unknown = port.ops.iter().filter(|op| !names.contains(op));
    let formats = port.formats.iter().filter(|format| ![f32::FORMAT, f64::FORMAT].contains(&format.as_str()));
    let claims = port.claims.keys().filter(|pattern| !names.iter().any(|name| glob::matches(pattern, name)));
    unknown
        .map(|op| format!("the port declares the operation {op}, which has no vectors"))
        .chain(formats.map(|format| format!("the port declares the format {format}, which has no vectors")))
        .chain(
            claims
                .map(|pattern| format!("the port claims an error for {pattern}, which no operation matches")),
        )
        .collect()
}

fn unknown_ids(known: &KnownFailures, all: &[Vectors]) -> Vec<String> {
    let ids: std::collections::HashSet<_> =
        all.iter().flat_map(|v| &v.tests).map(|test| test.id.as_str()).collect();
    known.ids().filter(|id| !ids.contains(id)).map(|id| format!("{id}: no such test")).collect()
}

fn stale_ids(operation: &Checked, known: &KnownFailures) -> Vec<String> {
    let listed =
        operation.vectors.tests.iter().zip(&operation.verdicts).filter(|(test, _)| known.contains(&test.id));
    let stale = listed.filter_map(|(test, verdict)| match verdict {
        Verdict::Passed(_) => Some(format!("{}: passes", test.id)),
        Verdict::Skipped(reason) => Some(format!("{}: is skipped: {reason}", test.id)),
        _ => None,
    });
    stale.collect()
}
