//! Round numbers along an axis.

use crate::output::{decimal_exponent, short};
use std::ops::RangeInclusive;

/// Returns the multiples of 1, 2 or 5 times a power of ten within `start..=end`, at most `most` and one, with texts.
///
/// Decimal throughout, so that a tick is labelled `0.3` and not `0.30000000000000004`. `start` is finite and below `end`,
/// and no further from 0 than some hundred times their distance, or the texts would be cut.
pub(super) fn ticks(start: f64, end: f64, most: usize) -> Vec<(f64, String)> {
    let exponent = decimal_exponent(end - start);
    // From the step that gives fewest ticks downwards; the last that does not give too many.
    let steps = (exponent - 4..=exponent + 1).rev().flat_map(|n| [5_i64, 2, 1].map(|m| (m, n)));
    let mut chosen = Vec::new();
    for (m, n) in steps {
        let first = (start / decimal(m, n).0).floor() as i64;
        let multiples = (first..first + most as i64 + 3).map(|i| decimal(i * m, n));
        let fitting: Vec<_> = multiples.filter(|&(x, _)| start <= x && x <= end).collect();
        if fitting.len() > most + 1 {
            break;
        }
        chosen = fitting;
    }
    chosen
}

/// The decimal logarithms, within a range of them, of 1, 2 and 5 times powers of ten; of the powers alone where they are
/// many, of the numbers of [`ticks`] where there are fewer than two.
pub(super) fn logarithmic_ticks(range: &RangeInclusive<f64>) -> Vec<f64> {
    let (start, end) = (*range.start(), *range.end());
    let digits: &[f64] = if end - start > 3.5 { &[1.0] } else { &[1.0, 2.0, 5.0] };
    let decades = start.floor() as i32..=end.ceil() as i32;
    let all = decades.flat_map(|n| digits.iter().map(move |d| f64::from(n) + libm::log10(*d)));
    let within: Vec<f64> = all.filter(|x| range.contains(x)).collect();
    if within.len() < 2 {
        return ticks(libm::exp10(start), libm::exp10(end), 5)
            .into_iter()
            .map(|(x, _)| libm::log10(x))
            .collect();
    }
    within
}

/// Returns the least of 1, 2 and 5 times the powers of ten that is at least a fifth of `span`, which is positive and finite.
pub(super) fn round_step(span: f64) -> f64 {
    let rough = span / 5.0;
    let decade: f64 = format!("1e{}", decimal_exponent(rough)).parse().unwrap_or(rough);
    decade * [1.0, 2.0, 5.0, 10.0].into_iter().find(|m| m * decade >= rough).unwrap_or(10.0)
}

/// Returns `digits * 10^n` and its text.
fn decimal(digits: i64, n: i32) -> (f64, String) {
    let x = format!("{digits}e{n}").parse().unwrap_or(f64::NAN);
    (x, short(x))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(end: f64, most: usize) -> Vec<String> {
        ticks(0.0, end, most).into_iter().map(|(_, text)| text).collect()
    }

    #[test]
    fn round_steps() {
        assert_eq!(texts(7.7, 8), ["0", "1", "2", "3", "4", "5", "6", "7"]);
        assert_eq!(texts(7.7, 5), ["0", "2", "4", "6"]);
        assert_eq!(texts(0.32, 4), ["0", "0.1", "0.2", "0.3"]);
        assert_eq!(texts(0.3, 3), ["0", "0.1", "0.2", "0.3"]);
        assert_eq!(texts(384.0, 10), ["0", "50", "100", "150", "200", "250", "300", "350"]);
        assert_eq!(texts(3e-9, 3), ["0", "1e-9", "2e-9", "3e-9"]);
    }

    #[test]
    fn axes_that_do_not_start_at_0() {
        let texts =
            |start, end, most| ticks(start, end, most).into_iter().map(|(_, text)| text).collect::<Vec<_>>();
        assert_eq!(texts(-0.4, 9.6, 5), ["0", "2", "4", "6", "8"]);
        assert_eq!(texts(-10.0, 10.0, 4), ["-10", "-5", "0", "5", "10"]);
        assert_eq!(texts(-0.35, -0.05, 3), ["-0.3", "-0.2", "-0.1"]);
        assert_eq!(texts(499.0, 509.0, 5), ["500", "502", "504", "506", "508"]);
        assert_eq!(texts(3.1, 3.9, 0), ["3.5"]);
    }

    #[test]
    fn logarithmic_axes() {
        let texts = |start: f64, end: f64| {
            let ticks = logarithmic_ticks(&(libm::log10(start)..=libm::log10(end)));
            ticks.into_iter().map(|x| short(libm::exp10(x))).collect::<Vec<_>>()
        };
        assert_eq!(texts(0.03, 3.0), ["0.05", "0.1", "0.2", "0.5", "1", "2"]);
        assert_eq!(texts(0.03, 300.0), ["0.1", "1", "10", "100"]);
        assert_eq!(texts(0.0107, 0.0127), ["0.011", "0.0115", "0.012", "0.0125"]);
        assert_eq!(texts(0.11, 0.33), ["0.15", "0.2", "0.25", "0.3"]);
    }

    #[test]
    fn extremes_end() {
        for end in [f64::MIN_POSITIVE, 5e-324, f64::MAX] {
            let ticks = ticks(0.0, end, 6);
            assert!(
                (1..=7).contains(&ticks.len()) && ticks.iter().all(|&(x, _)| x <= end),
                "{end}: {ticks:?}"
            );
        }
        assert_eq!(texts(7.7, 0), ["0"]);
    }
}
