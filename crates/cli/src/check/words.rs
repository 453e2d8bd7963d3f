//! Tests, answers and failures in words.

use super::judge::{Answered, Judged};
use super::values::Want;
use super::vectors::Test;
use super::{Cause, Kind, Role, TestFailure};
use crate::output::{Number, short};
use mean_information_report::hex_float;
use mean_information_report::one_line;
use mean_information_report::protocol::{Argument, errors};

/// The number of characters shown of an answer that cannot be read.
const ANSWER_SHOWN: usize = 120;
/// The number of floats shown of a list.
const SHOWN: usize = 6;

/// Returns the arguments by name, floats also as decimals.
pub(super) fn arguments(test: &Test) -> String {
    let named = test.args.iter().map(|(name, argument)| format!("{name} = {}", one_line(&value(argument))));
    named.collect::<Vec<_>>().join(", ")
}

fn value(argument: &Argument) -> String {
    match argument {
        Argument::Float(text) => float(text),
        Argument::List(texts) => list(texts, |text| float(text)),
        Argument::Rows(rows) => list(rows, |row| list(row, |text| float(text))),
    }
}

fn list<T>(items: &[T], item: impl Fn(&T) -> String) -> String {
    let shown: Vec<_> = items.iter().take(SHOWN).map(item).collect();
    let more = if items.len() > SHOWN { format!(", ... {} in all", items.len()) } else { String::new() };
    format!("[{}{more}]", shown.join(", "))
}

/// Returns a hexadecimal float with its decimals.
fn float(text: &str) -> String {
    match hex_float::parse::<f64>(text) {
        Ok(x) if x.is_finite() => format!("{text} ({})", Number::given(x)),
        _ => text.to_owned(),
    }
}

/// Returns the right answers.
pub(super) fn wanted(test: &Test) -> String {
    let wants = std::iter::once(&test.want).chain(&test.also).map(|want| match want {
        Want::Enclosure { lo, hi } if lo == hi => lo.text.clone(),
        Want::Enclosure { lo, hi } => format!("from {} to {}", lo.text, hi.text),
        Want::Domain => format!("the error \"{}\"", errors::DOMAIN),
        Want::Count(count) => count.to_string(),
    });
    wants.collect::<Vec<_>>().join(", or ")
}

/// Returns what was answered instead.
pub(super) fn answered(failure: &TestFailure) -> String {
    match failure {
        TestFailure::Answer(Judged { answer, error, .. }) => {
            let off = error
                .map(|error| format!(", {} ulp off, {} absolutely", short(error.ulp), short(error.absolute)))
                .unwrap_or_default();
            match answer {
                Answered::Float(_, text) => one_line(&float(text)) + &off,
                Answered::Count(count) => count.to_string(),
                Answered::Error(word) => format!("the error \"{}\"", one_line(word)),
                Answered::NotOfFormat(text) => format!("{}, which the format does not have", one_line(text)),
                Answered::Unreadable { text, wanted } => format!("{}: {wanted}", cut(text)),
            }
        }
        TestFailure::Port(failure) => failure.error.to_string(),
        TestFailure::NotRun(reason) => reason.clone(),
    }
}

/// Shortens a text to one line.
fn cut(text: &str) -> String {
    let start: String = text.chars().take(ANSWER_SHOWN).collect();
    one_line(&start) + if start.len() < text.len() { "..." } else { "" }
}

/// Returns a cause with its evidence, for an operation with `failures` failures.
pub(super) fn cause(cause: &Cause, failures: usize) -> String {
    let Cause { role, kind, name, note, explained, tests, elsewhere, .. } = cause;
    let evidence = match (kind, elsewhere) {
        (Kind::Trap, _) => {
            format!("{name}: {note}: so are {explained} of {tests} answers that would show it")
        }
        (Kind::Flag, Some((failed, all))) => {
            format!("{name}: {explained} of {tests} such tests fail, {failed} of {all} others: {note}")
        }
        _ => format!("{note}: {explained} of {failures} failures"),
    };
    match role {
        Role::Cause => evidence,
        Role::Pattern => format!("a pattern: {evidence}"),
        Role::Besides => format!("besides: {evidence}"),
    }
}
