//! The library as a port: it answers the requests of the [protocol](crate::protocol), whatever they are.

use crate::hex_float;
use crate::protocol::{Answer, Line, Reply, Request, Run, VERSION, Welcome, errors, read_line, values};
use mean_information::Real;
use mean_information::operations::{self, OPERATIONS, Operation, Refusal};
use serde::Deserialize;
use serde_json::Value as Json;
use std::io::{self, BufRead, Write};

/// The longest request that is read, in bytes: some million cells.
const LINE_LIMIT: usize = 1 << 26;

/// Answers the requests of `input` until one says stop, or until there are no more.
///
/// # Errors
/// Those of reading and writing.
pub fn serve(input: impl BufRead, output: impl Write) -> io::Result<()> {
    serve_lines(input, output, LINE_LIMIT)
}

fn serve_lines(mut input: impl BufRead, mut output: impl Write, limit: usize) -> io::Result<()> {
    loop {
        let answer = match read_line(&mut input, limit)? {
            Line::End => return Ok(()),
            Line::TooLong(_) => {
                input.skip_until(b'\n')?;
                Some(malformed(None))
            }
            Line::Whole(line) => answer(&line),
        };
        let Some(answer) = answer else { return Ok(()) };
        output.write_all((answer + "\n").as_bytes())?;
        output.flush()?;
    }
}

/// Returns the answer to a line, in a line; none if it says stop.
pub fn answer(line: &[u8]) -> Option<String> {
    let Ok(message) = serde_json::from_slice::<Json>(line) else { return Some(malformed(None)) };
    match Request::deserialize(&message) {
        Ok(Request::Start { protocol: VERSION }) => Some(welcome().line()),
        Ok(Request::Start { .. }) => Some(Answer::new(None, Reply::error(errors::PROTOCOL)).line()),
        Ok(Request::Run(run)) => Some(Answer::new(run.seq, reply(&run)).line()),
        Ok(Request::Stop) => None,
        Err(_) => Some(malformed(message["seq"].as_u64())),
    }
}

fn malformed(seq: Option<u64>) -> String {
    Answer::new(seq, Reply::error(errors::MALFORMED)).line()
}

/// Returns what the library says of itself as a port: both formats, all operations.
pub fn welcome() -> Welcome {
    Welcome {
        protocol: VERSION,
        name: "mean-information".to_owned(),
        language: "Rust".to_owned(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        formats: vec![f32::FORMAT.to_owned(), f64::FORMAT.to_owned()],
        ops: OPERATIONS.iter().map(|operation| operation.name.to_owned()).collect(),
        claims: [].into(),
    }
}

/// Computes the reply to a request.
pub fn reply(run: &Run) -> Reply {
    let Some(operation) = operations::find(&run.op) else { return Reply::error(errors::OPERATION) };
    match run.format.as_str() {
        f32::FORMAT => computed::<f32>(operation, run),
        f64::FORMAT => computed::<f64>(operation, run),
        _ => Reply::error(errors::FORMAT),
    }
}

fn computed<T: Real>(operation: &Operation, run: &Run) -> Reply {
    let values = values::<T>(operation, &run.args).map_err(|_| Refusal::Arguments);
    match values.and_then(|values| operation.run(&values)) {
        Ok(operations::Answer::Float(x)) => Reply::Result(hex_float::format(x).into()),
        Ok(operations::Answer::Count(count)) => Reply::Result(count.into()),
        Err(Refusal::Domain(_)) => Reply::error(errors::DOMAIN),
        Err(Refusal::TooLarge(error)) => Reply::Skipped(error.to_string()),
        Ok(_) => Reply::Skipped("the protocol has no answer of this kind".to_owned()),
        Err(_) => Reply::error(errors::ARGUMENTS),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_that_is_too_long_is_one_request() {
        let input = format!("{}\n{{\"seq\":3}}\n", "x".repeat(1000));
        let mut output = Vec::new();
        serve_lines(input.as_bytes(), &mut output, 100).unwrap();
        let answers = "{\"seq\":null,\"error\":\"malformed\"}\n{\"seq\":3,\"error\":\"malformed\"}\n";
        assert_eq!(String::from_utf8(output).unwrap(), answers);
    }
}
