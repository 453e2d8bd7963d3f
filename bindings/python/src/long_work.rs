//! Work without the interpreter's lock, which Ctrl-C ends.

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

/// The time between two looks at signals by who waits for a thread.
const WAIT: Duration = Duration::from_millis(50);

/// Does work that looks at no signals in a thread of its own, and looks at them meanwhile. What a handler raises ends the wait;
/// the work ends by itself, and its result is dropped.
///
/// # Errors
/// `KeyboardInterrupt`, or what another handler of signals raised; `RuntimeError` for a fault of the work.
pub(crate) fn watched<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> T + Send + 'static,
) -> PyResult<T> {
    let (done, mut result) = channel();
    // Nobody waits for the result after a signal.
    thread::spawn(move || done.send(work()).unwrap_or_default());
    loop {
        let waiting = &mut result;
        match py.detach(move || waiting.recv_timeout(WAIT)) {
            Ok(result) => return Ok(result),
            Err(RecvTimeoutError::Timeout) => py.check_signals()?,
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err("a fault of mean_information; please report it"));
            }
        }
    }
}

/// The steps between two looks at signals.
const STEPS: u64 = 1 << 24;

/// A count of the steps of long work, which looks at signals now and then.
#[derive(Default)]
pub(crate) struct Steps(u64);

impl Steps {
    /// Counts steps, of a nanosecond or so each.
    ///
    /// # Errors
    /// `KeyboardInterrupt`, or what another handler of signals raised.
    pub(crate) fn add(&mut self, steps: u64) -> PyResult<()> {
        self.0 += steps;
        if self.0 < STEPS {
            return Ok(());
        }
        self.0 = 0;
        Python::attach(|py| py.check_signals())
    }
}
