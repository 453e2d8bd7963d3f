//! The table of files in the book: each row names a test, and there is one of that name.

use std::fs;
use std::path::{Path, PathBuf};

/// The files with tests in a folder and those within it.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries
        .flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] })
        .filter(|path| path.extension().is_some_and(|extension| extension == "rs"))
        .collect()
}

#[test]
fn each_row_of_the_table_has_a_test() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let page = fs::read_to_string(crates.join("../docs/files.md")).unwrap();
    let (_, table) = page.split_once("| file | who writes it").expect("a table");
    let folders = [crates.join("files/tests"), crates.join("cli/tests")];
    let tests: String = folders
        .iter()
        .flat_map(|folder| sources(folder))
        .map(|file| fs::read_to_string(file).unwrap())
        .collect();
    let rows: Vec<&str> = table.lines().skip(2).take_while(|line| line.starts_with('|')).collect();
    assert!(rows.len() > 20);
    for row in rows {
        let name = row.trim_end_matches([' ', '|', '`']).rsplit('`').next().unwrap();
        let (_, body) =
            tests.split_once(&format!("#[test]\nfn {name}()")).unwrap_or_else(|| panic!("no test: {row}"));
        // One that runs wherever the project is: without data that may be absent.
        let body = body.split("\n}\n").next().unwrap();
        assert!(
            !["skipped", "data()", "shared("].iter().any(|word| body.contains(word)),
            "may be skipped: {row}"
        );
    }
}
