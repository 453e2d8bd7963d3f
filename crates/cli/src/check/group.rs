//! A process with all that it starts: it is ended as a whole, whether its first process still runs or has ended by
//! itself.
//!
//! The crate `process-wrap` (10.0.1) does nearly this, and on Windows more: its job objects end all processes there. It
//! is not used because on Unix its `try_wait` waits for the first process and so frees the number of its group, which is
//! then killed by that number up to a second later. Here the number stays taken until all of the group was ended.

use std::ffi::OsString;
use std::io;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// The time that a process may take to end once it has been killed.
const GRACE: Duration = Duration::from_secs(1);
const NAP: Duration = Duration::from_millis(2);

/// A process and those it starts, as far as they stay in its group; elsewhere than on Unix, only itself.
#[derive(Debug)]
pub(super) struct Group {
    /// The first process; its three pipes are there to be taken.
    pub(super) child: Child,
    /// The exit status, once the process was waited for: from then on its number may be another's.
    status: Option<ExitStatus>,
}

impl Group {
    /// Starts it.
    ///
    /// # Errors
    /// A command that the system cannot start.
    pub(super) fn start(command: &[OsString]) -> io::Result<Self> {
        let mut parts = command.iter();
        let mut start = Command::new(parts.next().map(OsString::as_os_str).unwrap_or_default());
        start.args(parts).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        #[cfg(unix)]
        {
            use std::os::unix::process::CommandExt;
            start.process_group(0);
        }
        Ok(Self { child: start.spawn()?, status: None })
    }

    /// Returns whether it has ended by itself, without waiting for it, so that its number stays that of its group.
    #[cfg(unix)]
    pub(super) fn has_ended(&mut self) -> bool {
        use rustix::process::{WaitId, WaitIdOptions, waitid};
        let options = WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT;
        self.status.is_some()
            || self.number().is_none_or(|n| !matches!(waitid(WaitId::Pid(n), options), Ok(None)))
    }

    /// Returns whether it has ended by itself.
    #[cfg(not(unix))]
    pub(super) fn has_ended(&mut self) -> bool {
        self.status = self.status.or_else(|| self.child.try_wait().ok().flatten());
        self.status.is_some()
    }

    /// Returns how it has ended, if it does so by itself in time; then ends the rest of its group.
    pub(super) fn wait(&mut self, limit: Duration) -> Option<ExitStatus> {
        let deadline = Instant::now() + limit;
        while !self.has_ended() {
            if Instant::now() >= deadline {
                return None;
            }
            thread::sleep(NAP);
        }
        self.kill();
        self.status
    }

    /// Returns whether it has ended with status 0.
    pub(super) fn succeeded(&self) -> bool {
        self.status.is_some_and(|status| status.success())
    }

    /// Ends all of it.
    pub(super) fn kill(&mut self) {
        if self.status.is_some() {
            return;
        }
        #[cfg(unix)]
        if let Some(number) = self.number() {
            let _ = rustix::process::kill_process_group(number, rustix::process::Signal::KILL);
        }
        let _ = self.child.kill();
        let deadline = Instant::now() + GRACE;
        while self.status.is_none() && Instant::now() < deadline {
            self.status = self.child.try_wait().ok().flatten();
            thread::sleep(NAP);
        }
    }

    #[cfg(unix)]
    fn number(&self) -> Option<rustix::process::Pid> {
        rustix::process::Pid::from_raw(self.child.id() as i32)
    }
}

impl Drop for Group {
    fn drop(&mut self) {
        self.kill();
    }
}
