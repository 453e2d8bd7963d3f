//! The time of a call, on a machine that others use, too.

use std::hint::black_box;
use std::path::Path;
use std::process::{Command, Stdio};

/// What a method gives, and in what time.
pub(crate) struct Timed<T> {
    pub(crate) method: String,
    pub(crate) seconds: f64,
    pub(crate) result: T,
}

/// The least time of a call in about `seconds` of calls, at least five.
pub(crate) fn timed<T>(method: &str, seconds: f64, call: impl Fn() -> T) -> Timed<T> {
    // In runs of a millisecond or more, so that the timer takes no part.
    let run = |calls: u32| {
        let start = now();
        for _ in 0..calls {
            black_box(call());
        }
        (now() - start) / f64::from(calls)
    };
    let calls = (1e-3 / run(3)).clamp(1.0, 1e6).ceil() as u32;
    let once = run(calls);
    let runs = (seconds / once / f64::from(calls)).clamp(5.0, 1e4) as u32;
    let seconds = (0..runs).map(|_| run(calls)).fold(once, f64::min);
    Timed { method: method.to_owned(), seconds, result: call() }
}

/// Processor time of this thread in seconds: unlike the clock, it stands still while others run.
#[cfg(unix)]
fn now() -> f64 {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// Time since the first call in seconds.
#[cfg(not(unix))]
fn now() -> f64 {
    static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    START.get_or_init(std::time::Instant::now).elapsed().as_secs_f64()
}

/// What a program writes, with what it reports passed on; nothing, with a message, where it cannot be run.
pub(crate) fn output_of(command: &mut Command) -> String {
    match command.stderr(Stdio::inherit()).output() {
        Ok(output) if output.status.success() => String::from_utf8_lossy(&output.stdout).into_owned(),
        Ok(output) => skipped(&format!("{command:?}: {}", output.status)),
        Err(error) => skipped(&format!("{command:?}: {error}")),
    }
}

fn skipped(why: &str) -> String {
    eprintln!("skipped: {why}");
    String::new()
}

/// A file beside this one.
pub(crate) fn beside(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/peers").join(name)
}

/// Python, for a script beside this file.
pub(crate) fn python(script: &str) -> Command {
    let mut command = Command::new("python3");
    command.arg(beside(script));
    command
}
