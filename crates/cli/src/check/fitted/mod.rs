//! Mistakes of more forms, or with a number in them, than a list of traps can hold. A number is fitted to some answers;
//! the mistake is a fact if the other answers have its values, too.
//!
//! | module | mistakes |
//! |---|---|
//! | `cells` | a small number added within the logarithm, occupancies clamped to an interval |
//! | `forms` | signs, tables, half precision, one distribution: what has no number to fit |
//! | `measure` | what operations make of the entropies of their cells |
//! | `sums` | an integral taken for a sum of some parts |

mod cells;
mod forms;
mod measure;
mod sums;

use super::candidate::{Candidate, Case};
use super::facts::{Number, PLAIN, fact, numbers};
use super::values::FloatFormat;
use mean_information_report::protocol::Arguments;

/// The least number of answers that have the value of a mistake where it differs from the right one.
const LEAST: usize = 3;

/// A number that was answered, and what was asked.
struct Answer<A> {
    number: Number,
    format: FloatFormat,
    asked: A,
}

/// Returns the mistakes that fit the answers to an operation.
pub(super) fn fitted(op: &str, cases: &[Case<'_>]) -> Vec<Candidate> {
    let mut found = cells::mistakes(op, cases);
    found.extend(forms::mistakes(op, cases));
    found.extend(sums::mistakes(op, cases));
    found
}

/// Returns the numbers that were answered, right ones too, with what was asked, as `read` understands it.
fn answers<A>(cases: &[Case<'_>], read: impl Fn(&Arguments) -> Option<A>) -> Vec<Answer<A>> {
    let answer = |number: Number| {
        let test = cases[number.case].test;
        Some(Answer { number, format: test.format, asked: read(&test.args)? })
    };
    numbers(cases).into_iter().filter_map(answer).collect()
}

impl<A> Answer<A> {
    /// Returns whether the answer is a value of a mistake, within `width`; `None` if it may be the right value as well.
    fn follows(&self, value: f64, width: f64) -> Option<bool> {
        let differs = (value - self.number.error.exact).abs() > 2.0 * width;
        differs.then(|| self.is_near(value, width))
    }

    fn is_near(&self, value: f64, width: f64) -> bool {
        (self.number.value - value).abs() <= width
    }
}

/// Returns a mistake as a cause, if most answers have its values where these differ from the right ones. It explains all
/// wrong answers that have its values. `model` gives the value of the mistake, and how near an answer is to be.
fn cause<A>(
    name: &str,
    note: String,
    answers: &[Answer<A>],
    model: impl Fn(&Answer<A>) -> (f64, f64),
) -> Option<Candidate> {
    let mut explained = Vec::new();
    let (mut following, mut others) = (0, 0);
    for answer in answers {
        let (value, width) = model(answer);
        match answer.follows(value, width) {
            Some(true) => following += 1,
            Some(false) => others += 1,
            None => {}
        }
        if !answer.number.right && answer.is_near(value, width) {
            explained.push(answer.number.case);
        }
    }
    let tests = explained.len() + others;
    (following >= LEAST && following > others).then(|| Candidate {
        tests,
        has_values: true,
        ..fact(name, note, PLAIN, explained)
    })
}
