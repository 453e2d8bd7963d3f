//! `meaninfo port` and `meaninfo check`: the reference passes, faulty ports are named for what they are, and no port,
//! however it misbehaves, makes the command hang.
//!
//! The ports are this program itself, started with the name of a fault (`ports`); hence it has a `main` of its own,
//! which runs the tests whose names contain one of the arguments, or all.

mod faults;
mod files;
mod fixture;
mod ports;
mod reference;
mod troubles;
mod verdicts;

use std::panic::catch_unwind;
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// A test by its name.
type Test = (&'static str, fn());

/// Most of them wait most of the time.
const THREADS: usize = 4;

pub(crate) fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [word, fault, rest @ ..] = &arguments[..]
        && word == fixture::AS_PORT
    {
        ports::serve(fault, rest);
        return ExitCode::SUCCESS;
    }
    let filters: Vec<_> = arguments.iter().filter(|argument| !argument.starts_with('-')).collect();
    let chosen =
        |name: &str| filters.is_empty() || filters.iter().any(|filter| name.contains(filter.as_str()));
    let all = [reference::TESTS, faults::TESTS, troubles::TESTS, verdicts::TESTS, files::TESTS].concat();
    let tests: Vec<Test> = all.into_iter().filter(|(name, _)| chosen(name)).collect();
    if arguments.iter().any(|argument| argument == "--list") {
        for (name, _) in &tests {
            println!("{name}: test");
        }
        return ExitCode::SUCCESS;
    }
    println!("\nrunning {} tests", tests.len());
    let (next, failed) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let work = || {
        while let Some((name, test)) = tests.get(next.fetch_add(1, Ordering::SeqCst)) {
            let passed = catch_unwind(test).is_ok();
            failed.fetch_add(usize::from(!passed), Ordering::SeqCst);
            println!("test {name} ... {}", if passed { "ok" } else { "FAILED" });
        }
    };
    thread::scope(|scope| (0..THREADS).for_each(|_| drop(scope.spawn(work))));
    let failed = failed.into_inner();
    println!("\ntest result: {} passed; {failed} failed\n", tests.len() - failed);
    if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
