//! The process of a port. Nothing it does can make this one wait beyond a limit of time or hold more than a limit of
//! memory: its pipes are served by threads, and what they pass on is bounded.

use super::group::Group;
use mean_information_report::one_line;
use mean_information_report::protocol::{Line, read_line};
use std::collections::VecDeque;
use std::ffi::OsString;
use std::fmt;
use std::io::{self, BufReader, Read, Write};
use std::process::{ChildStdin, ChildStdout};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender, SyncSender};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// The longest answer, in bytes; that to `start` names all operations.
const LINE_LIMIT: usize = 1 << 16;
/// Lines that wait to be looked at, before the port has to wait.
const UNREAD_LINES: usize = 256;
/// The bytes kept of the end of its standard error, and the lines and characters shown.
const ERRORS_KEPT: usize = 4096;
const ERRORS_SHOWN: (usize, usize) = (5, 500);
/// The number of characters shown of a wrong line.
const LINE_SHOWN: usize = 120;
/// The time that a process may take to end after its output, and its children to answer in its place.
const GRACE: Duration = Duration::from_secs(1);
/// The interval at which it is looked whether it has ended without its output.
const GLANCE: Duration = Duration::from_millis(20);
const NAP: Duration = Duration::from_millis(2);

/// A port that runs.
#[derive(Debug)]
pub(super) struct Process {
    group: Group,
    /// The queue of requests; none once it was told to stop.
    requests: Option<Sender<Vec<u8>>>,
    output: Receiver<Line>,
    errors: Arc<Mutex<VecDeque<u8>>>,
    error_reader: JoinHandle<()>,
}

/// An error of a port, not of an answer.
#[derive(Clone, Debug, PartialEq)]
pub enum PortError {
    /// No answer in time.
    TimeOut(Duration),
    /// The port ended where an answer was due.
    Ended(End),
    /// The port closed its output, but did not end.
    ClosedOutput,
    /// A line without end.
    TooLong(String),
    /// A line that is no answer.
    Malformed {
        /// The line, or its beginning.
        line: String,
        /// The reason why it is none.
        reason: String,
    },
    /// The answer to another request than that which was due.
    WrongNumber {
        /// The sequence number that was answered.
        answered: u64,
        /// The sequence number that was expected.
        due: u64,
    },
    /// A line that nobody asked for, after it was told to stop.
    Unasked(String),
    /// The port ended after it was told to stop, but not with status 0.
    Stopped(End),
    /// The port ran on after it was told to stop.
    DoesNotStop(Duration),
}

impl PortError {
    /// Returns whether the port printed a line that does not even look like an answer.
    pub(super) fn is_stray_line(&self) -> bool {
        // The line is shown in quotes.
        matches!(self, Self::Malformed { line, .. } if !line.starts_with("'{"))
    }
}

/// The end of a port's process.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct End {
    /// The exit status in the system's words.
    pub status: String,
    /// True if another process held its output and had to be killed.
    pub left_behind: bool,
}

impl End {
    fn left_behind(&self) -> &'static str {
        if self.left_behind {
            "; a process that it started lived on, held its standard output and was killed"
        } else {
            ""
        }
    }
}

impl fmt::Display for PortError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TimeOut(limit) => {
                write!(f, "no answer within {} s; does it flush every answer?", limit.as_secs_f64())
            }
            Self::Ended(end) => {
                write!(f, "it ended ({}) instead of answering{}", end.status, end.left_behind())
            }
            Self::ClosedOutput => f.write_str("it closed its standard output instead of answering"),
            Self::TooLong(line) => {
                write!(f, "a line of more than {LINE_LIMIT} bytes, which begins with {line}")
            }
            Self::Malformed { line, reason } => write!(f, "a line that is no answer, {reason}: {line}"),
            Self::WrongNumber { answered, due } => {
                write!(f, "the answer to request {answered} where that to {due} was due")
            }
            Self::Unasked(line) => write!(f, "a line after it was told to stop: {line}"),
            Self::Stopped(end) if end.left_behind => {
                write!(f, "it ended ({}) after it was told to stop{}", end.status, end.left_behind())
            }
            Self::Stopped(end) => write!(f, "it ended ({}, not 0) after it was told to stop", end.status),
            Self::DoesNotStop(limit) => {
                write!(f, "it ran on for {} s after it was told to stop", limit.as_secs_f64())
            }
        }
    }
}

/// No line in time, and no end of the output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Silent {
    /// The process runs on.
    Running,
    /// The process has ended; another one holds its output.
    Ended,
}

impl Process {
    /// Starts the port.
    ///
    /// # Errors
    /// A command that the system cannot start.
    pub(super) fn start(command: &[OsString]) -> io::Result<Self> {
        let mut group = Group::start(command)?;
        let child = &mut group.child;
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
        Ok(Self { group, requests: Some(requests), output, errors, error_reader })
    }

    /// Sends a line; where the port does not read, it waits in memory.
    pub(super) fn send(&self, line: &str) {
        if let Some(requests) = &self.requests {
            // A port that has ended is found out when its answer is due.
            let _ = requests.send(format!("{line}\n").into_bytes());
        }
    }

    /// Returns the port's next line.
    pub(super) fn receive(&mut self, limit: Duration) -> Result<Vec<u8>, PortError> {
        match self.next_line(limit) {
            Ok(Line::Whole(line)) => Ok(line),
            Ok(Line::TooLong(line)) => Err(PortError::TooLong(shown(&line))),
            Ok(Line::End) => {
                Err(self.ended(GRACE.min(limit), false).map_or(PortError::ClosedOutput, PortError::Ended))
            }
            Err(Silent::Running) => Err(PortError::TimeOut(limit)),
            Err(Silent::Ended) => {
                Err(self.ended(GRACE, true).map_or(PortError::TimeOut(limit), PortError::Ended))
            }
        }
    }

    /// Tells it to stop and waits until it has.
    pub(super) fn stop(&mut self, farewell: &str, limit: Duration) -> Result<(), PortError> {
        self.send(farewell);
        self.requests = None;
        let deadline = Instant::now() + limit;
        let left_behind = match self.next_line(limit) {
            Ok(Line::Whole(line) | Line::TooLong(line)) => return Err(PortError::Unasked(shown(&line))),
            Ok(Line::End) => false,
            Err(Silent::Running) => return Err(PortError::DoesNotStop(limit)),
            Err(Silent::Ended) => true,
        };
        let rest = deadline.saturating_duration_since(Instant::now()).max(GRACE.min(limit));
        let end = self.ended(rest, left_behind).ok_or(PortError::DoesNotStop(limit))?;
        if self.group.succeeded() && !left_behind { Ok(()) } else { Err(PortError::Stopped(end)) }
    }

    /// Returns the next line, or the end of the output. Once the process has ended, its children have but a moment left.
    fn next_line(&mut self, limit: Duration) -> Result<Line, Silent> {
        let mut deadline = Instant::now() + limit;
        let mut silent = Silent::Running;
        loop {
            let rest = deadline.saturating_duration_since(Instant::now());
            match self.output.recv_timeout(GLANCE.min(rest)) {
                Ok(line) => return Ok(line),
                Err(RecvTimeoutError::Disconnected) => return Ok(Line::End),
                Err(RecvTimeoutError::Timeout) => {}
            }
            if silent == Silent::Running && self.group.has_ended() {
                silent = Silent::Ended;
                deadline = Instant::now() + GRACE.min(limit);
            } else if Instant::now() >= deadline {
                return Err(silent);
            }
        }
    }

    /// Returns how it has ended, if it does so in time.
    fn ended(&mut self, limit: Duration, left_behind: bool) -> Option<End> {
        self.group.wait(limit).map(|status| End { status: status.to_string(), left_behind })
    }

    /// Ends the port and returns the last lines of its standard error.
    pub(super) fn end(mut self) -> Vec<String> {
        self.group.kill();
        let deadline = Instant::now() + GRACE / 4;
        while !self.error_reader.is_finished() && Instant::now() < deadline {
            thread::sleep(NAP);
        }
        let bytes: Vec<u8> = lock(&self.errors).iter().copied().collect();
        last_lines(&String::from_utf8_lossy(&bytes))
    }
}

/// Returns the beginning of a line, with its control characters escaped.
pub(super) fn shown(line: &[u8]) -> String {
    let text = String::from_utf8_lossy(&line[..line.len().min(4 * LINE_SHOWN)]);
    let start: String = text.chars().take(LINE_SHOWN).collect();
    let more = if start.len() < line.len() { "..." } else { "" };
    format!("'{}{more}'", one_line(&start))
}

/// Returns the last lines, the first of them the one that says why, if that stands further up: as Node.js has it, above
/// the calls that led there.
fn last_lines(text: &str) -> Vec<String> {
    let (lines, characters) = ERRORS_SHOWN;
    let filled: Vec<_> = text.lines().map(str::trim_end).filter(|line| !line.is_empty()).collect();
    let mut first = filled.len().saturating_sub(lines);
    let above = filled[..first].iter().rfind(|line| says_why(line));
    let above = above.filter(|_| !filled[first..].iter().any(|line| says_why(line)));
    first += usize::from(above.is_some());
    let last = above.into_iter().chain(&filled[first..]);
    last.map(|line| one_line(&line.chars().take(characters).collect::<String>())).collect()
}

/// Returns whether a line names an error: `Error: Cannot find module`, `ValueError: ...`, `error: ...`.
fn says_why(line: &str) -> bool {
    !line.starts_with(char::is_whitespace) && ["Error: ", "error: "].iter().any(|word| line.contains(word))
}

/// Returns the line of standard error that says why a port ended: the last that names an error, or else the last.
pub(super) fn reason(lines: &[String]) -> Option<&String> {
    lines.iter().rfind(|line| says_why(line)).or_else(|| lines.last())
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

    /// By Node.js 20, of a file that is not there.
    #[test]
    fn the_line_that_says_why_is_found_above_the_calls() {
        let calls = "    at Module._load (node:internal/modules/cjs/loader:1038:27)\n".repeat(6);
        let node = format!(
            "node:internal:1210\n  throw err;\n  ^\n\nError: Cannot find module 'a.mjs'\n{calls}  code: 'X',\n}}\n\nNode.js v20\n"
        );
        let lines = last_lines(&node);
        assert_eq!(
            (lines.len(), lines[0].as_str(), lines[4].as_str()),
            (5, "Error: Cannot find module 'a.mjs'", "Node.js v20")
        );
        assert_eq!(reason(&lines), Some(&lines[0]));
        let python = last_lines("Traceback:\n  raise ValueError: no\nValueError: no\n");
        assert_eq!(reason(&python).map(String::as_str), Some("ValueError: no"));
        let plain = last_lines("one\ntwo");
        assert_eq!(reason(&plain).map(String::as_str), Some("two"));
    }

    #[test]
    fn a_line_is_shown_in_one_line_and_in_part() {
        assert_eq!(shown(b"a\tb\xff"), "'a\\tb\u{fffd}'");
        assert_eq!(shown(&[b'x'; 1000]), format!("'{}...'", "x".repeat(LINE_SHOWN)));
    }
}
