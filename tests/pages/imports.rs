//! Files depend on one another one way: no circle of files in any package.
//!
//! A module's file that only re-exports is a face: an item that is imported through it counts as imported from the file
//! that defines it.

use crate::architecture::{paths, without_tests};
use crate::{read, sources};
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// A module by the names on its path from the root of its package.
type Module = Vec<String>;

/// The sources of a package.
struct Package {
    files: BTreeMap<Module, PathBuf>,
    code: BTreeMap<Module, String>,
}

impl Package {
    fn read(folder: &str) -> Self {
        let (mut files, mut code) = (BTreeMap::new(), BTreeMap::new());
        for file in sources(folder) {
            let within = file.strip_prefix(folder).unwrap().with_extension("");
            let mut module: Module = within.iter().map(|part| part.to_str().unwrap().to_owned()).collect();
            if module.iter().any(|name| name == "tests" || name == "main") {
                continue;
            }
            if module.last().is_some_and(|name| name == "mod" || name == "lib") {
                module.pop();
            }
            code.insert(module.clone(), without_tests(&read(&file)));
            files.insert(module, file);
        }
        Self { files, code }
    }

    /// The module that a path written in `module` leads to, and what follows it, if it begins in this package.
    fn absolute(&self, module: &Module, path: &[&str]) -> Option<Vec<String>> {
        let above = path.iter().take_while(|&&name| name == "super").count();
        let (start, rest) = match path[0] {
            "crate" => (Vec::new(), &path[1..]),
            "self" => (module.clone(), &path[1..]),
            "super" => (module[..module.len().checked_sub(above)?].to_vec(), &path[above..]),
            name => {
                let child = [module.clone(), vec![name.to_owned()]].concat();
                (self.files.contains_key(&child).then(|| module.clone())?, path)
            }
        };
        Some(start.into_iter().chain(rest.iter().map(|&name| name.to_owned())).collect())
    }

    /// The module whose file defines the item of an absolute path.
    fn home(&self, path: &[String]) -> Module {
        let depth = (0..=path.len()).rev().find(|&depth| self.files.contains_key(&path[..depth])).unwrap();
        let (module, rest) = (path[..depth].to_vec(), &path[depth..]);
        let Some(item) = rest.first() else { return module };
        let reexported = self.reexports(&module).find(|other| other.last().is_some_and(|name| name == item));
        reexported.map_or(module, |other| self.home(&other))
    }

    /// The absolute paths that a module hands on by `pub use`.
    fn reexports<'a>(&'a self, module: &'a Module) -> impl Iterator<Item = Vec<String>> + 'a {
        uses(&self.code[module]).filter(|(public, _)| *public).flat_map(move |(_, text)| {
            paths(text).into_iter().filter_map(move |path| self.absolute(module, &path))
        })
    }

    /// The modules on which the code of a module depends: by imports that are no re-exports, and by paths in the code.
    fn dependencies(&self, module: &Module) -> BTreeSet<Module> {
        let code = &self.code[module];
        let imports = uses(code).filter(|(public, _)| !public).flat_map(|(_, text)| paths(text));
        let starts = |word: &'static str| {
            code.match_indices(word).filter(|&(at, _)| {
                let before = &code[..at];
                let is_name = before.ends_with(|c: char| c.is_alphanumeric() || "_:$".contains(c));
                let line = &before[before.rfind('\n').map_or(0, |end| end + 1)..];
                let is_reexport = line.trim_start().starts_with("pub") && line.contains(" use ");
                !is_name && !is_reexport
            })
        };
        let written =
            ["crate::", "super::"].into_iter().flat_map(starts).flat_map(|(at, _)| paths(&code[at..]));
        let all = imports.chain(written).filter_map(|path| self.absolute(module, &path));
        let mut homes: BTreeSet<_> = all.map(|path| self.home(&path)).collect();
        homes.remove(module);
        homes
    }
}

/// The `use` declarations of a file: whether they re-export, and what follows the word.
fn uses(code: &str) -> impl Iterator<Item = (bool, &str)> {
    code.match_indices("use ").filter_map(|(at, word)| {
        let line = &code[code[..at].rfind('\n').map_or(0, |end| end + 1)..at];
        let visible = line.trim();
        let declares = visible.is_empty() || visible == "pub" || visible.starts_with("pub(");
        declares.then(|| (!visible.is_empty(), &code[at + word.len()..]))
    })
}

/// The modules that a module depends on, by however many steps.
fn reached<'a>(start: &'a Module, graph: &'a BTreeMap<Module, BTreeSet<Module>>) -> BTreeSet<&'a Module> {
    let (mut reached, mut open) = (BTreeSet::new(), vec![start]);
    while let Some(module) = open.pop() {
        open.extend(graph[module].iter().filter(|next| reached.insert(*next)));
    }
    reached
}

#[test]
fn no_files_form_a_circle() {
    for folder in [
        "src",
        "crates/cli/src",
        "crates/files/src",
        "crates/report/src",
        "crates/test-support/src",
        "bindings/web/src",
    ] {
        let package = Package::read(folder);
        let graph: BTreeMap<_, _> =
            package.files.keys().map(|module| (module.clone(), package.dependencies(module))).collect();
        assert!(graph.values().map(BTreeSet::len).sum::<usize>() > 1, "{folder}: no imports were found");
        let in_circles: Vec<_> =
            graph.keys().filter(|module| reached(module, &graph).contains(module)).collect();
        let told = in_circles.iter().map(|module| {
            let uses = graph[*module].iter().filter(|next| in_circles.contains(next));
            let uses: Vec<_> = uses.map(|next| package.files[next].display().to_string()).collect();
            format!("{} uses {}\n", package.files[*module].display(), uses.join(", "))
        });
        assert!(
            in_circles.is_empty(),
            "files that depend on one another in a circle:\n{}",
            told.collect::<String>()
        );
    }
}

#[test]
fn a_path_in_a_public_signature_is_a_dependency() {
    let name = |name: &str| vec![name.to_owned()];
    let code = [
        ("approximate", "pub(crate) struct Hole;\n"),
        ("ball", "pub(crate) fn hole(x: &super::approximate::Hole) {}\n"),
        ("face", "pub(crate) use super::approximate::Hole;\n"),
    ];
    let package = Package {
        files: code.iter().map(|&(module, _)| (name(module), PathBuf::from(module))).collect(),
        code: code.iter().map(|&(module, text)| (name(module), text.to_owned())).collect(),
    };
    assert_eq!(package.dependencies(&name("ball")), BTreeSet::from([name("approximate")]));
    assert_eq!(package.dependencies(&name("face")), BTreeSet::new());
}
