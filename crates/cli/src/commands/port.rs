//! `meaninfo port`: the library as a port, on standard input and output.

use super::Status;
use crate::failure::Failure;
use clap::Args;
use mean_information_report::port;
use std::io::{self, ErrorKind};

/// The arguments of `meaninfo port`: none.
#[derive(Args, Debug)]
pub struct Arguments {}

impl Arguments {
    #[expect(clippy::unused_self, reason = "as every command")]
    pub(super) fn run(&self) -> Result<Status, Failure> {
        match port::serve(io::stdin().lock(), io::stdout().lock()) {
            Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::Streams(error.to_string())),
            _ => Ok(Status::Done),
        }
    }
}
