//! The pages beside the code say what the code says: the book, the map of the report, the architecture, the
//! docstrings.

mod architecture;
mod book;
mod decimals;
mod docstrings;
mod executed;
mod imports;
mod links;
mod markdown;
mod packages;
mod paper;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The folder of the library's package.
const ROOT: &str = env!("CARGO_MANIFEST_DIR");

fn read(path: impl AsRef<Path>) -> String {
    let path = Path::new(ROOT).join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The files that git knows, from the root, where there is a checkout and git to ask.
fn versioned() -> Option<Vec<String>> {
    if !Path::new(ROOT).join(".git").exists() {
        return None;
    }
    let output = Command::new("git").args(["-C", ROOT, "ls-files"]).output().ok()?;
    let files = String::from_utf8(output.stdout).ok().filter(|_| output.status.success())?;
    Some(files.lines().map(str::to_owned).collect())
}

/// The files with Rust in a folder and those within it, from the root, in order.
fn sources(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(Path::new(ROOT).join(folder)).unwrap();
    let mut paths: Vec<_> = entries.map(|entry| Path::new(folder).join(entry.unwrap().file_name())).collect();
    paths.sort();
    let within = |path: PathBuf| match path.extension() {
        // What was built in a workspace of its own.
        None if path.ends_with("target") => vec![],
        None if Path::new(ROOT).join(&path).is_dir() => sources(path.to_str().unwrap()),
        Some(extension) if extension == "rs" => vec![path],
        _ => vec![],
    };
    paths.into_iter().flat_map(within).collect()
}
