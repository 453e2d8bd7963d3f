//! Every inequality of the book, and a search for points at which it does not hold: at random, then by small steps from
//! the worst. A test for each, named after its statement, searches for a moment; longer, with the ratios printed:
//!
//! ```text
//! cargo test --release -p mean-information --test library inequalities -- --ignored --nocapture
//! ```

mod cells;
mod circles;
mod evidence;
mod integrals;
mod kernels;
mod rooms;
mod search;
mod withdrawn;

use search::Inequality;
use std::collections::BTreeSet;
use std::fs;

/// How many random points a short search tries, and how many steps it takes from each of the best.
const POINTS: usize = 200;
const STEPS: usize = 100;

/// The same of a long one.
const LONG: [usize; 2] = [4000, 1000];

fn all() -> impl Iterator<Item = &'static Inequality> {
    [cells::ALL, circles::ALL, evidence::ALL, integrals::ALL, kernels::ALL, rooms::ALL].into_iter().flatten()
}

/// The statements that no search at points can try, and why.
const ELSEWHERE: [(&str, &str, &str); 27] = [
    ("cell", "Theorem (no ties)", "no inequality"),
    ("evidence", "Theorem (removal)", "an equality, bit for bit: tests/library/scan/removal.rs"),
    (
        "evidence",
        "Proposition (rounding of the agreement)",
        "below what floats show; the correct rounding is asserted in the chapter",
    ),
    ("evidence", "Proposition (rounding of the jackknife)", "in integers: tests/library/scan/jackknife.rs"),
    ("limit", "Theorem (limits)", "a limit; how near, the theorem on grids says"),
    ("limit", "Proposition (many scans)", "an order of magnitude; the next term is asserted in the chapter"),
    (
        "octrees",
        "Theorem (pruned trees)",
        "an equality, bit for bit: crates/files/tests/files/octrees.rs, of random trees",
    ),
    (
        "octrees",
        "Corollary (pruned trees by depth)",
        "an equality, bit for bit: crates/cli/src/octree.rs, of random trees",
    ),
    (
        "scan",
        "Theorem (directions)",
        "of integers that are not public: src/rounded/angle.rs, against the series",
    ),
    (
        "scan",
        "Theorem (ends)",
        "of integers that are not public: src/scan/lattice.rs, against exact quotients",
    ),
    (
        "scan",
        "Theorem (ends in floats)",
        "of integers that are not public: src/scan/ends.rs, against exact quotients",
    ),
    ("scan", "Theorem (fans)", "an equality: src/scan/fans.rs, against the cells of each beam"),
    ("scan", "Theorem (sure cells)", "an equality, bit for bit: src/scan/reference.rs, cell by cell"),
    ("scan", "Theorem (columns)", "an equality: src/scan/columns.rs, against the traversal line by line"),
    ("scan", "Theorem (counts)", "an equality, bit for bit: src/scan/reference.rs"),
    (
        "scan",
        "Theorem (levels)",
        "of integers that are not public: src/scan/lattice.rs, against the distances",
    ),
    ("sums", "Theorem (exact sums)", "an equality, bit for bit: tests/library/tally.rs"),
    (
        "sums",
        "Theorem (blocks)",
        "an equality, bit for bit: tests/library/tally.rs, every f32 in proofs/RESULTS.md",
    ),
    (
        "sums",
        "Theorem (log-odds)",
        "an equality, bit for bit: tests/library/elementwise.rs, proofs/exhaust.sh",
    ),
    (
        "sums",
        "Theorem (far log-odds)",
        "an equality, bit for bit: tests/library/elementwise.rs, tests/library/tally.rs, proofs/exhaust.sh",
    ),
    ("rounding", "Lemma (ties)", "no inequality"),
    ("rounding", "Lemma (Horner)", "machine-checked: proofs/*.gappa"),
    ("rounding", "Lemma (series)", "below what floats show: proofs/constants.sollya"),
    ("rounding", "Lemma (middle)", "an equality"),
    ("rounding", "Lemma (eight ln 2)", "of one number, asserted in the chapter"),
    ("rounding", "Lemma (ranges)", "of monotone functions at the ends, asserted in the chapter"),
    ("integration", "Lemma (128 bits)", "of numbers that are not public: src/interval/wide.rs has the tests"),
];

/// The theorems, lemmas, propositions and corollaries of the chapters.
fn stated() -> BTreeSet<(String, String)> {
    let docs = concat!(env!("CARGO_MANIFEST_DIR"), "/docs");
    let mut stated = BTreeSet::new();
    for entry in fs::read_dir(docs).expect("the chapters") {
        let path = entry.expect("a file").path();
        if path.extension().is_none_or(|extension| extension != "md") {
            continue;
        }
        let chapter = path.file_stem().and_then(|stem| stem.to_str()).expect("a name").to_owned();
        for line in fs::read_to_string(&path).expect("text").lines() {
            let Some((name, _)) = line.strip_prefix("**").and_then(|bold| bold.split_once(".**")) else {
                continue;
            };
            if ["Theorem (", "Lemma (", "Proposition (", "Corollary ("]
                .iter()
                .any(|kind| name.starts_with(kind))
            {
                stated.insert((chapter.clone(), name.to_owned()));
            }
        }
    }
    stated
}

#[test]
fn every_statement_of_the_book_is_here() {
    let searched = all().map(|inequality| inequality.statement);
    let elsewhere = ELSEWHERE.iter().map(|&(chapter, name, _)| (chapter, name));
    let here: BTreeSet<_> =
        searched.chain(elsewhere).map(|(chapter, name)| (chapter.to_owned(), name.to_owned())).collect();
    let stated = stated();
    let missing: Vec<_> = stated.difference(&here).collect();
    let gone: Vec<_> = here.difference(&stated).collect();
    assert!(
        missing.is_empty() && gone.is_empty(),
        "stated, and not here: {missing:?}; here, and not stated: {gone:?}"
    );
    assert!(stated.len() > 40, "{}", stated.len());
    let both = ELSEWHERE.iter().find(|(chapter, name, _)| all().any(|of| of.statement == (*chapter, *name)));
    assert_eq!(both, None);
}

#[test]
#[ignore = "takes minutes, and prints how much of each bound is used"]
fn long_search() {
    println!("largest   tried  inequality");
    for inequality in all() {
        let found = inequality.assert_holds(LONG[0], LONG[1]);
        let (chapter, name) = inequality.statement;
        let test = inequality.test.rsplit("::").next().unwrap_or_default();
        println!("{:.5} {:>7}  {chapter}: {name}; {test}, at {:.4?}", found.largest, found.tried, found.at);
    }
}
