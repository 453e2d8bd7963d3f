//! The verdict as JUnit XML, which the viewers of continuous integration read: a suite per operation.

use super::{Check, Counts, Verdict, Wrong, words};
use crate::one_line::one_line;
use std::fmt::Write;

/// The suite of what belongs to no test.
const OTHER: &str = "port";

impl Check {
    /// The whole verdict as JUnit XML.
    pub fn junit(&self) -> String {
        let totals = self.totals();
        let mut xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".to_owned();
        let others = self.stale.len() + self.ending.incidents.len();
        let _ = writeln!(xml, "<testsuites{}>", attributes("meaninfo check", totals.cases + others, totals));
        for operation in &self.operations {
            let counts = Counts::of(&operation.verdicts);
            let op = &operation.vectors.op;
            let _ = writeln!(xml, "  <testsuite{}>", attributes(op, counts.cases, counts));
            for (test, verdict) in operation.vectors.tests.iter().zip(&operation.verdicts) {
                let outcome = match verdict {
                    Verdict::Passed(_) => String::new(),
                    Verdict::Failed(wrong) => {
                        let text =
                            [words::arguments(test), format!("wanted {}", words::wanted(test))].join("\n");
                        failed(&words::answered(wrong), kind(wrong), &text)
                    }
                    Verdict::Known(wrong) => skipped(&format!("known failure: {}", words::answered(wrong))),
                    Verdict::Skipped(reason) => skipped(reason),
                };
                case(&mut xml, op, &test.id, &outcome);
            }
            xml.push_str("  </testsuite>\n");
        }
        if others > 0 {
            let counts = Counts { failed: others, ..Counts::default() };
            let _ = writeln!(xml, "  <testsuite{}>", attributes(OTHER, others, counts));
            for line in &self.stale {
                case(&mut xml, OTHER, line, &failed("not a known failure any more", "stale", ""));
            }
            for (place, incident) in &self.ending.incidents {
                let outcome = failed(&incident.trouble.to_string(), "trouble", &incident.errors.join("\n"));
                case(&mut xml, OTHER, place, &outcome);
            }
            xml.push_str("  </testsuite>\n");
        }
        xml + "</testsuites>\n"
    }
}

fn kind(wrong: &Wrong) -> &'static str {
    match wrong {
        Wrong::Answer(_) => "answer",
        Wrong::Trouble(_) => "trouble",
        Wrong::NotRun(_) => "not-run",
    }
}

fn attributes(name: &str, tests: usize, counts: Counts) -> String {
    let Counts { failed, skipped, .. } = counts;
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

/// Text of one line in an attribute or an element.
fn escaped(text: &str) -> String {
    let mut xml = String::with_capacity(text.len());
    for c in one_line(text).chars() {
        match c {
            '&' => xml.push_str("&amp;"),
            '<' => xml.push_str("&lt;"),
            '>' => xml.push_str("&gt;"),
            '"' => xml.push_str("&quot;"),
            // Not characters of XML.
            '\u{fffe}' | '\u{ffff}' => xml.push('\u{fffd}'),
            _ => xml.push(c),
        }
    }
    xml
}
