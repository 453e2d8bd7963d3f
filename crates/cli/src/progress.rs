//! A bar on stderr while a command works for more than a second, if stderr is a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use mean_information_report::one_line;
use std::io::{self, IsTerminal};
use std::thread;
use std::time::Duration;

/// Work below this shows no bar.
const DELAY: Duration = Duration::from_secs(1);
const TICK: Duration = Duration::from_millis(100);
const STYLE: &str = "{spinner} [{elapsed}] {pos} of {len}: {wide_msg}";

/// A bar that shows how far a command is. It goes when this is dropped.
pub(crate) struct Progress(ProgressBar);

impl Progress {
    /// Begins work of `steps` steps.
    pub(crate) fn new(steps: usize) -> Self {
        let bar = ProgressBar::with_draw_target(Some(steps as u64), ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template(STYLE) {
            bar.set_style(style);
        }
        if io::stderr().is_terminal() {
            let waiting = bar.downgrade();
            thread::spawn(move || {
                thread::sleep(DELAY);
                if let Some(bar) = waiting.upgrade().filter(|bar| !bar.is_finished()) {
                    bar.set_draw_target(ProgressDrawTarget::stderr());
                    bar.enable_steady_tick(TICK);
                }
            });
        }
        Self(bar)
    }

    /// Begins the next step, named `what`.
    pub(crate) fn begin(&self, what: &str) {
        self.0.set_message(one_line(what));
    }

    /// Ends the step.
    pub(crate) fn done(&self) {
        self.0.inc(1);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
