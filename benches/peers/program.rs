//! What a method gives; some are of other programs, whose sources are beside this file.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// What a method gives, and in what time.
pub(crate) struct Timed<T> {
    pub(crate) method: String,
    pub(crate) seconds: f64,
    pub(crate) result: T,
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
pub(crate) fn beside(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/peers").join(name)
}

/// Python, for a script beside this file.
pub(crate) fn python(script: &str) -> Command {
    let mut command = Command::new("python3");
    command.arg(beside(script));
    command
}
