//! Peers in other languages: processes that ask for values of the integrand, so that all methods see the same ones.
//!
//! `peers/peers.cpp` (GSL and Boost) is compiled here, `peers/quadpack.py` needs SciPy in the interpreter that the
//! variable `PYTHON` names, or in `python3`. The protocol stands in `peers.cpp`.

use crate::{LIMIT, Said};
use std::cell::RefCell;
use std::io::{BufReader, Read, Result, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/peers");

/// A peer that waits for integrals.
pub struct Peer {
    child: Child,
    pipes: RefCell<(ChildStdin, BufReader<ChildStdout>)>,
}

impl Peer {
    /// Starts a peer; none if this machine has not got what it needs.
    fn start(command: &mut Command) -> Option<Self> {
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().ok()?;
        let pipes = RefCell::new((child.stdin.take()?, BufReader::new(child.stdout.take()?)));
        let peer = Self { child, pipes };
        // A first integral tells whether it works.
        peer.integrate(&|_| 1.0, &[0.0, 1.0], 1e-3).is_ok().then_some(peer)
    }

    /// Integrates between points; a value that is no number stands for none.
    pub fn integrate(&self, f: &dyn Fn(f64) -> f64, points: &[f64], tolerance: f64) -> Result<Said> {
        let (input, output) = &mut *self.pipes.borrow_mut();
        let ends: Vec<String> = points.iter().map(|x| format!("{x:e}")).collect();
        writeln!(input, "{tolerance:e} {LIMIT} {} {}", points.len(), ends.join(" "))?;
        input.flush()?;
        loop {
            let (mut kind, mut done, mut bytes) = ([0], [0], [0; 8]);
            output.read_exact(&mut kind)?;
            output.read_exact(&mut bytes)?;
            let number = f64::from_ne_bytes(bytes);
            if kind[0] == b'v' {
                input.write_all(&f(number).to_ne_bytes())?;
                input.flush()?;
                continue;
            }
            output.read_exact(&mut bytes)?;
            output.read_exact(&mut done)?;
            return Ok(Said { value: number, claim: f64::from_ne_bytes(bytes), done: done[0] == 1 });
        }
    }
}

impl Drop for Peer {
    fn drop(&mut self) {
        // It ends with its input; only a peer that hangs has to be told.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Starts the peers of this machine, by name; says which are missing.
pub fn all() -> Vec<(&'static str, Peer)> {
    let program = std::env::temp_dir().join(format!("quadrature-peers-{}", std::process::id()));
    let compiled = Command::new("c++")
        .args(["-O2", "-o"])
        .arg(&program)
        .arg(format!("{FOLDER}/peers.cpp"))
        .args(["-lgsl", "-lgslcblas"])
        .status()
        .is_ok_and(|status| status.success());
    let python = std::env::var("PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let mut quadpack = Command::new(python);
    quadpack.arg(format!("{FOLDER}/quadpack.py"));
    let of_program = |name| compiled.then(|| Peer::start(Command::new(&program).arg(name))).flatten();
    let peers = [
        ("QUADPACK (SciPy)", Peer::start(&mut quadpack)),
        ("GSL", of_program("gsl")),
        ("Boost", of_program("boost")),
    ];
    // Both processes run; the file is not needed any more.
    let _ = std::fs::remove_file(program);
    let found = peers.into_iter().filter_map(|(name, peer)| {
        if peer.is_none() {
            println!("Skipped: {name}, which is not on this machine.");
        }
        Some((name, peer?))
    });
    found.collect()
}
