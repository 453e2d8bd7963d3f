//! A small number `e` in the entropy of a cell: added within the logarithms, `-p log2(p + e) - (1-p) log2(1-p + e)`, or
//! within one of them, or the end of the interval `[e, 1 - e]` that occupancies are clamped to, everywhere or
//! within the logarithms alone. All are monotone in `e`,
//! so each answer gives it by bisection; the value that fits most answers is taken.

use super::measure::{Measure, occupancies, width};
use super::{Answer, Candidate, Case, FloatFormat, LEAST, answers, cause};
use crate::output::short;
use std::f64::consts::LN_2;

/// The number of answers that `e` is fitted to, and the most cells of a map among them.
const SAMPLE: usize = 24;
const SHORT_MAP: usize = 16;
/// The greatest `e`.
const GREATEST: f64 = 0.4;
const BISECTIONS: usize = 60;
/// The relative distance within which `e` is taken for a decimal of one digit.
const ROUND: f64 = 1e-3;

/// The mistakes.
#[derive(Clone, Copy)]
enum Mistake {
    /// Within both logarithms, that of `p` alone, that of `1 - p` alone.
    Added,
    AddedToOccupied,
    AddedToFree,
    Clamped,
    /// `-p log2(max(p, e))`, and the same of `1 - p`.
    ClampedInLogarithm,
}

const MISTAKES: [Mistake; 5] = [
    Mistake::Added,
    Mistake::AddedToOccupied,
    Mistake::AddedToFree,
    Mistake::Clamped,
    Mistake::ClampedInLogarithm,
];

impl Mistake {
    /// Returns the entropy of a cell in bits.
    fn entropy(self, p: f64, e: f64) -> f64 {
        let (p, [occupied, free]) = match self {
            Self::Added => (p, [e, e]),
            Self::AddedToOccupied => (p, [e, 0.0]),
            Self::AddedToFree => (p, [0.0, e]),
            Self::Clamped => (p.clamp(e, 1.0 - e), [0.0, 0.0]),
            Self::ClampedInLogarithm => (p, [(e - p).max(0.0), (e - (1.0 - p)).max(0.0)]),
        };
        let term = |q: f64, added: f64| if q > 0.0 { -q * libm::log2(q + added) } else { 0.0 };
        term(p, occupied) + term(1.0 - p, free)
    }

    /// Returns the least `e`: what is smaller is lost in the rounding of the logarithms.
    fn least(self) -> f64 {
        if matches!(self, Self::Clamped) { 1e-17 } else { 1e-15 }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Added | Self::AddedToOccupied | Self::AddedToFree => "epsilon-in-logarithm",
            Self::Clamped | Self::ClampedInLogarithm => "clamped",
        }
    }

    fn note(self, e: f64, unit: f64) -> String {
        let e = short(e);
        let nats = if unit == 1.0 { "" } else { ", and takes natural logarithms" };
        match self {
            Self::Added => format!(
                "adds {e} within the logarithm, log2(p + {e}){nats}: the entropy of p = 1 is negative then, that of \
                 small p wrong; 0 log 0 is 0, without it"
            ),
            Self::AddedToOccupied | Self::AddedToFree => {
                let (one, certain) = if matches!(self, Self::AddedToFree) { ("1 - p", 0) } else { ("p", 1) };
                format!(
                    "adds {e} within one of the logarithms, log2({one} + {e}){nats}: the entropy of p = {certain} is \
                     negative then; 0 log 0 is 0, without it"
                )
            }
            Self::Clamped => format!(
                "clamps occupancies to [{e}, 1 - {e}]{nats}: p = 0 and 1 are certain, and all p below {e} get one answer"
            ),
            Self::ClampedInLogarithm => format!(
                "clamps the arguments of the logarithms, log2(max(p, {e})){nats}: what is nearer to certainty has too small a \
                 logarithm; 0 log 0 is 0, without it"
            ),
        }
    }
}

/// Returns the mistakes that fit the answers.
pub(super) fn mistakes(op: &str, cases: &[Case<'_>]) -> Vec<Candidate> {
    let Some(measure) = Measure::of(op) else { return Vec::new() };
    let answers = answers(cases, occupancies);
    let mut found = Vec::new();
    for mistake in MISTAKES {
        // In bits, and in nats.
        for unit in [1.0, LN_2] {
            let model = |answer: &Answer<Vec<f64>>, e: f64| {
                let value = measure.value(&answer.asked, |p| unit * mistake.entropy(p, e));
                (value, width(answer, value))
            };
            if let Some(e) = fit(&answers, mistake.least(), model) {
                let note = mistake.note(e, unit);
                found.extend(cause(mistake.name(), note, &answers, |answer| model(answer, e)));
            }
        }
    }
    found.extend(machine_epsilon(measure, &answers));
    found
}

/// Returns the spacing of doubles at 1, added within the logarithms, as a cause of wrong entropies. It is no more than the
/// rounding of most of them: it shows where both terms are as small, by the floats that come out, so nothing is fitted.
fn machine_epsilon(measure: Measure, answers: &[Answer<Vec<f64>>]) -> Option<Candidate> {
    let term = |q: f64| -q * libm::log2(q + f64::EPSILON);
    let model = |answer: &Answer<Vec<f64>>| {
        let terms = || answer.asked.iter().flat_map(|&p| [term(p), term(1.0 - p)]);
        let (value, size): (f64, f64) = (terms().sum(), terms().map(f64::abs).sum());
        let rounded =
            if answer.format == FloatFormat::F32 { f64::from(f32::EPSILON) * value.abs() } else { 0.0 };
        (value, rounded + 4.0 * f64::EPSILON * answer.asked.len() as f64 * size)
    };
    let note = Mistake::Added.note(f64::EPSILON, 1.0);
    let note = format!("{note}; this number is DBL_EPSILON, Number.EPSILON, finfo(float).eps");
    let is_entropy = matches!(measure, Measure::Entropy);
    is_entropy.then(|| cause(Mistake::Added.name(), note, answers, model)).flatten()
}

/// Returns the `e` that fits most of the wrong answers that are furthest off.
fn fit(
    answers: &[Answer<Vec<f64>>],
    least: f64,
    model: impl Fn(&Answer<Vec<f64>>, f64) -> (f64, f64),
) -> Option<f64> {
    let mut sample: Vec<_> =
        answers.iter().filter(|a| !a.number.right && (1..=SHORT_MAP).contains(&a.asked.len())).collect();
    sample.sort_by(|a, b| b.number.error.absolute.total_cmp(&a.number.error.absolute));
    // Doubles say more than single floats.
    sample.sort_by_key(|answer| answer.format == FloatFormat::F32);
    sample.truncate(SAMPLE);
    let fitting = |e: f64| {
        let follows = |answer: &&&Answer<_>| {
            let (value, width) = model(answer, e);
            answer.follows(value, width) == Some(true)
        };
        sample.iter().filter(follows).count()
    };
    let solutions = sample
        .iter()
        .filter_map(|answer| solution(answer.number.value, [least, GREATEST], |e| model(answer, e).0));
    let (fits, e) = solutions.map(|e| (fitting(e), e)).max_by_key(|(fits, _)| *fits)?;
    let round: f64 = format!("{e:.0e}").parse().ok()?;
    let e = if (round - e).abs() <= ROUND * e && fitting(round) >= fits { round } else { e };
    (fits >= LEAST).then_some(e)
}

/// Returns the `e` of a range at which a monotone function has a value, by bisection of its logarithm.
fn solution(value: f64, range: [f64; 2], function: impl Fn(f64) -> f64) -> Option<f64> {
    let [low, high] = range.map(&function);
    let rises = low < high;
    if low == high || !(low.min(high)..=low.max(high)).contains(&value) {
        return None;
    }
    let [mut low, mut high] = range.map(libm::log);
    for _ in 0..BISECTIONS {
        let middle = f64::midpoint(low, high);
        if (function(libm::exp(middle)) < value) == rises {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(libm::exp(high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_is_found_again() {
        for (mistake, cells) in [
            (Mistake::Added, &[1.0][..]),
            (Mistake::Added, &[0.3]),
            (Mistake::Added, &[0.25, 1e-12, 0.5, 0.9375]),
            (Mistake::AddedToOccupied, &[1.0]),
            (Mistake::AddedToFree, &[0.0, 0.75]),
            (Mistake::Clamped, &[0.0]),
            (Mistake::Clamped, &[1e-9, 0.3, 1.0]),
            (Mistake::ClampedInLogarithm, &[1e-9, 0.3, 1.0]),
        ] {
            for measure in [Measure::Entropy, Measure::Information, Measure::MeanInformation] {
                let value = |e| measure.value(cells, |p| LN_2 * mistake.entropy(p, e));
                let range = [mistake.least(), GREATEST];
                let e = solution(value(3e-7), range, value).unwrap();
                assert!((e / 3e-7 - 1.0).abs() < 1e-6, "{cells:?}: {e}");
                assert_eq!(solution(value(0.41), range, value), None);
            }
        }
    }

    #[test]
    fn the_mistakes_are_those_of_the_chapter() {
        let near = |a: f64, b: f64| (a - b).abs() < 1e-14;
        assert!(near(Mistake::Added.entropy(1.0, 1e-9), -1.4426950e-9));
        assert!(near(Mistake::AddedToOccupied.entropy(1.0, 1e-9), -1.4426950e-9));
        assert!(near(Mistake::AddedToFree.entropy(1.0, 1e-9), 0.0));
        assert!(near(Mistake::Added.entropy(0.25, 0.0), 0.8112781244591328));
        assert!(near(
            Mistake::ClampedInLogarithm.entropy(0.0625, 0.125),
            0.0625 * 3.0 - 0.9375 * libm::log2(0.9375)
        ));
        assert!(near(Mistake::Clamped.entropy(1e-8, 1e-7), 2.469619163220e-6));
        assert_eq!(Mistake::Clamped.entropy(1e-8, 1e-7), Mistake::Clamped.entropy(0.0, 1e-7));
        assert_eq!(Mistake::Clamped.entropy(0.375, 1e-7), Mistake::Added.entropy(0.375, 0.0));
    }
}
