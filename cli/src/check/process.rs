//! The process of a port. Nothing it does can make this one wait beyond a limit of time or hold more than a limit of
//! memory: its pipes are served by threads, and what they pass on is bounded.

use crate::maps::one_line;
use crate::protocol::{Line, read_line};
use std::collections::VecDeque;
use std::ffi::OsString;
use std::fmt;
use std::io::{self, BufReader, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender, SyncSender};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// Of an answer; that to `start` names all operations.
const LINE_LIMIT: usize = 1 << 16;
/// Lines that wait to be looked at, before the port has to wait.
const UNREAD_LINES: usize = 256;
/// What is kept of the end of its standard error, in bytes, and shown of it, in lines and characters.
const ERRORS_KEPT: usize = 4096;
const ERRORS_SHOWN: (usize, usize) = (5, 500);
/// How much of a wrong line is shown, in characters.
const LINE_SHOWN: usize = 120;
/// How long a process may take to end once its output has.
const GRACE: Duration = Duration::from_secs(1);
const NAP: Duration = Duration::from_millis(2);

/// A port that runs.
#[derive(Debug)]
pub(super) struct Process {
    child: Child,
    /// None once it was told to stop.
    requests: Option<Sender<Vec<u8>>>,
    output: Receiver<Line>,
    errors: Arc<Mutex<VecDeque<u8>>>,
    error_reader: JoinHandle<()>,
    ended: Option<ExitStatus>,
}

/// What went wrong with a port, not with an answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Trouble {
    /// No answer in time.
    TimeOut(Duration),
    /// It ended, as the system says how.
    Ended(String),
    /// Its output ended, but it did not.
    ClosedOutput,
    /// A line without end.
    TooLong(String),
    /// A line that is no answer.
    Malformed(String),
    /// The answer to another request than that which was due.
    WrongNumber {
        /// That of the answer.
        answered: Option<u64>,
        /// That which was due.
        due: u64,
    },
    /// A line that nobody asked for, after it was told to stop.
    Unasked(String),
    /// It ran on after it was told to stop.
    DoesNotStop(Duration),
}

impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TimeOut(limit) => {
                write!(f, "no answer within {} s; does it flush every answer?", limit.as_secs_f64())
            }
            Self::Ended(status) => write!(f, "it ended ({status}) instead of answering"),
            Self::ClosedOutput => f.write_str("it closed its standard output instead of answering"),
            Self::TooLong(line) => {
                write!(f, "a line of more than {LINE_LIMIT} bytes, which begins with {line}")
            }
            Self::Malformed(line) => write!(f, "a line that is no answer: {line}"),
            Self::WrongNumber { answered: Some(answered), due } => {
                write!(f, "the answer to request {answered} where that to {due} was due")
            }
            Self::WrongNumber { answered: None, due } => {
                write!(f, "an answer without number where that to request {due} was due")
            }
            Self::Unasked(line) => write!(f, "a line after it was told to stop: {line}"),
            Self::DoesNotStop(limit) => {
                write!(f, "it ran on for {} s after it was told to stop", limit.as_secs_f64())
            }
        }
    }
}

impl Process {
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
            // Whatever a script starts is killed with it.
            use std::os::unix::process::CommandExt;
            start.process_group(0);
        }
        let mut child = start.spawn()?;
        let (Some(stdin), Some(stdout), Some(stderr)) =
            (child.stdin.take(), child.stdout.take(), child.stderr.take())
        else {
            return Err(io::Error::other("no pipes"));
        };
        let (requests, queue) = mpsc::channel();
        thread::spawn(move || write_requests(stdin, &queue));
        let (lines, output) = mpsc::sync_channel(UNREAD_LINES);
        thread::spawn(move || read_lines(stdout, &lines));
        let errors = Arc::new(Mutex::new(VecDeque::new()));
        let kept = Arc::clone(&errors);
        let error_reader = thread::spawn(move || keep_end(stderr, &kept));
        Ok(Self { child, requests: Some(requests), output, errors, error_reader, ended: None })
    }

    /// Sends a line; where the port does not read, it waits in memory.
    pub(super) fn send(&self, line: &str) {
        if let Some(requests) = &self.requests {
            // A port that has ended is found out when its answer is due.
            let _ = requests.send(format!("{line}\n").into_bytes());
        }
    }

    /// Its next line.
    pub(super) fn receive(&mut self, limit: Duration) -> Result<Vec<u8>, Trouble> {
        match self.output.recv_timeout(limit) {
            Ok(Line::Whole(line)) => Ok(line),
            Ok(Line::TooLong(line)) => Err(Trouble::TooLong(shown(&line))),
            Ok(Line::End) | Err(RecvTimeoutError::Disconnected) => Err(match self.wait(GRACE.min(limit)) {
                Some(status) => Trouble::Ended(status.to_string()),
                None => Trouble::ClosedOutput,
            }),
            Err(RecvTimeoutError::Timeout) => Err(Trouble::TimeOut(limit)),
        }
    }

    /// Tells it to stop and waits until it has.
    pub(super) fn stop(&mut self, farewell: &str, limit: Duration) -> Result<(), Trouble> {
        self.send(farewell);
        self.requests = None;
        let deadline = Instant::now() + limit;
        match self.output.recv_timeout(limit) {
            Ok(Line::Whole(line) | Line::TooLong(line)) => return Err(Trouble::Unasked(shown(&line))),
            Err(RecvTimeoutError::Timeout) => return Err(Trouble::DoesNotStop(limit)),
            Ok(Line::End) | Err(RecvTimeoutError::Disconnected) => {}
        }
        match self.wait(deadline.saturating_duration_since(Instant::now()).max(GRACE.min(limit))) {
            Some(status) if status.success() => Ok(()),
            Some(status) => Err(Trouble::Ended(status.to_string())),
            None => Err(Trouble::DoesNotStop(limit)),
        }
    }

    /// How it ended, if it does so in time.
    fn wait(&mut self, limit: Duration) -> Option<ExitStatus> {
        let deadline = Instant::now() + limit;
        while self.ended.is_none() {
            self.ended = self.child.try_wait().ok().flatten();
            if Instant::now() > deadline {
                break;
            }
            thread::sleep(NAP);
        }
        self.ended
    }

    /// Ends it, with all it started.
    fn kill(&mut self) {
        // One that has ended was waited for; its number may be another's by now.
        if self.ended.is_some() {
            return;
        }
        #[cfg(unix)]
        {
            use rustix::process::{Pid, Signal, kill_process_group};
            if let Some(group) = Pid::from_raw(self.child.id() as i32) {
                let _ = kill_process_group(group, Signal::KILL);
            }
        }
        let _ = self.child.kill();
        self.wait(GRACE);
    }

    /// Ends it; the last lines of its standard error.
    pub(super) fn end(mut self) -> Vec<String> {
        self.kill();
        let deadline = Instant::now() + GRACE / 4;
        while !self.error_reader.is_finished() && Instant::now() < deadline {
            thread::sleep(NAP);
        }
        let bytes: Vec<u8> = lock(&self.errors).iter().copied().collect();
        last_lines(&String::from_utf8_lossy(&bytes))
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.kill();
    }
}

/// The beginning of a line in one line.
pub(super) fn shown(line: &[u8]) -> String {
    let text = String::from_utf8_lossy(&line[..line.len().min(4 * LINE_SHOWN)]);
    let start: String = text.chars().take(LINE_SHOWN).collect();
    let more = if start.len() < line.len() { "..." } else { "" };
    format!("'{}{more}'", one_line(&start))
}

fn last_lines(text: &str) -> Vec<String> {
    let (lines, characters) = ERRORS_SHOWN;
    let filled: Vec<_> = text.lines().map(str::trim_end).filter(|line| !line.is_empty()).collect();
    let last = filled.iter().skip(filled.len().saturating_sub(lines));
    last.map(|line| one_line(&line.chars().take(characters).collect::<String>())).collect()
}

fn lock(errors: &Mutex<VecDeque<u8>>) -> std::sync::MutexGuard<'_, VecDeque<u8>> {
    errors.lock().unwrap_or_else(PoisonError::into_inner)
}

fn write_requests(mut stdin: ChildStdin, queue: &Receiver<Vec<u8>>) {
    for line in queue {
        if stdin.write_all(&line).is_err() {
            return;
        }
    }
}

fn read_lines(stdout: ChildStdout, lines: &SyncSender<Line>) {
    let mut reader = BufReader::new(stdout);
    loop {
        // What cannot be read has ended.
        let line = read_line(&mut reader, LINE_LIMIT).unwrap_or(Line::End);
        let last = !matches!(line, Line::Whole(_));
        if lines.send(line).is_err() || last {
            return;
        }
    }
}

fn keep_end(mut stderr: impl Read, kept: &Mutex<VecDeque<u8>>) {
    let mut buffer = [0; 4096];
    while let Ok(n @ 1..) = stderr.read(&mut buffer) {
        let mut kept = lock(kept);
        kept.extend(&buffer[..n]);
        let surplus = kept.len().saturating_sub(ERRORS_KEPT);
        kept.drain(..surplus);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_end_of_standard_error_is_kept() {
        let lines: Vec<_> = (0..100_000).map(|i| format!("line {i}")).collect();
        let text = lines.join("\n") + "\n\n\u{1b}[31mend\r\n";
        let kept = Mutex::new(VecDeque::new());
        keep_end(text.as_bytes(), &kept);
        let kept: Vec<u8> = lock(&kept).iter().copied().collect();
        assert_eq!(kept.len(), ERRORS_KEPT);
        let lines = last_lines(&String::from_utf8(kept).unwrap());
        assert_eq!(lines, ["line 99996", "line 99997", "line 99998", "line 99999", "\\u{1b}[31mend"]);
    }

    #[test]
    fn a_line_is_shown_in_one_line_and_in_part() {
        assert_eq!(shown(b"a\tb\xff"), "'a\\tb\u{fffd}'");
        assert_eq!(shown(&[b'x'; 1000]), format!("'{}...'", "x".repeat(LINE_SHOWN)));
    }
}
