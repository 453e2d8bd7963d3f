//! The conversation with a port: requests are sent ahead, troubles are laid to the request that caused them, and the
//! port is started again.

use super::process::{PortError, Process, reason, shown};
use super::values::{MAX_ABSOLUTE, MAX_TOLERANCE};
use super::vectors::Test;
use crate::failure::Failure;
use mean_information_report::one_line;
use mean_information_report::protocol::{Answer, Claim, Reply, Request, Run, VERSION, Welcome};
use serde::Deserialize;
use serde_json::Value as Json;
use serde_json::error::Category;
use std::ffi::OsString;
use std::time::Duration;

/// Requests that are sent before the first of them is answered.
const AHEAD: usize = 32;
/// The number of troubles after which the rest of an operation is not run.
pub(super) const TROUBLES_PER_OPERATION: usize = 20;
/// The number of lines that are no answers, such as those of debugging, after which nothing is run any more.
const STRAY_LINES: usize = 3;
/// The number of answers not in time after which nothing is run any more.
pub(super) const TIME_OUTS: usize = 5;

/// The outcome of a request.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Outcome {
    Answered(Reply),
    /// The port failed at it.
    Failed(PortFailure),
    /// The request was not sent any more.
    NotRun,
}

/// PortError, and what the port said on its standard error.
#[derive(Clone, Debug, PartialEq)]
pub struct PortFailure {
    /// The error.
    pub error: PortError,
    /// The last lines.
    pub stderr: Vec<String>,
}

/// A port, and how it has fared.
#[derive(Debug)]
pub(super) struct Conversation<'a> {
    command: &'a [OsString],
    limit: Duration,
    process: Option<Process>,
    ahead: usize,
    /// The number of the next request.
    numbered: u64,
    time_outs: usize,
    stray_lines: usize,
    restarts: usize,
    /// Troubles that belong to no single request.
    port_failures: Vec<(String, PortFailure)>,
    given_up: Option<String>,
}

/// The end of a conversation.
#[derive(Debug)]
pub(super) struct Ending {
    pub(super) restarts: usize,
    /// The errors that belong to no single request, each with its place.
    pub(super) port_failures: Vec<(String, PortFailure)>,
    /// The reason why the rest was not run.
    pub(super) given_up: Option<String>,
}

impl<'a> Conversation<'a> {
    /// Starts a port and asks what it can do.
    ///
    /// # Errors
    /// A port that cannot be started, refuses the protocol or does not understand it.
    pub(super) fn open(command: &'a [OsString], limit: Duration) -> Result<(Self, Welcome), Failure> {
        let (process, welcome) = greet(command, limit)
            .map_err(|message| Failure::Port { command: command_line(command), message })?;
        let conversation = Self {
            command,
            limit,
            process: Some(process),
            ahead: AHEAD,
            numbered: 1,
            time_outs: 0,
            stray_lines: 0,
            restarts: 0,
            port_failures: Vec::new(),
            given_up: None,
        };
        Ok((conversation, welcome))
    }

    /// Runs the tests of one operation; as many outcomes, in their order. `done` is called for each.
    pub(super) fn run(&mut self, op: &str, tests: &[&Test], done: impl Fn()) -> Vec<Outcome> {
        let first = self.numbered;
        self.numbered += tests.len() as u64;
        let number = |index: usize| first + index as u64;
        let mut outcomes = Vec::with_capacity(tests.len());
        let mut troubles = 0;
        let mut sent = 0;
        // The end of a port that had several requests, up to this one: they are asked again, one at a time.
        let mut suspected: Option<(PortFailure, usize)> = None;
        while outcomes.len() < tests.len() && troubles < TROUBLES_PER_OPERATION {
            let Some(process) = &mut self.process else { break };
            let next = outcomes.len();
            while sent < tests.len() && sent - next < self.ahead {
                process.send(&request(op, tests[sent], number(sent)).line());
                sent += 1;
            }
            let answer = process.receive(self.limit).and_then(|line| read_answer(&line, number(next)));
            match answer {
                Ok(reply) => {
                    outcomes.push(Outcome::Answered(reply));
                    done();
                    if let Some((failure, _)) = suspected.take_if(|(_, end)| *end == outcomes.len()) {
                        let place = format!("{op}, requests sent ahead up to {}", tests[next].id);
                        self.port_failures.push((place, failure));
                    }
                }
                Err(error) => {
                    let alone = sent - next == 1;
                    let failure = self.restart(error);
                    if alone || !matches!(failure.error, PortError::Ended(_) | PortError::ClosedOutput) {
                        suspected = None;
                        outcomes.push(Outcome::Failed(failure));
                        troubles += 1;
                        done();
                    } else {
                        suspected = Some((failure, sent));
                    }
                    self.ahead = 1;
                    sent = outcomes.len();
                }
            }
        }
        if let Some((failure, _)) = suspected {
            self.port_failures.push((op.to_owned(), failure));
        }
        (outcomes.len()..tests.len()).for_each(|_| done());
        outcomes.resize(tests.len(), Outcome::NotRun);
        outcomes
    }

    /// Ends the port and starts it again.
    fn restart(&mut self, error: PortError) -> PortFailure {
        self.time_outs += usize::from(matches!(error, PortError::TimeOut(_)));
        self.stray_lines += usize::from(error.is_stray_line());
        let stderr = self.process.take().map(Process::end).unwrap_or_default();
        if self.time_outs >= TIME_OUTS {
            self.given_up = Some(format!("{TIME_OUTS} answers did not come in time"));
        } else if self.stray_lines >= STRAY_LINES {
            self.given_up = Some(format!(
                "{STRAY_LINES} lines that are no answers; what a port prints beside its answers belongs on standard error"
            ));
        } else {
            self.restarts += 1;
            match greet(self.command, self.limit) {
                Ok((process, _)) => self.process = Some(process),
                Err(message) => self.given_up = Some(format!("started again, {message}")),
            }
        }
        PortFailure { error, stderr }
    }

    /// Tells the port to stop.
    pub(super) fn close(mut self) -> Ending {
        if let Some(mut process) = self.process.take()
            && let Err(error) = process.stop(&Request::Stop.line(), self.limit)
        {
            let stderr = process.end();
            self.port_failures.push(("at the end".to_owned(), PortFailure { error, stderr }));
        }
        Ending { restarts: self.restarts, port_failures: self.port_failures, given_up: self.given_up }
    }
}

/// Returns the command as it was given.
pub(super) fn command_line(command: &[OsString]) -> String {
    let words: Vec<_> = command.iter().map(|word| word.to_string_lossy()).collect();
    words.join(" ")
}

/// Returns the request of a test.
pub(super) fn request(op: &str, test: &Test, seq: u64) -> Request {
    let Test { format, args, .. } = test;
    Request::Run(Run { seq, op: op.to_owned(), format: format.to_string(), args: args.clone() })
}

/// Starts a port and reads what it says of itself; or what is wrong.
fn greet(command: &[OsString], limit: Duration) -> Result<(Process, Welcome), String> {
    let mut process = Process::start(command).map_err(|error| format!("cannot be started: {error}"))?;
    process.send(&Request::Start { protocol: VERSION }.line());
    match process.receive(limit).map_err(|error| error.to_string()).and_then(|line| read_welcome(&line)) {
        Ok(welcome) => Ok((process, welcome)),
        Err(message) => Err(match reason(&process.end()) {
            Some(error) => format!("{message}; its standard error says: {error}"),
            None => message,
        }),
    }
}

/// Reads the answer to `start`, if this program can go on with it.
fn read_welcome(line: &[u8]) -> Result<Welcome, String> {
    let message: Json = serde_json::from_slice(line)
        .map_err(|error| format!("its answer to start is not JSON ({error}): {}", shown(line)))?;
    if let Some(error) = message.get("error") {
        return Err(format!("it refuses protocol {VERSION}: {}", one_line(&error.to_string())));
    }
    match message.get("protocol") {
        Some(version) if *version == VERSION => {}
        Some(other) => return Err(format!("it speaks protocol {other}, not {VERSION}")),
        None => return Err(format!("its answer to start has no \"protocol\": {}", shown(line))),
    }
    let welcome = Welcome::deserialize(&message)
        .map_err(|error| format!("its answer to start cannot be read ({error}): {}", shown(line)))?;
    if welcome.ops.is_empty() {
        return Err("it has no operations: \"ops\" is empty".to_owned());
    }
    for (pattern, Claim { ulp, bits }) in &welcome.claims {
        for (claim, unit, most) in [(*ulp, "ulp", MAX_TOLERANCE), (*bits, "bits", MAX_ABSOLUTE)] {
            if !(0.0..=most).contains(&claim) {
                return Err(format!("it claims {claim} {unit} for {pattern}; a claim is 0 to {most} {unit}"));
            }
        }
    }
    Ok(welcome)
}

/// Reads the answer that is due.
fn read_answer(line: &[u8], due: u64) -> Result<Reply, PortError> {
    let malformed = |reason: String| PortError::Malformed { line: shown(line), reason };
    let json = |error: serde_json::Error| match error.classify() {
        Category::Eof => "which is cut off".to_owned(),
        _ => format!("which is not JSON ({})", error.to_string().replace("at line 1 column", "at column")),
    };
    let message: Json = serde_json::from_slice(line).map_err(|error| malformed(json(error)))?;
    if !message.is_object() {
        return Err(malformed("which is JSON, but not an object".to_owned()));
    }
    match &message["seq"] {
        Json::Null => return Err(malformed(format!("which has no \"seq\", here {due}"))),
        seq if *seq == due => {}
        seq => match seq.as_u64() {
            Some(answered) => return Err(PortError::WrongNumber { answered, due }),
            None => return Err(malformed(format!("whose \"seq\" is {seq}, not the integer {due}"))),
        },
    }
    Answer::deserialize(message)
        .map_err(|error| malformed(format!("of which a part is of the wrong type ({error})")))?
        .reply()
        .map_err(|parts| {
            malformed(format!("which has {parts} of \"result\", \"error\" and \"skipped\", not one"))
        })
}
