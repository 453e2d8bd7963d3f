//! The book: its chapters, their order, what rustdoc makes of them, and the names in the notation.

use crate::markdown::{links, rows, spans};
use crate::{ROOT, read, sources};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// The chapters that rustdoc shows, in their order, and the pictures of each.
pub(crate) fn chapters() -> Vec<(String, Vec<String>)> {
    let source = read("src/book/mod.rs");
    let list = source
        .rsplit("chapters! {")
        .next()
        .and_then(|rest| rest.split('}').next())
        .expect("the list of chapters");
    let entries = list.split(';').map(str::trim).filter(|entry| !entry.is_empty());
    let chapter = |entry: &str| {
        let pictures = entry.split('"').skip(1).step_by(2).map(str::to_owned).collect();
        (entry.split_whitespace().next().expect("a name").to_owned(), pictures)
    };
    entries.map(chapter).collect()
}

pub(crate) fn chapter(name: &str) -> String {
    read(format!("docs/{name}.md"))
}

#[test]
fn the_chapters_are_the_files_in_the_order_of_the_contents() {
    let chapters: Vec<_> = chapters().into_iter().map(|(name, _)| name).collect();
    let files = fs::read_dir(Path::new(ROOT).join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let pages = files.filter(|path| path.extension().is_some_and(|extension| extension == "md"));
    let names: BTreeSet<_> =
        pages.map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned()).collect();
    // The front page, and the pages for those who read the code or the report beside the book.
    let others = ["README", "architecture", "paper"].map(str::to_owned);
    let expected: BTreeSet<_> = chapters.iter().chain(&others).cloned().collect();
    assert_eq!(names.difference(&expected).collect::<Vec<_>>(), Vec::<&String>::new());
    assert!(chapters.iter().all(|name| names.contains(name)));

    let contents = chapter("README");
    let rows = contents.lines().filter(|line| line.starts_with("| ") && line.contains(']'));
    let label = |row: &str| {
        let cell = row.split('|').nth(2).expect("a cell").trim();
        let label = cell.rsplit_once('[').expect("a link").1.trim_end_matches(']');
        label.to_lowercase()
    };
    assert_eq!(rows.map(label).collect::<Vec<_>>(), chapters);
    // Each ends with the way to the next.
    for pair in chapters.windows(2) {
        let text = chapter(&pair[0]);
        let next = text.split("\n\n").find(|paragraph| paragraph.starts_with("Next: "));
        let next = next.unwrap_or_else(|| panic!("docs/{}.md does not lead to the next chapter", pair[0]));
        let leads = [format!("][{}]", pair[1]), format!("[{}]", pair[1])];
        assert!(leads.iter().any(|link| next.contains(link)), "docs/{}.md: {next}", pair[0]);
    }
}

/// What rustdoc is told of a label is what the chapters say of it: the same chapter, or an item in that file.
#[test]
fn labels_mean_the_same_to_rustdoc() {
    let items = read("src/book/links.md");
    let (_, _, items) = links(&items);
    let mut used = BTreeSet::new();
    for name in chapters().into_iter().map(|(name, _)| name).chain(["README".to_owned()]) {
        let (_, _, definitions) = links(&chapter(&name));
        for (label, target) in definitions {
            let item = items
                .get(&label)
                .unwrap_or_else(|| panic!("docs/{name}.md: [{label}]: not in src/book/links.md"));
            if let Some(chapter) = item.strip_prefix("crate::book::") {
                let (chapter, anchor) = chapter.split_once('#').unwrap_or((chapter, ""));
                let anchor = if anchor.is_empty() { String::new() } else { format!("#{anchor}") };
                assert_eq!(target, format!("{chapter}.md{anchor}"), "docs/{name}.md: [{label}]");
            } else if item == "crate::book" {
                assert_eq!(target, "README.md", "docs/{name}.md: [{label}]");
            } else {
                let source = read(Path::new("docs").join(&target));
                let defined = item.rsplit("::").next().expect("a name");
                let file = [format!("/{defined}.rs"), format!("/{defined}/mod.rs")];
                let kinds = ["struct", "enum", "trait", "fn", "const", "type"];
                // A variant of an enumeration stands alone on its line.
                let lines =
                    [format!("    {defined},"), format!("    {defined}("), format!("    {defined} {{")];
                let found = file.iter().any(|end| target.ends_with(end))
                    || kinds.iter().any(|kind| source.contains(&format!("{kind} {defined}")))
                    || lines.iter().any(|line| source.contains(line));
                assert!(found, "docs/{name}.md: {target} has no {defined}");
            }
            used.insert(label);
        }
    }
    let unused: Vec<_> = items.keys().filter(|&label| !used.contains(label)).collect();
    assert_eq!(unused, Vec::<&String>::new(), "labels in src/book/links.md that no chapter uses");
}

#[test]
fn pictures_travel_with_their_pages() {
    for (name, pictures) in chapters() {
        let (targets, _, _) = links(&chapter(&name));
        let shown: Vec<_> = targets
            .into_iter()
            .filter(|target| Path::new(target).extension() == Some("svg".as_ref()))
            .collect();
        assert_eq!(shown, pictures, "docs/{name}.md and src/book/mod.rs");
    }
}

/// What the page on notation calls an identifier is one.
#[test]
fn identifiers_of_the_notation_are_in_the_source() {
    let code: String = sources("src").iter().map(read).collect();
    let words: BTreeSet<_> = code.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
    let page = chapter("notation");
    let rows = rows(&page).into_iter().filter(|row| row.len() == 4);
    let identifiers: Vec<_> = rows.flat_map(|row| spans(row[3])).collect();
    let identifiers = identifiers.into_iter();
    let identifiers: Vec<_> = identifiers.flat_map(|identifier| identifier.split("::")).collect();
    assert!(identifiers.len() > 30, "{identifiers:?}");
    let unknown: Vec<_> = identifiers.iter().filter(|&identifier| !words.contains(identifier)).collect();
    assert!(unknown.is_empty(), "{unknown:?}");
}

/// Each page of the book has what typesets it within: a browser asks no network for it.
#[test]
fn pages_are_typeset_without_a_network() {
    let parts = [
        "include_str!(\"style.html\")",
        "\"<script type=\\\"module\\\">\"",
        "include_str!(\"mathml.mjs\")",
        "include_str!(\"page.mjs\")",
        "\"</script>\"",
    ];
    let book = read("src/book/mod.rs");
    let lines = |start: &str| parts.map(|part| format!("{start}[doc = {part}]\n")).concat();
    assert!(book.contains(&lines("#!")));
    assert!(book.contains(&format!("{}        pub mod $name {{}}", lines("        #"))));

    for file in ["style.html", "mathml.mjs", "page.mjs"] {
        let text = read(Path::new("src/book").join(file));
        for asked in ["://", "import ", "fetch", "url(", "</script"] {
            assert!(!text.contains(asked), "src/book/{file}: {asked}");
        }
    }
}
