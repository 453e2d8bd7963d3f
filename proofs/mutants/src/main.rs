//! Every mutant that cargo-mutants lists for the library, in minutes: mutant schemata.
//!
//!     cargo run --release --manifest-path proofs/mutants/Cargo.toml -- [WORK [FILES...]]
//!
//! cargo-mutants compiles each mutant; here all are compiled once, each behind a switch that an environment variable sets, and
//! a mutant is run against those tests only which reach its place. FILES, globs such as `'src/map/**'`, restrict it to the
//! mutants of these files. WORK (default `target/mutants`) gets
//!
//! * `library/`: the copy of the repository with the switches, and `plain/` without, for `tests/proofs`;
//! * `log.tsv`: a line for each mutant, verdict, test and name. A name that is there is not run again: delete its line to do so;
//! * `refused.tsv`: the mutants that cannot be expressed by a switch, which cargo-mutants has to try (most do not compile).

mod places;
mod suites;
mod switches;

use std::collections::{BTreeMap, HashMap, HashSet};
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use places::{Mutant, Place};
use serde_json::Value;
use suites::Verdict;
use switches::Switched;

const PACKAGE: [&str; 4] = ["--package", "mean-information", "--features", "serde,vectors,rayon"];
/// Not `same_bits`, which compiles the source.
const SUITES: [&str; 9] = [
    "--lib",
    "--test",
    "library",
    "--test",
    "portable",
    "--test",
    "vectors",
    "--test",
    "proofs",
];
/// Generated, and checked against their generators by `proofs/check.sh`.
const GENERATED: [&str; 2] = ["src/rounded/constants.rs", "src/limit/closed_form/tables.rs"];

fn main() {
    let mut arguments = std::env::args().skip(1);
    let work = PathBuf::from(arguments.next().unwrap_or_else(|| "target/mutants".to_owned()));
    let files: Vec<String> = arguments.flat_map(|glob| ["--file".to_owned(), glob]).collect();
    fs::create_dir_all(&work).expect("the work directory can be made");
    let root = work.canonicalize().expect("the work directory is there").join("library");
    // Those that .cargo/mutants.toml excludes are run, too: they must not be caught.
    let mutants = list(&files, &["--no-config"]);
    let kept: HashSet<String> = list(&files, &[]).into_iter().map(|mutant| mutant.name).collect();
    println!("{} mutants, {} of them excluded", mutants.len(), mutants.len() - kept.len());
    copy(&root);

    let mut files: BTreeMap<&str, Vec<Mutant>> = BTreeMap::new();
    for mutant in &mutants {
        files.entry(&mutant.file).or_default().push(mutant.clone());
    }
    let mut refused: HashMap<u32, String> = HashMap::new();
    let mut sources: BTreeMap<&str, (String, Vec<Place>)> = BTreeMap::new();
    for (file, mutants) in files {
        let source = fs::read_to_string(file).expect("a file of the list can be read");
        let (places, without) = places::find(&source, &mutants);
        refused.extend(without.into_iter().map(|mutant| (mutant.id, "no switch for it".to_owned())));
        sources.insert(file, (source, places));
    }
    compile(&root, &sources, &mut refused);
    let lines =
        mutants.iter().filter_map(|mutant| Some(format!("{}\t{}\n", refused.get(&mutant.id)?, mutant.name)));
    fs::write(work.join("refused.tsv"), lines.collect::<String>()).expect("refused.tsv can be written");
    println!("{} refused", refused.len());

    let (proofs, suites): (Vec<_>, Vec<_>) =
        build(&root).into_iter().partition(|suite| suite.to_string_lossy().contains("proofs-"));
    // `tests/proofs` compares the source with the proofs, as text: without switches.
    let plain = Mutex::new(work.canonicalize().expect("the work directory is there").join("plain"));
    copy(&plain.lock().expect("no thread has it yet"));
    let tests = suites::measure(&root, &suites, &examples(&root), &root.join("reached"));
    let total: f64 = tests.iter().map(|test| test.time.as_secs_f64()).sum();
    println!("{} tests, {total:.1} s", tests.len());
    let place_of: HashMap<u32, u32> = sources
        .values()
        .flat_map(|(_, places)| places)
        .flat_map(|place| place.mutants.iter().map(|mutant| (mutant.id, place.mutants[0].id)))
        .collect();
    let path = work.join("log.tsv");
    let done = fs::read_to_string(&path).unwrap_or_default();
    let done: HashSet<&str> = done.lines().filter_map(|line| line.split('\t').nth(2)).collect();
    let wanted: Vec<&Mutant> = mutants
        .iter()
        .filter(|mutant| !refused.contains_key(&mutant.id) && !done.contains(mutant.name.as_str()))
        .collect();
    let log = OpenOptions::new().append(true).create(true).open(&path).expect("log.tsv can be opened");
    let (log, next) = (Mutex::new(log), AtomicUsize::new(0));
    let cores = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        for _ in 0..cores {
            scope.spawn(|| {
                while let Some(mutant) = wanted.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let (verdict, test) = match suites::judge(&root, &tests, mutant.id, place_of[&mutant.id])
                    {
                        Verdict::Caught(test) => ("caught", test),
                        Verdict::Timeout => ("timeout", String::new()),
                        Verdict::Missed if mutant.file.starts_with("src/rounded") => {
                            let plain = plain.lock().expect("no thread panics with the plain copy");
                            let file = plain.join(&mutant.file);
                            let source = &sources[mutant.file.as_str()].0;
                            write(&file, mutant.applied(source).as_bytes());
                            let differs = suites::fails(&plain, &proofs[0]);
                            write(&file, source.as_bytes());
                            if differs { ("caught", "proofs".to_owned()) } else { ("missed", String::new()) }
                        }
                        Verdict::Missed => ("missed", String::new()),
                    };
                    let line = format!("{verdict}\t{test}\t{}\n", mutant.name);
                    let mut log = log.lock().expect("no thread panics with the log");
                    log.write_all(line.as_bytes()).expect("log.tsv can be written");
                }
            });
        }
    });
    report(&path, &mutants, &refused, &kept);
}

/// Prints how many mutants have which verdict, those that are missed, and those that are caught although excluded.
fn report(log: &Path, mutants: &[Mutant], refused: &HashMap<u32, String>, kept: &HashSet<String>) {
    let log = fs::read_to_string(log).unwrap_or_default();
    let verdicts: HashMap<&str, &str> = log
        .lines()
        .filter_map(|line| line.split_once('\t'))
        .filter_map(|(verdict, rest)| Some((rest.split_once('\t')?.1, verdict)))
        .collect();
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for mutant in mutants.iter().filter(|mutant| !refused.contains_key(&mutant.id)) {
        let verdict = verdicts.get(mutant.name.as_str()).copied().unwrap_or("not run");
        let kept = kept.contains(&mutant.name);
        *counts.entry(if kept { verdict } else { "excluded" }).or_default() += 1;
        if kept == (verdict == "missed") {
            println!("{verdict}{}: {}", if kept { "" } else { ", although excluded" }, mutant.name);
        }
    }
    println!("{counts:?}, refused: {}", refused.len());
}

/// The mutants of cargo-mutants.
fn list(files: &[String], options: &[&str]) -> Vec<Mutant> {
    let mut command = Command::new("cargo");
    command
        .args(["mutants", "--package", "mean-information", "--all-features", "--list", "--json"])
        .args(files)
        .args(options);
    for file in GENERATED {
        command.args(["--exclude", file]);
    }
    let output = command.output().expect("cargo mutants starts");
    let list: Vec<Value> = serde_json::from_slice(&output.stdout).expect("cargo mutants writes JSON");
    let text = |value: &Value| value.as_str().expect("a string").to_owned();
    let at = |value: &Value| {
        let number = |key: &str| value[key].as_u64().expect("a number") as usize;
        (number("line"), number("column") - 1)
    };
    let mutant = |(id, value): (u32, &Value)| Mutant {
        id,
        name: text(&value["name"]),
        file: text(&value["file"]),
        genre: text(&value["genre"]),
        replacement: text(&value["replacement"]),
        returned: value["function"]["return_type"].as_str().unwrap_or_default().to_owned(),
        start: at(&value["span"]["start"]),
        end: at(&value["span"]["end"]),
    };
    (1..).zip(&list).map(mutant).collect()
}

/// The files under version control, into `root`; what is the same is left alone, so that it is not compiled again.
fn copy(root: &Path) {
    let output = Command::new("git").args(["ls-files", "-z"]).output().expect("git starts");
    for name in String::from_utf8_lossy(&output.stdout).split_terminator('\0') {
        if let Ok(bytes) = fs::read(name) {
            write(&root.join(name), &bytes);
        }
    }
}

fn write(path: &Path, bytes: &[u8]) {
    if fs::read(path).is_ok_and(|old| old == bytes) {
        return;
    }
    fs::create_dir_all(path.parent().expect("a file has a folder")).expect("a folder can be made");
    fs::write(path, bytes).expect("a file can be written");
}

/// Writes the switched files and refuses mutants until the library compiles.
fn compile(root: &Path, sources: &BTreeMap<&str, (String, Vec<Place>)>, refused: &mut HashMap<u32, String>) {
    write(&root.join("src/mutant.rs"), include_bytes!("switch.rs"));
    let library = fs::read_to_string("src/lib.rs").expect("src/lib.rs can be read");
    write(&root.join("src/lib.rs"), format!("{library}\nmod mutant;\n").as_bytes());
    for round in 1.. {
        let ids: HashSet<u32> = refused.keys().copied().collect();
        let switched: HashMap<&str, Switched> = sources
            .iter()
            .map(|(file, (source, places))| (*file, Switched::new(source, places, &ids)))
            .collect();
        for (file, switched) in &switched {
            write(&root.join(file), switched.text.as_bytes());
        }
        let errors = errors(root);
        if errors.is_empty() {
            let there: HashSet<u32> = switched.values().flat_map(Switched::mutants).chain(ids).collect();
            let all = sources.values().flat_map(|(_, places)| places).flat_map(|place| &place.mutants);
            for mutant in all {
                assert!(there.contains(&mutant.id), "lost: {}", mutant.name);
            }
            return;
        }
        for error in &errors {
            let spans = error["spans"].as_array().expect("an array");
            let owners = |primary: bool| {
                let mut spans =
                    spans.iter().filter(move |span| span["is_primary"].as_bool() == Some(primary));
                spans.find_map(|span| {
                    let file = switched.get(span["file_name"].as_str()?)?;
                    file.owners(span["byte_start"].as_u64()? as usize)
                })
            };
            let Some(ids) = owners(true).or_else(|| owners(false)) else {
                panic!("not the fault of a mutant: {}", error["rendered"].as_str().unwrap_or_default());
            };
            let code = error["code"]["code"].as_str().unwrap_or_default();
            for id in ids {
                let message = error["message"].as_str().unwrap_or_default().replace(['\n', '\t'], " ");
                refused.entry(*id).or_insert_with(|| format!("{code} {message}"));
            }
        }
        println!("round {round}: {} errors, {} mutants refused", errors.len(), refused.len());
    }
}

fn cargo(root: &Path) -> Command {
    let mut command = Command::new("nice");
    command.args(["-n", "5", "cargo"]).current_dir(root);
    // As `cargo test` does, but quick; the lints are those of other code.
    command.env("RUSTFLAGS", "--cap-lints allow").env("CARGO_TARGET_DIR", root.join("../target"));
    command.env("CARGO_PROFILE_DEV_OPT_LEVEL", "2").env("CARGO_PROFILE_DEV_DEBUG", "0");
    command
}

fn messages(command: &mut Command) -> Vec<Value> {
    let output = command.args(["--message-format", "json"]).output().expect("cargo starts");
    let text = String::from_utf8_lossy(&output.stdout);
    text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect()
}

fn errors(root: &Path) -> Vec<Value> {
    let messages = messages(cargo(root).args(["check", "--lib"]).args(PACKAGE));
    let errors = messages.into_iter().map(|mut message| message["message"].take());
    errors
        .filter(|message| {
            message["level"] == "error" && !message["spans"].as_array().is_none_or(Vec::is_empty)
        })
        .collect()
}

/// The executables of the suites.
fn build(root: &Path) -> Vec<PathBuf> {
    let messages = messages(cargo(root).args(["test", "--no-run"]).args(PACKAGE).args(SUITES));
    let suites = messages.iter().filter(|message| message["profile"]["test"] == true);
    let suites: Vec<PathBuf> =
        suites.filter_map(|message| message["executable"].as_str()).map(PathBuf::from).collect();
    assert_eq!(
        suites.len(),
        SUITES.len() / 2 + 1,
        "a suite does not compile: cargo test in {}",
        root.display()
    );
    suites
}

/// The folder of the examples of the documentation, which rustdoc makes one executable of.
fn examples(root: &Path) -> PathBuf {
    let folder = root.join("../examples");
    fs::create_dir_all(&folder).expect("a folder can be made");
    let flags = format!("--cap-lints allow -Zunstable-options --persist-doctests {}", folder.display());
    let mut command = cargo(root);
    // The stable compiler allows what is unstable to those who ask.
    command.args(["test", "--doc"]).args(PACKAGE).env("RUSTC_BOOTSTRAP", "1").env("RUSTDOCFLAGS", flags);
    assert!(command.output().expect("cargo starts").status.success(), "an example fails without a mutant");
    folder.join("merged_doctest_2024_0")
}
