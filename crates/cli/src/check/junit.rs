//! The verdict as JUnit XML, which the viewers of continuous integration read: a suite per operation.

use super::{Check, TestCounts, TestFailure, Verdict, words};
use crate::output;
use mean_information_report::one_line;
use std::fmt::Write;

/// The suite of what belongs to no test.
const OTHER: &str = "port";

impl Check {
    /// Writes the whole verdict as JUnit XML.
    pub fn junit(&self) -> String {
        let totals = self.totals();
        let mut xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".to_owned();
        let others = self.stale.len() + self.ending.port_failures.len();
        let _ = writeln!(xml, "<testsuites{}>", attributes("meaninfo check", totals.cases + others, totals));
        for operation in &self.operations {
            let counts = TestCounts::of(&operation.verdicts);
            let op = &operation.vectors.op;
            let _ = writeln!(xml, "  <testsuite{}>", attributes(op, counts.cases, counts));
            for (test, verdict) in operation.vectors.tests.iter().zip(&operation.verdicts) {
                let outcome = match verdict {
                    Verdict::Passed(_) => String::new(),
                    Verdict::Failed(failure) => {
                        let text =
                            [words::arguments(test), format!("wanted {}", words::wanted(test))].join("\n");
                        failed(&words::answered(failure), kind(failure), &text)
                    }
                    Verdict::Known(failure) => {
                        skipped(&format!("known failure: {}", words::answered(failure)))
                    }
                    Verdict::Skipped(reason) => skipped(reason),
                };
                case(&mut xml, op, &test.id, &outcome);
            }
            xml.push_str("  </testsuite>\n");
        }
        if others > 0 {
            let counts = TestCounts { failed: others, ..TestCounts::default() };
            let _ = writeln!(xml, "  <testsuite{}>", attributes(OTHER, others, counts));
            for line in &self.stale {
                case(&mut xml, OTHER, line, &failed("not a known failure any more", "stale", ""));
            }
            for (place, failure) in &self.ending.port_failures {
                let outcome = failed(&failure.error.to_string(), "trouble", &failure.stderr.join("\n"));
                case(&mut xml, OTHER, place, &outcome);
            }
            xml.push_str("  </testsuite>\n");
        }
        xml + "</testsuites>\n"
    }
}

fn kind(failure: &TestFailure) -> &'static str {
    match failure {
        TestFailure::Answer(_) => "answer",
        TestFailure::Port(_) => "trouble",
        TestFailure::NotRun(_) => "not-run",
    }
}

fn attributes(name: &str, tests: usize, counts: TestCounts) -> String {
    let TestCounts { failed, skipped, .. } = counts;
    format!(
        " name=\"{}\" tests=\"{tests}\" failures=\"{failed}\" errors=\"0\" skipped=\"{skipped}\" time=\"0\"",
        escaped(name)
    )
}

fn case(xml: &mut String, suite: &str, name: &str, outcome: &str) {
    let (suite, name) = (escaped(suite), escaped(name));
    let _ =
        writeln!(xml, "    <testcase classname=\"{suite}\" name=\"{name}\" time=\"0\">{outcome}</testcase>");
}

fn failed(message: &str, kind: &str, text: &str) -> String {
    let lines: Vec<_> = text.lines().map(escaped).collect();
    format!("<failure message=\"{}\" type=\"{kind}\">{}</failure>", escaped(message), lines.join("\n"))
}

fn skipped(reason: &str) -> String {
    format!("<skipped message=\"{}\"/>", escaped(reason))
}

/// Escapes text, which becomes one line, for an attribute or an element.
fn escaped(text: &str) -> String {
    output::escaped(&one_line(text))
}
