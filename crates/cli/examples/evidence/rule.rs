//! What differences count: pairs of trajectories whose order is known or measured, and moves of a whole that change nothing.

use crate::perturbed::Kind;
use crate::row::Row;
use mean_information::Error;
use mean_information::scan::Difference;
use mean_information_cli::Failure;

/// Upper ends of the ranges of a difference of mean information, in bits.
const BITS: [f64; 6] = [0.002, 0.005, 0.01, 0.02, 0.05, f64::INFINITY];
/// Upper ends of the ranges of a difference over its standard error.
const STANDARD_ERRORS: [f64; 4] = [1.0, 2.0, 3.0, f64::INFINITY];

/// Pairs of trajectories whose difference lies in a range.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Pairs {
    /// The upper end of the range.
    pub(crate) below: f64,
    /// The number of pairs.
    pub(crate) count: usize,
    /// Those that have the order of the errors of translation.
    pub(crate) as_translation: usize,
    /// Those that have the order of the errors of rotation.
    pub(crate) as_rotation: usize,
}

/// The order of all pairs, by ranges of their difference in bits, and by ranges of it over its jackknife standard error.
pub(crate) fn pairs(rows: &[&Row]) -> Result<[Vec<Pairs>; 2], Error> {
    let ranges =
        |ends: &[f64]| ends.iter().map(|&below| Pairs { below, ..Pairs::default() }).collect::<Vec<_>>();
    let mut by = [ranges(&BITS), ranges(&STANDARD_ERRORS)];
    for (k, one) in rows.iter().enumerate() {
        for other in &rows[..k] {
            let difference = between(one, other)?;
            let size = difference.value().abs();
            let [one, other] = [one, other].map(|row| row.errors.yardsticks());
            let is_alike = |part: usize| (difference.value() > 0.0) == (other[part] < one[part]);
            for (ranges, size) in by.iter_mut().zip([size, size / difference.standard_error()]) {
                if let Some(range) = ranges.iter_mut().find(|range| size < range.below) {
                    range.count += 1;
                    range.as_translation += usize::from(is_alike(0));
                    range.as_rotation += usize::from(is_alike(1));
                }
            }
        }
    }
    Ok(by)
}

/// The mean information of the second trajectory less that of the first, by the default model at the middle resolution.
fn between(first: &Row, second: &Row) -> Result<Difference, Error> {
    let [first, second] = [&first.measured, &second.measured];
    let without = first.without.iter().cloned().zip(second.without.iter().cloned());
    let without: Vec<_> = without.map(|(first, second)| [first, second]).collect();
    Difference::by_jackknife([&first.tally, &second.tally], &without)
}

/// The part of the pairs of one kind and one seed, of which the one with the greater error is known, that a loss orders so. The
/// corrected trajectory is the one of size 0 of each.
pub(crate) fn ordered(rows: &[Row], kinds: &[Kind], loss: impl Fn(&Row) -> f64) -> f64 {
    let (mut right, mut count) = (0, 0);
    for &kind in kinds {
        for seed in 0..kind.seeds() {
            let is_own = |row: &&Row| {
                row.made.kind == Kind::Corrected || row.made.kind == kind && row.made.seed == seed
            };
            let own: Vec<_> = rows.iter().filter(is_own).collect();
            for (k, worse) in own.iter().enumerate() {
                for better in &own[..k] {
                    right += u32::from(loss(better) < loss(worse));
                    count += 1;
                }
            }
        }
    }
    f64::from(right) / f64::from(count)
}

/// From which size on each kind of error is seen, by all of its trajectories.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    /// By mean information: the difference to the corrected trajectory is below `-2` standard errors.
    pub(crate) standard_error: Option<f64>,
    /// By mean information: it is beyond what moves of the whole make.
    pub(crate) moves: Option<f64>,
    /// By the relations: the mean error of translation is above that of the corrected one by more than 2 standard errors of the
    /// mean of the differences.
    pub(crate) relations: Option<f64>,
}

/// Finds from which sizes on errors are seen. `reach` is what moves of the whole make of a mean information.
pub(crate) fn seen(rows: &[Row], reach: f64) -> Result<Vec<Seen>, Failure> {
    let corrected = &rows[0];
    let mut found = Vec::new();
    for kind in Kind::ERRORS {
        let from = |is_seen: &dyn Fn(&Row) -> Result<bool, Error>| {
            let mut from = None;
            for &size in kind.sizes().iter().rev() {
                let own = rows.iter().filter(|row| row.made.kind == kind && row.made.size == size);
                let all = own.map(is_seen).collect::<Result<Vec<_>, Error>>()?;
                if !all.iter().all(|&is| is) {
                    break;
                }
                from = Some(size);
            }
            Ok::<_, Error>(from)
        };
        let difference = |row: &Row| between(corrected, row);
        found.push(Seen {
            standard_error: from(&|row| {
                let difference = difference(row)?;
                Ok(difference.value() < -2.0 * difference.standard_error())
            })?,
            moves: from(&|row| Ok(difference(row)?.value() < -reach))?,
            relations: from(&|row| Ok(is_worse(&corrected.errors.translations, &row.errors.translations)))?,
        });
    }
    Ok(found)
}

/// Whether errors are greater than others of the same relations by more than 2 standard errors of the mean difference.
fn is_worse(first: &[f64], second: &[f64]) -> bool {
    let n = first.len() as f64;
    let more: Vec<f64> = first.iter().zip(second).map(|(first, second)| second - first).collect();
    let mean = more.iter().sum::<f64>() / n;
    let squares = more.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>();
    mean > 2.0 * mean_information::elementary::sqrt(squares / (n * (n - 1.0)))
}

/// The difference of a trajectory's mean information to that of the corrected one, with its standard error.
pub(crate) fn to_corrected(rows: &[Row], row: &Row) -> Result<Difference, Error> {
    between(&rows[0], row)
}
