//! The whole report again: its five figures, the claim of its abstract, and a table of what can be checked in it.
//!
//! Everything is computed, nothing is stored; the same bytes on every run, whatever the number of threads.

mod circle;
mod closure;
mod convergence;
mod fusion;
mod page;
mod resolution;
mod sensor;

use crate::failure::Failure;
use crate::output::{Record, Report, Value, folded, text_table};
use crate::plots::Sheet;
use crate::progress::Progress;
use std::panic::resume_unwind;
use std::thread;

/// A figure.
#[derive(Debug)]
pub struct Figure {
    /// The name of its file.
    pub file: &'static str,
    /// The name in the report, and the subject.
    pub title: &'static str,
    /// The report's statement of what it shows.
    pub should: &'static str,
    /// The finding here.
    pub shows: String,
    /// The formulas below them on the page.
    pub theory: &'static [Theory],
    /// The picture, which describes itself to those who do not see it.
    pub picture: Sheet,
}

/// A formula that a figure rests on.
#[derive(Debug)]
pub struct Theory {
    /// Words before the formula, for a reader who has not read the report.
    pub words: &'static str,
    /// The formula, in MathML.
    pub formula: &'static str,
    /// The chapter of the book that derives it, by its name and in words.
    pub chapter: [&'static str; 2],
}

/// Something the report says that can be checked.
#[derive(Debug)]
pub struct Claim {
    /// The place in the report.
    pub place: &'static str,
    /// The claim.
    pub claim: &'static str,
    /// The measurement; of a corrected claim also what holds instead.
    pub measured: String,
    /// The verdict.
    pub verdict: Verdict,
}

/// The verdict on a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The claim holds as it stands.
    Pass,
    /// The claim does not hold as it stands; what holds instead was checked.
    Corrected,
    /// The claim, or what should hold instead, was found not to hold.
    Fail,
}

impl Verdict {
    /// Returns the verdict in a word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Corrected => "corrected",
            Self::Fail => "fail",
        }
    }
}

impl Claim {
    /// Creates a claim that holds as it stands if the check does.
    fn new(place: &'static str, claim: &'static str, holds: bool, measured: String) -> Self {
        let verdict = if holds { Verdict::Pass } else { Verdict::Fail };
        Self { place, claim, measured, verdict }
    }

    /// Creates a claim that does not hold as it stands; `holds` is the check of what does.
    fn corrected(place: &'static str, claim: &'static str, holds: bool, measured: String) -> Self {
        let verdict = if holds { Verdict::Corrected } else { Verdict::Fail };
        Self { place, claim, measured, verdict }
    }
}

/// Figures with the claims that go with them.
#[derive(Debug, Default)]
struct Section {
    figures: Vec<Figure>,
    claims: Vec<Claim>,
}

/// A section, by the name it has in messages.
type Job = (&'static str, fn() -> Result<Section, Failure>);

/// The report, reproduced.
#[derive(Debug)]
pub struct Paper {
    /// The figures, in the order of the report.
    pub figures: Vec<Figure>,
    /// The claims, in the order of the figures.
    pub claims: Vec<Claim>,
}

impl Paper {
    /// Computes all of it, each section in a thread.
    ///
    /// # Errors
    /// None is known.
    pub fn reproduce() -> Result<Self, Failure> {
        Self::of(&[
            ("Fig. 1", fusion::section),
            ("Fig. 2", resolution::section),
            ("Fig. 3", sensor::section),
            ("Fig. 4", circle::section),
            ("Fig. 5", convergence::section),
            ("closing a loop", closure::section),
        ])
    }

    fn of(jobs: &[Job]) -> Result<Self, Failure> {
        let progress = Progress::new(jobs.len());
        progress.begin("the figures of the report");
        let sections: Vec<_> = thread::scope(|scope| {
            let progress = &progress;
            let start = |&(name, job): &Job| {
                scope.spawn(move || {
                    let section = job();
                    progress.begin(&format!("{name} is drawn"));
                    progress.done();
                    section
                })
            };
            let threads: Vec<_> = jobs.iter().map(start).collect();
            // A panic there is one here.
            let ended = |thread: thread::ScopedJoinHandle<'_, _>| {
                thread.join().unwrap_or_else(|panic| resume_unwind(panic))
            };
            threads.into_iter().map(ended).collect()
        });
        let mut paper = Self { figures: Vec::new(), claims: Vec::new() };
        for section in sections {
            let Section { figures, claims } = section?;
            paper.figures.extend(figures);
            paper.claims.extend(claims);
        }
        Ok(paper)
    }

    /// Returns whether no check failed.
    pub fn holds(&self) -> bool {
        self.claims.iter().all(|claim| claim.verdict != Verdict::Fail)
    }

    /// Writes the page: all figures and claims in one file.
    pub fn page(&self) -> String {
        page::page(self)
    }
}

impl Report for Paper {
    fn table(&self) -> String {
        let rows = self.claims.iter().map(|claim| {
            [
                folded(claim.place, 16),
                folded(claim.claim, 44),
                folded(&claim.measured, 56),
                claim.verdict.name().to_owned(),
            ]
        });
        text_table(["in the report", "claim", "measured", "verdict"], rows)
    }

    fn rows(&self) -> Vec<Record> {
        let record = |claim: &Claim| {
            Record(vec![
                ("place", Value::Text(claim.place.to_owned())),
                ("claim", Value::Text(claim.claim.to_owned())),
                ("measured", Value::Text(claim.measured.clone())),
                ("verdict", Value::Text(claim.verdict.name().to_owned())),
            ])
        };
        self.claims.iter().map(record).collect()
    }

    fn json(&self) -> Value {
        let figure = |figure: &Figure| {
            Record(vec![
                ("file", Value::Text(figure.file.to_owned())),
                ("title", Value::Text(figure.title.to_owned())),
                ("should_show", Value::Text(figure.should.to_owned())),
                ("shows", Value::Text(figure.shows.clone())),
            ])
        };
        Value::Record(Record(vec![
            ("figures", Value::Records(self.figures.iter().map(figure).collect())),
            ("claims", Value::Records(self.rows())),
        ]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sections that take little time; `crates/cli/tests/paper.rs` has all of them.
    #[test]
    fn a_part_of_the_report() {
        let jobs: [Job; 2] = [("Fig. 3", sensor::section), ("Fig. 4", circle::section)];
        let paper = Paper::of(&jobs).unwrap();
        assert!(paper.holds());
        let files: Vec<_> = paper.figures.iter().map(|figure| figure.file).collect();
        assert_eq!(files, ["figure-3.svg", "figure-4.svg"]);
        let page = paper.page();
        for figure in &paper.figures {
            assert!(
                page.contains(&figure.picture.element()) && page.contains(figure.should),
                "{}",
                figure.file
            );
        }
        assert!(page.contains("2 claims: 2 hold as they stand, 0 are corrected, 0 failed."), "{page}");
        assert_eq!(paper.page(), Paper::of(&jobs).unwrap().page());
    }

    #[test]
    fn a_failed_check_is_a_failed_report() {
        let verdicts = [
            Claim::new("", "", true, String::new()),
            Claim::new("", "", false, String::new()),
            Claim::corrected("", "", true, String::new()),
            Claim::corrected("", "", false, String::new()),
        ];
        let expected = [Verdict::Pass, Verdict::Fail, Verdict::Corrected, Verdict::Fail];
        for (claim, verdict) in verdicts.into_iter().zip(expected) {
            assert_eq!(claim.verdict, verdict);
            let paper = Paper { figures: Vec::new(), claims: vec![claim] };
            assert_eq!(paper.holds(), verdict != Verdict::Fail);
        }
    }
}
