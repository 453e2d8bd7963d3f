//! `docs/architecture.md` and the crate page: the tree is there, dependencies run one way, files are small.

use crate::markdown::rows;
use crate::{ROOT, read, sources, versioned};
use std::collections::BTreeSet;
use std::path::Path;

/// Tables that a generator wrote.
const LONG: [&str; 2] = ["src/rounded/constants.rs", "src/limit/closed_form/tables.rs"];

#[test]
fn the_tree_is_the_tree() {
    let page = read("docs/architecture.md");
    let (_, tree) = page.split_once("```text\n").unwrap();
    let (tree, _) = tree.split_once("```").unwrap();
    let shown: BTreeSet<_> = tree.lines().map(|line| line.split_once('/').unwrap().0).collect();
    if let Some(files) = versioned() {
        let folders = files.iter().filter_map(|file| Some(file.split_once('/')?.0));
        assert_eq!(shown, folders.collect());
    } else {
        // The package of the library is a part of the tree.
        assert!(shown.iter().filter(|name| Path::new(ROOT).join(name).is_dir()).count() > 6);
    }
}

/// But for the module of a feature that is not a default one, to which a link may not resolve.
#[test]
fn the_crate_page_shows_the_public_modules() {
    let source = read("src/lib.rs");
    let page = head(&source);
    // The table of the modules; that of who begins where has readers.
    let modules = rows(&page).into_iter().filter(|row| row[0].starts_with('['));
    let shown = modules.map(|row| {
        assert!(!row[1].is_empty(), "{row:?}: holds what?");
        row[0].trim_matches(['[', ']', '`'])
    });
    let shown: BTreeSet<_> = shown.collect();
    let (source, _) = source.split_once("#[cfg(feature = \"vectors\")]").unwrap();
    let public = source.lines().filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';'));
    assert_eq!(shown, public.collect());
}

/// What a file says of itself.
fn head(source: &str) -> String {
    source.lines().filter_map(|line| line.strip_prefix("//! ")).collect::<Vec<_>>().join("\n")
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
fn the_modules_of_files_of_rows_and_of_the_command_depend_on_those_above_them() {
    for folder in ["crates/files/src", "crates/report/src", "crates/cli/src"] {
        let table = head(&read(format!("{folder}/lib.rs")));
        let name =
            |row: &Vec<&str>| row[0].trim_matches(['[', ']', '`']).trim_start_matches("mod@").to_lowercase();
        one_way(folder, &rows(&table).iter().map(name).collect::<Vec<_>>());
    }
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
        let own: Vec<_> =
            within.iter().map(|part| part.to_str().unwrap()).filter(|&part| part != "mod").collect();
        if ["lib", "main"].contains(&own[0]) || own.contains(&"tests") {
            continue;
        }
        let rank_of_own = rank(own[0]).unwrap();
        let text = read(&file);
        for name in used(&without_tests(&text), &own) {
            let other = rank(name).unwrap_or_else(|| panic!("{}: crate::{name}", file.display()));
            assert!(other <= rank_of_own, "{} uses {name}, which stands below it", file.display());
            checked += usize::from(other < rank_of_own);
        }
    }
    assert!(checked > 20, "{checked}");
}

/// Code without comments and without modules of tests.
pub(crate) fn without_tests(text: &str) -> String {
    let mut code = String::new();
    let mut lines = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    while let Some(line) = lines.next() {
        if line == "mod tests {" {
            lines.find(|line| *line == "}");
        } else {
            code.extend([line, "\n"]);
        }
    }
    code
}

/// The modules at the root of the crate that the code of a module uses, by `crate::` or by enough of `super::`.
fn used<'a>(code: &'a str, own: &[&str]) -> Vec<&'a str> {
    let begins = |&(at, _): &(usize, &str)| {
        !code[..at].ends_with(|c: char| c.is_alphanumeric() || "_$".contains(c))
            && !code[..at].ends_with("super::")
    };
    let starts = code.match_indices("crate::").chain(code.match_indices("super::")).filter(begins);
    let from_root = |path: Vec<&'a str>| {
        let above = path.iter().take_while(|&&part| part == "super").count();
        let at_root = path[0] == "crate" || above >= own.len();
        at_root.then(|| path[above.max(1)])
    };
    starts.flat_map(|(at, _)| paths(&code[at..])).filter_map(from_root).map(home).collect()
}

/// The paths that begin here, one for each member of a group.
pub(crate) fn paths(text: &str) -> Vec<Vec<&str>> {
    if let Some(group) = text.strip_prefix('{') {
        return members(group).into_iter().flat_map(paths).collect();
    }
    let (name, rest) =
        text.split_at(text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len()));
    let ends = rest.strip_prefix("::").map_or(vec![Vec::new()], paths);
    ends.into_iter().map(|end| [vec![name], end].concat()).collect()
}

/// The members of a group, up to the brace that ends it.
fn members(group: &str) -> Vec<&str> {
    let (mut members, mut depth, mut start) = (Vec::new(), 0, 0);
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' | '}' if depth == 0 => {
                members.push(group[start..at].trim());
                start = at + 1;
                if c == '}' {
                    break;
                }
            }
            _ => {}
        }
    }
    members.retain(|member| !member.is_empty());
    members
}

/// The module of what the root of a crate re-exports.
fn home(name: &str) -> &str {
    match name {
        "Error" => "error",
        "Real" => "real",
        "Tally" | "InformationSum" | "ExactSum" => "tally",
        "Failure" => "failure",
        "Cells" | "with_grid" => "cells",
        module => module,
    }
}

#[test]
fn a_file_holds_one_idea() {
    for folder in [
        "src",
        "crates",
        "bindings",
        "tests",
        "benches",
        "examples",
        "fuzz/fuzz_targets",
        "proofs/mutants/src",
    ] {
        for file in sources(folder) {
            let lines = read(&file).lines().count();
            let long = LONG.iter().any(|name| file == Path::new(name));
            assert!(lines <= 400 || long, "{}: {lines} lines", file.display());
        }
    }
}

/// A module is where its name says: no attribute reaches above the folder of its file.
#[test]
fn no_module_is_taken_from_a_folder_above() {
    for file in ["src", "crates", "tests", "benches", "examples", "fuzz"].into_iter().flat_map(sources) {
        let above = |line: &&str| line.trim_start().starts_with("#[path") && line.contains("..");
        assert_eq!(read(&file).lines().find(above), None, "{}", file.display());
    }
}
