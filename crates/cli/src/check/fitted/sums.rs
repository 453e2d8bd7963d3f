//! A sum of some parts in place of the integral of Eq. 7: by trapezia, at midpoints, and so on, in as many parts as people
//! choose. Where `sigma` is small against a part, it misses the obstacle or exaggerates it.

use super::{Answer, Candidate, Case, FloatFormat, answers, cause};
use mean_information_report::hex_float;
use mean_information_report::protocol::{Argument, Arguments};
use std::f64::consts::LN_2;

/// The numbers of parts that are tried: of points or of intervals between them.
const PARTS: [usize; 27] = [
    10, 20, 50, 64, 99, 100, 128, 199, 200, 255, 256, 499, 500, 511, 512, 999, 1000, 1023, 1024, 1999, 2000,
    2047, 2048, 4999, 5000, 9999, 10_000,
];
/// How near answers are to a sum, relatively: sums of floats, and of single ones.
const WIDTHS: [f64; 2] = [1e-9, 1e-4];
/// The number of answers that a rule is fitted to.
const SAMPLE: usize = 9;

/// The rules for sums.
#[derive(Clone, Copy, PartialEq)]
enum Rule {
    Trapezia,
    Midpoints,
    Left,
    Right,
    Points,
    Simpson,
}

impl Rule {
    const ALL: [Self; 6] =
        [Self::Trapezia, Self::Midpoints, Self::Left, Self::Right, Self::Points, Self::Simpson];

    fn name(self, parts: usize) -> String {
        match self {
            Self::Trapezia => format!("a sum of {parts} trapezia"),
            Self::Midpoints => format!("a sum at {parts} midpoints"),
            Self::Left => format!("a sum at the left ends of {parts} parts"),
            Self::Right => format!("a sum at the right ends of {parts} parts"),
            Self::Points => format!("the mean of {} points", parts + 1),
            Self::Simpson => format!("Simpson's sum of {parts} parts"),
        }
    }

    /// Returns the point `k` of `parts + 1`, in parts of the whole, and its weight.
    fn point(self, k: usize, parts: usize) -> (f64, f64) {
        let is_end = k == 0 || k == parts;
        let weight = match self {
            Self::Trapezia => {
                if is_end {
                    0.5
                } else {
                    1.0
                }
            }
            Self::Midpoints | Self::Left => f64::from(k < parts),
            Self::Right => f64::from(k > 0),
            Self::Points => 1.0,
            Self::Simpson => {
                if is_end {
                    1.0
                } else if k % 2 == 1 {
                    4.0
                } else {
                    2.0
                }
            }
        };
        let place = k as f64 + if self == Self::Midpoints { 0.5 } else { 0.0 };
        (place / parts as f64, weight)
    }
}

/// A room: range and sigma.
type Room = [f64; 2];

/// Returns the mean information along the beam, each point weighted by its distance if by area.
fn sum(rule: Rule, parts: usize, by_area: bool, [range, sigma]: Room) -> f64 {
    let length = range + sigma * libm::sqrt(2.0 * LN_2);
    let (mut total, mut weights) = (0.0, 0.0);
    for k in 0..=parts {
        let (place, weight) = rule.point(k, parts);
        let rho = place * length;
        let weight = if by_area { weight * rho } else { weight };
        total += weight * information((rho - range) / sigma);
        weights += weight;
    }
    // The length of the beam and its area are known without a sum, but for the mean of points.
    let whole = match (rule, by_area) {
        (Rule::Points, _) => weights,
        (Rule::Simpson, false) => 3.0 * parts as f64,
        (Rule::Simpson, true) => 1.5 * parts as f64 * length,
        (_, false) => parts as f64,
        (_, true) => 0.5 * parts as f64 * length,
    };
    total / whole
}

/// Returns the information at `t` standard deviations from the obstacle, as floats have it.
fn information(t: f64) -> f64 {
    let p = libm::exp(-t * t / 2.0);
    let term = |q: f64| if q > 0.0 { -q * libm::log2(q) } else { 0.0 };
    1.0 - term(p) - term(1.0 - p)
}

/// Returns the mistakes that fit the answers.
pub(super) fn mistakes(op: &str, cases: &[Case<'_>]) -> Vec<Candidate> {
    let by_area = match op {
        "limit.radial" => false,
        "limit.area" => true,
        _ => return Vec::new(),
    };
    let answers = answers(cases, room);
    let model = |answer: &Answer<Room>, (rule, parts): (Rule, usize)| {
        let value = sum(rule, parts, by_area, answer.asked);
        let [double, single] = WIDTHS;
        (value, value.abs() * if answer.format == FloatFormat::F64 { double } else { single })
    };
    let wrong: Vec<_> = answers.iter().filter(|a| !a.number.right && a.format == FloatFormat::F64).collect();
    // All kinds of rooms: in the most extreme ones floats overflow.
    let sample: Vec<_> = wrong.iter().step_by(wrong.len() / SAMPLE + 1).collect();
    let follows = |answer: &Answer<Room>, rule| {
        let (value, width) = model(answer, rule);
        answer.follows(value, width) == Some(true)
    };
    let rules = Rule::ALL.into_iter().flat_map(|rule| PARTS.map(|parts| (rule, parts)));
    let fitting = rules
        .map(|rule| (sample.iter().filter(|answer| follows(answer, rule)).count(), rule))
        .filter(|(count, _)| 2 * count > sample.len());
    let best = fitting.max_by_key(|(count, _)| *count).map(|(_, rule)| rule);
    let found = best.and_then(|(rule, parts)| {
        let note = format!(
            "takes {} for the integral: exact only where sigma is large against a part",
            rule.name(parts)
        );
        cause("coarse-sum", note, &answers, |answer| model(answer, (rule, parts)))
    });
    found.into_iter().collect()
}

fn room(arguments: &Arguments) -> Option<Room> {
    let float = |name: &str| match arguments.get(name)? {
        Argument::Float(text) => hex_float::parse::<f64>(text).ok(),
        _ => None,
    };
    Some([float("range")?, float("sigma")?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use mean_information::limit::{Weight, closed_form};
    use mean_information::sensor::GaussianSensor;

    /// With many parts every rule tends to the limit; Simpson's and trapezia faster than those that miss an end.
    #[test]
    fn sums_tend_to_the_limit() {
        let (range, sigma) = (2.0, 0.3);
        let sensor = GaussianSensor::new(range, sigma).unwrap();
        for (by_area, weight) in [(false, Weight::Radial), (true, Weight::Area)] {
            let limit = closed_form(&sensor, weight);
            for rule in Rule::ALL {
                let error = |parts| (sum(rule, parts, by_area, [range, sigma]) - limit).abs();
                let most = if matches!(rule, Rule::Left | Rule::Right | Rule::Points) { 3e-4 } else { 1e-7 };
                assert!(error(10_000) < most, "{}: {}", rule.name(10_000), error(10_000));
                assert!(error(10) > 1e-4, "{}: {}", rule.name(10), error(10));
            }
        }
    }

    /// Computed by a loop of Python.
    #[test]
    fn a_thousand_trapezia() {
        let found = sum(Rule::Trapezia, 1000, false, [2.0, 0.2]);
        assert!((found - 0.7893368829585508).abs() < 1e-12, "{found}");
    }
}
