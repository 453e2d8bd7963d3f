//! The compiled tests: which of them reach a place, and whether they notice its mutant.

use std::collections::HashSet;
use std::ffi::OsStr;
use std::fs;
use std::io::Read;
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// What the names of the examples begin with; their number follows.
const EXAMPLE: &str = "example ";

/// One test function, or one example of the documentation.
#[derive(Debug)]
pub struct Test {
    pub suite: PathBuf,
    pub name: String,
    /// How long it takes without a mutant.
    pub time: Duration,
    /// The places it reaches.
    pub reached: HashSet<u32>,
}

/// The verdict of a mutant's tests.
pub enum Verdict {
    /// The test that failed.
    Caught(String),
    /// They did not end.
    Timeout,
    Missed,
}

/// All tests of `suites` but those that are ignored, and the examples of the documentation, each run alone.
pub fn measure(root: &Path, suites: &[PathBuf], examples: &Path, scratch: &Path) -> Vec<Test> {
    let mut tests = Vec::new();
    for suite in suites {
        let ignored = list(root, suite, &["--ignored"]);
        let names = list(root, suite, &[]).into_iter().filter(|name| !ignored.contains(name));
        tests.extend(names.map(|name| (suite.clone(), name)));
    }
    let source = fs::read_to_string(examples.join("doctest_runner_2024.rs"))
        .expect("rustdoc's source of the examples");
    let count = source.matches("new_doctest(").count();
    tests.extend((0..count).map(|k| (examples.join("rust_out"), format!("{EXAMPLE}{k}"))));

    let measure = |(suite, name): (PathBuf, String)| {
        let timed = |variable: &str, value: &OsStr| {
            let mut command = test_command(root, &suite, [name.as_str()].into_iter());
            let started = Instant::now();
            let outcome = run(command.env(variable, value), Duration::from_secs(600));
            assert!(matches!(outcome, Outcome::Passed), "{name} fails without a mutant");
            started.elapsed()
        };
        fs::remove_file(scratch).ok();
        timed("MUTANT_REACHED", scratch.as_os_str());
        let reached = fs::read_to_string(scratch).unwrap_or_default();
        let reached = reached.lines().map(|line| line.parse().expect("the switch writes numbers")).collect();
        let time = timed("MUTANT", OsStr::new("0"));
        if time > Duration::from_millis(500) {
            println!("{name}: {:.1} s", time.as_secs_f64());
        }
        Test { suite, name, time, reached }
    };
    let mut tests: Vec<Test> = tests.into_iter().map(measure).collect();
    tests.sort_by_key(|test| test.time);
    tests
}

/// Runs the tests that reach `place` with `mutant`, the quick ones first, until one fails.
pub fn judge(root: &Path, tests: &[Test], mutant: u32, place: u32) -> Verdict {
    let mut reaching = tests.iter().filter(|test| test.reached.contains(&place)).peekable();
    let mut budget = Duration::from_millis(30);
    while reaching.peek().is_some() {
        let mut batch = Vec::new();
        let mut time = Duration::ZERO;
        while let Some(test) = reaching.next_if(|test| batch.is_empty() || time + test.time <= budget) {
            time += test.time;
            batch.push(test);
        }
        budget *= 4;
        let mut suites: Vec<&PathBuf> = batch.iter().map(|test| &test.suite).collect();
        suites.sort();
        suites.dedup();
        for suite in suites {
            let chosen: Vec<&&Test> = batch.iter().filter(|test| &test.suite == suite).collect();
            // The examples are processes of their own.
            let size = if chosen[0].name.starts_with(EXAMPLE) { 1 } else { chosen.len() };
            for chosen in chosen.chunks(size) {
                let time: Duration = chosen.iter().map(|test| test.time).sum();
                let mut command = test_command(root, suite, chosen.iter().map(|test| test.name.as_str()));
                command.env("MUTANT", mutant.to_string());
                match run(&mut command, time * 6 + Duration::from_secs(3)) {
                    Outcome::Passed => {}
                    Outcome::Failed(test) => {
                        let suite = suite.file_name().unwrap_or_default().to_string_lossy();
                        let test = test.unwrap_or_else(|| chosen[0].name.clone());
                        return Verdict::Caught(format!(
                            "{} {test}",
                            suite.split('-').next().unwrap_or_default()
                        ));
                    }
                    Outcome::Endless => return Verdict::Timeout,
                }
            }
        }
    }
    Verdict::Missed
}

/// Returns whether a suite fails in a folder.
pub fn fails(root: &Path, suite: &Path) -> bool {
    let mut command = Command::new(suite);
    command.current_dir(root).process_group(0);
    !matches!(run(&mut command, Duration::from_secs(60)), Outcome::Passed)
}

fn list(root: &Path, suite: &Path, more: &[&str]) -> Vec<String> {
    let mut command = Command::new(suite);
    command.current_dir(root).args(["--list", "--format", "terse"]).args(more);
    let text = command.output().expect("a suite lists its tests").stdout;
    let text = String::from_utf8_lossy(&text);
    text.lines().filter_map(|line| line.strip_suffix(": test")).map(str::to_owned).collect()
}

/// The tests of these names, in one thread, until one fails; with 4 GB of memory, as a mutant may ask for all there is.
fn test_command<'a>(root: &Path, suite: &Path, names: impl Iterator<Item = &'a str> + Clone) -> Command {
    let mut command = Command::new("sh");
    command.args(["-c", "ulimit -v 4000000; exec nice -n 5 \"$0\" \"$@\""]).arg(suite);
    if let Some(example) = names.clone().next().and_then(|name| name.strip_prefix(EXAMPLE)) {
        command.env("RUSTDOC_DOCTEST_RUN_NB_TEST", example);
    } else {
        command.args(["--exact", "--test-threads=1", "-Zunstable-options", "--fail-fast"]).args(names);
    }
    command.current_dir(root).process_group(0);
    // For --fail-fast.
    command.env("RUSTC_BOOTSTRAP", "1");
    command.env("PROPTEST_MAX_SHRINK_ITERS", "0").env("PROPTEST_DISABLE_FAILURE_PERSISTENCE", "1");
    command
}

enum Outcome {
    Passed,
    /// The test, if the output names it.
    Failed(Option<String>),
    Endless,
}

fn run(command: &mut Command, limit: Duration) -> Outcome {
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().expect("a suite starts");
    let mut stdout = child.stdout.take().expect("stdout is a pipe");
    let reader = thread::spawn(move || {
        let mut text = Vec::new();
        stdout.read_to_end(&mut text).ok();
        String::from_utf8_lossy(&text).into_owned()
    });
    let started = Instant::now();
    let mut pause = Duration::from_millis(1);
    let status = loop {
        if let Some(status) = child.try_wait().expect("a suite can be waited for") {
            break status;
        }
        if started.elapsed() > limit {
            let group = format!("-{}", child.id());
            Command::new("kill").args(["-KILL", "--", &group]).status().expect("kill starts");
            child.wait().expect("a suite that was killed ends");
            return Outcome::Endless;
        }
        thread::sleep(pause);
        pause = (pause * 2).min(Duration::from_millis(50));
    };
    if status.success() {
        return Outcome::Passed;
    }
    let text = reader.join().unwrap_or_default();
    let failed = text.lines().find(|line| line.ends_with("FAILED") && line.starts_with("test "));
    Outcome::Failed(failed.map(|line| line["test ".len()..].trim_end_matches(" ... FAILED").to_owned()))
}
