//! Links, paths in code spans and cited sections lead somewhere, on every page.

use crate::markdown::{anchors, links, plain, spans};
use crate::{ROOT, read, versioned};
use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

/// Paths that a reader makes, or that stand for many.
const MADE: [&str; 7] = [
    "report/index.html",
    "index.html",
    "vectors/v2",
    "target/mutants",
    "target/web",
    "v1/OPERATION.json",
    "../shared/data",
];

/// Every page that is meant to be read.
fn pages() -> Vec<PathBuf> {
    let is_page = |path: &PathBuf| {
        path.extension().is_some_and(|extension| extension == "md") && !path.ends_with("src/book/links.md")
    };
    let mut pages: Vec<_> = files().into_iter().filter(is_page).collect();
    pages.sort();
    pages
}

/// The versioned files that are there; without git, all but what is built and what is hidden.
fn files() -> Vec<PathBuf> {
    let root = Path::new(ROOT);
    match versioned() {
        Some(files) => files.iter().map(|file| root.join(file)).filter(|file| file.exists()).collect(),
        None => files_within(root),
    }
}

fn files_within(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let shown = entries.filter(|path| {
        let name = path.file_name().unwrap().to_str().unwrap();
        !name.starts_with('.') && name != "target"
    });
    shown.flat_map(|path| if path.is_dir() { files_within(&path) } else { vec![path] }).collect()
}

#[test]
fn links_lead_somewhere() {
    let mut wrong = Vec::new();
    let mut count = 0;
    for path in pages() {
        let page = read(&path);
        let (targets, labels, definitions) = links(&page);
        let shown = path.strip_prefix(ROOT).unwrap().display().to_string();
        for label in &labels {
            if !definitions.contains_key(label) {
                wrong.push(format!("{shown}: [{label}] is defined nowhere"));
            }
        }
        for label in definitions.keys().filter(|&label| !labels.contains(label)) {
            wrong.push(format!("{shown}: [{label}] is not used"));
        }
        for target in targets.iter().chain(definitions.values()) {
            count += 1;
            if target.starts_with("https://") || target.starts_with("http://") {
                continue;
            }
            let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
            let file = if file.is_empty() { path.clone() } else { path.parent().unwrap().join(file) };
            if !file.exists() {
                wrong.push(format!("{shown}: there is no {target}"));
            } else if !anchor.is_empty() && !anchors(&read(&file)).contains(anchor) {
                wrong.push(format!("{shown}: {target} is no heading"));
            }
        }
    }
    println!("{count} links");
    assert!(count > 50 && wrong.is_empty(), "{count} links\n{}", wrong.join("\n"));
}

/// A path in a code span is there, from the root or from the page's folder; a file without a folder is somewhere.
#[test]
fn paths_in_code_spans_are_there() {
    let files = files();
    let names: BTreeSet<_> = files.iter().filter_map(|file| file.file_name()).collect();
    let extensions: BTreeSet<_> = files.iter().filter_map(|file| file.extension()).collect();
    let (mut count, mut wrong) = (0, Vec::new());
    for page in pages() {
        let text = plain(&read(&page));
        let from = [Path::new(ROOT), page.parent().unwrap()];
        let is_there = |path: &str| from.iter().any(|folder| folder.join(path).exists());
        let is_path = |span: &&str| {
            span.chars().all(|c| c.is_ascii_alphanumeric() || "/._-".contains(c)) && !MADE.contains(span)
        };
        for path in spans(&text).filter(is_path) {
            let is_file = Path::new(path).extension().is_some_and(|ends| extensions.contains(ends));
            let found = match path.split_once('/') {
                Some((folder, _)) if is_file || is_there(folder) => is_there(path),
                None if is_file => names.contains(OsStr::new(path)),
                // A fraction or a name.
                _ => continue,
            };
            count += 1;
            if !found {
                wrong.push(format!("{}: there is no {path}", page.display()));
            }
        }
    }
    println!("{count} paths");
    assert!(count > 100 && wrong.is_empty(), "{count} paths\n{}", wrong.join("\n"));
}

/// "`docs/NAME.md`, "Title"" names a heading of that page.
#[test]
fn cited_sections_are_there() {
    let mut count = 0;
    for page in pages() {
        let text = plain(&read(&page));
        for citation in text.split("`docs/").skip(1) {
            let Some((name, title)) = citation.split_once("`, \"") else { continue };
            if name.contains('`') {
                continue;
            }
            let title = title.split('"').next().unwrap().split_whitespace().collect::<Vec<_>>().join("-");
            let anchor = title.to_lowercase();
            assert!(
                anchors(&read(format!("docs/{name}"))).contains(&anchor),
                "{}: docs/{name} has no section {anchor}",
                page.display()
            );
            count += 1;
        }
    }
    assert!(count > 15, "{count}");
}
