//! What causes are made of: the tests that were run, and what some of their failures have in common.

use super::TestFailure;
use super::judge::Judged;
use super::vectors::Test;

/// The kind of evidence for a cause.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Answers have the value that a known mistake gives.
    Trap,
    /// Tests of one flag fail, others less.
    Flag,
    /// The answers themselves.
    Fact,
}

impl Kind {
    /// Returns its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Trap => "trap",
            Self::Flag => "flag",
            Self::Fact => "fact",
        }
    }
}

/// The part that a cause has in an operation's failures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Role {
    /// A cause: most of them are explained by it.
    Cause,
    /// A pattern: at least a quarter of them is explained by it.
    Pattern,
    /// Another kind of answer than was due, to fewer of them.
    Besides,
}

impl Role {
    /// Returns its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cause => "cause",
            Self::Pattern => "pattern",
            Self::Besides => "besides",
        }
    }

    /// Returns the role of what explains a share `recall` of the failures and shows on a share `precision` of the tests
    /// on which it should; none if it explains less than a quarter, unless it is another kind of answer than was due.
    /// Where failures are says less than what they are, so of a flag's tests more have to fail.
    pub(super) fn of(kind: Kind, of_kind: bool, precision: f64, recall: f64) -> Option<Self> {
        let least = if kind == Kind::Flag { 2.0 / 3.0 } else { 0.5 };
        if recall > 0.5 && precision >= least {
            return Some(Self::Cause);
        }
        if recall >= 0.25 { Some(Self::Pattern) } else { of_kind.then_some(Self::Besides) }
    }
}

/// A test that was run, and how it ended.
#[derive(Clone, Copy, Debug)]
pub(super) struct Case<'a> {
    pub(super) test: &'a Test,
    /// The failure; none if the answer was right.
    pub(super) failure: Option<&'a TestFailure>,
    /// The answer, if there was one.
    pub(super) judged: Option<&'a Judged>,
}

impl<'a> Case<'a> {
    /// Returns the wrong answer, if one was given.
    pub(super) fn wrong_answer(self) -> Option<&'a Judged> {
        self.judged.filter(|judged| !judged.right)
    }
}

/// A cause before it is ranked: which cases it explains.
pub(super) struct Candidate {
    pub(super) kind: Kind,
    pub(super) name: String,
    pub(super) note: String,
    /// Indices of cases.
    pub(super) explained: Vec<usize>,
    /// The number of answered tests on which it should show.
    pub(super) tests: usize,
    /// The failures among tests without the flag, and the number of these tests; for flags only.
    pub(super) elsewhere: Option<(usize, usize)>,
    /// The most that the score of a cause can be that is no trap.
    pub(super) weight: f64,
    /// True if it gives the very values of the wrong answers: where it explains nearly all, nothing else is wrong.
    pub(super) has_values: bool,
    /// True if answers are of another kind than was due, NaN or no number: few of them matter, too.
    pub(super) is_of_kind: bool,
}

/// Returns the indices of the cases for which a condition holds.
pub(super) fn indices(cases: &[Case<'_>], holds: impl Fn(Case<'_>) -> bool) -> Vec<usize> {
    (0..cases.len()).filter(|&index| holds(cases[index])).collect()
}
