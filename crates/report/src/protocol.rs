//! The messages of the port protocol, version 1: lines of JSON, an answer for each request, in the order of the requests.
//!
//! | request | answer |
//! |---|---|
//! | `{"cmd":"start","protocol":1}` | [`Welcome`] |
//! | `{"cmd":"run","seq":1,"op":"cell.entropy","format":"f64","args":{"p":"0x1p-2"}}` | [`Answer`] |
//! | `{"cmd":"stop"}` | none: the port ends |
//!
//! Floats are [hexadecimal floats](crate::hex_float) in strings, counts are JSON integers.

use crate::hex_float;
use mean_information::Real;
use mean_information::operations::{self, Operation, Shape};
use serde::{Deserialize, Serialize};
use serde_json::Value as Json;
use std::collections::BTreeMap;
use std::io::{self, BufRead, Read};

/// The version.
pub const VERSION: u64 = 1;

/// A request to a port.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "cmd", rename_all = "lowercase")]
pub enum Request {
    /// The version of the protocol; the port answers with what it can do.
    Start {
        /// [`VERSION`].
        protocol: u64,
    },
    /// An operation to compute.
    Run(Run),
    /// The end of the conversation.
    Stop,
}

impl Request {
    /// Returns the request in a line.
    pub fn line(&self) -> String {
        to_line(self)
    }
}

/// An operation to be computed, with its arguments.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// The number that the answer repeats.
    pub seq: u64,
    /// The operation.
    pub op: String,
    /// `f32` or `f64`.
    pub format: String,
    /// The arguments by name.
    pub args: Arguments,
}

/// Arguments by name.
pub type Arguments = BTreeMap<String, Argument>;

/// An argument, of hexadecimal floats.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(
    untagged,
    expecting = "an argument is a hexadecimal float in a string, a list of them, or a list of lists"
)]
pub enum Argument {
    /// A float.
    Float(String),
    /// Floats.
    List(Vec<String>),
    /// Lists of floats; none of them reads as an empty list.
    Rows(Vec<Vec<String>>),
}

impl Argument {
    fn shape(&self) -> Shape {
        match self {
            Self::Float(_) => Shape::Float,
            Self::List(_) => Shape::List,
            Self::Rows(_) => Shape::Rows,
        }
    }
}

/// Parses the values of an operation's arguments, in its order.
///
/// # Errors
/// One that is missing, that the operation does not have, of another shape, or that is no float of the format: in words.
pub fn values<T: Real>(
    operation: &Operation,
    arguments: &Arguments,
) -> Result<Vec<operations::Value<T>>, String> {
    let known = |name: &String| operation.arguments.iter().any(|argument| argument.name == name);
    if let Some(other) = arguments.keys().find(|name| !known(name)) {
        return Err(format!("{} has no argument {other}", operation.name));
    }
    let value = |expected: &operations::Argument| {
        let name = expected.name;
        let argument = arguments.get(name).ok_or_else(|| format!("the argument {name} is missing"))?;
        let float = |text: &String| {
            let refused = || format!("{name}: \"{text}\" is no hexadecimal float of {}", T::FORMAT);
            hex_float::parse::<T>(text).map_err(|_| refused())
        };
        let list = |texts: &Vec<String>| texts.iter().map(float).collect::<Result<Vec<T>, String>>();
        Ok(match (expected.shape, argument) {
            (Shape::Float, Argument::Float(text)) => operations::Value::Float(float(text)?),
            (Shape::List, Argument::List(texts)) => operations::Value::List(list(texts)?),
            (Shape::Rows, Argument::Rows(rows)) => {
                operations::Value::Rows(rows.iter().map(list).collect::<Result<_, _>>()?)
            }
            (Shape::Rows, Argument::List(none)) if none.is_empty() => operations::Value::Rows(Vec::new()),
            (shape, other) => {
                return Err(format!(
                    "{name} must be of the shape {}, not {}",
                    shape.name(),
                    other.shape().name()
                ));
            }
        })
    };
    operation.arguments.iter().map(value).collect()
}

/// The answer to [`Request::Start`]: what a port says of itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Welcome {
    /// The version it speaks.
    pub protocol: u64,
    /// The port's name.
    #[serde(default)]
    pub name: String,
    /// The language it is written in.
    #[serde(default)]
    pub language: String,
    /// The port's own version.
    #[serde(default)]
    pub version: String,
    /// The formats it computes in.
    pub formats: Vec<String>,
    /// The operations it has.
    pub ops: Vec<String>,
    /// The errors that it claims where they are more than the contract allows, by operation or by a pattern with `*`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub claims: BTreeMap<String, Claim>,
}

/// An error that a port claims: in ulp, absolute, or both, of which an answer is to keep either.
///
/// A number alone is in ulp: `4` is `{"ulp":4}`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(from = "WrittenClaim", into = "WrittenClaim")]
pub struct Claim {
    /// The error in spacings of floats at the answer; 0 claims nothing.
    pub ulp: f64,
    /// The absolute error: in bits, of an occupancy in units of `p`; 0 claims nothing.
    pub bits: f64,
}

impl Claim {
    /// Returns the claim that allows what either of two allows.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self { ulp: self.ulp.max(other.ulp), bits: self.bits.max(other.bits) }
    }

    /// Returns what the claim allows above a tolerance in ulp.
    #[must_use]
    pub fn above(self, tolerance: f64) -> Self {
        Self { ulp: if self.ulp > tolerance { self.ulp } else { 0.0 }, ..self }
    }
}

/// A claim as it is written.
#[derive(Serialize, Deserialize)]
#[serde(untagged, expecting = "a claim is a number of ulp, or an object with \"ulp\", \"bits\" or both")]
enum WrittenClaim {
    Ulp(f64),
    Parts(ClaimParts),
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ClaimParts {
    #[serde(default)]
    ulp: f64,
    #[serde(default)]
    bits: f64,
}

impl From<WrittenClaim> for Claim {
    fn from(written: WrittenClaim) -> Self {
        match written {
            WrittenClaim::Ulp(ulp) => Self { ulp, bits: 0.0 },
            WrittenClaim::Parts(ClaimParts { ulp, bits }) => Self { ulp, bits },
        }
    }
}

impl From<Claim> for WrittenClaim {
    fn from(Claim { ulp, bits }: Claim) -> Self {
        if bits == 0.0 { Self::Ulp(ulp) } else { Self::Parts(ClaimParts { ulp, bits }) }
    }
}

impl Welcome {
    /// Returns the message in a line.
    pub fn line(&self) -> String {
        to_line(self)
    }
}

/// The answer to [`Request::Run`]: one of result, error and skipped.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// The number of the request; none if the request was not understood that far.
    pub seq: Option<u64>,
    /// A hexadecimal float in a string, or an integer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub result: Option<Json>,
    /// The reason why there is none, in a word of [`errors`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// The reason why it was not computed, in words.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub skipped: Option<String>,
}

impl Answer {
    /// Creates an answer from a result, an error or a reason why it was skipped.
    pub fn new(seq: impl Into<Option<u64>>, reply: Reply) -> Self {
        let mut answer = Self { seq: seq.into(), result: None, error: None, skipped: None };
        match reply {
            Reply::Result(value) => answer.result = Some(value),
            Reply::Error(word) => answer.error = Some(word),
            Reply::Skipped(reason) => answer.skipped = Some(reason),
        }
        answer
    }

    /// Returns the one of the three that is there.
    ///
    /// # Errors
    /// How many there are, if not one.
    pub fn reply(self) -> Result<Reply, usize> {
        let parts =
            [self.result.map(Reply::Result), self.error.map(Reply::Error), self.skipped.map(Reply::Skipped)];
        let mut parts: Vec<_> = parts.into_iter().flatten().collect();
        if parts.len() > 1 { Err(parts.len()) } else { parts.pop().ok_or(0) }
    }

    /// Returns the message in a line.
    pub fn line(&self) -> String {
        to_line(self)
    }
}

/// The content of an answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Reply {
    /// A float as a string, or a count.
    Result(Json),
    /// A word of [`errors`].
    Error(String),
    /// A reason.
    Skipped(String),
}

impl Reply {
    /// Creates an error by its word.
    pub fn error(word: &str) -> Self {
        Self::Error(word.to_owned())
    }
}

/// The words that stand for errors.
pub mod errors {
    /// An argument lies outside the domain of the operation.
    pub const DOMAIN: &str = "domain";
    /// No such operation.
    pub const OPERATION: &str = "unknown-operation";
    /// Neither `f32` nor `f64`.
    pub const FORMAT: &str = "unknown-format";
    /// Arguments that the operation does not take: one is missing, too many, of another shape, or no float of the format.
    pub const ARGUMENTS: &str = "arguments";
    /// A line that is no request.
    pub const MALFORMED: &str = "malformed";
    /// Another version of the protocol is asked for.
    pub const PROTOCOL: &str = "protocol";
}

/// Returns JSON without the end of the line.
fn to_line(message: &impl Serialize) -> String {
    // Strings, numbers and lists under string keys: serialisation cannot fail.
    serde_json::to_string(message).unwrap_or_default()
}

/// A line that was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Line {
    /// Without its end; the last one may have had none.
    Whole(Vec<u8>),
    /// The first bytes of one that is longer than allowed; the rest is not read yet.
    TooLong(Vec<u8>),
    /// There are no more.
    End,
}

/// Reads the next line, of at most `limit` bytes, which is all that is ever held of it.
///
/// # Errors
/// Those of the reader.
pub fn read_line(reader: &mut impl BufRead, limit: usize) -> io::Result<Line> {
    let mut line = Vec::new();
    reader.by_ref().take(limit as u64 + 1).read_until(b'\n', &mut line)?;
    if line.is_empty() {
        return Ok(Line::End);
    }
    let ended = line.pop_if(|last| *last == b'\n').is_some();
    if !ended && line.len() > limit {
        return Ok(Line::TooLong(line));
    }
    line.pop_if(|last| *last == b'\r');
    Ok(Line::Whole(line))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_are_those_of_the_contract() {
        for line in [
            r#"{"cmd":"start","protocol":1}"#,
            r#"{"cmd":"run","seq":1,"op":"cell.information","format":"f64","args":{"p":"0x1.8p-2"}}"#,
            r#"{"cmd":"run","seq":2,"op":"a","format":"f32","args":{"cells":["0x0p+0"],"rows":[["nan"],[]]}}"#,
            r#"{"cmd":"stop"}"#,
        ] {
            let request: Request = serde_json::from_str(line).unwrap();
            assert_eq!(request.line(), line);
        }
        for line in [
            r#"{"seq":1,"result":"0x1p-1"}"#,
            r#"{"seq":1,"result":3}"#,
            r#"{"seq":1,"error":"domain"}"#,
            r#"{"seq":1,"skipped":"too large"}"#,
            r#"{"seq":null,"error":"malformed"}"#,
        ] {
            let answer: Answer = serde_json::from_str(line).unwrap();
            assert_eq!(answer.line(), line);
            assert_eq!(Answer::new(answer.seq, answer.clone().reply().unwrap()), answer);
        }
        for line in [r#"{"seq":1}"#, r#"{"seq":1,"result":null}"#, r#"{"seq":1,"result":3,"error":"domain"}"#]
        {
            assert!(serde_json::from_str::<Answer>(line).unwrap().reply().is_err(), "{line}");
        }
    }

    #[test]
    fn a_welcome_may_claim_and_may_leave_out_its_names() {
        let claims = r#"{"a":4,"b":1e1,"c":{"bits":2e-16},"d":{"ulp":3,"bits":1e-9}}"#;
        let line = |claims: &str| {
            format!(r#"{{"protocol":1,"formats":["f64"],"ops":["cell.entropy"],"claims":{claims}}}"#)
        };
        let welcome: Welcome = serde_json::from_str(&line(claims)).unwrap();
        let claim = |ulp, bits| Claim { ulp, bits };
        let claimed: Vec<_> = welcome.claims.values().copied().collect();
        assert_eq!(claimed, [claim(4.0, 0.0), claim(10.0, 0.0), claim(0.0, 2e-16), claim(3.0, 1e-9)]);
        assert_eq!(claimed[1].or(claimed[3]), claim(10.0, 1e-9));
        assert_eq!(welcome.name, "");
        assert_eq!(serde_json::from_str::<Welcome>(&welcome.line()).unwrap(), welcome);
        for wrong in [r#"{"a":"4"}"#, r#"{"a":{"nats":1}}"#] {
            let error = serde_json::from_str::<Welcome>(&line(wrong)).unwrap_err().to_string();
            assert!(error.contains("a claim is a number of ulp"), "{error}");
        }
        assert!(serde_json::from_str::<Welcome>(r#"{"protocol":1,"formats":["f64"]}"#).is_err());
    }

    #[test]
    fn lines_are_read_up_to_the_limit() {
        let text = "one\r\n\nthree\nlonger\nend";
        let lines = |limit| {
            let mut reader = io::BufReader::with_capacity(2, text.as_bytes());
            let mut lines = Vec::new();
            loop {
                match read_line(&mut reader, limit).unwrap() {
                    Line::End => return lines,
                    line => lines.push(line),
                }
            }
        };
        let whole = |text: &str| Line::Whole(text.as_bytes().to_vec());
        assert_eq!(lines(6), ["one", "", "three", "longer", "end"].map(whole));
        let long = Line::TooLong(b"longer".to_vec());
        assert_eq!(lines(5), [whole("one"), whole(""), whole("three"), long, whole(""), whole("end")]);
    }
}
