//! Work without the interpreter's lock, which Ctrl-C ends.

use pyo3::prelude::*;

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
