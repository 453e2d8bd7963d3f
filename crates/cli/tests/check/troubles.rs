//! Ports that break the protocol: each ends in a report that names the request, and the run is carried on.

use super::Test;
use super::fixture::Vectors;
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};

pub(crate) const TESTS: &[Test] = &[
    ("troubles_with_one_request", troubles_with_one_request),
    ("a_port_that_reads_ahead_ends", a_port_that_reads_ahead_ends),
    ("a_port_that_ends_only_when_asked_ahead", a_port_that_ends_only_when_asked_ahead),
    ("a_port_that_never_flushes", a_port_that_never_flushes),
    ("a_port_that_ends_at_every_request", a_port_that_ends_at_every_request),
    ("a_port_that_prints_for_people", a_port_that_prints_for_people),
    ("troubles_at_the_end", troubles_at_the_end),
    ("ports_that_are_not_checked", ports_that_are_not_checked),
    ("what_a_port_leaves_behind_is_ended", what_a_port_leaves_behind_is_ended),
];

/// Long enough for an answer on a busy machine, short enough to wait for one that never comes.
const SHORT: [&str; 2] = ["--timeout", "3"];

/// The port misbehaves at request 7 each time it is asked it; all others are answered.
fn troubles_with_one_request() {
    let vectors = Vectors::new();
    for (fault, what) in [
        ("hangs", "no answer within 3 s"),
        ("floods", "'all work and no play"),
        ("floods-stderr", "stderr: working"),
        ("garbage", "is not JSON (expected value at column 1): 'computing \\u{1b}[31mcell"),
        ("debris", "no answer, which is not JSON (trailing characters at column "),
        ("no-utf8", "no answer, which is not JSON"),
        ("nested", "no answer, which is not JSON (recursion limit exceeded at column 128): '[[["),
        ("closes", "it closed its standard output instead of answering"),
        ("exits-3", "it ended (exit status: 3) instead of answering\n"),
        ("exits-3", "stderr: ZeroDivisionError: division by zero"),
        ("leaves", "it ended (exit status: 3) instead of answering; a process that it started lived on"),
        ("cuts", "a line that is no answer, which is cut off: '{\"seq\":7,"),
        ("no-number", "no answer, which has no \"seq\", here 7: '{\"result\":\"0x1p-1\"}'"),
        ("float-number", "no answer, whose \"seq\" is 7.0, not the integer 7: '{"),
        (
            "no-parts",
            "no answer, which has 0 of \"result\", \"error\" and \"skipped\", not one: '{\"seq\":7}'",
        ),
        ("both", "no answer, which has 2 of \"result\""),
        (
            "wrong-type",
            "is of the wrong type (invalid type: integer `3`, expected a string): '{\"seq\":7,\"error\":3}'",
        ),
        ("no-object", "no answer, which is JSON, but not an object: '[7,"),
        ("reorders", "the answer to request 8 where that to 7 was due"),
    ] {
        if cfg!(not(unix)) && ["closes", "leaves"].contains(&fault) {
            continue;
        }
        let table = vectors.table(fault, &SHORT, "43 passed, 1 failed, 0 skipped");
        let report = table.split("trouble: test-7\n").nth(1).unwrap_or_else(|| panic!("{fault}: {table}"));
        assert!(report.contains(what), "{fault}: {table}");
        assert!(table.contains("crashes, hangs or breaks the protocol"), "{fault}: {table}");
    }
    // Here the first of the answers is right; the next is not due.
    let table = vectors.table("floods-lines", &SHORT, "43 passed, 1 failed, 0 skipped");
    assert!(table.contains("the answer to request 7 where that to 8 was due"), "{table}");
}

/// Request 12 ends it while 2 is unanswered: that is found out by asking one at a time.
fn a_port_that_reads_ahead_ends() {
    let table = Vectors::new().table("exits-reading", &SHORT, "43 passed, 1 failed, 0 skipped");
    assert!(table.contains("trouble: test-12\n") && table.contains("stderr: reading failed"), "{table}");
}

fn a_port_that_ends_only_when_asked_ahead() {
    let table = Vectors::new().table("exits-ahead", &SHORT, "44 passed, 1 failed, 0 skipped");
    assert!(table.contains("requests sent ahead up to test-"), "{table}");
}

fn a_port_that_never_flushes() {
    let table =
        Vectors::new().table("never-flushes", &["--timeout", "0.5"], "0 passed, 44 failed, 0 skipped");
    for part in [
        "does it flush every answer?",
        "given up",
        "5 answers did not come in time",
        "not run after too much trouble: 35 of 40",
    ] {
        assert!(table.contains(part), "{part}: {table}");
    }
}

/// An operation is given up, the next one is begun.
fn a_port_that_ends_at_every_request() {
    let table = Vectors::new().table("exits-always", &SHORT, "0 passed, 44 failed, 0 skipped");
    assert!(table.contains("not run after too much trouble: 20 of 40 failures"), "{table}");
    assert!(table.contains("map.observed: 4 of 4 failed") && !table.contains("given up"), "{table}");
    // Three are shown of each operation.
    for more in ["trouble with 17 more requests", "trouble with 1 more requests"] {
        assert!(table.contains(more), "{table}");
    }
}

/// Three of its lines are enough, whatever the operation.
fn a_port_that_prints_for_people() {
    let vectors = Vectors::new();
    let table = vectors.table("debugs", &SHORT, "0 passed, 44 failed, 0 skipped");
    for part in [
        "given up, the rest has failed: 3 lines that are no answers",
        "belongs on standard error",
        "a line that is no answer, which is not JSON (expected value at column 1): 'p = {\"p\": Float",
        "not run after too much trouble: 37 of 40",
        "started again, 2 times in all",
    ] {
        assert!(table.contains(part), "{part}: {table}");
    }
}

fn troubles_at_the_end() {
    let vectors = Vectors::new();
    for (fault, what) in [
        ("ignores-stop", "it ran on for 3 s after it was told to stop"),
        ("talks-at-stop", "a line after it was told to stop: 'bye'"),
        ("exits-3-at-stop", "it ended (exit status: 3, not 0) after it was told to stop\n"),
        (
            "leaves-at-stop",
            "it ended (exit status: 0) after it was told to stop; a process that it started lived on",
        ),
    ] {
        if cfg!(not(unix)) && fault == "leaves-at-stop" {
            continue;
        }
        let table = vectors.table(fault, &SHORT, "44 passed, 1 failed, 0 skipped");
        assert!(table.contains("trouble at the end: ") && table.contains(what), "{table}");
    }
}

fn ports_that_are_not_checked() {
    let vectors = Vectors::new();
    for (fault, what) in [
        ("dies", "cannot find numpy"),
        ("dies", "exit status: 4"),
        ("mute", "no answer within 3 s"),
        ("protocol-2", "speaks protocol 2, not 1"),
        ("refuses", "refuses protocol 1: \"protocol\""),
        ("garbled", "not JSON"),
        ("no-protocol", "has no \"protocol\""),
        ("no-list", "cannot be read"),
        ("no-ops", "\"ops\" is empty"),
        ("strange-ops", "cell.entopy"),
        ("no-formats", "f16"),
        ("negative-claim", "a claim is 0 to 67108864 ulp"),
        ("huge-claim", "a claim is 0 to 67108864 ulp"),
        ("huge-bits", "a claim is 0 to 0.001 bits"),
    ] {
        let line = vectors.refusal(fault, &SHORT);
        assert!(line.contains(what) && line.contains(fault), "{fault}: {line}");
    }
}

/// A process that holds the pipes of a port that has ended is not waited for; it goes with the port.
fn what_a_port_leaves_behind_is_ended() {
    if !Path::new("/proc/self").exists() {
        return;
    }
    let vectors = Vectors::new();
    let number = vectors.folder.text_path("number");
    let mut command = crate::common::meaninfo();
    command.args(["check", "--vectors"]).arg(vectors.folder.path("")).args(["--timeout", "100", "--"]);
    command.arg(std::env::current_exe().unwrap()).args([super::fixture::AS_PORT, "orphan", &number]);
    let started = Instant::now();
    let output = command.timeout(Duration::from_secs(120)).output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let started = started.elapsed();
    assert!(started < Duration::from_secs(60), "{started:?}");
    let number = std::fs::read_to_string(number).unwrap();
    let runs = || {
        let state = std::fs::read_to_string(format!("/proc/{number}/stat")).unwrap_or_default();
        state.rsplit(')').next().is_some_and(|rest| !rest.is_empty() && !rest.trim_start().starts_with('Z'))
    };
    // The system takes a moment.
    for _ in 0..100 {
        if !runs() {
            return;
        }
        thread::sleep(Duration::from_millis(50));
    }
    panic!("{number} runs on");
}
