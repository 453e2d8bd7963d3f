//! The modules of the command line depend on each other in one direction: that of the table in `src/lib.rs`.

use std::fs;
use std::path::{Path, PathBuf};

const SOURCE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src");

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] }).collect()
}

/// The names that follow `crate::` in a text.
fn used(text: &str) -> impl Iterator<Item = &str> {
    text.split("crate::").skip(1).map(|rest| {
        let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        &rest[..end]
    })
}

#[test]
fn every_module_depends_only_on_those_above_it() {
    let lib = fs::read_to_string(format!("{SOURCE}/lib.rs")).unwrap();
    let order: Vec<String> = lib
        .lines()
        .filter_map(|line| {
            line.strip_prefix("//! | ")?.trim_start_matches('[').strip_prefix('`')?.split('`').next()
        })
        .map(str::to_lowercase)
        .collect();
    let modules = lib.lines().filter(|line| line.ends_with(';') && line.contains("mod ")).count();
    assert_eq!(order.len(), modules, "{order:?}");
    let rank = |name: &str| order.iter().position(|module| *module == name.to_lowercase());

    let mut checked = 0;
    for file in files(SOURCE.as_ref()) {
        let relative = file.strip_prefix(SOURCE).unwrap().with_extension("");
        let module = relative.iter().next().unwrap().to_str().unwrap();
        if ["lib", "main"].contains(&module) {
            continue;
        }
        let own = rank(module).unwrap_or_else(|| panic!("{module} is missing in the table of lib.rs"));
        for name in used(&fs::read_to_string(&file).unwrap()) {
            // A macro of the crate stands at its root.
            let other = rank(name).unwrap_or_else(|| panic!("{} uses crate::{name}", file.display()));
            assert!(other <= own, "{} uses {name}, which stands below it", file.display());
            checked += usize::from(other < own);
        }
    }
    assert!(checked > 20, "{checked}");
}
