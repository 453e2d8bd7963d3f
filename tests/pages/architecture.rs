//! `docs/architecture.md`: the tree is there, dependencies run one way, files are small.

use crate::{ROOT, read, rows, sources};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// Tables that a generator wrote.
const LONG: [&str; 2] = ["src/rounded/constants.rs", "src/limit/closed_form/tables.rs"];

#[test]
fn the_tree_is_the_tree() {
    let page = read("docs/architecture.md");
    let (_, tree) = page.split_once("```text\n").unwrap();
    let (tree, _) = tree.split_once("```").unwrap();
    let shown: BTreeSet<_> = tree.lines().map(|line| line.split_once('/').unwrap().0).collect();
    let is_folder = |name: &&str| Path::new(ROOT).join(name).is_dir();
    // The package of the library is a part of the tree.
    if is_folder(&"cli") {
        let made = ["target", ".git"];
        let there = fs::read_dir(ROOT).unwrap().map(|entry| entry.unwrap());
        let there = there.filter(|entry| entry.file_type().unwrap().is_dir());
        let there: Vec<_> = there.map(|entry| entry.file_name().into_string().unwrap()).collect();
        let there: BTreeSet<_> =
            there.iter().map(String::as_str).filter(|name| !made.contains(name)).collect();
        assert_eq!(shown, there);
    } else {
        assert!(shown.iter().filter(|name| is_folder(name)).count() > 6);
    }
}

#[test]
fn the_modules_of_the_library_depend_on_those_above_them() {
    let page = read("docs/architecture.md");
    let (_, library) = page.split_once("## The library").unwrap();
    let (library, _) = library.split_once("\n## ").unwrap();
    let modules: Vec<_> = rows(library).iter().map(|row| row[0].trim_matches('`').to_owned()).collect();
    one_way("src", &modules);
}

#[test]
fn the_modules_of_the_command_depend_on_those_above_them() {
    if !Path::new(ROOT).join("cli").exists() {
        return println!("skipped: the package of the library is without the command");
    }
    let head = read("cli/src/lib.rs");
    let table: Vec<_> = head.lines().filter_map(|line| line.strip_prefix("//! ")).collect();
    let table = table.join("\n");
    let name = |row: &Vec<&str>| row[0].trim_matches(['[', ']', '`']).to_lowercase();
    one_way("cli/src", &rows(&table).iter().map(name).collect::<Vec<_>>());
}

/// Every module of `folder` is in `order`, and uses none that stands after it.
fn one_way(folder: &str, order: &[String]) {
    let declared = read(format!("{folder}/lib.rs"));
    let declared = declared.lines().filter_map(|line| line.strip_suffix(';')?.split_once("mod "));
    let declared: BTreeSet<_> =
        declared.filter(|(before, _)| !before.starts_with(' ')).map(|(_, name)| name).collect();
    assert_eq!(declared, order.iter().map(String::as_str).collect());
    let rank = |name: &str| order.iter().position(|module| module == name);

    let mut checked = 0;
    for file in sources(folder) {
        let within = file.strip_prefix(folder).unwrap().with_extension("");
        let module = within.iter().next().unwrap().to_str().unwrap();
        let test = within.iter().any(|part| part == "tests");
        if ["lib", "main"].contains(&module) || test {
            continue;
        }
        let own = rank(module).unwrap();
        let text = read(&file);
        let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
        let code = code.collect::<Vec<_>>().join("\n");
        // Tests stand at the end of a file.
        let code = code.split("#[cfg(test)]\nmod tests {").next().unwrap();
        for name in used(code) {
            let other = rank(name).unwrap_or_else(|| panic!("{}: crate::{name}", file.display()));
            assert!(other <= own, "{} uses {name}, which stands below it", file.display());
            checked += usize::from(other < own);
        }
    }
    assert!(checked > 20, "{checked}");
}

/// The modules that follow `crate::` in code; of a group, each.
fn used(code: &str) -> impl Iterator<Item = &str> {
    let names = code.split("crate::").skip(1).flat_map(|rest| match rest.strip_prefix('{') {
        Some(group) => group.split('}').next().unwrap().split(',').map(str::trim).collect(),
        None => vec![rest],
    });
    names.filter(|name| !name.is_empty()).map(|path| {
        let end = path.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(path.len());
        home(&path[..end])
    })
}

/// The module of what the root of a crate re-exports.
fn home(name: &str) -> &str {
    match name {
        "Error" => "error",
        "Real" => "real",
        "Tally" | "Information" | "ExactSum" => "tally",
        "Failure" => "failure",
        module => module,
    }
}

#[test]
fn a_file_holds_one_idea() {
    let folders =
        ["src", "tests", "benches", "examples", "cli/src", "cli/tests", "cli/benches", "proofs/mutants/src"];
    for folder in folders.into_iter().filter(|folder| Path::new(ROOT).join(folder).exists()) {
        for file in sources(folder) {
            let lines = read(&file).lines().count();
            let long = LONG.iter().any(|name| file == Path::new(name));
            assert!(lines <= 400 || long, "{}: {lines} lines", file.display());
        }
    }
}
