//! The check, checked: mistakes are planted in the Python port, one at a time, and `meaninfo check` must name each.
//!
//! `faults/python.txt` lists mistakes of all kinds, `faults/mrpt.txt` the rules of MRPT, and
//! `faults/people.txt` mistakes as people write them. A mistake is named if the
//! first cause of the operation is one of those that the list expects. Every trap of the vectors is expected of some.

mod common;

use common::*;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

const PORT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../ports/python/port.py");
const LISTS: [&str; 3] =
    [include_str!("faults/python.txt"), include_str!("faults/mrpt.txt"), include_str!("faults/people.txt")];
const VECTORS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../vectors/v1");
const CHAPTER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/porting.md");
/// Ports that run at the same time.
const THREADS: usize = 2;

/// A mistake and what it must be called.
#[derive(Debug, Default)]
struct Fault<'a> {
    name: &'a str,
    op: &'a str,
    causes: Vec<&'a str>,
    /// Lines to take out, and those to put in their place.
    places: Vec<(Vec<&'a str>, Vec<&'a str>)>,
}

fn faults() -> Vec<Fault<'static>> {
    let mut faults: Vec<Fault> = Vec::new();
    let mut putting = true;
    for line in LISTS.iter().flat_map(|list| list.lines()) {
        match line.split_at_checked(1) {
            Some(("@", header)) => {
                let fields: Vec<_> = header.split(" : ").map(str::trim).collect();
                let [name, op, causes] = fields[..] else { panic!("{line}") };
                let causes = causes.split(' ').collect();
                faults.push(Fault { name, op, causes, places: Vec::new() });
                putting = true;
            }
            Some(("-", text)) => {
                let places = &mut faults.last_mut().unwrap().places;
                if putting {
                    places.push((Vec::new(), Vec::new()));
                }
                places.last_mut().unwrap().0.push(text);
                putting = false;
            }
            Some(("+", text)) => {
                faults.last_mut().unwrap().places.last_mut().unwrap().1.push(text);
                putting = true;
            }
            Some(("#", _)) | None => {}
            _ => panic!("neither a header nor a line of a place: {line}"),
        }
    }
    faults
}

impl Fault<'_> {
    fn planted(&self, port: &str) -> String {
        self.places.iter().fold(port.to_owned(), |port, (old, new)| {
            let old = old.join("\n");
            assert_eq!(port.matches(&old).count(), 1, "{}: must be there once:\n{old}", self.name);
            port.replace(&old, &new.join("\n"))
        })
    }

    /// What is wrong with the verdict on the port with this fault. The vectors are in folders by operation: to read
    /// them all takes longer than to run those of one.
    fn unnamed(&self, file: &Path, vectors: &Folder) -> Option<String> {
        let (status, verdict) = check(&["--vectors", &vectors.text_path(self.op)], file);
        let operations = verdict["operations"].as_array().unwrap();
        let causes: Vec<_> = operations.iter().flat_map(|o| o["causes"].as_array().unwrap()).collect();
        // Causes of one score cannot be told apart from the answers: the report says them all.
        let first = causes.iter().take_while(|cause| cause["score"] == causes[0]["score"]);
        let is_named = first.into_iter().any(|cause| self.causes.contains(&cause["name"].as_str().unwrap()));
        let found: Vec<_> = causes.iter().take(4).map(|cause| cause["name"].as_str().unwrap()).collect();
        (status != 1 || !is_named).then(|| {
            format!(
                "{} ({}): wanted {:?}, found {found:?}, exit status {status}",
                self.name, self.op, self.causes
            )
        })
    }
}

/// The exit status of `meaninfo check` on a Python file, and its verdict.
fn check(options: &[&str], file: &Path) -> (i32, Value) {
    let mut command = meaninfo();
    command.args(["check", "--format", "json"]).args(options).args(["--", "python3"]).arg(file);
    let output = command.output().unwrap();
    let verdict = serde_json::from_slice(&output.stdout);
    let verdict =
        verdict.unwrap_or_else(|error| panic!("{}: {error}: {}", file.display(), text(&output.stderr)));
    (output.status.code().unwrap(), verdict)
}

fn has_python() -> bool {
    let found = Command::new("python3").arg("--version").output();
    let has = found.is_ok_and(|output| output.status.success());
    if !has {
        eprintln!("skipped: there is no python3");
    }
    has
}

#[test]
fn the_port_without_faults_passes() {
    if has_python() {
        let (status, verdict) = check(&[], Path::new(PORT));
        assert_eq!(
            (status, &verdict["failed"], &verdict["undeclared"]),
            (0, &0.into(), &Value::Array(vec![]))
        );
    }
}

#[test]
fn every_planted_fault_is_named() {
    let faults = faults();
    assert!(faults.len() > 200);
    if !has_python() {
        return;
    }
    let port = fs::read_to_string(PORT).unwrap();
    let folder = Folder::new();
    for op in faults.iter().map(|fault| fault.op).collect::<BTreeSet<_>>() {
        fs::create_dir(folder.path(op)).unwrap();
        let file = format!("{op}.json");
        fs::copy(Path::new(VECTORS).join(&file), folder.path(op).join(&file)).unwrap();
    }
    let next = AtomicUsize::new(0);
    let work = || {
        let mut unnamed = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(fault) = faults.get(index) else { return unnamed };
            let file = folder.path(&format!("fault_{index}.py"));
            fs::write(&file, fault.planted(&port)).unwrap();
            unnamed.extend(fault.unnamed(&file, &folder));
        }
    };
    let unnamed: Vec<String> = thread::scope(|scope| {
        let threads: Vec<_> = (0..THREADS).map(|_| scope.spawn(work)).collect();
        threads.into_iter().flat_map(|thread| thread.join().unwrap()).collect()
    });
    assert!(
        unnamed.is_empty(),
        "{} of {} faults are not named:\n{}",
        unnamed.len(),
        faults.len(),
        unnamed.join("\n")
    );
}

/// The keys of an object in every file of vectors.
fn names_in_vectors(keys: &[&str]) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for entry in fs::read_dir(VECTORS).unwrap() {
        let vectors: Value =
            serde_json::from_slice(&fs::read(entry.unwrap().path()).unwrap()).unwrap_or_default();
        let objects = keys.iter().filter_map(|key| vectors[key].as_object());
        names.extend(objects.flat_map(|names| names.keys().cloned()));
    }
    names
}

/// A trap that is never planted may be one that no answer falls into; a cause that no file knows is a slip of the pen.
#[test]
fn every_trap_is_planted() {
    let expected: BTreeSet<_> =
        faults().into_iter().flat_map(|fault| fault.causes).map(str::to_owned).collect();
    let traps = names_in_vectors(&["traps"]);
    let missing: Vec<_> = traps.difference(&expected).collect();
    assert!(traps.len() > 100 && missing.is_empty(), "{missing:?} of {} traps", traps.len());
    let known = names_in_vectors(&["traps", "flags"]);
    // Facts are written with small letters.
    let unknown =
        expected.difference(&known).filter(|name| name.starts_with(|c: char| c.is_ascii_uppercase()));
    assert_eq!(unknown.collect::<Vec<_>>(), [] as [&String; 0]);
}

/// Names of traps and flags are words of two parts or more: `DividedByAll`.
#[test]
fn the_chapter_on_ports_uses_names_that_the_check_knows() {
    let known = names_in_vectors(&["traps", "flags"]);
    let chapter = fs::read_to_string(CHAPTER).unwrap();
    let code = chapter.split('`').skip(1).step_by(2);
    let is_name = |word: &&str| {
        word.starts_with(|c: char| c.is_ascii_uppercase())
            && word.chars().all(|c| c.is_ascii_alphanumeric())
            && word.chars().filter(char::is_ascii_uppercase).count() > 1
            && word.contains(|c: char| c.is_ascii_lowercase())
    };
    let used: BTreeSet<_> = code.filter(is_name).collect();
    let unknown: Vec<_> = used.iter().filter(|name| !known.contains(**name)).collect();
    assert!(used.len() > 20 && unknown.is_empty(), "{unknown:?} of {used:?}");
}
