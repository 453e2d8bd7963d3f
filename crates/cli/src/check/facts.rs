//! Causes that show in the answers themselves, whatever the operation.

use super::TestFailure;
use super::candidate::{Candidate, Case, Kind, indices};
use super::judge::{Answered, Deviation, Judged};
use super::values::{FloatFormat, Want};
use crate::output::short;
use mean_information::Real;
use mean_information_report::protocol::errors;
use std::collections::{BTreeMap, BTreeSet};

/// Weights of a cause: `PLAIN` for a certain but general fact, `PATTERN` for a numerical pattern.
pub(super) const PLAIN: f64 = 0.95;
const PATTERN: f64 = 0.9;
/// The least number of answers in which a pattern shows.
const LEAST: usize = 3;
/// The largest error, in ulp, that is laid to rounding and not to a mistake.
const FEW_ULP: f64 = 64.0;
/// Half an ulp of `f32`, and half of one of `f64`.
const TWICE_ULP: f64 = 0.5 + 1.0 / 1_073_741_824.0 + f64::EPSILON;
/// The least share of wrong numbers with small errors, for rounding to be the cause.
const MOST: f64 = 0.9;
/// The relative error below which two numbers have digits in common.
const NEAR: f64 = f64::EPSILON * 68_719_476_736.0; // 2^-16
const SAME: f64 = NEAR / 16.0;

/// Returns the facts that failures show.
pub(super) fn facts(cases: &[Case<'_>]) -> Vec<Candidate> {
    let mut candidates = Vec::new();
    for &(name, is_of_kind, note, holds) in PLAIN_FACTS {
        candidates
            .push(Candidate { is_of_kind, ..fact(name, note.to_owned(), PLAIN, indices(cases, holds)) });
    }
    candidates.extend(words(cases));
    let patterns = [
        lag(cases),
        constant(cases),
        factor(cases),
        missing_sign(cases),
        missing_sign_of_entropy(cases),
        complement(cases),
        few_ulp(cases),
        twice(cases),
        half_precision(cases),
    ];
    candidates.extend(patterns.into_iter().flatten());
    candidates.extend(bits(cases));
    candidates.retain(|candidate| !candidate.explained.is_empty());
    candidates
}

/// Creates a fact that shows on no test but those it explains.
pub(super) fn fact(name: &str, note: String, weight: f64, explained: Vec<usize>) -> Candidate {
    let tests = explained.len();
    let (kind, name) = (Kind::Fact, name.to_owned());
    Candidate {
        kind,
        name,
        note,
        explained,
        tests,
        elsewhere: None,
        weight,
        has_values: false,
        is_of_kind: false,
    }
}

type PlainFact = (&'static str, bool, &'static str, fn(Case<'_>) -> bool);

/// Name, whether it is another kind of answer than was due, what is wrong, and how it is told. The verdict shows troubles one
/// by one.
const PLAIN_FACTS: &[PlainFact] = &[
    ("trouble", false, "crashes, hangs or breaks the protocol", |case| {
        matches!(case.failure, Some(TestFailure::Port(_)))
    }),
    (
        "not-of-format",
        true,
        "answers numbers that the format asked for does not have: in double precision where single is asked for",
        |case| answered(case, |answer| matches!(answer, Answered::NotOfFormat(_))),
    ),
    (
        "unreadable",
        true,
        "answers something else than a hexadecimal float in a string, or for a count a JSON integer",
        |case| answered(case, |answer| matches!(answer, Answered::Unreadable { .. })),
    ),
    ("nan", true, "answers NaN where there is a number", |case| {
        numeric(case) && answered(case, |answer| matches!(answer, Answered::Float(x, _) if x.is_nan()))
    }),
    ("infinite", true, "answers infinity where there is a finite number", |case| {
        numeric(case) && answered(case, |answer| matches!(answer, Answered::Float(x, _) if x.is_infinite()))
    }),
    ("nan-for-error", true, "answers NaN where the error \"domain\" is to be answered", |case| {
        refused(case) && answered(case, |answer| matches!(answer, Answered::Float(x, _) if x.is_nan()))
    }),
    (
        "accepts",
        true,
        "computes a number where arguments lie outside the domain: they are not checked",
        |case| {
            let number = |answer: &Answered| match answer {
                Answered::Float(x, _) => !x.is_nan(),
                other => matches!(other, Answered::Count(_)),
            };
            refused(case) && answered(case, number)
        },
    ),
    ("refuses", true, "answers the error \"domain\" to arguments that lie in the domain", |case| {
        !refused(case)
            && answered(case, |answer| matches!(answer, Answered::Error(word) if word == errors::DOMAIN))
    }),
    ("negative-zero", false, "answers -0 where +0 is the nearest float", |case| {
        answered(case, |answer| matches!(answer, Answered::Float(x, _) if *x == 0.0 && x.is_sign_negative()))
    }),
];

fn answered(case: Case<'_>, holds: impl Fn(&Answered) -> bool) -> bool {
    case.wrong_answer().is_some_and(|judged| holds(&judged.answer))
}

fn numeric(case: Case<'_>) -> bool {
    matches!(case.test.want, Want::Enclosure { .. })
}

fn refused(case: Case<'_>) -> bool {
    case.test.want == Want::Domain
}

/// Returns a fact for each error that has another name.
fn words(cases: &[Case<'_>]) -> Vec<Candidate> {
    let mut by_word: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (index, case) in cases.iter().enumerate() {
        if let Some(Answered::Error(word)) = case.wrong_answer().map(|judged| &judged.answer)
            && word != errors::DOMAIN
        {
            by_word.entry(word).or_default().push(index);
        }
    }
    let note = |word: &str| format!("answers the error \"{word}\"");
    let named =
        |(word, explained)| Candidate { is_of_kind: true, ..fact("error", note(word), PLAIN, explained) };
    by_word.into_iter().map(named).collect()
}

/// A finite number that was answered.
#[derive(Clone, Copy)]
pub(super) struct Number {
    /// The index of the case.
    pub(super) case: usize,
    pub(super) right: bool,
    pub(super) value: f64,
    pub(super) error: Deviation,
}

/// Returns the numbers that were answered where one was wanted, right ones too.
pub(super) fn numbers(cases: &[Case<'_>]) -> Vec<Number> {
    let number = |(case, Case { judged, .. }): (usize, &Case<'_>)| match judged {
        Some(Judged { right, answer: Answered::Float(value, _), error: Some(error), .. }) => {
            Some(Number { case, right: *right, value: *value, error: *error })
        }
        _ => None,
    };
    cases.iter().enumerate().filter_map(number).collect()
}

/// Returns the wrong numbers that were answered.
fn wrong_numbers(cases: &[Case<'_>]) -> Vec<Number> {
    numbers(cases).into_iter().filter(|number| !number.right).collect()
}

/// Returns a pattern as a cause, if enough numbers follow it.
fn followed(
    cases: &[Case<'_>],
    name: &str,
    note: String,
    follows: impl Fn(&Number) -> bool,
) -> Option<Candidate> {
    let numbers = numbers(cases);
    let wrong = numbers.iter().filter(|number| !number.right && follows(number));
    let explained: Vec<_> = wrong.map(|number| number.case).collect();
    let others = numbers.iter().filter(|number| !follows(number)).count();
    let tests = explained.len() + others;
    // A quarter of the tests: less is chance.
    let telling = explained.len() >= LEAST && 4 * explained.len() >= tests;
    telling.then(|| Candidate { tests, ..fact(name, note, PATTERN, explained) })
}

/// Detects answers to the request before, under the number of this one.
fn lag(cases: &[Case<'_>]) -> Option<Candidate> {
    let answers = |judged: &Judged, want: &Want| match (&judged.answer, want) {
        (Answered::Float(x, _), Want::Enclosure { lo, .. }) => {
            let exact = lo.value.approximate();
            (x - exact).abs() <= SAME * exact.abs()
        }
        (Answered::Count(count), Want::Count(wanted)) => count == wanted,
        (Answered::Error(word), Want::Domain) => word == errors::DOMAIN,
        _ => false,
    };
    // Each answer that is not that of its own request: its place, and whether it is that of the request before.
    let others = cases.windows(2).enumerate().filter_map(|(index, pair)| {
        let judged = pair[1].judged.filter(|judged| !answers(judged, &pair[1].test.want))?;
        Some((index + 1, answers(judged, &pair[0].test.want)))
    });
    let (tests, explained) = others.fold((0, Vec::new()), |(tests, mut explained), (index, lags)| {
        explained.extend(lags.then_some(index));
        (tests + 1, explained)
    });
    let note = "answers what the request before asked: answers lag behind by one, under the right numbers"
        .to_owned();
    (explained.len() >= LEAST && 2 * explained.len() >= tests)
        .then(|| Candidate { tests, ..fact("lag", note, PLAIN, explained) })
}

/// Detects `f32` answers rounded twice: the exact result lies next to a midpoint, onto which rounding to `f64` puts it.
fn twice(cases: &[Case<'_>]) -> Option<Candidate> {
    let wrong = wrong_numbers(cases);
    let single = |number: &&Number| cases[number.case].test.format == FloatFormat::F32;
    let single: Vec<_> = wrong.iter().filter(single).collect();
    let explained: Vec<_> = single.iter().filter(|n| n.error.ulp < TWICE_ULP).map(|n| n.case).collect();
    let note =
        "answers in f32 miss by hardly more than half an ulp: they are rounded to f64 first, then to f32";
    (!explained.is_empty() && explained.len() == single.len())
        .then(|| fact("rounded-twice", note.to_owned(), PLAIN, explained))
}

/// Detects one answer to everything.
fn constant(cases: &[Case<'_>]) -> Option<Candidate> {
    let mut by_value: BTreeMap<u64, usize> = BTreeMap::new();
    for number in wrong_numbers(cases) {
        *by_value.entry(number.value.to_bits()).or_default() += 1;
    }
    let (bits, _) = by_value.into_iter().max_by_key(|(_, count)| *count)?;
    let note = format!("answers {} whatever is asked", short(f64::from_bits(bits)));
    followed(cases, "constant", note, |number| number.value.to_bits() == bits)
}

/// Detects the exact result times a factor.
fn factor(cases: &[Case<'_>]) -> Option<Candidate> {
    let ratio = |number: &Number| number.value / number.error.exact;
    let mut ratios: Vec<_> = wrong_numbers(cases).iter().map(ratio).collect();
    ratios.retain(|ratio| ratio.is_finite() && *ratio != 0.0);
    ratios.sort_by(f64::total_cmp);
    let median = *ratios.get(ratios.len() / 2)?;
    let alike = |ratio: f64| (ratio - median).abs() <= SAME * median.abs();
    let known = KNOWN_FACTORS.iter().find(|(factor, _)| alike(*factor)).map(|(_, what)| *what);
    let note = format!("answers {} times the exact result{}", short(median), known.unwrap_or_default());
    let zero = |number: &Number| number.value == 0.0 && number.error.exact == 0.0;
    let factor = followed(cases, "factor", note, |number| alike(ratio(number)) || zero(number));
    factor.filter(|_| (median - 1.0).abs() > NEAR)
}

/// Detects negative answers where results are positive.
fn missing_sign(cases: &[Case<'_>]) -> Option<Candidate> {
    let numbers: Vec<_> = numbers(cases).into_iter().filter(|number| number.error.exact > 0.0).collect();
    let negative: Vec<_> = numbers.iter().filter(|n| !n.right && n.value < 0.0).collect();
    let ratio = |number: &&Number| number.value / number.error.exact;
    let mut ratios: Vec<_> = negative.iter().map(|number| -ratio(number)).collect();
    ratios.sort_by(f64::total_cmp);
    let median = *ratios.get(ratios.len() / 2)?;
    let known = KNOWN_FACTORS.iter().find(|(factor, _)| (median - factor).abs() <= SAME * factor);
    let note = format!(
        "answers negative numbers: the minus sign before the sum is missing{}",
        known
            .map(|(factor, what)| format!(", and {} times the result{what}", short(*factor)))
            .unwrap_or_default()
    );
    let explained: Vec<_> = negative.iter().map(|number| number.case).collect();
    let telling = explained.len() >= LEAST && 2 * explained.len() >= numbers.len();
    telling.then(|| Candidate { tests: numbers.len(), ..fact("missing-sign", note, PLAIN, explained) })
}

/// Factors that are known by name.
const KNOWN_FACTORS: &[(f64, &str)] = &[
    (std::f64::consts::LN_2, ", ln 2: nats in place of bits"),
    (std::f64::consts::LOG2_E, ", 1 / ln 2: divided by ln 2 once more than needed"),
    (std::f64::consts::LOG10_2, ", log10 2: decimal logarithms in place of log2"),
];

/// Detects answers that are 1 less the exact result.
fn complement(cases: &[Case<'_>]) -> Option<Candidate> {
    let note = "answers 1 less the exact result: entropy for information, occupied for free".to_owned();
    followed(cases, "complement", note, |number| (number.value + number.error.exact - 1.0).abs() <= SAME)
}

/// Detects 1 less an entropy that is negative: 2 less the exact information.
fn missing_sign_of_entropy(cases: &[Case<'_>]) -> Option<Candidate> {
    let note = "answers 2 less the exact result: 1 - H where the minus sign before the sum of H is missing"
        .to_owned();
    followed(cases, "missing-sign", note, |number| (number.value + number.error.exact - 2.0).abs() <= SAME)
}

/// Detects answers that miss by rounding.
fn few_ulp(cases: &[Case<'_>]) -> Option<Candidate> {
    let wrong = wrong_numbers(cases);
    let all = wrong.len() as f64;
    let near: Vec<_> = wrong.into_iter().filter(|number| number.error.ulp <= FEW_ULP).collect();
    let worst = near.iter().map(|number| number.error.ulp).fold(0.0, f64::max);
    let unless = if near.len() as f64 == all { "" } else { ", where not by more," };
    let note = format!(
        "is off by up to {} ulp{unless}: rounding errors add up; claim what the port promises, or round once at the end",
        short(worst)
    );
    let explained: Vec<_> = near.into_iter().map(|number| number.case).collect();
    // Where many errors are larger, these are the small ones of something else.
    (!explained.is_empty() && explained.len() as f64 >= MOST * all)
        .then(|| fact("rounding", note, PATTERN, explained))
}

/// Detects answers with some digits right, by format, if most wrong answers are so.
fn bits(cases: &[Case<'_>]) -> Vec<Candidate> {
    let mut by_format: BTreeMap<FloatFormat, Vec<Number>> = BTreeMap::new();
    let mut wrong: BTreeMap<FloatFormat, usize> = BTreeMap::new();
    for number in wrong_numbers(cases) {
        *wrong.entry(cases[number.case].test.format).or_default() += 1;
        let Deviation { ulp, relative, .. } = number.error;
        if ulp > FEW_ULP && relative < NEAR && relative > 0.0 {
            by_format.entry(cases[number.case].test.format).or_default().push(number);
        }
    }
    let candidate = |(format, mut numbers): (FloatFormat, Vec<Number>)| {
        numbers.sort_by(|a, b| a.error.relative.total_cmp(&b.error.relative));
        // The exponent: relative = 2^-bits, about.
        let (m, e) = numbers[numbers.len() / 2].error.relative.parts();
        let bits = -(e + m.ilog2() as i32);
        let is_single = |number: &Number| f32::nearest(number.value).widen() == number.value;
        let single =
            format == FloatFormat::F64 && (SINGLE_BITS.contains(&bits) || numbers.iter().all(is_single));
        let what = if single { ": something is computed in single precision" } else { "" };
        let note = format!("answers in {format} are right to about {bits} bits{what}");
        let explained: Vec<_> = numbers.into_iter().map(|number| number.case).collect();
        fact(if single { "single-precision" } else { "bits" }, note, PATTERN, explained)
    };
    let most = by_format.into_iter().filter(|(format, numbers)| 2 * numbers.len() >= wrong[format]);
    most.map(candidate).collect()
}

/// Detects answers that half precision has: most of them near the exact results, and many different ones.
fn half_precision(cases: &[Case<'_>]) -> Option<Candidate> {
    let wrong = wrong_numbers(cases);
    let half: Vec<_> = wrong.iter().filter(|number| is_half(number.value)).collect();
    let near = half.iter().filter(|number| number.error.relative < NEAR_HALF).count();
    let values: BTreeSet<_> = half.iter().map(|number| number.value.to_bits()).collect();
    let note = "answers numbers of half precision, with 11 bits: something is computed in float16".to_owned();
    let explained: Vec<_> = half.iter().map(|number| number.case).collect();
    let telling = 2 * near >= half.len()
        && values.len() >= HALF_VALUES
        && half.len() as f64 >= MOST * wrong.len() as f64;
    telling.then(|| Candidate { tests: wrong.len(), ..fact("half-precision", note, PLAIN, explained) })
}

/// Returns whether half precision has a number.
fn is_half(x: f64) -> bool {
    let (m, e) = x.parts();
    let zeros = m.trailing_zeros() as i32;
    m == 0 || m >> zeros < 1 << 11 && e + zeros >= -24 && x.abs() <= 65504.0
}

/// The relative error of half precision, and some more.
const NEAR_HALF: f64 = 0.004;
/// The least number of different answers, which certain and unknown cells alone do not give.
const HALF_VALUES: usize = 12;

/// The number of right bits, about, of numbers in single precision.
const SINGLE_BITS: std::ops::RangeInclusive<i32> = 22..=27;
