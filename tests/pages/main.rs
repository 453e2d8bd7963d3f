//! The pages beside the code say what the code says: the book, the map of the report, the architecture, the
//! docstrings.

mod architecture;
mod book;
mod docstrings;
mod paper;

use std::fs;
use std::path::{Path, PathBuf};

/// The folder of the library's package.
const ROOT: &str = env!("CARGO_MANIFEST_DIR");

fn read(path: impl AsRef<Path>) -> String {
    let path = Path::new(ROOT).join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The files with Rust in a folder and those within it, from the root, in order.
fn sources(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(Path::new(ROOT).join(folder)).unwrap();
    let mut paths: Vec<_> = entries.map(|entry| Path::new(folder).join(entry.unwrap().file_name())).collect();
    paths.sort();
    let within = |path: PathBuf| match path.extension() {
        None => sources(path.to_str().unwrap()),
        Some(extension) => {
            if extension == "rs" {
                vec![path]
            } else {
                vec![]
            }
        }
    };
    paths.into_iter().flat_map(within).collect()
}

/// The rows of the tables of a page, each with its cells; without heads and rules.
fn rows(page: &str) -> Vec<Vec<&str>> {
    let lines: Vec<_> = page.lines().collect();
    let is_row = |line: &str| line.starts_with('|');
    let is_rule = |line: &str| line.starts_with("|---");
    let body = lines.iter().enumerate().filter(|(k, line)| {
        is_row(line) && !is_rule(line) && !lines.get(k + 1).is_some_and(|next| is_rule(next))
    });
    body.map(|(_, line)| line.trim_matches('|').split('|').map(str::trim).collect()).collect()
}

/// What stands in code spans.
fn spans(text: &str) -> impl Iterator<Item = &str> {
    text.split('`').skip(1).step_by(2)
}
