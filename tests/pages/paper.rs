//! `docs/paper.md`, the map from the report to the code: each row resolves, and none is missing.

use crate::markdown::{rows, spans};
use crate::{read, sources};
use mean_information::operations::OPERATIONS;
use std::collections::BTreeSet;

const PAGE: &str = "docs/paper.md";

#[test]
fn every_row_resolves() {
    let page = read(PAGE);
    let code: String = sources("src").iter().map(read).collect();
    let rows = rows(&page);
    assert!(rows.len() >= 33, "{}", rows.len());
    for row in &rows {
        let [place, what, chapter, function, vectors, test, ..] = row[..] else { panic!("{row:?}") };
        assert!(!place.is_empty() && !what.is_empty());
        let derivation = read(format!("docs/{}.md", chapter.trim_matches(['[', ']'])));
        if let Some(number) = place.strip_prefix("Eq. ") {
            let tag = format!("\\tag{{{}}}", number.split(',').next().unwrap());
            assert!(derivation.contains(&tag), "{place}: {chapter} has no {tag}");
        }
        // That the link leads to it is checked by `cargo doc`; here, that there is an item of the name shown.
        let item = spans(function).next().unwrap_or_else(|| panic!("{place}: {function}"));
        let name = item.rsplit("::").next().unwrap();
        let declared = ["fn", "struct", "enum", "mod", "trait"].map(|kind| format!("pub {kind} {name}"));
        assert!(declared.iter().any(|item| code.contains(item)), "{place}: {item}");
        for operation in spans(vectors) {
            assert!(OPERATIONS.iter().any(|known| known.name == operation), "{place}: {operation}");
            read(format!("vectors/v1/{operation}.json"));
        }
        let name = spans(test).next().unwrap_or_else(|| panic!("{place}: {test}"));
        let (file, test) = match name.split_once("::") {
            Some((module, test)) => (format!("tests/library/{module}.rs"), test),
            None => ("crates/cli/tests/paper.rs".to_owned(), name),
        };
        assert!(read(&file).contains(&format!("fn {test}(")), "{place}: {file} {test}");
    }
}

/// The README's line to cite is that of `CITATION.cff`, with the version of the package.
#[test]
fn the_line_to_cite_is_that_of_the_citation_file() {
    let (readme, citation) = (read("README.md"), read("CITATION.cff"));
    for (key, field) in [("title: ", "title"), ("version: ", "version"), ("  - name: ", "author")] {
        let line = citation.lines().find_map(|line| line.strip_prefix(key)).unwrap().trim_matches('"');
        let entry = readme.lines().find(|line| line.trim_start().starts_with(&format!("{field} "))).unwrap();
        assert!(entry.contains(&format!("{{{line}}}")), "{entry}: {line}");
        assert!(field != "version" || line == env!("CARGO_PKG_VERSION"), "{line}");
    }
}

#[test]
fn no_equation_figure_or_operation_is_missing() {
    let page = read(PAGE);
    let rows = rows(&page);
    let places: BTreeSet<_> = rows.iter().map(|row| row[0]).collect();
    for equation in 1..=7 {
        assert!(places.contains(&*format!("Eq. {equation}")), "Eq. {equation}");
    }
    for figure in 1..=5 {
        assert!(places.contains(&*format!("Fig. {figure}")), "Fig. {figure}");
    }
    let served: BTreeSet<_> = rows.iter().flat_map(|row| spans(row[4])).collect();
    // Log-odds are a way to store a cell, of which the report does not speak.
    let rest = OPERATIONS.iter().filter(|operation| !served.contains(operation.name));
    let rest: Vec<_> = rest.map(|operation| operation.name).collect();
    let log_odds =
        ["cell.entropy_from_log_odds", "cell.information_from_log_odds", "cell.occupancy_from_log_odds"];
    assert_eq!(rest, log_odds);
}
