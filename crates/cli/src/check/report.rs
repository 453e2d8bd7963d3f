//! The verdict: a table with the causes of failures below it, JSON with everything, CSV with the numbers.

use super::judge::Deviation;
use super::run::request;
use super::values::FloatFormat;
use super::vectors::Test;
use super::{Answered, Cause, Check, Checked, PortFailure, Role, TestCounts, TestFailure, Verdict, words};
use crate::output::{Number, Record, Report, Value, short, table};
use mean_information_report::one_line;
use mean_information_report::protocol::Claim;
use std::collections::BTreeMap;
use std::fmt::Write;

/// The most causes of an operation's failures that the table shows.
const CAUSES_SHOWN: usize = 3;
/// The least score of a cause that is shown, relative to the best one's.
const LIKELY: f64 = 0.5;
/// The least score of a cause that is shown: below it, few tests may agree by chance.
const LEAST: f64 = 0.1;
/// The most troubles of an operation that the table shows.
const TROUBLES_SHOWN: usize = 3;

impl Checked {
    /// Returns each format with the verdicts of its tests, in the order of the vectors.
    fn formats(&self) -> Vec<(FloatFormat, Vec<&Verdict>)> {
        let mut formats: Vec<(FloatFormat, Vec<&Verdict>)> = Vec::new();
        for (test, verdict) in self.vectors.tests.iter().zip(&self.verdicts) {
            match formats.iter_mut().find(|(format, _)| *format == test.format) {
                Some((_, verdicts)) => verdicts.push(verdict),
                None => formats.push((test.format, vec![verdict])),
            }
        }
        formats
    }

    /// Returns the tests that failed, known ones too.
    pub(super) fn failures(&self) -> impl Iterator<Item = (&Test, &TestFailure)> {
        self.vectors.tests.iter().zip(&self.verdicts).filter_map(|(test, verdict)| match verdict {
            Verdict::Failed(failure) | Verdict::Known(failure) => Some((test, failure)),
            _ => None,
        })
    }

    /// Returns the wrong answer that is furthest off; if none of them is a number, the first.
    fn worst(&self) -> Option<(&Test, &TestFailure)> {
        let answers = || self.failures().filter(|(_, failure)| matches!(failure, TestFailure::Answer(_)));
        let ulp = |failure: &TestFailure| match failure {
            TestFailure::Answer(judged) => judged.error.map(|error| error.ulp),
            _ => None,
        };
        let numbers = answers().filter_map(|(test, failure)| ulp(failure).map(|ulp| (ulp, (test, failure))));
        let worst = numbers.reduce(|worst, next| if next.0 > worst.0 { next } else { worst });
        worst.map(|(_, case)| case).or_else(|| answers().next())
    }

    /// Returns the tolerance in ulp; some tests allow more than the file.
    fn allowed(&self) -> String {
        let most = self.vectors.tests.iter().filter_map(|test| test.tolerance_ulp).fold(0.0, f64::max);
        let least = self.vectors.tolerance_ulp;
        if most > least { format!("{least} to {most}") } else { least.to_string() }
    }

    /// Returns what the port claims, if that is more than the tolerance, or else the tolerance, in ulp but for what has
    /// another unit.
    fn allowed_or_claimed(&self) -> String {
        match self.claimed {
            Claim { ulp: 0.0, bits: 0.0 } => self.allowed(),
            Claim { ulp, bits: 0.0 } => format!("{ulp} claimed"),
            Claim { ulp: 0.0, bits } => format!("{bits:e} bits claimed"),
            Claim { ulp, bits } => format!("{ulp} or {bits:e} bits claimed"),
        }
    }

    fn section(&self, text: &mut String) {
        let counts = TestCounts::of(&self.verdicts);
        let failures = counts.failed + counts.known;
        if failures == 0 {
            return;
        }
        let answered = counts.passed + failures;
        let _ = writeln!(text, "\n{}: {failures} of {answered} failed", self.vectors.op);
        let best = self.causes.first().map_or(0.0, |cause| cause.score);
        let least = LEAST.max(LIKELY * best);
        let likely = self.causes.iter().filter(|cause| !cause.redundant && cause.score >= least);
        if likely.clone().all(|cause| cause.role != Role::Cause) {
            let _ = writeln!(text, "  no known mistake explains most of them");
        }
        // Of another kind than was due: always shown.
        let besides = |cause: &&Cause| cause.role == Role::Besides && !cause.redundant;
        let likely = likely.filter(|cause| !besides(cause)).take(CAUSES_SHOWN);
        for cause in likely.chain(self.causes.iter().filter(besides)) {
            let _ = writeln!(text, "  {}", words::cause(cause, failures));
        }
        let not_run =
            self.failures().filter(|(_, failure)| matches!(failure, TestFailure::NotRun(_))).count();
        if not_run > 0 {
            let _ = writeln!(text, "  not run after too much trouble: {not_run} of {failures} failures");
        }
        if let Some((test, failure)) = self.worst() {
            let _ = writeln!(text, "  worst: {}, in {}", one_line(&test.id), test.format);
            let _ = writeln!(text, "    {}", words::arguments(test));
            let _ = writeln!(text, "    wanted {}", words::wanted(test));
            let _ = writeln!(text, "    answered {}", words::answered(failure));
        }
        let troubles = || {
            self.failures().filter_map(|(test, failure)| match failure {
                TestFailure::Port(failure) => Some((test, failure)),
                _ => None,
            })
        };
        for (test, failure) in troubles().take(TROUBLES_SHOWN) {
            let _ = writeln!(text, "  trouble: {}", one_line(&test.id));
            let _ = writeln!(text, "    {}", words::arguments(test));
            let _ = writeln!(text, "    {}", failure.error);
            errors(text, failure);
        }
        let more = troubles().count().saturating_sub(TROUBLES_SHOWN);
        if more > 0 {
            let _ = writeln!(text, "  trouble with {more} more requests: --format json has all of it");
        }
    }

    fn record(&self, format: FloatFormat, verdicts: &[&Verdict]) -> Record {
        let counts = TestCounts::of(verdicts.iter().copied());
        let count = |n: usize| Value::Count(n as u64);
        let cause = self.causes.first().filter(|cause| cause.role == Role::Cause);
        let cause = cause.map(|cause| cause.name.clone()).unwrap_or_default();
        let worst = |part| Value::Computed(worst_error(verdicts, part).map(Number::Double));
        Record(vec![
            ("operation", Value::Text(self.vectors.op.clone())),
            ("format", Value::Text(format.to_string())),
            ("declared", Value::Flag(self.declared)),
            ("tolerance_ulp", Value::Given(Some(self.vectors.tolerance_ulp))),
            ("claimed_ulp", given(self.claimed.ulp)),
            ("claimed_bits", given(self.claimed.bits)),
            ("cases", count(counts.cases)),
            ("passed", count(counts.passed)),
            ("failed", count(counts.failed)),
            ("skipped", count(counts.skipped)),
            ("known_failures", count(counts.known)),
            ("worst_error_ulp", worst(|error| error.ulp)),
            ("worst_error_absolute", worst(|error| error.absolute)),
            ("cause", Value::Text(if counts.failed + counts.known > 0 { cause } else { String::new() })),
        ])
    }

    fn json(&self) -> Record {
        let formats =
            self.formats().iter().map(|(format, verdicts)| self.record(*format, verdicts)).collect();
        let failures = self.failures().map(|(test, failure)| self.failure(test, failure)).collect();
        let worst = self.worst().map(|(test, _)| test.id.clone()).unwrap_or_default();
        Record(vec![
            ("operation", Value::Text(self.vectors.op.clone())),
            ("declared", Value::Flag(self.declared)),
            ("formats", Value::Records(formats)),
            ("causes", Value::Records(self.causes.iter().map(cause).collect())),
            ("worst_case", Value::Text(worst)),
            ("failures", Value::Records(failures)),
        ])
    }

    fn failure(&self, test: &Test, failure: &TestFailure) -> Record {
        let (error, stderr) = match failure {
            TestFailure::Answer(judged) => (judged.error, Vec::new()),
            TestFailure::Port(failure) => (None, failure.stderr.clone()),
            TestFailure::NotRun(_) => (None, Vec::new()),
        };
        let answer = match failure {
            TestFailure::Answer(judged) => match &judged.answer {
                Answered::Count(count) => count.to_string(),
                Answered::Error(text)
                | Answered::Float(_, text)
                | Answered::NotOfFormat(text)
                | Answered::Unreadable { text, .. } => text.clone(),
            },
            _ => String::new(),
        };
        Record(vec![
            ("id", Value::Text(test.id.clone())),
            ("format", Value::Text(test.format.to_string())),
            ("request", Value::Text(request(&self.vectors.op, test, 1).line())),
            ("wanted", Value::Text(words::wanted(test))),
            ("answer", Value::Text(answer)),
            ("what", Value::Text(words::answered(failure))),
            ("error_ulp", Value::Computed(error.map(|error| Number::Double(error.ulp)))),
            ("error_absolute", Value::Computed(error.map(|error| Number::Double(error.absolute)))),
            ("flags", Value::Texts(test.flags.clone())),
            ("stderr", Value::Texts(stderr)),
        ])
    }
}

fn cause(cause: &Cause) -> Record {
    let count = |n: usize| Value::Count(n as u64);
    let mut record = vec![
        ("role", Value::Text(cause.role.name().to_owned())),
        ("kind", Value::Text(cause.kind.name().to_owned())),
        ("name", Value::Text(cause.name.clone())),
        ("note", Value::Text(cause.note.clone())),
        ("explained", count(cause.explained)),
        ("tests", count(cause.tests)),
    ];
    if let Some((failed, all)) = cause.elsewhere {
        record.extend([("failed_elsewhere", count(failed)), ("tests_elsewhere", count(all))]);
    }
    record.extend([("score", Value::Given(Some(cause.score))), ("redundant", Value::Flag(cause.redundant))]);
    Record(record)
}

/// Wraps a claim; 0 claims nothing.
fn given(claim: f64) -> Value {
    Value::Given((claim > 0.0).then_some(claim))
}

/// Returns the largest error of numbers that were answered, right ones too, by a measure of errors.
fn worst_error(verdicts: &[&Verdict], measure: fn(Deviation) -> f64) -> Option<f64> {
    let error = |verdict: &&Verdict| match verdict {
        Verdict::Passed(judged)
        | Verdict::Failed(TestFailure::Answer(judged))
        | Verdict::Known(TestFailure::Answer(judged)) => judged.error.map(measure),
        _ => None,
    };
    verdicts.iter().filter_map(error).reduce(f64::max)
}

/// Writes the last lines of standard error.
fn errors(text: &mut String, failure: &PortFailure) {
    for line in &failure.stderr {
        let _ = writeln!(text, "    stderr: {line}");
    }
}

impl Check {
    fn undeclared(&self) -> Vec<&Checked> {
        self.operations.iter().filter(|operation| !operation.declared).collect()
    }

    /// Counts the skipped tests by their reason.
    fn skipped(&self) -> BTreeMap<&str, usize> {
        let mut reasons = BTreeMap::new();
        for verdict in self.operations.iter().filter(|o| o.declared).flat_map(|o| &o.verdicts) {
            if let Verdict::Skipped(reason) = verdict {
                *reasons.entry(reason.as_str()).or_default() += 1;
            }
        }
        reasons
    }

    fn summary(&self) -> String {
        let row = |operation: &Checked, format: FloatFormat, verdicts: &[&Verdict]| {
            let counts = TestCounts::of(verdicts.iter().copied());
            let worst = |measure| worst_error(verdicts, measure).map(short).unwrap_or_default();
            [
                operation.vectors.op.clone(),
                format.to_string(),
                counts.cases.to_string(),
                counts.passed.to_string(),
                counts.failed.to_string(),
                counts.skipped.to_string(),
                worst(|error| error.ulp),
                worst(|error| error.absolute),
                operation.allowed_or_claimed(),
            ]
        };
        let mut rows = Vec::new();
        for operation in self.operations.iter().filter(|operation| operation.declared) {
            rows.extend(
                operation.formats().iter().map(|(format, verdicts)| row(operation, *format, verdicts)),
            );
        }
        let header = [
            "operation",
            "format",
            "cases",
            "passed",
            "failed",
            "skipped",
            "worst error\n(ulp)",
            "worst error\n(absolute)",
            "allowed\n(ulp)",
        ];
        table(header, rows)
    }

    /// Writes what was not run or not counted, and why.
    fn remarks(&self, text: &mut String) {
        let undeclared = self.undeclared();
        if !undeclared.is_empty() {
            let names: Vec<_> = undeclared.iter().map(|operation| operation.vectors.op.as_str()).collect();
            let cases: usize = undeclared.iter().map(|operation| operation.verdicts.len()).sum();
            let all = self.operations.len();
            let _ = writeln!(
                text,
                "not declared: {} of {all} operations, {cases} cases skipped: {}",
                names.len(),
                names.join(", ")
            );
        }
        for (reason, cases) in self.skipped() {
            let _ = writeln!(text, "{cases} cases skipped: {}", one_line(reason));
        }
        let TestCounts { known, by_claim, passed, .. } = self.totals();
        if by_claim > 0 {
            let _ = writeln!(
                text,
                "{by_claim} answers pass only by the port's claims: the contract asks for more"
            );
        }
        if passed == 0 {
            let _ = writeln!(text, "nothing passed: that is no success");
        }
        if known > 0 {
            let _ = writeln!(text, "{known} known failures, counted as skipped");
        }
        for line in &self.stale {
            let _ = writeln!(text, "not a known failure any more: {}", one_line(line));
        }
        for (place, failure) in &self.ending.port_failures {
            let _ = writeln!(text, "trouble {}: {}", one_line(place), failure.error);
            errors(text, failure);
        }
        if self.ending.restarts > 0 {
            let _ = writeln!(text, "the port was started again, {} times in all", self.ending.restarts);
        }
        if let Some(reason) = &self.ending.given_up {
            let _ = writeln!(text, "given up, the rest has failed: {reason}");
        }
        for note in &self.notes {
            let _ = writeln!(text, "note: {}", one_line(note));
        }
    }
}

impl Report for Check {
    fn table(&self) -> String {
        let names = [&self.port.name, &self.port.version, &self.port.language];
        let names: Vec<_> =
            names.into_iter().filter(|name| !name.is_empty()).map(|name| one_line(name)).collect();
        let mut text = format!("{}: {}\n{}", one_line(&self.command), names.join(", "), self.summary());
        for operation in &self.operations {
            operation.section(&mut text);
        }
        text.push('\n');
        self.remarks(&mut text);
        let TestCounts { passed, failed, skipped, .. } = self.totals();
        let _ = writeln!(text, "{passed} passed, {failed} failed, {skipped} skipped");
        text
    }

    fn rows(&self) -> Vec<Record> {
        let rows = |operation: &Checked| {
            let formats = operation.formats().into_iter();
            formats.map(|(format, verdicts)| operation.record(format, &verdicts)).collect::<Vec<_>>()
        };
        self.operations.iter().flat_map(rows).collect()
    }

    fn json(&self) -> Value {
        let text = |text: &str| Value::Text(text.to_owned());
        let count = |n: usize| Value::Count(n as u64);
        let claim = |(pattern, claim): (&String, &Claim)| {
            Record(vec![("operation", text(pattern)), ("ulp", given(claim.ulp)), ("bits", given(claim.bits))])
        };
        let port = Record(vec![
            ("command", text(&self.command)),
            ("name", text(&self.port.name)),
            ("language", text(&self.port.language)),
            ("version", text(&self.port.version)),
            ("formats", Value::Texts(self.port.formats.clone())),
            ("ops", Value::Texts(self.port.ops.clone())),
            ("claims", Value::Records(self.port.claims.iter().map(claim).collect())),
        ]);
        let failure = |(place, failure): &(String, PortFailure)| {
            Record(vec![
                ("place", text(place)),
                ("what", Value::Text(failure.error.to_string())),
                ("stderr", Value::Texts(failure.stderr.clone())),
            ])
        };
        let TestCounts { passed, by_claim, failed, skipped, known, .. } = self.totals();
        Value::Record(Record(vec![
            ("port", Value::Record(port)),
            ("operations", Value::Records(self.operations.iter().map(Checked::json).collect())),
            ("undeclared", Value::Texts(self.undeclared().iter().map(|o| o.vectors.op.clone()).collect())),
            ("troubles", Value::Records(self.ending.port_failures.iter().map(failure).collect())),
            ("restarts", count(self.ending.restarts)),
            ("given_up", text(self.ending.given_up.as_deref().unwrap_or_default())),
            ("stale_known_failures", Value::Texts(self.stale.clone())),
            ("notes", Value::Texts(self.notes.clone())),
            ("known_failures", count(known)),
            ("passed", count(passed)),
            ("passed_by_claim", count(by_claim)),
            ("failed", count(failed)),
            ("skipped", count(skipped)),
        ]))
    }
}
