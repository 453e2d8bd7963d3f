//! What the failures of an operation have in common: causes, the most likely one first.
//!
//! A cause explains some failures; it is the likelier the more of them it explains, and the fewer tests there are on
//! which it should have shown but did not. Its score is, with `P = explained / tests on which it should show` and
//! `R = explained / failures`,
//!
//! * `P (1 + R) / 2` for a trap: where a known mistake's value is answered wherever it is known, the mistake is there,
//!   though others may be there as well. Not every test has every trap it could have: a trap that as many tests of a
//!   format have as have any explains the share `P` of that format's other failures, too;
//! * `2 P R / (P + R)`, times a weight below 1, for anything else.
//!
//! What explains most failures, `R > 1/2`, and shows on half of its tests (of a flag's, on two thirds) comes first. What
//! explains a quarter is a pattern, listed below; what explains less is not listed, but for answers of another kind than
//! was due: NaN for a number, a number for an error. They are few where arguments are, and no rounding explains them.

use super::candidate::{Candidate, Case, Kind, Role, indices};
use super::facts::facts;
use super::fitted::fitted;
use super::judge::Answered;
use super::values::{FloatFormat, Trap};
use super::vectors::Vectors;
use super::{TestFailure, Verdict};
use mean_information_report::hex_float;
use std::collections::{HashMap, HashSet};

/// An answer is that of a trap if it is as near to it as this, relatively.
const TRAP_WIDTH: f64 = f64::EPSILON * 4_294_967_296.0; // 2^-20
/// The least ratio of failures of a flag's tests to those without it at which the flag says something.
const LIFT: usize = 2;
/// The weight of a flag: where failures are says less than what they are.
const FLAG_WEIGHT: f64 = 0.7;
/// The part of the failures that a trap, or a fitted mistake, explains after which no other cause is needed.
const WHOLE: f64 = 0.9;

/// A cause: what some failures have in common.
#[derive(Clone, Debug, PartialEq)]
pub struct Cause {
    /// The part that it has in the failures.
    pub role: Role,
    /// The kind of evidence.
    pub kind: Kind,
    /// The name of the flag, of the trap or of the fact.
    pub name: String,
    /// The mistake, or the subject of the tests, in words.
    pub note: String,
    /// The number of failures that it explains.
    pub explained: usize,
    /// The number of answered tests on which it should show.
    pub tests: usize,
    /// The failures among tests without the flag, and the number of these tests; for flags only.
    pub elsewhere: Option<(usize, usize)>,
    /// The score, from 0 to 1.
    pub score: f64,
    /// True if likelier causes explain all that it explains.
    pub redundant: bool,
}

/// Returns the causes of an operation's failures, the most likely one first.
pub(super) fn diagnose(vectors: &Vectors, verdicts: &[Verdict]) -> Vec<Cause> {
    let run = vectors.tests.iter().zip(verdicts).filter_map(|(test, verdict)| match verdict {
        Verdict::Passed(judged) => Some(Case { test, failure: None, judged: Some(judged) }),
        Verdict::Failed(failure) | Verdict::Known(failure) => match failure {
            TestFailure::Answer(judged) => Some(Case { test, failure: Some(failure), judged: Some(judged) }),
            TestFailure::Port(_) => Some(Case { test, failure: Some(failure), judged: None }),
            TestFailure::NotRun(_) => None,
        },
        Verdict::Skipped(_) => None,
    });
    let cases: Vec<_> = run.collect();
    let traps = vectors.traps.iter().filter_map(|(name, note)| trap(&cases, name, note));
    let mut candidates: Vec<_> = traps.collect();
    candidates.extend(facts(&cases));
    candidates.extend(fitted(&vectors.op, &cases));
    candidates.extend(vectors.flags.iter().filter_map(|(name, note)| flag(&cases, name, note)));
    rank(&cases, candidates)
}

fn rank(cases: &[Case<'_>], candidates: Vec<Candidate>) -> Vec<Cause> {
    let failures = cases.iter().filter(|case| case.failure.is_some()).count();
    let recall = |c: &Candidate| match c.kind {
        Kind::Trap => explained_by(cases, c) / failures as f64,
        Kind::Flag | Kind::Fact => c.explained.len() as f64 / failures as f64,
    };
    let score = |c: &Candidate| {
        let (explained, tests) = (c.explained.len() as f64, c.tests as f64);
        match c.kind {
            Kind::Trap => explained / tests * (1.0 + recall(c)) / 2.0,
            // 2 P R / (P + R)
            Kind::Flag | Kind::Fact => c.weight * 2.0 * explained / (failures as f64 + tests),
        }
    };
    let ranked = |c: Candidate| {
        let precision = c.explained.len() as f64 / c.tests as f64;
        Some((Role::of(c.kind, c.is_of_kind, precision, recall(&c))?, score(&c), c))
    };
    let mut scored: Vec<_> = candidates.into_iter().filter_map(ranked).collect();
    // Of equal ones that which explains more, then the first.
    scored.sort_by(|(p, a, c), (q, b, d)| {
        let explained = d.explained.len().cmp(&c.explained.len());
        p.cmp(q).then(b.total_cmp(a)).then(explained)
    });
    let mut known: HashSet<usize> = HashSet::new();
    let mut whole = false;
    let mut last = None;
    let causes = scored.into_iter().map(|(role, score, candidate)| {
        // Equals cannot be told apart.
        let lesser = last.replace((role, score)) != Some((role, score));
        // Rounding may explain nearly all, but not these.
        let redundant = lesser
            && (whole && role != Role::Besides
                || candidate.explained.iter().all(|index| known.contains(index)));
        whole |= candidate.has_values && recall(&candidate) >= WHOLE;
        known.extend(&candidate.explained);
        let Candidate { kind, name, note, explained, tests, elsewhere, .. } = candidate;
        Cause { role, kind, name, note, explained: explained.len(), tests, elsewhere, score, redundant }
    });
    causes.collect()
}

fn trap(cases: &[Case<'_>], name: &str, note: &str) -> Option<Candidate> {
    let explained = indices(cases, |case| {
        let value = case.test.traps.get(name);
        value.zip(case.wrong_answer()).is_some_and(|(trap, judged)| is_caught(*trap, &judged.answer))
    });
    let tests = cases.iter().filter(|case| case.judged.is_some() && case.test.traps.contains_key(name));
    (!explained.is_empty()).then(|| Candidate {
        kind: Kind::Trap,
        name: name.to_owned(),
        note: note.to_owned(),
        explained,
        tests: tests.count(),
        elsewhere: None,
        weight: 1.0,
        has_values: true,
        is_of_kind: false,
    })
}

/// Returns whether the answer is that of the trap.
fn is_caught(trap: Trap, answer: &Answered) -> bool {
    match (trap, answer) {
        (Trap::Count(trap), Answered::Count(count)) => trap == *count,
        (Trap::Float(trap), Answered::Float(answer, _)) => is_near(trap, *answer),
        (Trap::Float(trap), Answered::NotOfFormat(text)) => {
            hex_float::parse(text).is_ok_and(|answer| is_near(trap, answer))
        }
        _ => false,
    }
}

fn is_near(trap: f64, answer: f64) -> bool {
    trap == answer
        || trap.is_nan() && answer.is_nan()
        || trap.is_finite() && (answer - trap).abs() <= TRAP_WIDTH * trap.abs()
}

/// Estimates how many failures a trap explains, also among tests that lack it because enough have it.
fn explained_by(cases: &[Case<'_>], trap: &Candidate) -> f64 {
    let of_format = |format: FloatFormat| {
        let in_format = |case: &&Case<'_>| case.test.format == format;
        let mut having: HashMap<&str, usize> = HashMap::new();
        for name in cases.iter().filter(in_format).flat_map(|case| case.test.traps.keys()) {
            *having.entry(name).or_default() += 1;
        }
        let most = having.values().max().copied().unwrap_or_default();
        let own = having.get(trap.name.as_str()).copied().unwrap_or_default();
        let explained = trap.explained.iter().filter(|index| in_format(&&cases[**index])).count() as f64;
        if own == 0 || own < most {
            return explained;
        }
        let failures = cases.iter().filter(in_format).filter(|case| case.failure.is_some()).count();
        explained.max(explained / own as f64 * failures as f64)
    };
    [FloatFormat::F32, FloatFormat::F64].into_iter().map(of_format).sum()
}

fn flag(cases: &[Case<'_>], name: &str, note: &str) -> Option<Candidate> {
    let has = |case: Case<'_>| case.test.flags.iter().any(|flag| flag == name);
    let explained = indices(cases, |case| case.failure.is_some() && has(case));
    let tests = cases.iter().filter(|case| has(**case)).count();
    let failures = cases.iter().filter(|case| case.failure.is_some()).count();
    let elsewhere = (failures - explained.len(), cases.len() - tests);
    // explained / tests > LIFT * elsewhere.0 / elsewhere.1
    let telling = explained.len() * elsewhere.1 > LIFT * elsewhere.0 * tests;
    telling.then(|| Candidate {
        kind: Kind::Flag,
        name: name.to_owned(),
        note: note.to_owned(),
        explained,
        tests,
        elsewhere: Some(elsewhere),
        weight: FLAG_WEIGHT,
        has_values: false,
        is_of_kind: false,
    })
}

#[cfg(test)]
mod tests {
    use super::super::judge::judge;
    use super::super::values::NEAREST;
    use super::super::vectors::Test;
    use super::*;
    use mean_information_report::protocol::{Claim, Reply};
    use serde_json::json;

    /// Tests in f64 whose exact results are `wants`, answered with `answers`; flags and traps of each by its index.
    fn causes(
        wants: &[f64],
        answers: &[f64],
        flags: fn(usize) -> Vec<&'static str>,
        traps: fn(usize) -> Vec<(&'static str, f64)>,
    ) -> Vec<Cause> {
        let test = |(index, want): (usize, &f64)| {
            let traps =
                traps(index).into_iter().map(|(name, x)| (name.to_owned(), hex_float::format(x).into()));
            let want = format!("{want:e}");
            json!({"id": index.to_string(), "format": "f64", "args": {}, "want": {"lo": want, "hi": want},
                "flags": flags(index), "traps": traps.collect::<serde_json::Map<String, serde_json::Value>>()})
        };
        let tests: Vec<_> = wants.iter().enumerate().map(test).collect();
        let vectors: Vectors = serde_json::from_value(json!({
            "op": "", "version": 1, "tolerance_ulp": 0.5, "flags": {"Left": "", "Random": ""},
            "traps": {"A": "", "B": "", "C": ""}, "tests": tests,
        }))
        .unwrap();
        let verdict = |(test, x): (&Test, &f64)| {
            let judged = judge(test, NEAREST, Claim::default(), &Reply::Result(hex_float::format(*x).into()));
            if judged.right { Verdict::Passed(judged) } else { Verdict::Failed(TestFailure::Answer(judged)) }
        };
        let verdicts: Vec<_> = vectors.tests.iter().zip(answers).map(verdict).collect();
        diagnose(&vectors, &verdicts)
    }

    /// Results without a pattern, from 1/4 to 3/4.
    fn wants(n: u32) -> Vec<f64> {
        (0..n).map(|i| 0.25 + f64::from(i * 37 % 101) / 202.0).collect()
    }

    fn names(causes: &[Cause]) -> Vec<&str> {
        causes.iter().map(|cause| cause.name.as_str()).collect()
    }

    /// A wrong answer that follows no pattern.
    fn astray(i: usize, x: f64) -> f64 {
        x * (1.01 + 0.013 * (i * 29 % 31) as f64)
    }

    #[test]
    fn a_flag_says_something_if_its_tests_fail_more_often() {
        let wants = wants(60);
        let answers = |failing: fn(usize) -> bool| -> Vec<f64> {
            let answer = |(i, x): (usize, &f64)| if failing(i) { astray(i, *x) } else { *x };
            wants.iter().enumerate().map(answer).collect()
        };
        let flags = |i: usize| if i < 20 { vec!["Left", "Random"] } else { vec!["Random"] };
        let left = causes(&wants, &answers(|i| i < 18 || i == 40), flags, |_| Vec::new());
        assert_eq!(names(&left), ["Left"]);
        assert_eq!((left[0].explained, left[0].tests, left[0].elsewhere), (18, 20, Some((1, 40))));
        // As often here as there.
        assert_eq!(names(&causes(&wants, &answers(|i| i % 2 == 0), flags, |_| Vec::new())), [] as [&str; 0]);
    }

    /// A and B have as many tests as any trap, C has fewer: it could have had others, but its mistake is not theirs.
    #[test]
    fn a_trap_cut_off_may_explain_the_rest() {
        let wants = wants(60);
        let wrong: Vec<f64> = wants.iter().enumerate().map(|(i, x)| astray(i, *x)).collect();
        let traps = |i: usize| {
            let right = 0.25 + (i as u32 * 37 % 101) as f64 / 202.0;
            let mut traps = Vec::new();
            if i.is_multiple_of(2) {
                traps.push(("A", astray(i, right)));
            } else {
                traps.push(("B", right / 7.0));
            }
            if i < 10 {
                traps.push(("C", astray(i, right)));
            }
            traps
        };
        let causes = causes(&wants, &wrong, |_| vec!["Random"], traps);
        // C explains a sixth.
        assert_eq!(names(&causes), ["A"]);
        assert_eq!((causes[0].score, causes[0].explained, causes[0].redundant), (1.0, 30, false));
    }

    /// B has tests enough to show what it explains, and A, C are answered in few of the failures that they could be in.
    #[test]
    fn a_quarter_is_a_pattern() {
        let wants = wants(60);
        let wrong: Vec<f64> = wants.iter().enumerate().map(|(i, x)| astray(i, *x)).collect();
        let traps = |i: usize| {
            let right = 0.25 + (i as u32 * 37 % 101) as f64 / 202.0;
            let mut traps = vec![("B", right / 7.0)];
            match i {
                0..18 => traps.push(("A", astray(i, right))),
                18..30 => traps.push(("C", astray(i, right))),
                _ => {}
            }
            traps
        };
        let causes = causes(&wants, &wrong, |_| vec!["Random"], traps);
        assert_eq!(names(&causes), ["A"]);
        assert_eq!((causes[0].role, causes[0].explained), (Role::Pattern, 18));
    }

    #[test]
    fn causes_that_cannot_be_told_apart_are_both_said() {
        let wants = wants(20);
        let wrong: Vec<f64> = wants.iter().enumerate().map(|(i, x)| astray(i, *x)).collect();
        let traps = |i: usize| {
            let x = astray(i, 0.25 + (i as u32 * 37 % 101) as f64 / 202.0);
            vec![("A", x * (1.0 + 1e-7)), ("B", x), ("C", x * (1.0 + 1e-5))]
        };
        let causes = causes(&wants, &wrong, |_| vec!["Random"], traps);
        assert_eq!(names(&causes), ["A", "B"]);
        assert!(causes.iter().all(|cause| cause.score == 1.0 && !cause.redundant));
    }

    /// Four of 60, beside errors of rounding.
    #[test]
    fn nan_is_said_however_rare() {
        let wants = wants(60);
        let answers: Vec<_> =
            (0..60).map(|i| if i < 4 { f64::NAN } else { wants[i].next_up().next_up() }).collect();
        let causes = causes(&wants, &answers, |_| Vec::new(), |_| Vec::new());
        assert_eq!(names(&causes), ["rounding", "nan"]);
        assert_eq!((causes[1].role, causes[1].explained, causes[1].redundant), (Role::Besides, 4, false));
    }

    /// Small errors among large ones, a value that occurs now and then: neither is a cause.
    #[test]
    fn patterns_of_few_are_none() {
        let wants = wants(60);
        let answer = |(i, x): (usize, &f64)| match i {
            0..10 => x.next_up().next_up(),
            10..15 => x * (1.0 + 1e-9),
            15..20 => 0.9,
            _ => astray(i, *x),
        };
        let answers: Vec<f64> = wants.iter().enumerate().map(answer).collect();
        assert_eq!(names(&causes(&wants, &answers, |_| Vec::new(), |_| Vec::new())), [] as [&str; 0]);
    }
}
