//! The answer of a comparison in a sentence: which of the two best is better, and which of the others are worse.

use super::alike::{Frame, apart};
use super::measure::BLOCKS;
use mean_information::scan::Difference;

/// The quantile of Student's distribution with 19 degrees of freedom, one less than blocks: 95 % lie within it on both sides.
const CLEAR: f64 = 2.093;

/// A trajectory that has less mean information than the best one.
pub(super) struct Behind<'a> {
    /// Its short name.
    pub(super) label: &'a str,
    /// How far the best one is above it.
    pub(super) difference: Difference,
    /// The frame in which it moves as the best one does, if it does.
    pub(super) frame: Option<Frame>,
}

impl Behind<'_> {
    /// Tells whether the best one is better by more than chance explains: 97.5 % of the differences that chance makes are
    /// below. Of two that move alike none is.
    fn is_worse(&self) -> bool {
        let Self { difference, frame, .. } = self;
        frame.is_none()
            && difference.blocks() == BLOCKS
            && difference.value() > CLEAR * difference.standard_error()
    }

    /// Returns the difference in standard errors; `None` if there is none.
    fn errors(&self) -> Option<f64> {
        let error = self.difference.standard_error();
        (error > 0.0).then(|| self.difference.value() / error)
    }

    /// Tells which of the two is better.
    fn against(&self, best: &str) -> String {
        let (next, value) = (self.label, self.difference.value());
        if self.is_worse() {
            let times = self.errors().map_or(String::new(), |times| format!(", {times:.1} standard errors"));
            return format!(
                "{best} makes the most consistent map: {value:.4} bits per cell above {next}{times}"
            );
        }
        let why = match (&self.frame, self.errors()) {
            (Some(frame), _) => format!(": {next} {}", frame.in_words(best)),
            (None, Some(times)) if value > 0.0 => {
                let [times, clear] = apart(times, CLEAR, 1);
                format!(
                    ": {best} is ahead by {value:.4} bits per cell, {times} standard errors, where {clear} would tell"
                )
            }
            (None, None) if value > 0.0 => format!(": {best} is ahead by {value:.4} bits per cell"),
            _ => String::new(),
        };
        format!("{best} and {next} are not told apart by these scans{why}")
    }
}

/// Says which trajectory makes the most consistent map, or that none does, and which others than the second are clearly worse;
/// `others` from the most information to the least.
pub(super) fn verdict(best: &str, others: &[Behind<'_>]) -> Option<String> {
    let (next, rest) = others.split_first()?;
    let worse = rest.iter().filter(|other| other.is_worse()).map(|other| match other.errors() {
        Some(times) => format!("; {} is worse by {times:.1} standard errors", other.label),
        None => format!("; {} is worse by {:.4} bits per cell", other.label, other.difference.value()),
    });
    Some(next.against(best) + &worse.collect::<String>())
}
