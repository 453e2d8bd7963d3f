//! Wrong forms of the entropy without a number to fit: signs, tables, half precision, one distribution. The traps of the
//! vectors hold the commonest; people write more of each, in nats, with one term, observed before or after the table.

use super::measure::{Measure, occupancies, width};
use super::{Answer, Candidate, Case, answers, cause};
use std::f64::consts::{LN_2, LOG10_2};

/// Bits, nats and decimal digits, and how they are called.
const UNITS: [(f64, &str); 3] =
    [(1.0, ""), (LN_2, ", and takes natural logarithms"), (LOG10_2, ", and takes decimal logarithms")];
/// The numbers of steps from 0 to 1 of the tables that are tried.
const STEPS: [u16; 12] = [10, 20, 50, 64, 100, 128, 200, 255, 256, 500, 1000, 1024];

/// Returns the mistakes that fit the answers.
pub(super) fn mistakes(op: &str, cases: &[Case<'_>]) -> Vec<Candidate> {
    let Some(measure) = Measure::of(op) else { return Vec::new() };
    let answers = answers(cases, occupancies);
    let mut found = Vec::new();
    let mut try_cells = |name: &str, note: String, entropy: &dyn Fn(f64) -> f64| {
        let model = |answer: &Answer<Vec<f64>>| {
            let value = measure.value(&answer.asked, entropy);
            (value, width(answer, value))
        };
        found.extend(cause(name, note, &answers, model));
    };
    for (unit, words) in UNITS {
        let sign = |what: &str| format!("adds p log p{what} where it is to be subtracted{words}");
        try_cells("missing-sign", sign(" + (1-p) log (1-p)"), &|p| -unit * entropy(p));
        try_cells("missing-sign", sign(", and that alone,"), &|p| -unit * term(p));
    }
    try_cells("half-precision", "keeps occupancies in half precision".to_owned(), &|p| entropy(half(p)));
    for steps in STEPS {
        let note = |how: &str| {
            format!(
                "looks up a table of {} entries, with the occupancy {how}: all between get one answer",
                steps + 1
            )
        };
        let steps = f64::from(steps);
        try_cells("table", note("cut"), &|p| entropy(libm::floor(steps * p) / steps));
        try_cells("table", note("rounded"), &|p| entropy(libm::rint(steps * p) / steps));
    }
    for (unit, words) in UNITS {
        let model = |answer: &Answer<Vec<f64>>| {
            let value = measure.value_of_all(&answer.asked, |cells| unit * of_one_distribution(cells));
            (value, width(answer, value))
        };
        let note = format!(
            "takes the cells of a map for one distribution, normalised to a sum of 1, as scipy.stats.entropy does{words}"
        );
        // Of one cell that is no mistake but a constant.
        if op.starts_with("map.") {
            found.extend(cause("normalised", note, &answers, model));
        }
    }
    found
}

/// Returns `-q log2 q`.
fn term(q: f64) -> f64 {
    if q > 0.0 { -q * libm::log2(q) } else { 0.0 }
}

/// Returns the entropy of a cell in bits.
fn entropy(p: f64) -> f64 {
    term(p) + term(1.0 - p)
}

/// Returns the entropy of cells that are normalised to a sum of 1.
fn of_one_distribution(cells: &[f64]) -> f64 {
    let total: f64 = cells.iter().sum();
    if total > 0.0 { cells.iter().map(|p| term(p / total)).sum() } else { 0.0 }
}

/// Returns the float of half precision nearest to a number from 0 to 1, ties to even.
fn half(x: f64) -> f64 {
    // 11 digits, or multiples of 2^-24 below 2^-14.
    let exponent = libm::floor(libm::log2(x.max(f64::MIN_POSITIVE))).max(-14.0);
    let spacing = libm::exp2(exponent - 10.0);
    libm::rint(x / spacing) * spacing
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By NumPy: `float(np.float16(x))`.
    #[test]
    fn half_precision_is_that_of_numpy() {
        for (x, nearest) in [
            (0.0, 0.0),
            (1.0, 1.0),
            (0.1, 0.0999755859375),
            (0.3, 0.300048828125),
            (0.99999, 1.0),
            (1e-5, 1.0013580322265625e-05),
            (3e-8, 5.960464477539063e-08),
            (2e-8, 0.0),
        ] {
            assert_eq!(half(x), nearest, "{x}");
        }
    }

    /// By SciPy: `scipy.stats.entropy([0.25, 0.5, 0, 0.75], base=2)`.
    #[test]
    fn one_distribution_is_that_of_scipy() {
        assert!((of_one_distribution(&[0.25, 0.5, 0.0, 0.75]) - 1.4591479170272448).abs() < 1e-15);
        assert_eq!(of_one_distribution(&[0.0, 0.0]), 0.0);
    }
}
