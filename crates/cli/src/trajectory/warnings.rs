//! The signs that a comparison means little.

use super::measure::{BLOCKS, Measured};
use super::row::{Row, Used};

/// Half of the blocks, of ten scans each: below this a standard error says too little (`docs/evidence.md`, "Coverage").
const FEW_SCANS: usize = 100;
/// The part of the observed cells that must have been seen in more than one block of scans.
const REVISITED: f64 = 0.25;
/// The difference of two such parts from which on the mean tells of how often cells were seen, too.
const REVISITED_APART: f64 = 0.2;
/// The part of the cells of the first row that another must observe.
const GROUND: f64 = 0.8;

/// Warns of the scans that all rows share.
pub(super) fn of_scans(used: &Used, silent: usize) -> Vec<String> {
    let (all, kept) = (used.scans, used.scans_used);
    let silent = (silent > 0).then(|| {
        format!(
            "{silent} scans have no beam that returned from within the greatest range, and are passed over"
        )
    });
    let few = (kept < FEW_SCANS).then(|| {
        format!("{kept} scans are few: with fewer than {FEW_SCANS} the standard error says less than is so")
    });
    let lost = (kept * 2 < all).then(|| {
        "fewer than half of the scans have a pose of every trajectory; a larger --max-gap interpolates more".to_owned()
    });
    [silent, few, lost].into_iter().flatten().collect()
}

/// Warns of a row; `first` has the measures of the first.
pub(super) fn of_row(row: &Row, first: &Measured) -> Vec<String> {
    let (observed, first_revisited, first) =
        (row.measures.observed(), first.revisited(), first.tally.observed());
    let part = |count: u64, of: u64| count as f64 / of as f64;
    let unseen = row.measures.not_meaningful.map(|why| why.warning().to_owned());
    let once = (observed > 0 && part(row.revisited, observed) < REVISITED).then(|| {
        format!(
            "{:.0} % of the observed cells were seen in more than one of {BLOCKS} parts of the log: where nothing is seen \
             again, nothing can contradict",
            100.0 * part(row.revisited, observed)
        )
    });
    let shares = [(row.revisited, observed), (first_revisited, first)].map(|(count, of)| part(count, of));
    let apart = (shares[0] - shares[1]).abs() > REVISITED_APART;
    let apart = apart.then(|| {
        let [own, first] = shares.map(|share| 100.0 * share);
        format!(
            "{own:.0} % of its observed cells were seen again in another part of the log, of those of the first {first:.0} %: the \
             difference tells of that, too"
        )
    });
    let less = (first > 0 && part(observed, first) < GROUND).then(|| {
        format!(
            "observes {:.0} % of the cells of the first: fewer cells make the mean greater",
            100.0 * part(observed, first)
        )
    });
    let unclear = row.difference.filter(|difference| difference.value().abs() <= difference.standard_error());
    let unclear = unclear.map(|_| {
        "the difference from the first is within its standard error: these scans do not tell them apart"
            .to_owned()
    });
    [unseen, once, apart, less, unclear].into_iter().flatten().collect()
}

/// Warns of a trajectory that is another.
pub(super) fn identical(name: &str) -> String {
    format!("has the very poses of {name} at these scans")
}
