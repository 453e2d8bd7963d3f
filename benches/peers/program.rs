//! What a method gives; some are of other programs, whose sources are beside this file.

use std::fs;
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

/// From the lines that a peer prints.
pub(crate) fn rows_of(command: &mut Command) -> impl Iterator<Item = Timed<f64>> {
    let row = |line: &str| {
        let mut fields = line.split('\t');
        let method = fields.next()?.to_owned();
        let mut number = || fields.next()?.parse().ok();
        Some(Timed { method, seconds: number()?, result: number()? })
    };
    output_of(command).lines().filter_map(row).collect::<Vec<_>>().into_iter()
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

/// Runs a compiler that writes `program`; nothing, with what it reports, where that fails.
pub(crate) fn compiled(compiler: &mut Command, program: PathBuf) -> Option<PathBuf> {
    let _ = fs::remove_file(&program);
    output_of(compiler);
    program.exists().then_some(program)
}

/// Compiles a program of C++ that uses MRPT as Debian installs it.
pub(crate) fn with_mrpt(source: &str, program: PathBuf) -> Option<PathBuf> {
    let Ok(modules) = fs::read_dir("/usr/include/mrpt") else {
        eprintln!("skipped: no /usr/include/mrpt; Debian's package is libmrpt-maps-dev");
        return None;
    };
    let mut compiler = Command::new("c++");
    compiler.args(["-std=c++17", "-O3", "-DWITH_MRPT"]);
    let includes = modules.flatten().map(|module| module.path().join("include")).filter(|path| path.is_dir());
    for include in includes.chain([PathBuf::from("/usr/include/eigen3")]) {
        compiler.arg("-isystem").arg(include);
    }
    compiler.arg(beside(source)).arg("-o").arg(&program);
    let libraries = ["maps", "obs", "poses", "math", "system", "core"].map(|name| format!("-lmrpt-{name}"));
    compiled(compiler.args(libraries), program)
}
