//! The signs that a comparison means little.

use super::alike::Frame;
use super::common::Common;
use super::measure::Measured;
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
pub(super) fn of_scans(used: &Used, common: &Common<'_>, labels: &[String]) -> Vec<String> {
    let (all, kept, silent) = (used.scans, used.scans_used, common.silent);
    let silent = (silent > 0).then(|| {
        format!(
            "{silent} scans have no beam that returned from within the greatest range, and are passed over"
        )
    });
    let few = (kept < FEW_SCANS).then(|| {
        format!("{kept} scans are few: with fewer than {FEW_SCANS} the standard error says less than is so")
    });
    // Those that lack more than half themselves; if there are none, those that lack the most.
    let most = common.without_pose.iter().copied().max().unwrap_or(0);
    let lack = common.without_pose.iter().zip(labels).filter(|&(&lacks, _)| lacks >= most.min(all / 2 + 1));
    let lost = (kept * 2 < all && most > 0).then(|| {
        let lack: Vec<_> = lack.map(|(lacks, label)| format!("{label} lacks {lacks} of {all}")).collect();
        format!(
            "fewer than half of the scans have a pose of every trajectory, {}; a larger --max-gap interpolates more, and \
             interpolated poses are worse poses",
            lack.join(", ")
        )
    });
    [silent, few, lost].into_iter().flatten().collect()
}

/// Warns of a row; `first` has the measures of the first.
pub(super) fn of_row(row: &Row, first: &Measured) -> Vec<String> {
    let parts = first.without.len();
    let (observed, first_revisited, first) =
        (row.measures.observed(), first.revisited(), first.tally.observed());
    let part = |count: u64, of: u64| count as f64 / of as f64;
    let unseen = row.measures.warning();
    let once = (observed > 0 && part(row.revisited, observed) < REVISITED).then(|| {
        let seen = match parts {
            0 | 1 => "the cells were seen by one scan alone".to_owned(),
            _ => {
                let percent = 100.0 * part(row.revisited, observed);
                format!("{percent:.0} % of the observed cells were seen in more than one of {parts} parts of the log")
            }
        };
        format!("{seen}: where nothing is seen again, nothing can contradict")
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

/// Warns of a trajectory that moves as another one does.
pub(super) fn alike(name: &str, frame: &Frame) -> String {
    let why = if frame.is_same() {
        "no beam ends a tenth of a cell elsewhere"
    } else {
        "the difference is that of where the cells lie, not of the trajectory"
    };
    format!("{}: {why}", frame.in_words(name))
}

/// Warns of a trajectory whose poses at many of the scans lie far from its own ones in time.
pub(super) fn stretched(common: &Common<'_>, index: usize) -> Option<String> {
    let (stretched, all, gap) = (common.stretched[index], common.scans.len(), Common::GAP);
    (stretched > 0).then(|| {
        format!(
            "{stretched} of its {all} poses are interpolated between two more than {gap} s apart: they are worse poses than its \
             own, and its map is the worse for them"
        )
    })
}
