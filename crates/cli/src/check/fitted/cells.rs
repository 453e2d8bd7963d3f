//! A small number `e` in the entropy of a cell: added within the logarithms, `-p log2(p + e) - (1-p) log2(1-p + e)`, or
//! the end of the interval `[e, 1 - e]` that occupancies are clamped to. Both are monotone in `e`, so each answer gives
//! it by bisection; the value that fits most answers is taken.

use super::{Answer, Candidate, Case, FloatFormat, LEAST, answers, cause};
use crate::output::short;
use mean_information_report::hex_float;
use mean_information_report::protocol::{Argument, Arguments};
use std::f64::consts::LN_2;

/// The number of answers that `e` is fitted to, and the most cells of a map among them.
const SAMPLE: usize = 24;
const SHORT_MAP: usize = 16;
/// The range of `e`: what is smaller is lost in the rounding of the logarithms.
const RANGE: [f64; 2] = [1e-15, 0.4];
const BISECTIONS: usize = 60;
/// The relative distance within which `e` is taken for a decimal of one digit.
const ROUND: f64 = 1e-3;

/// The mistakes.
#[derive(Clone, Copy)]
enum Mistake {
    Added,
    Clamped,
}

impl Mistake {
    /// Returns the entropy of a cell in bits.
    fn entropy(self, p: f64, e: f64) -> f64 {
        let (p, added) = match self {
            Self::Added => (p, e),
            Self::Clamped => (p.clamp(e, 1.0 - e), 0.0),
        };
        let term = |q: f64| if q > 0.0 { -q * libm::log2(q + added) } else { 0.0 };
        term(p) + term(1.0 - p)
    }

    fn name(self) -> &'static str {
        match self {
            Self::Added => "epsilon-in-logarithm",
            Self::Clamped => "clamped",
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
            Self::Clamped => format!(
                "clamps occupancies to [{e}, 1 - {e}]{nats}: p = 0 and 1 are certain, and all p below {e} get one answer"
            ),
        }
    }
}

/// What an operation makes of the entropies of its cells.
#[derive(Clone, Copy)]
enum Measure {
    Entropy,
    Information,
    MeanInformation,
}

impl Measure {
    fn of(op: &str) -> Option<Self> {
        match op {
            "cell.entropy" | "map.entropy" => Some(Self::Entropy),
            "cell.information" | "map.information" => Some(Self::Information),
            "map.mean_information" => Some(Self::MeanInformation),
            _ => None,
        }
    }

    fn value(self, cells: &[f64], entropy: impl Fn(f64) -> f64) -> f64 {
        let sum = |value: &dyn Fn(f64) -> f64| cells.iter().map(|&p| value(p)).sum::<f64>();
        match self {
            Self::Entropy => sum(&entropy),
            Self::Information => sum(&|p| 1.0 - entropy(p)),
            Self::MeanInformation => {
                let observed = cells.iter().filter(|p| **p != 0.5).count();
                sum(&|p| if p == 0.5 { 0.0 } else { 1.0 - entropy(p) }) / observed.max(1) as f64
            }
        }
    }
}

/// Returns the mistakes that fit the answers.
pub(super) fn mistakes(op: &str, cases: &[Case<'_>]) -> Vec<Candidate> {
    let Some(measure) = Measure::of(op) else { return Vec::new() };
    let answers = answers(cases, occupancies);
    let mut found = Vec::new();
    for mistake in [Mistake::Added, Mistake::Clamped] {
        // In bits, and in nats.
        for unit in [1.0, LN_2] {
            let model = |answer: &Answer<Vec<f64>>, e: f64| {
                let value = measure.value(&answer.asked, |p| unit * mistake.entropy(p, e));
                (value, width(answer, value))
            };
            if let Some(e) = fit(&answers, model) {
                let note = mistake.note(e, unit);
                found.extend(cause(mistake.name(), note, &answers, |answer| model(answer, e)));
            }
        }
    }
    found
}

/// Returns the cells of a map, or the one cell.
fn occupancies(arguments: &Arguments) -> Option<Vec<f64>> {
    let float = |text: &String| hex_float::parse::<f64>(text).ok();
    match (arguments.get("p"), arguments.get("cells")) {
        (Some(Argument::Float(p)), _) => Some(vec![float(p)?]),
        (_, Some(Argument::List(cells))) => cells.iter().map(float).collect(),
        _ => None,
    }
}

/// Returns how far floats added up one by one may be from a sum `value`.
fn width(answer: &Answer<Vec<f64>>, value: f64) -> f64 {
    let epsilon = match answer.format {
        FloatFormat::F32 => f64::from(f32::EPSILON),
        FloatFormat::F64 => f64::EPSILON,
    };
    epsilon * answer.asked.len() as f64 * (3.0 + value.abs())
}

/// Returns the `e` that fits most of the wrong answers that are furthest off.
fn fit(answers: &[Answer<Vec<f64>>], model: impl Fn(&Answer<Vec<f64>>, f64) -> (f64, f64)) -> Option<f64> {
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
    let solutions = sample.iter().filter_map(|answer| solution(answer.number.value, |e| model(answer, e).0));
    let (fits, e) = solutions.map(|e| (fitting(e), e)).max_by_key(|(fits, _)| *fits)?;
    let round: f64 = format!("{e:.0e}").parse().ok()?;
    let e = if (round - e).abs() <= ROUND * e && fitting(round) >= fits { round } else { e };
    (fits >= LEAST).then_some(e)
}

/// Returns the `e` at which a monotone function has a value, by bisection of its logarithm.
fn solution(value: f64, function: impl Fn(f64) -> f64) -> Option<f64> {
    let [low, high] = RANGE.map(&function);
    let rises = low < high;
    if low == high || !(low.min(high)..=low.max(high)).contains(&value) {
        return None;
    }
    let [mut low, mut high] = RANGE.map(libm::log);
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
            (Mistake::Clamped, &[0.0]),
            (Mistake::Clamped, &[1e-9, 0.3, 1.0]),
        ] {
            for measure in [Measure::Entropy, Measure::Information, Measure::MeanInformation] {
                let value = |e| measure.value(cells, |p| LN_2 * mistake.entropy(p, e));
                let e = solution(value(3e-7), value).unwrap();
                assert!((e / 3e-7 - 1.0).abs() < 1e-6, "{cells:?}: {e}");
                assert_eq!(solution(value(0.41), value), None);
            }
        }
    }

    #[test]
    fn the_mistakes_are_those_of_the_chapter() {
        let near = |a: f64, b: f64| (a - b).abs() < 1e-14;
        assert!(near(Mistake::Added.entropy(1.0, 1e-9), -1.4426950e-9));
        assert!(near(Mistake::Added.entropy(0.25, 0.0), 0.8112781244591328));
        assert!(near(Mistake::Clamped.entropy(1e-8, 1e-7), 2.469619163220e-6));
        assert_eq!(Mistake::Clamped.entropy(1e-8, 1e-7), Mistake::Clamped.entropy(0.0, 1e-7));
        assert_eq!(Mistake::Clamped.entropy(0.375, 1e-7), Mistake::Added.entropy(0.375, 0.0));
    }
}
